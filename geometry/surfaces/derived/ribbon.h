// Ribbons: strips of constant width along a curve,
//
//   r(u, v) = c(u) + v w(u),   |w| = 1,   w . c' = 0,
//
// w being a direction across the curve (moving_frame.h).
#pragma once

#include "geometry/curves/operations/moving_frame.h"
#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// u is the curve's own parameter, v in [-width/2, width/2] a length; the normal is (tangent) x (w).
class Ribbon final : public Surface {
 public:
  // Throws FieldError (field width, and those of direction_across).
  Ribbon(CurvePtr curve, double width, const FrameLaw& law);

  Rectangle domain() const override { return domain_; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  int max_order() const override { return std::min(curve_->max_order(), kMaxSurfaceOrder); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return curve_->enclosure_order(); }
  std::vector<SurfacePiece> pieces() const override;

 private:
  template <class T>
  Triple<T> at(const T& u, const T& v) const;

  CurvePtr curve_;
  Rectangle domain_;
  std::shared_ptr<const PolynomialCurve> across_;
};

}  // namespace lekalo::geometry
