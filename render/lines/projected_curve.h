// A curve as a picture shows it: P(t), in pixels, of a curve r(t) before a camera, and its points nearest to a place.
//
// The curve is cut into cells from certified enclosures of r, r', r'' put through the camera's map in interval
// arithmetic, which bounds P''. With h half the width of a cell and m = |P'| in its middle,
//
//   |P''| h <= kTurn m            the direction changes little: P runs along its chord, and
//   reach |P''| < kBend (m - |P''| h)^2    the radius of curvature is larger than the reach,
//
// so that the squared distance from a place q has one minimum on the cell if it comes within the reach of it: there
// g(t) = (P - q) . P' grows, as g' = P'^2 + (P - q) . P'' > 0. Where the curve bends more than that (cusps, small
// loops), cells are a few hundredths of a pixel long and their chords stand for them.
#pragma once

#include <optional>
#include <vector>

#include "geometry/curve.h"
#include "render/camera.h"

namespace lekalo::render {

class ProjectedCurve {
 public:
  // No cell is longer than this, in pixels, so that few are near a place.
  static constexpr double kLongest = 24;

  struct Cell {
    geometry::Interval t;
    Vec2 begin, end;                  // P there
    Vec2 begin_tangent, end_tangent;  // P'; that of the chord where the chord stands for the cell
    double bulge = 0;                 // the curve lies this near the chord
    double bow = 0;                   // |P''| h^2 / 2 at most: the bulge by that alone
    Vec2 second_lo{0}, second_hi{0};  // box of P''
    bool is_chord = false;
    bool follows = false;  // begins where the cell before it (of a closed curve, before the first: the last) ends
    bool is_followed = false;
    double length_before = 0;  // of the curve in the picture, from its beginning or from where it enters the picture
  };

  // `to_world` places the curve; cells that stay `reach` pixels and more outside of the picture, or behind the eye, are
  // left out. The curve's domain must be finite.
  ProjectedCurve(geometry::CurvePtr curve, const geometry::Affine& to_world, const Camera& camera, double reach);

  const std::vector<Cell>& cells() const { return cells_; }

  struct Nearest {
    double t = 0;
    Vec2 place{0};    // P(t)
    Vec2 tangent{0};  // unit, the way t grows; zero where there is none
    double distance = 0;
    int end = 0;  // -1 the curve's beginning, 1 its end, where the distance would go on to fall; else 0
  };
  // Where on the cell the distance from the place q is least, if that is a minimum of the whole curve's distance and
  // may lie within the reach: a corner between two cells belongs to the first of them.
  std::optional<Nearest> nearest(int cell, const Vec2& q) const;

  Vec2 point(double t) const;  // P
  // P and P'.
  struct Place {
    Vec2 p, tangent;
  };
  Place place(double t) const;
  // With P''.
  struct Jet {
    Vec2 p, p1, p2;
  };
  Jet jet(double t) const;

  // The point in the world, and the derivative of it.
  geometry::Line tangent(double t) const;
  // Length of the curve in the picture up to t in the cell, in pixels.
  double length_up_to(int cell, double t) const;

 private:
  Place place_of(const geometry::CurveJet& at, double w, double w1) const;
  void cut(const geometry::Interval& t);
  Cell& add(const geometry::Interval& t, bool is_chord, double bulge, double bow);
  void link();
  double length(const geometry::Interval& t) const;

  geometry::CurvePtr curve_;
  geometry::Affine to_world_;
  PictureMap map_;  // of the curve's own coordinates
  double reach_;
  Vec2 picture_;  // width and height
  double narrowest_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace lekalo::render
