// Intersections and silhouettes of surfaces that have a closed form: conics, straight lines, profiles, exact to
// rounding, with images by the surfaces' own inverse formulas (Golovanov 2016, 4.7; capabilities 4.7a to 4.7c). They
// are
//
//   planes with planes and quadrics, also under affine maps;
//   planes with extrusions and surfaces of revolution (geometry/queries/contours/analytic/profile_sections.h): the
//   profile, moved; quadrics that meet in planes (geometry/queries/quadrics/quadric_sections.h); silhouettes
//   of quadrics: sections by the polar plane of the eye, or of the line of sight; silhouettes of rings
//   (geometry/queries/contours/analytic/torus_silhouette.h); tori with planes across or through the axis and those that
//   touch them twice (Villarceau), with planes, spheres, cylinders, cones and tori about the same axis, with the
//   spheres that fill their tube; spheres with cylinders that touch them from within, tori with
//   planes along the axis that touch the inner equator (geometry/queries/contours/analytic/hippopede.h); what cylinders
//   of revolution about one axis with one radius have in common.
//
// Nothing is returned for other pairs, and wherever rounding or the tolerance would have to decide: nearly tangent,
// nearly coincident, borders that touch, singular points at ends. There the search of
// geometry/queries/contours decides. What is returned lies within 1e-14 of the size on both surfaces.
#pragma once

#include <optional>

#include "geometry/contour.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Both bounded; `tolerance` is a length.
std::optional<Contours> closed_intersection(const SurfacePtr& a, const SurfacePtr& b, double tolerance);

// The plane is unbounded, its normal of unit length; contours have one image.
std::optional<Contours> closed_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal,
                                       double tolerance);

// The view as checked by silhouette().
std::optional<Contours> closed_silhouette(const SurfacePtr& surface, const ViewOf& view, double tolerance);

}  // namespace lekalo::geometry
