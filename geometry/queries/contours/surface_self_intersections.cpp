// The parameter domain is halved into pairs of cells. A pair whose images are apart is done; one on whose hull the
// surface is one-to-one holds only trivial solutions; one that does not touch, across joined borders either, has two
// different places, and its solutions are the intersections of two surfaces
// (geometry/queries/contours/contour_equations.h). What is left are pairs that touch, down to the least cells: there
// the surface is pinched (Whitney's umbrella), or has a pole.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/analytic/profile_sections.h"
#include "geometry/queries/contours/contour_assembly.h"
#include "geometry/queries/contours/surface_joints.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/queries/intersections/curve_pair.h"
#include "geometry/queries/intersections/self_intersections.h"

namespace lekalo::geometry {

namespace {

// Cells are not halved in the middle: surfaces are symmetric, and double curves would run along the borders of cells.
constexpr double kCut = 0.4871;
constexpr double kOwnChange = 0.25;
// Parts of the surface's size.
constexpr double kMinCell = 3e-4;
constexpr double kRounding = 1e-15;
constexpr double kNearPole = 1e-5, kNearPinch = 1e-4;
constexpr double kJoined = 1e-10;
// Of the square of a cell's part of the size.
constexpr double kMinOfSquare = 1e-3;
// Of the domain's sides: cells that are nearer touch; places that are nearer are one at a pinch point.
constexpr double kTouch = 1e-12;
constexpr double kSamePlace = 1e-4, kNearPlace = 5e-3;
// Pairs of one size that touch and are not known to be one-to-one; more for each piece.
constexpr int kMaxPairs = 4000, kPairsOfPiece = 40;

struct Cell {
  Rectangle box;
  Box3 image;
  double extent = 0;                  // of the image, at most
  double weight_u = 0, weight_v = 0;  // the side with the larger one is halved
};
using CellPair = std::pair<Cell, Cell>;

double largest_length(const Box3& box) { return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))); }

bool touch(const Interval& a, const Interval& b, double by) { return a.lo - by <= b.hi && b.lo - by <= a.hi; }

double weight(const Cell& cell) { return std::max(cell.weight_u, cell.weight_v); }

ParameterPoint<4> swapped(const ParameterPoint<4>& x) { return {x[2], x[3], x[0], x[1]}; }

class SelfIntersection {
 public:
  SelfIntersection(SurfacePtr surface, double tolerance)
      : surface_(std::move(surface)),
        domain_(surface_->domain()),
        size_(std::max(bounds(*surface_).diameter(), 1e-300)),
        tolerance_(tolerance * size_),
        joints_(*surface_, kJoined * size_),
        assembly_(size_, tolerance_,
                  {closed_periods(*surface_).u, closed_periods(*surface_).v, closed_periods(*surface_).u,
                   closed_periods(*surface_).v}) {}

  Contours run() {
    std::vector<Cell> cells;
    for (const SurfacePiece& piece : surface_->pieces()) cells.push_back(cell(piece.domain));
    const size_t most = kMaxPairs + kPairsOfPiece * cells.size();
    std::vector<CellPair> level;
    for (size_t a = 0; a < cells.size(); ++a)
      for (size_t b = a; b < cells.size(); ++b) visit({cells[a], cells[b]}, level);
    bool complete = true;
    while (!level.empty() && complete) {
      complete = level.size() <= most;
      std::vector<CellPair> next;
      if (complete)
        for (const CellPair& pair : level) divide(pair, next);
      level = std::move(next);
    }
    Contours found = assembly_.joined();
    found.complete = found.complete && complete;
    for (Contour& branch : found.branches) branch = with_steady_images(branch, found.points);
    for (ContourPoint& point : found.points)
      if (const Pinch* pinch = pinch_at(point)) {
        point.point = pinch->point;
        point.parameters = {pinch->place.begin(), pinch->place.end()};
      }
    std::erase_if(found.points, [&](const ContourPoint& point) { return is_trivial(point); });
    for (ContourPoint& point : found.points) {
      const std::vector<double>& x = point.parameters;
      point.distance = glm::length(surface_->point(x[0], x[1]) - surface_->point(x[2], x[3]));
    }
    return found;
  }

 private:
  struct Pinch {
    Vec3 point;
    ParameterPoint<4> place;
  };

  // Beside how far a parameter moves the image it counts how much it changes its own tangent: where that vanishes at a
  // pinch point, r_v = 0 and r_vv != 0, cells that are no larger in v than in u are needed to tell places apart. Where
  // it vanishes all along a line, as at a pole, r_vv does too.
  Cell cell(const Rectangle& box) const {
    const SurfaceEnclosure s = surface_->enclose(box, 2);
    const double extent_u = largest_length(s.d(1, 0)) * box.u.width(),
                 extent_v = largest_length(s.d(0, 1)) * box.v.width();
    const double change_u = kOwnChange * largest_length(s.d(2, 0)) * box.u.width() * domain_.u.width(),
                 change_v = kOwnChange * largest_length(s.d(0, 2)) * box.v.width() * domain_.v.width();
    return {box, s.d(0, 0), std::max(extent_u, extent_v), std::max(extent_u, change_u), std::max(extent_v, change_v)};
  }

  void visit(const CellPair& pair, std::vector<CellPair>& undecided) {
    const auto& [a, b] = pair;
    if (!are_near(a.image, b.image, tolerance_)) return;
    bool touching = false;
    for (const DomainMotion& motion : joints_.motions()) {
      const Rectangle moved = motion.of(b.box);
      if (!touch(a.box.u, moved.u, kTouch * domain_.u.width()) || !touch(a.box.v, moved.v, kTouch * domain_.v.width()))
        continue;
      touching = true;
      // Then r(p) = r(q) only where the motion takes q to p: that is one place.
      if (joints_.is_one_to_one({hull(a.box.u, moved.u), hull(a.box.v, moved.v)}, known_)) return;
    }
    if (!touching)
      search(a, b);
    else if (std::max(a.extent, b.extent) <= kMinCell * size_)
      add_pinch(a, b);
    else
      undecided.push_back(pair);
  }

  void search(const Cell& a, const Cell& b) {
    // Near a pinch point, where the image of a cell is as narrow in one direction as the square of its length, and the
    // sheets stand at an angle like its length.
    const double part = std::min(a.extent, b.extent) / size_;
    PieceSearch<4> search;
    search.left_to_neighbour = {is_continued_u(a.box), is_continued_v(a.box), is_continued_u(b.box),
                                is_continued_v(b.box)};
    search.least = kMinOfSquare * part * part * size_;
    search.rounding_of_places = std::max(search.rounding_of_places, kRounding / (part * part * part));
    assembly_.add(equations(a.box, b.box), search);
  }

  void divide(const CellPair& pair, std::vector<CellPair>& undecided) {
    const auto& [a, b] = pair;
    const bool is_same = a.box.u == b.box.u && a.box.v == b.box.v;
    if (is_same) {
      const auto [lower, upper] = halves(a);
      visit({lower, lower}, undecided);
      visit({upper, upper}, undecided);
      visit({lower, upper}, undecided);
    } else if (weight(a) >= weight(b)) {
      const auto [lower, upper] = halves(a);
      visit({lower, b}, undecided);
      visit({upper, b}, undecided);
    } else {
      const auto [lower, upper] = halves(b);
      visit({a, lower}, undecided);
      visit({a, upper}, undecided);
    }
  }

  std::pair<Cell, Cell> halves(const Cell& whole) {
    Rectangle lower = whole.box, upper = whole.box;
    const bool of_u = whole.weight_u >= whole.weight_v;
    const Interval& side = of_u ? whole.box.u : whole.box.v;
    const double at = side.lo + kCut * side.width();
    (of_u ? lower.u : lower.v).hi = at;
    (of_u ? upper.u : upper.v).lo = at;
    return {cell(lower), cell(upper)};
  }

  bool is_continued_u(const Rectangle& box) const { return box.u.hi < domain_.u.hi || joints_.goes_on_u(); }
  bool is_continued_v(const Rectangle& box) const { return box.v.hi < domain_.v.hi || joints_.goes_on_v(); }

  std::unique_ptr<ContourEquations<4>> equations(const Rectangle& a, const Rectangle& b) const {
    return intersection_equations(surface_, a, surface_, b);
  }

  static Rectangle with(const Rectangle& box, const Vec2& place) {
    return {hull(box.u, Interval(place.x)), hull(box.v, Interval(place.y))};
  }

  bool are_near_places(const Vec2& a, const Vec2& b) const {
    return std::abs(a.x - b.x) <= kNearPlace * domain_.u.width() &&
           std::abs(a.y - b.y) <= kNearPlace * domain_.v.width();
  }

  // Curves may end here, where r_u x r_v = 0 (Whitney 1944): by Gauss's and Newton's iteration.
  void add_pinch(const Cell& a, const Cell& b) {
    const Vec2 start{a.box.u.middle(), a.box.v.middle()};
    Vec2 x = start;
    bool converged = false;
    for (int step = 0; step < 20 && !converged; ++step) {
      const SurfaceJet s = evaluate_within(*surface_, domain_, x.x, x.y, 2);
      const Vec3 f = glm::cross(s.du(), s.dv());
      const Vec3 f_u = glm::cross(s.duu(), s.dv()) + glm::cross(s.du(), s.duv());
      const Vec3 f_v = glm::cross(s.duv(), s.dv()) + glm::cross(s.du(), s.dvv());
      std::array<std::array<double, 3>, 2> inverse;
      if (!root_search::solve_for<2, 3>({{{f_u.x, f_v.x}, {f_u.y, f_v.y}, {f_u.z, f_v.z}}}, inverse)) break;
      Vec2 by{0};
      for (int k = 0; k < 3; ++k) by -= f[k] * Vec2(inverse[0][k], inverse[1][k]);
      x += by;
      if (!domain_.contains(x.x, x.y) || !are_near_places(x, start)) break;
      converged = std::abs(by.x) <= 1e-14 * domain_.u.width() && std::abs(by.y) <= 1e-14 * domain_.v.width();
    }
    if (!converged) x = start;
    // Across a joined border the second place is that of its cell.
    Vec2 y{b.box.u.clamp(x.x), b.box.v.clamp(x.y)};
    if (are_near_places(x, y)) y = x;
    const ParameterPoint<4> place{x.x, x.y, y.x, y.y};
    assembly_.add_end(equations(with(a.box, x), with(b.box, y)), place);
    pinches_.push_back({surface_->point(x.x, x.y), place});
  }

  // Of a point where curves end: it is the pinch point near it.
  const Pinch* pinch_at(const ContourPoint& point) const {
    const Pinch* best = nullptr;
    double nearest = kNearPinch * size_;
    for (const Pinch& pinch : pinches_)
      if (const double apart = glm::length(pinch.point - point.point); apart <= nearest) nearest = apart, best = &pinch;
    return point.kind == ContourPointKind::end ? best : nullptr;
  }

  // The last bit to a pinch point, where the pairs of cells touch, reaches from the end of the arc to the point.
  void lead_to_pinch(ContourSegment<4>& segment, const std::vector<ContourPoint>& points) const {
    for (const ContourPoint& point : points) {
      const Pinch* pinch = pinch_at(point);
      if (!pinch || (segment.from != point.point && segment.to != point.point)) continue;
      const bool ends = segment.to == point.point;
      (ends ? segment.to : segment.from) = pinch->point;
      (ends ? segment.end : segment.begin) = pinch->place;
      const ParameterBox<4> box = segment.equations->domain();
      segment.equations = equations(with({box[0], box[1]}, {pinch->place[0], pinch->place[1]}),
                                    with({box[2], box[3]}, {pinch->place[2], pinch->place[3]}));
    }
  }

  // Not a place where two of the surface meet: a pole, or one place across a border.
  bool is_trivial(const ContourPoint& point) const {
    if (point.kind != ContourPointKind::contact) return false;
    const Vec2 a{point.parameters[0], point.parameters[1]}, b{point.parameters[2], point.parameters[3]};
    if (joints_.is_same_place(a, b, kSamePlace)) return true;
    const DegenerateEdges poles = surface_->degenerate_edges();
    const auto near_pole = [&](bool is_pole, bool of_u, double at) {
      const auto apart = [&](const Vec2& x) {
        const Vec3 pole = of_u ? surface_->point(at, x.y) : surface_->point(x.x, at);
        const double side = of_u ? domain_.u.width() : domain_.v.width();
        return std::max(glm::length(pole - point.point) / (kNearPole * size_),
                        std::abs((of_u ? x.x : x.y) - at) / (1e-3 * side));
      };
      return is_pole && apart(a) <= 1 && apart(b) <= 1;
    };
    return near_pole(poles.u_min, true, domain_.u.lo) || near_pole(poles.u_max, true, domain_.u.hi) ||
           near_pole(poles.v_min, false, domain_.v.lo) || near_pole(poles.v_max, false, domain_.v.hi);
  }

  // The pairs of cells say which place is the first by chance: it stays the first along the branch.
  Contour with_steady_images(const Contour& contour, const std::vector<ContourPoint>& points) {
    const auto* curve = dynamic_cast<const ContourCurve<4>*>(contour.curve.get());
    std::vector<ContourSegment<4>> segments = curve->solution().segments();
    const std::array<double, 2> periods{closed_periods(*surface_).u, closed_periods(*surface_).v};
    const auto steps = [&](const ParameterPoint<4>& from, const ParameterPoint<4>& to) {
      return joints_.apart({from[0], from[1]}, {to[0], to[1]}) + joints_.apart({from[2], from[3]}, {to[2], to[3]});
    };
    std::map<const ContourEquations<4>*, std::shared_ptr<const ContourEquations<4>>> turned;
    for (size_t k = 0; k < segments.size(); ++k) {
      ContourSegment<4>& segment = segments[k];
      segment.shift = {};
      if (!segment.is_certified()) lead_to_pinch(segment, points);
      if (k == 0) continue;
      const ContourSegment<4>& before = segments[k - 1];
      if (steps(before.end, swapped(segment.begin)) < steps(before.end, segment.begin)) {
        std::shared_ptr<const ContourEquations<4>>& other = turned[segment.equations.get()];
        const ParameterBox<4> box = segment.equations->domain();
        if (!other) other = equations({box[2], box[3]}, {box[0], box[1]});
        segment.equations = other;
        segment.begin = swapped(segment.begin), segment.end = swapped(segment.end);
        segment.tube = {segment.tube[2], segment.tube[3], segment.tube[0], segment.tube[1]};
      }
      for (int i = 0; i < 4; ++i)
        if (periods[i % 2] > 0)
          segment.shift[i] =
              periods[i % 2] * std::round((before.end[i] + before.shift[i] - segment.begin[i]) / periods[i % 2]);
    }
    const auto solution = std::make_shared<const ContourSolution<4>>(std::move(segments), contour.closed);
    Contour result = contour;
    result.curve = std::make_shared<ContourCurve<4>>(solution);
    result.images = {std::make_shared<ContourImage<4>>(solution, 0), std::make_shared<ContourImage<4>>(solution, 2)};
    return result;
  }

  const SurfacePtr surface_;
  const Rectangle domain_;
  const double size_, tolerance_;  // lengths
  const SurfaceJoints joints_;
  ContourAssembly<4> assembly_;
  KnownEnclosures known_;
  std::vector<Pinch> pinches_;
};

}  // namespace

Contours self_intersection(const SurfacePtr& surface, double tolerance) {
  if (!surface->bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
  const auto of_profile = profile_self_intersection(surface, tolerance);
  Contours found = of_profile ? *of_profile : SelfIntersection(surface, tolerance).run();
  const SteppedParts stepped = parts_between_steps(surface);
  found.complete = found.complete && stepped.known && stepped.parts.empty();
  return found;
}

}  // namespace lekalo::geometry
