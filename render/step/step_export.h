// Models as STEP files (ISO 10303-21, application protocol 214): the boundary representation of what a scene shows, for
// CAD systems.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

// Something to write under a name: moved by `to_world`, of a colour where one is given.
struct StepShape {
  std::string name;
  Entity entity;
  geometry::Affine to_world;
  std::optional<geometry::Vec3> color;        // sRGB, 0 to 1
  std::map<int, geometry::Vec3> face_colors;  // of a body's faces that have their own
  std::string no_boundary;                    // why a solid that might have one has no boundary here
};

struct StepFile {
  std::string text;
  // What is not as it is in the model: fits with their deviation, things that are left out. One sentence each.
  std::vector<std::string> notes;
  int products = 0;
};

// Closed bodies are solids, with voids; open ones, surfaces and sets of surfaces are shells; curves are wire frames,
// points are points. Planes, cylinders, cones, spheres, tori, lines, circles, ellipses and NURBS stand as they are, in
// double precision, also where sweeps make them; other extrusions and revolutions keep their section; anything else is
// fitted by a B-spline nearer than `tolerance` times its size. Colours are sRGB. `unit`: what a scene unit is
// (info.unit); millimetres, with a note, where it is not known. Throws std::invalid_argument where nothing can be
// written.
StepFile step_file(const std::vector<StepShape>& shapes, const std::string& title, const std::string& unit,
                   double tolerance);

}  // namespace lekalo::render
