#include "render/scene/types/panels.h"

namespace lekalo::render {

using namespace geometry;

TypeDeclaration panel_type() {
  TypeDeclaration type =
      declare(Category::panel, "panel", "One of several views on a page.").example("camera: { view: top }");
  return type.optional("camera", reference({Category::camera}), "its view; the scene's camera by default")
      .optional("drawing", group(drawing_fields()), "what differs from the scene's `drawing`")
      .optional("objects", references({Category::object}).count(0), "what it shows instead of the scene's objects")
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
        return panel;
      });
}

std::vector<Field> layout_fields() {
  return {{"rows", name_rows(), "names of panels, row by row from the top; `empty` leaves a place free", true, {}},
          {"scale", number().positive().or_word({"fit"}),
           "of every panel: 1/2 draws a length of 10 mm with 5 mm; fit: as large as there is room", false, "fit"},
          {"gap", page_length().non_negative(), "between panels", false, "5 mm"}};
}

Layout layout_of(const Fields& fields) {
  Layout layout;
  layout.rows = fields.get<std::vector<std::vector<std::string>>>("rows");
  for (std::vector<std::string>& row : layout.rows)
    for (std::string& name : row)
      if (name == "empty") name.clear();
  if (fields.word("scale").empty()) layout.scale = fields.number("scale");
  layout.gap = fields.number("gap");
  return layout;
}

}  // namespace lekalo::render
