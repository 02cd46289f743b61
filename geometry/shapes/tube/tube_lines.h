// Lines on tubes about any curve: where a tube meets surfaces, implicit surfaces and other tubes, the edges along which
// it goes through itself, and its parameter lines.
//
// The boundary of a tube lies on surfaces: its walls (surfaces/canal_surface.h), one for each part of the curve without
// corners, the balls at corners and round ends, and the planes of flat ends. They are met by the search for contours
// (contours.h); what of a contour lies inside of the tube, or is cut off by a flat end, is cut away.
#pragma once

#include <array>
#include <optional>

#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/shapes/tube/canal_surface.h"
#include "geometry/shapes/tube/tube_cutting.h"

namespace lekalo::geometry {

class ImplicitFormula;

class TubeBoundary {
 public:
  // The tube must outlive it.
  explicit TubeBoundary(const Tube& tube);

  struct Part {
    SurfacePtr surface;
    std::shared_ptr<const CanalSurface> wall;  // the surface, if it is one
    std::optional<double> before, after;       // of a ball between walls, or after or before one: where these end
    int end = -1;                              // of a flat end: its side
  };
  // Together they hold the boundary, and more.
  const std::vector<Part>& parts() const { return parts_; }
  // False where the curve, or the radius, has no wall in some part (surfaces/canal_surface.h).
  bool complete() const { return without_wall_.empty(); }
  const Tube& tube() const { return tube_; }

  // All lines are edges, with images on the surface that is met; `view` is that of their turns. The surface and the
  // formula are given in the tube's coordinates, or by the map from these.
  ShapeOutlines intersection(const SurfacePtr& surface, const ViewOf& view) const;
  ShapeOutlines intersection(const ImplicitFormula& formula, const Affine& to_formula, const ViewOf& view) const;
  ShapeOutlines intersection(const TubeBoundary& other, const Affine& from_other, const ViewOf& view) const;

  // The edges along which the tube goes through itself, but for corners between straight parts (ball_outlines.h).
  struct Edges {
    ShapeOutlines lines;
    // False where some are left out: the curve bends more than the radius at an end, all along, or where it is no one
    // polynomial (at a knot); or parts without a wall come near themselves.
    bool all_known = true;
  };
  Edges edges(const ViewOf& view) const;

  // On the walls: circles about the curve, u its parameter, and lines along it, v the angle from where that of the
  // tube's hits is zero where the curve begins; they go on over corners. Round and flat ends have none. A closed
  // curve's lines close if its wall does; they meet at another angle where it has corners and is not plane.
  ShapeOutlines parameter_lines(const ParameterNet& net, const ViewOf& view) const;

  // Of a part at a place: the direction out of the tube, and whether the place is on the boundary, as seen from so far
  // outside, of the size.
  Vec3 outward(const Part& part, const Vec2& place) const;
  bool is_exposed(const Part& part, const Vec2& place, double beside) const;
  // The same of a place on two parts, where the tube has an edge; from between them.
  bool is_exposed_edge(const Part& a, const Vec2& at_a, const Part& b, const Vec2& at_b, double beside) const;

 private:
  void add_walls();
  void add_ball(std::optional<double> before, std::optional<double> after);
  void add_flat_ends();
  bool is_cut_off(const Part& part, const Vec2& place) const;
  bool is_on_end(int side, const Vec3& p) const;
  bool bends_too_much(const CanalSurface& wall) const;
  bool meet_in_curved_corner(const CanalSurface& a, const CanalSurface& b) const;
  std::optional<std::vector<std::array<Interval, 2>>> near_stretches(const Interval& range, bool closed) const;
  void add_own_edges(const Part& part, const ViewOf& view, Edges& found) const;
  // What of a part may meet another one: without the cells next to it where they have a ball in common.
  std::optional<Part> apart_from(const Part& part, const Part& other) const;
  Part wall_over(double from, double to) const;
  void add_edges(const Contours& contours, const Part& a, const Part& b, const ViewOf& view, Edges& found) const;
  bool add_cuspidal_edges(const CanalSurface& wall, const ViewOf& view, Edges& found) const;
  TubeLine line_on_wall(const Part& part, IsoDirection held, double at) const;
  std::optional<TubeLine> line_over_corner(const Part& ball, const Part& before, double v) const;
  std::vector<double> zero_angles() const;
  TubeLine edge_of_balls(const CurvePtr& curve, const std::function<Vec2(double)>& balls,
                         const std::function<bool(const Vec2&)>& keeps) const;

  const Tube& tube_;
  double size_;
  std::vector<Part> parts_;
  std::vector<Interval> without_wall_;
};

}  // namespace lekalo::geometry
