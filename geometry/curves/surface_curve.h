// A curve on a surface, r(t) = S(u(t), v(t)) (Golovanov 2016, 3.18): the image in space of a curve in the parameter
// plane.
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class SurfaceCurve final : public Curve {
 public:
  SurfaceCurve(SurfacePtr surface, Curve2Ptr image) : surface_(std::move(surface)), image_(std::move(image)) {}

  Interval domain() const override { return image_->domain(); }
  // Derivatives up to the surface's highest order; throws std::invalid_argument beyond.
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  // Those of the image; none is rational.
  std::vector<CurvePiece> pieces() const override;

 private:
  SurfacePtr surface_;
  Curve2Ptr image_;
};

}  // namespace lekalo::geometry
