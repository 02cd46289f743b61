// Sets of Bezier patches as text, in the form in which the Newell teapot is handed round.
#pragma once

#include <string_view>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// The first number is the count of patches. Each patch is then 16 points of three numbers, four rows of four; a line of
// two whole numbers before a patch gives other degrees (m n: (m + 1) x (n + 1) points), for this patch and the
// following ones. The row index runs with u. '#' begins a comment; blank lines mean nothing.
// Throws FieldError (field file) that names the line.
std::vector<SurfacePtr> parse_patches(std::string_view text);

}  // namespace lekalo::geometry
