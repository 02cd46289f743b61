#include "geometry/curves/interpolation/hermite_edge.h"

#include <fmt/format.h>

#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

std::vector<Vec3> hermite_edge(const Vec3& p, const Vec3& m, const Vec3& q, const Vec3& n, EdgeTangents tangents) {
  const Vec3 chord = q - p;
  Vec3 v = chord - glm::dot(m, chord) * m, w = glm::dot(n, chord) * n - chord;
  if (tangents == EdgeTangents::arc) {
    // cos f = |v|/|q - p|, cos^2(f/2) = (1 + cos f)/2.
    const double length = glm::length(chord);
    for (Vec3* one : {&v, &w})
      if (const double own = glm::length(*one); own > 0) *one *= 2 * length * length / ((length + own) * own);
  }
  return {p, p + v / 3.0, q + w / 3.0, q};
}

TypeDeclaration hermite_edge_type() {
  return declare(Category::curve, "hermite_edge",
                 "Cubic between two points that is orthogonal to a normal at each end, as the sides of triangles on a "
                 "triangulation are (Golovanov 2016, 3.17.1).")
      .field("from", point(), "where it begins")
      .field("to", point(), "where it ends")
      .field("normals", points().count(2, 2), "vectors orthogonal to it at both ends, of any length")
      .field("tangents", choice({"projected", "arc"}),
             "their lengths: of the chord without its part along the normal; or such that arcs of circles are met best",
             "projected")
      .shows({"control_polygon", "de_casteljau"})
      .example("from: [1, 0], to: [0, 1], normals: [[1, 0], [0, 1]]")
      .built_by([](const Fields& f) {
        std::vector<Vec3> normals = f.points("normals");
        for (size_t k = 0; k < normals.size(); ++k) {
          if (glm::length(normals[k]) == 0)
            throw FieldError("normals", fmt::format("normal {} is zero", k), "give it a direction, of any length");
          normals[k] = glm::normalize(normals[k]);
        }
        if (f.vec3("from") == f.vec3("to")) throw FieldError("to", "it ends where it begins", "move one of its ends");
        const auto tangents = f.text("tangents") == "arc" ? EdgeTangents::arc : EdgeTangents::projected;
        return bezier_curve(hermite_edge(f.vec3("from"), normals[0], f.vec3("to"), normals[1], tangents));
      });
}

}  // namespace lekalo::geometry
