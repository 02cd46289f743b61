// Curves with their images on a surface.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// A curve and its image in the parameter plane of a surface, at the same parameter.
struct LineOnSurface {
  CurvePtr curve;
  Curve2Ptr image;
};

}  // namespace lekalo::geometry
