// Canal surfaces: the envelope of balls of radius R(t) about the points c(t) of a curve, the wall of a tube
// (shapes/tube.h) with all that lies inside of it.
//
//   s(u, v) = q(u) + rho(u) (cos v w(u) + sin v e(u) x w(u)),   e = c'/|c'|,   p = -R'/|c'|
//   q = c + R p e,   rho = R sqrt(1 - p^2)
//
// The circles lie on the balls, across the curve. w is a direction across that turns about the curve no more than it
// must, and closes with a closed curve (surfaces/ribbon.h). It has no closed form: so q, rho w and rho e x w are
// polynomials on each of some parts of the curve that agree with what is meant to 1e-13 of the size.
#pragma once

#include <functional>

#include "geometry/numerics/polynomial_part.h"
#include "geometry/shapes/tube/ball_sweep.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// u is the curve's parameter, v in [0, 2 pi] the angle from w; the normal leads out of the tube where it bends no more
// than its radius allows.
class CanalSurface final : public Surface {
 public:
  // Over a range of the curve's parameter; `closes`: where that is all of a closed curve the wall is closed, too.
  // Throws FieldError where there is no such surface: the curve has a corner or rests, the radius jumps, or changes so
  // fast, |R'| >= |c'|, that balls hold others.
  CanalSurface(const BallSweep& sweep, const Interval& range, bool closes = true);

  Rectangle domain() const override { return {range_, {0, kTwoPi}}; }
  Periods periods() const override { return {is_closed_ ? range_.width() : 0, kTwoPi}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return kMaxSurfaceOrder; }
  std::vector<SurfacePiece> pieces() const override;

  // The unit normal on the side that is outside of the ball; the surface's own where it bends no more than its radius.
  Vec3 outward(double u, double v) const;

 private:
  static constexpr int kTerms = 14;
  using Curve3 = PolynomialPart<kTerms>;
  struct Part {
    Curve3 center, x, y;  // q, rho w, rho e x w
  };
  void cut(const Interval& t, const std::function<std::array<Vec3, 3>(double)>& circle, double agree);
  const Part& part(double u) const;

  Interval range_;
  bool is_closed_;
  std::vector<Part> parts_;
};

}  // namespace lekalo::geometry
