#include "geometry/shapes/tube/tube_lines.h"

#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/level_section.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/implicit_curves/implicit_formula.h"
#include "geometry/shapes/tube/ball_circles.h"
#include "geometry/shapes/tube/tube_cutting.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Unit tangents of a wall's pieces differ by no more than this where they meet.
constexpr double kSmoothWall = 1e-8;
// Poles of balls stand so to the curve: where no symmetry puts a contour.
const Vec3 kPole{0.31, 0.17, 1};
// A part of a tube on which a line lies, in coordinates that the map leads from.
struct OnPart {
  const TubeBoundary& boundary;
  const TubeBoundary::Part& part;
  Affine map;
  Curve2Ptr image;

  Vec2 place(double t) const { return Vec2(image->point(t)); }
};

TubeLine line_on(const Contour& contour, std::vector<OnPart> parts) {
  TubeLine line;
  line.curve = contour_approximation(contour.curve);
  for (OnPart& on : parts) {
    on.image = contour_approximation(contour.curve, *on.part.surface, on.image);
    line.places = std::max(line.places, static_cast<int>(on.boundary.tube().sweep().cells().size()));
    line.outward.push_back([on](double t) { return on.map.normal(on.boundary.outward(on.part, on.place(t))); });
  }
  line.is_exposed = [parts = std::move(parts)](double t, double beside) {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const OnPart& on) { return on.boundary.is_exposed(on.part, on.place(t), beside); });
  };
  return line;
}

}  // namespace

TubeBoundary::TubeBoundary(const Tube& tube) : tube_(tube), size_(tube.bounds().diameter()) {
  add_walls();
  if (!tube.sweep().curve().is_closed() && tube.caps() != Caps::round) add_flat_ends();
}

void TubeBoundary::add_walls() {
  const BallSweep& sweep = tube_.sweep();
  const Curve& curve = sweep.curve();
  const std::vector<CurvePiece> pieces = curve.pieces();
  const bool has_round_ends = !curve.is_closed() && tube_.caps() == Caps::round;
  const auto direction = [&](double t) { return glm::normalize(sweep.ball(t).center[1]); };
  if (has_round_ends) add_ball({}, curve.domain().lo);
  double from = curve.domain().lo;
  for (size_t k = 0; k < pieces.size(); ++k) {
    const bool last = k + 1 == pieces.size();
    const double to = last ? curve.domain().hi : pieces[k].domain.hi, before = next_down(to);
    const double after = last ? curve.domain().lo : to;
    const bool is_end = last && !curve.is_closed();
    const bool turns = !is_end && !(glm::length(direction(before) - direction(after)) <= kSmoothWall);
    if (turns && is_corner(sweep, before, after)) add_ball(before, after);
    if (!last && !turns) continue;
    try {
      const auto wall = std::make_shared<CanalSurface>(sweep, Interval{from, to}, !turns);
      parts_.push_back({wall, wall, {}, {}, -1});
    } catch (const FieldError&) {
      without_wall_.emplace_back(from, to);
    }
    from = to;
  }
  if (has_round_ends) add_ball(next_down(curve.domain().hi), {});
}

void TubeBoundary::add_ball(std::optional<double> before, std::optional<double> after) {
  const BallJet ball = tube_.sweep().ball(after ? *after : *before);
  const double speed = glm::length(ball.center[1]);
  const Frame along = frame_about(Vec3(0), speed > 0 ? ball.center[1] / speed : Vec3(0, 0, 1));
  const Frame frame =
      frame_about(ball.center[0], glm::normalize(kPole.x * along.x + kPole.y * along.y + kPole.z * along.z));
  parts_.push_back({std::make_shared<SphereSurface>(frame, ball.radius[0]), nullptr, before, after, -1});
}

void TubeBoundary::add_flat_ends() {
  const auto& cells = tube_.sweep().cells();
  for (int side = 0; side < 2; ++side) {
    const Tube::End& end = tube_.end(side);
    double reach = tube_.sweep().ball(side == 0 ? cells.front().t.lo : next_down(cells.back().t.hi)).radius[0];
    for (int cell = end.begin; cell < end.end; ++cell)
      reach = std::max(reach, 0.5 * cells[static_cast<size_t>(cell)].box.diameter());
    const auto plane =
        std::make_shared<Plane>(frame_about(end.point, -end.inward), Rectangle{{-reach, reach}, {-reach, reach}});
    parts_.push_back({plane, nullptr, {}, {}, side});
  }
}

Vec3 TubeBoundary::outward(const Part& part, const Vec2& place) const {
  return part.wall ? part.wall->outward(place.x, place.y) : part.surface->normal(place.x, place.y);
}

// By what a part itself ends at: flat ends, and of a ball the walls on its sides, n . c' >= -R' before and n . c' <=
// -R' after it.
bool TubeBoundary::is_cut_off(const Part& part, const Vec2& place) const {
  if (part.end >= 0) return false;
  const Vec3 p = part.surface->point(place.x, place.y);
  if (part.wall) return tube_.is_cut_off(p, place.x);
  const Vec3 n = outward(part, place);
  for (const auto& [t, sign] : {std::pair(part.before, 1.0), std::pair(part.after, -1.0)}) {
    if (!t) continue;
    const BallJet ball = tube_.sweep().ball(*t);
    if (sign * (glm::dot(n, ball.center[1]) + ball.radius[1]) < 0 || tube_.is_cut_off(p, *t)) return true;
  }
  return false;
}

bool TubeBoundary::is_exposed(const Part& part, const Vec2& place, double beside) const {
  if (part.end >= 0 && tube_.caps() == Caps::none) return false;
  const Vec3 p = part.surface->point(place.x, place.y), by = beside * size_ * outward(part, place);
  return !is_cut_off(part, place) && !tube_.holds(p + by) && (part.end < 0 || tube_.holds(p - by));
}

// Whether a point of a flat end's plane is in one of the balls that the plane cuts.
bool TubeBoundary::is_on_end(int side, const Vec3& p) const {
  constexpr int kPlaces = 64;
  if (tube_.caps() == Caps::none) return false;
  const BallSweep& sweep = tube_.sweep();
  const auto holds = [&](double t) {
    const BallJet ball = sweep.ball(t);
    return glm::length(p - ball.center[0]) <= ball.radius[0];
  };
  const Interval domain = sweep.curve().domain();
  bool is_in = holds(side == 0 ? domain.lo : next_down(domain.hi));
  const Tube::End& end = tube_.end(side);
  for (int cell = end.begin; cell < end.end && !is_in; ++cell) {
    const Interval& t = sweep.cells()[static_cast<size_t>(cell)].t;
    for (int k = 0; k < kPlaces && !is_in; ++k) is_in = holds(t.lo + t.width() * k / kPlaces);
  }
  return is_in;
}

bool TubeBoundary::is_exposed_edge(const Part& a, const Vec2& at_a, const Part& b, const Vec2& at_b,
                                   double beside) const {
  const Vec3 n = outward(a, at_a) + outward(b, at_b), p = a.surface->point(at_a.x, at_a.y);
  const double length = glm::length(n);
  if (!(length > 0) || is_cut_off(a, at_a) || is_cut_off(b, at_b)) return false;
  for (const Part* part : {&a, &b})
    if (part->end >= 0 && !is_on_end(part->end, p)) return false;
  return !tube_.holds(p + beside * size_ / length * n);
}

ShapeOutlines TubeBoundary::intersection(const SurfacePtr& surface, const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete();
  const Box3 box = bounds(*surface);
  for (const Part& part : parts_) {
    if (!BoxTree::meets(bounds(*part.surface), box)) continue;
    const Contours contours = intersect(part.surface, surface);
    found.complete = found.complete && contours.complete;
    for (const Contour& contour : contours.branches) {
      TubeLine line = line_on(contour, {{*this, part, {}, contour.images[0]}});
      line.image = contour_approximation(contour.curve, *surface, contour.images[1]);
      add_bare(line, view, found);
    }
  }
  return found;
}

ShapeOutlines TubeBoundary::intersection(const ImplicitFormula& formula, const Affine& to_formula,
                                         const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete();
  for (const Part& part : parts_) {
    const Contours contours = level_section(part.surface, formula, to_formula);
    found.complete = found.complete && contours.complete;
    for (const Contour& contour : contours.branches)
      add_bare(line_on(contour, {{*this, part, {}, contour.images[0]}}), view, found);
  }
  return found;
}

ShapeOutlines TubeBoundary::intersection(const TubeBoundary& other, const Affine& from_other,
                                         const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete() && other.complete();
  for (const Part& theirs : other.parts_) {
    const SurfacePtr moved = transformed(theirs.surface, from_other);
    const Box3 box = bounds(*moved);
    for (const Part& part : parts_) {
      if (!BoxTree::meets(bounds(*part.surface), box)) continue;
      const Contours contours = intersect(part.surface, moved);
      found.complete = found.complete && contours.complete;
      for (const Contour& contour : contours.branches)
        add_bare(
            line_on(contour, {{*this, part, {}, contour.images[0]}, {other, theirs, from_other, contour.images[1]}}),
            view, found);
    }
  }
  return found;
}

}  // namespace lekalo::geometry
