// What fillets and chamfers ask of a scene: two surfaces, the sides on which they lie, the guide.
#pragma once

#include "geometry/describe.h"
#include "geometry/surfaces/blends/sections.h"

namespace lekalo::geometry {

// The fields of, sides, guide, branch, near.
TypeDeclaration& blend_fields(TypeDeclaration& type);
// A field of one size, or one for each surface, as formulas of s.
std::array<ScalarLaw, 2> blend_sizes(const Fields& f, const char* field);
// The contacts of the law, whose kind, sizes and, of an edge, guide are set; the rest is read here.
Contacts blend_contacts(BlendLaw law, const Fields& f);

// A surface of such sections; closed along a closed guide.
template <class Sections>
SurfacePtr blend_surface(Sections sections, const Contacts& contacts) {
  SurfaceProperties properties = blend_properties(contacts, sections.curves);
  auto surface = std::make_shared<ComposedSurface<Sections>>(std::move(sections), std::move(properties));
  const double period = contacts.law().period;
  if (period > 0 && contacts.domain().width() >= period * (1 - 1e-12) && is_closed_along(*surface, Along::u))
    surface->close(Along::u, period);
  return surface;
}

}  // namespace lekalo::geometry
