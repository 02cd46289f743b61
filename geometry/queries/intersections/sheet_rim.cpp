#include "geometry/queries/intersections/sheet_rim.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/queries/measures/curve_features.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Vertices on all of the curve, at first and at most.
constexpr int kFirst = 96, kMaxPlaces = 768;
// A triangle below this part of the square of the size has no orientation.
constexpr double kThin = 1e-13;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

class Polygon {
 public:
  explicit Polygon(std::vector<Vec2> points) : points_(std::move(points)) {
    Vec2 lo = points_.front(), hi = lo;
    for (const Vec2& p : points_) lo = glm::min(lo, p), hi = glm::max(hi, p);
    thin_ = kThin * glm::dot(hi - lo, hi - lo);
  }

  int turning_number() const {
    double sum = 0;
    const size_t n = points_.size();
    for (size_t i = 0; i < n; ++i) {
      const Vec2 a = points_[(i + 1) % n] - points_[i], b = points_[(i + 2) % n] - points_[(i + 1) % n];
      sum += std::atan2(cross(a, b), glm::dot(a, b));
    }
    return static_cast<int>(std::lround(sum / kTwoPi));
  }

  int crossings() const {
    const size_t n = points_.size();
    const auto side = [&](size_t i, const Vec2& p) {
      return cross(points_[(i + 1) % n] - points_[i], p - points_[i]) > 0;
    };
    int count = 0;
    for (size_t i = 0; i < n; ++i)
      for (size_t j = i + 2; j < n; ++j)
        if ((j + 1) % n != i && side(i, points_[j]) != side(i, points_[(j + 1) % n]) &&
            side(j, points_[i]) != side(j, points_[i + 1]))
          ++count;
    return count;
  }

  // Whether triangles that run counterclockwise fill it.
  bool has_triangles() const {
    const size_t n = points_.size();
    std::vector<char> filled(n * n, 0);
    for (size_t i = 0; i + 1 < n; ++i) filled[i * n + i + 1] = 1;
    for (size_t span = 2; span < n; ++span)
      for (size_t i = 0; i + span < n; ++i) {
        const size_t j = i + span;
        for (size_t k = i + 1; k < j && !filled[i * n + j]; ++k)
          filled[i * n + j] = filled[i * n + k] && filled[k * n + j] && runs_left(i, k, j);
      }
    return filled[n - 1];
  }

  bool is_rim() const { return turning_number() == 1 && has_triangles(); }

 private:
  bool runs_left(size_t i, size_t k, size_t j) const {
    return cross(points_[k] - points_[i], points_[j] - points_[i]) > thin_;
  }

  std::vector<Vec2> points_;
  double thin_ = 0;
};

// Even steps on every smooth piece, and the places given.
std::vector<double> parameters(const Curve& curve, int count, const std::vector<double>& places) {
  std::vector<double> result = places;
  const Interval domain = curve.domain();
  for (const CurvePiece& piece : curve.pieces()) {
    const int steps = std::max(2, static_cast<int>(count * piece.domain.width() / domain.width()));
    for (int i = 0; i < steps; ++i) result.push_back(piece.domain.lo + piece.domain.width() * i / steps);
  }
  std::sort(result.begin(), result.end());
  const double same = 1e-9 * domain.width();
  const auto is_same = [&](double a, double b) { return b - a <= same; };
  result.erase(std::unique(result.begin(), result.end(), is_same), result.end());
  return result;
}

// Positions in the parameters of the chord's ends.
size_t index_of(const std::vector<double>& at, double t) {
  return static_cast<size_t>(
      std::min_element(at.begin(), at.end(), [&](double a, double b) { return std::abs(a - t) < std::abs(b - t); }) -
      at.begin());
}

// The places inside of the secant, from the point `from` of the rim to the point `to`; `normal`, `size`: those of the
// rim.
std::vector<Vec3> places_along(const Curve& secant, const Vec3& from, const Vec3& to, const Vec3& normal, double size,
                               int count) {
  const Interval domain = secant.domain();
  const auto begins_at = [&](const Vec3& p) { return glm::length(secant.point(domain.lo) - p) <= kSamePoint * size; };
  const auto ends_at = [&](const Vec3& p) { return glm::length(secant.point(domain.hi) - p) <= kSamePoint * size; };
  const bool forth = begins_at(from) && ends_at(to);
  if (!forth && !(begins_at(to) && ends_at(from)))
    throw std::invalid_argument("the secant does not go from one end of the chord to the other");
  std::vector<Vec3> result;
  for (const double t : parameters(secant, count, {})) result.push_back(secant.point(t));
  for (const Vec3& p : result)
    if (std::abs(glm::dot(p - from, normal)) > kSamePoint * size)
      throw std::invalid_argument("the secant leaves the plane of the curve");
  result.erase(result.begin());  // the rim has it
  if (!forth) std::reverse(result.begin(), result.end());
  return result;
}

}  // namespace

SheetRim sheet_rim(const Curve& curve, const std::optional<std::pair<double, double>>& chord, const Curve* secant) {
  const CurveFeatures features = curve_features(curve);
  if (!features.closed || !features.plane) throw std::invalid_argument("the curve is not closed, or not plane");
  const CurveSelfIntersections own = self_intersections(curve);
  if (!own.common.empty() || std::any_of(own.points.begin(), own.points.end(), [](const CurveSelfIntersection& p) {
        return p.kind != SelfIntersectionKind::crossing;
      }))
    throw std::invalid_argument("the curve touches itself, has a cusp, or runs through a part twice");
  const Frame frame = frame_about(Vec3(0), features.normal);
  std::vector<double> places;
  if (secant && !chord) throw std::invalid_argument("a secant needs the parameters of its ends on the rim");
  if (chord) {
    const Interval domain = curve.domain();
    places = {std::min(chord->first, chord->second), std::max(chord->first, chord->second)};
    if (!(domain.contains(places[0]) && places[1] < domain.hi && places[0] < places[1]))
      throw std::invalid_argument("the ends of the chord are no two parameters of the curve");
  }
  SheetRim result;
  result.crossings = static_cast<int>(own.points.size());
  for (int count = kFirst; count <= kMaxPlaces; count *= 2) {
    const std::vector<double> at = parameters(curve, count, places);
    const auto in_plane = [&](const Vec3& p) { return Vec2(glm::dot(p, frame.x), glm::dot(p, frame.y)); };
    std::vector<Vec2> points, along;  // along: from the first end of the chord to the second
    for (const double t : at) points.push_back(in_plane(curve.point(t)));
    if (secant)
      for (const Vec3& p : places_along(*secant, curve.point(places[0]), curve.point(places[1]), frame.z,
                                        bounds(curve).diameter(), count))
        along.push_back(in_plane(p));
    result.turning_number = Polygon(points).turning_number();
    if (Polygon(points).crossings() != result.crossings) continue;
    size_t i = chord ? index_of(at, places[0]) : 0, j = chord ? index_of(at, places[1]) : 0;
    if (result.turning_number < 0) {
      std::reverse(points.begin(), points.end());
      std::tie(i, j) = std::pair(points.size() - 1 - j, points.size() - 1 - i);
      std::reverse(along.begin(), along.end());
    }
    result.is_rim = Polygon(points).is_rim();
    if (!chord) return result;
    const auto from = [&](size_t k) { return points.begin() + static_cast<std::ptrdiff_t>(k); };
    std::vector<Vec2> first(from(i), from(j + 1)), second(from(j), points.end());
    second.insert(second.end(), points.begin(), from(i + 1));
    second.insert(second.end(), along.begin(), along.end());
    first.insert(first.end(), along.rbegin(), along.rend());
    result.is_connected = result.is_rim && Polygon(first).is_rim() && Polygon(second).is_rim();
    return result;
  }
  throw std::invalid_argument("the curve crosses itself in places too near to each other");
}

}  // namespace lekalo::geometry
