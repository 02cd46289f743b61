// Arcs of parabolas.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// r(t) = o + f t^2 x + 2 f t y in a frame (o; x, y, z): the vertex at t = 0, the focus at f x, the directrix -f x.
class Parabola final : public Curve {
 public:
  // Focal length f > 0, a finite range; throws std::invalid_argument.
  Parabola(const Frame& frame, double focal_length, const Interval& range);

  const Frame& frame() const { return frame_; }
  double focal_length() const { return focal_length_; }

  Interval domain() const override { return range_; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::optional<NurbsCurveForm> as_nurbs() const override;
  CurvePtr continued(const Interval& domain) const override {
    return std::make_shared<Parabola>(frame_, focal_length_, domain);
  }

 private:
  Frame frame_;
  double focal_length_;
  Interval range_;
};

}  // namespace lekalo::geometry
