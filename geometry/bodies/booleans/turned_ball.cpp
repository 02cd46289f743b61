#include "geometry/bodies/booleans/turned_ball.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-13;  // of directions, and of lengths by the radius

const SphereSurface* whole_ball(const Body& body) {
  if (body.faces.size() != 1 || body.faces[0].trimmed || !body.faces[0].forward) return nullptr;
  const auto* sphere = dynamic_cast<const SphereSurface*>(body.faces[0].surface.get());
  if (!sphere || sphere->reversed()) return nullptr;
  const Rectangle full = SphereSurface::kFull, domain = sphere->domain();
  return domain.u == full.u && domain.v == full.v ? sphere : nullptr;
}

// About z a surface cuts the sphere in circles; x is where its own seam is.
struct Axis {
  Vec3 z, x;
};

std::optional<Axis> axis_through(const Frame& frame, const SphereSurface& sphere) {
  const Vec3 from = sphere.frame().origin - frame.origin;
  if (glm::length(from - glm::dot(from, frame.z) * frame.z) > kSame * (sphere.radius() + glm::length(from)))
    return std::nullopt;
  return Axis{frame.z, frame.x};
}

bool is_elementary(const Surface& surface) {
  return dynamic_cast<const Plane*>(&surface) || dynamic_cast<const ConeSurface*>(&surface) ||
         dynamic_cast<const TorusSurface*>(&surface) || dynamic_cast<const SphereSurface*>(&surface);
}

std::optional<Axis> axis_of(const Surface& surface, const SphereSurface& sphere) {
  if (const auto* plane = dynamic_cast<const Plane*>(&surface)) return Axis{plane->frame().z, Vec3(0)};
  if (const auto* cone = dynamic_cast<const ConeSurface*>(&surface)) return axis_through(cone->frame(), sphere);
  if (const auto* torus = dynamic_cast<const TorusSurface*>(&surface)) return axis_through(torus->frame(), sphere);
  if (const auto* other = dynamic_cast<const SphereSurface*>(&surface)) {
    const Vec3 between = other->frame().origin - sphere.frame().origin;
    const double length = glm::length(between);
    if (length > kSame * sphere.radius()) return Axis{between / length, Vec3(0)};
  }
  return std::nullopt;
}

bool may_meet(const Body& body, int face, const SphereSurface& sphere) {
  const Vec3 center = sphere.frame().origin;
  const auto* plane = dynamic_cast<const Plane*>(body.faces[face].surface.get());
  if (plane && std::abs(glm::dot(center - plane->frame().origin, plane->frame().z)) >= sphere.radius()) return false;
  const Box3 box = bounds(body, face);
  const Vec3 nearest = glm::clamp(center, box.lo, box.hi);
  return glm::length(nearest - center) < sphere.radius();
}

// A body has faces on one axis through the center, or on several, or such as are not known of.
enum class Axes { none, one, several, unknown };

struct Cuts {
  Axes axes = Axes::none;
  Axis axis{};
  std::vector<int> faces;
};

Cuts cuts_by(const Body& other, const SphereSurface& sphere) {
  Cuts cuts;
  for (size_t f = 0; f < other.faces.size(); ++f) {
    if (!may_meet(other, static_cast<int>(f), sphere)) continue;
    const Surface& surface = *other.faces[f].surface;
    cuts.faces.push_back(static_cast<int>(f));
    if (!is_elementary(surface)) return {Axes::unknown, {}, {}};
    const auto found = axis_of(surface, sphere);
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
                                 const SphereSurface& sphere) {
  constexpr int kPlaces = 48;
  std::vector<Vec3> result;
  for (const int f : faces)
    for (const Contour& contour : intersect(whole, other.faces[f].surface).branches) {
      const Interval t = contour.curve->domain();
      for (int k = 0; k <= kPlaces; ++k)
        result.push_back((contour.curve->point(t.lo + t.width() * k / kPlaces) - sphere.frame().origin) /
                         sphere.radius());
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

std::optional<Frame> better_frame(const Body& body, const Body& other, const SphereSurface& sphere) {
  const Cuts cuts = cuts_by(other, sphere);
  const Frame& own = sphere.frame();
  if (cuts.axes == Axes::one) {
    const Axis& axis = cuts.axis;
    if (glm::length(glm::cross(axis.z, own.z)) <= kSame) return std::nullopt;
    return axis.x == Vec3(0) ? frame_about(own.origin, axis.z) : frame_from(own.origin, axis.z, axis.x);
  }
  if (cuts.axes != Axes::several) return std::nullopt;
  return clear_frame(own, cut_directions(other, cuts.faces, body.faces[0].surface, sphere));
}

}  // namespace

std::optional<Body> turned_ball(const Body& body, const Body& other) {
  const SphereSurface* sphere = whole_ball(body);
  const auto frame = sphere ? better_frame(body, other, *sphere) : std::nullopt;
  if (!frame) return std::nullopt;
  Body turned = ball(*frame, sphere->radius());
  for (size_t k = 0; k < turned.vertices.size(); ++k) turned.vertices[k].origin = body.vertices[k].origin;
  for (size_t k = 0; k < turned.edges.size(); ++k) turned.edges[k].origin = body.edges[k].origin;
  turned.faces[0].origin = body.faces[0].origin;
  return turned;
}

}  // namespace lekalo::geometry
