#include "geometry/bodies/booleans/same_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bodies/booleans/near_curve.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 40;
constexpr double kParallel = 1e-12;  // the sine of an angle

std::vector<Vec3> points_of(const Curve& curve) {
  std::vector<Vec3> result;
  const Interval t = curve.domain();
  for (int k = 0; k <= kPlaces; ++k)
    result.push_back(curve.point(k == kPlaces ? t.hi : t.lo + t.width() * k / kPlaces));
  return result;
}

// A curve and how it moves: about an axis, or along it.
struct Sweep {
  CurvePtr curve;
  Axis axis;
  bool turns;
};

bool keeps_lengths(const Affine& map) {
  const Mat3 square = glm::transpose(map.linear) * map.linear;
  double off = 0;
  for (int k = 0; k < 3; ++k) off = std::max(off, glm::length(square[k] - Mat3(1)[k]));
  return off <= kParallel;
}

std::optional<Sweep> sweep_of(const SurfacePtr& surface) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    const auto original = sweep_of(moved->original());
    if (!original || !keeps_lengths(moved->map())) return std::nullopt;
    const Axis axis{moved->map().point(original->axis.through), moved->map().direction(original->axis.along)};
    return Sweep{transformed(original->curve, moved->map()), axis, original->turns};
  }
  if (const auto* turned = dynamic_cast<const RevolutionSurface*>(surface.get()))
    return Sweep{turned->curve(), turned->axis(), true};
  if (const auto* extruded = dynamic_cast<const ExtrusionSurface*>(surface.get()))
    return Sweep{extruded->curve(), {Vec3(0), glm::normalize(extruded->along())}, false};
  return std::nullopt;
}

Vec3 foot_on(const Axis& axis, const Vec3& p) {
  return axis.through + glm::dot(p - axis.through, axis.along) * axis.along;
}

bool have_one_axis(const Sweep& a, const Sweep& b, const std::vector<Vec3>& points, double tolerance) {
  if (glm::length(glm::cross(a.axis.along, b.axis.along)) > kParallel) return false;
  return !a.turns || std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
    return glm::length(foot_on(a.axis, p) - foot_on(b.axis, p)) <= tolerance;
  });
}

// The half-plane of the axis in which a curve of revolution lies, or the plane of an extruded one, and how points are
// moved there by the motion.
class CurvePlane {
 public:
  CurvePlane(const Sweep& sweep, const std::vector<Vec3>& points) : axis_(sweep.axis), turns_(sweep.turns) {
    origin_ = points[0];
    if (turns_) {
      for (const Vec3& p : points)
        if (const Vec3 out = p - foot_on(axis_, p); glm::length(out) > glm::length(direction_)) direction_ = out;
    } else {
      for (size_t k = 1; k + 1 < points.size(); ++k)
        direction_ += glm::cross(points[k] - points[0], points[k + 1] - points[0]);
      const Vec3 side = points.back() - points.front();
      // Of a straight line the plane across that of the motion.
      if (!(glm::length(direction_) > kParallel * glm::dot(side, side)))
        direction_ = axis_.along * glm::dot(side, side) - side * glm::dot(side, axis_.along);
    }
    if (glm::length(direction_) > 0) direction_ = glm::normalize(direction_);
  }

  // Whether the points, which made it, lie in it.
  bool holds(const std::vector<Vec3>& points, double tolerance) const {
    if (turns_ ? !(glm::length(direction_) > 0) : !(std::abs(glm::dot(direction_, axis_.along)) > kAcross))
      return false;
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return glm::length(moved_here(p) - p) <= tolerance; });
  }
  Vec3 moved_here(const Vec3& p) const {
    if (!turns_) return p + glm::dot(origin_ - p, direction_) / glm::dot(axis_.along, direction_) * axis_.along;
    const Vec3 foot = foot_on(axis_, p);
    return foot + glm::length(p - foot) * direction_;
  }
  // The same for a curve that lies in another such plane.
  CurvePtr moved_here(const CurvePtr& curve, const CurvePlane& from) const {
    if (turns_) {
      const double angle = std::atan2(glm::dot(glm::cross(from.direction_, direction_), axis_.along),
                                      glm::dot(from.direction_, direction_));
      return transformed(curve, Affine::rotation(angle, axis_.along, axis_.through));
    }
    Affine map;
    const Vec3 by = axis_.along / glm::dot(axis_.along, direction_);
    for (int k = 0; k < 3; ++k) map.linear[k] = Mat3(1)[k] - direction_[k] * by;
    map.offset = glm::dot(origin_, direction_) * by;
    return transformed(curve, map);
  }

 private:
  static constexpr double kAcross = 1e-6;
  Axis axis_;
  bool turns_;
  Vec3 origin_{0}, direction_{0};  // away from the axis, or across the plane
};

// Two such surfaces that move as one, and the planes of their curves.
struct SweepPair {
  std::array<Sweep, 2> sweeps;
  std::array<std::vector<Vec3>, 2> points;
  std::array<CurvePlane, 2> planes;
};

std::optional<SweepPair> moving_as_one(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  const auto of_a = sweep_of(a), of_b = sweep_of(b);
  if (!of_a || !of_b || of_a->turns != of_b->turns) return std::nullopt;
  if (!(of_a->curve->domain().width() < kInfinity && of_b->curve->domain().width() < kInfinity)) return std::nullopt;
  const std::vector<Vec3> points_a = points_of(*of_a->curve), points_b = points_of(*of_b->curve);
  if (!have_one_axis(*of_a, *of_b, points_a, tolerance) || !have_one_axis(*of_a, *of_b, points_b, tolerance))
    return std::nullopt;
  SweepPair pair{{*of_a, *of_b}, {points_a, points_b}, {CurvePlane(*of_a, points_a), CurvePlane(*of_b, points_b)}};
  for (const int k : {0, 1})
    if (!pair.planes[k].holds(pair.points[k], tolerance)) return std::nullopt;
  return pair;
}

bool is_end(const Curve& curve, double t, const Vec3& p, double tolerance) {
  const Interval domain = curve.domain();
  const double end = t < domain.middle() ? domain.lo : domain.hi;
  return !curve.is_closed() && glm::length(curve.point(end) - p) <= tolerance;
}

}  // namespace

bool are_one_sweep(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  const auto pair = moving_as_one(a, b, tolerance);
  if (!pair) return false;
  for (const int k : {0, 1}) {
    const NearCurve near(pair->sweeps[1 - k].curve);
    for (const Vec3& p : pair->points[k])
      if (!near.place_of(pair->planes[1 - k].moved_here(p), tolerance)) return false;
  }
  return true;
}

bool sweeps_meet_at_borders(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  const auto pair = moving_as_one(a, b, tolerance);
  if (!pair) return false;
  const Curve& of_b = *pair->sweeps[1].curve;
  const CurvePtr of_a = pair->planes[1].moved_here(pair->sweeps[0].curve, pair->planes[0]);
  const CurveIntersections found = intersect(*of_a, of_b);
  return found.common.empty() &&
         std::all_of(found.points.begin(), found.points.end(), [&](const CurveIntersection& hit) {
           return is_end(*of_a, hit.s, hit.point, tolerance) || is_end(of_b, hit.t, hit.point, tolerance);
         });
}

}  // namespace lekalo::geometry
