#include "render/drawing/visibility/piercings.h"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/queries/contours/mesh_contours.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/shapes/csg/csg_leaves.h"
#include "geometry/transformed.h"
#include "render/drawing/visibility/quantitative_invisibility.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// A stretch of a line as near to a surface, of the scene's radius, is told by rays; after a few of them it may run
// along the surface.
constexpr double kNear = 1e-7;
constexpr int kFewTouches = 6, kManyPairs = 400000;

bool has_surfaces(const Shape& shape) {
  const auto* moved = dynamic_cast<const TransformedShape*>(&shape);
  const auto* solid = dynamic_cast<const Csg*>(moved ? moved->original().get() : &shape);
  if (!solid) return false;
  const std::vector<CsgLeaf> leaves = csg_leaves(*solid);
  return std::none_of(leaves.begin(), leaves.end(), [](const CsgLeaf& leaf) { return leaf.shape != nullptr; });
}

// What lines pierce without surfaces that tell where.
bool is_pierced_shape(const Object& object) {
  if (!(object.visible_to & static_cast<uint32_t>(RayKind::camera))) return false;
  const auto* shape = std::get_if<ShapePtr>(&object.shape);
  return shape ? !has_surfaces(**shape) : std::holds_alternative<MeshPtr>(object.shape);
}

}  // namespace

Piercings::Piercings(const World& world, const std::vector<Stroke>& strokes) : world_(world) {
  std::vector<Box3> boxes;
  std::map<const Surface*, std::vector<size_t>> copies;
  for (const Stroke& stroke : strokes)
    for (const Stroke::SupportingSurface& supporting_surface : stroke.supporting_surfaces) {
      if (!supporting_surface.surface->bounded()) continue;
      std::vector<size_t>& known = copies[supporting_surface.surface.get()];
      if (std::any_of(known.begin(), known.end(),
                      [&](size_t k) { return is_supporting_surface(surfaces_[k], stroke); }))
        continue;
      known.push_back(surfaces_.size());
      const SurfacePtr placed = transformed(supporting_surface.surface, stroke.to_world);
      boxes.push_back(bounds(*placed));
      surfaces_.push_back({placed, supporting_surface.surface, stroke.to_world, stroke.object, nullptr,
                           std::make_unique<std::mutex>()});
    }
  tree_ = BoxTree(boxes);
  PlacedObjects(world.model().objects, is_pierced_shape)
      .visit(
          [&](const Object& object, const Affine& to_world, int placement) { add_shape(object, to_world, placement); });
}

void Piercings::add_shape(const Object& object, const Affine& to_world, int placement) {
  const auto& all = world_.objects();
  const int number = static_cast<int>(std::find(all.begin(), all.end(), &object) - all.begin());
  if (const auto* shape = std::get_if<ShapePtr>(&object.shape)) {
    const ShapePtr placed = transformed(*shape, to_world);
    shapes_.push_back({placed->bounds(), number, placement, [placed](const Line& chord, std::vector<double>& hits) {
                         std::vector<SurfaceHit> found;
                         placed->all_hits(chord, {0, 1}, found);
                         for (const SurfaceHit& hit : found) hits.push_back(hit.t);
                       }});
  }
  if (const auto* mesh = std::get_if<MeshPtr>(&object.shape)) {
    const auto placed = std::make_shared<MeshTriangles>(std::make_shared<Mesh>(transformed(**mesh, to_world)));
    shapes_.push_back({placed->bounds(), number, placement, [placed](const Line& chord, std::vector<double>& hits) {
                         placed->add_crossings(chord, {0, 1}, hits);
                       }});
  }
}

void Piercings::add(const Stroke& stroke, const std::vector<const Stroke*>& along, std::vector<double>& places) {
  const CurvePtr curve = transformed(stroke.curve, stroke.to_world);
  const Box3 box = bounds(*curve);
  for (const PlacedShape& other : shapes_) {
    const bool is_own = other.object == stroke.object && other.placement == stroke.placement,
               is_met = other.object == stroke.met && other.placement == stroke.met_placement;
    if (!is_own && !is_met && BoxTree::meets(other.box, box))
      add_entries(*curve, other.box, world_.radius(), other.add_hits, places);
  }
  std::optional<CurveCells> cells;
  tree_.around(box, [&](int number) {
    PlacedSurface& other = surfaces_[number];
    if (is_supporting_surface(other, stroke) ||
        std::any_of(along.begin(), along.end(), [&](const Stroke* one) { return is_supporting_surface(other, *one); }))
      return;
    if (!cells) cells.emplace(*curve);
    const double near = kNear * world_.radius();
    {
      const std::lock_guard lock(*other.guard);
      if (!other.cells) other.cells = std::make_unique<SurfaceCells>(*other.surface);
      if (add_crossing_candidates(*cells, *other.cells, near, kFewTouches, kManyPairs, places) ||
          lies_on(*curve, other) || add_crossing_candidates(*cells, *other.cells, near, kManyPairs, kManyPairs, places))
        return;
    }
    for (const SurfaceIntersection& intersection : intersect(*curve, *other.surface).points)
      places.push_back(intersection.t);
  });
}

bool Piercings::is_supporting_surface(const PlacedSurface& surface, const Stroke& stroke) {
  return stroke.object == surface.object && same_map(stroke.to_world, surface.to_world) &&
         std::any_of(stroke.supporting_surfaces.begin(), stroke.supporting_surfaces.end(),
                     [&](const Stroke::SupportingSurface& supporting_surface) {
                       return supporting_surface.surface == surface.original;
                     });
}

// A free curve that runs on a surface pierces it nowhere; to find that out as common parts takes long.
bool Piercings::lies_on(const Curve& curve, const PlacedSurface& other) const {
  const Interval domain = curve.domain();
  for (const double x : {0.43, 0.07, 0.91, 0.26, 0.71, 0.13, 0.58})
    if (!other.cells->holds(curve.point(domain.lo + x * domain.width()),
                            QuantitativeInvisibility::kTouch * world_.radius()))
      return false;
  return true;
}

}  // namespace lekalo::render
