// Faces taken away (Golovanov 2016, 6.12): the faces around them are continued until they close the wound, and holes in
// them are filled; or the faces taken are closed by the same continued surfaces to a body of their own.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/local/fillet_chains.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

namespace {

const char* const kHint = "another group of faces: those around it are continued until they meet";

// Wounds close where edges were longer or shorter, or ran the other way.
void check_shells(const FaceReplacement& made) {
  if (made.body.faces.empty()) throw FieldError("faces", "nothing is left of the body", "leave some of its faces");
  FaceReplacement whole = made;
  whole.turned_edges.clear();
  check_replacement(whole, "faces", kHint);
}

// Fillets with all that follows them; the faces that are none.
std::vector<FilletChain> chains_among(const Body& body, std::vector<int>& faces) {
  std::vector<FilletChain> chosen;
  for (FilletChain& chain : fillet_chains(body)) {
    const size_t before = faces.size();
    std::erase_if(faces, [&](int k) {
      return std::find(chain.faces.begin(), chain.faces.end(), k) != chain.faces.end() ||
             std::find(chain.corners.begin(), chain.corners.end(), k) != chain.corners.end();
    });
    if (faces.size() < before) chosen.push_back(std::move(chain));
  }
  return chosen;
}

Body without_chains(const Body& body, std::vector<int> faces) {
  const std::vector<FilletChain> chains = chains_among(body, faces);
  if (!faces.empty())
    throw FieldError("faces", fmt::format("the face {} is no fillet", name_of_face(body, faces.front())),
                     "leave out 'chain', or the face");
  return without_fillets(body, chains, "faces").body;
}

Body deleted(const Fields& f) {
  const Body& body = *f.body("of");
  if (f.boolean("chain")) return without_chains(body, faces_named(body, f, "faces"));
  std::vector<SurfacePtr> surfaces = surfaces_of(body);
  for (const int k : faces_named(body, f, "faces")) surfaces[k] = nullptr;
  FaceReplacement made = replace_faces(body, surfaces, "faces");
  check_shells(made);
  return std::move(made.body);
}

// Of a hollow: what fills it.
void turn_outward(Body& body) {
  double volume = 0;
  for (size_t s = 0; s < body.shells.size(); ++s) volume += signed_volume(body, static_cast<int>(s), 1e-3);
  if (volume > 0) return;
  for (Face& face : body.faces) face.forward = !face.forward;
  for (Loop& loop : body.loops) std::reverse(loop.coedges.begin(), loop.coedges.end());
  for (Coedge& use : body.coedges) use.forward = !use.forward;
}

Body detached(const Fields& f) {
  const Body& body = *f.body("of");
  std::vector<SurfacePtr> surfaces(body.faces.size());
  std::vector<char> group(body.faces.size(), 0);
  for (const int k : faces_named(body, f, "faces")) group[k] = 1;
  for (const Edge& edge : body.edges) {
    const bool beside = std::any_of(edge.coedges.begin(), edge.coedges.end(),
                                    [&](int c) { return group[face_of_coedge(body, c)] != 0; });
    if (!beside) continue;
    for (const int c : edge.coedges) surfaces[face_of_coedge(body, c)] = body.faces[face_of_coedge(body, c)].surface;
  }
  FaceReplacement made = replace_faces(body, surfaces, "faces", true);
  turn_outward(made.body);
  check_shells(made);
  return std::move(made.body);
}

}  // namespace

TypeDeclaration deleted_faces_type() {
  return declare(Category::body, "deleted_faces",
                 "A body without some of its faces: a boss, a lug, a hole, a fillet. The faces around them are "
                 "continued until they close the wound; a hole in one of them is filled.")
      .example(
          "of: { type: extrusion_body, of: [{ type: rectangle, size: [6, 4] }, { type: circle, radius: 1 }], "
          "along: [0, 0, 1] }, faces: side.4")
      .field("of", reference({Category::body}), "the body; closed")
      .field("faces", texts().count(1), "names or numbers of the faces, as 'lekalo measure --topology' gives them")
      .field("chain", boolean(),
             "the faces are fillets, and all go that follow them smoothly with their radius, corners among them",
             "false")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(deleted(f)); });
}

TypeDeclaration detached_faces_type() {
  return declare(Category::body, "detached_faces",
                 "Some faces of a body as a body of their own, closed by the faces around them, which are continued as "
                 "for deleted_faces: what these take away from the body, or fill up in it.")
      .example(
          "of: { type: extrusion_body, of: [{ type: rectangle, size: [6, 4] }, { type: circle, radius: 1 }], "
          "along: [0, 0, 1] }, faces: side.4")
      .field("of", reference({Category::body}), "the body; closed")
      .field("faces", texts().count(1), "names or numbers of the faces, as 'lekalo measure --topology' gives them")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(detached(f)); });
}

}  // namespace lekalo::geometry
