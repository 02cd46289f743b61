#include "geometry/bodies/booleans/turned_ball.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-13;  // of directions, and of lengths by the radius

struct Ball {
  Frame frame;
  double radius = 0;
};

// Of a surface that knows its axis: that as z, and x where its seam is.
Frame frame_of(const CanonicalSurface& surface) {
  const Mat3 axes = glm::inverse(surface.to_local);
  return frame_from(surface.origin, glm::normalize(axes[2]), glm::normalize(axes[0]));
}

std::optional<Ball> whole_ball(const Body& body) {
  if (body.faces.size() != 1 || body.faces[0].trimmed) return std::nullopt;
  const SurfacePtr& surface = body.faces[0].surface;
  const auto known = canonical(surface);
  if (!known || known->kind != CanonicalSurface::Kind::ellipsoid) return std::nullopt;
  const auto scale = known->scale();
  const Rectangle full = SphereSurface::kFull, domain = surface->domain();
  if (!scale || domain.u != full.u || domain.v != full.v) return std::nullopt;
  const double u = domain.u.middle(), v = domain.v.middle();
  if (glm::dot(body.normal(0, u, v), surface->point(u, v) - known->origin) < 0) return std::nullopt;
  return Ball{frame_of(*known), 1 / *scale};
}

// About z a surface cuts the sphere in circles; x is where its own seam is.
struct Axis {
  Vec3 z, x;
};

std::optional<Axis> axis_through(const Frame& frame, const Ball& ball) {
  const Vec3 from = ball.frame.origin - frame.origin;
  if (glm::length(from - glm::dot(from, frame.z) * frame.z) > kSame * (ball.radius + glm::length(from)))
    return std::nullopt;
  return Axis{frame.z, frame.x};
}

// What cuts a sphere about an axis in circles: planes, and round cylinders, cones, spheres and tori.
bool is_elementary(const CanonicalSurface& surface) {
  using Kind = CanonicalSurface::Kind;
  return surface.kind == Kind::plane ||
         ((surface.kind == Kind::cone || surface.kind == Kind::ellipsoid || surface.kind == Kind::torus) &&
          surface.scale());
}

std::optional<Axis> axis_of(const CanonicalSurface& surface, const Ball& ball) {
  if (surface.kind == CanonicalSurface::Kind::plane) return Axis{surface.normal(), Vec3(0)};
  if (surface.kind != CanonicalSurface::Kind::ellipsoid) return axis_through(frame_of(surface), ball);
  const Vec3 between = surface.origin - ball.frame.origin;
  const double length = glm::length(between);
  if (length > kSame * ball.radius) return Axis{between / length, Vec3(0)};
  return std::nullopt;
}

bool may_meet(const Body& body, int face, const std::optional<CanonicalSurface>& surface, const Ball& ball) {
  const Vec3 center = ball.frame.origin;
  if (surface && surface->kind == CanonicalSurface::Kind::plane &&
      std::abs(glm::dot(center - surface->origin, surface->normal())) >= ball.radius)
    return false;
  const Box3 box = bounds(body, face);
  const Vec3 nearest = glm::clamp(center, box.lo, box.hi);
  return glm::length(nearest - center) < ball.radius;
}

// A body has faces on one axis through the center, or on several, or such as are not known of.
enum class Axes { none, one, several, unknown };

struct Cuts {
  Axes axes = Axes::none;
  Axis axis{};
  std::vector<int> faces;
};

Cuts cuts_by(const Body& other, const Ball& ball) {
  Cuts cuts;
  for (size_t f = 0; f < other.faces.size(); ++f) {
    const auto surface = canonical(other.faces[f].surface);
    if (!may_meet(other, static_cast<int>(f), surface, ball)) continue;
    cuts.faces.push_back(static_cast<int>(f));
    if (!surface || !is_elementary(*surface)) return {Axes::unknown, {}, {}};
    const auto found = axis_of(*surface, ball);
    if (!found || (cuts.axes == Axes::one && glm::length(glm::cross(cuts.axis.z, found->z)) > kSame))
      cuts.axes = Axes::several;
    if (cuts.axes == Axes::several) continue;
    if (cuts.axes == Axes::none || cuts.axis.x == Vec3(0)) cuts.axis = *found;
    cuts.axes = Axes::one;
  }
  return cuts;
}

// Directions from the center to points of the curves in which faces cut the sphere.
std::vector<Vec3> cut_directions(const Body& other, const std::vector<int>& faces, const SurfacePtr& whole,
                                 const Ball& ball) {
  // Points of a searched curve take long; between them it goes straight on nearly enough.
  constexpr int kPlaces = 48, kBetween = 8;
  std::vector<Vec3> result;
  for (const int f : faces)
    for (const Contour& contour : intersect(whole, other.faces[f].surface).branches) {
      const Interval t = contour.curve->domain();
      Vec3 before(0);
      for (int k = 0; k <= kPlaces; ++k) {
        const Vec3 d = (contour.curve->point(t.lo + t.width() * k / kPlaces) - ball.frame.origin) / ball.radius;
        for (int i = 1; k > 0 && i < kBetween; ++i)
          result.push_back(glm::normalize(before + static_cast<double>(i) / kBetween * (d - before)));
        result.push_back(d);
        before = d;
      }
    }
  return result;
}

// The cosine between the nearest of these and a place of the seam, x over z to -z.
double nearness(const Frame& frame, const std::vector<Vec3>& directions, double enough) {
  double nearest = -1;
  for (const Vec3& d : directions) {
    const Vec3 p = frame.to_local_direction(d);
    nearest = std::max(nearest, p.x > 0 ? std::sqrt(p.x * p.x + p.z * p.z) : std::abs(p.z));
    if (nearest >= enough) break;
  }
  return nearest;
}

// The frame whose seam and poles stay farthest from the curves, of those of a grid; the own one where that is clear.
std::optional<Frame> clear_frame(const Frame& own, const std::vector<Vec3>& directions) {
  constexpr double kClear = 0.999, kClearEnough = 0.99;  // cosines
  constexpr int kPoles = 80, kMeridians = 16;
  if (directions.empty() || nearness(own, directions, kClear) < kClear) return std::nullopt;
  Frame best;
  double least = kClearEnough;
  for (int i = 0; i < kPoles; ++i) {
    // Over half of a sphere, by the golden angle.
    const double height = (i + 0.5) / kPoles, turn = i * kPi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - height * height);
    const Frame about = frame_about(own.origin, {r * std::cos(turn), r * std::sin(turn), height});
    for (int k = 0; k < kMeridians; ++k) {
      const double angle = kTwoPi * k / kMeridians;
      const Frame frame = frame_from(own.origin, about.z, std::cos(angle) * about.x + std::sin(angle) * about.y);
      const double near = nearness(frame, directions, least);
      if (near < least) least = near, best = frame;
    }
  }
  return least < kClearEnough ? std::optional(best) : std::nullopt;
}

std::optional<Frame> better_frame(const Body& body, const Body& other, const Ball& ball) {
  const Cuts cuts = cuts_by(other, ball);
  const Frame& own = ball.frame;
  if (cuts.axes == Axes::one) {
    const Axis& axis = cuts.axis;
    if (glm::length(glm::cross(axis.z, own.z)) <= kSame) return std::nullopt;
    return axis.x == Vec3(0) ? frame_about(own.origin, axis.z) : frame_from(own.origin, axis.z, axis.x);
  }
  if (cuts.axes != Axes::several) return std::nullopt;
  return clear_frame(own, cut_directions(other, cuts.faces, body.faces[0].surface, ball));
}

}  // namespace

std::optional<Body> turned_ball(const Body& body, const Body& other) {
  const std::optional<Ball> whole = whole_ball(body);
  const auto frame = whole ? better_frame(body, other, *whole) : std::nullopt;
  if (!frame) return std::nullopt;
  Body turned = ball(*frame, whole->radius);
  for (size_t k = 0; k < turned.vertices.size(); ++k) turned.vertices[k].origin = body.vertices[k].origin;
  for (size_t k = 0; k < turned.edges.size(); ++k) turned.edges[k].origin = body.edges[k].origin;
  turned.faces[0].origin = body.faces[0].origin;
  return turned;
}

}  // namespace lekalo::geometry
