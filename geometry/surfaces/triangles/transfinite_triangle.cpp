// Surfaces on three curves (Golovanov 2016, 3.10.11), c_1 from p_3 to p_2 (side a = 0), c_2 from p_1 to p_3 (b = 0),
// c_3 from p_2 to p_1 (c = 0), each over 0..1:
//
//   r = a (c_3(1 - b) + c_2(c) - p_1) + b (c_1(1 - c) + c_3(a) - p_2) + c (c_2(1 - a) + c_1(b) - p_3)
//
// It has no quadratic precision: over short arcs it bulges by a third too much. `balanced` takes that off,
//
//   r - 4abc (c_1(1/2) + c_2(1/2) + c_3(1/2) - p_1 - p_2 - p_3)
//
// Curves of polynomials give an exact Bezier triangle (3.17; see triangles/three_curves.h).
#include <fmt/format.h>

#include <array>

#include "geometry/composition.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/surfaces/triangles/three_curves.h"

namespace lekalo::geometry {

namespace {

struct OnThreeCurves {
  std::array<CurvePtr, 3> c;
  std::array<Vec3, 3> p;
  Vec3 correction{0};  // times -4abc

  template <class T>
  Triple<T> at(const std::array<T, 3>& t) const {
    const auto& [a, b, d] = t;
    const auto curve = [&](int k, const T& parameter) { return curve_at(*c[k], parameter); };
    return a * (curve(2, 1.0 - b) + curve(1, d) - triple(p[0])) + b * (curve(0, 1.0 - d) + curve(2, a) - triple(p[1])) +
           d * (curve(1, 1.0 - a) + curve(0, b) - triple(p[2])) - (a * b * d) * triple(4.0 * correction);
  }
};

struct OverSquare {
  OnThreeCurves formula;
  TrianglePole pole;
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    return formula.at(barycentric(pole, u, v));
  }
};

struct OverTriangle {
  OnThreeCurves formula;
  ParameterTriangle triangle;
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    return formula.at(barycentric(triangle, u, v));
  }
};

class TransfiniteTriangle final : public TriangularSurface {
 public:
  TransfiniteTriangle(const OnThreeCurves& formula, const SurfaceProperties& properties,
                      const ParameterTriangle& triangle, TrianglePole pole)
      : TriangularSurface(std::make_shared<ComposedSurface<OverSquare>>(OverSquare{formula, pole}, properties),
                          triangle, pole),
        over_triangle_{formula, triangle} {}
  SurfaceJet evaluate_over_triangle(const Vec2& uv, int order) const override {
    return evaluate_surface_formula(over_triangle_, uv.x, uv.y, order);
  }

 private:
  OverTriangle over_triangle_;
};

// The net where all curves are polynomial Bezier curves.
std::optional<TriangularNet> exact_net(const std::array<CurvePtr, 3>& curves, const Vec3& correction) {
  std::array<std::vector<Vec3>, 3> points;
  for (size_t q = 0; q < 3; ++q) {
    const std::vector<CurvePiece> pieces = curves[q]->pieces();
    if (pieces.size() != 1 || !pieces[0].is_rational() || pieces[0].map.kind != ParameterMap::Kind::affine)
      return std::nullopt;
    for (const Vec4& p : pieces[0].points) {
      if (p.w != 1) return std::nullopt;
      points[q].emplace_back(p);
    }
    if (points[q].size() > static_cast<size_t>(kMaxDegree)) return std::nullopt;
  }
  return net_on_three_curves(points, correction);
}

// Curves meet to this part of their size.
constexpr double kMeeting = 1e-7;

CurvePtr over_unit(const CurvePtr& curve) {
  if (!(curve->domain().width() < kInfinity)) throw FieldError("of", "a curve is unbounded", "give it a domain");
  return curve->domain() == Interval(0, 1) ? curve : with_domain(curve, {0, 1});
}

// The curves in one round: each, turned where needed, begins where the one before ended.
std::array<CurvePtr, 3> in_a_round(const Fields& f) {
  std::vector<CurvePtr> given;
  Box3 box;
  for (const std::any& one : f.references("of")) {
    given.push_back(over_unit(std::any_cast<CurvePtr>(one)));
    box.include(bounds(*given.back()));
  }
  if (given.size() != 3) throw FieldError("of", fmt::format("three curves are needed, not {}", given.size()));
  const double near = kMeeting * box.diameter();
  // The widest gap between the end of a curve and the beginning of the next, of the way round where that is smallest.
  struct Gap {
    double width = kInfinity;
    int behind = 0;
  } smallest;
  for (const int turned : {0, 1, 2, 3, 4, 5, 6, 7}) {
    std::array<CurvePtr, 3> c;
    for (int k = 0; k < 3; ++k) c[k] = turned >> k & 1 ? reversed_curve(given[k]) : given[k];
    Gap widest{0};
    for (int k = 0; k < 3; ++k) {
      const double width = glm::length(c[k]->point(0) - c[(k + 1) % 3]->point(1));
      if (width > widest.width) widest = {width, k};
    }
    if (widest.width <= near) return c;
    if (widest.width < smallest.width) smallest = widest;
  }
  throw FieldError("of",
                   fmt::format("the curves do not meet in three corners: ends of curves {} and {} are {:.6g} apart",
                               smallest.behind, (smallest.behind + 1) % 3, smallest.width),
                   "their ends must coincide in pairs; any direction will do");
}

std::any on_three_curves(const Fields& f) {
  OnThreeCurves formula;
  formula.c = in_a_round(f);
  // c_1 ends at p_2, where c_3 begins, ...
  for (int k = 0; k < 3; ++k) formula.p[k] = formula.c[(k + 1) % 3]->point(0);
  if (f.text("method") == "balanced")
    for (int k = 0; k < 3; ++k) formula.correction += formula.c[k]->point(0.5) - formula.p[k];
  if (const auto net = exact_net(formula.c, formula.correction))
    return std::any(SurfacePtr(std::make_shared<BezierTriangle>(*net, triangle_of(f), pole_of(f))));
  SurfaceProperties properties{{{0, 1}, {0, 1}}, {}, {0, 1}, {0, 1}};
  for (const CurvePtr& curve : formula.c) {
    properties.max_order = std::min(properties.max_order, curve->max_order());
    properties.enclosure_order = std::min(properties.enclosure_order, curve->enclosure_order());
    if (curve->pieces().size() > 1)
      throw FieldError("of", "a curve has several pieces, whose joints would be kinks across the surface",
                       "take curves of one piece: arcs, formulas, Bezier curves");
  }
  return std::any(SurfacePtr(std::make_shared<TransfiniteTriangle>(formula, properties, triangle_of(f), pole_of(f))));
}

}  // namespace

TypeDeclaration transfinite_triangle_type() {
  TypeDeclaration type = declare(Category::surface, "transfinite_triangle",
                                 "Surface on three curves that meet in three corners (Golovanov 2016, 3.10.11). The "
                                 "second and third curve meet in its first corner.");
  type.field("of", references({Category::curve}),
             "three curves of one smooth piece each, in any direction; the first is opposite to the first corner")
      .field("method", choice({"plain", "balanced"}),
             "plain: the sum of three ruled surfaces, which bulges by a third too much on shallow arcs; balanced: with "
             "that taken off, exact for parabolas",
             "plain");
  declare_triangle(type);
  return type
      .example(
          "of: [{ type: segment, from: [0, 0, 1], to: [0, 1, 0] }, { type: bezier_curve, points: [[0, 0, 1], [1, 0, "
          "1], "
          "[1, 0, 0]] }, { type: segment, from: [0, 1, 0], to: [1, 0, 0] }]")
      .built_by(on_three_curves);
}

}  // namespace lekalo::geometry
