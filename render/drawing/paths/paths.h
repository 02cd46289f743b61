// Pictures of curves as paths of straight lines, arcs of ellipses and cubic Bezier curves.
#pragma once

#include <vector>

#include "render/lines/projected_curve.h"

namespace lekalo::render {

// An ellipse: center + cos(a) x + sin(a) y; x and y are its half axes, at right angles.
struct PictureEllipse {
  Vec2 center{0}, x{0}, y{0};

  Vec2 point(double angle) const;
};

// From the point before to `to`.
struct PathStep {
  enum class Kind { line, curve, arc } kind = Kind::line;
  Vec2 to{0};
  Vec2 first{0}, second{0};   // of a cubic Bezier curve: its handles
  PictureEllipse ellipse;     // of an arc
  double begin = 0, end = 0;  // of an arc: its angles, radians, no more than a quarter turn apart
};
inline PathStep line_to(const Vec2& to) { return {PathStep::Kind::line, to, {}, {}, {}, 0, 0}; }
inline PathStep curve_to(const Vec2& first, const Vec2& second, const Vec2& to) {
  return {PathStep::Kind::curve, to, first, second, {}, 0, 0};
}
// The arc from one angle of the ellipse to another, in either direction, as one step for each quarter turn.
std::vector<PathStep> arcs_to(const PictureEllipse& ellipse, double begin, double end);

// The point at the share s, 0 to 1, of a step that begins there.
Vec2 point_on(const Vec2& begin, const PathStep& step, double s);

struct Path {
  Vec2 from{0};
  std::vector<PathStep> steps;
  bool closed = false;  // ends where it begins, smoothly or not

  const Vec2& end() const { return steps.empty() ? from : steps.back().to; }
};

// The picture of the curve over `t`, in pixels, no farther than `tolerance` from it. `breaks`: parameters where the
// curve may have a corner, ascending. What is straight, or an arc of an ellipse to rounding, becomes one.
Path fitted_path(const ProjectedCurve& curve, const geometry::Interval& t, const std::vector<double>& breaks,
                 double tolerance);

// Whether no place of the path is farther from its beginning than `size`: a line that is seen along itself.
bool is_point(const Path& path, double size);

// The step between two shares of it, `begin` being where it begins.
PathStep part_of(const Vec2& begin, const PathStep& step, double from, double to);

// The path the other way.
Path reversed(const Path& path);
// Every point p at scale p + shift.
Path moved(Path path, const Vec2& shift, double scale = 1);
// The same without arcs: by cubic curves no farther from them than `tolerance`.
Path without_arcs(const Path& path, double tolerance);

}  // namespace lekalo::render
