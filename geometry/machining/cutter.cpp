#include "geometry/machining/cutter.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"

namespace lekalo::geometry {

namespace {

constexpr double kRightAngle = kPi / 2;
// Lengths below this part of the radius are none.
constexpr double kNothing = 1e-12;

bool is_disc(const Cutter& cutter) { return cutter.angle <= -kRightAngle + kNothing; }

void check_end(const Cutter& cutter, const std::string& prefix) {
  const double rho = cutter.corner_radius;
  if (rho < 0 && !(-rho > cutter.radius))
    throw FieldError(prefix + "corner_radius",
                     fmt::format("a hollow end of radius {:.6g} does not reach the rim at {:.6g}", -rho, cutter.radius),
                     "corner_radius: below minus the radius, or not negative");
  if (rho > cutter.radius && !(cutter.flank_start().x > kNothing * cutter.radius))
    throw FieldError(prefix + "angle", "the pointed end turns into the flank only beyond the axis",
                     fmt::format("an angle below {:.6g}", std::acos(1 - cutter.radius / rho) * 180 / kPi));
}

void check_flank(const Cutter& cutter, const std::string& prefix) {
  const Vec2 start = cutter.flank_start();
  const double least = kNothing * cutter.radius;
  if (is_disc(cutter)) {
    if (!(cutter.corner_radius > 0 && std::abs(cutter.length - 2 * cutter.corner_radius) <= 1e-9 * cutter.length))
      throw FieldError(prefix + "angle", "a disc with the angle -90 ends at the height of two corner radii",
                       "length: twice the corner_radius");
    if (!(cutter.ring_radius() > least))
      throw FieldError(prefix + "corner_radius", "the corners of a disc leave no place for its top",
                       "a corner_radius below the radius");
    return;
  }
  if (!(cutter.length >= start.y - least))
    throw FieldError(prefix + "length", fmt::format("the corner alone is {:.6g} high", start.y), "a longer cutter");
  if (!(cutter.top_radius() > least))
    throw FieldError(prefix + "angle", "the flank meets the axis below the top",
                     "a shorter cutter, or an angle nearer to 0");
}

}  // namespace

Vec2 Cutter::flank_start() const {
  const double rho = rounding();
  return {ring_radius() + rho * std::cos(angle), rho * (1 - std::sin(angle))};
}

double Cutter::top_radius() const {
  return is_disc(*this) ? ring_radius() : flank_start().x + (length - flank_start().y) * std::tan(angle);
}

double Cutter::flank_radius() const { return flank_start().x - flank_start().y * std::tan(angle); }

std::vector<MeridianPart> meridian(const Cutter& cutter, const Frame& frame) {
  const double rho = cutter.corner_radius, least = kNothing * cutter.radius;
  const auto at = [&](double x, double z) { return frame.origin + x * frame.x + z * frame.z; };
  // Angles count from x to z.
  const auto arc = [&](double x, double z, double radius, double from, double to) {
    return std::make_shared<Circle>(Frame{at(x, z), frame.x, frame.z, -frame.y}, radius, Interval(from, to));
  };
  std::vector<MeridianPart> parts;
  const auto line = [&](const char* name, const Vec2& from, const Vec2& to) {
    if (glm::length(to - from) > least)
      parts.push_back({name, std::make_shared<Segment>(at(from.x, from.y), at(to.x, to.y))});
  };
  if (rho < 0) {
    // From the axis down to the rim: an arc that runs clockwise about a centre below, turned round by its frame.
    const double rise = std::asin(cutter.radius / -rho);
    const Frame turned{at(0, -std::sqrt(rho * rho - cutter.radius * cutter.radius)), frame.z, frame.x, frame.y};
    parts.push_back({"end", std::make_shared<Circle>(turned, -rho, Interval(0, rise))});
  } else {
    line("end", {0, 0}, {cutter.ring_radius(), 0});
  }
  if (rho > 0) {
    const double from = rho > cutter.radius ? -std::acos(1 - cutter.radius / rho) : -kRightAngle;
    if (rho > cutter.radius) parts.clear();
    parts.push_back({"corner", arc(cutter.ring_radius(), rho, rho, from, -cutter.angle)});
  }
  const Vec2 top(cutter.top_radius(), cutter.length);
  if (!is_disc(cutter)) line("flank", cutter.flank_start(), top);
  line("top", top, {0, cutter.length});
  return parts;
}

std::vector<Field> cutter_fields() {
  return {{"radius", length().positive(), "R, where the round corner would meet an upright flank", true, {}},
          {"corner_radius", length(),
           "rho: 0 a sharp corner, the radius a ball end, more a pointed one; below minus the radius a hollow end",
           false, "0"},
          {"length", length().positive(), "L, from the end to the top", true, {}},
          {"angle", angle().at_least(-kPi / 2).below(kPi / 2),
           "between flank and axis: positive for a cutter that is wider away from its end; -90 for a round disc", false,
           "0"}};
}

Cutter read_cutter(const Fields& fields, const std::string& prefix) {
  const Cutter cutter{fields.number("radius"), fields.number("corner_radius"), fields.number("length"),
                      fields.number("angle")};
  check_end(cutter, prefix);
  check_flank(cutter, prefix);
  return cutter;
}

}  // namespace lekalo::geometry
