// The lines and marks that pictures show of a model's objects: curves, borders, edges, parameter lines, control
// polygons and nets, points. Lengths on the page become pixels here.
//
// What objects ask for by `lines` is shown; of objects that do not say, curves and points alone, in the style `curve`
// of the drawing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/trace/world.h"

namespace lekalo::render {

struct LineLook {
  double half_width = 0.5;  // pixels; no line is thinner than a pixel: a thinner one is the fainter for it
  Spectrum color;
  double opacity = 1;
  std::vector<double> dash;  // pixels drawn and left out in turn; empty: solid
  enum class Cap { butt, round, square } cap = Cap::butt;
};

struct Stroke {
  geometry::CurvePtr curve;
  geometry::Affine to_world;
  LineLook look;
  std::optional<LineLook> hidden;  // of what lies behind something; none: not drawn
  int object = 0;                  // its number in World::objects()
  int order = 0;                   // of lines at the same depth the one of the higher order is seen
};

// A sign of constant size at a point.
struct Mark {
  Vec3 point{0};  // in the world
  enum class Sign { dot, circle, ball, cross, plus, square, triangle, diamond } sign = Sign::dot;
  double radius = 2;  // pixels
  LineLook line;      // of signs that are drawn by lines
  std::optional<Spectrum> fill;
  std::optional<double> hidden_opacity;  // of marks behind something; none: not drawn
  int object = 0;
  int order = 0;
};

struct LineWork {
  std::vector<Stroke> strokes;
  std::vector<Mark> marks;
};

LineWork line_work(const World& world);

// What of the objects' lines, helpers and shapes pictures do not show, but drawings: "lines (silhouette)", "helpers
// (comb)".
std::vector<std::string> left_to_drawings(const std::vector<Object>& objects);

}  // namespace lekalo::render
