// A convex region of the plane cut by line segments into triangles that no segment goes through: the pieces of
// piecewise polynomials with knots at the ends of the segments (Golovanov 2016, 3.13).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

struct PlanarSegment {
  Vec2 from, to;
};

struct PlanarCells {
  std::vector<Vec2> points;
  std::vector<std::array<int, 3>> triangles;  // counterclockwise; neighbours share whole sides
  std::array<Vec2, 3> corners(size_t triangle) const;
};

// `border`: a convex polygon, counterclockwise. Where a segment ends inside a cell the cell is cut through. Places
// nearer than 1e-12 of the region's size are one.
PlanarCells planar_cells(std::span<const Vec2> border, std::span<const PlanarSegment> segments);

// Their x and y.
std::vector<Vec2> plane_points(const std::vector<Vec3>& points);

// Counterclockwise, without points on the sides; fewer than three where all points lie on one line.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

// All pairs of different points.
std::vector<PlanarSegment> all_segments(std::span<const Vec2> points);

}  // namespace lekalo::geometry
