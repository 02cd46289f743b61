// The parts of tools/bench intersections. Each prints JSON objects of its rows, one a line.
#pragma once

namespace lekalo::benchmarks {

// All foot points of points on curves and surfaces, against GeomAPI_ProjectPointOnCurve and -OnSurf.
void print_projections(int runs);
// Intersections of two surfaces against GeomAPI_IntSS.
void print_intersections(int runs);
// One pair of surfaces cut into more and more pieces.
void print_sizes(int runs);

}  // namespace lekalo::benchmarks
