// The offset of polygons as a region of winding numbers: every side moves to the left by d; where the next one turns to
// the right an arc about the corner joins both, where it turns to the left the way leads over the corner itself, which
// makes a loop of negative winding. Of all these closed ways together the region is where the winding number is
// positive (as Vatti 1992, and the libraries after him).
#include "geometry/machining/pocket_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/curves/operations/polyline_of_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// Of the size of the region: corners nearer than this are one.
constexpr double kSamePlace = 1e-9;
// More would take too long: all are compared with all.
constexpr size_t kMaxSides = 4000;
// An arc about a corner has at most so many chords.
constexpr double kMaxChords = 200;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
Vec2 left_of(const Vec2& along) { return Vec2(-along.y, along.x) / glm::length(along); }

// Whether the way through a corner from `in` to `out` leaves `other_in` and `other_out` on two sides. One that lies on
// the way touches it.
bool parts(const Vec2& in, const Vec2& out, const Vec2& other_in, const Vec2& other_out) {
  const auto turn_to = [&](const Vec2& d) {
    const double angle = std::atan2(cross(in, d), glm::dot(in, d));
    return angle < 0 ? angle + kTwoPi : angle;
  };
  const double way = turn_to(out), a = turn_to(other_in), b = turn_to(other_out);
  for (const double angle : {a, b})
    if (std::min({angle, kTwoPi - angle, std::abs(angle - way)}) < kSamePlace) return false;
  return (a < way) != (b < way);
}

// Sides and corners that only touch do not cross.
void check_crossings(const Polygon2& polygon, const std::string& field) {
  const size_t n = polygon.size();
  const auto side_of = [](const Vec2& a, const Vec2& b, const Vec2& p) {
    const double beside = cross(b - a, p - a) / glm::length(b - a);
    return std::abs(beside) <= kSamePlace * glm::length(b - a) ? 0.0 : beside;
  };
  const auto lies_inside = [&](const Vec2& a, const Vec2& b, const Vec2& p) {
    return side_of(a, b, p) == 0 && glm::dot(a - p, b - p) < 0;
  };
  const auto refuse = [&](const Vec2& at) {
    throw FieldError(field, fmt::format("the contour crosses itself near ({:.6g}, {:.6g})", at.x, at.y),
                     "a contour without loops");
  };
  // Whether the contour crosses at its corner k the way from one point to another that leads through it.
  const auto is_crossed = [&](size_t k, const Vec2& from, const Vec2& to) {
    const Vec2& corner = polygon[k];
    return parts(polygon[(k + n - 1) % n] - corner, polygon[(k + 1) % n] - corner, from - corner, to - corner);
  };
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 2; j < n; ++j) {
      const Vec2 &a = polygon[i], &b = polygon[i + 1], &c = polygon[j], &d = polygon[(j + 1) % n];
      const double same = kSamePlace * glm::length(b - a);
      if (glm::length(c - a) <= same && is_crossed(i, polygon[j - 1], d)) refuse(a);
      if (lies_inside(c, d, a) && is_crossed(i, c, d)) refuse(a);
      if (lies_inside(a, b, c) && is_crossed(j, a, b)) refuse(c);
      const double to_c = side_of(a, b, c), to_d = side_of(a, b, d);
      if (!(to_c * to_d < 0) || !(side_of(c, d, a) * side_of(c, d, b) < 0)) continue;
      refuse(glm::mix(c, d, to_c / (to_c - to_d)));
    }
}

Polygon2 polygon_of(const Curve& curve, const std::string& field, double tolerance, double height) {
  if (!curve.is_closed()) throw FieldError(field, "the curve is not closed", "a contour ends where it begins");
  const NurbsCurve polyline = polyline_of_curve(curve, tolerance);
  Polygon2 polygon;
  const double size = bounds(curve).diameter();
  for (const Vec4& p : polyline.points()) {
    if (std::abs(p.z / p.w - height) > kSamePlace * size)
      throw FieldError(field, "the contours do not lie in one plane of constant z", "draw them at one height");
    const Vec2 at(p.x / p.w, p.y / p.w);
    if (polygon.empty() || glm::length(at - polygon.back()) > kSamePlace * size) polygon.push_back(at);
  }
  if (polygon.size() > 1 && glm::length(polygon.front() - polygon.back()) <= kSamePlace * size) polygon.pop_back();
  if (polygon.size() < 3) throw FieldError(field, "the contour encloses nothing");
  if (polygon.size() <= kMaxSides) check_crossings(polygon, field);
  return polygon;
}

bool contains(const Polygon2& polygon, const Vec2& p) {
  bool inside = false;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) inside = !inside;
  }
  return inside;
}

void turn(Polygon2& polygon, bool counterclockwise) {
  if ((signed_area(polygon) > 0) != counterclockwise) std::reverse(polygon.begin(), polygon.end());
}

// Chords of an arc of radius d about a corner, no more than `sagitta` inside of it; or the place where the two sides
// meet, if that is no farther outside.
void add_arc(Polygon2& way, const Vec2& corner, const Vec2& from, const Vec2& to, double d, double sagitta) {
  const double angle = std::atan2(cross(from, to), glm::dot(from, to));
  if (const double meet = d / std::cos(0.5 * angle); std::abs(angle) < 1 && meet - d <= sagitta) {
    way.push_back(corner + meet * glm::normalize(from + to));
    return;
  }
  const double step = 2 * std::acos(std::clamp(1 - sagitta / d, 0.0, 1.0));
  const int chords = static_cast<int>(std::min(std::ceil(std::abs(angle) / step), kMaxChords));
  for (int k = 0; k <= chords; ++k) {
    const double turned = angle * k / std::max(chords, 1);
    way.push_back(corner + d * Vec2(std::cos(turned) * from.x - std::sin(turned) * from.y,
                                    std::sin(turned) * from.x + std::cos(turned) * from.y));
  }
}

// Every side to the left by d; loops are left in it.
Polygon2 moved_left(const Polygon2& polygon, double d, double sagitta) {
  if (d == 0) return polygon;
  Polygon2 way;
  const size_t n = polygon.size();
  for (size_t k = 0; k < n; ++k) {
    const Vec2 &before = polygon[(k + n - 1) % n], &corner = polygon[k], &after = polygon[(k + 1) % n];
    const Vec2 from = left_of(corner - before), to = left_of(after - corner);
    if (cross(from, to) < 0 || (cross(from, to) == 0 && glm::dot(from, to) < 0)) {
      add_arc(way, corner, from, to, d, sagitta);
    } else {
      way.push_back(corner + d * from);
      if (cross(from, to) > 0) way.push_back(corner);
      way.push_back(corner + d * to);
    }
  }
  return way;
}

struct Side {
  Vec2 a, b;
  std::vector<double> cuts;  // parameters of a..b
};

// Where sides cross or one ends on the other.
void cut(Side& p, Side& q, double same) {
  const Vec2 u = p.b - p.a, v = q.b - q.a, w = q.a - p.a;
  const double area = cross(u, v), lu = glm::length(u), lv = glm::length(v);
  if (std::abs(area) <= 1e-14 * lu * lv) {  // parallel: the ends of each that lie on the other
    const auto end_on = [&](Side& side, const Vec2& along, double length, const Vec2& end) {
      const double t = glm::dot(end - side.a, along) / (length * length);
      if (std::abs(cross(along, end - side.a)) <= same * length && t > 0 && t < 1) side.cuts.push_back(t);
    };
    for (const Vec2& end : {q.a, q.b}) end_on(p, u, lu, end);
    for (const Vec2& end : {p.a, p.b}) end_on(q, v, lv, end);
    return;
  }
  const double s = cross(w, v) / area, t = cross(w, u) / area, es = same / lu, et = same / lv;
  if (s < -es || s > 1 + es || t < -et || t > 1 + et) return;
  if (s > 0 && s < 1) p.cuts.push_back(s);
  if (t > 0 && t < 1) q.cuts.push_back(t);
}

// Numbers for places, one for all that are the same to the tolerance.
class Places {
 public:
  explicit Places(double same) : same_(same) {}
  int number(const Vec2& p) {
    const auto x = static_cast<long long>(std::floor(p.x / same_)), y = static_cast<long long>(std::floor(p.y / same_));
    for (long long i = x - 1; i <= x + 1; ++i)
      for (long long j = y - 1; j <= y + 1; ++j)
        if (const auto found = cells_.find({i, j}); found != cells_.end())
          for (const int one : found->second)
            if (glm::length(points_[static_cast<size_t>(one)] - p) <= same_) return one;
    cells_[{x, y}].push_back(static_cast<int>(points_.size()));
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }
  const Vec2& operator[](int k) const { return points_[static_cast<size_t>(k)]; }

 private:
  double same_;
  std::vector<Vec2> points_;
  std::map<std::pair<long long, long long>, std::vector<int>> cells_;
};

// How often the sides run around a place that lies on none of them.
int winding(const std::map<std::pair<int, int>, int>& sides, const Places& places, const Vec2& p) {
  int sum = 0;
  for (const auto& [ends, times] : sides) {
    const Vec2 &a = places[ends.first], &b = places[ends.second];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    const double side = cross(b - a, p - a);
    if (b.y > a.y ? side > 0 : side < 0) sum += b.y > a.y ? times : -times;
  }
  return sum;
}

// From place to place in the direction in which more ways run than back, with how many more.
std::map<std::pair<int, int>, int> arrangement(std::vector<Side>& sides, Places& places, double same) {
  for (size_t i = 0; i < sides.size(); ++i)
    for (size_t j = i + 1; j < sides.size(); ++j) cut(sides[i], sides[j], same);
  std::map<std::pair<int, int>, int> result;
  for (Side& side : sides) {
    side.cuts.push_back(0);
    side.cuts.push_back(1);
    std::sort(side.cuts.begin(), side.cuts.end());
    int before = -1;
    for (const double t : side.cuts) {
      const int at = places.number(glm::mix(side.a, side.b, t));
      if (before >= 0 && at != before) {
        if (const auto back = result.find({at, before}); back != result.end())
          --back->second;
        else
          ++result[{before, at}];
      }
      before = at;
    }
  }
  std::erase_if(result, [](const auto& one) { return one.second == 0; });
  return result;
}

// Sides with the region on their left are followed to closed rims, turning as far to the right as they may: rims that
// touch at a place stay apart.
std::vector<Polygon2> rims_of(const std::vector<std::pair<int, int>>& sides, const Places& places) {
  std::map<int, std::vector<size_t>> from;
  for (size_t k = 0; k < sides.size(); ++k) from[sides[k].first].push_back(k);
  std::vector<bool> used(sides.size(), false);
  std::vector<Polygon2> rims;
  for (size_t first = 0; first < sides.size(); ++first) {
    Polygon2 rim;
    for (size_t at = first; !used[at];) {
      used[at] = true;
      rim.push_back(places[sides[at].first]);
      const Vec2 along = places[sides[at].second] - places[sides[at].first];
      double sharpest = 4;
      for (const size_t next : from[sides[at].second]) {
        const Vec2 on = places[sides[next].second] - places[sides[next].first];
        const double angle = std::atan2(cross(along, on), glm::dot(along, on));
        if (!used[next] && angle < sharpest) sharpest = angle, at = next;
      }
    }
    if (rim.size() > 2) rims.push_back(std::move(rim));
  }
  return rims;
}

PocketRegion positive_region(const std::vector<Polygon2>& ways, double size) {
  const double same = kSamePlace * size;
  std::vector<Side> sides;
  for (const Polygon2& way : ways)
    for (size_t k = 0; k < way.size(); ++k)
      if (glm::length(way[(k + 1) % way.size()] - way[k]) > same)
        sides.push_back({way[k], way[(k + 1) % way.size()], {}});
  if (sides.size() > kMaxSides)
    throw FieldError("allowance", fmt::format("{} sides are needed to stay in the band", sides.size()),
                     "widen the allowance");
  Places places(4 * same);
  const auto arranged = arrangement(sides, places, same);
  std::vector<std::pair<int, int>> borders;
  for (const auto& [ends, times] : arranged) {
    const Vec2 &a = places[ends.first], &b = places[ends.second];
    const Vec2 beside = 0.5 * (a + b) + std::min(100 * same, 0.01 * glm::length(b - a)) * left_of(b - a);
    const int left = winding(arranged, places, beside);
    if (left > 0 && left - times <= 0) borders.push_back(ends);
    if (left <= 0 && left - times > 0) borders.push_back({ends.second, ends.first});
  }
  return {rims_of(borders, places)};
}

}  // namespace

double signed_area(const Polygon2& polygon) {
  double sum = 0;
  for (size_t k = 0; k < polygon.size(); ++k)
    sum += cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  return 0.5 * sum;
}

double area(const PocketRegion& region) {
  double sum = 0;
  for (const Polygon2& rim : region.rims) sum += signed_area(rim);
  return sum;
}

namespace {

std::vector<Polygon2> contours_of(const Curve& outer, const std::vector<CurvePtr>& islands, double tolerance) {
  const double height = outer.point(outer.domain().lo).z;
  std::vector<Polygon2> contours{polygon_of(outer, "outer", tolerance, height)};
  turn(contours[0], true);
  for (const CurvePtr& island : islands) {
    contours.push_back(polygon_of(*island, "islands", tolerance, height));
    const auto is_inside = [&](const Vec2& corner) { return contains(contours[0], corner); };
    if (std::none_of(contours.back().begin(), contours.back().end(), is_inside))
      throw FieldError("islands",
                       fmt::format("island {} does not lie inside of the outer contour", contours.size() - 2),
                       "islands are left standing in the pocket");
    turn(contours.back(), false);
  }
  return contours;
}

}  // namespace

PocketRegion inset_region(const Curve& outer, const std::vector<CurvePtr>& islands, double nearest, double farthest,
                          const char* field_of_distance) {
  const double band = farthest - nearest, size = bounds(outer).diameter();
  std::vector<Polygon2> contours = contours_of(outer, islands, 0.25 * band);
  for (Polygon2& contour : contours) contour = moved_left(contour, 0.5 * (nearest + farthest), 0.25 * band);
  PocketRegion region = positive_region(contours, size);
  // Slivers that rounding leaves where loops touch.
  std::erase_if(region.rims, [&](const Polygon2& rim) { return std::abs(signed_area(rim)) <= 1e-9 * size * size; });
  if (region.rims.empty() || !(area(region) > 0))
    throw FieldError(field_of_distance, "nothing is left of the pocket at this distance from its contours",
                     "take a smaller allowance or tool");
  return region;
}

}  // namespace lekalo::geometry
