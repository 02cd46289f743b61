#include "geometry/shapes/tube/radius_law.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

// Places along the curve where a formula is tried before anything else asks.
constexpr int kTried = 64;

}  // namespace

RadiusLaw::RadiusLaw(double constant) : constant_(constant) {
  if (!(constant > 0 && constant < kInfinity))
    throw FieldError("radius", fmt::format("the radius must be greater than 0, found {}", constant));
}

RadiusLaw::RadiusLaw(const Expression& law, const Curve& curve) : law_(law) {
  const auto& names = law.names();
  if (std::find(names.begin(), names.end(), "s") == names.end()) {
    *this = RadiusLaw(law.evaluate<double>(std::array{0.0}));
    return;
  }
  try {
    fraction_ = ArcFraction(curve);
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
  // A name that holds one of these words only makes more pieces.
  for (const char* word : {"if", "abs", "min", "max", "clamp", "floor", "ceil", "round", "sign", "mod"})
    has_branches_ = has_branches_ || law.text().find(word) != std::string::npos;
  const Interval domain = curve.domain();
  for (int i = 0; i <= kTried; ++i) {
    const double t = i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried;
    const double radius = law_(fraction_.at(t));
    if (!(radius > 0 && radius < kInfinity)) refuse(t, radius);
  }
}

void RadiusLaw::refuse(double t, double radius) const {
  const double s = fraction_.at(t);
  const std::string message =
      std::isfinite(radius)
          ? fmt::format("the radius must be greater than 0, and at s = {:.4g} it is {:.4g}", s, radius)
          : fmt::format("the formula has no value at s = {:.4g}", s);
  throw FieldError("radius", message, "s runs from 0 to 1 along the curve");
}

std::array<double, 3> RadiusLaw::at(double t, const CurveJet& jet) const {
  if (constant_ > 0) return {constant_, 0, 0};
  const double speed = glm::length(jet.d[1]);
  Jet<double, 2> s(fraction_.at(t));
  s.c[1] = speed / fraction_.length();
  s.c[2] = speed > 0 ? 0.5 * glm::dot(jet.d[1], jet.d[2]) / (speed * fraction_.length()) : 0;
  const Jet<double, 2> radius = law_(s);
  return {radius.derivative(0), radius.derivative(1), radius.derivative(2)};
}

std::array<Interval, 3> RadiusLaw::over(const Interval& t, const CurveEnclosure& boxes) const {
  if (constant_ > 0) return {constant_, 0.0, 0.0};
  const Triple<Interval> first = triple(boxes.d[1]), second = triple(boxes.d[2]);
  const auto norm = [](const Triple<Interval>& v) { return sqrt(sqr(v.x) + sqr(v.y) + sqr(v.z)); };
  // The table of s holds it to rounding.
  const Interval slack(-1e-14, 1e-14), speed = norm(first);
  Jet<Interval, 2> s(Interval(fraction_.at(t.lo), fraction_.at(t.hi)) + slack);
  s.c[1] = speed / fraction_.length();
  // The speed changes at most as fast as the derivative does.
  const double most = norm(second).hi;
  const Interval change = (first.x * second.x + first.y * second.y + first.z * second.z) / speed;
  s.c[2] = 0.5 * intersect(change, Interval(-most, most)) / fraction_.length();
  const Jet<Interval, 2> radius = law_(s);
  return {radius.derivative(0), radius.derivative(1), radius.derivative(2)};
}

}  // namespace lekalo::geometry
