// A part of another camera's picture, enlarged or reduced.
#pragma once

#include "render/camera.h"

namespace lekalo::render {

// The picture of width x height pixels whose upper left corner stands at (x, y) of the other camera's picture, one
// pixel of which has `zoom` > 0 of its own.
CameraPtr window_of(CameraPtr camera, double x, double y, double zoom, int width, int height);

}  // namespace lekalo::render
