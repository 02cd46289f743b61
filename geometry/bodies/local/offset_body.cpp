// Body at a distance from another (Golovanov 2016, 6.7): each face on the offset of its surface,
//
//   r(u, v) = b(u, v) + h m(u, v),   m the outward normal,
//
// joined by extension. Mitred, so that no face is rounded.
#include <fmt/format.h>

#include "geometry/bodies/local/face_replacement.h"

namespace lekalo::geometry {

namespace {

FaceReplacement offset(const Body& body, double h) {
  std::vector<SurfacePtr> surfaces;
  for (const Face& face : body.faces) {
    const double side = face.forward == (face.surface->normal_sign() > 0) ? 1 : -1;
    surfaces.push_back(offset_support(face.surface, side * h, "distance"));
  }
  return replace_faces(body, surfaces, "distance");
}

Body offset_body(const Fields& f) {
  const Body& body = *f.body("of");
  FaceReplacement made = offset(body, f.number("distance"));
  check_replacement(made, "distance", "a smaller distance");
  return std::move(made.body);
}

}  // namespace

TypeDeclaration offset_body_type() {
  return declare(Category::body, "offset_body",
                 "Body whose faces lie at a distance from those of another, continued until they meet. Faces and edges "
                 "keep their names; a vertex where more than three faces meet becomes several, with edges joint.k.")
      .example("of: { type: pyramid, points: [[-2, -1], [2, -1], [2, 1], [-2, 1]], height: 3 }, distance: 0.3")
      .field("of", reference({Category::body}), "the body; closed")
      .field("distance", length(), "along the outward normals; negative: to the inside")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(offset_body(f)); });
}

}  // namespace lekalo::geometry
