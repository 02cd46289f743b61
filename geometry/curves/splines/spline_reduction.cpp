#include "geometry/curves/splines/spline_reduction.h"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

#include "geometry/curves/splines/blossom.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/weights.h"

namespace lekalo::geometry {

namespace {

// Homogeneous Bezier points over [a, b], inside one span, of a degree that is not lower than the form's.
std::vector<Vec4> bezier_points_of(const NurbsCurveForm& form, double a, double b, int degree) {
  const int p = form.degree, span = find_span(p, form.knots, 0.5 * (a + b));
  std::vector<Vec4> points(static_cast<size_t>(p) + 1);
  bezier_points(p, form.knots, span, form.points.data(), 1, a, b, points.data(), 1);
  while (static_cast<int>(points.size()) <= degree) {  // Golovanov 2016, 2.6
    const auto n = static_cast<double>(points.size());
    std::vector<Vec4> higher{points.front()};
    for (size_t i = 1; i < points.size(); ++i)
      higher.push_back(
          affine_mix(static_cast<double>(i) / n, points[i - 1], 1 - static_cast<double>(i) / n, points[i]));
    higher.push_back(points.back());
    points = std::move(higher);
  }
  return points;
}

Vec4 homogeneous_point(const NurbsCurveForm& form, double t) {
  const int p = form.degree, span = find_span(p, form.knots, t);
  const SpanBasis basis = span_basis(p, form.knots, span, t, 0);
  Vec4 sum(0);
  for (int m = 0; m <= p; ++m) sum += basis.values[0][m] * form.points[static_cast<size_t>(span - p + m)];
  return sum;
}

ReducedCurve interpolated(const NurbsCurveForm& form, int degree, std::vector<double> knots) {
  NurbsCurveForm result{degree, std::move(knots), {}, {}};
  const auto count = static_cast<Eigen::Index>(result.knots.size()) - degree - 1;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count), values(count, 4);
  for (Eigen::Index j = 0; j < count; ++j) {
    double site = 0;
    for (int k = 1; k <= degree; ++k) site += result.knots[static_cast<size_t>(j + k)] / degree;
    site = form.domain().clamp(site);
    const int span = find_span(degree, result.knots, site);
    const SpanBasis basis = span_basis(degree, result.knots, span, site, 0);
    for (int m = 0; m <= degree; ++m) matrix(j, span - degree + m) = basis.values[0][m];
    const Vec4 point = homogeneous_point(form, site);
    for (int k = 0; k < 4; ++k) values(j, k) = point[k];
  }
  const Eigen::MatrixXd points = matrix.partialPivLu().solve(values);
  for (Eigen::Index j = 0; j < count; ++j)
    result.points.emplace_back(points(j, 0), points(j, 1), points(j, 2), points(j, 3));
  if (!has_weights(form.points))
    for (Vec4& point : result.points) point.w = 1;
  return {result, deviation_bound(form, result)};
}

std::vector<double> inner_knots(const NurbsCurveForm& form) {
  const auto p = static_cast<std::ptrdiff_t>(form.degree);
  return {form.knots.begin() + p + 1, form.knots.end() - p - 1};
}

std::vector<double> clamped_knots(const NurbsCurveForm& form, int degree, const std::vector<double>& inner) {
  std::vector<double> knots(static_cast<size_t>(degree) + 1, form.domain().lo);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), static_cast<size_t>(degree) + 1, form.domain().hi);
  return knots;
}

}  // namespace

// Of a - b = (A - B - (w_a - w_b) b)/w_a, in coordinates about a point of the curve.
double deviation_bound(const NurbsCurveForm& a, const NurbsCurveForm& b) {
  const Interval domain = intersect(a.domain(), b.domain());
  std::vector<double> ends{domain.lo, domain.hi};
  for (const NurbsCurveForm* form : {&a, &b})
    for (const double knot : form->knots)
      if (domain.lo < knot && knot < domain.hi) ends.push_back(knot);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const int degree = std::max(a.degree, b.degree);
  double bound = 0;
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    const std::vector<Vec4> p = bezier_points_of(a, ends[k], ends[k + 1], degree),
                            q = bezier_points_of(b, ends[k], ends[k + 1], degree);
    if (!all_weights_positive(p) || !all_weights_positive(q)) return kInfinity;
    const Vec3 center = Vec3(p[0]) / p[0].w;
    double apart = 0, weight = kInfinity, weights_apart = 0, reach = 0;
    for (size_t i = 0; i < p.size(); ++i) {
      const Vec3 a_i = Vec3(p[i]) - p[i].w * center, b_i = Vec3(q[i]) - q[i].w * center;
      apart = std::max(apart, glm::length(a_i - b_i));
      weights_apart = std::max(weights_apart, std::abs(p[i].w - q[i].w));
      reach = std::max(reach, glm::length(b_i) / q[i].w);
      weight = std::min(weight, p[i].w);
    }
    bound = std::max(bound, (apart + weights_apart * reach) / weight);
  }
  return bound;
}

ReducedCurve reduced_degree(const NurbsCurveForm& form, int degree) {
  const int lower = form.degree - degree;
  std::vector<double> inner;
  const std::vector<double> old = inner_knots(form);
  for (auto knot = old.begin(); knot != old.end();) {
    const auto next = std::upper_bound(knot, old.end(), *knot);
    const int copies = std::clamp(static_cast<int>(next - knot) - lower, 1, degree);
    inner.insert(inner.end(), static_cast<size_t>(copies), *knot);
    knot = next;
  }
  return interpolated(form, degree, clamped_knots(form, degree, inner));
}

ReducedCurve without_knots(const NurbsCurveForm& form, std::span<const double> knots) {
  std::vector<double> inner = inner_knots(form);
  for (const double knot : knots) {
    const auto found = std::find(inner.begin(), inner.end(), knot);
    if (found == inner.end())
      throw std::invalid_argument(fmt::format("{} is no knot inside the domain that is left", knot));
    inner.erase(found);
  }
  return interpolated(form, form.degree, clamped_knots(form, form.degree, inner));
}

ReducedCurve with_fewest_knots(const NurbsCurveForm& form, double tolerance) {
  std::vector<double> inner = inner_knots(form);
  ReducedCurve best{form, 0};
  for (size_t i = inner.size(); i-- > 0;) {
    std::vector<double> fewer = inner;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    const ReducedCurve reduced = interpolated(form, form.degree, clamped_knots(form, form.degree, fewer));
    if (!(reduced.bound <= tolerance)) continue;
    inner = std::move(fewer);
    best = reduced;
  }
  return best;
}

}  // namespace lekalo::geometry
