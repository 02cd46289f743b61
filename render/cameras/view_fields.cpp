#include "render/cameras/view_fields.h"

#include <unordered_map>

#include "render/model/objects.h"
#include "render/model/section_faces.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// More copies of a thing stay in the groups that they stand in: their boxes are a little wider.
constexpr double kMaxApart = 1e5;

// Those of some objects that show a thing, also inside groups.
class Showing {
 public:
  explicit Showing(const void* shape) : shape_(shape) {}

  void add(const std::vector<Object>& objects, std::vector<Object>& found) {
    const Part part = part_of(objects);
    if (part.copies > kMaxApart)
      found.insert(found.end(), part.objects.begin(), part.objects.end());
    else
      add_apart(part.objects, Affine(), found);
  }

 private:
  // Groups in it have no other members than those wanted.
  struct Part {
    std::vector<Object> objects;
    double copies = 0;
  };
  struct PartOfGroup {
    GroupPtr group;
    double copies = 0;
  };

  bool shows(const Object& object) const { return identity(shape_as_written(object)) == shape_; }

  Part part_of(const std::vector<Object>& objects) {
    Part part;
    for (const Object& object : objects) {
      const auto* group = std::get_if<GroupPtr>(&object.shape);
      if (shows(object)) {
        part.objects.push_back(object);
        ++part.copies;
      } else if (group) {
        const PartOfGroup inner = part_of(*group);
        if (inner.copies == 0) continue;
        part.objects.push_back(object);
        part.objects.back().shape = inner.group;
        part.copies += inner.copies;
      }
    }
    return part;
  }
  PartOfGroup part_of(const GroupPtr& group) {
    const auto known = groups_.find(group.get());
    if (known != groups_.end()) return known->second;
    Part part = part_of(group->objects);
    return groups_[group.get()] = {std::make_shared<const Group>(Group{std::move(part.objects)}), part.copies};
  }

  void add_apart(const std::vector<Object>& objects, const Affine& map, std::vector<Object>& found) const {
    for (const Object& object : objects) {
      const Affine placed = map * object.transform;
      if (!shows(object)) {
        add_apart(std::get<GroupPtr>(object.shape)->objects, placed, found);
        continue;
      }
      found.push_back(object);
      found.back().transform = placed;
    }
  }

  const void* shape_;
  std::unordered_map<const Group*, PartOfGroup> groups_;
};

}  // namespace

Vec3 middle(const Box3& box) { return box.empty() || !box.bounded() ? Vec3(0) : box.center(); }

void declare_view(TypeDeclaration& type, std::string default_view) {
  FieldType view =
      group({{"azimuth", angle(), "of the viewer's place, from x towards y; front is -90", true, {}},
             {"elevation", angle().between(-kPi / 2, kPi / 2), "of the viewer's place above the xy plane", true, {}}});
  type.field("view", view.or_word(view_names()), "from where all is seen when `from` is not given",
             std::move(default_view))
      .field("frame", references({geometry_categories().begin(), geometry_categories().end()}).or_word({"all"}),
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
    for (const std::any& thing : fields.references("frame")) result.framed.push_back(entity_of(thing));
  }
  return result;
}

FramedContent ViewFields::shown(const FramedContent& all) const {
  if (frame_all) return all;
  std::vector<Object> part;
  for (const Entity& entity : framed) {
    const size_t before = part.size();
    const void* shape = identity(entity);
    if (shape && all.objects) Showing(shape).add(*all.objects, part);
    if (part.size() == before) part.emplace_back().shape = entity;
  }
  return FramedContent(part);
}

void check_placed(const Fields& fields) {
  if (fields.given("view"))
    throw FieldError("view", "'view' and 'from' both say from where the scene is seen",
                     "leave out 'from' to have everything framed, or 'view'");
  if (fields.given("margin"))
    throw FieldError("margin", "'margin' is for a camera that frames the scene; this one stands at 'from'",
                     "leave out 'margin', or 'from'");
  if (fields.given("frame") && fields.has("at"))
    throw FieldError("frame", "'frame' is for a camera that frames the scene; this one looks from 'from' at 'at'",
                     "leave out 'frame', or 'from' and 'at'");
}

}  // namespace lekalo::render
