// Fields that both camera types share: the direction of view and what to frame.
#pragma once

#include <vector>

#include "geometry/describe.h"
#include "render/cameras/cameras.h"
#include "render/model/model.h"

namespace lekalo::render {

struct ViewFields {
  ViewDirection view;
  double margin = 0;
  bool frame_all = true;
  std::vector<Entity> framed;  // the named things when not frame_all

  // The part of all that is shown which must be in the picture: named things where objects show them, or where they
  // are themselves if no object does.
  FramedContent shown(const FramedContent& all) const;
};

// Adds the fields view, frame, margin.
void declare_view(geometry::TypeDeclaration& type, std::string default_view);
ViewFields view_fields(const geometry::Fields& fields);
// Of a camera placed by `from`: throws FieldError for fields that would place it otherwise.
void check_placed(const geometry::Fields& fields);

// The centre; of an empty or unbounded box the origin.
Vec3 middle(const geometry::Box3& box);

}  // namespace lekalo::render
