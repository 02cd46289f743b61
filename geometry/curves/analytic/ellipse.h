// Ellipses and their arcs; circles are the case of equal semi-axes (curves/circle.h).
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// r(t) = o + a cos t x + b sin t y in a frame (o; x, y, z), t in radians: the eccentric anomaly, not the polar angle.
class Ellipse : public Curve {
 public:
  // Semi-axes a, b > 0; the arc may start anywhere and is at most one turn long. Throws std::invalid_argument.
  Ellipse(const Frame& frame, double a, double b, const Interval& arc = {0, kTwoPi});

  const Frame& frame() const { return frame_; }
  double semi_axis_x() const { return a_; }
  double semi_axis_y() const { return b_; }

  Interval domain() const override { return arc_; }
  double period() const override { return kTwoPi; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::optional<NurbsCurveForm> as_nurbs() const override;
  CurvePtr continued(const Interval& domain) const override {
    return domain.width() <= kTwoPi ? std::make_shared<Ellipse>(frame_, a_, b_, domain) : nullptr;
  }

 private:
  Frame frame_;
  double a_, b_;
  Interval arc_;
};

}  // namespace lekalo::geometry
