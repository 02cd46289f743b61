// What surfaces that are moved along their normals ask of them.
#pragma once

#include <string>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Throws FieldError (that field) for a surface with a pole, or without a normal at one of the places of a grid.
void check_normals(const Surface& of, const std::string& field);

}  // namespace lekalo::geometry
