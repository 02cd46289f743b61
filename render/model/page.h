// What a drawing shows beside its objects: annotations, axes of a graph, legend, ground; and several views on a page.
// Plain values, checked and with formulas evaluated; lengths on the page are millimetres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/model/look.h"
#include "render/scene/values/source.h"

namespace lekalo::render {

// A label, an arrow, a dimension, ...: its type and fields as declared in annotation_types.cpp.
struct Annotation {
  std::string type;
  Style style;
  geometry::Fields values;
  Place place;
};

// One axis of a graph.
struct GraphAxis {
  TextTemplate label;
  std::string ticks = "auto";  // auto, none, or empty: `tick_values`
  std::vector<double> tick_values;
  std::vector<TextTemplate> texts;  // of these ticks; empty: their numbers
  bool grid = false;                // lines across the graph at the ticks
};

struct GraphAxes {
  std::optional<GraphAxis> x, y;
  Style style, grid_style;
};

struct Legend {
  std::string side = "right";  // above, below, left, right, or a corner inside: above left, ...
  std::optional<TextTemplate> title;
  Style style;
};

enum class Ground { none, fill, shaded };

struct DrawingChoices {
  Ground ground = Ground::none;
  Fill fill;  // of ground fill, for objects without their own
  geometry::Vec3 paper{1};
  Lines lines;  // of objects without their own
  std::optional<GraphAxes> axes;
  std::optional<Legend> legend;
  std::vector<Annotation> annotations;
  std::optional<Style> center_lines;  // axes of what is round; none: not drawn
  std::string title;                  // TeX, above the view; empty: none
};

// Where panels stand: rows from the top, each from the left; an empty name leaves the place free.
struct Layout {
  std::vector<std::vector<std::string>> rows;
  double scale = 0;              // millimetres of paper for one of the model, info.unit decides; 0: as large as fits
  double gap = 5;                // between panels
  std::vector<double> columns;   // widths in proportion; empty: equal. Not with a scale
  Place scale_place, gap_place;  // in the scene file, for messages; none where they are not given
};

// The sheet of drawings.
struct Paper {
  double width = 0;  // millimetres; a picture in pixels counts 96 of them to the inch
  double height = 0;
  double margin = 0;
  bool auto_width = false, auto_height = false;  // as the panels want it
  Place size_place, margin_place;                // as in Layout
};

// Whether it is a colour bar that neither has numbers of its own nor those of a curve.
bool tells_scale_of_ground(const Annotation& annotation);

// Why nothing of an annotation can be seen: the field, what is wrong, and a hint; nothing where it has a size.
std::optional<geometry::FieldError> lack_of_size(const std::string& type, const geometry::Fields& values);

std::vector<geometry::Field> drawing_fields();
// Throws FieldError.
DrawingChoices drawing_of(const geometry::Fields& fields);

}  // namespace lekalo::render
