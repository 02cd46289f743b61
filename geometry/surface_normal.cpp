// The unit normal where it is easy, and its limit where r_u x r_v vanishes (Golovanov 2016, 3.1).
//
// With N = r_u x r_v, in parameters scaled to the domain's ranges, and a direction (a, b) from the point towards the
// middle of the domain, N along that direction is the series
//
//   N(tau) = sum c_k tau^k,   r_u(tau) = sum tau^k/k! (a d_u + b d_v)^k r_u,   r_v likewise,
//
// and the limit of N/|N| is the first coefficient that does not vanish. At a pole (r_u = 0 along an edge v = v0) c_1 is
// r_uv x r_v times the sign of v - v0: the tip of a cone thus keeps one normal for each u. Where r_u and r_v are
// parallel at a corner, or control points coincide to higher order, c_2 and c_3 decide; they need derivatives up to
// order 4.
#include "geometry/surface_normal.h"

#include <cmath>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

constexpr int kSeriesOrder = 3;

double scale_of(const Interval& range) {
  const double width = range.width();
  return width > 0 && width < kInfinity ? width : 1.0;
}

// Direction towards the middle of a range in its own scale; to the right of the middle itself.
double inward(const Interval& range, double x) {
  const double width = range.width();
  if (!(width > 0 && width < kInfinity)) return 1;
  const double from_middle = (x - range.middle()) / width;
  return from_middle > 1e-9 ? -1 : 1;
}

struct NormalSeries {
  Vec3 c[kSeriesOrder + 1];
  double noise[kSeriesOrder + 1];  // lengths that rounding alone can give the coefficients
};

NormalSeries normal_series(const SurfaceJet& jet, double step_u, double step_v) {
  constexpr double kFactorial[] = {1, 1, 2, 6};
  Vec3 ru[kSeriesOrder + 1], rv[kSeriesOrder + 1];
  const Vec3 at = glm::abs(jet.point());
  double largest_u = 0, largest_v = 0;
  for (int k = 0; k <= kSeriesOrder; ++k) {
    ru[k] = rv[k] = Vec3(0);
    double binomial = 1;  // of k over j
    for (int j = 0; j <= k; ++j) {
      const double factor = binomial / kFactorial[k] * std::pow(step_u, k - j) * std::pow(step_v, j);
      ru[k] += factor * jet.d(k - j + 1, j);
      rv[k] += factor * jet.d(k - j, j + 1);
      binomial = binomial * (k - j) / (j + 1);
    }
    ru[k] *= std::abs(step_u);
    rv[k] *= std::abs(step_v);
    largest_u = std::max(largest_u, glm::length(ru[k]));
    largest_v = std::max(largest_v, glm::length(rv[k]));
  }
  // Derivatives round at the size of the coordinates that they are differences of: beside a pole far off the origin the
  // vanishing one is nothing else.
  const double coordinates = std::max({at.x, at.y, at.z}) * (largest_u + largest_v);
  NormalSeries series;
  for (int k = 0; k <= kSeriesOrder; ++k) {
    series.c[k] = Vec3(0);
    double terms = coordinates;
    for (int i = 0; i <= k; ++i) {
      series.c[k] += glm::cross(ru[i], rv[k - i]);
      terms += glm::length(ru[i]) * largest_v + largest_u * glm::length(rv[k - i]);
    }
    series.noise[k] = kNormalNoise * terms;
  }
  return series;
}

Vec3 limit_normal(const Surface& surface, double u, double v) {
  const Vec2 step = inward_step(surface.domain(), u, v);
  const NormalSeries series = normal_series(surface.evaluate(u, v, kSeriesOrder + 1), step.x, step.y);
  // The coefficient that rules at a small distance. A vanishing N is looked at from further away: at a double root (the
  // tip of a horn torus) c_1 is known long before it vanishes, but has opposite signs on the two sides.
  const bool vanishes = !(glm::length(series.c[0]) > series.noise[0]);
  const double distance = vanishes ? 100 * kNormalLimit : kNormalLimit;
  int leading = -1;
  double largest = 0;
  for (int k = kSeriesOrder; k >= 0; --k) {
    const double length = glm::length(series.c[k]), term = length * std::pow(distance, k);
    if (length > series.noise[k] && term > largest) {
      largest = term;
      leading = k;
    }
  }
  if (leading >= 0) {
    const Vec3& c = series.c[leading];
    // A point just before a singular line that the direction crosses keeps the normal of its own side. On one where a
    // smooth piece ends the series is that of the piece, but behind it there may be another.
    const auto beyond = [&] {
      const SurfaceJet jet = surface.evaluate(u + distance * step.x, v + distance * step.y, 1);
      return glm::cross(jet.du(), jet.dv());
    };
    const bool crosses = glm::dot(vanishes ? beyond() : series.c[0], c) < 0;
    return glm::normalize(crosses ? -c : c);
  }
  // Beside derivatives that grow without bounds, as those of a root of zero, no digits are lost, however near the
  // place.
  const bool infinite = !std::isfinite(glm::length(series.c[0]));
  for (double shift = infinite ? 1e-15 : 1e-6; shift < 0.1; shift *= 100) {
    const SurfaceJet near = surface.evaluate(u + shift * step.x, v + shift * step.y, 1);
    const Vec3 n = glm::cross(near.du(), near.dv());
    const double length = glm::length(n);
    if (length > 0 && std::isfinite(length)) return n / length;
  }
  // The surface is a curve or a point here: any unit vector across it.
  const SurfaceJet jet = surface.evaluate(u, v, 1);
  const Vec3 tangent = glm::length(jet.du()) > glm::length(jet.dv()) ? jet.du() : jet.dv();
  const double length = glm::length(tangent);
  return length > 0 && std::isfinite(length) ? frame_about(Vec3(0), tangent / length).x : Vec3(0, 0, 1);
}

}  // namespace

Vec2 inward_step(const Rectangle& domain, double u, double v) {
  return {scale_of(domain.u) * inward(domain.u, u), scale_of(domain.v) * inward(domain.v, v)};
}

Vec3 parametric_normal(const Surface& surface, double u, double v, const SurfaceJet& jet) {
  const Vec3 n = glm::cross(jet.du(), jet.dv());
  const double length = glm::length(n);
  const Rectangle domain = surface.domain();
  const double scale_u = scale_of(domain.u), scale_v = scale_of(domain.v);
  const double reach = std::max(glm::length(jet.du()) * scale_u, glm::length(jet.dv()) * scale_v);
  const Vec3 p = glm::abs(jet.point());
  const bool tiny = reach < 1e-9 * std::max({p.x, p.y, p.z});
  if (!tiny && length * scale_u * scale_v > 10 * kNormalLimit * reach * reach && std::isfinite(length))
    return n / length;
  return limit_normal(surface, u, v);
}

}  // namespace lekalo::geometry
