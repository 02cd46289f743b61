// What helpers draw of a surface: lines, arrows and points on and beside it, in the surface's own coordinates
// (Golovanov 2016, 3.1).
//
//   curvature_lines, asymptotic_lines, contour_lines, isophotes, reflections   lines on the surface
//   principal_directions, umbilics, hedgehog, tool_axis_field                  crosses, points, needles, arrows
//   principal_circles, dupin_indicatrix, tangent_plane                   at one place
#pragma once

#include <string>
#include <vector>

#include "geometry/contour.h"
#include "geometry/surface.h"
#include "render/model/look.h"

namespace lekalo::render {

struct SurfaceFigure {
  struct Line {
    geometry::CurvePtr curve;
    geometry::Curve2Ptr image;  // on the surface; none where it does not lie there
    bool arrow = false;         // a head at its end
  };
  struct Text {
    geometry::Vec3 point;
    std::string words;
  };
  std::vector<Line> lines;
  std::vector<Text> texts;
  std::vector<geometry::Vec3> points;  // that get the helper's marker
  bool complete = true;                // false where not all of the lines are known
};

// Whether a helper is one of these.
bool is_surface_figure(const std::string& helper);

// Whether it reaches beyond the surface, so that a picture that shows all of it needs more room.
bool leaves_surface(const Helper& helper);

// Throws std::invalid_argument for a surface of which none of these can be drawn: an unbounded one.
void check_surface_figure(const geometry::Surface& surface);

// Whether all of it lies on the surface, so that faces of bodies have it too.
bool lies_on_surface(const Helper& helper);

// Throws FieldError for fields that do not fit the surface; std::invalid_argument for an unbounded one. `levels`: of
// contour_lines.
SurfaceFigure surface_figure(const geometry::SurfacePtr& surface, const Helper& helper,
                             const std::vector<double>& levels = {});

// Those that a helper contour_lines asks for, or round numbers of the range on all of the surfaces.
std::vector<double> contour_levels(const Helper& helper, const std::vector<geometry::SurfacePtr>& surfaces);

}  // namespace lekalo::render
