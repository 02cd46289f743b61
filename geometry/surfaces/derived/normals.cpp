#include "geometry/surfaces/derived/normals.h"

#include <fmt/format.h>

#include "geometry/describe.h"

namespace lekalo::geometry {

void check_normals(const Surface& of, const std::string& field) {
  const DegenerateEdges poles = of.degenerate_edges();
  if (poles.u_min || poles.u_max || poles.v_min || poles.v_max)
    throw FieldError(field,
                     fmt::format("the surface has a pole at {}: what is moved along normals has no tangents there",
                                 poles.u_min   ? "the least u"
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
        throw FieldError(field, fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}", u, v),
                         "take a part without that place");
    }
}

}  // namespace lekalo::geometry
