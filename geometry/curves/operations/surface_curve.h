// A curve on a surface, r(t) = S(u(t), v(t)) (Golovanov 2016, 3.18 and 4.6): the image in space of a curve in the
// parameter plane.
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Where the surface is closed (its period is the width of its domain) the image may go on beyond the domain. The curve
// is periodic if its image is, or if the image's ends differ by whole periods of such a surface.
class SurfaceCurve final : public Curve {
 public:
  // `error` is how far in space the curve may be from the one that is meant, where the image only approaches that.
  SurfaceCurve(SurfacePtr surface, Curve2Ptr image, double error = 0);

  Interval domain() const override { return image_->domain(); }
  double period() const override { return period_; }
  // Derivatives up to the surface's highest order; throws std::invalid_argument beyond.
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override { return std::min(surface_->max_order(), image_->max_order()); }
  double fit_distance() const override { return surface_->fit_distance(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  // Those of the image, cut where it passes over a line of the surface on which derivatives jump; none is rational.
  std::vector<CurvePiece> pieces() const override;

  const SurfacePtr& surface() const { return surface_; }
  const Curve2Ptr& image() const { return image_; }
  double error() const { return error_; }

 private:
  bool jumps(double t) const;
  void add_breaks(const Interval& piece, int axis, std::vector<double> lines, std::vector<double>& ends) const;

  SurfacePtr surface_;
  Curve2Ptr image_;
  double error_ = 0;
  double period_ = 0;
};

// The period of a surface that is closed in a direction, whose domain is as wide as that; else 0.
Periods closed_periods(const Surface& surface);

// The surface's enclosure over a rectangle that may lie beyond the domain where the surface is closed; elsewhere what
// lies beyond is left out.
SurfaceEnclosure enclose_unwrapped(const Surface& surface, const Rectangle& place, int order);

}  // namespace lekalo::geometry
