// Over a span of length h with tension p, u = (t - t_i) / h, M_i = r''(t_i), F = 1 / (2 (p^2 + 3p + 3)):
//
//   r = (1 - u) p_i + u p_{i+1} + h^2 F M_i     ((1 - u)^3 / (1 + p u)     - (1 - u))
//                               + h^2 F M_{i+1} (u^3 / (1 + p (1 - u)) - u)           (Zavyalov et al. 1985, I.6)
//
// r' is continuous where, d being the slopes of the polygon,
//   h_{i-1} F_{i-1} M_{i-1} + (h_{i-1} F_{i-1} (2 + p_{i-1}) + h_i F_i (2 + p_i)) M_i + h_i F_i M_{i+1} = d_i -
//   d_{i-1}.
// Times (1 + p u) (1 + p (1 - u)) / (1 + p) it is of degree 4, with weights 1 at both ends.
#include "geometry/curves/interpolation/tension_spline.h"

#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <cmath>

#include "geometry/curves/interpolation/point_parameters.h"

namespace lekalo::geometry {

namespace {

// Tensions beyond which a span is its chord to eight digits.
constexpr double kLargestTension = 1e8;
// Where monotony of a span is looked at.
constexpr int kPlaces = 32;

double factor(double p) { return 1 / (2 * (p * p + 3 * p + 3)); }

using Ends = TensionEnds;

std::vector<Vec3> second_derivatives(const PointSequence& data, std::span<const double> tensions, const Ends& ends) {
  std::vector<SpanFlexibility> spans;
  for (const double p : tensions) spans.push_back({factor(p) * (2 + p), factor(p)});
  return geometry::second_derivatives(data, spans, ends);
}

// The five homogeneous Bezier points of a span but the last. from, to: the points; c, d: h^2 F M at both ends.
void add_span(const Vec3& from, const Vec3& to, const Vec3& c, const Vec3& d, double p, std::vector<Vec4>& points) {
  // Of the denominator, raised from degree 2 to 4: 1 + p^2 / (1 + p) u (1 - u).
  const double bulge = p * p / (1 + p);
  const double w2[3] = {1, 1 + bulge / 2, 1}, w4[4] = {1, 1 + bulge / 4, 1 + bulge / 3, 1 + bulge / 4};
  // The straight part times the denominator, degree 3.
  const Vec3 a = from - c, b = to - d;
  const Vec3 cubic[4] = {w2[0] * a, (2 * w2[1] * a + w2[0] * b) / 3.0, (w2[2] * a + 2 * w2[1] * b) / 3.0, w2[2] * b};
  const double curved = 1 / (4 * (1 + p));
  const Vec3 numerator[4] = {from, (cubic[0] + 3.0 * cubic[1]) / 4.0 + curved * c, 0.5 * (cubic[1] + cubic[2]),
                             (3.0 * cubic[2] + cubic[3]) / 4.0 + curved * d};
  for (int k = 0; k < 4; ++k) points.emplace_back(numerator[k], w4[k]);
}

void check_tensions(std::span<const double> tensions, int spans) {
  if (static_cast<int>(tensions.size()) != spans)
    throw FieldError("tension", fmt::format("{} spans need {} tensions, not {}", spans, spans, tensions.size()),
                     "one number serves all spans");
  for (size_t i = 0; i < tensions.size(); ++i)
    if (!(tensions[i] >= 0 && tensions[i] <= kLargestTension))
      throw FieldError("tension", fmt::format("the tension {} of span {} is not between 0 and {:g}", tensions[i], i,
                                              kLargestTension));
}

bool same_sign(double a, double b) { return a * b > 0; }

// Spans whose tension must grow for the sake of one coordinate.
void add_misshapen(const PointSequence& data, const std::vector<Vec3>& second, const NurbsCurve& curve,
                   const Ends& ends, int k, std::vector<bool>& misshapen) {
  const int count = data.size(), spans = static_cast<int>(misshapen.size());
  const auto inner = [&](int i) { return data.closed || (i > 0 && i < count - 1); };
  const auto bend = [&](int i) { return inner(i) ? (data.slope(i) - data.slope(i - 1))[k] : 0; };
  const auto moment = [&](int i) { return second[(i + count) % count][k]; };
  for (int i = 0; i < spans; ++i) {
    const bool convex = same_sign(bend(i), bend(i + 1));
    if (convex && (same_sign(moment(i), -bend(i)) || same_sign(moment(i + 1), -bend(i)))) misshapen[i] = true;
    const double slope = data.slope(i)[k];
    const auto goes_on = [&](int node, int span) {
      if (inner(node)) return same_sign(slope, data.slope(span)[k]);
      const std::optional<Vec3>& tangent = node == 0 ? ends.start : ends.end;
      return !tangent || same_sign(slope, (*tangent)[k]);
    };
    if (!goes_on(i, i - 1) || !goes_on(i + 1, i + 1)) continue;
    for (int place = 0; place <= kPlaces; ++place) {
      const double t = data.parameter(i) + data.step(i) * place / kPlaces;
      if (same_sign(curve.evaluate(t, 1).d[1][k], -slope)) misshapen[i] = true;
    }
  }
}

}  // namespace

std::vector<Vec3> second_derivatives(const PointSequence& data, std::span<const SpanFlexibility> flexibilities,
                                     const TensionEnds& ends) {
  const int count = data.size(), spans = data.closed ? count : count - 1;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  const auto add = [&](int row, const Vec3& v) { right.row(row) += Eigen::RowVector3d(v.x, v.y, v.z); };
  const auto is_natural = [&](int i) {
    return !data.closed && ((i == 0 && !ends.start) || (i == count - 1 && !ends.end));
  };
  for (int i = 0; i < spans; ++i) {
    const int next = (i + 1) % count;
    const auto& [near, far] = flexibilities[static_cast<size_t>(i)];
    for (const auto& [row, other, sign] : {std::tuple(i, next, 1.0), std::tuple(next, i, -1.0)}) {
      if (is_natural(row)) continue;
      entries.emplace_back(row, row, data.step(i) * near);
      entries.emplace_back(row, other, data.step(i) * far);
      add(row, sign * data.slope(i));
    }
  }
  if (!data.closed) {
    for (const int end : {0, count - 1})
      if (is_natural(end)) entries.emplace_back(end, end, 1);
    if (ends.start) add(0, -*ends.start);
    if (ends.end) add(count - 1, *ends.end);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixX3d second = Eigen::SparseLU<Eigen::SparseMatrix<double>>(matrix).solve(right);
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) result.emplace_back(second(i, 0), second(i, 1), second(i, 2));
  return result;
}

NurbsCurve tension_spline(const PointSequence& data, std::span<const double> tensions,
                          const std::optional<Vec3>& start_tangent, const std::optional<Vec3>& end_tangent) {
  const int count = data.size(), spans = data.closed ? count : count - 1;
  check_tensions(tensions, spans);
  const std::vector<Vec3> second = second_derivatives(data, tensions, {start_tangent, end_tangent});
  std::vector<Vec4> points;
  for (int i = 0; i < spans; ++i) {
    const double scale = data.step(i) * data.step(i) * factor(tensions[i]);
    add_span(data.point(i), data.point(i + 1), scale * second[i], scale * second[(i + 1) % count], tensions[i], points);
  }
  if (!data.closed) points.emplace_back(data.point(count - 1), 1);
  std::vector<Vec3> places;
  std::vector<double> weights, knots(1, data.closed ? data.parameter(-1) : data.parameter(0));
  for (const Vec4& p : points) places.push_back(Vec3(p) / p.w), weights.push_back(p.w);
  for (int i = 0; i <= spans; ++i) knots.insert(knots.end(), 4, data.parameter(i));
  if (data.closed)
    knots.insert(knots.end(), 4, data.parameter(spans + 1));
  else
    knots.push_back(knots.back());
  return NurbsCurve(SplineAxis(4, std::move(knots), data.closed ? Extension::periodic : Extension::tangent), places,
                    weights);
}

std::vector<double> shape_keeping_tensions(const PointSequence& data, std::vector<double> tensions,
                                           const std::optional<Vec3>& start_tangent,
                                           const std::optional<Vec3>& end_tangent) {
  const int spans = static_cast<int>(tensions.size());
  while (true) {
    const NurbsCurve curve = tension_spline(data, tensions, start_tangent, end_tangent);
    const std::vector<Vec3> second = second_derivatives(data, tensions, {start_tangent, end_tangent});
    std::vector<bool> misshapen(spans, false);
    for (int k = 0; k < 3; ++k) add_misshapen(data, second, curve, {start_tangent, end_tangent}, k, misshapen);
    std::vector<bool> grows(spans, false);
    for (int i = 0; i < spans; ++i)
      for (int j = i - 1; misshapen[i] && j <= i + 1; ++j)
        if (data.closed || (j >= 0 && j < spans)) grows[(j + spans) % spans] = true;
    bool any = false;
    for (int i = 0; i < spans; ++i) {
      if (!grows[i] || tensions[i] >= kLargestTension) continue;
      tensions[i] = std::min(1.3 * tensions[i] + 0.5, kLargestTension);
      any = true;
    }
    if (!any) return tensions;
  }
}

void declare_tension(TypeDeclaration& type) {
  type.field("points", points().count(2), "points of the curve; those of a closed one are not repeated")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(), "smooth over its seam", "false")
      .field("tension", numbers(), "0 or more: one for all spans between points, or one for each", "[0]")
      .optional("start_tangent", vector(), "derivative by t at the first point; without it the second one vanishes")
      .optional("end_tangent", vector(), "derivative by t at the last point; without it the second one vanishes")
      .shows({"knots"});
}

TensionData read_tension(const Fields& f) {
  TensionData data;
  data.points = f.points("points");
  data.closed = f.boolean("closed");
  data.parameters = point_parameters(f.knots("knots"), data.points, data.closed);
  for (const char* field : {"start_tangent", "end_tangent"}) {
    if (!f.has(field)) continue;
    if (data.closed) throw FieldError(field, "a closed curve has no ends");
    (field[0] == 's' ? data.ends.start : data.ends.end) = f.vec3(field);
  }
  data.tensions = f.numbers("tension");
  const size_t spans = data.points.size() - (data.closed ? 0 : 1);
  if (data.tensions.size() == 1) data.tensions.assign(spans, data.tensions[0]);
  check_tensions(data.tensions, static_cast<int>(spans));
  return data;
}

TypeDeclaration tension_spline_type() {
  TypeDeclaration type =
      declare(Category::curve, "tension_spline",
              "Rational spline of class C2 through points, drawn tight from a cubic spline towards their polygon.");
  type.example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]], tension: 3");
  declare_tension(type);
  return type
      .field("keep_shape", boolean(),
             "draws spans tighter until each coordinate is convex and monotone where those of the points are", "false")
      .built_by([](const Fields& f) {
        TensionData data = read_tension(f);
        if (f.boolean("keep_shape"))
          data.tensions = shape_keeping_tensions(data.sequence(), data.tensions, data.ends.start, data.ends.end);
        return tension_spline(data.sequence(), data.tensions, data.ends.start, data.ends.end);
      });
}

}  // namespace lekalo::geometry
