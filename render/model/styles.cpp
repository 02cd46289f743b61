#include "render/model/styles.h"

namespace lekalo::render {

using namespace geometry;

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
      declare(Category::style, "style", "How lines, markers and texts look. All lengths are on the page.")
          .example("width: 0.5 mm, color: crimson");
  return type.optional("width", page_length().positive().at_most(50), "of lines")
      .optional("color", color().non_negative().or_word({"cycle"}),
                "of lines, markers and text; cycle: another palette colour for each member of a family")
      .optional("opacity", number().between(0, 1), "1: opaque")
      .optional("dash", page_lengths().non_negative().count(2).or_word({"solid"}),
                "lengths drawn and left out in turn: [1.5 mm, 0.75 mm]")
      .optional("cap", choice({"butt", "round", "square"}), "ends of lines and dashes")
      .optional("join", choice({"round", "miter", "bevel"}), "corners of lines")
      .optional("marker", choice({"none", "dot", "circle", "ball", "cross", "plus", "square", "triangle", "diamond"}),
                "sign at points; a dot if no style says another")
      .optional("marker_size", page_length().positive().at_most(50), "diameter of markers")
      .optional("fill", color().non_negative().or_word({"none"}), "inside of markers, and behind texts")
      .optional("font", choice({"serif", "sans", "mono"}), "of texts outside formulas")
      .optional("text_size", page_length().positive().at_most(200), "of texts")
      .optional("arrows", choice({"none", "start", "end", "both"}),
                "heads of lines; arrows and dimensions have theirs if no style says another")
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
