// The faces of a body apart from each other (Golovanov 2016, 5.1): each moved along its mean normal, or away from the
// middle of the body, with its own copies of its edges.
#include <vector>

#include "geometry/bodies/topology/copied_face.h"
#include "geometry/describe.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

namespace {

// The mean of the outward normals over a grid of the face's parameters, by area. It vanishes where they cancel.
Vec3 mean_normal(const Body& body, int f) {
  const Face& face = body.faces[f];
  Box3 box;
  for (const int loop : face.loops)
    for (const int c : body.loops[loop].coedges) box.include(bounds(*body.coedges[c].image));
  constexpr int kSamples = 24;
  Vec3 sum(0);
  double whole = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const Vec3 at = box.lo + (box.hi - box.lo) * Vec3((i + 0.5) / kSamples, (j + 0.5) / kSamples, 0);
      const SurfaceJet s = face.surface->evaluate(at.x, at.y, 1);
      const double area = glm::length(glm::cross(s.du(), s.dv()));
      sum += area * body.normal(f, at.x, at.y);
      whole += area;
    }
  return whole > 0 ? sum / whole : Vec3(0);
}

Body exploded(const Fields& f) {
  const Body& body = *f.body("of");
  if (f.has("distance") == f.has("factor"))
    throw FieldError("distance", "faces are moved by a distance along their normals, or by a factor from the middle",
                     "give one of 'distance' and 'factor'");
  const Vec3 middle = bounds(body).center();
  Body result;
  for (size_t k = 0; k < body.faces.size(); ++k) {
    const int face = static_cast<int>(k);
    Vec3 by;
    if (f.has("distance")) {
      const Vec3 n = mean_normal(body, face);
      // Normals all round: a direction that is rounding alone moves nothing.
      by = glm::length(n) > 1e-6 ? f.number("distance") * glm::normalize(n) : Vec3(0);
    } else {
      by = f.number("factor") * (measure_face(body, face).centroid - middle);
    }
    copy_face(body, face, Affine::translation(by), result);
  }
  return result;
}

}  // namespace

TypeDeclaration exploded_body_type() {
  return declare(Category::body, "exploded_body",
                 "The faces of a body moved apart, with their names: an exploded view. It encloses nothing.")
      .example("of: { type: box, size: [3, 2, 1] }, distance: 0.5")
      .field("of", reference({Category::body}), "the body")
      .optional("distance", length(), "how far each face goes along the mean of its outward normals")
      .optional("factor", number().positive(), "in place of distance: of the way from the middle of the body")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(exploded(f)); });
}

}  // namespace lekalo::geometry
