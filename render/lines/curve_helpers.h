// What helpers show: combs of curvature, moving frames; and how far they reach.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "render/model/model.h"

namespace lekalo::render {

// Teeth across the curve at `count` even parameters: r - scale k n, on the side away from the centre of curvature (k n
// the vector of curvature); `by` torsion r + scale chi b along the binormal; by geodesic_curvature or normal_curvature
// of a curve on a surface only the part of k n along the surface or along its normal. Where the curve rests there are
// none. Where the teeth jump, as at a joint of a line and an arc, one comb ends and another begins, with both teeth.
struct CurvatureComb {
  std::vector<geometry::Vec3> foot_points, tips;
};
std::vector<CurvatureComb> curvature_combs(const geometry::Curve& curve, int count, double scale,
                                           const std::string& by);

// Where the pieces of a curve do not meet: its own points there, and its limits from either side that are others.
struct CurveJumps {
  std::vector<geometry::Vec3> values, limits;
};
CurveJumps curve_jumps(const geometry::Curve& curve);

// So many parameters, evenly spaced in arc length: both ends, or of a closed curve the first alone. One: the middle.
std::vector<double> even_parameters(const geometry::Curve& curve, int count);

// Frames with z the tangent, x the principal normal, y the binormal (Golovanov 2016, 2.1). Places without curvature
// have none.
std::vector<geometry::Frame> frenet_frames(const geometry::Curve& curve, const std::vector<double>& at);

// Frames that turn about the tangent no more than they must, beginning with the principal normal where there is one.
// `at` must rise.
std::vector<geometry::Frame> rotation_minimizing_frames(const geometry::Curve& curve, const std::vector<double>& at);

// Those that a helper `frames` asks for.
std::vector<geometry::Frame> helper_frames(const geometry::Curve& curve, const Helper& helper);

// Ends of what a helper `normals` shows at a place: the normal n, and with `frames` the unit tangent t along u and t x
// n (Grezdov, Filippenko 2010, 10).
std::vector<geometry::Vec3> normal_tips(const geometry::Surface& surface, double u, double v, const Helper& helper);

// What the helpers of an object reach: control points, tips of combs, frames and normals.
std::vector<geometry::Vec3> helper_points(const Object& object);

}  // namespace lekalo::render
