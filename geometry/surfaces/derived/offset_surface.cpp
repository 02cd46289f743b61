// Offset surfaces (Golovanov 2016, 3.15):
//
//   r(u, v) = s(u, v) + d n(u, v),   n = s_u x s_v/|s_u x s_v|
//
// d a constant or a formula of u and v. The offsets of plane, sphere, cylinder and torus at a constant distance are
// surfaces of their kind. n is not smooth at a pole of s, whose offset is built without it.
#include <fmt/format.h>

#include <cmath>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

struct Offset {
  SurfacePtr of;
  std::shared_ptr<const Expression> distance;
  double sign;  // of the normal

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    const Triple<T> n = cross(surface_at(*of, u, v, 1, 0), surface_at(*of, u, v, 0, 1));
    const std::array<T, 2> at{u, v};
    const T d = sign * distance->evaluate(std::span<const T>(at));
    return surface_at(*of, u, v) + (d / length(n)) * n;
  }
};

// The surface of the same kind at a distance, with the same parameters; null where there is none.
std::shared_ptr<Surface> analytic_offset(const Surface& of, double d) {
  if (const auto* sphere = dynamic_cast<const SphereSurface*>(&of); sphere && sphere->radius() + d > 0)
    return std::make_shared<SphereSurface>(sphere->frame(), sphere->radius() + d, sphere->domain());
  if (const auto* torus = dynamic_cast<const TorusSurface*>(&of); torus && torus->minor_radius() + d > 0)
    return std::make_shared<TorusSurface>(torus->frame(), torus->major_radius(), torus->minor_radius() + d,
                                          torus->domain());
  return nullptr;
}

void check_normals(const Surface& of) {
  const DegenerateEdges poles = of.degenerate_edges();
  if (poles.u_min || poles.u_max || poles.v_min || poles.v_max)
    throw FieldError(
        "of",
        fmt::format("the surface has a pole at {}: an offset has no tangents there", poles.u_min   ? "the least u"
                                                                                     : poles.u_max ? "the greatest u"
                                                                                     : poles.v_min ? "the least v"
                                                                                                   : "the greatest v"),
        "give the surface a domain without it");
  const Rectangle domain = of.domain();
  constexpr int kTried = 16;
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const double u = domain.u.lo + domain.u.width() * i / kTried, v = domain.v.lo + domain.v.width() * j / kTried;
      const SurfaceJet jet = of.evaluate(u, v, 1);
      if (!(glm::length(glm::cross(jet.du(), jet.dv())) > 0))
        throw FieldError("of", fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}", u, v),
                         "take a part without that place");
    }
}

}  // namespace

TypeDeclaration offset_surface_type() {
  return declare(Category::surface, "offset_surface",
                 "Surface at a distance from another along its normals, with its parameters. Where the distance is "
                 "beyond a "
                 "radius of curvature it folds over.")
      .example("of: { type: cylinder_surface, radius: 1, height: 2 }, distance: 0.2")
      .field("of", reference({Category::surface}), "the surface; bounded, and with a normal everywhere")
      .field("distance", formula({"u", "v"}), "along the normal; a number, or a formula of the parameters")
      .built_by([](const Fields& f) {
        const SurfacePtr of = f.surface("of");
        if (!of->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
        const auto distance = std::make_shared<const Expression>(f.get<Expression>("distance"));
        std::shared_ptr<Surface> offset;
        if (distance->is_constant())
          offset = analytic_offset(*of, of->normal_sign() * distance->evaluate(std::span<const double>()));
        if (!offset) {
          check_normals(*of);
          offset =
              std::make_shared<ComposedSurface<Offset>>(Offset{of, distance, of->normal_sign()}, properties_of(*of, 1));
        }
        offset->set_reversed(of->reversed());
        return std::any(SurfacePtr(offset));
      });
}

}  // namespace lekalo::geometry
