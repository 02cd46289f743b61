// What helpers draw of a curve: lines and points beside it, in the curve's own coordinates.
//
//   osculating_circle, evolute, tangents, normal_lines, features, hodograph, direction      (Golovanov 2016, 2.1)
//   insertion, elevation, hulls, moved_point                                      (2.4, 2.6, 2.11, 2.8: local support)
//   crossings                                                                     (2.9: variation diminishing)
//   cutters, tool_axes, contacts, tool_moves                       (tool_figures.h)
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"
#include "render/model/look.h"

namespace lekalo::render {

struct CurveFigure {
  std::vector<geometry::CurvePtr> lines;
  std::vector<geometry::Vec3> points;  // that get the helper's marker
  bool arrows = false;                 // heads at the ends of the lines
  std::vector<size_t> counts;          // counters of the helper's label, which stands at `label_at`
  geometry::Vec3 label_at{0};
};

// Whether a helper is one of these.
bool is_curve_figure(const std::string& helper);

// Throws FieldError for fields that do not fit the curve, and for a curve without a NURBS form where one is needed.
CurveFigure curve_figure(const geometry::CurvePtr& curve, const Helper& helper);

}  // namespace lekalo::render
