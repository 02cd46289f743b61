#include "geometry/queries/closest/position.h"

#include <cmath>
#include <stdexcept>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

// Ways whose angle with the tangent plane has a smaller sine lead beside the surface.
constexpr double kBeside = 1e-9;
// Beside a crease normals are taken so far off, in parts of the range; about a pole at so many places.
constexpr double kOff = 1e-9;
constexpr int kPlacesOfPole = 32;
// A foot point inside of a face has the way along the normal; with a smaller cosine it is not decided there.
constexpr double kAlongNormal = 0.9;

// The sum of the unit normals around a place: of both sides of a crease, of all directions at a pole.
Vec3 normals_about(const Surface& surface, double u, double v) {
  const Rectangle domain = surface.domain();
  const DegenerateEdges poles = surface.degenerate_edges();
  Vec3 sum(0);
  const auto is_at = [](double x, double end, const Interval& range) {
    return std::abs(x - end) <= kOff * range.width();
  };
  if ((poles.v_min && is_at(v, domain.v.lo, domain.v)) || (poles.v_max && is_at(v, domain.v.hi, domain.v))) {
    for (int k = 0; k < kPlacesOfPole; ++k)
      sum += surface.normal(domain.u.lo + domain.u.width() * (k + 0.5) / kPlacesOfPole, v);
    return sum;
  }
  if ((poles.u_min && is_at(u, domain.u.lo, domain.u)) || (poles.u_max && is_at(u, domain.u.hi, domain.u))) {
    for (int k = 0; k < kPlacesOfPole; ++k)
      sum += surface.normal(u, domain.v.lo + domain.v.width() * (k + 0.5) / kPlacesOfPole);
    return sum;
  }
  const auto beside = [](double x, const Interval& range, double side, double period) {
    const double to = x + side * kOff * range.width();
    if (range.contains(to)) return to;
    return period > 0 && std::abs(period - range.width()) <= kOff * period ? to - side * period : x;
  };
  const Periods periods = surface.periods();
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      sum += surface.normal(beside(u, domain.u, a, periods.u), beside(v, domain.v, b, periods.v));
  return sum;
}

// Lines through the point vote whether it is inside, `hits` giving the parameters of the crossings with one. A line
// whose two halves disagree has met an edge or touched something: it does not count.
template <class Hits>
bool vote_inside(const Vec3& point, Hits&& hits) {
  constexpr int kLines = 7, kMaxLines = 40;
  int inside = 0, outside = 0;
  for (int k = 0; k < kMaxLines && inside + outside < kLines; ++k) {
    // Directions spread over the sphere by the golden angle, none along an axis.
    const double z = 0.97 - 1.91 * (k * 0.6180339887498949 - std::floor(k * 0.6180339887498949));
    const double angle = 0.3 + 2.399963229728653 * k, r = std::sqrt(1 - z * z);
    const std::pair<int, int> count = hits(Line{point, {r * std::cos(angle), r * std::sin(angle), z}});
    if (count.first % 2 != count.second % 2) continue;
    ++(count.first % 2 ? inside : outside);
  }
  return inside > outside;
}

std::pair<int, int> count_sides(const std::vector<SurfaceHit>& hits) {
  std::pair<int, int> count{0, 0};
  for (const SurfaceHit& hit : hits) ++(hit.t > 0 ? count.first : count.second);
  return count;
}

}  // namespace

SurfacePosition position(const Vec3& point, const Surface& surface) {
  const SurfaceFootPoints found = project(point, surface);
  const SurfaceFootPoint& foot_point = found.foot_points.front();
  SurfacePosition result;
  result.distance = foot_point.distance;
  result.nearest = {DistancePlace::Kind::surface, -1, 0, foot_point.u, foot_point.v, foot_point.point};
  const double size = surface.bounded() ? bounds(surface).diameter() : glm::length(point);
  if (foot_point.distance <= kOnSurface * size) return result;
  const Vec3 way = point - foot_point.point;
  const Vec3 sum = foot_point.kind == FootPointKind::border ? normals_about(surface, foot_point.u, foot_point.v)
                                                            : surface.normal(foot_point.u, foot_point.v);
  const double length = glm::length(sum);
  result.height = length > 0 ? glm::dot(way, sum) / length : 0;
  result.side = std::abs(result.height) <= kBeside * foot_point.distance ? SurfacePosition::Side::beside
                : result.height > 0                                      ? SurfacePosition::Side::above
                                                                         : SurfacePosition::Side::below;
  return result;
}

namespace {

// The nearest place of the loops, those of which `counts` is true.
template <class Counts>
RegionPosition nearest_border(const Vec2& point, const std::vector<std::vector<TrimRegion::Part>>& loops,
                              Counts&& counts) {
  RegionPosition result;
  result.distance = kInfinity;
  for (size_t i = 0; i < loops.size(); ++i)
    for (size_t k = 0; k < loops[i].size(); ++k) {
      if (!counts(i, k)) continue;
      const CurveFootPoint foot_point = project(Vec3(point, 0), *loops[i][k].curve).foot_points.front();
      if (foot_point.distance < result.distance)
        result = {Containment::outside, foot_point.distance, static_cast<int>(i),
                  static_cast<int>(k),  foot_point.t,        Vec2(foot_point.point)};
    }
  return result;
}

double size_of(const std::vector<std::vector<TrimRegion::Part>>& loops) {
  Box3 box;
  for (const auto& loop : loops)
    for (const TrimRegion::Part& part : loop) box.include(bounds(*part.curve));
  return box.diameter();
}

void decide(RegionPosition& position, bool inside, double size) {
  position.where = position.distance <= kOnSurface * size ? Containment::on
                   : inside                               ? Containment::inside
                                                          : Containment::outside;
}

}  // namespace

RegionPosition position(const Vec2& point, const std::vector<std::vector<TrimRegion::Part>>& loops) {
  RegionPosition result = nearest_border(point, loops, [](size_t, size_t) { return true; });
  decide(result, TrimRegion(loops).contains(point.x, point.y), size_of(loops));
  return result;
}

RegionPosition position(const Vec2& point, const Body& body, int face) {
  const Face& of = body.faces[face];
  std::vector<std::vector<TrimRegion::Part>> loops;
  for (const int loop : of.loops) {
    loops.emplace_back();
    for (const int c : body.loops[loop].coedges)
      loops.back().push_back({body.coedges[c].image, body.coedges[c].forward});
  }
  const auto is_border = [&](size_t loop, size_t k) {
    return body.edges[body.coedges[body.loops[of.loops[loop]].coedges[k]].edge].kind == EdgeKind::regular;
  };
  const Periods periods = of.surface->periods();
  RegionPosition result;
  result.distance = kInfinity;
  for (int i = periods.u > 0 ? -1 : 0; i <= (periods.u > 0 ? 1 : 0); ++i)
    for (int j = periods.v > 0 ? -1 : 0; j <= (periods.v > 0 ? 1 : 0); ++j) {
      const RegionPosition one = nearest_border(point + Vec2(i * periods.u, j * periods.v), loops, is_border);
      if (one.distance < result.distance) result = one;
    }
  decide(result, TrimRegion(loops, periods).contains(point.x, point.y), size_of(loops));
  return result;
}

BodyPosition position(const Vec3& point, const Body& body) {
  if (!body.is_closed()) throw std::invalid_argument("the body is not closed: it has no inside");
  const Distance found = distance(point, &body, DistanceMinima::nearest);
  BodyPosition result;
  result.distance = found.minima.front().distance;
  result.nearest = found.minima.front().b;
  if (result.distance <= kOnSurface * bounds(body).diameter()) {
    result.where = Containment::on;
    return result;
  }
  const DistancePlace& foot_point = result.nearest;
  bool inside = false;
  result.by_lines = true;
  if (foot_point.kind == DistancePlace::Kind::face) {
    const double along =
        glm::dot(point - foot_point.point, body.normal(foot_point.index, foot_point.u, foot_point.v)) / result.distance;
    inside = along < 0;
    result.by_lines = !(std::abs(along) > kAlongNormal);
  }
  if (result.by_lines) {
    const LineIntersector intersector(body);
    inside = is_inside(point, intersector);
  }
  result.where = inside ? Containment::inside : Containment::outside;
  return result;
}

bool is_inside(const Vec3& point, const LineIntersector& body) {
  return vote_inside(point, [&](const Line& line) { return count_sides(body.all_hits(line)); });
}

bool is_inside(const Vec3& point, const Shape& shape) {
  if (!shape.is_closed()) throw std::invalid_argument("the shape is not closed: it has no inside");
  const bool bounded = shape.bounds().bounded();
  return vote_inside(point, [&](const Line& line) {
    std::vector<SurfaceHit> hits;
    shape.all_hits(line, {-kInfinity, kInfinity}, hits);
    std::pair<int, int> count = count_sides(hits);
    if (bounded) return count;
    // From where the line begins, and so on both of its halves.
    if (shape.begins_inside(line)) ++count.second;
    return std::pair(count.second, count.second);
  });
}

}  // namespace lekalo::geometry
