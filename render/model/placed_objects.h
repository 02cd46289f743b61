// The objects of a model where they are placed: those of a group once for each time that the group is shown. Groups in
// groups place more of them than can be visited, so groups that hold nothing of what is wanted are passed over.
#pragma once

#include <atomic>
#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

// Of the same numbers.
inline bool same_map(const geometry::Affine& a, const geometry::Affine& b) {
  return a.linear == b.linear && a.offset == b.offset;
}

// Visits all objects, groups too, each once however often it is placed: in their order, groups before their members.
template <class Visit>
void each_object(const std::vector<Object>& objects, const Visit& visit) {
  std::unordered_set<const Group*> known;
  const auto walk = [&](const auto& self, const std::vector<Object>& list) -> void {
    for (const Object& object : list) {
      visit(object);
      const auto* group = std::get_if<GroupPtr>(&object.shape);
      if (group && known.insert(group->get()).second) self(self, (*group)->objects);
    }
  };
  walk(walk, objects);
}

// The placements of those objects, no groups, that are wanted.
class PlacedObjects {
 public:
  using CellBudget = std::function<bool(const Object&)>;
  // `placement`: which of its placements an object stands in, in their order.
  using Visit = std::function<void(const Object& object, const geometry::Affine& to_world, int placement)>;

  // The objects must stay.
  explicit PlacedObjects(
      const std::vector<Object>& objects, CellBudget wanted = [](const Object&) { return true; });

  // May be more than integers hold.
  double count() const { return count_; }
  // In their order; no more of them once `stop` is set (null: never).
  void visit(const Visit& visit, const std::atomic<bool>* stop = nullptr) const;

 private:
  double count_in(const std::vector<Object>& objects);
  double count_of(const Object& object);

  const std::vector<Object>& objects_;
  CellBudget wanted_;
  std::unordered_map<const Group*, double> in_groups_;
  double count_ = 0;
};

}  // namespace lekalo::render
