#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/machining/turning_pass.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxFeedPoints = 20000;
constexpr int kEvaluations = 200000;
constexpr int kHalvings = 200;  // at most: until no number is left between

std::vector<double> breaks_of(const Curve& curve) {
  std::vector<double> breaks;
  for (const CurvePiece& piece : curve.pieces()) breaks.push_back(piece.domain.lo);
  breaks.push_back(curve.domain().hi);
  return breaks;
}

}  // namespace

double parameter_at_x(const Curve& profile, double x) {
  Interval t = profile.domain();
  const bool grows = profile.point(t.hi).x > profile.point(t.lo).x;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = t.middle();
    if (middle <= t.lo || middle >= t.hi) break;
    ((profile.point(middle).x < x) == grows ? t.lo : t.hi) = middle;
  }
  return t.middle();
}

Measured removed_volume(const Curve& before, const Curve& after) {
  std::vector<double> breaks = breaks_of(before);
  for (const double t : breaks_of(after)) breaks.push_back(t);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  const auto integrand = [&](double t, std::span<double> value) {
    const CurveJet at = after.evaluate(t, 1);
    const double r = before.point(t).y;
    value[0] = kPi * (r * r - at.d[0].y * at.d[0].y) * at.d[1].x;
  };
  const Integral integral = integrate(integrand, 1, breaks, {0, kMeasureAccuracy, kEvaluations});
  return {std::abs(integral.value[0]), integral.error[0]};
}

std::vector<FeedPoint> feed_points(const Curve& profile, double feed, double allowance, bool forward) {
  const Interval domain = profile.domain();
  const double first = profile.point(domain.lo).x, last = profile.point(domain.hi).x;
  const Interval x(std::min(first, last), std::max(first, last));
  const double way = forward ? 1 : -1, end = forward ? x.hi : x.lo;
  std::vector<FeedPoint> points;
  for (double at = forward ? x.lo : x.hi;;) {
    FeedPoint one;
    one.t = parameter_at_x(profile, at);
    const CurveJet jet = profile.evaluate(one.t, 1);
    one.point = jet.d[0];
    one.slope = std::atan2(-way * jet.d[1].y * (jet.d[1].x < 0 ? -1 : 1), std::abs(jet.d[1].x));
    one.depth = allowance / std::cos(one.slope);
    const double left = std::abs(end - at);
    one.step = std::min(feed * std::cos(one.slope), left);
    // The profile may get steeper before the next point.
    for (int k = 0; k < 40; ++k) {
      const Vec3 next = profile.point(parameter_at_x(profile, at + way * one.step));
      if (glm::length(next - one.point) <= feed * (1 + 1e-9)) break;
      one.step *= 0.9;
    }
    points.push_back(one);
    if (!(left > 1e-12 * x.width())) return points;
    at = one.step >= left ? end : at + way * one.step;
    if (points.size() > kMaxFeedPoints)
      throw FieldError("feed", "more than 20000 places are needed", "take a larger feed");
  }
}

}  // namespace lekalo::geometry
