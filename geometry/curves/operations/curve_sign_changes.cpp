#include "geometry/curves/operations/curve_sign_changes.h"

#include <algorithm>

namespace lekalo::geometry {

namespace {

constexpr double kMinPart = 1e-7;  // of the domain
// Parts of one length that stay undecided, for each piece: where there are more the function keeps to zero.
constexpr size_t kMaxParts = 32;
constexpr int kBisections = 60;

}  // namespace

std::vector<double> sign_changes(const Curve& curve, bool closed, const std::function<Interval(const Box3&)>& range,
                                 const std::function<double(const Vec3&)>& value) {
  const Interval domain = curve.domain();
  std::vector<Interval> level, open;
  for (const CurvePiece& piece : curve.pieces())
    if (const Interval t = intersect(piece.domain, domain); t.width() > 0) level.push_back(t);
  const size_t most = kMaxParts * level.size();
  for (bool first = true; !level.empty(); first = false) {
    std::vector<Interval> next;
    const bool last = !first && level.size() > most;
    for (const Interval& t : level) {
      if (!range(curve.enclose(t, 0).d[0]).contains(0)) continue;
      const double middle = t.middle();
      if (last || t.width() <= kMinPart * domain.width() || !(t.lo < middle && middle < t.hi)) {
        open.push_back(t);
        continue;
      }
      next.emplace_back(t.lo, middle);
      next.emplace_back(middle, t.hi);
    }
    level.swap(next);
  }
  const auto wrapped = [&](double t) { return t > domain.hi ? t - domain.width() : t; };
  const auto is_positive = [&](double t) { return value(curve.point(wrapped(t))) > 0; };
  // Pieces meet to rounding only: the bounds of neither may tell of a change at a joint.
  for (const CurvePiece& piece : curve.pieces())
    if (const double t = piece.domain.lo; t > domain.lo && t < domain.hi && is_positive(next_down(t)) != is_positive(t))
      open.emplace_back(next_down(t), t);
  // Parts that follow each other are one, also over the joint of a closed curve.
  std::sort(open.begin(), open.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
  std::vector<Interval> joined;
  for (const Interval& t : open) {
    if (!joined.empty() && joined.back().hi >= t.lo)
      joined.back().hi = std::max(joined.back().hi, t.hi);
    else
      joined.push_back(t);
  }
  if (closed && joined.size() > 1 && joined.front().lo <= domain.lo && joined.back().hi >= domain.hi) {
    joined.back().hi += joined.front().hi - domain.lo;
    joined.erase(joined.begin());
  }
  std::vector<double> found;
  for (const Interval& part : joined) {
    const bool begins = is_positive(part.lo);
    if (begins == is_positive(part.hi)) continue;
    double lo = part.lo, hi = part.hi;
    for (int step = 0; step < kBisections && lo < hi; ++step) {
      const double middle = 0.5 * (lo + hi);
      (is_positive(middle) == begins ? lo : hi) = middle;
    }
    found.push_back(wrapped(0.5 * (lo + hi)));
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace lekalo::geometry
