// Lines whose direction at each point is told by the surface's curvature there: r' is a unit vector along a principal
// direction, or turned from that of the largest curvature by the angle
//
//   phi = +-atan sqrt(-lambda_1/lambda_2),   lambda_1 cos^2 phi + lambda_2 sin^2 phi = 0
//
// (Euler, Golovanov 2016, 3.1.14). Its sign is that which goes on from the step before.
#include <fmt/format.h>

#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/surface_lines/geodesic_law.h"

namespace lekalo::geometry {

namespace {

enum class Family { maximum, minimum, first, second };

bool is_asymptotic(Family family) { return family == Family::first || family == Family::second; }

// Principal curvatures that differ by less than this part of the larger are one; asymptotic lines need Gaussian
// curvature beyond this part of the square of the larger.
constexpr double kUmbilic = 1e-9;
constexpr double kParabolic = 1e-12;
// A line that does not go on by steps has come to a point where curvatures differ by less than this part.
constexpr double kNearSingular = 1e-3;
// A line of more diameters does not close, or not soon.
constexpr double kLongest = 100;

struct DirectionLaw {
  static constexpr int kSize = 2;
  static constexpr bool kPassesPoles = false;
  using State = std::array<double, kSize>;

  Family family;
  double sign = 1;         // of the direction at the beginning
  double normal_sign = 1;  // of the surface

  SurfaceCurvature curvature_at(const SurfaceJet& at) const {
    return curvature(at, normal_sign * glm::normalize(glm::cross(at.du(), at.dv())));
  }
  // How far the curvatures are from those that have no such direction; 1 where they are farthest.
  double distinct(const SurfaceCurvature& c) const {
    const double largest = std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
    if (!c.regular || !(largest > 0)) return 0;
    return is_asymptotic(family) ? -c.principal[0] / largest * c.principal[1] / largest
                                 : 0.5 * (c.principal[0] - c.principal[1]) / largest;
  }
  // Along the line, either way.
  std::optional<Vec3> direction(const SurfaceJet& at) const {
    if (!is_regular(at)) return std::nullopt;
    const SurfaceCurvature c = curvature_at(at);
    if (!(distinct(c) > (is_asymptotic(family) ? kParabolic : kUmbilic))) return std::nullopt;
    switch (family) {
      case Family::maximum:
        return c.directions[0];
      case Family::minimum:
        return c.directions[1];
      default:
        break;
    }
    const double angle = std::atan2(std::sqrt(c.principal[0]), std::sqrt(-c.principal[1]));
    return std::cos(angle) * c.directions[0] + (family == Family::first ? 1 : -1) * std::sin(angle) * c.directions[1];
  }

  std::optional<State> rates(const SurfaceJet& at, const State&, const Vec3& before) const {
    const auto along = direction(at);
    if (!along) return std::nullopt;
    Vec2 rate = tangent_components(at, *along);
    if (before == Vec3(0)) {
      // The beginning: u grows, or v where u stays but for rounding.
      const double u = rate.x * glm::length(at.du()), v = rate.y * glm::length(at.dv());
      if ((std::abs(u) > 1e-9 * std::abs(v) ? u : v) * sign < 0) rate = -rate;
    } else {
      const double turn = glm::dot(*along, before);
      if (std::abs(turn) < kStraight) return std::nullopt;
      if (turn < 0) rate = -rate;
    }
    return State{rate.x, rate.y};
  }
  bool is_singular(const SurfaceJet& at) const { return distinct(curvature_at(at)) < kNearSingular; }
  bool cross(const SurfaceJet& from, const SurfaceJet& to, bool, State& y, const Vec3& before) const {
    const auto differ = [](const Vec3& a, const Vec3& b) {
      return glm::length(a - b) > kSameDerivative * (glm::length(a) + glm::length(b));
    };
    return !differ(from.du(), to.du()) && !differ(from.dv(), to.dv()) && rates(to, y, before);
  }

  static constexpr double kStraight = 0.5;  // cosine of the most that a step turns
};

using DirectionFlow = SurfaceFlow<DirectionLaw>;

// The line followed backwards, by t -> -t.
std::vector<PolynomialCurve::Part> turned(std::vector<PolynomialCurve::Part> parts) {
  std::reverse(parts.begin(), parts.end());
  for (PolynomialCurve::Part& part : parts) {
    part.t = {-part.t.hi, -part.t.lo};
    for (size_t k = 1; k < part.powers.size(); k += 2) part.powers[k] = -part.powers[k];
  }
  return parts;
}

SurfaceLine follow(const Surface& surface, const Vec2& through, Family family, std::optional<double> length) {
  check_place(surface, through, "through");
  DirectionLaw law{family, 1, surface.normal_sign()};
  if (!law.direction(surface.evaluate(through.x, through.y, 2)))
    throw is_asymptotic(family)
        ? FieldError("through", "there are no asymptotic directions: the Gaussian curvature is not negative here",
                     "take a point where the surface is a saddle")
        : FieldError("through", "this is an umbilic: the curvature is the same in all directions",
                     "take another point");
  if (!surface.bounded() && !length) throw FieldError("length", "a line on an unbounded surface needs a length");
  const double size = line_size(surface, length.value_or(0));
  struct Both {
    std::vector<PolynomialCurve::Part> parts;
    LineEnd begins = LineEnd::length, ends = LineEnd::length;
    double to = 0;
    Vec2 end{0};
  };
  const auto run = [&](FlowOptions options) {
    options.length = length ? 0.5 * *length : kLongest * size;
    options.size = length ? std::min(size, *length) : size;
    options.may_close = true;
    Both both;
    law.sign = 1;
    auto on = DirectionFlow(surface, law, options).run({through.x, through.y});
    both.ends = on.why;
    both.end = {on.end[0], on.end[1]};
    if (on.why != LineEnd::closed) {
      law.sign = -1;
      auto back = DirectionFlow(surface, law, options).run({through.x, through.y});
      both.begins = back.why;
      both.parts = turned(std::move(back.parts));
    } else {
      both.begins = LineEnd::closed;
    }
    both.parts.insert(both.parts.end(), on.parts.begin(), on.parts.end());
    return both;
  };
  FlowOptions options;
  Both line = run(options);
  if (line.begins == LineEnd::jagged || line.ends == LineEnd::jagged)
    throw FieldError("of", "the surface is not smooth enough for such a line");
  if (line.parts.empty()) throw FieldError("through", "the line leaves the surface's domain at once");
  if (!length && (line.begins == LineEnd::length || line.ends == LineEnd::length))
    throw FieldError("through",
                     fmt::format("the line neither ends nor closes within {:.0f} diameters of the surface", kLongest),
                     "give it a length");
  options.longest_step *= 0.1;
  options.tolerance *= 0.1;
  SurfaceLine result = finished(surface, std::move(line.parts), run(options).parts);
  result.begins = line.begins;
  result.ends = line.ends;
  result.closed = line.ends == LineEnd::closed;
  return result;
}

}  // namespace

SurfaceLine curvature_line(const Surface& surface, const Vec2& through, CurvatureFamily family,
                           std::optional<double> length) {
  return follow(surface, through, family == CurvatureFamily::maximum ? Family::maximum : Family::minimum, length);
}

SurfaceLine asymptotic_line(const Surface& surface, const Vec2& through, AsymptoticFamily family,
                            std::optional<double> length) {
  return follow(surface, through, family == AsymptoticFamily::first ? Family::first : Family::second, length);
}

}  // namespace lekalo::geometry
