#include "geometry/queries/measures/enclosed_area.h"

#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

namespace {

constexpr double kFlat = 1e-10;  // of the size
constexpr int kTried = 32;
constexpr int kEvaluations = 200000;

}  // namespace

std::optional<Measured> enclosed_area(const Curve& curve) {
  if (!curve.is_closed() || curve.fit_distance() > 0) return std::nullopt;
  const Box3 box = bounds(curve);
  if (!box.bounded()) return std::nullopt;
  const double unit = 0.5 * box.diameter();
  std::vector<double> breaks;
  for (const CurvePiece& piece : curve.pieces()) breaks.push_back(piece.domain.lo);
  breaks.push_back(curve.domain().hi);
  const auto integrand = [&](double t, std::span<double> values) {
    const CurveJet jet = curve.evaluate(t, 1);
    const Vec3 area = 0.5 * glm::cross((jet.d[0] - box.center()) / unit, jet.d[1] / unit);
    for (int k = 0; k < 3; ++k) values[k] = area[k];
  };
  const Integral integral = integrate(integrand, 3, breaks, {1e-14, kMeasureAccuracy, kEvaluations});
  const Vec3 area(integral.value[0], integral.value[1], integral.value[2]),
      error(integral.error[0], integral.error[1], integral.error[2]);
  const double size = glm::length(area);
  if (!integral.converged || !(size > glm::length(error))) return std::nullopt;
  for (int k = 0; k < kTried; ++k) {
    const double t = curve.domain().lo + curve.domain().width() * (k + 0.5) / kTried;
    if (!(std::abs(glm::dot(area / size, curve.point(t) - curve.point(curve.domain().lo))) <= kFlat * unit))
      return std::nullopt;
  }
  return Measured{unit * unit * size, unit * unit * glm::length(error)};
}

}  // namespace lekalo::geometry
