// Integrals over triangles of the parameter plane by rules of few points (Golovanov 2016, 8.10), and areas and volumes
// by them on the triangles into which surfaces and bodies are cut (8.9).
#pragma once

#include <span>

#include "geometry/body.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

struct CubaturePoint {
  double a, b, c;  // barycentric
  double weight;   // all of a rule together: 1
};
// Of 1, 3, 4, 6 or 7 points, exact for polynomials of total degree 1, 2, 3, 4, 5; throws std::invalid_argument for
// other numbers.
std::span<const CubaturePoint> triangle_rule(int points);

struct CellMeasures {
  size_t cells = 0;
  double area = 0;
  double volume = 0;  // of a closed body: 1/3 of the integral of (r - o) . n
};
// The normal turns by about `angle` (radians) inside of a cell at most. The values come with no bound on their error:
// compare rules, or angles. Chords of cells replace curved trims.
CellMeasures measure_on_triangles(const Surface& surface, int points, double angle);
CellMeasures measure_on_triangles(const Body& body, int points, double angle);

}  // namespace lekalo::geometry
