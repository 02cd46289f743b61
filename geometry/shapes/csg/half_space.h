// All points on one side of a plane: dot(p - through, normal) <= 0. The normal looks out of it.
#pragma once

#include <span>

#include "geometry/shape.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

class HalfSpaceShape final : public Shape {
 public:
  // The normal is a unit vector.
  HalfSpaceShape(const Vec3& through, const Vec3& normal) : plane_(frame_about(through, normal)) {}

  const Frame& frame() const { return plane_.frame(); }

  Box3 bounds() const override;
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  std::optional<Mat3> shape_operator(const SurfaceHit&, const Vec3&) const override { return Mat3(0); }
  bool is_closed() const override { return true; }
  bool begins_inside(const Line& line) const override;

 private:
  Plane plane_;
};

// A box around what half-spaces have in common, which lies where z <= 0 in their frames; everything() where they leave
// it open.
Box3 bounds_of_common(std::span<const Frame> half_spaces);

}  // namespace lekalo::geometry
