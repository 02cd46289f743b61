#include "geometry/curves/polynomial_approximation.h"

#include <cmath>

#include "geometry/numerics/chebyshev.h"

namespace lekalo::geometry {

namespace {

constexpr int kNodes = static_cast<int>(PolynomialCurve::kTerms);
constexpr size_t kMostParts = 4096;
constexpr int kMostHalvings = 24;  // of a piece
constexpr double kLeftOut = 0.1;   // of the tolerance: terms as small together

class Fitting {
 public:
  Fitting(const std::function<Vec3(double)>& point, double tolerance) : point_(point), tolerance_(tolerance) {}

  bool add(const Interval& t, int depth) {
    PolynomialCurve::Part part;
    std::array<Vec3, kNodes> values;
    // At a break the curve's own point is that from the right.
    const double last = next_down(t.hi);
    const auto point = [&](double x) { return point_(std::min(t.middle() + 0.5 * t.width() * x, last)); };
    for (int j = 0; j < kNodes; ++j) values[j] = point(chebyshev_point(j, kNodes));
    auto coefficients = chebyshev_coefficients(values);
    // A cubic is one again: what is rounding, or as little, is left out.
    double left_out = 0;
    int terms = kNodes;
    while (terms > 1 && left_out + glm::length(coefficients[terms - 1]) <= kLeftOut * tolerance_)
      left_out += glm::length(coefficients[--terms]), coefficients[terms] = Vec3(0);
    part = {t, 2 / t.width(), powers_of_chebyshev(coefficients), terms};
    bool good = true;
    for (const double x : {-1.0, -0.97, -0.6, -0.1, 0.3, 0.85, 1.0})
      good = good && glm::length(part.value(x) - point(x)) <= tolerance_;
    if (good) {
      parts.push_back(part);
      return parts.size() <= kMostParts;
    }
    return depth < kMostHalvings && add({t.lo, t.middle()}, depth + 1) && add({t.middle(), t.hi}, depth + 1);
  }

  std::vector<PolynomialCurve::Part> parts;

 private:
  const std::function<Vec3(double)>& point_;
  double tolerance_;
};

}  // namespace

std::shared_ptr<const PolynomialCurve> polynomial_approximation(const std::function<Vec3(double)>& point,
                                                                std::span<const Interval> pieces, double tolerance) {
  Fitting fitting(point, tolerance);
  for (const Interval& t : pieces)
    if (!t.empty() && t.width() > 0 && !fitting.add(t, 0)) return nullptr;
  return std::make_shared<const PolynomialCurve>(std::move(fitting.parts));
}

std::shared_ptr<const PolynomialCurve> polynomial_approximation(const Curve& curve, double tolerance) {
  std::vector<Interval> pieces;
  for (const CurvePiece& piece : curve.pieces()) pieces.push_back(intersect(piece.domain, curve.domain()));
  return polynomial_approximation([&](double t) { return curve.point(t); }, pieces, tolerance);
}

}  // namespace lekalo::geometry
