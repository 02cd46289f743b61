#include "render/scene/styles.h"

#include <algorithm>
#include <array>

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr std::array<std::string_view, 9> kNames{"thick",        "thin",      "hairline", "hidden", "axis",
                                                 "construction", "dimension", "label",    "ray"};

// Dashes of ISO 128-2: 12 widths drawn, 3 left out; chains 24, 3, 0.5, 3. Shortened by half for small figures.
constexpr std::string_view kBuiltIn = R"(
thick:        { width: 0.5 mm }
thin:         { width: 0.25 mm }
hairline:     { width: 0.13 mm }
hidden:       { width: 0.25 mm, dash: [1.5 mm, 0.75 mm] }
axis:         { width: 0.18 mm, dash: [3 mm, 0.6 mm, 0.2 mm, 0.6 mm] }
construction: { width: 0.18 mm, color: '#555555' }
dimension:    { width: 0.18 mm, arrows: both, text_size: 8 pt }
label:        { width: 0.18 mm, text_size: 10 pt }
ray:          { width: 0.25 mm, color: crimson, arrows: end }
)";

}  // namespace

std::string_view built_in_styles() { return kBuiltIn; }

bool is_built_in_style(std::string_view name) { return std::find(kNames.begin(), kNames.end(), name) != kNames.end(); }

Style complete(const StyleChanges& changes) {
  const Fields& f = changes.fields;
  Style style;
  style.name = changes.name;
  const auto number = [&](const char* field, double& value) {
    if (f.has(field)) value = f.number(field);
  };
  const auto word = [&](const char* field, std::string& value) {
    if (f.has(field)) value = f.text(field);
  };
  number("width", style.width);
  number("opacity", style.opacity);
  number("marker_size", style.marker_size);
  number("text_size", style.text_size);
  number("arrow_size", style.arrow_size);
  word("cap", style.cap);
  word("join", style.join);
  word("marker", style.marker);
  word("font", style.font);
  word("arrows", style.arrows);
  if (f.has("color")) {
    style.cycles = f.holds<std::string>("color");
    if (!style.cycles) style.color = f.vec3("color");
  }
  if (f.holds<std::vector<double>>("dash")) style.dash = f.numbers("dash");
  if (f.holds<Vec3>("fill")) style.fill = f.vec3("fill");
  return style;
}

Style style_of(const Fields& fields, std::string_view field) { return complete(fields.get<StyleChanges>(field)); }

TypeDeclaration style_type() {
  TypeDeclaration type =
      declare(Category::style, "style", "How lines, markers and texts of drawings look. All lengths are on the page.")
          .example("width: 0.5 mm, color: crimson");
  return type.optional("width", page_length().non_negative().at_most(50), "of lines")
      .optional("color", color().non_negative().or_word({"cycle"}),
                "of lines, markers and text; cycle: another palette colour for each member of a family")
      .optional("opacity", number().between(0, 1), "1: opaque")
      .optional("dash", page_lengths().non_negative().count(2).or_word({"solid"}),
                "lengths drawn and left out in turn: [1.5 mm, 0.75 mm]")
      .optional("cap", choice({"butt", "round", "square"}), "ends of lines and dashes")
      .optional("join", choice({"round", "miter", "bevel"}), "corners of lines")
      .optional("marker", choice({"none", "dot", "circle", "ball", "cross", "plus", "square", "triangle", "diamond"}),
                "sign at points")
      .optional("marker_size", page_length().positive().at_most(50), "diameter of markers")
      .optional("fill", color().non_negative().or_word({"none"}), "inside of markers, and behind texts")
      .optional("font", choice({"serif", "sans", "mono"}), "of texts outside formulas")
      .optional("text_size", page_length().positive().at_most(200), "of texts")
      .optional("arrows", choice({"none", "start", "end", "both"}), "heads of lines")
      .optional("arrow_size", page_length().positive().at_most(50), "length of an arrow head")
      .built_by([](const Fields& f) {
        if (f.holds<std::vector<double>>("dash")) {
          double sum = 0;
          for (const double length : f.numbers("dash")) sum += length;
          if (!(sum > 0)) throw FieldError("dash", "dashes without any length", "write solid for a line without gaps");
          if (f.numbers("dash").size() % 2 != 0)
            throw FieldError("dash", "lengths drawn and left out come in pairs", "for example [1.5 mm, 0.75 mm]");
        }
        return StyleChanges{{}, f};
      });
}

}  // namespace lekalo::render
