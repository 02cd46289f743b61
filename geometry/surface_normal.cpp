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
#include <cmath>

#include "geometry/surface.h"

namespace lekalo::geometry {

namespace {

constexpr int kSeriesOrder = 3;
// Near a singular point, at the distance delta from it, N loses eps/delta of its direction and the limit is off by
// delta: they are equal at 1e-8.
constexpr double kSwitch = 1e-8;
// Coefficients below this share of their own terms are rounding errors.
constexpr double kNoise = 1e-13;

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
  double size = 0;  // the largest sum of the absolute values of a coefficient's terms
};

NormalSeries normal_series(const SurfaceJet& jet, double step_u, double step_v) {
  constexpr double kFactorial[] = {1, 1, 2, 6};
  Vec3 ru[kSeriesOrder + 1], rv[kSeriesOrder + 1];
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
  }
  NormalSeries series;
  for (int k = 0; k <= kSeriesOrder; ++k) {
    series.c[k] = Vec3(0);
    double size = 0;
    for (int i = 0; i <= k; ++i) {
      series.c[k] += glm::cross(ru[i], rv[k - i]);
      size += glm::length(ru[i]) * glm::length(rv[k - i]);
    }
    series.size = std::max(series.size, size);
  }
  return series;
}

// The coefficient whose direction the normal takes, or -1.
int leading_coefficient(const NormalSeries& series) {
  for (int k = 0; k <= kSeriesOrder; ++k) {
    const double length = glm::length(series.c[k]);
    if (!(length > kNoise * series.size)) continue;
    bool leads = true;
    for (int later = k + 1; later <= kSeriesOrder; ++later)
      leads = leads && length > kSwitch * glm::length(series.c[later]);
    if (leads) return k;
  }
  return -1;
}

Vec3 limit_normal(const Surface& surface, double u, double v) {
  const Rectangle domain = surface.domain();
  const double step_u = scale_of(domain.u) * inward(domain.u, u);
  const double step_v = scale_of(domain.v) * inward(domain.v, v);
  const NormalSeries series = normal_series(surface.evaluate(u, v, kSeriesOrder + 1), step_u, step_v);
  const int k = leading_coefficient(series);
  if (k >= 0) {
    // A point just before a singular line that the direction crosses keeps the normal of its own side.
    const bool crosses =
        k > 0 && glm::length(series.c[0]) > kNoise * series.size && glm::dot(series.c[0], series.c[k]) < 0;
    return glm::normalize(crosses ? -series.c[k] : series.c[k]);
  }
  for (const double shift : {1e-6, 1e-4, 1e-2}) {
    const SurfaceJet near = surface.evaluate(u + shift * step_u, v + shift * step_v, 1);
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

Vec3 parametric_normal(const Surface& surface, double u, double v, const SurfaceJet& jet) {
  const Vec3 n = glm::cross(jet.du(), jet.dv());
  const double length = glm::length(n);
  const Rectangle domain = surface.domain();
  const double scale_u = scale_of(domain.u), scale_v = scale_of(domain.v);
  const double reach = std::max(glm::length(jet.du()) * scale_u, glm::length(jet.dv()) * scale_v);
  const Vec3 p = glm::abs(jet.point());
  const bool tiny = reach < 1e-9 * std::max({p.x, p.y, p.z});
  if (!tiny && length * scale_u * scale_v > 10 * kSwitch * reach * reach && std::isfinite(length)) return n / length;
  return limit_normal(surface, u, v);
}

}  // namespace lekalo::geometry
