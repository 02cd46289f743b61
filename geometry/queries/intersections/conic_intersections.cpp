#include "geometry/queries/intersections/conic_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/queries/intersections/curve_pair.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/queries/quadrics/conic.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// With the curve's own parameter.
std::optional<Conic> conic_of(const Curve& curve) {
  if (const auto* part = dynamic_cast<const CurvePart*>(&curve)) return conic_of(*part->of());
  if (const auto* moved = dynamic_cast<const TransformedCurve*>(&curve)) {
    const std::optional<Conic> own = conic_of(*moved->original());
    return own ? std::optional(mapped(*own, moved->map().linear, moved->map().point(own->origin))) : std::nullopt;
  }
  if (const auto* segment = dynamic_cast<const Segment*>(&curve))
    return Conic{Conic::Kind::line, segment->from(), Vec3(0), segment->to() - segment->from()};
  if (const auto* ellipse = dynamic_cast<const Ellipse*>(&curve)) {
    const Frame& frame = ellipse->frame();
    return Conic{Conic::Kind::ellipse, frame.origin, ellipse->semi_axis_x() * frame.x,
                 ellipse->semi_axis_y() * frame.y};
  }
  if (const auto* parabola = dynamic_cast<const Parabola*>(&curve)) {
    const Frame& frame = parabola->frame();
    const double f = parabola->focal_length();
    return Conic{Conic::Kind::parabola, frame.origin, f * frame.x, 2 * f * frame.y};
  }
  if (const auto* hyperbola = dynamic_cast<const Hyperbola*>(&curve)) {
    const Frame& frame = hyperbola->frame();
    return Conic{Conic::Kind::hyperbola, frame.origin, hyperbola->semi_axis_x() * frame.x,
                 hyperbola->semi_axis_y() * frame.y};
  }
  return std::nullopt;
}

class ConicAndPlane {
 public:
  ConicAndPlane(const Curve& curve, const Conic& conic, const CanonicalSurface& plane, double tolerance)
      : curve_(curve), conic_(conic), plane_(plane), normal_(plane.normal()), tolerance_(tolerance) {}

  SurfaceIntersections run() {
    const Interval t = curve_.domain();
    const std::vector<double> turns = in_domain(stationary(normal_));
    std::vector<double> places = turns;
    places.insert(places.end(), {t.lo, t.hi});
    if (std::all_of(places.begin(), places.end(), [&](double at) { return is_in_plane(at); })) {
      find_parts();
    } else {
      std::vector<double> roots = in_domain(plane_roots(conic_, normal_, glm::dot(normal_, plane_.origin)));
      // Two that no tolerance tells apart are one contact, as is a double one.
      const bool is_double = roots.size() == 1 && std::any_of(turns.begin(), turns.end(),
                                                              [&](double turn) { return !are_apart(roots[0], turn); });
      const bool is_one = roots.size() == 2 && !turns.empty() &&
                          (!are_apart(roots[0], roots[1]) || std::any_of(turns.begin(), turns.end(), [&](double turn) {
                            return std::abs(height(turn)) <= rounding();
                          }));
      if (is_double || is_one) roots.clear();
      for (const double root : roots) add(root, false);
      if (roots.empty())
        for (const double at : places) add(at, true);
    }
    std::sort(result_.points.begin(), result_.points.end(),
              [](const SurfaceIntersection& a, const SurfaceIntersection& b) { return a.t < b.t; });
    return std::move(result_);
  }

 private:
  double height(double t) const { return glm::dot(normal_, curve_.point(t) - plane_.origin); }
  // Of heights: between two roots whose sagitta is no more the curve is as good as tangent.
  double rounding() const {
    constexpr double kUlps = 4 * std::numeric_limits<double>::epsilon();
    return kUlps * (glm::length(conic_.origin - plane_.origin) + glm::length(conic_.x) + glm::length(conic_.y));
  }
  bool is_in_plane(double t) const { return std::abs(height(t)) <= tolerance_; }
  bool are_apart(double a, double b) const { return glm::length(curve_.point(a) - curve_.point(b)) > 4 * tolerance_; }

  // Where the height along a direction is greatest and least.
  std::vector<double> stationary(const Vec3& along) const {
    const double x = glm::dot(along, conic_.x), y = glm::dot(along, conic_.y);
    switch (conic_.kind) {
      case Conic::Kind::line:
        return {};
      case Conic::Kind::parabola:
        return x != 0 ? std::vector<double>{-0.5 * y / x} : std::vector<double>();
      case Conic::Kind::hyperbola:
        return std::abs(y) < std::abs(x) ? std::vector<double>{std::atanh(-y / x)} : std::vector<double>();
      case Conic::Kind::ellipse:
        return {std::atan2(y, x), std::atan2(y, x) + kPi};
    }
    return {};
  }

  // Of an ellipse's angles those on the arc; what rounding and the tolerance take beyond an end is that end.
  std::vector<double> in_domain(const std::vector<double>& places) const {
    const Interval t = curve_.domain();
    const double slack = slack_of(curve_, t, tolerance_);
    std::vector<double> result;
    for (double place : places) {
      if (conic_.is_closed()) place -= kTwoPi * std::floor((place - (t.lo - slack)) / kTwoPi);
      if (place >= t.lo - slack && place <= t.hi + slack) result.push_back(t.clamp(place));
    }
    return result;
  }

  // Of the surface's point nearest to that of the curve.
  SurfaceIntersection at(double t) const {
    const Vec3 point = curve_.point(t), local = plane_.local(point);
    const Rectangle domain = plane_.surface->domain();
    const double u = domain.u.clamp(local.x), v = domain.v.clamp(local.y);
    return {t, u, v, point, glm::length(plane_.surface->point(u, v) - point)};
  }
  bool is_on_surface(double t) const { return at(t).distance <= tolerance_; }

  void find_parts() {
    const Interval domain = curve_.domain();
    std::vector<double> cuts;
    const Mat3 normals = glm::transpose(plane_.to_local);
    for (const CanonicalSurface::Border& border : plane_.borders()) {
      const Vec3 normal = normals * border.normal;
      const double height = border.height + glm::dot(normal, plane_.origin);
      for (const double root : plane_roots(conic_, normal, height)) cuts.push_back(root);
    }
    cuts = in_domain(cuts);
    cuts.insert(cuts.end(), {domain.lo, domain.hi});
    std::sort(cuts.begin(), cuts.end());
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Interval part{cuts[k], cuts[k + 1]};
      if (!are_apart(part.lo, part.hi) && !are_apart(part.lo, part.middle())) continue;
      if (!is_on_surface(part.middle())) continue;
      std::vector<Interval>& parts = result_.on_surface;
      if (!parts.empty() && !are_apart(parts.back().hi, part.lo))
        parts.back().hi = part.hi;
      else
        parts.push_back(part);
    }
    const auto ends_part = [&](double t) {
      return std::any_of(result_.on_surface.begin(), result_.on_surface.end(), [&](const Interval& part) {
        return part.contains(t) || !are_apart(part.lo, t) || !are_apart(part.hi, t);
      });
    };
    for (const double cut : cuts)
      if (!ends_part(cut)) add(cut, true);
  }

  void add(double t, bool contact) {
    SurfaceIntersection intersection = at(t);
    if (!(intersection.distance <= tolerance_)) return;
    const Vec3 tangent = curve_.evaluate(t, 1).d[1];
    intersection.contact = contact && std::abs(glm::dot(tangent, normal_)) < kParallel * glm::length(tangent);
    for (const SurfaceIntersection& other : result_.points)
      if (!are_apart(other.t, t)) return;
    result_.points.push_back(intersection);
  }

  const Curve& curve_;
  const Conic& conic_;
  const CanonicalSurface& plane_;
  const Vec3 normal_;
  const double tolerance_;
  SurfaceIntersections result_;
};

}  // namespace

std::optional<SurfaceIntersections> conic_intersections(const Curve& curve, const Surface& surface, double tolerance) {
  const std::optional<Conic> conic = conic_of(curve);
  if (!conic) return std::nullopt;
  const auto plane = canonical(SurfacePtr(SurfacePtr(), &surface));
  if (!plane || plane->kind != CanonicalSurface::Kind::plane) return std::nullopt;
  return ConicAndPlane(curve, *conic, *plane, tolerance).run();
}

std::optional<CurveIntersections> line_conic_intersections(const Curve& a, const Curve& b, double tolerance) {
  const std::optional<Conic> of_a = conic_of(a), of_b = conic_of(b);
  if (!of_a || !of_b || (of_a->kind == Conic::Kind::line) == (of_b->kind == Conic::Kind::line)) return std::nullopt;
  const bool a_is_line = of_a->kind == Conic::Kind::line;
  const Conic &line = a_is_line ? *of_a : *of_b, &conic = a_is_line ? *of_b : *of_a;
  const Curve &straight = a_is_line ? a : b, &round = a_is_line ? b : a;
  const Vec3 across = glm::cross(line.y, glm::cross(conic.x, conic.y));
  if (!(glm::length(across) > kParallel * glm::length(line.y) * glm::length(conic.x) * glm::length(conic.y)))
    return std::nullopt;
  const Plane plane(frame_from(line.origin, across, line.y));
  CurveIntersections result;
  const double slack = slack_of(straight, straight.domain(), tolerance);
  for (const SurfaceIntersection& found :
       ConicAndPlane(round, conic, *canonical(SurfacePtr(SurfacePtr(), &plane)), tolerance).run().points) {
    const double s = glm::dot(found.point - line.origin, line.y) / glm::dot(line.y, line.y);
    const Interval domain = straight.domain();
    if (s < domain.lo - slack || s > domain.hi + slack) continue;
    const double at = domain.clamp(s);
    const Vec3 on_line = straight.point(at), tangent = round.evaluate(found.t, 1).d[1];
    const double distance = glm::length(on_line - found.point);
    if (distance > tolerance) continue;
    const bool contact =
        glm::length(glm::cross(tangent, line.y)) < kParallel * glm::length(tangent) * glm::length(line.y);
    result.points.push_back({a_is_line ? at : found.t, a_is_line ? found.t : at, 0.5 * (on_line + found.point),
                             distance, found.contact && contact});
  }
  std::sort(result.points.begin(), result.points.end(),
            [](const CurveIntersection& x, const CurveIntersection& y) { return x.s < y.s; });
  return result;
}

}  // namespace lekalo::geometry
