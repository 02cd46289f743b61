// A scene as a finished drawing: its view, or several of them as panels, with lines, signs, axes, annotations and texts
// in their places.
#pragma once

#include <memory>

#include "render/drawing/figure_sheet.h"

namespace lekalo::render {

// Of the page's pixels those that the film's crop keeps. Throws SceneError where something does not fit on the paper
// (with what would), std::runtime_error where a font is missing.
Figure figure_of(const std::shared_ptr<const Model>& model, const FigureOptions& options);

}  // namespace lekalo::render
