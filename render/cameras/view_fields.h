// Fields that both camera types share: the direction of view and what to frame.
#pragma once

#include <vector>

#include "geometry/describe.h"
#include "render/cameras/cameras.h"

namespace lekalo::render {

struct ViewFields {
  ViewDirection view;
  double margin = 0;
  bool frame_all = true;
  Shown framed;  // the named things when not frame_all

  const Shown& shown(const Shown& all) const { return frame_all ? all : framed; }
};

// Adds the fields view, frame, margin.
void declare_view(geometry::TypeDeclaration& type, std::string default_view);
ViewFields view_fields(const geometry::Fields& fields);

// The centre; of an empty or unbounded box the origin.
Vec3 middle(const geometry::Box3& box);

}  // namespace lekalo::render
