#include "render/model/model.h"

namespace lekalo::render {

using geometry::Box3;

Box3 Boxes::of(const Entity& entity) {
  return std::visit(
      [this](const auto& value) -> Box3 {
        using T = std::decay_t<decltype(value)>;
        Box3 box;
        if constexpr (std::is_same_v<T, Vec3>) {
          box.include(value);
        } else if constexpr (std::is_same_v<T, SurfaceSet>) {
          for (const geometry::SurfacePtr& surface : value) box.include(of(Entity(surface)));
        } else {
          const auto known = known_.find(value.get());
          if (known != known_.end()) return known->second;
          if constexpr (std::is_same_v<T, GroupPtr>)
            for (const Object& object : value->objects) box.include(transformed(of(object.shape), object.transform));
          else
            box = bounds(*value);
          known_[value.get()] = box;
        }
        return box;
      },
      entity);
}

Box3 Boxes::of(const std::vector<Object>& objects) {
  Box3 box;
  for (const Object& object : objects) {
    const Box3 one = transformed(of(object.shape), object.transform);
    if (one.bounded()) box.include(one);
  }
  return box;
}

Box3 bounds(const Entity& entity) { return Boxes().of(entity); }

std::vector<std::string> light_groups(const Model& model) {
  std::vector<std::string> groups;
  for (const LightPtr& light : model.lights)
    if (!light->group().empty() && std::find(groups.begin(), groups.end(), light->group()) == groups.end())
      groups.push_back(light->group());
  return groups;
}

Box3 bounds(const Model& model) { return bounds(model.objects); }
Box3 bounds(const std::vector<Object>& objects) { return Boxes().of(objects); }

}  // namespace lekalo::render
