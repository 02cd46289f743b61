// Curves, surfaces and bodies as polygons and triangles with a bound on the sag (Golovanov 2016, 8.3, 8.6-8.8).
#pragma once

#include <functional>

#include "geometry/body.h"
#include "geometry/curve.h"
#include "geometry/mesh.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

struct TessellationTolerance {
  double sag = 1e-3;              // largest distance of a triangle from the surface, in scene units
  double angle = 20 * kPi / 180;  // largest turn of the normal along u and v; more across both
  // Sag as a function of place, for tolerances in pixels; used in place of `sag` when set.
  std::function<double(const Vec3&)> sag_at;
  double sag_near(const Vec3& point) const { return sag_at ? sag_at(point) : sag; }
};

// Increasing parameters from domain().lo to domain().hi whose chords keep the sag; knots of lower smoothness included.
std::vector<double> polygon_parameters(const Curve& curve, const TessellationTolerance& tolerance);

// A surface over its whole domain: shared vertices, true normals, separate steps in u and v, no degenerate triangles at
// poles, the first and last column of a closed direction welded. Parameters are natural.
Mesh tessellate(const Surface& surface, const TessellationTolerance& tolerance);

// A body: one polygon for every edge shared by both faces, so that there are no cracks; normals per face.
// Triangle::face is the face's handle.
Mesh tessellate(const Body& body, const TessellationTolerance& tolerance);

}  // namespace lekalo::geometry
