#include "geometry/queries/contours/surface_intersection.h"

#include <algorithm>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_assembly.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/queries/contours/contours_of_parts.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

static Contours intersect_smooth(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  for (const bool swapped : {false, true}) {
    const auto* plane = dynamic_cast<const Plane*>(swapped ? a.get() : b.get());
    const SurfacePtr& other = swapped ? b : a;
    if (plane && !plane->bounded() && other->bounded())
      return plane_section(other, plane->frame().origin, plane->frame().z);
  }
  demand_bounded(*a);
  demand_bounded(*b);
  Box3 all = bounds(*a);
  all.include(bounds(*b));
  const double size = std::max(all.diameter(), 1e-300);
  if (auto exact = closed_intersection(a, b, tolerance * size)) return *exact;
  const Periods of_a = closed_periods(*a), of_b = closed_periods(*b);
  ContourAssembly<4> assembly(size, tolerance * size, {of_a.u, of_a.v, of_b.u, of_b.v});
  const std::vector<SurfacePiece> pieces_a = a->pieces(), pieces_b = b->pieces();
  std::vector<Box3> boxes_b;
  for (const SurfacePiece& piece : pieces_b) boxes_b.push_back(bounds(*b, piece));
  const BoxTree tree_b(boxes_b);
  for (const SurfacePiece& piece_a : pieces_a)
    tree_b.around(bounds(*a, piece_a).inflated(tolerance * size), [&](int k) {
      const std::array<bool, 2> in_a = goes_on(*a, piece_a.domain), in_b = goes_on(*b, pieces_b[k].domain);
      PieceSearch<4> search;
      search.left_to_neighbour = {in_a[0], in_a[1], in_b[0], in_b[1]};
      assembly.add(intersection_equations(a, piece_a.domain, b, pieces_b[k].domain), search);
    });
  return assembly.joined();
}

Contours intersect(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  return of_parts(a, 0, [&](const SurfacePtr& part_a) {
    return of_parts(b, 1, [&](const SurfacePtr& part_b) { return intersect_smooth(part_a, part_b, tolerance); });
  });
}

}  // namespace lekalo::geometry
