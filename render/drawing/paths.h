// Pictures of curves as paths of straight lines and cubic Bezier curves.
#pragma once

#include <vector>

#include "render/lines/projected_curve.h"

namespace lekalo::render {

// From the point before through two handles to `to`; a straight line without handles.
struct PathStep {
  bool straight = true;
  Vec2 first{0}, second{0}, to{0};
};
struct Path {
  Vec2 from{0};
  std::vector<PathStep> steps;
  bool closed = false;  // ends where it begins, smoothly or not
};

// The picture of the curve over `t`, in pixels, no farther than `tolerance` from it. `breaks`: parameters where the
// curve may have a corner.
Path fitted_path(const ProjectedCurve& curve, const geometry::Interval& t, const std::vector<double>& breaks,
                 double tolerance);

// The same the other way.
Path reversed(const Path& path);

}  // namespace lekalo::render
