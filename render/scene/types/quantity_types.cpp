// Numbers measured of the scene's geometry, for parameters: distance, angle and scalar product (the functions DIST,
// ANGLE and SCAL of Zavyalov et al. 1985, VII.2), lengths, areas, volumes, curvatures and feet.
#include "render/scene/types/quantity.h"

#include <any>
#include <cmath>

#include "geometry/body.h"
#include "geometry/curve.h"
#include "geometry/describe.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surface.h"

namespace lekalo::render {

using namespace geometry;

namespace {

Distant distant(const std::any& thing) {
  if (const auto* curve = std::any_cast<CurvePtr>(&thing)) return curve->get();
  if (const auto* surface = std::any_cast<SurfacePtr>(&thing)) return surface->get();
  if (const auto* body = std::any_cast<BodyPtr>(&thing)) return body->get();
  return std::any_cast<const Vec3&>(thing);
}

TypeDeclaration distance_type() {
  const FieldType thing = reference({Category::point, Category::curve, Category::surface, Category::body});
  return declare(Category::quantity, "distance",
                 "Shortest distance of two points, curves, surfaces or bodies; 0 where they meet.")
      .field("from", thing, "one of them")
      .field("to", thing, "the other")
      .example("from: [1, 2, 3], to: { type: circle, radius: 1 }")
      .built_by([](const Fields& f) {
        const Distant a = distant(f.any("from")), b = distant(f.any("to"));
        return MeasuredQuantity{distance(a, b, DistanceMinima::nearest).distance};
      });
}

TypeDeclaration angle_between_type() {
  return declare(Category::quantity, "angle_between", "Angle of two vectors, between 0 and half a turn.")
      .field("from", direction(), "the first vector, of any length")
      .field("to", direction(), "the second vector, of any length")
      .example("from: x, to: [1, 1, 0]")
      .built_by([](const Fields& f) {
        const Vec3 a = f.vec3("from"), b = f.vec3("to");
        return MeasuredQuantity{std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)), Measure::angle};
      });
}

TypeDeclaration scalar_product_type() {
  return declare(Category::quantity, "scalar_product",
                 "Scalar product of two vectors; with an axis x, y or z a coordinate of the other.")
      .field("first", vector(), "the first vector")
      .field("second", vector(), "the second vector")
      .example("first: [1, 2, 3], second: z")
      .built_by([](const Fields& f) { return MeasuredQuantity{glm::dot(f.vec3("first"), f.vec3("second"))}; });
}

TypeDeclaration arc_length_type() {
  return declare(Category::quantity, "arc_length", "Length of a curve, or of a part of it.")
      .field("of", reference({Category::curve}), "the curve")
      .optional("from", number(), "parameter where the part begins; the curve's beginning by default")
      .optional("to", number(), "parameter where the part ends; the curve's end by default")
      .example("of: { type: circle, radius: 1 }")
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        if (!f.has("from") && !f.has("to")) return MeasuredQuantity{measure(*curve).length.value};
        const Interval domain = curve->domain();
        const double from = f.has("from") ? f.number("from") : domain.lo, to = f.has("to") ? f.number("to") : domain.hi;
        const double length = std::abs(arc_length(*curve, from, to).value);
        if (!std::isfinite(length)) throw FieldError("of", "the length of this part cannot be told");
        return MeasuredQuantity{length};
      });
}

TypeDeclaration area_type() {
  return declare(Category::quantity, "surface_area", "Area of a surface, or of the whole surface of a body.")
      .field("of", reference({Category::surface, Category::body}), "the surface or body")
      .example("of: { type: sphere_surface, radius: 1 }")
      .built_by([](const Fields& f) {
        if (f.holds<SurfacePtr>("of")) return MeasuredQuantity{measure(*f.surface("of")).area.value};
        return MeasuredQuantity{measure(*f.body("of")).area.value};
      });
}

TypeDeclaration volume_type() {
  return declare(Category::quantity, "volume", "Volume of a body.")
      .field("of", reference({Category::body}), "the body")
      .example("of: { type: ball, radius: 1 }")
      .built_by([](const Fields& f) {
        const MassProperties found = measure(*f.body("of"));
        if (!found.closed) throw FieldError("of", "this body has free borders: it has no volume");
        return MeasuredQuantity{found.volume.value};
      });
}

TypeDeclaration curvature_type() {
  return declare(Category::quantity, "curvature", "Curvature of a curve at a parameter.")
      .field("of", reference({Category::curve}), "the curve")
      .field("t", number(), "the parameter")
      .example("of: { type: circle, radius: 2 }, t: 0")
      .built_by([](const Fields& f) {
        const double found = curvature(*f.curve("of"), f.number("t")).curvature;
        if (!std::isfinite(found)) throw FieldError("t", "the curve has no finite curvature there");
        return MeasuredQuantity{found};
      });
}

TypeDeclaration closest_parameter_type() {
  return declare(Category::quantity, "closest_parameter", "Parameter of a curve's point that is nearest to a point.")
      .field("of", reference({Category::curve}), "the curve")
      .field("to", point(), "the point")
      .example("of: { type: segment, from: [0, 0], to: [2, 0] }, to: [1, 1]")
      .built_by([](const Fields& f) {
        const CurveFootPoints found = project(f.vec3("to"), *f.curve("of"));
        if (found.foot_points.empty()) throw FieldError("of", "no foot was found: its formulas have no finite bounds");
        return MeasuredQuantity{found.foot_points.front().t};
      });
}

TypeDeclaration attribute_type() {
  return declare(Category::quantity, "attribute",
                 "An attribute of an element, its own or one that it inherits: of a face that of its body.")
      .field("of", reference({Category::surface, Category::curve, Category::body, Category::mesh, Category::shape}),
             "name of the element, or conditions: a face, unless they speak of an edge")
      .field("name", text(), "of the attribute: density, temperature, ...")
      .example("of: my_body, name: temperature")
      .built_by([](const Fields& f) {
        return QuantityOfElement{f.text("name"), {}};
      });
}

TypeDeclaration mass_type() {
  return declare(Category::quantity, "mass",
                 "Mass of a body in kilograms: its volume times its attribute `density`; without info.unit a scene "
                 "unit is a metre.")
      .field("of", reference({Category::body}), "name of the body")
      .example("of: my_body")
      .built_by([](const Fields& f) {
        const BodyPtr body = f.body("of");
        if (!body->is_closed()) throw FieldError("of", "this body has free borders: it has no volume");
        return QuantityOfElement{"density", body};
      });
}

}  // namespace

std::vector<TypeDeclaration> quantity_types() {
  return {distance_type(), angle_between_type(), scalar_product_type(),    arc_length_type(), area_type(),
          volume_type(),   curvature_type(),     closest_parameter_type(), attribute_type(),  mass_type()};
}

}  // namespace lekalo::render
