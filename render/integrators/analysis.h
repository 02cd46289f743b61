// Pictures of what surfaces are like: curvatures, stripes, angles and any formula of these in colours.
#pragma once

#include "render/integrator.h"
#include "render/integrators/quantities.h"

namespace lekalo::render {

struct AnalysisOptions {
  Quantity quantity;
  std::optional<geometry::Interval> range;   // of the first and last colour; none: as the camera sees it
  std::string colors;                        // scale of colours; empty: by the quantity's sign
  geometry::ParameterValues levels{10, {}};  // about so many round numbers, or these
  bool bands = false;                        // one colour between two levels
  double line_width = 0;                     // millimetres of lines at the levels; 0: none
  double shading = 0.3;                      // how much darker surfaces are that are seen edge-on, in [0, 1]
  std::string title;
};

IntegratorPtr make_analysis_integrator(const AnalysisOptions& options);

}  // namespace lekalo::render
