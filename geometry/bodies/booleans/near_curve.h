// A curve prepared for the question where on it a point lies.
#pragma once

#include <optional>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

class NearCurve {
 public:
  explicit NearCurve(CurvePtr curve);

  const Box3& box() const { return box_; }
  double length() const { return length_; }
  Vec3 point(double t) const { return curve_->point(t); }
  // The parameter of the nearest point, where that is not farther than `near`.
  std::optional<double> place_of(const Vec3& p, double near) const;

 private:
  CurvePtr curve_;
  std::vector<double> ends_;
  std::vector<Vec3> corners_;
  double sag_ = 0;  // of the polygon of corners
  double length_ = 0;
  Box3 box_;
};

}  // namespace lekalo::geometry
