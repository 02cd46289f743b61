#include "geometry/queries/contours/surface_intersection.h"

#include <algorithm>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_assembly.h"
#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/implicit_curves/surface_tips.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

static bool has_tip_on(const Surface& surface, const Plane& plane, double tolerance) {
  const std::vector<Vec2> tips = surface_tips(surface);
  return std::any_of(tips.begin(), tips.end(), [&](const Vec2& tip) {
    return std::abs(plane.frame().to_local_point(surface.point(tip.x, tip.y)).z) <= tolerance;
  });
}

// Where a bounded plane meets a surface, as the section by the whole plane, cut at its sides: through tips a search in
// four parameters finds no way.
static Contours section_by_rectangle(const SurfacePtr& surface, const Plane& plane, bool plane_first) {
  const Frame& frame = plane.frame();
  const Rectangle domain = plane.domain();
  Affine to_plane;
  to_plane.linear = glm::transpose(Mat3(frame.x, frame.y, Vec3(0)));
  to_plane.offset = -(to_plane.linear * frame.origin);
  const Contours whole = plane_section(surface, frame.origin, frame.z);
  Contours found;
  found.coincident = whole.coincident, found.complete = whole.complete;
  for (Contour contour : whole.branches) {
    const Curve2Ptr on_plane = transformed(contour_approximation(contour.curve), to_plane);
    contour.images.insert(plane_first ? contour.images.begin() : contour.images.end(), on_plane);
    add_inside(contour, *on_plane, domain, found.branches);
  }
  for (ContourPoint point : whole.points) {
    const Vec3 at = to_plane.point(point.point);
    if (!domain.contains(at.x, at.y)) continue;
    point.parameters.insert(plane_first ? point.parameters.begin() : point.parameters.end(), {at.x, at.y});
    found.points.push_back(std::move(point));
  }
  return found;
}

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
  for (const bool swapped : {false, true})
    if (const auto* plane = dynamic_cast<const Plane*>(swapped ? a.get() : b.get()))
      if (const SurfacePtr& other = swapped ? b : a; has_tip_on(*other, *plane, tolerance * size))
        return section_by_rectangle(other, *plane, swapped);
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
