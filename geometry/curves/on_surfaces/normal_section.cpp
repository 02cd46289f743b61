// Normal section of a surface (Golovanov 2016, 3.1): where the plane through a point's normal and a tangent direction d
// cuts it. At the point its curvature is the absolute normal curvature along d, the least of all curves of the surface
// with that tangent (Meusnier).
#include <cmath>

#include "geometry/curves/on_surfaces/branch_choice.h"
#include "geometry/queries/contours/plane_section.h"

namespace lekalo::geometry {

TypeDeclaration normal_section_type() {
  return declare(Category::curve, "normal_section",
                 "Where the plane of a surface's normal and a direction at a point cuts the surface: of several "
                 "branches the one through the point.")
      .example("of: { type: torus_surface, major_radius: 3, minor_radius: 1 }, through: [0, 0], direction: 30 deg")
      .field("of", reference({Category::surface}), "the surface")
      .field("through", numbers().count(2, 2), "parameters u and v of the point")
      .field("direction", angle(), "angle from the u line to the plane, counterclockwise seen from r_u x r_v")
      .built_by([](const Fields& f) {
        const SurfacePtr surface = f.surface("of");
        const double u = f.numbers("through")[0], v = f.numbers("through")[1];
        if (!surface->domain().contains(u, v)) throw FieldError("through", "the point lies outside of the domain");
        const SurfaceJet jet = surface->evaluate(u, v, 1);
        const Vec3 across = glm::cross(jet.du(), jet.dv());
        if (!(glm::length(across) > 1e-14 * glm::length(jet.du()) * glm::length(jet.dv())))
          throw FieldError("through", "the surface has no tangent plane by its parameters at this point",
                           "take a point beside the pole");
        const Vec3 m = glm::normalize(across), x = glm::normalize(jet.du()), y = glm::cross(m, x);
        const double angle = f.number("direction");
        const Vec3 direction = std::cos(angle) * x + std::sin(angle) * y;
        Contours found;
        try {
          found = plane_section(surface, jet.point(), glm::cross(m, direction));
        } catch (const std::invalid_argument& error) {
          throw FieldError("of", error.what());
        }
        if (found.branches.empty())
          throw FieldError("direction", "the plane only touches the surface here", "take a point inside the domain");
        Fields at = f;
        at.set("near", jet.point());
        return std::any(chosen_branch(found.branches, at, "of"));
      });
}

}  // namespace lekalo::geometry
