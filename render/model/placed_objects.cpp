#include "render/model/placed_objects.h"

namespace lekalo::render {

PlacedObjects::PlacedObjects(const std::vector<Object>& objects, CellBudget wanted)
    : objects_(objects), wanted_(std::move(wanted)), count_(count_in(objects)) {}

double PlacedObjects::count_in(const std::vector<Object>& objects) {
  double sum = 0;
  for (const Object& object : objects) sum += count_of(object);
  return sum;
}

double PlacedObjects::count_of(const Object& object) {
  const auto* group = std::get_if<GroupPtr>(&object.shape);
  if (!group) return wanted_(object) ? 1 : 0;
  const auto known = in_groups_.find(group->get());
  if (known != in_groups_.end()) return known->second;
  const double count = count_in((*group)->objects);
  return in_groups_[group->get()] = count;
}

void PlacedObjects::visit(const Visit& visit, const std::atomic<bool>* stop) const {
  std::unordered_map<const Object*, int> placements;
  const auto walk = [&](const auto& self, const std::vector<Object>& objects,
                        const geometry::Affine& to_world) -> void {
    for (const Object& object : objects) {
      if (stop && stop->load(std::memory_order_relaxed)) return;
      const auto* group = std::get_if<GroupPtr>(&object.shape);
      if (group ? in_groups_.at(group->get()) == 0 : !wanted_(object)) continue;
      const geometry::Affine map = to_world * object.transform;
      if (group)
        self(self, (*group)->objects, map);
      else
        visit(object, map, placements[&object]++);
    }
  };
  walk(walk, objects_, geometry::Affine());
}

}  // namespace lekalo::render
