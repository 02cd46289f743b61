// A face of a body deformed (Golovanov 2016, 6.13): its surface gets r = b + h m, h a B-spline over the rectangle of
// the face's parameters, or is moved by vectors. Where the border stays, nothing else changes; else the edges are where
// the neighbours meet the new surface.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/bodies/local/face_rectangle.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/surfaces/derived/deformed.h"

namespace lekalo::geometry {

namespace {

// How far the surface is from the edges of the face.
double gap_at_border(const Body& body, int number, const Surface& surface) {
  double gap = 0;
  for (const int l : body.faces[number].loops)
    for (const int c : body.loops[l].coedges) {
      const Coedge& use = body.coedges[c];
      const Curve& curve = *body.edges[use.edge].curve;
      for (int k = 0; k <= 24; ++k) {
        const double t = curve.domain().lo + curve.domain().width() * k / 24;
        const Vec3 uv = use.image->point(t);
        gap = std::max(gap, glm::length(surface.point(uv.x, uv.y) - curve.point(t)));
      }
    }
  return gap;
}

Body deformed(const Fields& f) {
  const Body& body = *f.body("of");
  const int number = one_called(body, Element::face, f.text("face"), "face");
  const SurfacePtr surface = deformed_by(over_its_rectangle(body, number), f, true);
  if (gap_at_border(body, number, *surface) <= 1e-12 * bounds(body).diameter()) {
    FaceReplacement made;
    made.body = body;
    made.body.faces[number].surface = surface;
    made.body.faces[number].forward = true;
    made.changed.assign(body.faces.size(), 0);
    made.changed[number] = 1;
    check_replacement(made, "face", "moves by less");
    return std::move(made.body);
  }
  std::vector<SurfacePtr> surfaces = surfaces_of(body);
  const auto turned = std::const_pointer_cast<Surface>(surface);
  turned->set_reversed(body.faces[number].surface->reversed());
  surfaces[number] = turned;
  FaceReplacement made = replace_faces(body, surfaces, "face");
  check_replacement(made, "face", "a deformation that leaves the border, or moves it by less");
  return std::move(made.body);
}

}  // namespace

TypeDeclaration deformed_face_type() {
  TypeDeclaration type =
      declare(Category::body, "deformed_face",
              "A body one of whose faces has dents and bulges: it is moved along its outward normals by heights, or by "
              "vectors, that a B-spline over the rectangle of its parameters blends. With zeros along the border the "
              "edges stay; with two rows of them the face stays tangent there; else the neighbours follow.")
          .example("of: { type: box, size: [4, 4, 1] }, face: z_max, count: 6, moves: { at: [2, 3], height: 1.5 }")
          .field("of", reference({Category::body}), "the body")
          .field("face", text(), "name or number of the face, as 'lekalo measure --topology' gives them");
  declare_deformation(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(deformed(f)); });
  return type;
}

}  // namespace lekalo::geometry
