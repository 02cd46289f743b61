#include <fmt/format.h>

#include "geometry/describe.h"
#include "geometry/queries/surface_lines/geodesic_law.h"

namespace lekalo::geometry {

// So many sizes of the surface a geodesic is followed: some seconds.
static constexpr double kMaxSizes = 1000;

GeodesicLaw::State GeodesicLaw::start(const Surface& surface, const Vec2& uv, double angle) {
  const SurfaceJet at = surface.evaluate(uv.x, uv.y, 1);
  const Vec3 x = glm::normalize(at.du()), normal = glm::normalize(glm::cross(at.du(), at.dv()));
  const Vec2 rate = tangent_components(at, std::cos(angle) * x + std::sin(angle) * glm::cross(normal, x));
  return {uv.x, uv.y, rate.x, rate.y, 0, 1};
}

std::optional<GeodesicLaw::State> GeodesicLaw::rates(const SurfaceJet& at, const State& y, const Vec3&) const {
  const Vec3 n = glm::cross(at.du(), at.dv());
  const double area2 = glm::dot(n, n);
  if (!(area2 > 0)) return std::nullopt;
  const double p = y[2], q = y[3];
  const Vec3 bend = p * p * at.duu() + 2 * p * q * at.duv() + q * q * at.dvv();
  const Vec2 slide = tangent_components(at, bend);
  // K = (r_uu . n)(r_vv . n) - (r_uv . n)^2 over |n|^4.
  const double mixed = glm::dot(at.duv(), n);
  const double curvature = (glm::dot(at.duu(), n) * glm::dot(at.dvv(), n) - mixed * mixed) / (area2 * area2);
  const State result{p, q, -slide.x, -slide.y, y[5], -curvature * y[4]};
  for (const double x : result)
    if (!std::isfinite(x)) return std::nullopt;
  return result;
}

bool GeodesicLaw::cross(const SurfaceJet& from, const SurfaceJet& to, bool along_u, State& y, const Vec3&) const {
  const auto differ = [](const Vec3& a, const Vec3& b) {
    return glm::length(a - b) > kSameDerivative * (glm::length(a) + glm::length(b));
  };
  if (!differ(from.du(), to.du()) && !differ(from.dv(), to.dv())) return true;
  const Vec3 motion = y[2] * from.du() + y[3] * from.dv();
  const Vec3 edge = glm::normalize(along_u ? to.du() : to.dv());
  const Vec3 beyond = along_u ? to.dv() : to.du();
  const double turn = glm::dot(motion, edge), speed2 = glm::dot(motion, motion);
  Vec3 across = glm::normalize(beyond - glm::dot(beyond, edge) * edge);
  if ((along_u ? y[3] : y[2]) < 0) across = -across;
  const Vec2 rate = tangent_components(to, turn * edge + std::sqrt(std::max(0.0, speed2 - turn * turn)) * across);
  if (!std::isfinite(rate.x) || !std::isfinite(rate.y)) return false;
  y[2] = rate.x;
  y[3] = rate.y;
  return true;
}

double line_size(const Surface& surface, double length) {
  return surface.bounded() ? bounds(surface).diameter() : length;
}

SurfaceLine finished(const Surface& surface, std::vector<PolynomialCurve::Part> parts,
                     const std::vector<PolynomialCurve::Part>& again) {
  SurfaceLine line;
  line.image = std::make_shared<PolynomialCurve>(std::move(parts));
  const PolynomialCurve other(again);
  const Interval common = intersect(line.image->domain(), other.domain());
  for (const PolynomialCurve::Part& part : line.image->parts())
    for (const double x : {-0.6, 0.1, 0.7, 1.0}) {
      const double t = part.t.middle() + 0.5 * x * part.t.width();
      if (!common.contains(t)) continue;
      const Vec3 a = line.image->point(t), b = other.point(t);
      line.error = std::max(line.error, glm::length(surface.point(a.x, a.y) - surface.point(b.x, b.y)));
    }
  return line;
}

void check_place(const Surface& surface, const Vec2& uv, const char* name) {
  const Rectangle domain = surface.domain();
  if (!domain.contains(uv.x, uv.y))
    throw FieldError(name, fmt::format("({:.6g}, {:.6g}) lies outside of the surface's domain, u in [{:.6g}, {:.6g}], "
                                       "v in [{:.6g}, {:.6g}]",
                                       uv.x, uv.y, domain.u.lo, domain.u.hi, domain.v.lo, domain.v.hi));
  // At poles r_u or r_v vanishes but for rounding.
  const SurfaceJet at = surface.evaluate(uv.x, uv.y, 1);
  const double size = line_size(surface, 0);
  const auto vanishes = [&](const Vec3& d, const Interval& range) {
    return range.width() < kInfinity && glm::length(d) * range.width() <= 1e-12 * size;
  };
  if (!is_regular(at) || vanishes(at.du(), domain.u) || vanishes(at.dv(), domain.v))
    throw FieldError(name, "this is a pole, an apex or a place where the parameters do not tell directions",
                     "take a point beside it");
}

SurfaceLine geodesic(const Surface& surface, const Vec2& start, double angle, double length) {
  check_place(surface, start, "from");
  const GeodesicLaw law;
  FlowOptions options;
  options.size = std::min(line_size(surface, length), length);
  options.length = std::min(length, kMaxSizes * options.size);
  const auto run = [&] { return GeodesicFlow(surface, law, options).run(GeodesicLaw::start(surface, start, angle)); };
  GeodesicFlow::Result flow = run();
  const auto place = [&] { return fmt::format("({:.6g}, {:.6g})", flow.end[0], flow.end[1]); };
  if (flow.why == LineEnd::jagged)
    throw FieldError("of", "the surface is not smooth enough for a geodesic at (u, v) = " + place());
  if (flow.why == LineEnd::length && options.length < length)
    throw FieldError("length", fmt::format("the geodesic gets longer than {:g} times the surface's size", kMaxSizes),
                     fmt::format("at most {:.6g} here", options.length));
  if (flow.parts.empty())
    throw FieldError("from", "the geodesic leaves the surface's domain at once", "turn its direction");
  options.longest_step *= 0.1;
  options.tolerance *= 0.1;
  SurfaceLine line = finished(surface, std::move(flow.parts), run().parts);
  line.error = std::max(line.error, flow.beside);
  line.ends = flow.why;
  return line;
}

}  // namespace lekalo::geometry
