// Arcs of hyperbolas.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// r(t) = o + a cosh t x + b sinh t y in a frame (o; x, y, z): the branch towards x, its vertex at t = 0.
class Hyperbola final : public Curve {
 public:
  // Semi-axes a, b > 0, a finite range; throws std::invalid_argument.
  Hyperbola(const Frame& frame, double a, double b, const Interval& range);

  const Frame& frame() const { return frame_; }
  double semi_axis_x() const { return a_; }
  double semi_axis_y() const { return b_; }

  Interval domain() const override { return range_; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::optional<NurbsCurveForm> as_nurbs() const override;
  CurvePtr continued(const Interval& domain) const override {
    return std::make_shared<Hyperbola>(frame_, a_, b_, domain);
  }

 private:
  Frame frame_;
  double a_, b_;
  Interval range_;
};

}  // namespace lekalo::geometry
