#include "geometry/machining/strip.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/mat2x2.hpp>

#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 128;
// Cosines below this are 0: the section runs along the sharp rim, which bends as its circle does.
constexpr double kAlong = 1e-7;

// The curvatures of the cutter: k_1 in the direction `meridian` of the tangent plane, k_2 across.
struct CutterBend {
  Vec3 meridian;
  double k1, k2;
  double along(const Vec3& direction) const {
    const double c = glm::dot(direction, meridian);
    if (std::isinf(k1)) return std::abs(c) > kAlong ? k1 : k2;
    return k1 * c * c + k2 * (1 - c * c);
  }
};

CutterBend cutter_bend(const Cutter& cutter, const CutterPlace<double>& place) {
  const Vec3 n = vec(place.normal), q = vec(place.axis);
  const double rho = cutter.rounding(), sine = glm::length(glm::cross(q, n));
  if (cutter.has_ball_end()) return {vec(place.feed), 1 / rho, 1 / rho};
  const Vec3 meridian = glm::normalize(q - glm::dot(q, n) * n);
  return {meridian, rho > 0 ? 1 / rho : kInfinity, sine / (cutter.ring_radius() + rho * sine)};
}

// Of the part in the basis x, y of its tangent plane, at a distance along the normal; and the map that leads from
// there back to the part.
struct PartBend {
  glm::dmat2 form, back;
};
PartBend part_bend(const Mat3& shape, const Vec3& x, const Vec3& y, double distance) {
  const double a = glm::dot(x, shape * x), b = 0.5 * (glm::dot(x, shape * y) + glm::dot(y, shape * x)),
               c = glm::dot(y, shape * y);
  const glm::dmat2 form(a, b, b, c);
  const glm::dmat2 back = glm::inverse(glm::dmat2(1.0) - distance * form);
  return {form * back, back};
}

double min_eigenvalue(double a, double b, double c) { return 0.5 * (a + c) - std::hypot(0.5 * (a - c), b); }

double min_difference(const CutterBend& cutter, const PartBend& part, const Vec3& x, const Vec3& y) {
  const glm::dvec2 m(glm::dot(cutter.meridian, x), glm::dot(cutter.meridian, y)), p(-m.y, m.x);
  if (std::isinf(cutter.k1)) return cutter.k2 - glm::dot(p, part.form * p);
  const auto entry = [&](int i, int j) { return cutter.k1 * m[i] * m[j] + cutter.k2 * p[i] * p[j] - part.form[i][j]; };
  return min_eigenvalue(entry(0, 0), entry(0, 1), entry(1, 1));
}

// (u, v) of a tangent vector.
Vec2 parameters_of(const SurfaceJet& jet, const Vec3& vector) {
  const Vec3 &a = jet.du(), &b = jet.dv();
  const double e = glm::dot(a, a), f = glm::dot(a, b), g = glm::dot(b, b), x = glm::dot(vector, a),
               y = glm::dot(vector, b);
  return Vec2(g * x - f * y, e * y - f * x) / (e * g - f * f);
}

}  // namespace

double ContactBend::width(double height) const {
  const double difference = cutter_across - part_across;
  if (!(difference > 0)) return min_difference < 0 ? 0 : kInfinity;
  return std::sqrt(8 * height / difference);
}

ContactBend contact_bend(const SurfaceContact& contact, double t) {
  const auto line = contact.line(t);
  const CutterPlace<double> place = contact.at(t);
  const Surface& surface = *contact.line.of;
  const auto shape = shape_operator(surface, contact.side, line.u, line.v);
  if (!shape)
    throw FieldError("of", fmt::format("the surface has no curvature at u = {:.6g}, v = {:.6g}", line.u, line.v));
  const Vec3 n = vec(place.normal), x = vec(place.feed), y = glm::cross(n, x);
  const CutterBend cutter = cutter_bend(contact.cutter, place);
  const PartBend part = part_bend(*shape, x, y, contact.allowance);
  const glm::dvec2 over = part.back * glm::dvec2(0, 1);
  return {cutter.along(y), part.form[1][1], min_difference(cutter, part, x, y),
          parameters_of(surface.evaluate(line.u, line.v, 1), over.x * x + over.y * y)};
}

StripReport strip_report(const SurfaceContact& contact, const Interval& range, double height) {
  StripReport report;
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = range.clamp(range.lo + range.width() * i / kPlaces);
    const ContactBend bend = contact_bend(contact, t);
    const auto line = contact.line(t);
    if (bend.min_difference < report.min_difference)
      report.min_difference = bend.min_difference, report.u = line.u, report.v = line.v;
    if (!(height > 0)) continue;
    const double width = bend.width(height);
    report.min_width = std::min(report.min_width, width);
    report.max_width = std::max(report.max_width, width);
    const double band = width * glm::length(bend.across);
    report.min_band = std::min(report.min_band, band);
    report.max_band = std::max(report.max_band, band);
  }
  return report;
}

}  // namespace lekalo::geometry
