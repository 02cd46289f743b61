#include "render/model/page.h"

#include <fmt/format.h>

namespace lekalo::render {

using namespace geometry;

namespace {

std::vector<Field> axis_fields() {
  return {
      {"label", label(), "what is measured along it", false, {}},
      {"ticks", numbers().or_word({"auto", "none"}), "where there are marks: a list, or a range 0..6", false, "auto"},
      {"texts",
       labels(),
       "TeX at the marks of a list instead of their numbers, one for each: ['$0$', '$\\pi$']",
       false,
       {}},
      {"grid", boolean(), "lines across the graph at the marks", false, "false"}};
}

GraphAxis axis_of(const Fields& fields, const std::string& name) {
  GraphAxis axis;
  if (fields.has("label")) axis.label = fields.get<TextTemplate>("label");
  axis.ticks = fields.word("ticks");
  if (axis.ticks.empty()) axis.tick_values = fields.numbers("ticks");
  if (fields.has("texts")) {
    axis.texts = fields.get<std::vector<TextTemplate>>("texts");
    if (!axis.ticks.empty())
      throw FieldError(name + ".texts", "texts stand at marks that are given: these are '" + axis.ticks + "'",
                       "ticks: [0, pi/2, pi] beside the texts");
    if (axis.texts.size() != axis.tick_values.size())
      throw FieldError(name + ".texts",
                       fmt::format("{} texts for {} marks", axis.texts.size(), axis.tick_values.size()),
                       "one for each of `ticks`; '' leaves one without");
  }
  axis.grid = fields.boolean("grid");
  return axis;
}

}  // namespace

std::vector<Field> drawing_fields() {
  const FieldType style = reference({Category::style});
  return {
      {"ground", choice({"none", "fill", "shaded"}),
       "under the lines: nothing, plain areas, or the picture as rendered", false, "none"},
      {"fill", group(fill_fields()), "of the areas of `ground: fill`, of objects that do not say", false, "{}"},
      {"paper", color().between(0, 1), "of the sheet", false, "white"},
      {"lines", group(lines_fields()), "of objects that do not say which lines they have", false, kUsualLines},
      {"axes",
       group({{"x", group(axis_fields()), "the axis below a graph", false, {}},
              {"y", group(axis_fields()), "the axis left of a graph", false, {}},
              {"style", style, "of the axes, their marks and texts", false, "thin"},
              {"grid_style", style, "of the lines across the graph", false, "hairline"}}),
       "axes of a graph (camera: { type: graph })",
       false,
       {}},
      {"legend",
       group({{"side",
               choice({"above", "below", "left", "right", "above left", "above right", "below left", "below right"}),
               "beside the picture, or in a corner of it", false, "right"},
              {"title", label(), "above the entries", false, {}},
              {"style", style, "of its texts", false, "label"}}),
       "list of the objects that have a `legend`",
       false,
       {}},
      {"center_lines", boolean(), "axes of all that is round, in the style `center_line_style`", false, "false"},
      {"center_line_style", style, "of centre lines", false, "axis"},
      {"annotations", references({Category::annotation}).count(0), "labels, arrows, dimensions, ...", false, {}}};
}

DrawingChoices drawing_of(const Fields& fields) {
  DrawingChoices drawing;
  const std::string& ground = fields.text("ground");
  drawing.ground = ground == "fill" ? Ground::fill : ground == "shaded" ? Ground::shaded : Ground::none;
  drawing.fill = fill_of(fields.group("fill"));
  drawing.paper = fields.vec3("paper");
  drawing.lines = lines_of(fields.group("lines"));
  if (fields.has("axes")) {
    const Fields& given = fields.group("axes");
    GraphAxes& axes = drawing.axes.emplace();
    if (given.has("x")) axes.x = axis_of(given.group("x"), "axes.x");
    if (given.has("y")) axes.y = axis_of(given.group("y"), "axes.y");
    axes.style = style_of(given, "style");
    axes.grid_style = style_of(given, "grid_style");
  }
  if (fields.has("legend")) {
    const Fields& given = fields.group("legend");
    Legend& legend = drawing.legend.emplace();
    legend.side = given.text("side");
    if (given.has("title")) legend.title = given.get<TextTemplate>("title");
    legend.style = style_of(given, "style");
  }
  if (fields.boolean("center_lines")) drawing.center_lines = style_of(fields, "center_line_style");
  if (fields.has("annotations"))
    for (const std::any& one : fields.references("annotations"))
      drawing.annotations.push_back(std::any_cast<const Annotation&>(one));
  return drawing;
}

}  // namespace lekalo::render
