#include "geometry/queries/quadrics/canonical_surface.h"

#include <cmath>

#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/parameter_range.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

using Kind = CanonicalSurface::Kind;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// q = (x / s.x, y / s.y, z / s.z) of the coordinates of a frame.
void place(CanonicalSurface& surface, Kind kind, const Frame& frame, const Vec3& s) {
  surface.kind = kind;
  surface.origin = frame.origin;
  surface.to_local = glm::transpose(Mat3(frame.x / s.x, frame.y / s.y, frame.z / s.z));
}

// The surface's own formula, without an affine map.
bool recognise(const Surface& surface, CanonicalSurface& result) {
  if (const auto* plane = dynamic_cast<const Plane*>(&surface)) {
    place(result, Kind::plane, plane->frame(), Vec3(1));
  } else if (const auto* sphere = dynamic_cast<const SphereSurface*>(&surface)) {
    place(result, Kind::ellipsoid, sphere->frame(), Vec3(sphere->radius()));
  } else if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&surface)) {
    place(result, Kind::ellipsoid, ellipsoid->frame(), ellipsoid->semi_axes());
  } else if (const auto* cone = dynamic_cast<const ConeSurface*>(&surface)) {
    place(result, Kind::cone, cone->frame(), Vec3(1));
    result.radius = cone->radius();
    result.widening = cone->top_radius() - cone->radius();
    result.height = cone->height();
  } else if (const auto* torus = dynamic_cast<const TorusSurface*>(&surface)) {
    place(result, Kind::torus, torus->frame(), Vec3(1));
    result.major = torus->major_radius();
    result.minor = torus->minor_radius();
  } else if (const auto* one = dynamic_cast<const HyperboloidOneSheet*>(&surface)) {
    place(result, Kind::one_sheet, one->frame(), one->semi_axes());
  } else if (const auto* two = dynamic_cast<const HyperboloidTwoSheets*>(&surface)) {
    place(result, Kind::two_sheets, two->frame(), two->semi_axes());
  } else if (const auto* bowl = dynamic_cast<const EllipticParaboloid*>(&surface)) {
    place(result, Kind::paraboloid, bowl->frame(), {bowl->semi_axes().x, bowl->semi_axes().y, 1});
  } else if (const auto* saddle = dynamic_cast<const HyperbolicParaboloid*>(&surface)) {
    place(result, Kind::saddle, saddle->frame(), {saddle->semi_axes().x, saddle->semi_axes().y, 1});
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::optional<CanonicalSurface> canonical(const SurfacePtr& surface) {
  CanonicalSurface result;
  result.surface = surface;
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    if (!recognise(*moved->original(), result)) return std::nullopt;
    result.origin = moved->map().point(result.origin);
    result.to_local = result.to_local * glm::inverse(moved->map().linear);
  } else if (!recognise(*surface, result)) {
    return std::nullopt;
  }
  return result;
}

std::vector<CanonicalSurface::Border> CanonicalSurface::borders() const {
  const Rectangle domain = surface->domain();
  std::vector<Border> result;
  const auto add = [&](const Vec3& normal, double at) {
    if (std::isfinite(at)) result.push_back({normal, at});
  };
  if (is_affine()) {
    for (const double u : {domain.u.lo, domain.u.hi}) add({1, 0, 0}, u);
    for (const double v : {domain.v.lo, domain.v.hi}) add({0, 1, 0}, v);
    return result;
  }
  if (domain.u.width() < kTwoPi * (1 - 1e-15))
    for (const double u : {domain.u.lo, domain.u.hi}) result.push_back({{-std::sin(u), std::cos(u), 0}, 0});
  if (kind == Kind::torus && domain.v.width() >= kTwoPi * (1 - 1e-15)) return result;
  for (const double v : {domain.v.lo, domain.v.hi}) {
    if (!std::isfinite(v)) continue;
    switch (kind) {
      case Kind::ellipsoid:
        add({0, 0, 1}, std::sin(v));
        break;
      case Kind::one_sheet:
        add({0, 0, 1}, std::sinh(v));
        break;
      case Kind::two_sheets:
        add({0, 0, 1}, std::cosh(v));
        break;
      case Kind::paraboloid:
        add({0, 0, 1}, v * v);
        break;
      case Kind::cone:
        add({0, 0, 1}, height * v);
        break;
      case Kind::torus:
        add({0, 0, 1}, minor * std::sin(v));
        break;
      default:
        break;
    }
  }
  return result;
}

std::optional<Vec2> CanonicalSurface::parameters(const Vec3& p, double near) const {
  const Rectangle domain = surface->domain();
  const Vec3 q = local(p);
  std::optional<double> u, v;
  if (is_affine()) {
    u = within(domain.u, q.x);
    v = within(domain.v, q.y);
  } else {
    const double turn = side(q.z), rho = std::hypot(q.x, q.y);
    const double along = parameter(turn * rho, q.z);
    v = kind == Kind::torus ? angle_within(domain.v, along) : within(domain.v, along);
    // On the axis every angle is as good.
    const bool on_axis = rho <= 64 * kEpsilon * (1 + std::abs(q.z));
    u = on_axis ? domain.u.lo : angle_within(domain.u, std::atan2(turn * q.y, turn * q.x));
  }
  if (!u || !v || !(glm::length(surface->point(*u, *v) - p) <= near)) return std::nullopt;
  return Vec2(*u, *v);
}

std::optional<QuadricForm> CanonicalSurface::quadric(const Vec3& center, double size) const {
  // d.x x^2 + d.y y^2 + d.z z^2 + 2 e z + k = 0 in q.
  Vec3 d(1, 1, 0);
  double e = 0, k = 0;
  switch (kind) {
    case Kind::ellipsoid:
      d.z = 1, k = -1;
      break;
    case Kind::one_sheet:
      d.z = -1, k = -1;
      break;
    case Kind::two_sheets:
      d.z = -1, k = 1;
      break;
    case Kind::paraboloid:
      e = -0.5;
      break;
    case Kind::saddle:
      d.y = -1, e = -0.5;
      break;
    case Kind::cone: {
      const double slope = widening / height;
      d.z = -slope * slope, e = -radius * slope, k = -radius * radius;
      break;
    }
    case Kind::plane:
    case Kind::torus:
      return std::nullopt;
  }
  const Vec3 m = local(center);
  const Mat3 back = glm::transpose(to_local);
  QuadricForm result;
  const Mat3 scaled(d * to_local[0], d * to_local[1], d * to_local[2]);
  result.a = back * scaled;
  result.b = back * (d * m + Vec3(0, 0, e));
  result.c = glm::dot(m, d * m) + 2 * e * m.z + k;
  const Vec3 reach = glm::abs(m) + size * Vec3(glm::length(back[0]), glm::length(back[1]), glm::length(back[2]));
  result.rounding = 16 * kEpsilon * (glm::dot(reach, glm::abs(d) * reach) + 2 * std::abs(e) * reach.z + std::abs(k));
  return result;
}

std::optional<double> CanonicalSurface::scale() const {
  const Mat3 square = glm::transpose(to_local) * to_local;
  const double s = (square[0][0] + square[1][1] + square[2][2]) / 3;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(square[i][j] - (i == j ? s : 0)) > 32 * kEpsilon * s) return std::nullopt;
  return std::sqrt(s);
}

Vec3 CanonicalSurface::axis() const {
  const Mat3 rows = glm::transpose(to_local);
  return glm::normalize(rows[2]);
}

}  // namespace lekalo::geometry
