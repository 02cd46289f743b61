// Profiles of bodies: a plane region bounded by one closed curve and any number of holes, each cut into segments at its
// corners (Golovanov 2016, 5.7).
#pragma once

#include <memory>
#include <vector>

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

struct ProfileLoop {
  std::vector<CurvePtr> segments;  // each begins where the one before ends, and the first where the last ends
  Vec3 area{0};                    // area times the normal about which the loop runs counterclockwise
  bool hole = false;
  size_t source = 0;  // its curve among those given
};

struct Profile {
  Frame plane;
  std::vector<ProfileLoop> loops;  // the outer one first

  // Seen against the plane's z, the region lies to the left of the loop.
  bool is_left(const ProfileLoop& loop) const { return (glm::dot(loop.area, plane.z) > 0) != loop.hole; }
  std::vector<Vec3> samples() const;
};

// The smooth segments of a curve: those of a composite curve, else cut where the tangent or the curvature jumps.
std::vector<CurvePtr> smooth_segments(const CurvePtr& curve);

// The profile of the curves of a field (references), whose plane's normal is that of the first. Throws FieldError for
// curves that are open, not plane, in several planes, cross themselves or each other, or are not one outline with
// holes.
Profile read_profile(const Fields& fields, const char* field);
Profile profile_of(const std::vector<CurvePtr>& curves, const char* field);

// Turns the plane so that its normal has a positive component along the direction. Throws FieldError (that field) where
// the direction lies in the plane.
void face_along(Profile& profile, const Vec3& direction, const char* field);

}  // namespace lekalo::geometry
