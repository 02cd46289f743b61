#pragma once

#include "geometry/describe.h"
#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// r(u, v) = p + M(v) (c(u) - p), M(v) the rotation by the angle v (radians, right-hand rule) about the axis through p:
// u is the curve's own parameter, v the angle. For a curve that runs upward beside the axis the normal points inward.
// Where the curve meets the axis at an end, that edge is one point and the normal is the limit from inside.
class RevolutionSurface final : public Surface {
 public:
  // The whole curve turned from 0 to the angle. Throws std::invalid_argument for more than a turn and for a curve that
  // lies on the axis.
  RevolutionSurface(CurvePtr curve, const Axis& axis, double angle = kTwoPi);
  // A part: u within the curve's domain, v at most a turn.
  RevolutionSurface(CurvePtr curve, const Axis& axis, const Rectangle& domain);

  const CurvePtr& curve() const { return curve_; }
  Axis axis() const { return {frame_.origin, frame_.z}; }

  Rectangle domain() const override { return domain_; }
  Periods periods() const override { return {curve_->period(), kTwoPi}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  double fit_distance() const override { return curve_->fit_distance(); }
  int max_order() const override { return std::min(curve_->max_order(), kMaxSurfaceOrder); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return curve_->enclosure_order(); }
  std::vector<SurfacePiece> pieces() const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override;
  DegenerateEdges degenerate_edges() const override;

 private:
  template <class T>
  Triple<T> at(const T& u, const T& v) const;
  bool on_axis(double u) const;
  CurvePtr curve_;
  Frame frame_;  // z is the axis
  Rectangle domain_;
};

}  // namespace lekalo::geometry
