// What a picture shall show, for cameras that frame it.
#pragma once

#include <memory>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::render {

struct Model;
struct Object;

struct Shown {
  geometry::Box3 box;
  std::vector<geometry::Vec3> points;                  // on the shapes, dense enough to stand for them in the picture
  std::shared_ptr<const std::vector<Object>> objects;  // of the scene, where a camera frames some by name; else null

  Shown() = default;
  // The corners of the box stand for it; of an empty or unbounded box those of the unit cube about the origin.
  Shown(const geometry::Box3& box);
};

// Points on everything that the model's objects show: grids on surfaces and faces, points along edges and curves. A
// silhouette between them may stand out by half a hundredth of the shape's size. Unbounded shapes are left out.
// Of very many objects only the corners of their boxes are taken.
Shown shown(const Model& model);
Shown shown(const std::vector<Object>& objects);

}  // namespace lekalo::render
