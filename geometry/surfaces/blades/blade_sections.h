// Sections of a turbine blade (Zavyalov et al. 1985, VII.3; II.6, problems 6 and 7).
#pragma once

#include <optional>

#include "geometry/describe.h"

namespace lekalo::geometry {

// Points from the trailing edge along the pressure side, about the leading edge and along the suction side back.
struct BladeSection {
  std::vector<Vec3> points;
  int leading = 0;               // the point on the leading edge
  std::optional<double> radius;  // of a cylinder: the points are places on its development
};

// Throws FieldError.
std::vector<BladeSection> blade_sections(const Fields& fields);

// A place of the development of a cylinder about z, x along its circumference: (R cos x/R, R sin x/R, y).
Vec3 wound_up(const BladeSection& section, const Frame& about, const Vec3& place);

}  // namespace lekalo::geometry
