// Colours that stand for numbers, and what of a curve they may tell.
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"
#include "render/integrator.h"

namespace lekalo::render {

// The names of the scales.
std::vector<std::string> color_scales();

// The colour at x in [0, 1], linear Rec.709: viridis grows from dark blue to yellow in even steps of lightness;
// magma from black over purple to pale yellow; blue_red goes through white, for numbers that have a middle; grey from
// dark to light.
geometry::Vec3 color_at(const std::string& scale, double x);

// Where on a scale, in [0, 1], the colour of a number stands; of bands the middle of its band.
double place_on_scale(const PictureScale& scale, double value);

// The multiples of 1, 2 or 5 times a power of ten in the range, about `count` of them.
std::vector<double> round_numbers(const geometry::Interval& range, int count);

// What a line may be coloured by: curvature, signed_curvature (of a plane curve, positive to the left in its plane z =
// const), torsion, speed (|dr/dt|), parameter; of a curve on a surface geodesic_curvature, normal_curvature.
std::vector<std::string> curve_quantities();

// At a place; where there is none (a torsion of a straight point) 0. Throws FieldError (by) for a curve that lies on no
// surface, where it is asked for one that does.
double curve_quantity(const geometry::Curve& curve, const std::string& quantity, double t);

// How a curve on a surface bends at a place: the parts of its vector of curvature along m x t and along m, the
// surface's normal (Golovanov 2016, 3.1). Throws FieldError (by) for a curve that lies on no surface.
struct SurfaceBend {
  double geodesic = 0, normal = 0;
  geometry::Vec3 across{0}, up{0};  // m x t and m
};
SurfaceBend surface_bend(const geometry::Curve& curve, double t);

// Least and largest of it, as seen at places of the curve; of a constant quantity a range about it. In colours that
// have a middle numbers of both signs have it at zero.
geometry::Interval curve_range(const geometry::Curve& curve, const std::string& quantity, const std::string& colors);

}  // namespace lekalo::render
