#include "geometry/curves/splines/rational_cubic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bezier_curve.h"

namespace lekalo::geometry {

namespace {

// Of the first leg: nearer to its line the third point is on it.
constexpr double kOnLine = 1e-12;

Vec3 binormal_curvature(double invariant, const Vec3& across, double leg) {
  return 2 * invariant / (3 * leg * leg * leg) * across;
}

std::array<double, 4> read_weights(const Fields& f, const RationalCubic& polygon) {
  const bool by_curvature = f.has("start_curvature") || f.has("end_curvature");
  if (f.has("weights") + f.has("invariants") + by_curvature > 1)
    throw FieldError(f.has("weights") ? "weights" : "invariants",
                     "weights, invariants and curvatures at the ends say the same", "give one of them");
  if (f.has("weights")) {
    const std::vector<double>& w = f.numbers("weights");
    return {w[0], w[1], w[2], w[3]};
  }
  const auto& p = polygon.points;
  double start = 1, end = 1;
  if (f.has("invariants")) start = f.numbers("invariants")[0], end = f.numbers("invariants")[1];
  if (f.has("start_curvature"))
    start = invariant_of_curvature(f.number("start_curvature"), p[0], p[1], p[2], "start_curvature");
  if (f.has("end_curvature"))
    end = invariant_of_curvature(f.number("end_curvature"), p[3], p[2], p[1], "end_curvature");
  return weights_of_invariants(start, end);
}

}  // namespace

Vec3 RationalCubic::start_curvature() const {
  const Vec3 a = points[1] - points[0];
  return binormal_curvature(start_invariant(), glm::cross(a, points[2] - points[1]), glm::length(a));
}

Vec3 RationalCubic::end_curvature() const {
  const Vec3 c = points[3] - points[2];
  return binormal_curvature(end_invariant(), glm::cross(points[2] - points[1], c), glm::length(c));
}

BezierSegment RationalCubic::bezier() const {
  BezierSegment segment;
  for (int i = 0; i < 4; ++i) segment.push_back({weights[i] * points[i], weights[i]});
  return segment;
}

std::array<double, 4> weights_of_invariants(double start, double end, CubicWeights form) {
  if (form == CubicWeights::inner_ones) return {start, 1, 1, end};
  const double s = std::cbrt(start), e = std::cbrt(end);
  return {1, 1 / (s * s * e), 1 / (s * e * e), 1};
}

double invariant_of_curvature(double curvature, const Vec3& p0, const Vec3& p1, const Vec3& p2,
                              const std::string& field) {
  const Vec3 leg = p1 - p0;
  const double length = glm::length(leg);
  const double distance = length > 0 ? glm::length(glm::cross(leg, p2 - p0)) / length : 0;
  if (!(distance > kOnLine * length))
    throw FieldError(field, "the three points at this end lie on one line: the curvature there is 0 for any weights",
                     "move one of them off the line, or leave the curvature out");
  return 1.5 * curvature * length * length / distance;
}

TypeDeclaration rational_cubic_type() {
  return declare(Category::curve, "rational_cubic",
                 "Rational cubic segment; its weights are given, or follow from the curvature at its ends; t runs in "
                 "0..1.")
      .example("points: [[0, 0], [1, 2], [3, 2], [4, 0]], start_curvature: 0.4")
      .field("points", points().count(4, 4), "control points")
      .optional("weights", numbers().positive().count(4, 4), "one for each point; all 1 without anything else")
      .optional("invariants", numbers().positive().count(2, 2),
                "w0 w2/w1^2 and w1 w3/w2^2 instead, which are all that shapes the curve; w0 = w3 = 1 then")
      .optional("start_curvature", number().positive(), "curvature at t = 0 instead, 1/length")
      .optional("end_curvature", number().positive(), "curvature at t = 1 instead, 1/length")
      .field("standard_form", boolean(), "changes given weights to those with w0 = w3 = 1 of the same curve", "false")
      .shows({"control_polygon", "de_casteljau"})
      .built_by([](const Fields& f) {
        RationalCubic cubic;
        std::copy_n(f.points("points").begin(), 4, cubic.points.begin());
        cubic.weights = read_weights(f, cubic);
        if (f.boolean("standard_form"))
          cubic.weights = weights_of_invariants(cubic.start_invariant(), cubic.end_invariant());
        return bezier_curve(cubic.points, cubic.weights);
      });
}

}  // namespace lekalo::geometry
