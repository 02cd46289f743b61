// A body whose faces get other surfaces, or go, while everything else follows (Golovanov 2016, 6.7, 6.12): the one
// mechanism of offsets, shells, drafts, moved and deleted faces.
//
// Each vertex is the common point of its faces' new surfaces; where more than three faces meet and have no point in
// common any more, it becomes several vertices with edges between them. Each edge runs along the intersection of its
// two surfaces; a smooth edge, or a seam, keeps its image. A group of faces that goes leaves a wound, which closes to
// a point or such a tree of edges where the faces around it come together.
#pragma once

#include <vector>

#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/support.h"

namespace lekalo::geometry {

struct FaceReplacement {
  Body body;
  std::vector<int> faces;     // the old number of each face
  std::vector<char> changed;  // whether each face has another surface or border; empty where no face has
  // Names of edges that run the other way now: the body passes through itself there.
  std::vector<std::string> turned_edges;
  bool polyhedral = false;  // all faces are plane
};

// `surfaces`: of each face its new surface, the same pointer where it stays, null where the face goes. A new surface
// has nearly the parameters of the old one (a plane need not). Throws FieldError (that field) where surfaces do not
// meet, for an open body, and where a face would be left without a border. The result may pass through itself: see
// turned_edges and check_replacement.
//
// With `cut_off` the faces that stay are a group and all its neighbours, which close it to a body of its own: each
// neighbour keeps the loops along the group, and looks to the side where these leave it.
FaceReplacement replace_faces(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field,
                              bool cut_off = false);

// Throws FieldError (that field, with the hint) where edges have turned, the body is not valid, or a changed face runs
// into another.
void check_replacement(const FaceReplacement& made, const char* field, const char* hint);

}  // namespace lekalo::geometry
