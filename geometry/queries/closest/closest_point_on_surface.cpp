// Foot points of a point on a surface (closest_point.h, nearest_on_surface.h).
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/numerics/root_search.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/closest/degenerate_foot_point.h"
#include "geometry/queries/closest/foot_point_polynomials.h"
#include "geometry/queries/closest/nearest_on_surface.h"
#include "geometry/queries/closest/parts_projection.h"
#include "geometry/queries/closest/unbounded_surfaces.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Boxes are not halved below this part of the domain: a double foot point shows as a few of them.
constexpr double kMinBox = 1e-8;
// A derivative below this part of the size over the width of the domain vanishes: a pole.
constexpr double kNoDerivative = 1e-9;
// What is not decided so near to a pole, in parts of the domain, belongs to the pole.
constexpr double kAtPole = 1e-6;
// Foot points nearer than this part of the size are one, seen from both sides of a seam.
constexpr double kSameFootPoint = 1e-11;
// Of products of the way to the surface and its derivatives.
constexpr double kRounding = 1e-15;
// A point is on a line of the surface: rounding of the coordinates.
constexpr double kOnLine = 1e-14;

// (p - s) . s_u = (p - s) . s_v = 0 (Golovanov 2016, (4.2.5)).
struct SurfaceSystem {
  const Vec3& p;
  const Surface& surface;
  Rectangle piece;

  SurfaceJet jet(double u, double v) const { return evaluate_within(surface, piece, u, v, 2); }
  SystemValue<Interval, 2, 2> enclose(const ParameterBox<2>& box) const {
    const SurfaceEnclosure s = surface.enclose({box[0], box[1]}, 2);
    const Box3 &r = s.d(0, 0), &u = s.d(1, 0), &v = s.d(0, 1);
    const Interval mixed = product(p, r, s.d(1, 1)) - product(u, v);
    return {{product(p, r, u), product(p, r, v)},
            {{{product(p, r, s.d(2, 0)) - square(u), mixed}, {mixed, product(p, r, s.d(0, 2)) - square(v)}}}};
  }
  SystemValue<double, 2, 2> evaluate(const ParameterPoint<2>& at) const { return of(jet(at[0], at[1])); }
  SystemValue<double, 2, 2> of(const SurfaceJet& s) const {
    const Vec3 way = p - s.point();
    const double mixed = glm::dot(way, s.duv()) - glm::dot(s.du(), s.dv());
    return {{glm::dot(way, s.du()), glm::dot(way, s.dv())},
            {{{glm::dot(way, s.duu()) - glm::dot(s.du(), s.du()), mixed},
              {mixed, glm::dot(way, s.dvv()) - glm::dot(s.dv(), s.dv())}}}};
  }
};

FootPointKind kind_of(const SystemValue<double, 2, 2>& at) {
  const auto& j = at.derivative;  // minus half the second derivatives of the squared distance
  const double determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  const double scale = std::abs(j[0][0] * j[1][1]) + std::abs(j[0][1] * j[1][0]);
  if (!(std::abs(determinant) > 1e-12 * scale)) return FootPointKind::degenerate;
  if (determinant < 0) return FootPointKind::saddle;
  return j[0][0] < 0 ? FootPointKind::minimum : FootPointKind::maximum;
}

// Whether an edge of the patch shrinks to a point: both equations vanish along it.
bool has_collapsed_edge(const SurfacePiece& piece) {
  const int p = piece.degree_u, q = piece.degree_v;
  const auto at = [&](int i, int j) {
    const Vec4& point = piece.points[i * (q + 1) + j];
    return Vec3(point) / point.w;
  };
  Box3 all;
  std::array<Box3, 4> edges;
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec3 point = at(i, j);
      all.include(point);
      if (i == 0) edges[0].include(point);
      if (i == p) edges[1].include(point);
      if (j == 0) edges[2].include(point);
      if (j == q) edges[3].include(point);
    }
  return std::any_of(edges.begin(), edges.end(),
                     [&](const Box3& edge) { return edge.diameter() <= kNoDerivative * all.diameter(); });
}

struct PreparedSurface {
  struct Piece {
    Rectangle domain;
    ParameterMap map_u, map_v;
    std::optional<FootPointPolynomials> polynomials;
  };
  // An edge of the domain, or a line inside where the tangent plane jumps.
  struct Line {
    bool holds_u;
    double place, below;  // the same line seen from below: across a seam another parameter
    bool has_below, has_above;
    Box3 box;
    std::optional<CurveProjector> foot_points;  // none of a pole
  };
  SurfacePtr surface;
  Rectangle domain;
  DegenerateEdges edges;
  double size;
  std::vector<Piece> pieces;
  std::vector<Line> lines;

  explicit PreparedSurface(SurfacePtr given)
      : surface(std::move(given)),
        domain(surface->domain()),
        edges(surface->degenerate_edges()),
        size(std::max(bounds(*surface).diameter(), 1e-300)) {
    const std::vector<SurfacePiece> given_pieces = surface->pieces();
    for (const SurfacePiece& piece : given_pieces) {
      Piece& own = pieces.emplace_back(Piece{piece.domain, piece.map_u, piece.map_v, {}});
      if (piece.is_rational() && std::min(piece.degree_u, piece.degree_v) > 0 &&
          std::max(piece.degree_u, piece.degree_v) <= FootPointPolynomials::kMaxDegree && !has_collapsed_edge(piece))
        own.polynomials.emplace(piece, Vec3(piece.points[0]) / piece.points[0].w);
    }
    for (const IsoDirection held : {IsoDirection::u, IsoDirection::v}) add_lines(held, given_pieces);
  }

  // The derivative across a line, on the side towards less or greater parameters.
  Vec3 across(bool holds_u, double place, double t, bool below) const {
    const Interval& range = holds_u ? domain.u : domain.v;
    const double beside = below ? within({range.lo, place}, place) : place;
    const SurfaceJet s = holds_u ? surface->evaluate(beside, t, 1) : surface->evaluate(t, beside, 1);
    return holds_u ? s.du() : s.dv();
  }

 private:
  void add_lines(IsoDirection held, const std::vector<SurfacePiece>& given_pieces) {
    const bool holds_u = held == IsoDirection::u;
    const Interval& range = holds_u ? domain.u : domain.v;
    const Interval& other = holds_u ? domain.v : domain.u;
    const Periods periods = surface->periods();
    const double period = holds_u ? periods.u : periods.v;
    const bool periodic = period > 0 && std::abs(period - range.width()) <= kDomainSlack * range.width();
    std::vector<double> places;
    for (const Piece& piece : pieces) places.push_back(holds_u ? piece.domain.u.lo : piece.domain.v.lo);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    places.push_back(range.hi);
    for (size_t k = 0; k < places.size(); ++k) {
      const double place = places[k];
      const bool first = k == 0, last = k + 1 == places.size();
      if (periodic && last) continue;
      Line line{holds_u, place, first ? range.hi : place, !first || periodic, !last, {}, {}};
      const auto jumps = [&](double t) {
        const Vec3 a = across(holds_u, line.below, t, true), b = across(holds_u, place, t, false);
        return glm::length(a - b) > 1e-9 * (glm::length(a) + glm::length(b));
      };
      if (line.has_below && line.has_above) {
        bool crease = false;
        for (int i = 0; i <= 8; ++i) crease = crease || jumps(other.lo + other.width() * i / 8);
        if (!crease) continue;
      }
      const auto curve = std::make_shared<ParameterLine>(surface, held, place);
      line.box = bounds(*curve);
      if (line.box.diameter() > kCollapsedEdge * size)
        line.foot_points.emplace(curve, pieces_along(holds_u, place, last, given_pieces, *curve));
      lines.push_back(std::move(line));
    }
  }

  // As rational pieces if the patches beside the line are.
  static std::vector<CurvePiece> pieces_along(bool holds_u, double place, bool upper,
                                              const std::vector<SurfacePiece>& patches, const Curve& line) {
    std::vector<CurvePiece> result;
    for (const SurfacePiece& patch : patches) {
      const Interval& across = holds_u ? patch.domain.u : patch.domain.v;
      if ((upper ? across.hi : across.lo) != place) continue;
      if (!patch.is_rational()) return line.pieces();
      CurvePiece piece{holds_u ? patch.domain.v : patch.domain.u, holds_u ? patch.map_v : patch.map_u, {}};
      const int p = patch.degree_u, q = patch.degree_v, held = !upper ? 0 : holds_u ? p : q;
      for (int k = 0; k <= (holds_u ? q : p); ++k)
        piece.points.push_back(patch.points[holds_u ? held * (q + 1) + k : k * (q + 1) + held]);
      result.push_back(std::move(piece));
    }
    std::sort(result.begin(), result.end(),
              [](const CurvePiece& a, const CurvePiece& b) { return a.domain.lo < b.domain.lo; });
    return result;
  }
};

// A part of a piece, or all of it, by which the nearest foot point is looked for.
struct NearCell {
  const PreparedSurface::Piece* piece;
  Rectangle part;
  Box3 box;
  Vec3 place;  // one of its points
};

std::vector<NearCell> near_cells(const PreparedSurface& on) {
  constexpr double kCells = 16;  // in each direction, of all the surface
  std::vector<NearCell> cells;
  const int each = std::max(1, static_cast<int>(kCells / std::sqrt(on.pieces.size())));
  for (const PreparedSurface::Piece& piece : on.pieces) {
    const int count = piece.polynomials ? 1 : each;
    const auto part = [&](const Interval& all, int k) {
      return Interval{k == 0 ? all.lo : all.lo + all.width() * k / count,
                      k + 1 == count ? all.hi : all.lo + all.width() * (k + 1) / count};
    };
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        const Rectangle cell{part(piece.domain.u, i), part(piece.domain.v, j)};
        cells.push_back(
            {&piece, cell, on.surface->enclose(cell, 0).d(0, 0), on.surface->point(cell.u.middle(), cell.v.middle())});
      }
  }
  return cells;
}

// All foot points of one point, gathered; or the nearest.
class SurfaceProjection {
 public:
  using Piece = PreparedSurface::Piece;
  using Line = PreparedSurface::Line;
  SurfaceProjection(const Vec3& p, const PreparedSurface& on)
      : p_(p), on_(on), surface_(*on.surface), domain_(on.domain), size_(on.size) {}

  SurfaceFootPoints run() {
    for (const Piece& piece : on_.pieces) search(piece);
    for (const Line& line : on_.lines) add_line(line);
    std::sort(result_.foot_points.begin(), result_.foot_points.end(), is_before);
    return std::move(result_);
  }

  std::optional<SurfaceFootPoint> nearest(const std::vector<NearCell>& cells) {
    double near = kInfinity;
    for (const NearCell& cell : cells) near = std::min(near, glm::length(p_ - cell.place));
    near += kSameFootPoint * size_;
    std::vector<std::pair<double, const NearCell*>> candidates;
    for (const NearCell& cell : cells)
      if (const double away = distance_to(cell.box); away <= near) candidates.emplace_back(away, &cell);
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [away, cell] : candidates) {
      if (away > near) break;
      cell->piece->polynomials ? search(*cell->piece) : search(cell->piece->domain, cell->part);
      for (const SurfaceFootPoint& found : result_.foot_points) near = std::min(near, found.distance);
    }
    for (const Line& line : on_.lines)
      if (distance_to(line.box) <= near) add_line(line);
    const auto first = std::min_element(result_.foot_points.begin(), result_.foot_points.end(), is_before);
    return first == result_.foot_points.end() ? std::nullopt : std::optional(*first);
  }

 private:
  static bool is_before(const SurfaceFootPoint& a, const SurfaceFootPoint& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.u != b.u ? a.u < b.u : a.v < b.v;
  }
  double distance_to(const Box3& box) const {
    return glm::length(glm::max(glm::max(box.lo - p_, p_ - box.hi), Vec3(0)));
  }

  void add(double u, double v, FootPointKind kind) {
    const Vec3 at = surface_.point(u, v);
    for (const SurfaceFootPoint& other : result_.foot_points)
      if (glm::length(other.point - at) <= kSameFootPoint * size_ && are_one(other, u, v)) return;
    result_.foot_points.push_back({u, v, at, glm::length(p_ - at), kind});
  }

  // One place of the parameters, or both sides of a seam: a surface may pass through one point several times.
  bool are_one(const SurfaceFootPoint& a, double u, double v) const {
    const auto near = [](double x, double y, const Interval& range) {
      const double apart = std::abs(x - y) / range.width();
      return apart <= 1e-6 || apart >= 1 - 1e-6;
    };
    return near(a.u, u, domain_.u) && near(a.v, v, domain_.v);
  }

  bool is_singular(const SurfaceJet& s) const {
    return glm::length(s.du()) * domain_.u.width() <= kNoDerivative * size_ ||
           glm::length(s.dv()) * domain_.v.width() <= kNoDerivative * size_;
  }

  // Both equations hold all along an edge that is one point: see add_pole.
  static bool is_at_pole(const Interval& box, const Interval& range, bool pole_below, bool pole_above) {
    const double near = kAtPole * range.width();
    return (pole_below && box.hi <= range.lo + near) || (pole_above && box.lo >= range.hi - near);
  }

  void search(const Piece& piece) {
    SurfaceFootPointZeros zeros;
    if (!piece.polynomials || !piece.polynomials->isolate(p_, zeros)) return search(piece.domain, piece.domain);
    const auto part = [](const Interval& x, const ParameterMap& map, const Interval& domain) {
      const double beside = kBorderSlack * domain.width();
      return intersect(Interval(map.natural_of_bezier(x.lo) - beside, map.natural_of_bezier(x.hi) + beside), domain);
    };
    std::vector<ParameterBox<2>> undecided;
    const auto part_of = [&](const Rectangle& x) {
      return Rectangle{part(x.u, piece.map_u, piece.domain.u), part(x.v, piece.map_v, piece.domain.v)};
    };
    for (const Rectangle& box : zeros.undecided) undecided.push_back({part_of(box).u, part_of(box).v});
    for (const SurfaceFootPointZeros::Single& zero : zeros.single) {
      const Rectangle within = part_of(zero.within);
      if (!polish(piece.domain, within, piece.map_u.natural_of_bezier(zero.near[0]),
                  piece.map_v.natural_of_bezier(zero.near[1])))
        undecided.push_back({within.u, within.v});
    }
    for (const ParameterBox<2>& box : joined_boxes<2>(undecided, {0, 0})) search(piece.domain, {box[0], box[1]});
  }

  // The foot point near (u, v); false if Newton's iteration leads out of the part that holds one.
  bool polish(const Rectangle& piece, const Rectangle& part, double u, double v) {
    const SurfaceSystem system{p_, surface_, piece};
    double before = kInfinity;
    for (int step = 0; step < 20; ++step) {
      const SurfaceJet s = system.jet(u, v);
      const SystemValue<double, 2, 2> there = system.of(s);
      std::array<std::array<double, 2>, 2> inverse;
      if (!root_search::invert<2>(there.derivative, inverse)) return false;
      const double du = inverse[0][0] * there.value[0] + inverse[0][1] * there.value[1],
                   dv = inverse[1][0] * there.value[0] + inverse[1][1] * there.value[1];
      if (!part.contains(u - du, v - dv)) return false;
      u -= du, v -= dv;
      const double length = std::max(std::abs(du) / domain_.u.width(), std::abs(dv) / domain_.v.width());
      if (length <= 1e-15 || (length <= 1e-8 && length > 0.5 * before)) {
        if (!is_singular(s)) add(u, v, kind_of(there));
        return true;
      }
      before = length;
    }
    return false;
  }

  // By intervals.
  void search(const Rectangle& piece, const Rectangle& part) {
    const SurfaceSystem system{p_, surface_, piece};
    RootSearchOptions<2, 2> options;
    options.least = {kMinBox * domain_.u.width(), kMinBox * domain_.v.width()};
    options.slack = {kBorderSlack * domain_.u.width(), kBorderSlack * domain_.v.width()};
    // Many foot points on a border, as those of a torus's middle at v = pi, may lie beyond it by its rounding.
    const double away = glm::length(p_ - surface_.point(part.u.middle(), part.v.middle()));
    const double rounding = kRounding * size_ * (size_ + away);
    options.tolerance = {rounding / domain_.u.width(), rounding / domain_.v.width()};
    const auto found = search_roots<2, 2>(system, ParameterBox<2>{part.u, part.v}, options);
    for (const auto& at : found.isolated)
      if (!is_singular(system.jet(at[0], at[1]))) add(at[0], at[1], kind_of(system.evaluate(at)));
    const DegenerateEdges& edges = on_.edges;
    for (const auto& box : found.open) {
      if (is_at_pole(box[0], domain_.u, edges.u_min, edges.u_max) ||
          is_at_pole(box[1], domain_.v, edges.v_min, edges.v_max))
        continue;
      if (box[0].width() > 1e3 * options.least[0] || box[1].width() > 1e3 * options.least[1])
        result_.regions.push_back({box[0], box[1]});
      const auto [u, v] = degenerate_foot_point(system, piece, box, {domain_.u.width(), domain_.v.width()});
      add(u, v, FootPointKind::degenerate);
    }
  }

  // Edges of the domain, and lines inside where the tangent plane jumps.
  void add_line(const Line& line) {
    if (!line.foot_points)
      return add_pole(line.holds_u, line.place, line.holds_u ? domain_.v : domain_.u, line.has_above);
    for (const CurveFootPoint& foot_point : line.foot_points->foot_points(p_).foot_points) {
      if (foot_point.kind == FootPointKind::maximum) continue;
      const Vec3 way = p_ - foot_point.point;
      const double rounding = 1e-14 * glm::length(way);
      // Of a point on the line the way is rounding, and its direction tells nothing.
      const bool lies_on_line = glm::length(way) <= kOnLine * (size_ + glm::length(p_));
      const auto slope = [&](const Vec3& d) { return glm::dot(way, d) / std::max(glm::length(d), 1e-300); };
      const bool holds_u = line.holds_u;
      if (!lies_on_line && line.has_below && !(slope(on_.across(holds_u, line.below, foot_point.t, true)) > rounding))
        continue;
      if (!lies_on_line && line.has_above && !(slope(on_.across(holds_u, line.place, foot_point.t, false)) < -rounding))
        continue;
      holds_u ? add(line.place, foot_point.t, FootPointKind::border)
              : add(foot_point.t, line.place, FootPointKind::border);
    }
  }

  // All parameters of the edge are one point: a foot point where the way to it is normal to the surface, a border where
  // the distance grows in all directions.
  void add_pole(bool holds_u, double place, const Interval& other, bool begins) {
    const auto jet = [&](double t) {
      return holds_u ? surface_.evaluate(place, t, 2) : surface_.evaluate(t, place, 2);
    };
    const Vec3 way = p_ - jet(other.lo).point();
    double steepest = -kInfinity, flattest = kInfinity;
    constexpr int kPlaces = 256;
    for (int k = 0; k <= kPlaces; ++k) {
      const SurfaceJet s = jet(other.lo + other.width() * k / kPlaces);
      Vec3 inward = holds_u ? s.du() : s.dv();
      if (!begins) inward = -inward;
      const double length = glm::length(inward);
      if (!(length > 0)) continue;
      const double slope = glm::dot(way, inward) / length;
      steepest = std::max(steepest, slope);
      flattest = std::min(flattest, slope);
    }
    const double rounding = 1e-12 * std::max(glm::length(way), size_);
    const double t = other.lo;
    const auto keep = [&](FootPointKind kind) { holds_u ? add(place, t, kind) : add(t, place, kind); };
    if (std::max(std::abs(steepest), std::abs(flattest)) <= rounding)
      keep(FootPointKind::degenerate);
    else if (steepest < -rounding)
      keep(FootPointKind::border);
  }

  const Vec3 p_;
  const PreparedSurface& on_;
  const Surface& surface_;
  const Rectangle domain_;
  const double size_;
  SurfaceFootPoints result_;
};

}  // namespace

struct SurfaceProjector::Prepared : PreparedSurface {
  using PreparedSurface::PreparedSurface;
};

SurfaceProjector::SurfaceProjector(SurfacePtr surface) {
  const SteppedParts stepped = parts_between_steps(surface);
  demand_known(stepped);
  const bool is_stepped = !stepped.parts.empty();
  const Periods periods = surface->periods();
  // Parts have ends where a surface with kinks closes.
  std::vector<SmoothPart> parts = is_stepped ? stepped.parts : smooth_parts(surface);
  if (is_stepped || (parts.size() > 1 && periods.u == 0 && periods.v == 0 && free_creases(parts).complete))
    parts_ = std::make_shared<ProjectorOfParts>(std::move(parts));
  else if (surface->bounded())
    prepared_ = std::make_shared<Prepared>(std::move(surface));
  else if (const auto plane = std::dynamic_pointer_cast<const Plane>(surface); plane && plane->is_whole())
    plane_ = plane;
  else if (part_near(*surface, {Vec3(0), Vec3(0)}))
    unbounded_ = surface;
  else
    throw std::invalid_argument("the surface is unbounded: give it a domain to project on");
}

SurfaceFootPoints SurfaceProjector::foot_points(const Vec3& point) const {
  if (parts_) return parts_->foot_points(point);
  if (unbounded_) {
    const SurfacePtr part = part_near(*unbounded_, {point, point});
    return SurfaceProjection(point, PreparedSurface(part)).run();
  }
  if (!plane_) return SurfaceProjection(point, *prepared_).run();
  const Vec3 local = plane_->frame().to_local_point(point);
  return {{{local.x, local.y, plane_->point(local.x, local.y), std::abs(local.z), FootPointKind::minimum}}, {}};
}

struct NearestOnSurface::Prepared {
  std::optional<PreparedSurface> surface;
  std::vector<NearCell> cells;
  std::optional<SurfaceProjector> projector;  // of planes and parts instead, which have few foot points

  explicit Prepared(const SurfacePtr& of) {
    const SteppedParts stepped = parts_between_steps(of);
    demand_known(stepped);
    if (of->bounded() && stepped.parts.empty() && smooth_parts(of).size() <= 1)
      cells = near_cells(surface.emplace(of));
    else
      projector.emplace(of);
  }
};

NearestOnSurface::NearestOnSurface(const SurfacePtr& surface) : prepared_(std::make_shared<Prepared>(surface)) {}

std::optional<SurfaceFootPoint> NearestOnSurface::operator()(const Vec3& point) const {
  if (prepared_->surface) return SurfaceProjection(point, *prepared_->surface).nearest(prepared_->cells);
  const SurfaceFootPoints all = prepared_->projector->foot_points(point);
  return all.foot_points.empty() ? std::nullopt : std::optional(all.foot_points.front());
}

SurfaceFootPoints project(const Vec3& point, const Surface& surface) {
  return SurfaceProjector(SurfacePtr(SurfacePtr(), &surface)).foot_points(point);
}

}  // namespace lekalo::geometry
