// Surfaces on a family of curves (Golovanov 2016, 3.4) and the translational surface (3.3.1), as Boolean sums of one
// family, or of two with functions 1:
//
//   ruled    (1 - v) c_0(u) + v c_1(u);   sector: c_1 is a point
//   lofts    sum B_i(v) c_i(u), B_i those of Lagrange, Hermite's cubic, C2 cubic splines, Bernstein or B-splines
//   shifted  c(u) + g(v) - g(v_min)
//
// and, with weights that are functions of u, the quotient sum B_i(v) w_i(u) c_i(u) / sum B_i(v) w_i(u) (3.4.5, 3.4.7).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/spline_axis.h"
#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/surfaces/nets/boolean_sum.h"
#include "geometry/surfaces/nets/curve_family.h"
#include "geometry/surfaces/nets/lofts.h"

namespace lekalo::geometry {

namespace {

CurvePtr constant(const Vec3& point, const Interval& range) {
  return std::make_shared<NurbsCurve>(
      NurbsCurveForm{1, {range.lo, range.lo, range.hi, range.hi}, {Vec4(point, 1), Vec4(point, 1)}, {}});
}

Interval common_domain(const std::vector<CurvePtr>& curves) { return curves.front()->domain(); }

// Control curves with weights that are functions of u.
struct WeightedFamily {
  Family family;
  std::shared_ptr<const std::vector<Expression>> weights;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    Triple<T> sum{T(0), T(0), T(0)};
    T whole(0);
    for (size_t i = 0; i < family.curves.size(); ++i) {
      const T weight = curve_at(*family.functions[i], v).x * (*weights)[i].evaluate(std::span<const T>(&u, 1));
      sum += weight * curve_at(*family.curves[i], u);
      whole += weight;
    }
    return (T(1) / whole) * sum;
  }
};

std::vector<Expression> read_weights(const Fields& f, const std::vector<CurvePtr>& curves) {
  const auto& weights = f.get<std::vector<Expression>>("weight_functions");
  if (weights.size() != curves.size())
    throw FieldError("weight_functions", fmt::format("{} weights for {} curves", weights.size(), curves.size()));
  constexpr int kTried = 256;
  const Interval range = common_domain(curves);
  for (size_t i = 0; i < weights.size(); ++i) {
    if (weights[i].smoothness() != Expression::Smoothness::smooth)
      throw FieldError("weight_functions", fmt::format("weight {} has kinks or jumps", i), "smooth functions");
    for (int k = 0; k <= kTried; ++k) {
      const double u = range.clamp(range.lo + range.width() * k / kTried), w = weights[i](u);
      if (!(w > 0 && w < kInfinity))
        throw FieldError("weight_functions", fmt::format("weight {} is {:.6g} at u = {:.6g}, not positive", i, w, u));
    }
  }
  return weights;
}

SurfacePtr weighted_loft(Family family, std::vector<Expression> weights, const Interval& range_v, Periods periods) {
  const Interval range = common_domain(family.curves);
  for (const Expression& weight : weights)
    if (std::abs(weight(range.lo) - weight(range.hi)) > 1e-12 * weight(range.lo)) periods.u = 0;
  SurfaceProperties properties = properties_along_u(*family.curves.front(), range_v);
  for (const CurvePtr& curve : family.curves) add_operand(properties, *curve, Along::u);
  for (const CurvePtr& function : family.functions) add_operand(properties, *function, Along::v);
  properties.periods = periods;
  return std::make_shared<ComposedSurface<WeightedFamily>>(
      WeightedFamily{std::move(family), std::make_shared<const std::vector<Expression>>(std::move(weights))},
      std::move(properties));
}

}  // namespace

SurfacePtr ruled_surface(const CurvePtr& first, const CurvePtr& second) {
  BooleanSum sum;
  sum.along_u = {{first, second}, lagrange_functions({0, 1})};
  return std::make_shared<BlendedSurface>(
      blended_surface(std::move(sum), {first->domain(), {0, 1}}, {common_period({first, second}), 0}));
}

SurfacePtr translation_surface(const CurvePtr& c, const CurvePtr& g) {
  BooleanSum sum;
  sum.along_u = {{c}, {one_function(g->domain())}};
  sum.along_v = {{g}, {one_function(c->domain())}};
  sum.points = {{g->point(g->domain().lo)}};
  return std::make_shared<BlendedSurface>(
      blended_surface(std::move(sum), {c->domain(), g->domain()}, {c->period(), g->period()}));
}

SurfacePtr loft_surface(const Fields& f, const std::vector<CurvePtr>& curves) {
  const std::string& method = f.text("method");
  const bool closed = f.boolean("closed");
  const int count = static_cast<int>(curves.size());
  const bool through = method == "hermite" || method == "spline" || method == "lagrange";
  if (closed && method == "lagrange")
    throw FieldError("closed", "Lagrange's polynomials do not close", "method: hermite, spline or b_spline");
  if (closed && count < 3) throw FieldError("of", "a closed surface needs three curves at least");
  if (f.has("at_v") && !through)
    throw FieldError("at_v", fmt::format("the surface does not go through its curves with method: {}", method),
                     "give 'knots', or method: hermite, spline or lagrange");
  for (const char* field : {"weights", "weight_functions"})
    if (f.has(field) && through) throw FieldError(field, "weights are of methods bezier and b_spline");
  if (f.has("weights") && f.has("weight_functions"))
    throw FieldError("weight_functions", "the weights are given twice",
                     "numbers are functions too: leave 'weights' out");
  BooleanSum sum;
  sum.along_u.curves = curves;
  Periods periods{common_period(curves), 0};
  if (through) {
    const std::vector<double> nodes = read_nodes(f, "at_v", curves, closed);
    sum.along_u.functions = method == "lagrange" ? lagrange_functions(nodes)
                            : method == "spline" ? spline_functions(nodes, closed)
                                                 : hermite_functions(nodes, closed);
    if (closed) periods.v = nodes.back() - nodes.front();
    return std::make_shared<BlendedSurface>(
        blended_surface(std::move(sum), {common_domain(curves), {nodes.front(), nodes.back()}}, periods));
  }
  const std::vector<double> weights = f.has("weights") ? f.numbers("weights") : std::vector<double>();
  if (!weights.empty() && static_cast<int>(weights.size()) != count)
    throw FieldError("weights", fmt::format("{} weights for {} curves", weights.size(), count));
  for (const double w : weights)
    if (!(w > 0)) throw FieldError("weights", "the weights must be positive");
  if (method == "bezier" && (closed || f.given("degree") || f.given("knots")))
    throw FieldError("method", "a Bezier surface has neither 'degree' nor 'knots' and does not close",
                     "method: b_spline");
  const int degree = method == "bezier" ? count - 1 : std::min(f.integer("degree"), count - (closed ? 0 : 1));
  const SplineAxis axis = make_axis(degree, method == "bezier" ? Knots{"clamped", {}} : f.knots("knots"), closed, count,
                                    steps_between(curves, closed));
  sum.along_u.functions = b_spline_functions(degree, axis.knots(), weights, count);
  periods.v = axis.period();
  if (f.has("weight_functions"))
    return weighted_loft(std::move(sum.along_u), read_weights(f, curves), axis.domain(), periods);
  return std::make_shared<BlendedSurface>(
      blended_surface(std::move(sum), {common_domain(curves), axis.domain()}, periods));
}

TypeDeclaration ruled_surface_type() {
  return declare(
             Category::surface, "ruled_surface",
             "Straight lines between points of two curves with the same share of their parameters, or of their "
             "lengths. u is the first curve's parameter where both have one domain, else 0..1; v runs from 0 at the "
             "first to 1 at the second.")
      .example("of: [{ type: circle, radius: 1 }, { type: circle, radius: 1, center: [0, 0, 2] }]")
      .field("of", references({Category::curve}), "the two curves")
      .field("match", choice({"parameter", "arc_length"}), "which points belong together", "parameter")
      .built_by([](const Fields& f) {
        const std::vector<CurvePtr> curves = read_family(f, "of");
        if (curves.size() != 2)
          throw FieldError("of", fmt::format("a ruled surface has two curves, not {}", curves.size()),
                           "loft_surface takes more");
        return std::any(ruled_surface(curves[0], curves[1]));
      });
}

TypeDeclaration sector_surface_type() {
  return declare(Category::surface, "sector_surface",
                 "Straight lines from the points of a curve to one point: a cone over any curve. u is the curve's "
                 "parameter, v runs from 0 at the curve to 1 at the point.")
      .example("of: { type: circle, radius: 1 }, apex: [0, 0, 2]")
      .field("of", reference({Category::curve}), "the curve")
      .field("apex", point(), "where the lines meet")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        if (!(curve->domain().width() < kInfinity))
          throw FieldError("of", "the curve is unbounded", "give it a domain");
        BooleanSum sum;
        sum.along_u = {{curve, constant(f.vec3("apex"), curve->domain())}, lagrange_functions({0, 1})};
        return std::any(SurfacePtr(std::make_shared<BlendedSurface>(
            blended_surface(std::move(sum), {curve->domain(), {0, 1}}, {curve->period(), 0}))));
      });
}

TypeDeclaration translation_surface_type() {
  return declare(Category::surface, "translation_surface",
                 "What a curve sweeps when it is moved parallel to itself along another, from that one's beginning: "
                 "c(u) + g(v) - g(v_min).")
      .example(
          "of: { type: circle, radius: 1 }, along: { type: bezier_curve, points: [[0, 0, 0], [1, 0, 1], [0, 0, 2]] }")
      .field("of", reference({Category::curve}), "the curve that is moved; its parameter is u")
      .field("along", reference({Category::curve}), "the curve along which; its parameter is v")
      .built_by([](const Fields& f) {
        const CurvePtr c = f.curve("of"), g = f.curve("along");
        for (const auto& [curve, field] : {std::pair(c, "of"), std::pair(g, "along")})
          if (!(curve->domain().width() < kInfinity))
            throw FieldError(field, "the curve is unbounded", "give it a domain");
        return std::any(translation_surface(c, g));
      });
}

void declare_loft(TypeDeclaration& type) {
  type.field("method", choice({"hermite", "spline", "lagrange", "bezier", "b_spline"}), "how they are joined",
             "hermite")
      .optional(
          "at_v", numbers(),
          "increasing values of v at the curves (one more than curves when closed); else by their mean distances, 0..1")
      .field("closed", boolean(), "the first curve follows the last, smoothly", "false")
      .field("match", choice({"parameter", "arc_length"}), "which points of the curves belong together", "parameter")
      .field("degree", integer().between(1, 9), "in v, of method b_spline", "3")
      .field("knots", knots(), "of method b_spline: as of nurbs_curve", "clamped")
      .optional("weights", numbers(), "of methods bezier and b_spline: one for each curve")
      .optional("weight_functions", formulas({"u"}, 2, 1000),
                "of methods bezier and b_spline: for each curve a positive, smooth function of u");
}

TypeDeclaration loft_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "loft_surface",
              "Surface on a family of curves. Methods hermite (cubic, tangents from three neighbours), spline (cubic, "
              "second derivatives continuous) and lagrange (one polynomial: it oscillates over many curves) go "
              "through the curves at the values at_v; bezier and b_spline have them for control curves.")
          .example(
              "of: [{ type: circle, radius: 1 }, { type: circle, radius: 2, center: [0, 0, 1] }, "
              "{ type: circle, radius: 1, center: [0, 0, 2] }]")
          .field("of", references({Category::curve}), "the curves in their order; all run the same way");
  declare_loft(type);
  type.built_by([](const Fields& f) { return std::any(loft_surface(f, read_family(f, "of"))); });
  return type;
}

}  // namespace lekalo::geometry
