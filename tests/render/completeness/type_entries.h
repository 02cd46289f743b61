// The example of every type of surface, beside an oracle for its patches.
#pragma once

#include <memory>

#include "render/completeness/shape_entries.h"

namespace lekalo::render::completeness {

struct SurfaceAndTruth {
  SurfacePtr surface;
  Truth truth;
};

inline Entry type_entry(const std::string& name, const std::function<SurfacePtr()>& make) {
  // Made once, when it is asked for.
  const auto made = std::make_shared<SurfaceAndTruth>();
  return {name, [=](const Vec3& offset) {
            if (!made->surface) {
              made->surface = make();
              made->truth = truth_of(tests::patches_of(made->surface), bounds(*made->surface).diameter());
            }
            return moved_subject(made->surface, offset, made->truth);
          }};
}

inline std::vector<Entry> type_entries() {
  std::vector<Entry> entries;
  for (const std::string& name : every_surface::surface_type_names())
    entries.push_back(type_entry("type_" + name, [=] { return every_surface::short_example(name); }));
  return entries;
}

}  // namespace lekalo::render::completeness
