// Points and normals of a surface of which a sparse wire frame is known (Zavyalov, Leus, Skorospelov 1985, III.3).
//
// Over a base plane, onto which the surface projects one to one, planes across it cut the lines of the frame; the
// points in each are interpolated by a plane curve. Where a section x = const meets one y = const there is a point of
// the surface, and the product of their tangents is its normal. With an interpolant that errs by h all of it is within
// 3 h, as long as the surface does not bend by more than 55 degrees.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/mesh.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class FrameNet {
 public:
  // The lines of the frame, and the base plane: x and y of `base`. Throws FieldError (field of) for unbounded lines.
  FrameNet(std::vector<CurvePtr> frame, const Frame& base);

  // Coordinates x and y over which the frame lies.
  const Rectangle& range() const { return range_; }

  // The section x = at (along_y), or y = at: a cubic spline through the points where the frame's lines meet it, whose
  // parameter is the other coordinate; null where there are fewer than two. Throws FieldError (field frame) where two
  // lie above one another.
  CurvePtr section(bool along_y, double at) const;

  // The net over a rectangle of x and y with so many sections each way, which the frame surrounds; parameters are x, y.
  // Throws FieldError (field of) where it has no cell.
  Mesh mesh(const Rectangle& range, int count_x, int count_y) const;

 private:
  std::vector<CurvePtr> frame_;
  Frame base_;
  Rectangle range_;
  double size_ = 1;
};

}  // namespace lekalo::geometry
