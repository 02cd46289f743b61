#include "geometry/curves/operations/hermite_span.h"

#include <fmt/format.h>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

// A difference that 2^20 parts of a span do not bound is not bounded.
constexpr int kMaxHalvings = 20;
// Steps shorter than this part of the range: more spans than anyone wants.
constexpr double kShortestStep = 1e-5;
// Steps are found to this part.
constexpr double kStepAccuracy = 0.01;
// First derivatives that differ by more than this part make a corner.
constexpr double kCorner = 1e-9;

double largest_length(const Triple<Interval>& v) {
  const auto largest = [](const Interval& x) { return std::max(std::abs(x.lo), std::abs(x.hi)); };
  return glm::length(Vec3(largest(v.x), largest(v.y), largest(v.z)));
}

Triple<Interval> between(const Vec3& a, const Vec3& b) {
  Box3 box;
  box.include(a);
  box.include(b);
  return triple(box);
}

// Proves the bound on t by halving; the difference at the ends is known.
template <class Difference, class Bound>
bool proved(const Interval& t, double at_lo, double at_hi, double tolerance, const Difference& difference,
            const Bound& bound_of_second, int halvings) {
  const double ends = std::max(at_lo, at_hi);
  if (!(ends <= tolerance)) return false;
  if (ends + t.width() * t.width() / 8 * bound_of_second(t) <= tolerance) return true;
  if (halvings == 0) return false;
  const double middle = t.middle(), at_middle = difference(middle);
  return proved({t.lo, middle}, at_lo, at_middle, tolerance, difference, bound_of_second, halvings - 1) &&
         proved({middle, t.hi}, at_middle, at_hi, tolerance, difference, bound_of_second, halvings - 1);
}

}  // namespace

Vec3 HermiteSpan::point(double at) const {
  const double h = t.width(), w = (at - t.lo) / h, v = 1 - w;
  return v * v * (1 + 2 * w) * from + w * w * (3 - 2 * w) * to + h * w * v * (v * tangent_from - w * tangent_to);
}

Vec3 HermiteSpan::second(double at) const {
  const double h = t.width(), w = (at - t.lo) / h;
  return ((6 - 12 * w) / h * (to - from) + (6 * w - 4) * tangent_from + (6 * w - 2) * tangent_to) / h;
}

HermiteSpan straight_span(const Interval& t, const Vec3& from, const Vec3& to) {
  const Vec3 slope = (to - from) / t.width();
  return {t, from, to, slope, slope};
}

HermiteSpan hermite_span(const Curve& curve, const Interval& t) {
  const CurveJet from = curve.evaluate(t.lo, 1), to = evaluate_within(curve, t, t.hi, 1);
  return {t, from.d[0], curve.point(t.hi), from.d[1], to.d[1]};
}

bool is_within(const Curve& curve, const HermiteSpan& span, double tolerance) {
  const auto difference = [&](double t) { return glm::length(curve.point(t) - span.point(t)); };
  const auto bound = [&](const Interval& t) {
    return largest_length(triple(curve.enclose(t, 2).d[2]) - between(span.second(t.lo), span.second(t.hi)));
  };
  return proved(span.t, difference(span.t.lo), difference(span.t.hi), tolerance, difference, bound, kMaxHalvings);
}

// Across the chord the difference in parameter does not count, if the curve goes on along it.
bool chord_is_within(const Curve& curve, const Interval& t, double tolerance) {
  const Vec3 from = curve.point(t.lo), chord = curve.point(t.hi) - from;
  const double length = glm::length(chord);
  if (!(length > 0)) return is_within(curve, straight_span(t, from, from), tolerance);
  const Vec3 along = chord / length;
  const Triple<double> unit = triple(along);
  const auto along_chord = [&](const Triple<Interval>& v) { return v.x * unit.x + v.y * unit.y + v.z * unit.z; };
  const auto difference = [&](double at) {
    const Vec3 off = curve.point(at) - from;
    return glm::length(off - glm::clamp(glm::dot(off, along), 0.0, length) * along);
  };
  const auto bound = [&](const Interval& part) {
    const CurveEnclosure enclosure = curve.enclose(part, 2);
    // Where it may run back, it runs beyond the ends by no more than that.
    const double back = std::max(0.0, -along_chord(triple(enclosure.d[1])).lo) * part.width();
    const Triple<Interval> second = triple(enclosure.d[2]);
    const double across = largest_length(second - along_chord(second) * unit);
    return across + 8 * back / (part.width() * part.width());
  };
  return proved(t, 0, 0, tolerance, difference, bound, kMaxHalvings) ||
         is_within(curve, straight_span(t, from, from + chord), tolerance);
}

std::vector<double> corners(const Curve& curve) {
  const Interval domain = curve.domain();
  if (!(domain.width() < kInfinity)) throw FieldError("of", "the curve has no ends", "a part of it has");
  std::vector<double> at{domain.lo};
  const std::vector<CurvePiece> pieces = curve.pieces();
  for (size_t k = 1; k < pieces.size(); ++k) {
    const Vec3 before = evaluate_within(curve, pieces[k - 1].domain, pieces[k - 1].domain.hi, 1).d[1];
    const Vec3 after = curve.evaluate(pieces[k].domain.lo, 1).d[1];
    if (glm::length(after - before) > kCorner * (glm::length(before) + glm::length(after)))
      at.push_back(pieces[k].domain.lo);
  }
  at.push_back(domain.hi);
  return at;
}

std::vector<double> longest_steps(const Interval& t, const std::function<bool(const Interval&)>& fits) {
  std::vector<double> at{t.lo};
  double step = t.width();
  while (at.back() < t.hi) {
    const double from = at.back(), rest = t.hi - from;
    const auto fits_to = [&](double length) { return fits({from, length < rest ? from + length : t.hi}); };
    double good = 0, bad = kInfinity;
    for (double trial = std::min(step, rest); bad - good > kStepAccuracy * good;) {
      (fits_to(trial) ? good : bad) = trial;
      if (good == rest) break;
      if (good == 0 && trial < kShortestStep * t.width())
        throw FieldError("tolerance", fmt::format("more than {:.0f} spans would be needed", 1 / kShortestStep),
                         "a larger tolerance");
      trial = good == 0 ? bad / 2 : bad == kInfinity ? std::min(1.5 * good, rest) : 0.5 * (good + bad);
    }
    step = good;
    at.push_back(good < rest ? from + good : t.hi);
  }
  return at;
}

std::vector<double> equal_steps(const Interval& t, const std::function<bool(const Interval&)>& fits) {
  const auto steps = [&](int count) {
    std::vector<double> at;
    for (int i = 0; i < count; ++i) at.push_back(t.lo + i * t.width() / count);
    at.push_back(t.hi);
    return at;
  };
  const auto all_fit = [&](int count) {
    const std::vector<double> at = steps(count);
    for (int i = 0; i < count; ++i)
      if (!fits({at[i], at[i + 1]})) return false;
    return true;
  };
  int good = 1, bad = 0;
  while (!all_fit(good)) {
    bad = good;
    good *= 2;
    if (good > 1 / kShortestStep)
      throw FieldError("tolerance", fmt::format("more than {:.0f} spans would be needed", 1 / kShortestStep),
                       "a larger tolerance");
  }
  while (good - bad > 1) {
    const int middle = (good + bad) / 2;
    (all_fit(middle) ? good : bad) = middle;
  }
  return steps(good);
}

}  // namespace lekalo::geometry
