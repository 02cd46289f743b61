// Where planes cut shapes.
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

void StrokeCollector::add_section(const Entity& shape, const SectionPlane& plane, const Style& style,
                                  const HiddenLines& hidden) {
  // The plane in the shape's coordinates.
  const Affine back = to_world_.inverse();
  const Vec3 through = back.point(plane.through), normal = glm::transpose(to_world_.linear) * plane.normal;
  if (const auto* body = std::get_if<BodyPtr>(&shape))
    add(plane_section(**body, through, normal), **body, style, hidden);
  each_surface(shape, [&](const SurfacePtr& surface) {
    if (!surface->bounded()) return leave_out("sections of " + name_of_object() + ", which is unbounded");
    each_smooth_part(surface,
                     [&](const SurfacePtr& part) { add(plane_section(part, through, normal), {part}, style, hidden); });
  });
  if (const auto* solid_shape = std::get_if<ShapePtr>(&shape))
    in_own_coordinates(*solid_shape, [&](const Shape& original, const Affine& own) {
      const Vec3 own_through = own.point(through), own_normal = glm::transpose(own.inverse().linear) * normal;
      if (const auto* surface = dynamic_cast<const ImplicitSurface*>(&original))
        return add(plane_section(*surface, own_through, own_normal, seen_through(view_from(back), own)), style, hidden);
      const ViewOf own_view = seen_through(view_from(back), own);
      if (const auto* balls = dynamic_cast<const Balls*>(&original))
        return add(plane_section(*balls, own_through, own_normal, own_view), true, style, hidden);
      if (const auto* tube = dynamic_cast<const Tube*>(&original))
        return add(plane_section(*tube, own_through, own_normal, own_view), true, style, hidden);
      const auto* solid = dynamic_cast<const Csg*>(&original);
      if (!solid) return;
      const CsgLines found = csg_section(*solid, own_through, own_normal, own_view);
      note(found);
      for (const CsgLine& line : found.lines) add(line, style, hidden);
    });
  if (const auto* mesh = std::get_if<MeshPtr>(&shape))
    for (const CurvePtr& line : plane_section(**mesh, through, normal)) stroke(line, style, hidden);
}

}  // namespace lekalo::render
