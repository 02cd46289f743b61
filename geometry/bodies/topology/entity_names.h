// What messages call faces and edges of a body.
#pragma once

#include <string>

#include "geometry/body.h"

namespace lekalo::geometry {

// By the names of its two faces.
std::string name_of_edge(const Body& body, int edge);
// Its name, or its number.
std::string name_of_face(const Body& body, int face);

// The face in which a coedge runs.
inline int face_of(const Body& body, int coedge) { return body.loops[body.coedges[coedge].loop].face; }

// 1 where a face's r_u x r_v looks outward, else -1.
inline double outward_side(const Face& face) { return face.forward == (face.surface->normal_sign() > 0) ? 1 : -1; }

}  // namespace lekalo::geometry
