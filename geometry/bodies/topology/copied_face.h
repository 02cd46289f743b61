// Faces of bodies by themselves, with their own copies of their edges and vertices.
#pragma once

#include "geometry/body.h"

namespace lekalo::geometry {

// Adds the face, moved by a map that keeps angles, with an open shell of its own; returns its number.
int copy_face(const Body& from, int face, const Affine& move, Body& into);

// The face alone.
Body face_alone(const Body& body, int face);

}  // namespace lekalo::geometry
