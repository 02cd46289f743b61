// Colours that stand for numbers, and what of a curve they may tell.
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::render {

// The names of the scales.
std::vector<std::string> color_scales();

// The colour at x in [0, 1], linear Rec.709: viridis grows from dark blue to yellow in even steps of lightness;
// blue_red goes through white, for numbers that have a middle; grey from dark to light.
geometry::Vec3 color_at(const std::string& scale, double x);

// What a line may be coloured by: curvature, signed_curvature (of a plane curve, positive to the left in its plane z =
// const), torsion, speed (|dr/dt|), parameter.
std::vector<std::string> curve_quantities();

// At a place; where there is none (a torsion of a straight point) 0.
double curve_quantity(const geometry::Curve& curve, const std::string& quantity, double t);

// Least and largest of it, as seen at places of the curve; of a constant quantity a range about it.
geometry::Interval curve_range(const geometry::Curve& curve, const std::string& quantity);

}  // namespace lekalo::render
