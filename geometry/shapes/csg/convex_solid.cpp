#include "geometry/shapes/csg/convex_solid.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/parameter_range.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Beyond so many planes a hierarchy over the faces is faster than to ask them all.
constexpr size_t kMaxPlanes = 24;

// A corner this far outside a plane (of the body's size) still belongs to a convex body: rounding of its coordinates.
constexpr double kFlatCorner = 1e-12;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

ConvexSolid::Side::Side(SurfacePtr side) : surface(std::move(side)), has_closest_point(surface->has_closest_point()) {
  const Surface* original = surface.get();
  if (const auto* image = dynamic_cast<const TransformedSurface*>(original)) {
    original = image->original().get();
    mapped = true;
    map = image->map();
    inverse = map.inverse();
  }
  plane = dynamic_cast<const Plane*>(original);
  sphere = dynamic_cast<const SphereSurface*>(original);
  cone = dynamic_cast<const ConeSurface*>(original);
  if (sphere && !covers(sphere->domain(), SphereSurface::kFull)) sphere = nullptr;  // only a part of it
  // A frustum from end to end.
  if (cone && !(cone->radius() >= 0 && cone->top_radius() >= 0 && cone->height() > 0 &&
                cone->domain().u.width() >= kTwoPi && cone->domain().v.lo == 0 && cone->domain().v.hi == 1))
    cone = nullptr;
}

std::optional<ConvexSolid> ConvexSolid::of(const Body& body) {
  if (!body.is_closed() || body.shells.size() != 1) return std::nullopt;
  ConvexSolid solid;
  const int face_count = static_cast<int>(body.faces.size());
  for (int face = 0; face < face_count; ++face) {
    Side side(body.faces[face].surface);
    if (!side.plane && !side.sphere && !side.cone) return std::nullopt;
    side.sign = body.faces[face].forward ? 1 : -1;
    if (!side.plane) {
      if (solid.round_face_ >= 0) return std::nullopt;
      solid.round_face_ = face;
    }
    solid.sides_.push_back(std::move(side));
  }
  for (int face = 0; face < face_count; ++face) {
    const Side& side = solid.sides_[face];
    if (!side.plane) continue;
    const Rectangle domain = side.surface->domain();
    const double u = domain.u.middle(), v = domain.v.middle();
    solid.add_plane(face, side.surface->point(u, v), body.normal(face, u, v));
  }
  if (solid.round_face_ < 0) {
    if (solid.slabs_.size() > kMaxPlanes || !solid.holds_corners_of(body)) return std::nullopt;
    return solid;
  }
  const Side& round = solid.sides_[solid.round_face_];
  // Its normal must look away from the center or the axis.
  if (body.faces[solid.round_face_].trimmed) return std::nullopt;
  const Rectangle domain = round.surface->domain();
  const double u = domain.u.middle(), v = domain.v.middle();
  const Surface& original = round.sphere ? static_cast<const Surface&>(*round.sphere) : *round.cone;
  const Vec3 inside =
      round.sphere ? round.sphere->frame().origin : round.cone->frame().point({0, 0, v * round.cone->height()});
  const Vec3 out = original.point(u, v) - inside;
  if (!(glm::dot(body.normal(solid.round_face_, u, v), round.map.direction(out)) > 0)) return std::nullopt;
  if (round.sphere && face_count > 1) return std::nullopt;
  if (round.cone) {
    // One plane across the axis at each end that has a width.
    const double radii[2] = {round.cone->radius(), round.cone->top_radius()};
    const Frame& frame = round.cone->frame();
    const double height = round.cone->height(), size = height + radii[0] + radii[1];
    int ends = 0;
    for (int end = 0; end < 2; ++end) {
      if (radii[end] == 0) continue;
      ++ends;
      const bool found = std::any_of(solid.sides_.begin(), solid.sides_.end(), [&](const Side& side) {
        if (!side.plane) return false;
        const Frame& across = side.plane->frame();
        const Vec3 off = round.inverse.point(side.map.point(across.origin)) - frame.point({0, 0, end * height});
        const auto is_across = [&](const Vec3& d) {
          const Vec3 moved = round.inverse.direction(side.map.direction(d));
          return std::abs(glm::dot(moved, frame.z)) <= kFlatCorner * glm::length(moved);
        };
        return std::abs(glm::dot(off, frame.z)) <= kFlatCorner * size && is_across(across.x) && is_across(across.y);
      });
      if (!found) return std::nullopt;
    }
    if (face_count != ends + 1) return std::nullopt;
  }
  solid.add_round(solid.round_face_);
  return solid;
}

ConvexSolid ConvexSolid::half_space(const Frame& frame) {
  ConvexSolid solid;
  solid.sides_.emplace_back(std::make_shared<Plane>(frame));
  solid.add_plane(0, frame.origin, frame.z);
  return solid;
}

bool ConvexSolid::holds_corners_of(const Body& body) const {
  Box3 box;
  for (const Vertex& vertex : body.vertices) box.include(vertex.point);
  const double slack = kFlatCorner * (box.diameter() + glm::length(box.center()));
  return std::all_of(body.vertices.begin(), body.vertices.end(), [&](const Vertex& vertex) {
    return std::all_of(slabs_.begin(), slabs_.end(), [&](const Slab& slab) {
      const double x = glm::dot(slab.normal, vertex.point - slab.at_hi);
      return x >= -slab.depth - slack && x <= slack;
    });
  });
}

void ConvexSolid::add_plane(int face, const Vec3& through, const Vec3& normal) {
  for (Slab& slab : slabs_) {
    if (slab.normal != -normal || slab.depth < kInfinity) continue;
    slab.depth = glm::dot(slab.normal, slab.at_hi - through);
    slab.at_lo = through;
    slab.face_lo = face;
    return;
  }
  slabs_.push_back({normal, through, through, kInfinity, face, face});
}

void ConvexSolid::add_round(int face) {
  const Side& side = sides_[face];
  const Frame& frame = side.sphere ? side.sphere->frame() : side.cone->frame();
  Vec3 center = frame.origin, scale(1);
  if (side.sphere) {
    radius_ = side.sphere->radius();
    scale = Vec3(1 / radius_);
    round_ = side.mapped ? Round::ellipsoid : Round::ball;
  } else if (side.cone->radius() == side.cone->top_radius()) {
    round_ = Round::cylinder;
    scale = Vec3(1 / side.cone->radius());
    center = frame.point({0, 0, 0.5 * side.cone->height()});
    quadric_ = {{1, 1, 0}, 0, -1};
  } else {
    // The third coordinate is the radius at the height of the point. Figures matter most at the apex.
    round_ = Round::cone;
    const double radius = side.cone->radius(), widening = side.cone->top_radius() - radius,
                 height = side.cone->height(), size = std::max(radius, side.cone->top_radius());
    const double v = std::clamp(-radius / widening, 0.0, 1.0);
    center = frame.point({0, 0, v * height});
    scale = {1 / size, 1 / size, widening / (height * size)};
    unit_center_ = {0, 0, (radius + v * widening) / size};
    quadric_ = {{1, 1, -1}, 0, 0};
  }
  Mat3 rows(scale.x * frame.x, scale.y * frame.y, scale.z * frame.z);
  to_unit_ = glm::transpose(rows) * side.inverse.linear;
  center_ = side.map.point(center);
}

bool ConvexSolid::stretch(const LineOfSolids& line, Stretch& inside) const {
  inside = {};
  if (round_ == Round::ball) return clip_to_ball(line, inside);
  return clip_to_slabs(line.line, inside) && (round_ == Round::none || clip_to_quadric(line, inside));
}

// t where the line meets a plane, found again from its point there: a distant origin costs no figures.
LEKALO_FUSED bool ConvexSolid::clip_to_slabs(const Line& line, Stretch& inside) const {
  constexpr double kParallel = 4 * kEpsilon;
  const Vec3 &o = line.origin, &d = line.direction;
  const double length = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const Slab *slab_in = nullptr, *slab_out = nullptr;
  double speed_in = 1, speed_out = 1;  // inverse
  for (const Slab& slab : slabs_) {
    const double speed = glm::dot(slab.normal, d), x = glm::dot(slab.normal, slab.at_hi - o);
    if (std::abs(speed) <= kParallel * length) {
      if (x < 0 || x > slab.depth) return false;
      continue;
    }
    const double inverse = 1 / speed;
    const double at_hi = x * inverse, at_lo = (x - slab.depth) * inverse;
    const double in = inverse > 0 ? at_lo : at_hi, out = inverse > 0 ? at_hi : at_lo;
    if (in > inside.in) {
      inside.in = in;
      slab_in = &slab;
      speed_in = inverse;
    }
    if (out < inside.out) {
      inside.out = out;
      slab_out = &slab;
      speed_out = inverse;
    }
    if (inside.in > inside.out) return false;
  }
  const auto refine = [&](const Slab& slab, bool hi, double inverse, double& t) {
    t -= glm::dot(fused_at(line, t) - (hi ? slab.at_hi : slab.at_lo), slab.normal) * inverse;
    return hi ? slab.face_hi : slab.face_lo;
  };
  if (slab_in) inside.face_in = refine(*slab_in, speed_in < 0, speed_in, inside.in);
  if (slab_out) inside.face_out = refine(*slab_out, speed_out > 0, speed_out, inside.out);
  return inside.in < inside.out;
}

// About the line's point nearest to the center p: |p + s d| = R with p . d only rounding.
LEKALO_FUSED bool ConvexSolid::clip_to_ball(const LineOfSolids& line, Stretch& inside) const {
  const Vec3 &o = line.line.origin, &d = line.line.direction;
  const double start = glm::dot(center_ - o, d) * line.inverse_square;
  const Vec3 p = fused_at(line.line, start) - center_;
  const double room = (radius_ * radius_ - glm::dot(p, p)) * line.inverse_square;
  if (!(room > 0)) return false;
  const double off = glm::dot(p, d) * line.inverse_square, half = std::sqrt(room + off * off);
  inside.in = start + (-off - half);
  inside.out = start + (half - off);
  inside.face_in = inside.face_out = round_face_;
  return true;
}

// A line steeper than a cone is inside its nappe from the crossing on, or up to it; the other crossing is of the other
// nappe.
LEKALO_FUSED bool ConvexSolid::clip_to_quadric(const LineOfSolids& line, Stretch& inside) const {
  const double start = glm::dot(center_ - line.line.origin, line.line.direction) * line.inverse_square;
  const Vec3 o = to_unit_ * (fused_at(line.line, start) - center_) + unit_center_, d = to_unit_ * line.line.direction;
  const QuadricRoots roots = quadric_roots(quadric_, o, d);
  const auto keep = [&](double in, double out) {
    if (in > inside.in) {
      inside.in = in;
      inside.face_in = round_face_;
    }
    if (out < inside.out) {
      inside.out = out;
      inside.face_out = round_face_;
    }
    return inside.in < inside.out;
  };
  // Along the axis of a cylinder there is nothing to cross; a line beside a cone misses it.
  if (roots.count == 0) return round_ == Round::cylinder && quadric_.value(o) < 0;
  if (roots.count == 2 && roots.square < 0) {
    const bool rising = d.z > 0;
    const double t = start + quadric_hit(quadric_, d, roots, rising ? 1 : 0).s;
    return rising ? keep(t, kInfinity) : keep(-kInfinity, t);
  }
  const QuadricHit first = quadric_hit(quadric_, d, roots, 0);
  if (roots.count == 1) {
    if (round_ == Round::cone && first.point.z < 0) return false;
    const double t = start + first.s;
    return quadric_.half_slope(first.point, d) < 0 ? keep(t, kInfinity) : keep(-kInfinity, t);
  }
  const QuadricHit second = quadric_hit(quadric_, d, roots, 1);
  if (round_ == Round::cone && first.point.z + second.point.z < 0) return false;
  return keep(start + first.s, start + second.s);
}

ShapePoint ConvexSolid::point(int face, const Vec3& near, bool parameters) const {
  const Side& side = sides_[face];
  if (!parameters && side.has_closest_point) {
    const FootPoint foot_point = side.surface->foot_point(near);
    return {foot_point.point, side.sign * foot_point.normal};
  }
  const Vec3 at = side.mapped ? side.inverse.point(near) : near;
  const Rectangle domain = side.surface->domain();
  double u, v;
  if (side.plane) {
    const Vec3 local = side.plane->frame().to_local_point(at);
    u = domain.u.clamp(local.x);
    v = domain.v.clamp(local.y);
  } else {
    const Frame& frame = side.sphere ? side.sphere->frame() : side.cone->frame();
    const Vec3 local = frame.to_local_point(at);
    const double angle = std::atan2(local.y, local.x);
    u = angle_within(domain.u, angle).value_or(domain.u.clamp(angle));
    v = domain.v.clamp(side.sphere ? std::atan2(local.z, std::sqrt(local.x * local.x + local.y * local.y))
                                   : local.z / side.cone->height());
  }
  return point_on(*side.surface, side.sign, u, v, near);
}

}  // namespace lekalo::geometry
