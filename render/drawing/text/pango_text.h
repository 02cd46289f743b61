// Pango as drawings use it: one font by name, no hints, no resolution.
#pragma once

#include <pango/pangocairo.h>

#include <memory>
#include <string>

#include "render/drawing/sheet.h"

namespace lekalo::render {

struct GObjectUnref {
  void operator()(void* object) const { g_object_unref(object); }
};
using PangoContextPtr = std::unique_ptr<PangoContext, GObjectUnref>;
using PangoLayoutPtr = std::unique_ptr<PangoLayout, GObjectUnref>;

// A context of its own whose texts scale without steps.
PangoContextPtr exact_context();

// A line of characters of one font, whose em is `size` units.
PangoLayoutPtr layout_of(PangoContext* context, const Font& font, const std::string& text, double size);

}  // namespace lekalo::render
