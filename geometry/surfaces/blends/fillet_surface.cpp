// Fillets: what a ball that rolls along two surfaces leaves between its contacts (Golovanov 2016, 4.9). Its sections
// are arcs of circles; of other conics with another weight (1 parabolas, below ellipses, above hyperbolas) or two
// radii.
#include "geometry/surfaces/blends/blend_fields.h"
#include "geometry/surfaces/blends/exact_fillet.h"

namespace lekalo::geometry {

namespace {

BlendLaw read_law(const Fields& f) {
  if (f.has("radius") == f.has("chord"))
    throw FieldError(f.has("chord") ? "chord" : "radius", "a fillet has a radius, or a chord instead",
                     "give one of them");
  BlendLaw law;
  if (f.has("chord")) {
    if (f.has("edge")) throw FieldError("chord", "along an edge the radius is given", "give `radius` instead");
    law.kind = BlendKind::chord, law.size_field = "chord";
    law.sizes = {ScalarLaw(f.get<Expression>("chord")), ScalarLaw(f.get<Expression>("chord"))};
    return law;
  }
  law.sizes = blend_sizes(f, "radius");
  if (!f.has("edge")) return law;
  if (f.get<std::vector<Expression>>("radius").size() > 1)
    throw FieldError("radius", "along an edge there is one radius, that on the first surface", "give one");
  law.kind = BlendKind::edge;
  law.guide = f.curve("edge");
  return law;
}

std::any fillet(const Fields& f) {
  SectionShape shape;
  const std::string word = f.word("section");
  shape.weight = word == "circle" ? 0 : word == "parabola" ? 1 : f.number("section");
  shape.is_even = f.boolean("even");
  const bool two_radii = f.has("radius") && f.get<std::vector<Expression>>("radius").size() > 1;
  if (shape.is_even && (shape.weight > 0 || two_radii))
    throw FieldError("even", "only circular sections are run through evenly", "leave it out");
  BlendLaw law = read_law(f);
  const bool is_analytic = f.text("form") == "analytic";
  if (is_analytic && (law.kind != BlendKind::ball || two_radii || shape.weight > 0 || !law.sizes[0].is_constant()))
    throw FieldError("form", "only a ball of constant radius leaves a torus or a cylinder", "leave it out");
  const Contacts contacts = blend_contacts(std::move(law), f);
  if (is_analytic) {
    const auto exact = exact_fillet(contacts);
    if (!exact) throw FieldError("form", "this fillet is no torus and no cylinder", "leave it out");
    return std::any(SurfacePtr(exact));
  }
  return std::any(
      blend_surface(ConicSections{blend_curves(contacts, shape), contacts.law().of, shape.is_even}, contacts));
}

}  // namespace

TypeDeclaration fillet_surface_type() {
  TypeDeclaration type = declare(
      Category::surface, "fillet_surface",
      "Surface that rounds the edge between two surfaces as a ball does that rolls along both. u is the parameter of "
      "the "
      "guide, v runs in 0..1 from the contact with the first to that with the second. It ends where a contact leaves "
      "its surface.");
  type.example("of: [{ type: plane, size: [6, 6] }, { type: cylinder_surface, radius: 1, height: 2 }], radius: 0.4");
  return blend_fields(type)
      .optional("radius", formulas({"s"}, 1, 2),
                "of the ball: a number, a formula of the fraction s of the guide's length, or one for each surface, "
                "which makes ellipses")
      .optional("chord", formula({"s"}), "in place of a radius: the distance of the contacts")
      .optional("edge", reference({Category::curve}),
                "an edge of the second surface: the ball touches the first surface and the edge")
      .field("section", number().positive().or_word({"circle", "parabola"}),
             "a circle (with two radii, an ellipse), or the middle weight of another conic: below 1 an ellipse, 1 a "
             "parabola, above a hyperbola",
             "circle")
      .field("even", boolean(), "v runs evenly with the angle of circular sections", "false")
      .field("form", choice({"sections", "analytic"}),
             "analytic: the torus or cylinder that it is, with the parameters of these (between planes, about a common "
             "axis, and the like); its normal points away from the ball",
             "sections")
      .built_by(fillet);
}

TypeDeclaration chamfer_surface_type() {
  TypeDeclaration type = declare(
      Category::surface, "chamfer_surface",
      "Surface of straight lines that takes off the edge between two surfaces. Legs are measured in the tangent "
      "planes at its borders, from where they meet. u is the parameter of the guide, v runs in 0..1 from the "
      "first surface to the second.");
  type.example("of: [{ type: plane, size: [6, 6] }, { type: cylinder_surface, radius: 1, height: 2 }], legs: 0.4");
  return blend_fields(type)
      .field("legs", formulas({"s"}, 1, 2),
             "their length: a number, a formula of the fraction s of the guide's length, or one for each surface")
      .built_by([](const Fields& f) {
        BlendLaw law;
        law.kind = BlendKind::chamfer, law.size_field = "legs";
        law.sizes = blend_sizes(f, "legs");
        const Contacts contacts = blend_contacts(std::move(law), f);
        return std::any(blend_surface(StraightSections{blend_curves(contacts, {}), contacts.law().of}, contacts));
      });
}

}  // namespace lekalo::geometry
