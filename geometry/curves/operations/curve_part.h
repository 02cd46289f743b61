// A part of a curve, with the curve's own parameter.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

class CurvePart final : public Curve {
 public:
  // The range is finite, not empty, and lies in the curve's domain; throws std::invalid_argument.
  CurvePart(CurvePtr of, const Interval& range);

  const CurvePtr& of() const { return of_; }

  Interval domain() const override { return range_; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override { return of_->evaluate(t, order); }
  double fit_distance() const override { return of_->fit_distance(); }
  int max_order() const override { return of_->max_order(); }
  CurveEnclosure enclose(const Interval& t, int order) const override { return of_->enclose(t, order); }
  int enclosure_order() const override { return of_->enclosure_order(); }
  std::vector<CurvePiece> pieces() const override;
  // The whole curve's: it covers more than the part.
  std::optional<NurbsCurveForm> as_nurbs() const override { return of_->as_nurbs(); }

 private:
  CurvePtr of_;
  Interval range_;
};

// The curve itself where the range is its domain, else that part of it; throws as the constructor.
CurvePtr curve_over(const CurvePtr& curve, const Interval& range);

// The parts between steps and poles, of all that a curve without them; none is shorter than 1e-12 of its domain.
std::vector<CurvePtr> unbroken_parts(const CurvePtr& curve);

}  // namespace lekalo::geometry
