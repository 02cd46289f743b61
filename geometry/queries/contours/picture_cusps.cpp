// The curve's own enclosures bound r', r'' and the place on the surface over a part of it, hence m . (r' x i) and its
// derivative; where the surface bends along the line of sight there is none. Parts where the one may be zero and the
// other too are halved; what stays is joined. It holds a cusp if the sign differs at its ends, as a part does where the
// function is monotone.
#include "geometry/queries/contours/picture_cusps.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/contour_curve.h"
#include "geometry/surface_series.h"

namespace lekalo::geometry {

namespace {

// Of the branch's length.
constexpr double kMinPart = 1e-7;
// Parts that stay undecided, for each segment: where there are more the curve keeps to the line of sight.
constexpr size_t kMaxParts = 16;
constexpr int kBisections = 60;

Triple<Interval> ranges(const Box3& box) { return {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}}; }

class CuspSearch {
 public:
  CuspSearch(const Surface& surface, const ContourSolution<2>& solution, const ViewOf& view)
      : surface_(surface), solution_(solution), view_(view) {}

  std::vector<double> run() const {
    const double length = solution_.domain().width();
    std::vector<Interval> monotone, open;
    std::vector<Part> level;
    for (const ContourSegment<2>& segment : solution_.segments()) level.push_back({&segment, segment.t});
    const size_t most = kMaxParts * level.size();
    for (bool first = true; !level.empty(); first = false) {
      std::vector<Part> next;
      const std::vector<Verdict> verdicts = decided(level, first);
      for (size_t k = 0; k < level.size(); ++k) {
        const Part& part = level[k];
        const bool certified = part.segment->is_certified();
        const Verdict verdict = verdicts[k];
        if (verdict == Verdict::none) continue;
        const bool is_small = part.t.width() <= kMinPart * length || (!first && level.size() > most);
        if (verdict == Verdict::monotone || !certified || is_small) {
          (verdict == Verdict::monotone ? monotone : open).push_back(part.t);
          continue;
        }
        const double middle = part.t.middle();
        next.push_back({part.segment, {part.t.lo, middle}});
        next.push_back({part.segment, {middle, part.t.hi}});
      }
      level.swap(next);
    }
    std::vector<Interval> parts = joined(std::move(open));
    parts.insert(parts.end(), monotone.begin(), monotone.end());
    std::vector<double> found;
    for (const Interval& part : parts)
      if (is_positive(part.lo) != is_positive(part.hi)) found.push_back(solution_.wrap(bisect(part)));
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  struct Part {
    const ContourSegment<2>* segment;
    Interval t;
  };

  // What intervals tell of m . (r' x i) over a part.
  enum class Verdict { none, monotone, unsure };

  std::vector<Verdict> decided(const std::vector<Part>& parts, bool are_segments) const {
    std::vector<Verdict> verdicts(parts.size(), Verdict::unsure);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, parts.size()), [&](const tbb::blocked_range<size_t>& some) {
      for (size_t k = some.begin(); k < some.end(); ++k) {
        if (!parts[k].segment->is_certified()) continue;
        verdicts[k] = are_segments && bends_along_sight(*parts[k].segment) ? Verdict::none : decide(parts[k]);
      }
    });
    return verdicts;
  }

  // Where the line of sight i touches, the surface bends along it: with m . s_uu and so on, and i = (a s_u + b
  // s_v)/m^2, a^2 L + 2 a b M + b^2 N is not 0. A line that ran along i there would leave the silhouette. Needs no
  // enclosure of the curve.
  bool bends_along_sight(const ContourSegment<2>& segment) const {
    const ParameterBox<2> domain = segment.equations->domain();
    const Rectangle box{intersect(segment.tube[0], domain[0]), intersect(segment.tube[1], domain[1])};
    if (box.u.empty() || box.v.empty()) return false;
    const SurfaceEnclosure s = surface_.enclose(box, 2);
    const Triple<Interval> s_u = derivative_of(s, 1, 0), s_v = derivative_of(s, 0, 1), m = cross(s_u, s_v);
    const Triple<Interval> sight = sight_at(s.d(0, 0));
    const Interval a = dot(cross(sight, s_v), m), b = dot(cross(s_u, sight), m);
    const Interval bend = sqr(a) * dot(m, derivative_of(s, 2, 0)) +
                          Interval(2) * a * b * dot(m, derivative_of(s, 1, 1)) +
                          sqr(b) * dot(m, derivative_of(s, 0, 2));
    return !bend.contains(0);
  }

  Triple<Interval> sight_at(const Box3& points) const {
    const Vec3& from = view_.direction_or_eye;
    const Triple<Interval> sight{Interval(from.x), Interval(from.y), Interval(from.z)};
    return view_.central ? ranges(points) - sight : sight;
  }

  Verdict decide(const Part& part) const {
    const ContourSolution<2>::Ranges over = solution_.over(part.t, 2);
    const ContourSegment<2>& segment = *part.segment;
    const ParameterBox<2> domain = segment.equations->domain();
    Rectangle box;
    box.u = intersect(over.x[0][0] - Interval(segment.shift[0]), domain[0]);
    box.v = intersect(over.x[1][0] - Interval(segment.shift[1]), domain[1]);
    if (box.u.empty() || box.v.empty()) return Verdict::unsure;
    const SurfaceEnclosure s = surface_.enclose(box, 2);
    const Triple<Interval> s_u = derivative_of(s, 1, 0), s_v = derivative_of(s, 0, 1), normal = cross(s_u, s_v);
    const Triple<Interval> sight = sight_at(over.point[0]);
    const Triple<Interval> across = cross(ranges(over.point[1]), sight);
    if (!dot(normal, across).contains(0)) return Verdict::none;
    // The derivative; that of the sight is r' or nothing, and adds nothing.
    const auto along = [&](int i, int j) {
      return over.x[0][1] * derivative_of(s, i + 1, j) + over.x[1][1] * derivative_of(s, i, j + 1);
    };
    const Interval slope = dot(cross(along(1, 0), s_v) + cross(s_u, along(0, 1)), across) +
                           dot(normal, cross(ranges(over.point[2]), sight));
    if (!slope.contains(0)) return Verdict::monotone;
    const double middle = part.t.middle();
    const Interval rounding = Interval(-1e-14, 1e-14) * Interval(magnitude(dot(normal, across)));
    return (Interval(value(middle)) + rounding + slope * (part.t - Interval(middle))).contains(0) ? Verdict::unsure
                                                                                                  : Verdict::none;
  }

  // m . (r' x i) with m = s_u x s_v.
  double value(double t) const {
    const auto there = solution_.at(solution_.wrap(t), 1);
    const auto vector = [&](int k) { return Vec3(there.point.x.c[k], there.point.y.c[k], there.point.z.c[k]); };
    const Vec3 sight = view_.central ? vector(0) - view_.direction_or_eye : view_.direction_or_eye;
    const SurfaceJet s = surface_.evaluate(there.x[0].c[0], there.x[1].c[0], 1);
    return glm::dot(glm::cross(s.du(), s.dv()), glm::cross(vector(1), sight));
  }
  bool is_positive(double t) const { return value(t) > 0; }

  double bisect(const Interval& part) const {
    double lo = part.lo, hi = part.hi;
    const bool at_lo = is_positive(lo);
    for (int step = 0; step < kBisections && lo < hi; ++step) {
      const double middle = 0.5 * (lo + hi);
      (is_positive(middle) == at_lo ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  }

  // Parts that follow each other are one, also over the joint of a closed curve.
  std::vector<Interval> joined(std::vector<Interval> parts) const {
    std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    std::vector<Interval> result;
    for (const Interval& part : parts) {
      if (!result.empty() && result.back().hi >= part.lo)
        result.back().hi = std::max(result.back().hi, part.hi);
      else
        result.push_back(part);
    }
    const Interval all = solution_.domain();
    if (solution_.is_closed() && result.size() > 1 && result.front().lo <= all.lo && result.back().hi >= all.hi) {
      result.back().hi = all.hi + (result.front().hi - all.lo);
      result.erase(result.begin());
    }
    return result;
  }

  const Surface& surface_;
  const ContourSolution<2>& solution_;
  const ViewOf& view_;
};

}  // namespace

std::vector<double> picture_cusps(const Surface& surface, const Contour& branch, const ViewOf& view) {
  const auto& curve = dynamic_cast<const ContourCurve<2>&>(*branch.curve);
  return CuspSearch(surface, curve.solution(), view).run();
}

}  // namespace lekalo::geometry
