#pragma once

#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// r(u, v) = c(u) + v d: u is the curve's own parameter, v the fraction of the vector d. The normal is c' x d.
class ExtrusionSurface final : public Surface {
 public:
  // v in [0, 1] and u over the whole curve. `along` must not be zero; throws std::invalid_argument.
  ExtrusionSurface(CurvePtr curve, const Vec3& along);
  // A part: u within the curve's domain, v any.
  ExtrusionSurface(CurvePtr curve, const Vec3& along, const Rectangle& domain);

  const CurvePtr& curve() const { return curve_; }
  const Vec3& along() const { return along_; }

  Rectangle domain() const override { return domain_; }
  Periods periods() const override { return {curve_->period(), 0}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  double fit_distance() const override { return curve_->fit_distance(); }
  int max_order() const override { return std::min(curve_->max_order(), kMaxSurfaceOrder); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return curve_->enclosure_order(); }
  std::vector<SurfacePiece> pieces() const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override;

 private:
  template <class T>
  Triple<T> at(const T& u, const T& v) const;

  CurvePtr curve_;
  Vec3 along_;
  Rectangle domain_;
};

}  // namespace lekalo::geometry
