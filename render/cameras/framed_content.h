// What a picture shall show, for cameras that frame it.
#pragma once

#include <memory>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::render {

struct Object;

class FramedContent {
 public:
  geometry::Box3 box;
  std::shared_ptr<const std::vector<Object>> objects;  // of the scene, where a camera frames some by name; else null

  // The corners of the box stand for it; of an empty or unbounded box those of the unit cube about the origin.
  explicit FramedContent(const geometry::Box3& box = {});
  // Everything that the objects show.
  explicit FramedContent(const std::vector<Object>& objects);

  // Points on the shapes, dense enough to stand for them in the picture: grids on surfaces and faces, points along
  // edges and curves; of solids that are put together where lines in a grid meet them. A silhouette between them may
  // stand out by half a hundredth of the shape's size, a corner that cuts make by three hundredths. Unbounded shapes
  // are left out, and what planes cut away. Of very many objects only the corners of their boxes are taken, and no more
  // is kept of them. Else computed when first asked for: many cameras do not ask.
  const std::vector<geometry::Vec3>& points() const;

  // The box of these points, and of the places where curves are farthest along x and y, found to rounding: a graph of
  // sin(t) is shown from -1 to 1.
  const geometry::Box3& tight_box() const;

 private:
  struct Points;
  std::shared_ptr<Points> points_;
};

}  // namespace lekalo::render
