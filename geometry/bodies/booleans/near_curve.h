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
  // Every passage of the curve within `near` of the point: of a closed curve both ends, of one that crosses itself
  // there each time. Passages are farther apart, along the curve, than they are wide.
  std::vector<double> places_of(const Vec3& p, double near) const;

 private:
  // Calls visit(t, distance) for the nearest point of each part of the curve that comes so near.
  template <class Visit>
  void near_places(const Vec3& p, double near, Visit&& visit) const;

  CurvePtr curve_;
  std::vector<double> ends_;
  std::vector<Vec3> corners_;
  double sag_ = 0;  // of the polygon of corners
  double length_ = 0;
  Box3 box_;
};

}  // namespace lekalo::geometry
