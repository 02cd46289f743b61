// Body at a distance from another (Golovanov 2016, 6.7): each face on the offset of its surface,
//
//   r(u, v) = b(u, v) + h m(u, v),   m the outward normal,
//
// joined by extension. Mitred, so that no face is rounded.
#include "geometry/bodies/local/offset_of_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/local/cleared_offset.h"
#include "geometry/bodies/local/plane_polygons.h"
#include "geometry/bodies/local/plane_seams.h"
#include "geometry/bodies/local/round_offset.h"
#include "geometry/bodies/local/untangled.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

// What comes nearer to a face than its distance is a part of the body turned inside out twice.
void check_distances(const Body& body, const std::vector<double>& distances, const Body& made, const char* field,
                     const char* hint) {
  const double small = 1e-9 * bounds(body).diameter();
  for (const PlanePolygon& polygon : polygons_of(without_plane_seams(body)))
    for (const Vertex& v : made.vertices)
      if (distance_from(polygon, v.point) < std::abs(distances[polygon.face]) - small)
        throw FieldError(field,
                         fmt::format("something is left that is nearer to the face {} than the distance",
                                     name_of_face(body, polygon.face)),
                         hint);
}

void untangle(const Body& body, const std::vector<double>& distances, FaceReplacement& made, const char* field,
              const char* hint) {
  Untangled result;
  try {
    result = untangled(made.body);
  } catch (const FieldError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FieldError(field, fmt::format("the faces run into each other: {}", error.what()), hint);
  }
  if (!result.changed) return;
  if (result.body.faces.empty()) throw FieldError(field, "nothing is left of the body", hint);
  check_distances(body, distances, result.body, field, hint);
  std::vector<int> faces;
  for (const int k : result.faces) faces.push_back(made.faces[k]);
  made.body = std::move(result.body);
  made.faces = std::move(faces);
  made.turned_edges.clear();
  made.changed.clear();
}

}  // namespace

namespace {

FaceReplacement plain_offset(const Body& body, const std::vector<double>& distances, double share, const char* field,
                             const char* hint) {
  std::vector<double> shares;
  for (const double distance : distances) shares.push_back(share * distance);
  FaceReplacement made = replace_faces(body, offset_surfaces(body, shares, field), field);
  if (made.polyhedral) untangle(body, shares, made, field, hint);
  check_replacement(made, field, hint);
  return made;
}

// The largest share of the distances with which a body is made, found by halving; 0 where none is known.
double largest_share(const Body& body, const std::vector<double>& distances, const char* field) {
  double works = 0, fails = 1;
  for (int step = 0; step < 12; ++step) {
    const double share = 0.5 * (works + fails);
    try {
      plain_offset(body, distances, share, field, "");
      works = share;
    } catch (const std::invalid_argument&) {
      fails = share;
    }
  }
  return works;
}

}  // namespace

FaceReplacement offset_of_body(const Body& body, const std::vector<double>& distances, const char* field,
                               const char* hint) {
  try {
    return plain_offset(body, distances, 1, field, hint);
  } catch (const FieldError& error) {
    if (!body.is_closed()) throw;
    double distance = 0;
    for (const double d : distances) distance = std::max(distance, std::abs(d));
    const double share = largest_share(body, distances, field);
    if (!(share > 0)) throw;
    // Rounded down: the limit itself is what fails.
    const double works = share * distance, digit = std::pow(10, std::floor(std::log10(works)) - 2);
    throw FieldError(field, error.what(),
                     fmt::format("{}: up to {:.3g} works", hint, std::floor(works / digit) * digit));
  }
}

namespace {

Body offset_body(const Fields& f) {
  const Body& body = *f.body("of");
  const std::vector<double> distances(body.faces.size(), f.number("distance"));
  if (f.text("joints") == "round") {
    if (!(f.number("distance") > 0))
      throw FieldError("joints", "inside of a body joints are not round", "a positive distance, or joints: extended");
    FaceReplacement made;
    made.body = round_offset(body, f.number("distance"), "joints");
    check_replacement(made, "joints", "joints: extended");
    return std::move(made.body);
  }
  const double distance = f.number("distance");
  if (!has_vanishing_face(body, distance)) {
    try {
      return plain_offset(body, distances, 1, "distance", "").body;
    } catch (const FieldError&) {
      // Perhaps it can be put together.
    }
  }
  if (auto made = cleared_offset(body, distance)) return *std::move(made);
  return offset_of_body(body, distances, "distance", "a smaller distance").body;
}

}  // namespace

TypeDeclaration offset_body_type() {
  return declare(Category::body, "offset_body",
                 "Body whose faces lie at a distance from those of another, continued until they meet. Faces and edges "
                 "keep their names; a vertex where more than three faces meet becomes several, with edges joint.k. "
                 "Faces that are rounder than the distance vanish.")
      .example("of: { type: pyramid, points: [[-2, -1], [2, -1], [2, 1], [-2, 1]], height: 3 }, distance: 0.3")
      .field("of", reference({Category::body}), "the body; closed")
      .field("distance", length(), "along the outward normals; negative: to the inside")
      .field("joints", choice({"extended", "round"}),
             "what joins the faces: they are continued until they meet, or, outside of a convex body, what is at the "
             "distance from its edges and vertices",
             "extended")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(offset_body(f)); });
}

}  // namespace lekalo::geometry
