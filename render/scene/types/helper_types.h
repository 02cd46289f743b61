// What declarations of helpers (`show` of an object) have in common.
#pragma once

#include <vector>

#include "geometry/describe.h"

namespace lekalo::render {

namespace helpers {

// With the fields `style` and `hidden`.
geometry::TypeDeclaration helper(const char* name, const char* description, const char* default_style);
// Built as a Helper (render/model/look.h).
geometry::TypeDeclaration& finish(geometry::TypeDeclaration& type);
// A sign at points.
geometry::FieldType marker();

}  // namespace helpers

// Those of surfaces, and of triangulations.
std::vector<geometry::TypeDeclaration> surface_helper_types();
// Those of planned paths: graphs, pockets.
std::vector<geometry::TypeDeclaration> route_helper_types();

}  // namespace lekalo::render
