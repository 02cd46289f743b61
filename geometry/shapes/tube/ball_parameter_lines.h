// The parameter lines of balls, as far as they are on the outside of all.
#pragma once

#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/shapes/tube/ball_outlines.h"

namespace lekalo::geometry {

// Meridians and parallels of each ball, z up; `view` is that of the turns.
ShapeOutlines parameter_lines(const Balls& balls, const ParameterNet& net, const ViewOf& view);

}  // namespace lekalo::geometry
