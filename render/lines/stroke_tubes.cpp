// Lines on tubes: where they meet other shapes (geometry/shapes/tube/tube_lines.h).
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

const TubeBoundary& StrokeCollector::boundary_of(const Tube& tube) {
  return tubes_.try_emplace(&tube, tube).first->second;
}

void StrokeCollector::add_on_tube(const ShapeOutlines& lines, const SurfacePtr& met, const Style& style,
                                  const HiddenLines& hidden) {
  if (!lines.complete) is_incomplete();
  for (const ShapeOutline& line : lines.lines) {
    if (met && line.image) supporting_surfaces_.push_back({met, line.image});
    cusps_ = line.turns;
    stroke(line.curve, style, hidden);
  }
}

StrokeCollector::Meets StrokeCollector::meets_of_tube(const Tube& tube, const Affine& to_world,
                                                      const Affine& solid_to_world, const Style& style,
                                                      const HiddenLines& hidden) {
  to_world_ = to_world;
  const TubeBoundary* boundary = &boundary_of(tube);
  const Affine to_solid = solid_to_world.inverse() * to_world, from_solid = to_solid.inverse();
  const ViewOf view = view_from(to_world.inverse());
  return {transformed(tube.bounds(), to_solid),
          [=, this](const ImplicitSurface& other) {
            add_on_tube(boundary->intersection(other.formula(), to_solid, view), nullptr, style, hidden);
          },
          [=, this](const SurfacePtr& surface) {
            const SurfacePtr moved = transformed(surface, from_solid);
            if (const auto* plane = dynamic_cast<const Plane*>(surface.get()))
              add_on_tube(plane_section(boundary->tube(), from_solid.point(plane->frame().origin),
                                        glm::transpose(to_solid.linear) * plane->frame().z, view),
                          nullptr, style, hidden);
            else
              add_on_tube(boundary->intersection(moved, view), moved, style, hidden);
          }};
}

bool StrokeCollector::add_intersection_of_tube(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                               const HiddenLines& hidden) {
  const auto* tube = solid_of<Tube>(a.shape);
  if (!tube) return false;
  const Meets meets = meets_of_tube(*tube, a.to_world, b.to_world, style, hidden);
  if (const auto* other = solid_of<Tube>(b.shape))
    add_on_tube(boundary_of(*tube).intersection(boundary_of(*other), a.to_world.inverse() * b.to_world,
                                                view_from(a.to_world.inverse())),
                nullptr, style, hidden);
  else if (has_parts(b.shape))
    meets_parts(meets, b);
  else
    return false;
  return true;
}

}  // namespace lekalo::render
