// What helpers draw of the paths of cutters: the cutters themselves, their axes, and where they touch (Zavyalov, Leus,
// Skorospelov 1985, V.1).
#pragma once

#include "geometry/describe.h"
#include "render/lines/curve_figures.h"

namespace lekalo::render {

// All throw FieldError for a curve that is no path of a cutter, as one that was moved afterwards.
CurveFigure cutters_figure(const geometry::CurvePtr& path, const geometry::Fields& fields);
CurveFigure tool_axes_figure(const geometry::CurvePtr& path, const geometry::Fields& fields);
CurveFigure contacts_figure(const geometry::CurvePtr& path, const geometry::Fields& fields);
CurveFigure tool_moves_figure(const geometry::CurvePtr& path, const geometry::Fields& fields);

}  // namespace lekalo::render
