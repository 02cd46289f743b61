// What `lekalo evaluate` tells of one kind of thing.
#pragma once

#include <vector>

#include "geometry/surface.h"
#include "json.h"

namespace lekalo::command {

inline ordered_json json_or_null(bool known, double x) { return known ? finite_or_null(x) : ordered_json(nullptr); }

// `along`: none, or one or two directions in the parameter plane, in which the normal curvature and between which the
// angle is told.
ordered_json evaluate_surface(const geometry::Surface& surface, const geometry::Vec2& uv,
                              const std::vector<geometry::Vec2>& along);

}  // namespace lekalo::command
