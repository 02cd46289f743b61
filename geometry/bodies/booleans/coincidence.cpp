#include "geometry/bodies/booleans/coincidence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bodies/booleans/same_sweep.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/curves/on_surfaces/projected_image.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/analytic/elementary_surface.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// The equation of a canonical surface in its own coordinates, and its gradient.
double equation(const CanonicalSurface& s, const Vec3& q, Vec3& gradient) {
  const double rho = std::hypot(q.x, q.y);
  const Vec3 outward = rho > 0 ? Vec3(q.x / rho, q.y / rho, 0) : Vec3(0);
  switch (s.kind) {
    case CanonicalSurface::Kind::plane:
      gradient = {0, 0, 1};
      return q.z;
    case CanonicalSurface::Kind::saddle:
      gradient = {-2 * q.x, 2 * q.y, 1};
      return q.z - q.x * q.x + q.y * q.y;
    case CanonicalSurface::Kind::ellipsoid:
      gradient = 2.0 * q;
      return glm::dot(q, q) - 1;
    case CanonicalSurface::Kind::one_sheet:
      gradient = {2 * q.x, 2 * q.y, -2 * q.z};
      return rho * rho - q.z * q.z - 1;
    case CanonicalSurface::Kind::two_sheets:
      gradient = {2 * q.x, 2 * q.y, -2 * q.z};
      return rho * rho - q.z * q.z + 1;
    case CanonicalSurface::Kind::paraboloid:
      gradient = {2 * q.x, 2 * q.y, -1};
      return rho * rho - q.z;
    case CanonicalSurface::Kind::cone: {
      const double slope = s.widening / s.height;
      gradient = outward - Vec3(0, 0, slope);
      return rho - (s.radius + slope * q.z);
    }
    case CanonicalSurface::Kind::torus: {
      const double around = std::hypot(rho - s.major, q.z);
      gradient = around > 0 ? ((rho - s.major) * outward + Vec3(0, 0, q.z)) / around : Vec3(0);
      return around - s.minor;
    }
  }
  return 0;
}

// First-order distance of a point from the surface.
double distance_from(const CanonicalSurface& s, const Vec3& p) {
  Vec3 gradient(0);
  const double value = equation(s, s.local(p), gradient);
  const double steep = glm::length(glm::transpose(s.to_local) * gradient);
  return steep > 0 ? std::abs(value) / steep : std::abs(value);
}

// Enough points to tell surfaces of the fourth degree apart.
std::vector<Vec3> points_of(const CanonicalSurface& s, const Vec3& near, double size) {
  std::vector<Vec3> points;
  Rectangle domain = s.surface->domain();
  if (s.kind == CanonicalSurface::Kind::plane) {
    const Mat3 axes = glm::inverse(s.to_local);
    const Vec3 at = s.local(near), foot = s.origin + axes[0] * at.x + axes[1] * at.y;
    for (int k = 0; k < 8; ++k) {
      const double angle = kTwoPi * k / 8;
      points.push_back(foot +
                       size * (std::cos(angle) * glm::normalize(axes[0]) + std::sin(angle) * glm::normalize(axes[1])));
    }
    return points;
  }
  constexpr int kPlaces = 7;
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j)
      points.push_back(s.surface->point(domain.u.lo + domain.u.width() * (i + 0.37) / kPlaces,
                                        domain.v.lo + domain.v.width() * (j + 0.41) / kPlaces));
  return points;
}

Vec2 parameters_by_equation(const CanonicalSurface& s, const Vec3& p) {
  const Vec3 q = s.local(p);
  if (s.is_affine()) return {q.x, q.y};
  const double turn = s.side(q.z);
  return {std::atan2(turn * q.y, turn * q.x), s.parameter(turn * std::hypot(q.x, q.y), q.z)};
}

// The parameters that the equation gives for points of a curve, going on from period to period.
class Tracking {
 public:
  Tracking(const SurfacePtr& surface, const CurvePtr& curve)
      : surface_(surface), curve_(curve), known_(canonical(surface)), periods_(surface->periods()) {
    if (!known_) equations_ = std::make_unique<ProjectionEquations>(curve, surface, std::nullopt);
  }

  // Places along the curve, near enough to each other that no turn is lost; false where a place is not found.
  bool begin() {
    constexpr int kPlaces = 32;
    for (const CurvePiece& piece : curve_->pieces())
      for (int k = 0; k <= kPlaces; ++k) {
        const double t = piece.domain.lo + piece.domain.width() * k / kPlaces;
        if (!places_.empty() && !(t > places_.back().t)) continue;
        std::optional<Vec2> at = raw(t, places_.empty() ? std::nullopt : std::optional(places_.back().uv));
        if (!at) return false;
        if (!places_.empty()) *at = unwrapped(*at, places_.back().uv);
        places_.push_back({t, *at});
      }
    settle_ends();
    return true;
  }

  Vec3 operator()(double t) const {
    if (pole_at_begin_ && t <= places_.front().t) return Vec3(places_.front().uv, 0);
    if (pole_at_end_ && t >= places_.back().t) return Vec3(places_.back().uv, 0);
    const auto next = std::upper_bound(places_.begin() + 1, places_.end() - 1, t,
                                       [](double at, const Place& place) { return at < place.t; });
    const Place &a = *(next - 1), &b = *next;
    const Vec2 between = a.uv + (t - a.t) / (b.t - a.t) * (b.uv - a.uv);
    const std::optional<Vec2> at = raw(t, between);
    return Vec3(at ? unwrapped(*at, between) : between, 0);
  }

 private:
  struct Place {
    double t;
    Vec2 uv;
  };

  std::optional<Vec2> raw(double t, const std::optional<Vec2>& near) const {
    const Vec3 p = curve_->point(t);
    if (known_) return parameters_by_equation(*known_, p);
    if (near)
      if (const auto found = equations_->solve(t, *near)) return found;
    const SurfaceFootPoint nearest = project(p, *surface_).foot_points.front();
    return Vec2(nearest.u, nearest.v);
  }

  Vec2 unwrapped(Vec2 uv, const Vec2& near) const {
    if (periods_.u > 0) uv.x += periods_.u * std::round((near.x - uv.x) / periods_.u);
    if (periods_.v > 0) uv.y += periods_.v * std::round((near.y - uv.y) / periods_.v);
    return uv;
  }

  bool at_pole(double t) const {
    if (!known_ || known_->is_affine()) return false;
    const Vec3 q = known_->local(curve_->point(t));
    return known_->kind != CanonicalSurface::Kind::torus && std::hypot(q.x, q.y) <= 1e-9 * (1 + std::abs(q.z));
  }

  // On the axis every angle is as good: the limit along the curve is meant, that of the tangent where there is one.
  void settle_ends() {
    const auto limit = [&](double end, double inner, const Vec2& near) {
      const Vec3 along = (inner > end ? 1.0 : -1.0) * (known_->to_local * curve_->evaluate(end, 1).d[1]);
      if (std::hypot(along.x, along.y) > 1e-6 * glm::length(along)) {
        const double turn = known_->side(known_->local(curve_->point(inner)).z);
        return unwrapped({std::atan2(turn * along.y, turn * along.x), near.y}, near);
      }
      const double h = 1e-4 * (inner - end);
      Vec2 values[3];
      for (int k = 0; k < 3; ++k) values[k] = unwrapped(*raw(end + (k + 1) * h, near), near);
      return 3.0 * values[0] - 3.0 * values[1] + values[2];
    };
    pole_at_begin_ = at_pole(places_.front().t);
    pole_at_end_ = at_pole(places_.back().t);
    if (pole_at_begin_) places_[0].uv.x = limit(places_[0].t, places_[1].t, places_[1].uv).x;
    const size_t last = places_.size() - 1;
    if (pole_at_end_) places_[last].uv.x = limit(places_[last].t, places_[last - 1].t, places_[last - 1].uv).x;
  }

  SurfacePtr surface_;
  CurvePtr curve_;
  std::optional<CanonicalSurface> known_;
  std::unique_ptr<ProjectionEquations> equations_;
  Periods periods_;
  std::vector<Place> places_;
  bool pole_at_begin_ = false, pole_at_end_ = false;
};

double parameter_size(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const double size = std::max(domain.u.width(), domain.v.width());
  return size < kInfinity ? size : 1;
}

// The smooth parts of a curve; of a part of a curve the first and last may be slivers, which count to their neighbours.
std::vector<Interval> stretches_of(const Curve& curve) {
  constexpr double kSliver = 1e-9;
  const double least = kSliver * curve.domain().width();
  std::vector<Interval> result;
  for (const CurvePiece& piece : curve.pieces()) {
    if (!result.empty() && (piece.domain.width() <= least || result.back().width() <= least))
      result.back().hi = piece.domain.hi;
    else
      result.push_back(piece.domain);
  }
  return result;
}

// A straight line where the function is one; a coordinate that is constant is so exactly. At its ends, which may be
// poles, the function is less sure than between them.
Curve2Ptr simple_image(const std::function<Vec3(double)>& image, const std::vector<Interval>& stretches, double size) {
  constexpr double kAgree = 1e-13;
  const Interval t{stretches.front().lo, stretches.back().hi};
  constexpr int kPlaces = 37;
  std::array<Vec3, kPlaces + 1> places;
  for (int k = 0; k <= kPlaces; ++k) places[k] = image(k == kPlaces ? t.hi : t.lo + t.width() * k / kPlaces);
  const Vec3 middle = places[kPlaces / 2];
  Vec2 change(0);
  for (int k = 1; k < kPlaces; ++k) change = glm::max(change, Vec2(glm::abs(places[k] - middle)));
  const auto settled = [&](Vec3 at) {
    for (int axis = 0; axis < 2; ++axis)
      if (change[axis] <= kAgree * size) at[axis] = middle[axis];
    at.z = 0;
    return at;
  };
  const Vec3 begin = settled(places[0]), end = settled(places[kPlaces]);
  double bend = 0;
  for (int k = 1; k < kPlaces; ++k) {
    const double part = static_cast<double>(k) / kPlaces;
    bend = std::max(bend, glm::length(settled(places[k]) - (begin + part * (end - begin))));
  }
  if (bend <= kAgree * size) return image_line(t, Vec2(begin), Vec2(end));
  for (const double tolerance : {kAgree, 10 * kAgree, 100 * kAgree})
    if (auto result =
            polynomial_approximation([&](double at) { return settled(image(at)); }, stretches, tolerance * size))
      return result;
  return nullptr;
}

}  // namespace

Curve2Ptr simple_image(const Surface& surface, const Curve2Ptr& image) {
  // In a pole, whose parameter is known less well than others, an image jumps: at an end its limit is meant.
  const double size = parameter_size(surface);
  const Interval t = image->domain();
  const double step = 1e-6 * t.width();
  const auto limit = [&](double end, double by) {
    const Vec3 near = image->point(end + by), far = image->point(end + 2 * by);
    return [=](double at) { return near + (at - (end + by)) / by * (far - near); };
  };
  const auto at_begin = limit(t.lo, step), at_end = limit(t.hi, -step);
  const bool jumps_at_begin = glm::length(at_begin(t.lo) - image->point(t.lo)) > 1e-6 * size,
             jumps_at_end = glm::length(at_end(t.hi) - image->point(t.hi)) > 1e-6 * size;
  const std::vector<CurvePiece> pieces = image->pieces();
  if (!jumps_at_begin && !jumps_at_end &&
      std::any_of(pieces.begin(), pieces.end(), [](const CurvePiece& piece) { return piece.is_rational(); }))
    return image;
  const auto point = [&](double at) {
    if (jumps_at_begin && at < t.lo + step) return at_begin(at);
    if (jumps_at_end && at > t.hi - step) return at_end(at);
    return image->point(at);
  };
  const Curve2Ptr result = simple_image(point, stretches_of(*image), size);
  return result ? result : image;
}

std::optional<bool> have_same_equation(const SurfacePtr& a, const SurfacePtr& b, const Vec3& near, double size,
                                       double tolerance) {
  if (is_same(a, b)) return true;
  const auto of_a = elementary_surface(a), of_b = elementary_surface(b);
  if (!of_a || !of_b) return are_one_sweep(a, b, tolerance) ? std::optional(true) : std::nullopt;
  if ((of_a->kind == CanonicalSurface::Kind::plane) != (of_b->kind == CanonicalSurface::Kind::plane)) return false;
  for (const Vec3& p : points_of(*of_a, near, size))
    if (!(distance_from(*of_b, p) <= tolerance)) return false;
  for (const Vec3& p : points_of(*of_b, near, size))
    if (!(distance_from(*of_a, p) <= tolerance)) return false;
  return true;
}

Vec2 parameters_on(const SurfacePtr& surface, const Vec3& p) {
  if (const auto known = canonical(surface)) return parameters_by_equation(*known, p);
  const SurfaceFootPoint nearest = project(p, *surface).foot_points.front();
  return {nearest.u, nearest.v};
}

Curve2Ptr image_on(const SurfacePtr& surface, const CurvePtr& curve) {
  const auto known = canonical(surface);
  if (known && known->kind == CanonicalSurface::Kind::plane) {
    Affine map;
    map.linear = known->to_local;
    for (int k = 0; k < 3; ++k) map.linear[k].z = 0;
    map.offset = -(map.linear * known->origin);
    return transformed(curve, map);
  }
  const auto tracking = std::make_shared<Tracking>(surface, curve);
  if (!tracking->begin()) return nullptr;
  return simple_image([&](double t) { return (*tracking)(t); }, stretches_of(*curve), parameter_size(*surface));
}

}  // namespace lekalo::geometry
