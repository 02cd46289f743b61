#include "render/scene/model.h"

namespace lekalo::render {

geometry::Box3 bounds(const Entity& entity) {
  return std::visit(
      [](const auto& value) -> geometry::Box3 {
        using T = std::decay_t<decltype(value)>;
        geometry::Box3 box;
        if constexpr (std::is_same_v<T, Vec3>) {
          box.include(value);
        } else if constexpr (std::is_same_v<T, SurfaceSet>) {
          for (const geometry::SurfacePtr& surface : value) box.include(bounds(*surface));
        } else if constexpr (std::is_same_v<T, GroupPtr>) {
          for (const Object& object : value->objects) box.include(transformed(bounds(object.shape), object.transform));
        } else {
          box = bounds(*value);
        }
        return box;
      },
      entity);
}

geometry::Box3 bounds(const Model& model) { return bounds(model.objects); }

geometry::Box3 bounds(const std::vector<Object>& objects) {
  geometry::Box3 box;
  for (const Object& object : objects) {
    const geometry::Box3 one = transformed(bounds(object.shape), object.transform);
    if (one.bounded()) box.include(one);
  }
  return box;
}

}  // namespace lekalo::render
