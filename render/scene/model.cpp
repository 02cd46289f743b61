#include "render/scene/model.h"

#include <unordered_map>

namespace lekalo::render {

namespace {

// Boxes of entities; that of a group, which may be shown in many groups, is found once.
class Boxes {
 public:
  geometry::Box3 of(const Entity& entity) {
    return std::visit(
        [this](const auto& value) -> geometry::Box3 {
          using T = std::decay_t<decltype(value)>;
          geometry::Box3 box;
          if constexpr (std::is_same_v<T, Vec3>) {
            box.include(value);
          } else if constexpr (std::is_same_v<T, SurfaceSet>) {
            for (const geometry::SurfacePtr& surface : value) box.include(bounds(*surface));
          } else if constexpr (std::is_same_v<T, GroupPtr>) {
            const auto known = groups_.find(value.get());
            if (known != groups_.end()) return known->second;
            for (const Object& object : value->objects) box.include(transformed(of(object.shape), object.transform));
            groups_[value.get()] = box;
          } else {
            box = bounds(*value);
          }
          return box;
        },
        entity);
  }
  geometry::Box3 of(const std::vector<Object>& objects) {
    geometry::Box3 box;
    for (const Object& object : objects) {
      const geometry::Box3 one = transformed(of(object.shape), object.transform);
      if (one.bounded()) box.include(one);
    }
    return box;
  }

 private:
  std::unordered_map<const Group*, geometry::Box3> groups_;
};

}  // namespace

geometry::Box3 bounds(const Entity& entity) { return Boxes().of(entity); }
geometry::Box3 bounds(const Model& model) { return bounds(model.objects); }
geometry::Box3 bounds(const std::vector<Object>& objects) { return Boxes().of(objects); }

}  // namespace lekalo::render
