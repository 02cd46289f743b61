// Parts that primitive bodies are made of.
#pragma once

#include "geometry/body.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// The straight line from `from` to `to` over the parameters of an edge.
Curve2Ptr image_line(const Interval& t, const Vec2& from, const Vec2& to);
// A curve of no length over the parameters of a pole edge.
CurvePtr point_curve(const Interval& t, const Vec3& point);

// A plane polygon of a polyhedron: its corners counterclockwise seen from outside. Without a frame the plane's origin
// is the first corner and x runs along the first side.
struct PolygonFace {
  std::vector<int> corners;
  Origin origin;
  const Frame* frame = nullptr;
};

// Closed body from plane faces. Edges run from the lower to the higher vertex number. A rectangle along its frame's
// axes becomes an untrimmed face.
Body polyhedron(const std::vector<Vec3>& points, const std::vector<PolygonFace>& faces);

// The base polygon of prisms and pyramids in the plane of a frame, counterclockwise about z.
std::vector<Vec2> base_polygon(const Fields& fields);
// Declares the fields that base_polygon reads: sides and radius, or points.
void declare_base(TypeDeclaration& type);

// Where a body of revolution stands, from the fields that declare_axis declares: its base plane z = 0 and height.
struct AxialPlacement {
  Frame frame;
  double height;
};
AxialPlacement axial_placement(const Fields& fields);
void declare_axis(TypeDeclaration& type);

}  // namespace lekalo::geometry
