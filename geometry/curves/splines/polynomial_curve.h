// Curves that are polynomials on each of some parts of their domain: what is left of solutions of differential
// equations and other curves without a formula.
#pragma once

#include "geometry/curve.h"
#include "geometry/numerics/polynomial_part.h"

namespace lekalo::geometry {

class PolynomialCurve final : public Curve {
 public:
  static constexpr std::size_t kTerms = 17;
  using Part = PolynomialPart<kTerms>;

  // Parts in order, each beginning at the parameter and point where the one before ends; at least one.
  explicit PolynomialCurve(std::vector<Part> parts) : parts_(std::move(parts)) {}

  const std::vector<Part>& parts() const { return parts_; }

  Interval domain() const override { return {parts_.front().t.lo, parts_.back().t.hi}; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  // One for each part.
  std::vector<CurvePiece> pieces() const override;

 private:
  std::vector<Part> parts_;
};

}  // namespace lekalo::geometry
