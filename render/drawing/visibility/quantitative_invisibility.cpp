#include "render/drawing/visibility/quantitative_invisibility.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

using namespace geometry;

namespace {

// Rays to a border are aimed a little inside of it, and a surface that joins there may lie before it, but not by more
// than this along the line of sight, of the radius: a sheet that goes round near the border does.
constexpr double kBeforeBorder = 1e-7;
// Where one singular value of (s_u, s_v), over the domain's widths, is so small a part of the other the surface has no
// normal.
constexpr double kNoNormal = 1e-6;
// How far beside a line rays are aimed, of the scene's radius; and how much an outline's surface must bend along the
// line of sight for that, times the radius.
constexpr double kBeside = 1e-6, kBends = 1e-9;
// Inside of a border, of the domain: enough that a ray need not be found to meet the border itself, and less than
// kBeforeBorder, as another surface that joins it there may lie before it.
constexpr double kInside = 1e-12;
constexpr double kShareAside = 1e-3;  // of a stretch's length
// A sheet no farther across the line than this many times what a ray is aimed beside an outline may touch it: one that
// bends away from it is twice as far.
constexpr double kTouched = 8;
// A face whose normal stands across the sight but for this is seen edge-on.
constexpr double kEdgeOn = 1e-9;

}  // namespace

QuantitativeInvisibility::QuantitativeInvisibility(const World& world)
    : world_(world),
      camera_(*world.model().camera),
      eye_(camera_.ray(0.5 * camera_.width(), 0.5 * camera_.height()).origin) {}

int QuantitativeInvisibility::before(const Stroke& stroke, const ProjectedCurve& curve, double t,
                                     double lateral_offset) {
  const Own own = own_sheets(stroke);
  const std::optional<Vec3> across = normal_seen_edge_on(stroke, curve, t);
  if (!across) {
    const Count count = count_before(probe(stroke, curve, t, lateral_offset), own);
    if (stroke.kind != "silhouette" || !(count.nearest <= kTouched * lateral_offset)) return count.layers;
    // What touches the surface from outside along its outline lies before all that is beside the line, the less the
    // nearer to it.
    const Own touching{kTouched * kMinLateralOffset, kInfinity};
    return std::min(count.layers, count_before(probe(stroke, curve, t, kMinLateralOffset), touching).layers);
  }
  // Rays would run along the face. What it is the outline of hides the line on one side alone.
  const Vec3 exact = curve.tangent(t).origin, by = lateral_offset * world_.radius() * *across;
  return std::min(count_before(exact + by, own).layers, count_before(exact - by, own).layers);
}

// Of a surface on which a line lies, where it is seen edge-on.
std::optional<Vec3> QuantitativeInvisibility::normal_seen_edge_on(const Stroke& stroke, const ProjectedCurve& curve,
                                                                  double t) const {
  if (stroke.kind == "silhouette") return std::nullopt;
  for (const Stroke::SupportingSurface& supporting_surface : stroke.supporting_surfaces) {
    const Vec3 uv = supporting_surface.image->point(t);
    const Vec3 normal = glm::normalize(stroke.to_world.normal(supporting_surface.surface->normal(uv.x, uv.y)));
    const Vec3 sight =
        camera_.is_parallel() ? camera_.view_direction() : glm::normalize(curve.tangent(t).origin - eye_);
    if (std::abs(glm::dot(normal, sight)) < kEdgeOn) return normal;
  }
  return std::nullopt;
}

QuantitativeInvisibility::Own QuantitativeInvisibility::own_sheets(const Stroke& stroke) const {
  if (stroke.met != -2) return {};
  // Known to lie on what they belong to as exactly as lines are found, the surfaces given or not.
  if (!stroke.supporting_surfaces.empty())
    return stroke.kind == "boundary" ? Own{kTouch, kBeforeBorder} : Own{kOnSupportingSurface, kInfinity};
  const bool is_of_shape =
      stroke.object >= 0 && std::holds_alternative<ShapePtr>(world_.objects()[stroke.object]->shape);
  return is_of_shape ? Own{kOnSupportingSurface, kInfinity} : Own();
}

double QuantitativeInvisibility::room_beside(const ProjectedCurve& curve, const Interval& t) const {
  const Vec2 chord = curve.place(t.hi).p - curve.place(t.lo).p;
  const double length = glm::length(chord) * camera_.pixel_size(curve.tangent(t.middle()).origin);
  return std::clamp(kShareAside * length / world_.radius(), kMinLateralOffset, kBeside);
}

// The point at which a ray is aimed for a point of a line. Rays along an outline touch its surface, and rays to a
// border of a surface meet it or not: both are found slowly, so that they are aimed a little outside of the outline,
// where its surface does not go, and a little inside of the border.
Vec3 QuantitativeInvisibility::probe(const Stroke& stroke, const ProjectedCurve& curve, double t,
                                     double lateral_offset) const {
  const Vec3 exact = curve.tangent(t).origin;
  if (stroke.outward_offset) {
    const Vec3 out = stroke.to_world.direction(stroke.outward_offset->point(t));
    return exact + lateral_offset * world_.radius() / glm::length(out) * out;
  }
  if (stroke.supporting_surfaces.size() != 1) return exact;
  const Surface& surface = *stroke.supporting_surfaces[0].surface;
  Vec3 uv = stroke.supporting_surfaces[0].image->point(t);
  if (stroke.kind == "silhouette") {
    const SurfaceJet s = surface.evaluate(uv.x, uv.y, 2);
    const double e = glm::dot(s.du(), s.du()), f = glm::dot(s.du(), s.dv()), g = glm::dot(s.dv(), s.dv());
    const double area = e * g - f * f;
    const Rectangle domain = surface.domain();
    const double wide = domain.u.width() * domain.u.width(), high = domain.v.width() * domain.v.width(),
                 largest = kNoNormal * std::max(e * wide, g * high);
    if (!(area * wide * high > largest * largest)) return beside_cuspidal_edge(stroke, exact, s, lateral_offset);
    const Affine back = stroke.to_world.inverse();
    const Vec3 sight = glm::normalize(back.direction(camera_.is_parallel() ? camera_.view_direction() : exact - eye_));
    const Vec3 normal = glm::normalize(glm::cross(s.du(), s.dv()));
    // The line of sight is tangent, sight = a s_u + b s_v: the surface bends to one side along it.
    const double x = glm::dot(sight, s.du()), y = glm::dot(sight, s.dv());
    const double a = (g * x - f * y) / area, b = (e * y - f * x) / area;
    const double bend = glm::dot(normal, s.duu() * a * a + 2.0 * s.duv() * a * b + s.dvv() * b * b);
    const double size = world_.radius();
    if (!(std::abs(bend) * size > kBends)) return exact;
    const Vec3 out = stroke.to_world.direction(bend > 0 ? -normal : normal);
    return exact + lateral_offset * size / glm::length(out) * out;
  }
  if (stroke.kind != "boundary" || std::holds_alternative<BodyPtr>(world_.objects()[stroke.object]->shape))
    return exact;
  const Rectangle domain = surface.domain();
  const double inside = std::min(lateral_offset, kInside);
  uv.x += inside * (domain.u.middle() - uv.x), uv.y += inside * (domain.v.middle() - uv.y);
  return stroke.to_world.point(surface.point(uv.x, uv.y));
}

// Where s_u and s_v are parallel, a s_u + b s_v = 0, both sheets go away from the edge along the second derivative in
// that direction of the parameters.
Vec3 QuantitativeInvisibility::beside_cuspidal_edge(const Stroke& stroke, const Vec3& exact, const SurfaceJet& s,
                                                    double lateral_offset) const {
  const bool by_u = glm::length(s.du()) > glm::length(s.dv());
  const Vec3 along = by_u ? s.du() : s.dv();
  const double square = glm::dot(along, along), share = glm::dot(s.du(), s.dv()) / square;
  if (!(square > 0)) return exact;
  const double a = by_u ? -share : 1, b = by_u ? 1 : -share;
  Vec3 away = s.duu() * a * a + 2.0 * s.duv() * a * b + s.dvv() * b * b;
  away = stroke.to_world.direction(away - glm::dot(away, along) / square * along);
  return glm::length(away) > 0 ? exact - lateral_offset * world_.radius() / glm::length(away) * away : exact;
}

QuantitativeInvisibility::Count QuantitativeInvisibility::count_before(const Vec3& point, const Own& own) {
  ++rays_;
  const PicturePoint at = camera_.project(point);
  Ray ray = camera_.ray(at.x, at.y);
  ray.t_max = at.depth;
  Count count;
  for (const Hit& hit : world_.all_hits(ray)) {
    if (!(hit.t < at.depth)) continue;
    const SurfacePoint met = world_.surface_point(ray, hit);
    const double along = at.depth - hit.t, across = along * std::abs(glm::dot(ray.direction, met.geometric_normal));
    const auto passes = [&](double near) { return across <= near * world_.radius() + 4 * met.error; };
    if (passes(kOnSupportingSurface) || (passes(own.across) && along <= own.along * world_.radius())) continue;
    ++count.layers;
    count.nearest = std::min(count.nearest, across / world_.radius());
  }
  return count;
}

}  // namespace lekalo::render
