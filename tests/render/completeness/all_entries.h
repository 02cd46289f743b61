// All surfaces of the completeness suite, and the model that shows one of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "render/completeness/patch_entries.h"
#include "render/completeness/shape_entries.h"
#include "render/completeness/type_entries.h"

namespace lekalo::render::completeness {

inline std::vector<Entry> all_entries() {
  std::vector<Entry> entries = bezier_entries();
  for (const auto& more : {surface_entries(), formula_entries(), composed_entries(), type_entries(), implicit_entries(),
                           sweep_entries(), solid_entries()})
    entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

// A name that GoogleTest accepts.
inline std::string word(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// A test of each, by its number.
class OfAllEntries : public testing::TestWithParam<size_t> {
 public:
  static std::string name_of(const testing::TestParamInfo<size_t>& info) { return word(entries()[info.param].name); }

 protected:
  static const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = all_entries();
    return all;
  }
};

inline std::shared_ptr<const Model> model_of(const Subject& subject) {
  auto model = std::make_shared<Model>();
  Object object;
  object.shape = subject.entity;
  object.transform = subject.transform;
  model->objects.push_back(std::move(object));
  return model;
}

}  // namespace lekalo::render::completeness
