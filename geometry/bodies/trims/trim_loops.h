// Loops of curves in a parameter plane: which cross, and which lies in which.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// A part of a curve of the parameter plane.
struct Arc {
  Arc(const Curve& curve, const Interval& t);

  const Curve* curve;
  Interval t;
  Vec2 a, b;     // its ends
  double bulge;  // it lies this near its chord
};

struct TrimLoop {
  std::vector<Body::Use> uses;  // edges are numbers of curves
  std::vector<Vec2> polygon;    // closed: the last goes on with the first
  std::vector<Arc> arcs;        // that the sides of the polygon stand for
  Box3 box;                     // of the polygon
  double area = 0;              // positive where it runs counterclockwise
  int depth = 0;                // loops around it
  int around = -1;              // the innermost of them
  int winds = -1;               // 0, 1: it goes once round the closed surface along u, v, and upwards; a ring
  // Pairs of uses that are the two sides of one seam.
  std::vector<std::array<size_t, 2>> seams;
};

// Fills a loop's polygon, arcs, box and area from its uses.
void outline(TrimLoop& loop);
// Of its curves.
Box3 box_of(const TrimLoop& loop);
bool is_in(const Vec2& p, const std::vector<Vec2>& polygon);

// What messages call the curve of a use.
using NameOfCurve = std::function<std::string(size_t curve)>;
std::string text_of(const Vec2& p);

// Of outlined loops, `size` being that of the whole: throws TrimError where they cross each other or themselves,
// enclose nothing, or are the same. They may touch.
void check_loops(const std::vector<TrimLoop>& loops, double size, const NameOfCurve& name);
// Finds depth and around of each; throws likewise.
void nest(std::vector<TrimLoop>& loops, const NameOfCurve& name);

}  // namespace lekalo::geometry
