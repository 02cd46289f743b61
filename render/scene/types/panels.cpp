#include "render/scene/types/panels.h"

#include <algorithm>
#include <memory>
#include <string>

namespace lekalo::render {

using namespace geometry;

namespace {

std::shared_ptr<const Section> section_in(const Fields& f) {
  try {
    return std::make_shared<const Section>(section_of(f.group("section")));
  } catch (const FieldError& error) {
    throw FieldError(error.field.empty() ? "section" : "section." + error.field, error.what(), error.hint);
  }
}

}  // namespace

TypeDeclaration panel_type() {
  TypeDeclaration type =
      declare(Category::panel, "panel", "One of several views on a page.").example("camera: { view: top }");
  return type.optional("camera", reference({Category::camera}), "its view; the scene's camera by default")
      .optional("drawing", group(drawing_fields()), "what differs from the scene's `drawing`")
      .optional("objects", references({Category::object}).count(0), "what it shows instead of the scene's objects")
      .optional("section", group(section_fields(true)), "what is taken away of its solids to show their inside")
      .optional("detail", group(detail_fields()), "a circle that it shows of its view, enlarged")
      .optional("title", label(), "above it; of a section with a title A it is A–A by default, of a detail B (5:1)")
      .built_by([](const Fields& f) -> std::any {
        PanelAsRead panel;
        if (f.has("camera")) panel.camera = f.get<CameraFactory>("camera");
        if (f.has("drawing")) panel.drawing = f.group("drawing");
        if (f.has("objects")) {
          panel.objects.emplace();
          for (const std::any& one : f.references("objects")) {
            const auto& some = std::any_cast<const Objects&>(one);
            panel.objects->insert(panel.objects->end(), some.begin(), some.end());
          }
        }
        if (f.has("section")) panel.section = section_in(f);
        if (f.has("detail")) panel.detail = std::make_shared<const Detail>(detail_of(f.group("detail")));
        if (f.has("title"))
          panel.title = f.get<TextTemplate>("title").text();
        else if (panel.detail)
          panel.title = view_title(*panel.detail);
        else if (panel.section && !panel.section->title.empty())
          panel.title = panel.section->title + "–" + panel.section->title;
        return panel;
      });
}

std::vector<Field> layout_fields() {
  return {{"rows", name_rows(), "names of panels, row by row from the top; `empty` leaves a place free", true, {}},
          {"scale", number().positive().or_word({"fit"}),
           "of every panel: 1/2 draws a length of 10 mm with 5 mm; fit: as large as there is room", false, "fit"},
          {"gap", page_length().non_negative(), "between panels", false, "5 mm"},
          {"columns",
           numbers().positive().count(1),
           "widths of the columns in proportion, without a scale; equal by default",
           false,
           {}}};
}

Layout layout_of(const Fields& fields) {
  Layout layout;
  layout.rows = fields.get<std::vector<std::vector<std::string>>>("rows");
  for (std::vector<std::string>& row : layout.rows)
    for (std::string& name : row)
      if (name == "empty") name.clear();
  if (fields.word("scale").empty()) layout.scale = fields.number("scale");
  layout.gap = fields.number("gap");
  if (fields.has("columns")) layout.columns = fields.numbers("columns");
  size_t most = 0;
  for (const auto& row : layout.rows) most = std::max(most, row.size());
  if (!layout.columns.empty() && layout.columns.size() != most)
    throw FieldError("columns", "the rows have " + std::to_string(most) + " columns, this gives the widths of " +
                                    std::to_string(layout.columns.size()));
  if (!layout.columns.empty() && layout.scale > 0)
    throw FieldError("columns", "with a scale the columns are as wide as what stands in them", "leave one of them out");
  return layout;
}

}  // namespace lekalo::render
