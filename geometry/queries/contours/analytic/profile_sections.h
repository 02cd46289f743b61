// Sections of extrusions and surfaces of revolution by planes, and where these meet themselves, without a search but
// for the roots of the profile (Golovanov 2016, 4.7c):
//
//   extrusion along d, plane n . p = h with n . d != 0   the profile moved along d, v(u) = (h - n . c(u)) / (n . d)
//   extrusion along the plane                           straight lines from the points of the profile in the plane
//   revolution, plane across the axis                   circles through the points of the profile in the plane
//   revolution, plane through the axis                  the profile turned into the plane, if it is plane itself
//   extrusion along d, itself                           straight lines where the profile seen along d meets itself
//   revolution, itself                                  circles where the profile does, if it is plane with the axis
#pragma once

#include <optional>

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The rectangle of a bounded plane that cuts, with the plane's images; without it there is one image.
struct CuttingPlane {
  Vec3 origin{0}, normal{0, 0, 1};
  SurfacePtr bounded;
};

// Nothing for other surfaces, and where the profile touches the plane's or its own borders, or the plane along a part.
// `size` is that of both.
std::optional<Contours> profile_section(const SurfacePtr& surface, const CuttingPlane& plane, double size);

// Two images each. Incomplete where the profile has cusps or runs twice through a part. Nothing for other surfaces, and
// where the profile meets the axis or two of its points lie the extrusion's whole length apart. `tolerance` is
// relative.
std::optional<Contours> profile_self_intersection(const SurfacePtr& surface, double tolerance);

}  // namespace lekalo::geometry
