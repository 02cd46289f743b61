// Where a drawing's lines pass through surfaces on which they do not lie.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "geometry/queries/intersections/crossing_candidates.h"
#include "geometry/queries/intersections/curve_entries.h"
#include "geometry/spatial/box_tree.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

class Piercings {
 public:
  // Through the surfaces on which the strokes lie, and through shapes and meshes of the world that no surfaces
  // describe.
  Piercings(const World& world, const std::vector<Stroke>& strokes);

  // Adds the parameters at which a line passes through one. `along`: lines that lie along it, whose surfaces count as
  // its own. May be asked of many lines at once.
  void add(const Stroke& stroke, const std::vector<const Stroke*>& along, std::vector<double>& places);

 private:
  struct PlacedSurface {
    geometry::SurfacePtr surface, original;
    geometry::Affine to_world;
    int object;
    std::unique_ptr<geometry::SurfaceCells> cells;  // when they are first asked for
    std::unique_ptr<std::mutex> guard;              // of the cells
  };
  // Whose boundary is not made of parametric surfaces.
  struct PlacedShape {
    geometry::Box3 box;
    int object, placement;
    geometry::ChordHits add_hits;
  };
  // Whether the line is known to lie on it.
  static bool is_supporting_surface(const PlacedSurface& surface, const Stroke& stroke);
  bool lies_on(const geometry::Curve& curve, const PlacedSurface& other) const;
  void add_shape(const Object& object, const geometry::Affine& to_world, int placement);

  const World& world_;
  std::vector<PlacedSurface> surfaces_;
  geometry::BoxTree tree_;  // of their boxes
  std::vector<PlacedShape> shapes_;
};

}  // namespace lekalo::render
