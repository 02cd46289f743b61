// A curve by its formulas (Golovanov 2016, 2.1): r(t) = point(f(t), g(t), h(t)).
#include "geometry/curves/formula_curve.h"

#include <cmath>
#include <stdexcept>

#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places where the formulas are tried before anything else asks.
constexpr int kTried = 64;

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

const std::vector<std::string> kVariables{"t"};

}  // namespace

FormulaCurve::FormulaCurve(std::array<Expression, 3> formulas, Coordinates coordinates, const Interval& domain,
                           bool closed)
    : formulas_(std::move(formulas)), coordinates_(coordinates), domain_(domain) {
  if (!(domain.width() > 0 && domain.width() < kInfinity))
    throw std::invalid_argument("the domain of a curve must be finite and not empty");
  double size = 0;
  const Vec3 first = point(domain.lo);
  for (int i = 0; i <= kTried; ++i) {
    const double t = i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried;
    const Vec3 p = point(t);
    if (!is_finite(p)) throw std::invalid_argument("the formulas have no value at t = " + std::to_string(t));
    size = std::max(size, glm::length(p - first));
  }
  if (closed && glm::length(point(domain.hi) - first) > kClosedCurve * size)
    throw std::invalid_argument("the curve is not closed: its ends do not meet");
  closed_ = closed;
}

CurveJet FormulaCurve::evaluate(double t, int order) const {
  if (closed_ && !domain_.contains(t)) t -= domain_.width() * std::floor((t - domain_.lo) / domain_.width());
  return evaluate_curve_formula(
      [this](const auto& x) { return point_of(coordinates_, formulas_[0](x), formulas_[1](x), formulas_[2](x)); }, t,
      order);
}

CurveEnclosure FormulaCurve::enclose(const Interval& t, int order) const {
  return enclose_curve_centered(
      [this](const auto& x) { return point_of(coordinates_, formulas_[0](x), formulas_[1](x), formulas_[2](x)); }, t,
      order);
}

TypeDeclaration formula_curve_type() {
  TypeDeclaration type = declare(Category::curve, "formula_curve", "Curve given by formulas of its parameter t.");
  type.example("point: [cos(t), sin(2*t)], domain: [0, 2*pi], closed: true");
  declare_formulas(type, kVariables);
  type.field("domain", range(), "of t, or of x");
  type.field("closed", boolean(), "the ends meet, and the parameter wraps", "false");
  return type.built_by([](const Fields& f) {
    const PointFormulas read = read_formulas(f, kVariables);
    const auto made = [&](bool closed) {
      try {
        return FormulaCurve(read.formulas, read.coordinates, f.range("domain"), closed);
      } catch (const std::invalid_argument& error) {
        throw FieldError(closed ? "closed" : "domain", error.what());
      }
    };
    const FormulaCurve open = made(false);
    return f.boolean("closed") ? made(true) : open;
  });
}

}  // namespace lekalo::geometry
