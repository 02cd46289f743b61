// The edges along which a tube goes through itself (declared in tube_lines.h).
//
// Walls meet one another, balls and flat ends. A wall does not meet itself along stretches that are shorter than a
// length L, so that pairs of longer stretches are enough. By the length s, with k the largest curvature of the curve:
//
// - For a constant radius R < 1/k everywhere L is as far as the tangent T turns by pi in all, whatever the curvature is
//   where. If balls at a and b touched a point p, c(b) - c(a) = R (n(a) - n(b)) with n across T. With w = T half way by
//   the turning angle x, which goes from -y to y, its product with w would be at most 2 R sin y; but it is the integral
//   of T . w ds, more than that of R cos x dx, which is 2 R sin y (after Schur: do Carmo 1976, 5-7).
// - L = 2 ((1 - R'^2 - R R'')/k - R): where two balls touch a point p, |p - c|^2 - R^2 has minima 0, and between them a
//   maximum, where 1 - R'^2 - R R'' <= (p - c) . c'' <= k |p - c|, and p is no farther from c there than R + L/2.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/point_formulas.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/shapes/tube/ball_circles.h"
#include "geometry/shapes/tube/cuspidal_edges.h"
#include "geometry/shapes/tube/tube_lines.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

namespace {

using Cell = BallSweep::Cell;

std::vector<Cell> cells_in(const BallSweep& sweep, const Interval& range) {
  std::vector<Cell> cells;
  for (const Cell& cell : sweep.cells())
    if (intersect(cell.t, range).width() > kSameOnBalls * range.width()) cells.push_back(cell);
  return cells;
}

// Bounds over cells, by the length.
struct Bounds {
  double curvature = 0, radius = 0, slope = 0, bulge = 0;  // bulge: of R R''
  bool constant = true;                                    // of the radius
  bool bends_less = true, bends_more = false;  // curvature times radius: below 1 everywhere, above somewhere
  std::vector<double> lengths, turns;          // of the cells, at most

  Bounds(const BallSweep& sweep, const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
      lengths.push_back(0), turns.push_back(0);
      for (int k = 0; k < kParts; ++k)
        add(sweep, cell, cell.t.lo + k * cell.t.width() / kParts, 0.5 * cell.t.width() / kParts, kHalvings);
    }
  }
  // What of each cell adds up to L above, and L; 0 where there is none.
  bool is_by_turns() const { return constant && bends_less; }
  const std::vector<double>& steps() const { return is_by_turns() ? turns : lengths; }
  double safe_length() const {
    if (is_by_turns()) return kPi;
    const double safe = 2 * ((1 - slope * slope - bulge) / curvature - radius);
    return safe > 0 ? safe : 0;
  }

 private:
  // Cells are too wide for good bounds.
  static constexpr int kParts = 4;
  // Of a part on which the curvature is not known to be small enough.
  static constexpr int kHalvings = 12;
  void add(const BallSweep& sweep, const Cell& cell, double from, double h, int halvings) {
    const BallJet middle = sweep.ball(from + h);
    const Vec3 &r1 = middle.center[1], &r2 = middle.center[2];
    const Box3 box = sweep.curve().enclose({from, std::min(from + 2 * h, cell.t.hi)}, 2).d[2];
    const double variation_bound = glm::length(glm::max(box.hi - r2, r2 - box.lo)),
                 most = glm::length(r2) + variation_bound;
    const double speed = glm::length(r1), turn = most * h, slowest = speed - turn;
    const double along = glm::dot(r1, r2) / (speed * speed);
    const double across = glm::length(r2 - along * r1) + variation_bound + std::abs(along) * turn;
    const double R2 = std::abs(cell.middle.radius[2]) + cell.radius_variation_bound,
                 R1 = std::abs(middle.radius[1]) + R2 * h, R = middle.radius[0] + R1 * h;
    // r' x r'' but for what r'' wanders: r' = r1 + x r2 + ..., and r2 x r2 = 0.
    const double product = glm::length(glm::cross(r1, r2)),
                 max_product = product + variation_bound * (h * glm::length(r2) + speed + turn);
    const double length = 2 * h * (speed + turn),
                 bend = slowest > 0 ? std::min(across, max_product / slowest) / (slowest * slowest) : kInfinity;
    if (R1 == 0 && !cell.regular && !(bend * R < 1)) {
      const bool is_more = product * R > speed * speed * speed;
      bends_more = bends_more || is_more;
      if (!is_more && halvings > 0) {
        add(sweep, cell, from, 0.5 * h, halvings - 1);
        add(sweep, cell, from + h, 0.5 * h, halvings - 1);
        return;
      }
    }
    constant = constant && R1 == 0;
    lengths.back() += length;
    turns.back() += length * (cell.regular ? std::min(bend, 1 / R) : bend);
    bends_less = bends_less && (cell.regular || bend * R < 1);
    const auto include = [&](double& bound, double value) { bound = slowest > 0 ? std::max(bound, value) : kInfinity; };
    include(curvature, bend);
    include(radius, R);
    include(slope, R1 / slowest);
    include(bulge, R * (R2 + R1 * most / slowest) / (slowest * slowest));
  }
};

// Of a closed curve, a place beyond the end of its domain.
double in_domain(const Curve& curve, double t) { return curve.is_closed() ? wrapped(t, curve.domain()) : t; }

double apart(const Box3& a, const Box3& b) {
  return glm::length(glm::max(Vec3(0), glm::max(a.lo - b.hi, b.lo - a.hi)));
}

}  // namespace

bool TubeBoundary::bends_too_much(const CanalSurface& wall) const {
  constexpr int kPlaces = 4, kAngles = 24;
  const std::vector<Cell> cells = cells_in(tube_.sweep(), wall.domain().u);
  if (const Bounds along(tube_.sweep(), cells); along.constant) return along.bends_more;
  for (const Cell& cell : cells) {
    if (cell.regular) continue;
    for (int i = 0; i <= kPlaces; ++i)
      for (int k = 0; k < kAngles; ++k) {
        const double u = wall.domain().u.clamp(cell.t.lo + cell.t.width() * i / kPlaces), v = kTwoPi * k / kAngles;
        if (glm::dot(wall.normal(u, v), wall.outward(u, v)) < 0) return true;
      }
  }
  return false;
}

// Pairs of stretches that may meet, each half as long as L at most; nothing where that is not known.
std::optional<std::vector<std::array<Interval, 2>>> TubeBoundary::near_stretches(const Interval& range,
                                                                                 bool closed) const {
  const std::vector<Cell> cells = cells_in(tube_.sweep(), range);
  const Bounds along(tube_.sweep(), cells);
  const double most = 0.5 * along.safe_length();
  const std::vector<double>& steps = along.steps();
  if (!(*std::max_element(steps.begin(), steps.end()) <= most)) return std::nullopt;
  struct Stretch {
    size_t from, to;
  };
  std::vector<Stretch> stretches;
  std::vector<Box3> centers;  // of each cell
  double length = 0;
  for (size_t k = 0; k < cells.size(); ++k) {
    length += steps[k];
    if (k == 0 || length > most) stretches.push_back({k, k}), length = steps[k];
    stretches.back().to = k + 1;
    centers.push_back(cells[k].box.inflated(-cells[k].min_radius));
  }
  const auto are_near = [&](const Stretch& a, const Stretch& b) {
    for (size_t i = a.from; i < a.to; ++i)
      for (size_t k = b.from; k < b.to; ++k)
        if (apart(centers[i], centers[k]) <= cells[i].min_radius + cells[k].min_radius) return true;
    return false;
  };
  const auto range_of = [&](const Stretch& stretch) {
    return Interval{cells[stretch.from].t.lo, cells[stretch.to - 1].t.hi};
  };
  std::vector<std::array<Interval, 2>> pairs;
  for (size_t i = 0; i < stretches.size(); ++i)
    for (size_t k = i + 2; k < stretches.size(); ++k)
      if (!(closed && i == 0 && k + 1 == stretches.size()) && are_near(stretches[i], stretches[k]))
        pairs.push_back({range_of(stretches[i]), range_of(stretches[k])});
  return pairs;
}

void TubeBoundary::add_own_edges(const Part& part, const ViewOf& view, Edges& found) const {
  const auto pairs = near_stretches(part.wall->domain().u, part.wall->periods().u > 0);
  if (!pairs) return add_edges(self_intersection(part.surface), part, part, view, found);
  std::map<double, Part> walls;
  const auto wall_of = [&](const Interval& range) -> const Part& {
    return walls.try_emplace(range.lo, wall_over(range.lo, range.hi)).first->second;
  };
  for (const auto& [first, second] : *pairs) {
    const Part &a = wall_of(first), &b = wall_of(second);
    add_edges(intersect(a.surface, b.surface), a, b, view, found);
  }
}

std::optional<TubeBoundary::Part> TubeBoundary::apart_from(const Part& part, const Part& other) const {
  if (!part.wall) return part;
  const BallSweep& sweep = tube_.sweep();
  const Interval whole = sweep.curve().domain();
  const Interval range = part.wall->domain().u;
  const auto is_one = [&](double a, double b) {
    return std::abs(a - b) <= kSameOnBalls * whole.width() ||
           (sweep.curve().is_closed() && std::abs(std::abs(a - b) - whole.width()) <= kSameOnBalls * whole.width());
  };
  // Where the other part begins and ends.
  std::vector<double> ends;
  if (other.before) ends.push_back(*other.before);
  if (other.after) ends.push_back(*other.after);
  if (other.wall) ends = {other.wall->domain().u.lo, other.wall->domain().u.hi};
  const Interval moving = sweep.moving(whole);
  if (other.end >= 0) ends = {other.end == 0 ? moving.lo : moving.hi};
  const std::vector<Cell> cells = cells_in(sweep, range);
  const int count = static_cast<int>(cells.size());
  int first = 0, last = count;
  for (const double end : ends) {
    const int own = other.end >= 0 ? tube_.end(other.end).end - tube_.end(other.end).begin : 0;  // of a flat end
    if (is_one(range.lo, end)) first = std::max(1, own);
    if (is_one(range.hi, end)) last = count - std::max(1, own);
  }
  if (first == 0 && last == count) return part;
  if (first >= last) return std::nullopt;
  return wall_over(cells[static_cast<size_t>(first)].t.lo, cells[static_cast<size_t>(last - 1)].t.hi);
}

bool TubeBoundary::meet_in_curved_corner(const CanalSurface& a, const CanalSurface& b) const {
  const BallSweep& sweep = tube_.sweep();
  const auto is_corner_between = [&](double before, double after) {
    return is_corner(sweep, next_down(before), after) && !is_straight_corner(sweep, next_down(before), after);
  };
  const Interval whole = sweep.curve().domain(), first = a.domain().u, second = b.domain().u;
  return (first.hi == second.lo && is_corner_between(first.hi, second.lo)) ||
         (sweep.curve().is_closed() && first.lo == whole.lo && second.hi == whole.hi &&
          is_corner_between(second.hi, first.lo));
}

TubeBoundary::Part TubeBoundary::wall_over(double from, double to) const {
  const auto wall = std::make_shared<CanalSurface>(tube_.sweep(), Interval{from, to}, false);
  return {wall, wall, {}, {}, -1};
}

void TubeBoundary::add_edges(const Contours& contours, const Part& a, const Part& b, const ViewOf& view,
                             Edges& found) const {
  found.lines.complete = found.lines.complete && contours.complete;
  for (const Contour& contour : contours.branches) {
    if (contour.kind != ContourKind::crossing) continue;
    const Curve2Ptr on_a = contour_approximation(contour.curve, *a.surface, contour.images[0]),
                    on_b = contour_approximation(contour.curve, *b.surface, contour.images[1]);
    TubeLine line;
    line.curve = contour_approximation(contour.curve);
    line.places = std::max(line.places, static_cast<int>(tube_.sweep().cells().size()));
    line.outward = {[&, on_a](double t) { return outward(a, Vec2(on_a->point(t))); },
                    [&, on_b](double t) { return outward(b, Vec2(on_b->point(t))); }};
    line.is_exposed = [&](double t, double beside) {
      return is_exposed_edge(a, Vec2(on_a->point(t)), b, Vec2(on_b->point(t)), beside);
    };
    add_bare(line, view, found.lines);
  }
}

// Where two balls touch the edge, those kept whose places on the curve are.
TubeLine TubeBoundary::edge_of_balls(const CurvePtr& curve, const std::function<Vec2(double)>& balls,
                                     const std::function<bool(const Vec2&)>& keeps) const {
  const auto normal = [this, curve](double t, double ball) {
    return glm::normalize(curve->point(t) - tube_.sweep().ball(in_domain(tube_.sweep().curve(), ball)).center[0]);
  };
  TubeLine line;
  line.curve = curve;
  line.outward = {[=](double t) { return normal(t, balls(t).x); }, [=](double t) { return normal(t, balls(t).y); }};
  line.is_exposed = [=, this](double t, double beside) {
    const Vec2 both = balls(t);
    if (!keeps(both)) return false;
    const Vec3 p = curve->point(t), n = normal(t, both.x) + normal(t, both.y);
    return !tube_.is_cut_off(p, both.x) && !tube_.is_cut_off(p, both.y) &&
           !tube_.holds(p + beside * size_ * glm::normalize(n));
  };
  return line;
}

// Bends X are stretches of cells on which the wall may be singular, Y these with the cells beside them, W what is
// between bends. Pairs of balls are those of one bend, one of them in X and both in Y (cuspidal_edges.h); one in X and
// the other beyond Y, or in another bend; and those of walls W.
bool TubeBoundary::add_cuspidal_edges(const CanalSurface& wall, const ViewOf& view, Edges& found) const {
  const BallSweep& sweep = tube_.sweep();
  const Interval domain = wall.domain().u;
  const bool closed = wall.periods().u > 0;
  const std::vector<Cell> cells = cells_in(sweep, domain);
  const int count = static_cast<int>(cells.size());
  const auto is_regular = [&](int k) { return cells[static_cast<size_t>((k + count) % count)].regular; };
  const auto begin = [&](int k) { return cells[static_cast<size_t>(k % count)].t.lo + k / count * domain.width(); };
  // The first cell after a bend, of a closed curve.
  int first = 0;
  while (closed && first < count && !(is_regular(first) && !is_regular(first - 1))) ++first;
  if (first == count || (!closed && !(is_regular(0) && is_regular(count - 1)))) return false;
  struct Stretch {
    int from, to;  // cells, which may go on beyond the last
  };
  std::vector<Stretch> bends, between{{first, first}};
  for (int k = first; k < first + count; ++k) {
    if (is_regular(k)) {
      if (between.back().to != k) between.push_back({k, k});
      between.back().to = k + 1;
    } else {
      if (bends.empty() || bends.back().to != k) bends.push_back({k, k});
      bends.back().to = k + 1;
    }
  }
  // Walls over stretches of cells, in two where they go on beyond the end.
  const auto walls = [&](int from, int to) {
    std::vector<Part> parts;
    if (from < count && from < to) parts.push_back(wall_over(begin(from), to < count ? begin(to) : domain.hi));
    if (to > count && from < to) parts.push_back(wall_over(begin(std::max(from, count) - count), begin(to - count)));
    return parts;
  };
  const auto add_pairs = [&](const std::vector<Part>& some, const std::vector<Part>& others) {
    for (const Part& a : some)
      for (const Part& b : others)
        if (BoxTree::meets(bounds(*a.surface), bounds(*b.surface)))
          add_edges(intersect(a.surface, b.surface), a, b, view, found);
  };
  bool all_known = true;
  for (size_t i = 0; i < bends.size(); ++i) {
    const Stretch& bend = bends[i];
    const Interval all{begin(bend.from - 1), begin(bend.to + 1)}, core{begin(bend.from), begin(bend.to)};
    const std::optional<BendEdges> own = bend_edges(sweep, all);
    if (!own) all_known = false;
    found.lines.complete = found.lines.complete && (!own || own->complete);
    const auto keeps = [=](const Vec2& t) {
      return t.x >= all.lo && t.y <= all.hi && (core.contains(t.x) || core.contains(t.y));
    };
    if (own)
      for (const BendEdge& edge : own->edges) add_bare(edge_of_balls(edge.curve, edge.balls, keeps), view, found.lines);
    const std::vector<Part> of_bend = walls(bend.from, bend.to);
    for (size_t k = i + 1; k < bends.size(); ++k) add_pairs(of_bend, walls(bends[k].from, bends[k].to));
    for (const Stretch& other : between)
      add_pairs(of_bend, walls(other.from + (other.from == bend.to || other.from + count == bend.to ? 1 : 0),
                               other.to - (other.to == bend.from || other.to - count == bend.from ? 1 : 0)));
  }
  for (size_t i = 0; i < between.size(); ++i) {
    const std::vector<Part> some = walls(between[i].from, between[i].to);
    for (const Part& part : some) add_own_edges(part, view, found);
    for (size_t k = i + 1; k < between.size(); ++k) add_pairs(some, walls(between[k].from, between[k].to));
    // The two parts of one that goes on beyond the end have a circle in common.
    if (some.size() == 2) {
      const int last = count - 1;
      add_pairs({some[0]}, walls(count + 1, between[i].to));
      add_pairs(walls(between[i].from, last), walls(count, count + 1));
    }
  }
  return all_known;
}

TubeBoundary::Edges TubeBoundary::edges(const ViewOf& view) const {
  Edges found;
  // Where there is no wall it is enough that it would not meet itself.
  for (const Interval& range : without_wall_) {
    const auto pairs =
        near_stretches(range, tube_.sweep().curve().is_closed() && range == tube_.sweep().curve().domain());
    found.all_known = found.all_known && pairs && pairs->empty();
  }
  for (size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.wall && bends_too_much(*part.wall))
      found.all_known = add_cuspidal_edges(*part.wall, view, found) && found.all_known;
    else if (part.wall)
      add_own_edges(part, view, found);
    for (size_t k = i + 1; k < parts_.size(); ++k) {
      const Part& other = parts_[k];
      if (!BoxTree::meets(bounds(*part.surface), bounds(*other.surface))) continue;
      const bool is_crease = part.wall && other.wall && meet_in_curved_corner(*part.wall, *other.wall);
      const std::optional<Part> a = part.wall && other.wall ? part : apart_from(part, other),
                                b = is_crease ? other : apart_from(other, part);
      if (a && b && BoxTree::meets(bounds(*a->surface), bounds(*b->surface)))
        add_edges(intersect(a->surface, b->surface), *a, *b, view, found);
    }
  }
  return found;
}

}  // namespace lekalo::geometry
