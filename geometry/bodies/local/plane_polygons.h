// Oriented polygons in planes of space, whose loops may cross: what the faces of a polyhedron become that passes
// through itself.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

struct PlanePolygon {
  Frame frame;  // z is the outward normal
  std::vector<std::vector<Vec3>> loops;
  int face = -1;
};

// The faces of a body whose faces are plane and whose edges are straight.
std::vector<PlanePolygon> polygons_of(const Body& body);

// How often the loops go round a point of the plane; `margin`: no loop comes nearer (else nothing).
std::optional<int> winding(const PlanePolygon& polygon, const Vec3& point, double margin);

// How often all of them together enclose the point: crossings of a ray to the outside, those with faces that look along
// it less those with faces against it. Polygons for which `skip` is true are left out.
int enclosing(const std::vector<PlanePolygon>& polygons, const Vec3& point, const Vec3& towards,
              const std::vector<char>& skip, double size);

// Distance of a point from the polygon.
double distance_from(const PlanePolygon& polygon, const Vec3& point);

// Where a polygon runs through the plane of a frame: segments between its borders, and its sides in the plane.
std::vector<std::pair<Vec3, Vec3>> traces(const PlanePolygon& polygon, const Frame& plane, double small);

}  // namespace lekalo::geometry
