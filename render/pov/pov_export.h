// A model as a scene file of POV-Ray 3.7, for comparison with an independent program.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

struct PovOptions {
  double sag = 0;          // of triangles where POV-Ray has no exact shape, in scene units; 0: 1e-4 of the shape's size
  double flatness = 1e-5;  // of bicubic_patch: parts flatter than this, in scene units, are not divided further
  int patch_steps = 7;     // bicubic_patch is divided into at most 2^patch_steps parts in each direction
};

struct PovScene {
  std::string text;
  // What POV-Ray cannot show as the model says, one sentence each, without repetition.
  std::vector<std::string> notes;
};

// Spheres, cylinders, cones, tori, boxes, quadrics, planes and polynomial Bezier patches up to degree 3 become the
// exact shapes of POV-Ray, all else smooth triangles (mesh2). Needs a model with a camera; throws std::invalid_argument
// without one. To get the values of the `classic` integrator, render with `-A` (one ray a pixel, through its centre).
PovScene pov_scene(const Model& model, const PovOptions& options = {});

}  // namespace lekalo::render
