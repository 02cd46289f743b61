// First-order models of the cells that line_cells.h asks, with bounds on what they leave out.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "geometry/queries/rays/bezier_patch.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// First-order model of a cell.
struct CellModel {
  Vec3 point{0};
  Vec3 dx{0};
  Vec3 dy{0};
  Vec3 normal{0};  // unit, across dx and dy; zero where they are parallel
  // Bounds over the cell on |S_x - dx| + |S_y - dy|, both taken apart as (shift_x dx + shift_y dy + bend normal):
  // shares of dx and of dy, and a length. Infinite where dx and dy are parallel.
  double shift_x = 0;
  double shift_y = 0;
  double bend = 0;
  double variation_x = 0;  // bounds on the lengths of the differences; infinite where formulas are singular
  double variation_y = 0;
  bool is_bounded() const { return variation_x + variation_y < kInfinity; }
  // Bounds on the extent in space along x, and along y, from the centre.
  double reach_x() const { return glm::length(dx) + variation_x; }
  double reach_y() const { return glm::length(dy) + variation_y; }
};

// The model of a rational Bezier patch over its whole square, x = 2 s - 1, y = 2 t - 1. All bounds are infinite where a
// weight is not positive.
CellModel model_of(const PatchView& patch);

// The same for a rectangle of any surface, from evaluate and enclose.
CellModel model_of(const Surface& surface, const Rectangle& box);

// A cell's place in the square of a patch: [x - hx, x + hx] times [y - hy, y + hy].
struct CellPlace {
  double x = 0, y = 0, hx = 1, hy = 1;
};

// The upper half of a float: seven bits behind the leading one, the range of a float.
struct HalfFloat {
  uint16_t bits = 0;
  operator double() const { return std::bit_cast<float>(static_cast<uint32_t>(bits) << 16); }
  // The least one that is not below the value, and the largest that is not above it.
  static HalfFloat above(double value);
  static HalfFloat below(double value);
};

// A cell of a rational Bezier patch for many lines, small because every line that comes near reads it and because there
// are many: a frame in floats and bounds in halves of floats, whose rounding is part of the bounds. The frame measures
// a vector in shares of dx and dy and by its part along the normal.
struct PatchCell {
  using Four = std::array<float, 4>;
  using FourHalves = std::array<HalfFloat, 4>;
  std::array<Four, 3> frame;   // columns: the parts of (1, 0, 0), (0, 1, 0), (0, 0, 1); fourth, the middle's x, y, z
  FourHalves lo, hi;           // box of the cell in its frame, about the middle; fourth, shift_x and shift_y
  HalfFloat bend;              //
  HalfFloat reach_x, reach_y;  // bounds on the extent in space along x and y from the middle
  // Its place, exactly: the middle in units of 1 / kPlaces, and how often the piece was halved.
  int16_t at_x, at_y;
  uint8_t halvings_x, halvings_y;
  static constexpr int kPlaces = 1 << 9;

  // `part`: the patch restricted to the place, which comes from at most nine halvings; `model`: of the part.
  PatchCell(const PatchView& part, const CellModel& model, const CellPlace& place);
  CellPlace place() const {
    constexpr double unit = 1.0 / kPlaces;
    return {unit * at_x, unit * at_y, unit * (kPlaces >> halvings_x), unit * (kPlaces >> halvings_y)};
  }
};

// How far from the linear guess a root may lie, as a share of the cell, for a line at 45 degrees to it; lines that do
// not graze a cell of roughness below 1/4 are decided without halving.
double roughness(const CellModel& model);

// Cells up to this roughness are not cut further when a target is built: few enough to be found quickly, flat enough
// that most lines are decided without halving.
inline constexpr double kFlat = 0.2;

// The cut that flattens more, judged by the second differences of the control points: across the direction in which the
// patch bends more, or, where twist is most of it, across the longer of the cell's extents x and y.
bool flattens_across_u(const PatchView& patch, double x, double y);

}  // namespace lekalo::geometry
