#include "geometry/surfaces/splines/nurbs_surface.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/rational.h"
#include "geometry/curves/splines/rational_enclosure.h"
#include "geometry/curves/splines/weights.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

NurbsSurface::NurbsSurface(SplineAxis u, SplineAxis v, std::span<const Vec3> points, std::span<const double> weights)
    : u_(std::move(u)), v_(std::move(v)) {
  const size_t rows = u_.distinct(), columns = v_.distinct();
  if (points.size() != rows * columns)
    throw FieldError("points",
                     fmt::format("the knots ask for {} x {} points, not {} in all", rows, columns, points.size()));
  const std::vector<Vec4> net = homogeneous(points, weights);
  form_ = {u_.degree(), v_.degree(), u_.knots(), v_.knots(), {}, {}, {}};
  form_.points.reserve(static_cast<size_t>(u_.count()) * v_.count());
  for (int i = 0; i < u_.count(); ++i)
    for (int j = 0; j < v_.count(); ++j) form_.points.push_back(net[(i % rows) * columns + j % columns]);
  finish();
}

NurbsSurface::NurbsSurface(const NurbsSurfaceForm& form)
    : u_(form.degree_u, form.knots_u, Extension::tangent), v_(form.degree_v, form.knots_v, Extension::tangent) {
  form_ = {u_.degree(), v_.degree(), u_.knots(), v_.knots(), form.points, {}, {}};
  if (form_.points.size() != static_cast<size_t>(u_.count()) * v_.count())
    throw FieldError("points", fmt::format("the knots ask for {} x {} points, not {} in all", u_.count(), v_.count(),
                                           form_.points.size()));
  finish();
}

void NurbsSurface::finish() {
  rational_ = has_weights(form_.points);
  if (!all_weights_positive(form_.points))
    for (const SurfacePiece& piece : bezier_pieces(form_, form_.domain()))
      if (!denominator_positive(piece.degree_u, piece.degree_v, piece.points))
        throw FieldError(
            "weights",
            fmt::format("the denominator vanishes in u {}..{}, v {}..{}: the surface goes through infinity",
                        piece.domain.u.lo, piece.domain.u.hi, piece.domain.v.lo, piece.domain.v.hi),
            "positive weights are always safe");
  degenerate_ = collapsed_edges(form_, domain());
}

namespace {

// Room for one order more than surfaces promise: tangent continuation across one edge differentiates once more.
constexpr int kInnerOrder = kMaxSurfaceOrder + 1;
constexpr int kInnerCount = (kInnerOrder + 1) * (kInnerOrder + 2) / 2;

// SpanBasis::derivatives in whole registers, the same numbers; the degree may be known.
template <int kDegree>
inline void derivatives(const SpanBasis& basis, Lanes* points, int order, Lanes* result) {
  const int degree = kDegree > 0 ? kDegree : basis.degree;
  for (int k = 0; k <= order; ++k) {
    Lanes sum{};
    for (int m = 0; m <= degree - k; ++m) {
      if (k > 0) points[m] = basis.factors[k][m] * (points[m + 1] - points[m]);
      sum += basis.values[k][m] * points[m];
    }
    result[k] = sum;
  }
}

// All homogeneous derivatives of total order up to `order` of one span pair: along v in each row of control points,
// then along u over the rows' results.
template <int kDegreeU, int kDegreeV>
inline void tensor_sums(const Vec4* row, size_t stride, const SpanBasis& bu, const SpanBasis& bv, int order,
                        Vec4* sums) {
  const int p = kDegreeU > 0 ? kDegreeU : bu.degree, q = kDegreeV > 0 ? kDegreeV : bv.degree;
  Lanes columns[kInnerOrder + 1][kMaxDegree + 1];  // [derivative by v][row]
  Lanes points[kMaxDegree + 1], results[kInnerOrder + 1];
  for (int i = 0; i <= p; ++i, row += stride) {
    for (int j = 0; j <= q; ++j) load(row[j], points[j]);
    derivatives<kDegreeV>(bv, points, order, results);
    for (int dv = 0; dv <= order; ++dv) columns[dv][i] = results[dv];
  }
  for (int dv = 0; dv <= order; ++dv) {
    derivatives<kDegreeU>(bu, columns[dv], order - dv, results);
    for (int du = 0; du + dv <= order; ++du) store(results[du], sums[SurfaceJet::index(du, dv)]);
  }
}

LEKALO_WIDE void tensor_sums(const NurbsSurfaceForm& form, int span_u, int span_v, const SpanBasis& bu,
                             const SpanBasis& bv, int order, Vec4* sums) {
  const size_t stride = form.count_v();
  const Vec4* row = form.points.data() + (span_u - form.degree_u) * stride + (span_v - form.degree_v);
  // Loops of known length for what most models have, and rays ask for at every hit.
  if (bu.degree == 3 && bv.degree == 3) switch (order) {
      case 1:
        return tensor_sums<3, 3>(row, stride, bu, bv, 1, sums);
      case 2:
        return tensor_sums<3, 3>(row, stride, bu, bv, 2, sums);
      case 3:
        return tensor_sums<3, 3>(row, stride, bu, bv, 3, sums);
      default:
        break;
    }
  if (bv.degree == 3 && order == 1) return tensor_sums<0, 3>(row, stride, bu, bv, 1, sums);
  if (bv.degree == 2 && order == 1) return tensor_sums<0, 2>(row, stride, bu, bv, 1, sums);
  tensor_sums<0, 0>(row, stride, bu, bv, order, sums);
}

// r continues along its tangents, `beyond` in each direction: d(i, j) of the continued surface from those at the edge.
void continue_along_tangents(const Vec3* r, double beyond_u, double beyond_v, SurfaceJet& jet) {
  const auto at = [r](int i, int j) { return r[SurfaceJet::index(i, j)]; };
  for (int n = 0; n <= jet.order; ++n)
    for (int j = 0; j <= n; ++j) {
      const int i = n - j;
      if ((beyond_u != 0 && i > 1) || (beyond_v != 0 && j > 1)) {
        jet.d(i, j) = Vec3(0);
        continue;
      }
      Vec3 value = at(i, j);
      const bool add_u = beyond_u != 0 && i == 0, add_v = beyond_v != 0 && j == 0;
      if (add_u) value += beyond_u * at(i + 1, j);
      if (add_v) value += beyond_v * at(i, j + 1);
      if (add_u && add_v) value += beyond_u * beyond_v * at(i + 1, j + 1);
      jet.d(i, j) = value;
    }
}

}  // namespace

SurfaceJet NurbsSurface::evaluate(double u, double v, int order) const {
  const SplineAxis::Place pu = u_.place(u), pv = v_.place(v);
  const bool outside = pu.beyond != 0 || pv.beyond != 0;
  // Beyond a corner only d(0..1, 0..1) are needed, beyond an edge one order more.
  const int evaluated = !outside ? order : std::max(2, order + 1);
  const SpanBasis bu = span_basis(u_.degree(), u_.knots(), pu.span, pu.t, evaluated);
  const SpanBasis bv = span_basis(v_.degree(), v_.knots(), pv.span, pv.t, evaluated);
  Vec4 sums[kInnerCount];
  tensor_sums(form_, pu.span, pv.span, bu, bv, evaluated, sums);

  SurfaceJet jet(order);
  if (!outside && !rational_) {
    for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k) jet.values[k] = Vec3(sums[k]);
  } else if (!outside) {
    divide_by_weight_2d(sums, order, jet.values.data());
  } else {
    Vec3 r[kInnerCount];
    divide_by_weight_2d(sums, evaluated, r);
    continue_along_tangents(r, pu.beyond, pv.beyond, jet);
  }
  return jet;
}

SurfaceEnclosure NurbsSurface::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure result;
  const auto part = [](const std::vector<double>& knots, int span, const Interval& t) {
    return Interval{std::clamp(t.lo, knots[span], knots[span + 1]), std::clamp(t.hi, knots[span], knots[span + 1])};
  };
  const std::vector<int> spans_v = v_.spans_over(box.v);
  for (const int span_u : u_.spans_over(box.u))
    for (const int span_v : spans_v)
      enclose_spans(form_, span_u, span_v, rational_,
                    {part(form_.knots_u, span_u, box.u), part(form_.knots_v, span_v, box.v)}, order, result);
  return result;
}

std::vector<double> weights_of_net(const Fields& f) {
  if (!f.has("weights")) return {};
  const Grid<double>& weights = f.number_grid("weights");
  const Grid<Vec3>& net = f.net("points");
  if (weights.rows != net.rows || weights.columns != net.columns)
    throw FieldError(
        "weights",
        fmt::format("{} x {} weights do not fit {} x {} points", weights.rows, weights.columns, net.rows, net.columns),
        "weights are written in the same rows as points");
  return weights.values;
}

DegenerateEdges collapsed_edges(const NurbsSurfaceForm& form, const Rectangle& domain) {
  const auto cartesian = [](const Vec4& p) { return Vec3(p) / p.w; };
  double size = 0;  // of the net, about its first point
  for (const Vec4& p : form.points) size = std::max(size, glm::length(cartesian(p) - cartesian(form.points[0])));

  // The Bezier points along one edge, from the strip of patches beside it.
  const auto is_point = [&](const Rectangle& strip, bool along_v, bool at_end) {
    Box3 box;
    for (const SurfacePiece& piece : bezier_pieces(form, strip)) {
      const int p = piece.degree_u, q = piece.degree_v;
      for (int k = 0; k <= (along_v ? q : p); ++k) {
        const int i = along_v ? (at_end ? p : 0) : k;
        const int j = along_v ? k : (at_end ? q : 0);
        box.include(cartesian(piece.points[i * (q + 1) + j]));
      }
    }
    return box.diameter() <= kCollapsedEdge * size;
  };
  const auto first_span = [](const std::vector<double>& knots, const Interval& t) {
    return Interval{t.lo, std::min(t.hi, *std::upper_bound(knots.begin(), knots.end(), t.lo))};
  };
  const auto last_span = [](const std::vector<double>& knots, const Interval& t) {
    return Interval{std::max(t.lo, *(std::lower_bound(knots.begin(), knots.end(), t.hi) - 1)), t.hi};
  };
  const auto& [u, v] = domain;
  return {
      is_point({first_span(form.knots_u, u), v}, true, false), is_point({last_span(form.knots_u, u), v}, true, true),
      is_point({u, first_span(form.knots_v, v)}, false, false), is_point({u, last_span(form.knots_v, v)}, false, true)};
}

namespace {

// Mean distances of neighbouring rows (u) and columns (v) of a net, for knots by chord length.
std::vector<double> mean_steps(const Grid<Vec3>& net, bool along_u, bool closed) {
  const int count = along_u ? net.rows : net.columns, lines = along_u ? net.columns : net.rows;
  std::vector<double> steps(count - (closed ? 0 : 1), 0.0);
  for (int line = 0; line < lines; ++line) {
    std::vector<Vec3> polygon;
    for (int k = 0; k < count; ++k) polygon.push_back(along_u ? net.at(k, line) : net.at(line, k));
    const std::vector<double> sides = polygon_steps(polygon, closed);
    for (size_t k = 0; k < sides.size(); ++k) steps[k] += sides[k] / lines;
  }
  return steps;
}

SplineAxis axis_of(const Fields& f, bool along_u) {
  const Grid<Vec3>& net = f.net("points");
  const auto knots = along_u ? f.u<Knots>("knots") : f.v<Knots>("knots");
  const int degree = along_u ? f.u<int>("degree") : f.v<int>("degree");
  const bool closed = along_u ? f.u<bool>("closed") : f.v<bool>("closed");
  try {
    SplineAxis axis =
        make_axis(degree, knots, closed, along_u ? net.rows : net.columns, mean_steps(net, along_u, closed));
    if (f.has("domain")) axis.restrict_to(along_u ? f.rectangle("domain").u : f.rectangle("domain").v);
    return axis;
  } catch (const FieldError& error) {
    const std::string field = error.field + (error.field == "points" ? "" : along_u ? ".u" : ".v");
    throw FieldError(field, fmt::format("in direction {}: {}", along_u ? 'u' : 'v', error.what()), error.hint);
  }
}

}  // namespace

TypeDeclaration nurbs_surface_type() {
  return declare(Category::surface, "nurbs_surface",
                 "Rational B-spline surface of any degrees, open or closed in each direction.")
      .example("degree: 1, points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]]")
      .field("points", net(), "control points: points[i][j], i runs with u, j with v; not repeated where closed")
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "degree of the polynomial pieces", "3")
      .field(
          "knots", knots().for_each_direction(),
          "the full knot vector (points + degree + 1 numbers; points + 2 degree + 1 when closed), or a rule: clamped "
          "(integers), uniform, chord_length, centripetal",
          "clamped")
      .optional("weights", number_grid(), "one weight for each point, in the same rows; all 1 when left out")
      .field("closed", boolean().for_each_direction(), "periodic, smooth over the seam", "false")
      .optional("domain", rectangle(), "part of the surface, in the knots' parameters; over the seam too when closed")
      .shows({"control_net", "knots"})
      .built_by([](const Fields& f) {
        SplineAxis u = axis_of(f, true), v = axis_of(f, false);
        return NurbsSurface(std::move(u), std::move(v), f.net("points").values, weights_of_net(f));
      });
}

}  // namespace lekalo::geometry
