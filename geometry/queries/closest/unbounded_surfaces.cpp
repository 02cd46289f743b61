#include "geometry/queries/closest/unbounded_surfaces.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_corners.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Below this sine of the angle between them directions are parallel: rounding.
constexpr double kParallelDirections = 1e-14;

// The box, and a border around, in the coordinates of a frame.
Box3 seen_from(const Frame& frame, const Box3& box) {
  Box3 local;
  for (const Vec3& corner : corners(box)) local.include(frame.to_local_point(corner));
  return local.inflated(std::max(box.diameter(), 1e-3 * glm::length(box.center() - frame.origin)) + 1e-300);
}

// Of a domain that has an end on one side: what lies wholly beyond is nearest to a strip along that.
Interval clamped(const Interval& domain, double lo, double hi) {
  Interval part{domain.clamp(lo), domain.clamp(hi)};
  if (part.width() > 0) return part;
  if (part.lo == domain.lo)
    part.hi = domain.clamp(part.lo + (hi - lo));
  else
    part.lo = domain.clamp(part.hi - (hi - lo));
  return part;
}

SurfacePtr part_of(const Plane& plane, const Box3& box) {
  const Box3 local = seen_from(plane.frame(), box);
  const Rectangle all = plane.domain();
  return std::make_shared<Plane>(
      plane.frame(), Rectangle{clamped(all.u, local.lo.x, local.hi.x), clamped(all.v, local.lo.y, local.hi.y)});
}

// The foot points on a cylinder are as high as their point, those on a cone no farther from the apex.
SurfacePtr part_of(const ConeSurface& cone, const Box3& box) {
  const Box3 local = seen_from(cone.frame(), box);
  double lo = local.lo.z, hi = local.hi.z;
  if (const double widening = cone.top_radius() - cone.radius(); widening != 0) {
    const double apex = -cone.radius() / widening * cone.height();
    double reach = 0;
    for (const Vec3& corner : corners(local)) reach = std::max(reach, glm::length(corner - Vec3(0, 0, apex)));
    lo = apex - reach, hi = apex + reach;
  }
  const double v = lo / cone.height(), w = hi / cone.height();
  const Rectangle domain{cone.domain().u, clamped(cone.domain().v, std::min(v, w), std::max(v, w))};
  return std::make_shared<ConeSurface>(cone.frame(), cone.radius(), cone.top_radius(), cone.height(), domain);
}

// A plane, or the axis of a cylinder with its radius.
struct Whole {
  const Surface* surface;
  Frame frame;
  double radius = 0;  // 0 of a plane
  double height = 1;  // of a cylinder: what v = 1 is
  bool is_plane() const { return radius == 0; }

  DistancePlace at(const Vec3& p) const {
    const Vec3 local = frame.to_local_point(p);
    DistancePlace place{.kind = DistancePlace::Kind::surface};
    if (is_plane()) {
      place.u = local.x, place.v = local.y;
    } else {
      const double angle = std::atan2(local.y, local.x);
      place.u = angle < 0 ? angle + kTwoPi : angle, place.v = local.z / height;
    }
    place.point = surface->point(place.u, place.v);
    return place;
  }
};

std::optional<Whole> whole(const Surface& surface) {
  if (const auto* plane = dynamic_cast<const Plane*>(&surface); plane && plane->is_whole())
    return Whole{&surface, plane->frame()};
  const auto* cone = dynamic_cast<const ConeSurface*>(&surface);
  if (!cone || cone->radius() != cone->top_radius()) return std::nullopt;
  const Rectangle domain = cone->domain();
  if (domain.v.lo > -kInfinity || domain.v.hi < kInfinity || domain.u.lo > 0 || domain.u.hi < kTwoPi)
    return std::nullopt;
  return Whole{&surface, cone->frame(), std::abs(cone->radius()), cone->height()};
}

struct Gap {
  Vec3 on_a{0}, on_b{0};  // no places of cylinders and planes that meet
  double distance = 0;
  bool isolated = false;
  bool coaxial = false;
};

// Parallel ones have a gap all along, others meet.
Gap between_planes(const Frame& a, const Frame& b) {
  const Vec3 across = glm::cross(a.z, b.z);
  const double sine = glm::length(across), height = glm::dot(a.z, b.origin - a.origin);
  if (sine <= kParallelDirections) return {b.origin - height * a.z, b.origin, std::abs(height)};
  // From the foot of b's origin towards the line in which they meet.
  const Vec3 foot = b.origin - height * a.z, towards = glm::cross(across, a.z) / sine;
  const Vec3 common = foot + glm::dot(b.z, b.origin - foot) / glm::dot(b.z, towards) * towards;
  return {common, common};
}

Gap plane_to_cylinder(const Frame& plane, const Frame& axis, double radius) {
  const double slope = glm::dot(plane.z, axis.z), height = glm::dot(plane.z, axis.origin - plane.origin);
  if (std::abs(slope) <= kParallelDirections && std::abs(height) > radius) {
    const Vec3 on_plane = axis.origin - height * plane.z;
    return {on_plane, axis.origin - std::copysign(radius, height) * plane.z, std::abs(height) - radius};
  }
  // A point of the cylinder at right angles to the plane's slope, which lies at the height h over it.
  const Vec3 level = glm::cross(plane.z, axis.z);
  const bool is_upright = glm::length(level) <= kParallelDirections;
  if (std::abs(slope) > kParallelDirections) {
    const Vec3 side = is_upright ? axis.x : glm::normalize(level);
    const Vec3 common = axis.origin + radius * side - height / slope * axis.z;
    return {common, common};
  }
  const double sideways = std::sqrt(std::max(radius * radius - height * height, 0.0));
  const Vec3 common = axis.origin - height * plane.z + sideways * glm::normalize(level);
  return {common, common};
}

Gap between_cylinders(const Frame& a, double radius_a, const Frame& b, double radius_b) {
  const Vec3 way = b.origin - a.origin, across = glm::cross(a.z, b.z);
  const double sine = glm::length(across);
  if (sine <= kParallelDirections) {
    const Vec3 off = way - glm::dot(way, a.z) * a.z;
    // Of coaxial ones rounding is left, whose direction tells nothing.
    const double apart =
        glm::length(off) > kParallelDirections * (radius_a + radius_b + glm::length(way)) ? glm::length(off) : 0;
    const Vec3 level = b.origin - off;  // on the axis of a
    const Vec3 out = apart > 0 ? off / apart : a.x;
    const double gap = std::max(apart - radius_a - radius_b, std::abs(radius_a - radius_b) - apart);
    if (gap > 0) {
      // Outside of each other, or one about the other.
      const bool outside = apart > radius_a + radius_b;
      const double side_a = outside || radius_a > radius_b ? 1 : -1, side_b = outside ? -1 : side_a;
      return {level + side_a * radius_a * out, b.origin + side_b * radius_b * out, gap, false, apart == 0};
    }
    // The circles cross at the distance x from the first axis.
    const double x = (apart * apart + radius_a * radius_a - radius_b * radius_b) / (2 * apart);
    const Vec3 aside = glm::cross(a.z, out);
    const Vec3 common = apart > 0 ? level + x * out + std::sqrt(std::max(radius_a * radius_a - x * x, 0.0)) * aside
                                  : level + radius_a * out;
    return {common, common};
  }
  // Along the common perpendicular of the axes.
  const Vec3 normal = across / sine;
  const double apart = glm::dot(way, normal);
  const Vec3 on_a = a.origin + glm::dot(glm::cross(way, b.z), across) / (sine * sine) * a.z;
  const Vec3 on_b = b.origin + glm::dot(glm::cross(way, a.z), across) / (sine * sine) * b.z;
  const double gap = std::abs(apart) - radius_a - radius_b;
  const Vec3 towards = std::copysign(1.0, apart) * normal;
  if (gap > 0) return {on_a + radius_a * towards, on_b - radius_b * towards, gap, true};
  // They meet at a height over both axes that both reach: level lines of both there cross.
  const double lo = std::max(-radius_a, std::abs(apart) - radius_b),
               hi = std::min(radius_a, std::abs(apart) + radius_b);
  const double height = 0.5 * (lo + hi);
  const double side_a = std::sqrt(std::max(radius_a * radius_a - height * height, 0.0)),
               of_b = std::abs(apart) - height, side_b = std::sqrt(std::max(radius_b * radius_b - of_b * of_b, 0.0));
  // Level lines p = on_a + height towards + side_a (a.z x towards) + s a.z, and the like of b.
  const Vec3 p = on_a + height * towards + side_a * glm::cross(a.z, towards),
             q = on_b - of_b * towards + side_b * glm::cross(b.z, towards);
  const Vec3 common = p + glm::dot(glm::cross(q - p, b.z), across) / (sine * sine) * a.z;
  return {common, common};
}

Gap gap_of(const Whole& a, const Whole& b) {
  if (a.is_plane() && b.is_plane()) return between_planes(a.frame, b.frame);
  if (a.is_plane()) return plane_to_cylinder(a.frame, b.frame, b.radius);
  if (!b.is_plane()) return between_cylinders(a.frame, a.radius, b.frame, b.radius);
  Gap gap = plane_to_cylinder(b.frame, a.frame, a.radius);
  std::swap(gap.on_a, gap.on_b);
  return gap;
}

}  // namespace

SurfacePtr part_near(const Surface& surface, const Box3& box) {
  if (const auto* plane = dynamic_cast<const Plane*>(&surface)) return part_of(*plane, box);
  if (const auto* cone = dynamic_cast<const ConeSurface*>(&surface)) return part_of(*cone, box);
  return nullptr;
}

std::optional<Distance> unbounded_distance(const Surface& a, const Surface& b) {
  const auto whole_a = whole(a), whole_b = whole(b);
  if (!whole_a || !whole_b) return std::nullopt;
  const Gap gap = gap_of(*whole_a, *whole_b);
  DistanceMinimum minimum{whole_a->at(gap.on_a), whole_b->at(gap.on_b), gap.distance, gap.isolated};
  Distance result{gap.distance, gap.distance, gap.distance == 0, {}};
  if (result.meet) {
    minimum.isolated = true;
  } else if (!minimum.isolated) {
    // As far as both are parallel: without end along axes and planes; round cylinders only where they are coaxial.
    const auto range = [&](const Whole& of, const Whole& other, const DistancePlace& at) {
      const Interval endless = Interval::entire();
      if (!of.is_plane())
        return std::array<Interval, 2>{gap.coaxial ? of.surface->domain().u : Interval(at.u), endless};
      if (other.is_plane()) return std::array<Interval, 2>{endless, endless};
      // A line of the plane; along one of its axes, or as far as known.
      const Vec3 along = of.frame.to_local_direction(other.frame.z);
      return std::array<Interval, 2>{std::abs(along.x) > kParallelDirections ? endless : Interval(at.u),
                                     std::abs(along.y) > kParallelDirections ? endless : Interval(at.v)};
    };
    minimum.range_a = range(*whole_a, *whole_b, minimum.a), minimum.range_b = range(*whole_b, *whole_a, minimum.b);
  }
  // The places come by rounded arithmetic.
  result.bound = std::max(0.0, gap.distance - 1e-14 * (gap.distance + whole_a->radius + whole_b->radius));
  result.minima.push_back(minimum);
  return result;
}

}  // namespace lekalo::geometry
