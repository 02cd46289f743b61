#include "render/cameras/view_fields.h"

#include "render/scene/model.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// A built thing, as references carry it.
Entity entity_of(const std::any& thing) {
  if (const auto* point = std::any_cast<Vec3>(&thing)) return *point;
  if (const auto* curve = std::any_cast<CurvePtr>(&thing)) return *curve;
  if (const auto* surface = std::any_cast<SurfacePtr>(&thing)) return *surface;
  if (const auto* set = std::any_cast<SurfaceSet>(&thing)) return *set;
  if (const auto* body = std::any_cast<BodyPtr>(&thing)) return *body;
  if (const auto* mesh = std::any_cast<MeshPtr>(&thing)) return *mesh;
  if (const auto* group = std::any_cast<GroupPtr>(&thing)) return *group;
  throw FieldError("frame", "this cannot be framed", "name points, curves, surfaces, bodies or meshes");
}

}  // namespace

Vec3 middle(const Box3& box) { return box.empty() || !box.bounded() ? Vec3(0) : box.center(); }

void declare_view(TypeDeclaration& type, std::string default_view) {
  FieldType view =
      group({{"azimuth", angle(), "of the viewer's place, from x towards y; front is -90", true, {}},
             {"elevation", angle().between(-kPi / 2, kPi / 2), "of the viewer's place above the xy plane", true, {}}});
  type.field("view", view.or_word(view_names()), "from where all is seen when `from` is not given",
             std::move(default_view))
      .field("frame",
             references({Category::point, Category::curve, Category::surface, Category::body, Category::mesh})
                 .or_word({"all"}),
             "what must be in the picture", "all")
      .field("margin", number().between(0, 0.45), "left free on each side, as a share of the picture's shorter side",
             "0.06");
}

ViewFields view_fields(const Fields& fields) {
  ViewFields result;
  const std::string word = fields.word("view");
  if (!word.empty()) {
    result.view = preset_view(word);
  } else {
    const Fields& angles = fields.group("view");
    result.view = view_from_angles(angles.number("azimuth"), angles.number("elevation"));
  }
  result.margin = fields.number("margin");
  result.frame_all = fields.word("frame") == "all";
  if (!result.frame_all) {
    Model named;
    for (const std::any& thing : fields.references("frame")) named.objects.emplace_back().shape = entity_of(thing);
    result.framed = shown(named);
  }
  return result;
}

}  // namespace lekalo::render
