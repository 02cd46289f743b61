// Offsets of profiles: thin-walled ones from open curves, and drafts (Golovanov 2016, 5.7).
#pragma once

#include "geometry/bodies/constructions/profile.h"

namespace lekalo::geometry {

// The curves at a distance to the left of each segment, seen against the normal of their plane, cut or extended to meet
// their neighbours: as many segments as there were, each over the same parameters, none inserted at corners. Throws
// FieldError (that field) where one of them vanishes or neighbours do not meet.
std::vector<CurvePtr> mitred_offset(const std::vector<CurvePtr>& segments, const Vec3& normal, double distance,
                                    bool closed, const char* field);

// Declares `thickness` and `thickness_side`.
void declare_thickness(TypeDeclaration& type);

// The profile of the curves of a field; with `thickness` what lies between an open curve and its offset. `motion` is
// where the profile will go: left and right are as seen against it, and the plane of a straight curve is across it.
Profile read_thick_profile(const Fields& fields, const char* field, const Vec3& motion);

}  // namespace lekalo::geometry
