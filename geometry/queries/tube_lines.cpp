#include "geometry/queries/tube_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/curves/curve_part.h"
#include "geometry/describe.h"
#include "geometry/queries/ball_circles.h"
#include "geometry/queries/box_tree.h"
#include "geometry/queries/contour_approximation.h"
#include "geometry/shapes/implicit_formula.h"
#include "geometry/surfaces/plane.h"
#include "geometry/surfaces/sphere.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Unit tangents of a wall's pieces differ by no more than this where they meet.
constexpr double kSmoothWall = 1e-8;
// Poles of balls stand so to the curve: where no symmetry puts a contour.
const Vec3 kPole{0.31, 0.17, 1};
constexpr int kPlaces = 64;
// Parts of half a stretch by which its end is moved.
constexpr double kFirstStep = 1e-14, kLongestStep = 0.01;

using Part = TubeBoundary::Part;

// A line found on a surface, before what is inside of tubes is cut away.
class Cutting {
 public:
  // On a part of a tube, whose coordinates the map leads from.
  struct Side {
    const TubeBoundary& boundary;
    const Part& part;
    Affine map;
    Curve2Ptr image;

    Vec2 place(double t) const { return Vec2(image->point(t)); }
  };

  Cutting(const Contour& contour, std::vector<Side> sides, const ViewOf& view)
      : curve_(contour_approximation(contour.curve)), sides_(std::move(sides)), view_(view) {
    for (Side& side : sides_) {
      side.image = contour_approximation(contour.curve, *side.part.surface, side.image);
      places_ = std::max(places_, static_cast<int>(side.boundary.tube().sweep().cells().size()));
    }
  }

  // Adds what of it lies on the boundaries of all its tubes.
  void add_bare(const Curve2Ptr& image, ShapeOutlines& found) const {
    add_where(
        [this](double t, double beside) {
          return std::all_of(sides_.begin(), sides_.end(),
                             [&](const Side& side) { return side.boundary.is_bare(side.part, side.place(t), beside); });
        },
        image, found);
  }

  // Adds what of it is an edge of the one tube on two parts of which it lies.
  void add_edges(ShapeOutlines& found) const {
    const Side &a = sides_[0], &b = sides_[1];
    add_where([&](double t,
                  double beside) { return a.boundary.is_bare_edge(a.part, a.place(t), b.part, b.place(t), beside); },
              nullptr, found);
  }

 private:
  template <class State>
  void add_where(const State& state, const Curve2Ptr& image, ShapeOutlines& found) const {
    const Interval all = curve_->domain();
    each_stretch(
        all, places_, [&](double t) { return state(t, kBesideBalls); },
        [&](Interval t, bool bare) {
          if (!bare) return;
          if (t.lo > all.lo) t.lo = settled(t.lo, t.middle(), state);
          if (t.hi < all.hi) t.hi = settled(t.hi, t.middle(), state);
          ShapeOutline line{curve_, true, nullptr, {}, image};
          if (t.width() < all.width()) line.curve = std::make_shared<CurvePart>(curve_, t);
          for (const Side& side : sides_) add_turns(side, t, line.turns);
          std::sort(line.turns.begin(), line.turns.end());
          found.lines.push_back(std::move(line));
        });
  }

  // The end of a stretch as it would be seen from the surface itself: from half as far outside it is half as far off.
  template <class State>
  double settled(double end, double inside, const State& state) const {
    const auto is_bare = [&](double t) { return state(t, 0.5 * kBesideBalls); };
    const double most = kLongestStep * (inside - end);
    double covered = end, bare = end;
    for (double step = kFirstStep * (inside - end); covered == bare; step *= 2) {
      if (std::abs(step) > std::abs(most)) return end;
      if (is_bare(end + step)) bare = end + step;
    }
    for (double middle = 0.5 * (covered + bare); std::min(covered, bare) < middle && middle < std::max(covered, bare);
         middle = 0.5 * (covered + bare))
      (is_bare(middle) ? bare : covered) = middle;
    return end + 2 * (bare - end);
  }

  void add_turns(const Side& side, const Interval& range, std::vector<double>& turns) const {
    const auto faces_viewer = [&](double t) {
      const Vec3 n = side.map.normal(side.boundary.outward(side.part, side.place(t)));
      return glm::dot(n, view_.central ? curve_->point(t) - view_.direction_or_eye : view_.direction_or_eye) < 0;
    };
    each_stretch(range, kPlaces, faces_viewer, [&](const Interval& part, bool) {
      if (part.lo > range.lo) turns.push_back(part.lo);
    });
  }

  CurvePtr curve_;
  std::vector<Side> sides_;
  const ViewOf& view_;
  int places_ = kPlaces;
};

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
      complete_ = false;
    }
    from = to;
  }
  if (has_round_ends) add_ball(next_down(curve.domain().hi), {});
}

void TubeBoundary::add_ball(std::optional<double> before, std::optional<double> after) {
  const BallJet ball = tube_.sweep().ball(after ? *after : *before);
  const Frame along = frame_about(Vec3(0), glm::normalize(ball.center[1]));
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

bool TubeBoundary::is_bare(const Part& part, const Vec2& place, double beside) const {
  if (part.end >= 0 && tube_.caps() == Caps::none) return false;
  const Vec3 p = part.surface->point(place.x, place.y), by = beside * size_ * outward(part, place);
  return !is_cut_off(part, place) && !tube_.holds(p + by) && (part.end < 0 || tube_.holds(p - by));
}

bool TubeBoundary::is_bare_edge(const Part& a, const Vec2& at_a, const Part& b, const Vec2& at_b, double beside) const {
  const Vec3 n = outward(a, at_a) + outward(b, at_b);
  const double length = glm::length(n);
  if (!(length > 0) || is_cut_off(a, at_a) || is_cut_off(b, at_b)) return false;
  return !tube_.holds(a.surface->point(at_a.x, at_a.y) + beside * size_ / length * n);
}

ShapeOutlines TubeBoundary::meeting(const SurfacePtr& surface, const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete_;
  const Box3 box = bounds(*surface);
  for (const Part& part : parts_) {
    if (!BoxTree::meets(bounds(*part.surface), box)) continue;
    const Contours contours = intersect(part.surface, surface);
    found.complete = found.complete && contours.complete;
    for (const Contour& contour : contours.branches)
      Cutting(contour, {{*this, part, {}, contour.images[0]}}, view).add_bare(contour.images[1], found);
  }
  return found;
}

ShapeOutlines TubeBoundary::meeting(const ImplicitFormula& formula, const Affine& to_formula,
                                    const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete_;
  for (const Part& part : parts_) {
    const Contours contours = level_section(part.surface, formula, to_formula);
    found.complete = found.complete && contours.complete;
    for (const Contour& contour : contours.branches)
      Cutting(contour, {{*this, part, {}, contour.images[0]}}, view).add_bare(nullptr, found);
  }
  return found;
}

ShapeOutlines TubeBoundary::meeting(const TubeBoundary& other, const Affine& from_other, const ViewOf& view) const {
  ShapeOutlines found;
  found.complete = complete_ && other.complete_;
  for (const Part& theirs : other.parts_) {
    const SurfacePtr moved = transformed(theirs.surface, from_other);
    const Box3 box = bounds(*moved);
    for (const Part& part : parts_) {
      if (!BoxTree::meets(bounds(*part.surface), box)) continue;
      const Contours contours = intersect(part.surface, moved);
      found.complete = found.complete && contours.complete;
      for (const Contour& contour : contours.branches)
        Cutting(contour, {{*this, part, {}, contour.images[0]}, {other, theirs, from_other, contour.images[1]}}, view)
            .add_bare(nullptr, found);
    }
  }
  return found;
}

void TubeBoundary::add_edges(const Contour& contour, const Part& a, const Part& b, const ViewOf& view,
                             ShapeOutlines& found) const {
  Cutting(contour, {{*this, a, {}, contour.images[0]}, {*this, b, {}, contour.images[1]}}, view).add_edges(found);
}

}  // namespace lekalo::geometry
