// Which of several branches a scene means.
#pragma once

#include <string>
#include <vector>

#include "geometry/contour.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// Declares the fields `branch` and `near`.
TypeDeclaration& choose_branch(TypeDeclaration& type);
// The branch that they choose, or the only one. `field`: what gave the branches. Throws FieldError, which lists them.
CurvePtr chosen_branch(const std::vector<Contour>& branches, const Fields& fields, const std::string& field);

}  // namespace lekalo::geometry
