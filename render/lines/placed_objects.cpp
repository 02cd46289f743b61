#include "render/lines/placed_objects.h"

#include <map>

namespace lekalo::render {

namespace {

void visit_all(const std::vector<Object>& objects, const geometry::Affine& to_world,
               std::map<const Object*, int>& placements, const VisitPlaced& visit) {
  for (const Object& object : objects) {
    const geometry::Affine map = to_world * object.transform;
    if (const auto* group = std::get_if<GroupPtr>(&object.shape))
      visit_all((*group)->objects, map, placements, visit);
    else
      visit(object, map, placements[&object]++);
  }
}

}  // namespace

void each_placed(const std::vector<Object>& objects, const VisitPlaced& visit) {
  std::map<const Object*, int> placements;
  visit_all(objects, geometry::Affine(), placements, visit);
}

}  // namespace lekalo::render
