#include "geometry/bodies/local/edge_curve.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/composition.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/derived/extended.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr int kSamples = 8;
// What rounding explains, relative to the size.
constexpr double kSame = 1e-12;

double at_sample(const Interval& t, int k) { return k == kSamples ? t.hi : t.lo + t.width() * k / kSamples; }

bool is_straight(const Curve& curve, double size) {
  const Interval t = curve.domain();
  const Vec3 a = curve.point(t.lo), b = curve.point(t.hi);
  for (int k = 1; k < kSamples; ++k)
    if (glm::length(curve.point(at_sample(t, k)) - (a + (b - a) * (double(k) / kSamples))) > kSame * size) return false;
  return glm::length(b - a) > kSame * size;
}

// A range that need not be continued: it goes round.
bool is_whole(const Interval& own, double period) { return period > 0 && own.width() >= period * (1 - 1e-12); }

// Rounding taken off the ends of a line: borders of the domain are met, and lines along a parameter hold the other.
void snap(Vec2& a, Vec2& b, const Rectangle& domain) {
  for (int k = 0; k < 2; ++k) {
    const Interval& own = k == 0 ? domain.u : domain.v;
    const double small = 1e-12 * own.width();
    for (Vec2* p : {&a, &b})
      for (const double border : {own.lo, own.hi})
        if (std::abs((*p)[k] - border) <= small) (*p)[k] = border;
    if (std::abs(a[k] - b[k]) <= small) b[k] = a[k];
  }
}

Curve2Ptr image_of(const EdgeSide& side, const LineOnSurface& line, const Vec3& from, const Vec3& to, double size) {
  if (side.plane) {
    for (int k = 0; k <= kSamples; ++k) {
      const Vec3 p = line.curve->point(at_sample(line.curve->domain(), k));
      if (std::abs(glm::dot(side.plane->z, p - side.plane->origin)) > kSame * size) return nullptr;
    }
    return image_in(*side.plane, line.curve);
  }
  Vec2 a = near_foot(*side.surface, from, side.near[0]).place, b = near_foot(*side.surface, to, side.near[1]).place;
  snap(a, b, side.surface->domain());
  Curve2Ptr image = image_line(line.curve->domain(), a, b);
  for (int k = 0; k <= kSamples; ++k) {
    const double t = at_sample(line.curve->domain(), k);
    const Vec3 uv = image->point(t);
    if (!(glm::length(side.surface->point(uv.x, uv.y) - line.curve->point(t)) <= kSame * size)) return nullptr;
  }
  return image;
}

// A surface that is ruled along one parameter cut by a plane: v = lo + (hi - lo) n.(o - a)/n.(b - a), a(u) and b(u) the
// borders where v is lo and hi. The image (t, v(t)), or (u(t), t).
struct RuledSection {
  SurfacePtr of;
  Vec3 normal, origin;
  bool along_v;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Rectangle d = of->domain();
    const Interval& rule = along_v ? d.v : d.u;
    const auto border = [&](double at) { return along_v ? surface_at(*of, t, T(at)) : surface_at(*of, T(at), t); };
    const Triple<T> a = border(rule.lo);
    const auto n = triple(normal);
    const T found = T(rule.lo) + T(rule.width()) * (dot(n, triple(origin) - a) / dot(n, border(rule.hi) - a));
    return along_v ? Triple<T>{t, found, T(0)} : Triple<T>{found, t, T(0)};
  }
};

// Whether lines along the parameter are straight and run evenly.
bool is_ruled(const Surface& surface, bool along_v, const Rectangle& where, double size) {
  for (int k = 0; k <= kSamples; ++k) {
    const double held = at_sample(along_v ? where.u : where.v, k);
    const Interval& rule = along_v ? where.v : where.u;
    const auto at = [&](double x) { return along_v ? surface.point(held, x) : surface.point(x, held); };
    const Vec3 a = at(rule.lo), b = at(rule.hi);
    for (const double f : {0.25, 0.5, 0.75})
      if (!(glm::length(at(rule.lo + f * rule.width()) - (a + f * (b - a))) <= 1e-13 * size)) return false;
  }
  return true;
}

std::optional<EdgeCurve> ruled_section(const EdgeSide& ruled, const EdgeSide& plane, const Vec3& from, const Vec3& to,
                                       double size) {
  const Vec2 a = near_foot(*ruled.surface, from, ruled.near[0]).place,
             b = near_foot(*ruled.surface, to, ruled.near[1]).place;
  const Rectangle d = ruled.surface->domain();
  for (const bool along_v : {true, false}) {
    Interval range =
        along_v ? Interval(std::min(a.x, b.x), std::max(a.x, b.x)) : Interval(std::min(a.y, b.y), std::max(a.y, b.y));
    const bool backward = along_v ? a.x > b.x : a.y > b.y;
    const Interval whole = along_v ? d.u : d.v;
    if (!(range.width() > 1e-9 * whole.width()) || !is_ruled(*ruled.surface, along_v, d, size)) continue;
    for (double* end : {&range.lo, &range.hi})
      for (const double own : {whole.lo, whole.hi})
        if (std::abs(*end - own) <= 1e-12 * whole.width()) *end = own;
    SurfacePtr surface = ruled.surface;
    Rectangle domain = d;
    (along_v ? domain.u : domain.v) = {std::min(whole.lo, range.lo), std::max(whole.hi, range.hi)};
    if (!(domain.u == d.u && domain.v == d.v)) surface = extended_to(surface, domain);
    if (!is_ruled(*surface, along_v, domain, size)) continue;
    CurveProperties properties;
    properties.domain = range;
    properties.max_order = std::min(kMaxCurveOrder, surface->max_order());
    properties.enclosure_order = surface->enclosure_order();
    properties.breaks = {range.lo};
    for (const SurfacePiece& piece : surface->pieces()) {
      const double x = along_v ? piece.domain.u.lo : piece.domain.v.lo;
      if (x > range.lo && x < range.hi) properties.breaks.push_back(x);
    }
    properties.breaks.push_back(range.hi);
    std::sort(properties.breaks.begin(), properties.breaks.end());
    properties.breaks.erase(std::unique(properties.breaks.begin(), properties.breaks.end()), properties.breaks.end());
    CurvePtr image = std::make_shared<ComposedCurve<RuledSection>>(
        RuledSection{surface, plane.plane->z, plane.plane->origin, along_v}, std::move(properties));
    if (backward) image = reversed_curve(image);
    const auto curve = std::make_shared<SurfaceCurve>(surface, image);
    if (glm::length(curve->point(range.lo) - from) > kSame * size ||
        glm::length(curve->point(range.hi) - to) > kSame * size)
      continue;
    return EdgeCurve{curve, {image, image_in(*plane.plane, curve)}};
  }
  return std::nullopt;
}

double distance_to(const std::vector<Vec3>& guide, const Curve& curve) {
  double sum = 0;
  const auto last = static_cast<double>(guide.size() - 1);
  for (size_t k = 0; k < guide.size(); ++k) {
    const Interval t = curve.domain();
    sum += glm::length(curve.point(t.lo + t.width() * static_cast<double>(k) / last) - guide[k]);
  }
  return sum;
}

// A surface over the whole of what an edge near its ends may need.
SurfacePtr wide_enough(const EdgeSide& side, const Vec3& from, const Vec3& to) {
  if (side.plane) return std::make_shared<Plane>(*side.plane);
  const Rectangle d = side.surface->domain();
  const Periods periods = side.surface->periods();
  const Vec2 a = near_foot(*side.surface, from, side.near[0]).place,
             b = near_foot(*side.surface, to, side.near[1]).place;
  const auto widened = [](const Interval& own, double x, double y, double period) {
    if (is_whole(own, period)) return own;
    const double lo = std::min({own.lo, x, y}), hi = std::max({own.hi, x, y}), more = 0.02 * (hi - lo);
    const Interval wide(lo < own.lo ? lo - more : lo, hi > own.hi ? hi + more : hi);
    if (period > 0 && wide.width() > period)
      return Interval(wide.middle() - 0.5 * period, wide.middle() + 0.5 * period);
    return wide;
  };
  const Rectangle wide{widened(d.u, a.x, b.x, periods.u), widened(d.v, a.y, b.y, periods.v)};
  if (wide.u == d.u && wide.v == d.v) return side.surface;
  // Between the ends it may come nearer to a pole than they are.
  if (dynamic_cast<const SphereSurface*>(side.surface.get()))
    return extended_to(side.surface, {{wide.u.middle() - kPi, wide.u.middle() + kPi}, {-0.5 * kPi, 0.5 * kPi}});
  return extended_to(side.surface, wide);
}

std::optional<double> parameter_on(const CurvePtr& curve, const Vec3& point, double size) {
  const CurveFootPoints found = project(point, *curve);
  if (found.foot_points.empty() || found.foot_points.front().distance > 1e-9 * size) return std::nullopt;
  return found.foot_points.front().t;
}

// The image of such a part of a contour. One that goes round a surface ends a period from where it begins, and goes on
// from there.
Curve2Ptr trimmed_image(const Contour& branch, const Curve2Ptr& image, double from, double to, bool backward) {
  if (!branch.closed || image->is_closed()) return trimmed_curve(image, from, to, backward);
  const Interval all = image->domain();
  if (from >= all.hi) from = all.lo;
  const double sign = backward ? -1 : 1, end = backward ? all.lo : all.hi, begin = backward ? all.hi : all.lo;
  double length = std::fmod(sign * (to - from), all.width());
  if (length <= 0) length += all.width();
  const double first = std::abs(end - from), rest = length - first;
  const auto part = [&](double a, double b) { return trimmed_curve(image, a, all.clamp(b), backward); };
  if (first == 0) return part(begin, begin + sign * length);
  if (rest <= 0) return part(from, from + sign * length);
  const Affine on = Affine::translation(image->point(end) - image->point(begin));
  return std::make_shared<CompositeCurve>(
      std::vector<CurvePtr>{part(from, end), transformed(part(begin, begin + sign * rest), on)}, false, 1e-9);
}

// Moved by whole periods so that it begins at `begin`.
Curve2Ptr at_periods(Curve2Ptr image, const Surface& surface, const Vec2& begin) {
  const Periods periods = surface.periods();
  const Vec3 from = image->point(image->domain().lo);
  Vec3 by(0);
  if (periods.u > 0) by.x = periods.u * std::round((begin.x - from.x) / periods.u);
  if (periods.v > 0) by.y = periods.v * std::round((begin.y - from.y) / periods.v);
  return by == Vec3(0) ? image : transformed(image, Affine::translation(by));
}

std::optional<EdgeCurve> searched_edge(const std::array<EdgeSide, 2>& sides, const Vec3& from, const Vec3& to,
                                       const std::vector<Vec3>& guide, double size) {
  const SurfacePtr a = wide_enough(sides[0], from, to), b = wide_enough(sides[1], from, to);
  std::optional<EdgeCurve> best;
  double nearest = kInfinity;
  for (const Contour& branch : intersect(a, b).branches) {
    const auto s = parameter_on(branch.curve, from, size), t = parameter_on(branch.curve, to, size);
    if (!s || !t) continue;
    for (const bool backward : {false, true}) {
      if (!branch.closed && (*s > *t) != backward) continue;
      EdgeCurve edge;
      try {
        edge.curve = trimmed_curve(branch.curve, *s, *t, backward);
        // A section by a plane has an image in the other surface only.
        for (int k = 0; k < 2; ++k)
          edge.images[k] = sides[k].plane
                               ? image_in(*sides[k].plane, edge.curve)
                               : trimmed_image(branch, branch.images[sides[1 - k].plane ? 0 : k], *s, *t, backward);
      } catch (const FieldError&) {
        continue;  // a part without length
      }
      const double far = distance_to(guide, *edge.curve);
      if (!(far < nearest)) continue;
      nearest = far;
      for (int k = 0; k < 2; ++k)
        if (!sides[k].plane)
          edge.images[k] =
              at_periods(edge.images[k], *sides[k].surface, near_foot(*sides[k].surface, from, sides[k].near[0]).place);
      best = edge;
    }
  }
  return best;
}

}  // namespace

std::shared_ptr<const Circle> even_circle(const Curve& curve, double size) {
  const Interval t = curve.domain();
  const CurveJet c = curve.evaluate(t.lo, 2);
  const double speed = glm::length(c.d[1]), bend = glm::length(c.d[2]);
  if (!(speed > 0 && bend > 0) || std::abs(glm::dot(c.d[1], c.d[2])) > 1e-10 * speed * bend) return nullptr;
  const double radius = speed * speed / bend, angle = speed / radius * t.width();
  if (!(radius < 1e6 * size) || !(angle <= kTwoPi * (1 + 1e-12))) return nullptr;
  const Vec3 x = -c.d[2] / bend, z = glm::cross(x, c.d[1] / speed);
  const Frame frame = frame_from(c.d[0] - radius * x, z, x);
  const auto circle = std::make_shared<Circle>(frame, radius, Interval(0, std::min(angle, kTwoPi)));
  for (int k = 0; k <= kSamples; ++k)
    if (glm::length(circle->point(at_sample(circle->domain(), k)) - curve.point(at_sample(t, k))) > kSame * size)
      return nullptr;
  return circle;
}

LineOnSurface line_on_surface(const SurfacePtr& surface, const Vec2& from, const Vec2& to, double size) {
  const Interval unit(0, 1);
  const Curve2Ptr image = image_line(unit, from, to);
  const auto curve = std::make_shared<SurfaceCurve>(surface, image);
  if (is_straight(*curve, size)) return {std::make_shared<Segment>(curve->point(0), curve->point(1)), image};
  if (auto circle = even_circle(*curve, size)) return {circle, image_line(circle->domain(), from, to)};
  return {curve, image};
}

std::optional<EdgeCurve> parameter_edge(const std::array<EdgeSide, 2>& sides, const Vec3& from, const Vec3& to,
                                        double size) {
  const EdgeSide& side = sides[0];
  Vec2 a = near_foot(*side.surface, from, side.near[0]).place, b = near_foot(*side.surface, to, side.near[1]).place;
  const Rectangle d = side.surface->domain();
  snap(a, b, d);
  if (a == b) return std::nullopt;
  const auto widened = [](const Interval& own, double x, double y, double period) {
    return is_whole(own, period) ? own : Interval(std::min({own.lo, x, y}), std::max({own.hi, x, y}));
  };
  const Periods periods = side.surface->periods();
  const Rectangle wide{widened(d.u, a.x, b.x, periods.u), widened(d.v, a.y, b.y, periods.v)};
  LineOnSurface line;
  try {
    const bool inside = wide.u == d.u && wide.v == d.v;
    line = line_on_surface(inside ? side.surface : extended_to(side.surface, wide), a, b, size);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  const Curve2Ptr other = image_of(sides[1], line, from, to, size);
  if (!other) return std::nullopt;
  return EdgeCurve{line.curve, {line.image, other}};
}

std::optional<EdgeCurve> intersection_edge(const std::array<EdgeSide, 2>& sides, const Vec3& from, const Vec3& to,
                                           const std::vector<Vec3>& guide, double size) {
  if (sides[0].plane && sides[1].plane) {
    if (!(glm::length(to - from) > 0)) return std::nullopt;
    const auto line = std::make_shared<Segment>(from, to);
    return EdgeCurve{line, {image_in(*sides[0].plane, line), image_in(*sides[1].plane, line)}};
  }
  const auto swapped = [](std::optional<EdgeCurve> edge) {
    if (edge) std::swap(edge->images[0], edge->images[1]);
    return edge;
  };
  const std::array turned{sides[1], sides[0]};
  if (!sides[0].plane)
    if (auto edge = parameter_edge(sides, from, to, size)) return edge;
  if (!sides[1].plane)
    if (auto edge = swapped(parameter_edge(turned, from, to, size))) return edge;
  if (sides[1].plane)
    if (auto edge = ruled_section(sides[0], sides[1], from, to, size)) return edge;
  if (sides[0].plane)
    if (auto edge = swapped(ruled_section(sides[1], sides[0], from, to, size))) return edge;
  return searched_edge(sides, from, to, guide, size);
}

}  // namespace lekalo::geometry
