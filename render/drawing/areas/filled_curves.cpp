#include "render/drawing/areas/filled_curves.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <unordered_map>

#include "geometry/bodies/constructions/lamina.h"
#include "render/model/look.h"

namespace lekalo::render {

using geometry::BodyPtr;
using geometry::CurvePtr;

namespace {

class FilledCurves {
 public:
  explicit FilledCurves(std::vector<std::string>& left_out) : left_out_(left_out) {}

  std::vector<Object> of(const std::vector<Object>& objects) {
    std::vector<Object> all;
    for (const Object& object : objects) {
      all.push_back(object);
      if (auto* group = std::get_if<GroupPtr>(&all.back().shape)) *group = of(*group);
      const auto* curve = std::get_if<CurvePtr>(&object.shape);
      if (curve && object.look && object.look->fill) add_region(object, *curve, all);
    }
    return all;
  }

 private:
  // Copies of a group stay copies of one.
  GroupPtr of(const GroupPtr& group) {
    const auto known = groups_.find(group.get());
    if (known != groups_.end()) return known->second;
    return groups_[group.get()] = std::make_shared<const Group>(Group{of(group->objects)});
  }

  void add_region(const Object& object, const CurvePtr& curve, std::vector<Object>& all) {
    try {
      Object region = object;
      region.shape =
          BodyPtr(std::make_shared<const geometry::Body>(geometry::lamina(geometry::profile_of({curve}, ""))));
      region.as_written.reset();
      region.representation = Representation::direct;
      region.legend.clear();
      Look look;
      look.lines.emplace();  // none
      look.fill = object.look->fill;
      region.look = std::make_shared<const Look>(std::move(look));
      all.push_back(std::move(region));
    } catch (const std::invalid_argument& error) {
      left_out_.push_back(fmt::format("the fill of '{}': {}", object.name, error.what()));
    }
  }

  std::vector<std::string>& left_out_;
  std::unordered_map<const Group*, GroupPtr> groups_;
};

}  // namespace

std::vector<Object> with_filled_curves(const std::vector<Object>& objects, std::vector<std::string>& left_out) {
  return FilledCurves(left_out).of(objects);
}

}  // namespace lekalo::render
