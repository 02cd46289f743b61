// Curves of a fillet or chamfer (Golovanov 2016, 4.9.2-4.9.4): its contacts, the way of the ball's center, the middle
// curve, in which the tangent planes at the contacts meet, and its weight.
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/blends/sections.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

struct Divided {
  PolynomialPtr point, weight;
  template <class T>
  Triple<T> operator()(const T& t) const {
    return curve_at(*point, t) / curve_at(*weight, t).x;
  }
};

// The point (t, w(t)) of a graph.
struct Graph {
  PolynomialPtr weight;
  template <class T>
  Triple<T> operator()(const T& t) const {
    return {t, curve_at(*weight, t).x, T(0)};
  }
};

template <class Formula>
CurvePtr composed(Formula formula, const Curve& of) {
  return std::make_shared<ComposedCurve<Formula>>(std::move(formula), properties_of(of));
}

CurvePtr curve_of(const BlendCurves& curves, const std::array<SurfacePtr, 2>& of, const std::string& part) {
  if (part == "first") return std::make_shared<SurfaceCurve>(of[0], as_spline(*curves.first_image));
  if (part == "second" && curves.second_image)
    return std::make_shared<SurfaceCurve>(of[1], as_spline(*curves.second_image));
  if (part == "second") return as_spline(*curves.second);
  if (part == "center") return as_spline(*curves.center);
  if (part == "first_image") return as_spline(*curves.first_image);
  if (part == "second_image") {
    if (!curves.second_image)
      throw FieldError("part", "the second contact is an edge", "its image is that of the edge itself");
    return as_spline(*curves.second_image);
  }
  if (!curves.middle)
    throw FieldError("part", "the sections of a chamfer are straight", "take first, second or center");
  if (part == "weight") return composed(Graph{curves.weight}, *curves.weight);
  return composed(Divided{curves.middle, curves.weight}, *curves.middle);
}

// What lies in space moves with a fillet that is moved.
CurvePtr curve_of_surface(const SurfacePtr& of, const std::string& part) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(of.get())) {
    const CurvePtr curve = curve_of_surface(moved->original(), part);
    const bool lies_in_space = part != "weight" && part != "first_image" && part != "second_image";
    return lies_in_space ? transformed(curve, moved->map()) : curve;
  }
  if (const auto* fillet = dynamic_cast<const ComposedSurface<ConicSections>*>(of.get()))
    return curve_of(fillet->formula().curves, fillet->formula().of, part);
  if (const auto* chamfer = dynamic_cast<const ComposedSurface<StraightSections>*>(of.get()))
    return curve_of(chamfer->formula().curves, chamfer->formula().of, part);
  throw FieldError("of", "the surface is no fillet and no chamfer", "name a fillet_surface or chamfer_surface");
}

}  // namespace

TypeDeclaration blend_curve_type() {
  return declare(Category::curve, "blend_curve",
                 "A curve from which a fillet or chamfer is made, with its parameter u.")
      .example(
          "of: { type: fillet_surface, of: [{ type: plane, size: [6, 6] }, { type: cylinder_surface, radius: 1, "
          "height: "
          "2 }], radius: 0.4 }")
      .field("of", reference({Category::surface}), "a fillet_surface or chamfer_surface")
      .field("part", choice({"first", "second", "center", "middle", "weight", "first_image", "second_image"}),
             "the contact with the first or second surface, a curve on it; the way of the ball's center (of a chamfer: "
             "where the tangent planes meet); the middle curve, where the tangent planes at the contacts meet; the "
             "weight of the middle curve, as a graph (u, weight); the contacts in the parameter planes of the surfaces",
             "first")
      .built_by([](const Fields& f) { return std::any(curve_of_surface(f.surface("of"), f.text("part"))); });
}

}  // namespace lekalo::geometry
