// sum_i w_i |r(t_i) - p_i|^2 + stiffness * integral of |r''|^2 is a sum of squares that are linear in the control
// points: the integral by Gauss's rule on each span, which is exact. QR decomposition does not square the condition.
//
// Cubics that meet with a common tangent alone have sum_j beta_j |r''(T_j+) - r''(T_j-)|^2 beside it (Zavyalov et al.
// 1985, II.5, problem 7b); large beta_j make them a spline of class C2.
#include "geometry/curves/interpolation/fit_curve.h"

#include <fmt/format.h>

#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>

#include "geometry/curves/interpolation/collocation.h"
#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

namespace {

// Parameters stop moving when the sum of squares falls by less than this part.
constexpr double kSettled = 1e-9;

using Sparse = Eigen::SparseMatrix<double>;

SplineAxis fit_axis(const PointSequence& data, const std::vector<double>& breaks, const FitOptions& options) {
  const double lo = data.parameters.front(), hi = data.parameters.back();
  const int degree = options.degree, copies = options.jump_weights.empty() ? 1 : 2;
  std::vector<double> inner;
  for (const double t : breaks) inner.insert(inner.end(), copies, t);
  return data.closed ? periodic_axis(degree, inner, hi - lo) : clamped_axis(degree, lo, hi, inner);
}

struct Rows {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vec3> right;

  void add(const SplineAxis& axis, double t, int order, double scale, const Vec3& value) {
    const SplineAxis::Place place = axis.place(t);
    add_to_last(axis, place.span, place.t, order, scale);
    right.push_back(scale * value);
  }

  // The jump of the second derivative between two neighbouring spans, which shall be 0.
  void add_jump(const SplineAxis& axis, int before, int after, double scale) {
    const auto& knots = axis.knots();
    add_to_last(axis, after, knots[after], 2, scale);
    add_to_last(axis, before, knots[before + 1], 2, -scale);
    right.emplace_back(0);
  }

 private:
  void add_to_last(const SplineAxis& axis, int span, double t, int order, double scale) {
    const int p = axis.degree();
    std::vector<double> basis(p + 1);
    basis_derivative(p, axis.knots(), span, t, order, basis);
    for (int m = 0; m <= p; ++m)
      entries.emplace_back(static_cast<int>(right.size()), (span - p + m) % axis.distinct(), scale * basis[m]);
  }
};

// One weight for all places where spans meet, or one for each.
void add_jumps(const SplineAxis& axis, const std::vector<double>& weights, Rows& rows) {
  const auto& knots = axis.knots();
  std::vector<int> spans;
  for (int span = axis.degree(); span < axis.degree() + axis.distinct(); ++span)
    if (knots[span + 1] > knots[span] && knots[span] < axis.domain().hi) spans.push_back(span);
  if (axis.periodic()) spans.insert(spans.begin(), spans.back());
  for (size_t k = 0; k + 1 < spans.size(); ++k)
    rows.add_jump(axis, spans[k], spans[k + 1], std::sqrt(weights.size() == 1 ? weights[0] : weights[k]));
}

void add_stiffness(const SplineAxis& axis, double stiffness, Rows& rows) {
  const auto& knots = axis.knots();
  const auto rule = gauss_legendre(std::max(axis.degree() - 1, 1));
  for (int span = axis.degree(); span < axis.degree() + axis.distinct(); ++span) {
    const double lo = knots[span], h = knots[span + 1] - lo;
    if (!(h > 0) || (!axis.periodic() && lo >= axis.domain().hi)) continue;
    for (size_t k = 0; k < rule.nodes.size(); ++k)
      rows.add(axis, lo + 0.5 * h * (1 + rule.nodes[k]), 2, std::sqrt(stiffness * 0.5 * h * rule.weights[k]), Vec3(0));
  }
}

NurbsCurve fitted(const SplineAxis& axis, std::span<const Vec3> points, const std::vector<double>& parameters,
                  const FitOptions& options) {
  Rows rows;
  const Vec3 origin = points[0];
  for (size_t i = 0; i < points.size(); ++i)
    rows.add(axis, parameters[i], 0, options.weights.empty() ? 1 : std::sqrt(options.weights[i]), points[i] - origin);
  if (options.stiffness > 0 && options.degree > 1) add_stiffness(axis, options.stiffness, rows);
  if (!options.jump_weights.empty()) add_jumps(axis, options.jump_weights, rows);
  const int count = axis.distinct(), height = static_cast<int>(rows.right.size());
  Sparse matrix(height, count);
  matrix.setFromTriplets(rows.entries.begin(), rows.entries.end());
  Eigen::MatrixX3d right(height, 3);
  for (int i = 0; i < height; ++i) right.row(i) << rows.right[i].x, rows.right[i].y, rows.right[i].z;
  const Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> factors(matrix);
  if (height < count || factors.rank() < count)
    throw FieldError("points",
                     fmt::format("{} points do not determine a spline of degree {} with {} control points",
                                 points.size(), axis.degree(), count),
                     "fewer spans, knots where points are, or a stiffness");
  const Eigen::MatrixX3d solution = factors.solve(right);
  std::vector<Vec3> control;
  for (int i = 0; i < count; ++i) control.push_back(origin + Vec3(solution(i, 0), solution(i, 1), solution(i, 2)));
  return NurbsCurve(axis, control);
}

double sum_of_squares(const NurbsCurve& curve, std::span<const Vec3> points, const std::vector<double>& parameters) {
  double sum = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 off = curve.point(parameters[i]) - points[i];
    sum += glm::dot(off, off);
  }
  return sum;
}

// One Newton step towards the foot of the point, taken where it brings the curve nearer.
double nearer_parameter(const NurbsCurve& curve, const Vec3& p, double t) {
  const CurveJet at = curve.evaluate(t, 2);
  const Vec3 off = at.d[0] - p;
  const double slope = glm::dot(at.d[1], at.d[1]) + glm::dot(off, at.d[2]);
  if (!(slope > 0)) return t;
  double moved = t - glm::dot(off, at.d[1]) / slope;
  if (curve.period() == 0) moved = curve.domain().clamp(moved);
  return glm::length(curve.point(moved) - p) < glm::length(off) ? moved : t;
}

void check_jump_weights(const FitOptions& options, size_t joints) {
  const std::vector<double>& weights = options.jump_weights;
  if (weights.empty()) return;
  if (options.degree != 3) throw FieldError("jump_weights", "only cubics have them", "degree: 3");
  if (weights.size() != 1 && weights.size() != joints)
    throw FieldError("jump_weights", fmt::format("{} weights do not fit {} joints of pieces", weights.size(), joints),
                     "one for all, or one for each");
  for (size_t i = 0; i < weights.size(); ++i)
    if (!(weights[i] >= 0)) throw FieldError("jump_weights", fmt::format("weight {} is {}, below 0", i, weights[i]));
}

void check_options(const PointSequence& data, const FitOptions& options) {
  if (!options.weights.empty() && options.weights.size() != data.points.size())
    throw FieldError("weights", fmt::format("{} weights do not fit {} points", options.weights.size(), data.size()));
  for (size_t i = 0; i < options.weights.size(); ++i)
    if (!(options.weights[i] > 0))
      throw FieldError("weights", fmt::format("weight {} is {}, not positive", i, options.weights[i]),
                       "a small one lets the curve pass far from the point; leave out a point that has none");
}

struct Fit {
  NurbsCurve curve;
  std::vector<double> parameters;
};

Fit fit(const PointSequence& data, const std::vector<double>& knots, const FitOptions& options) {
  check_options(data, options);
  check_jump_weights(options, knots.size());
  const SplineAxis axis = fit_axis(data, knots, options);
  std::vector<double> parameters(data.parameters.begin(), data.parameters.begin() + data.size());
  Fit result{fitted(axis, data.points, parameters, options), parameters};
  double sum = sum_of_squares(result.curve, data.points, parameters);
  for (int pass = 0; pass < options.passes; ++pass) {
    for (int i = data.closed ? 0 : 1; i < data.size() - (data.closed ? 0 : 1); ++i)
      parameters[i] = nearer_parameter(result.curve, data.points[i], parameters[i]);
    Fit next{fitted(axis, data.points, parameters, options), parameters};
    const double smaller = sum_of_squares(next.curve, data.points, parameters);
    if (!(smaller < sum)) break;
    const bool settled = sum - smaller <= kSettled * sum;
    sum = smaller;
    result = std::move(next);
    if (settled) break;
  }
  return result;
}

}  // namespace

NurbsCurve fit_curve(const PointSequence& data, const std::vector<double>& knots, const FitOptions& options) {
  return fit(data, knots, options).curve;
}

std::vector<double> even_knots(const PointSequence& data, int spans) {
  std::vector<double> knots;
  const int steps = data.closed ? data.size() : data.size() - 1;
  for (int j = data.closed ? 0 : 1; j < spans; ++j) {
    const double place = static_cast<double>(j) * steps / spans;
    const int i = static_cast<int>(place);
    knots.push_back(data.parameter(i) + (place - i) * (place > i ? data.step(i) : 0));
  }
  return knots;
}

NurbsCurve fit_within(const PointSequence& data, double tolerance, const FitOptions& options) {
  // Spans by the numbers of the points where they begin; each has a step of the points at least.
  const int steps = data.closed ? data.size() : data.size() - 1;
  std::vector<int> begins{0};
  if (data.closed) begins = {0, steps / 3, 2 * steps / 3};
  while (true) {
    std::vector<double> knots;
    for (const int i : begins)
      if (i > 0 || data.closed) knots.push_back(data.parameter(i));
    const Fit found = fit(data, knots, options);
    std::vector<int> halves;
    double largest = 0;
    for (size_t k = 0; k < begins.size(); ++k) {
      const int end = k + 1 < begins.size() ? begins[k + 1] : steps;
      double off = 0;
      for (int i = begins[k]; i <= std::min(end, data.size() - 1); ++i)
        off = std::max(off, glm::length(found.curve.point(found.parameters[i]) - data.points[i]));
      largest = std::max(largest, off);
      if (off > tolerance && end - begins[k] > 1) halves.push_back((begins[k] + end) / 2);
    }
    if (largest <= tolerance) return found.curve;
    const int spans = static_cast<int>(begins.size() + halves.size());
    // Jumps that weigh nothing let each piece bend freely.
    const bool is_free = !options.jump_weights.empty() && options.jump_weights[0] == 0;
    const int control_points = (is_free ? 2 : 1) * (spans - 1) + (data.closed ? 1 + is_free : options.degree + 1);
    if (halves.empty() || (control_points > data.size() && options.stiffness == 0))
      throw FieldError("tolerance",
                       fmt::format("not reached: with {} spans a point is still {} away", begins.size(), largest),
                       "a spline_curve goes through all points");
    begins.insert(begins.end(), halves.begin(), halves.end());
    std::sort(begins.begin(), begins.end());
  }
}

TypeDeclaration fit_curve_type() {
  return declare(Category::curve, "fit_curve",
                 "Spline near points by least squares: with so many spans, with given knots, or within a tolerance.")
      .example("points: [[0, 0], [1, 1.2], [2, 0.9], [3, 1.1], [4, 0.2], [5, 0]], spans: 2")
      .field("points", points().count(2), "points that the curve passes by; those of a closed one are not repeated")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(), "periodic curve, smooth over its seam", "false")
      .field("degree", integer().between(1, kMaxDegree), "degree of the polynomial pieces", "3")
      .optional("spans", integer().at_least(1), "number of pieces, with about as many points each")
      .optional("breaks", numbers(), "parameters where pieces meet")
      .optional("tolerance", length().positive(), "largest distance of a point from the curve at its parameter")
      .optional("weights", numbers(), "weight of each squared distance; all 1 when left out")
      .field("stiffness", number().non_negative(),
             "weight of the integral of the squared second derivative beside the sum of squared distances", "0")
      .optional(
          "jump_weights", numbers(),
          "cubic pieces have common tangents alone where they meet; beside the sum of squared distances stand the "
          "squared jumps of the second derivative with this weight: one for all joints, or one for each (closed: "
          "the start first). 0: pieces bend freely; ever larger: as without")
      .field("passes", integer().between(0, 10000), "how often parameters of points move to where the curve is nearest",
             "0")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        const bool closed = f.boolean("closed");
        const std::vector<double> parameters = point_parameters(f.knots("knots"), points, closed);
        const PointSequence data{points, parameters, closed};
        const FitOptions options{f.integer("degree"), f.has("weights") ? f.numbers("weights") : std::vector<double>(),
                                 f.number("stiffness"), f.integer("passes"),
                                 f.has("jump_weights") ? f.numbers("jump_weights") : std::vector<double>()};
        if (f.has("tolerance") && options.jump_weights.size() > 1)
          throw FieldError("jump_weights", "within a tolerance the number of joints is not known before", "one weight");
        const int said = f.has("spans") + f.has("breaks") + f.has("tolerance");
        if (said != 1)
          throw FieldError(said == 0         ? "points"
                           : f.has("breaks") ? "breaks"
                                             : "spans",
                           said == 0 ? "how many pieces the curve has is not said" : "only one of these can be said",
                           "one of spans, breaks, tolerance");
        if (f.has("tolerance")) return fit_within(data, f.number("tolerance"), options);
        if (f.has("spans")) {
          if (closed && f.integer("spans") < 3) throw FieldError("spans", "a closed curve has at least 3 spans");
          return fit_curve(data, even_knots(data, f.integer("spans")), options);
        }
        std::vector<double> breaks = f.numbers("breaks");
        if (closed) breaks.insert(breaks.begin(), parameters.front());
        for (size_t i = 0; i < breaks.size(); ++i)
          if (!(breaks[i] >= parameters.front() && breaks[i] < parameters.back()) ||
              (i > 0 && !(breaks[i] > breaks[i - 1])))
            throw FieldError("breaks", fmt::format("{} is not inside {} to {}, after the one before", breaks[i],
                                                   parameters.front(), parameters.back()));
        return fit_curve(data, breaks, options);
      });
}

}  // namespace lekalo::geometry
