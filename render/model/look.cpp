#include "render/model/look.h"

#include <memory>

#include "render/scene/values/types.h"

namespace lekalo::render {

using namespace geometry;

FieldType hidden_lines() { return reference({Category::style}).or_word({"show", "drop", "dashed", "thin", "faded"}); }

HiddenLines hidden_of(const Fields& fields) {
  HiddenLines hidden;
  using Way = HiddenLines::Way;
  const std::string word = fields.word("hidden");
  if (word.empty()) {
    hidden.way = Way::styled;
    hidden.style = style_of(fields, "hidden");
  } else {
    hidden.way = word == "show"     ? Way::show
                 : word == "dashed" ? Way::dashed
                 : word == "thin"   ? Way::thin
                 : word == "faded"  ? Way::faded
                                    : Way::drop;
  }
  return hidden;
}

namespace {

Field of_style(const char* default_style) {
  return {"style", reference({Category::style}), "of these lines", false, default_style};
}

Field own_hidden() {
  return {
      "hidden", hidden_lines(), "what becomes of these lines behind something, instead of `hidden` of all", false, {}};
}

// A style, or { style: thick, hidden: dashed }.
Field kind_of_lines(const char* name, const char* description, const char* default_style) {
  FieldType type = reference({Category::style});
  type.fields = std::make_shared<const std::vector<Field>>(std::vector<Field>{of_style(default_style), own_hidden()});
  return {name, type, description, false, default_style};
}

void read_kind(const Fields& fields, const std::string& kind, Lines& lines) {
  if (!fields.given(kind)) return;
  if (!fields.holds<Fields>(kind)) {
    lines.styles[kind] = style_of(fields, kind);
    return;
  }
  const Fields& own = fields.group(kind);
  if (own.has("style")) lines.styles[kind] = style_of(own, "style");
  if (own.has("hidden")) lines.own_hidden[kind] = hidden_of(own);
}

}  // namespace

std::vector<Field> lines_fields() {
  return {
      kind_of_lines("boundary", "borders of a surface; drawn where given, like all kinds of lines", "thick"),
      kind_of_lines("sharp", "edges where faces of a body, or smooth pieces of a surface, meet at an angle", "thick"),
      kind_of_lines("smooth", "edges of a body where faces meet smoothly", "thin"),
      kind_of_lines("silhouette", "where a surface turns away from the viewer", "thick"),
      {"parameter",
       group({{"at_u", counts(), "lines u = const: how many, or where", false, {}},
              {"at_v", counts(), "lines v = const: how many, or where", false, {}},
              of_style("hairline"),
              own_hidden()}),
       "parameter lines of surfaces, faces, tubes and balls, and of what is put together of them",
       false,
       {}},
      {"section",
       group({{"planes",
               groups({{"through", point(), "a point of the plane", false, "[0, 0, 0]"},
                       {"normal", direction(), "across the plane", true, {}}})
                   .count(1),
               "planes of the world (also for objects of groups) that cut",
               true,
               {}},
              of_style("thin"),
              own_hidden()}),
       "curves in which planes cut the object",
       false,
       {}},
      {"intersection",
       group({{"with",
               references({Category::surface, Category::body, Category::mesh, Category::shape}),
               "what is met",
               true,
               {}},
              of_style("thin"),
              own_hidden()}),
       "curves in which other things meet the object",
       false,
       {}},
      kind_of_lines("self_intersection", "where a surface goes through itself", "thin"),
      kind_of_lines("curve", "the curve itself", "thick"),
      {"hidden", hidden_lines(), "what becomes of lines behind something: show, drop, dashed, thin, faded, or a style",
       false, "drop"},
      {"hidden_layers",
       integer().at_least(1),
       "in drawings: lines behind more layers than this are dropped",
       false,
       {}}};
}

Lines lines_of(const Fields& fields) {
  Lines lines;
  for (const char* kind : {"boundary", "sharp", "smooth", "silhouette", "self_intersection", "curve"})
    read_kind(fields, kind, lines);
  for (const char* kind : {"parameter", "section", "intersection"}) read_kind(fields, kind, lines);
  if (fields.has("parameter")) {
    const Fields& given = fields.group("parameter");
    if (!given.has("at_u") && !given.has("at_v"))
      throw FieldError("lines.parameter", "parameter lines need 'at_u' or 'at_v'",
                       "how many, or where: parameter: { at_u: 9, at_v: [0, 0.5, 1] }");
    if (given.has("at_u")) lines.at_u = given.get<ParameterValues>("at_u");
    if (given.has("at_v")) lines.at_v = given.get<ParameterValues>("at_v");
  }
  if (fields.has("section")) {
    const Fields& given = fields.group("section");
    for (const Fields& plane : given.groups("planes"))
      lines.planes.push_back({plane.vec3("through"), plane.vec3("normal")});
  }
  if (fields.has("intersection")) {
    const Fields& given = fields.group("intersection");
    lines.with = given.references("with");
  }
  lines.hidden = hidden_of(fields);
  if (fields.has("hidden_layers")) {
    lines.hidden.max_layers = fields.integer("hidden_layers");
    for (auto& [kind, own] : lines.own_hidden) own.max_layers = lines.hidden.max_layers;
  }
  return lines;
}

std::vector<Field> fill_fields() {
  return {
      {"shading", choice({"none", "flat", "two_tone", "gradient"}),
       "one colour, two by the side that looks to the light, or one that fades by Lambert's law", false, "flat"},
      {"color", color().between(0, 1), "the material's by default", false, {}},
      {"shade", number().between(0, 1), "brightness of what is turned away from the light", false, "0.75"},
      {"light", direction(), "towards the light; above the viewer and to the left by default", false, {}},
      {"hatching",
       group({{"angle", angle(), "from the page's horizontal", false, "45 deg"},
              {"spacing", page_length().at_least(0.1), "between lines, on the page", false, "1.2 mm"},
              {"crossed", boolean(), "with lines across these", false, "false"},
              {"of", choice({"all", "shade"}), "the whole area, or what is turned away from the light", false, "all"},
              {"style", reference({Category::style}), "of the lines", false, "hairline"}}),
       "parallel lines over the area",
       false,
       {}}};
}

Fill fill_of(const Fields& fields) {
  Fill fill;
  const std::string& shading = fields.text("shading");
  fill.shading = shading == "none"       ? Fill::Shading::none
                 : shading == "two_tone" ? Fill::Shading::two_tone
                 : shading == "gradient" ? Fill::Shading::gradient
                                         : Fill::Shading::flat;
  if (fields.has("color")) fill.color = fields.vec3("color");
  fill.shade = fields.number("shade");
  if (fields.has("light")) fill.light = glm::normalize(fields.vec3("light"));
  if (fields.has("hatching")) {
    const Fields& given = fields.group("hatching");
    fill.hatching = Hatching{given.number("angle"), given.number("spacing"), given.boolean("crossed"),
                             given.text("of") == "shade", style_of(given, "style")};
  }
  return fill;
}

}  // namespace lekalo::render
