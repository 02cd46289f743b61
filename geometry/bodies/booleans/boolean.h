// Union, intersection and difference of bodies as boundaries (Golovanov 2016, 6.2 and 6.3; Requicha, Voelcker 1985).
//
// The edges of each body are cut where they meet the faces of the other, the curves in which faces intersect are cut
// at the same points. In each face old and new edges together are an arrangement of the parameter plane, whose regions
// lie altogether inside, outside or on the other body. Those that the operation keeps are glued along their common
// edges.
#pragma once

#include <stdexcept>
#include <string>

#include "geometry/body.h"

namespace lekalo::geometry {

enum class BooleanOperation { unite, intersect, subtract };

// What cannot be decided or has no result, and where.
class BooleanError : public std::runtime_error {
 public:
  BooleanError(const std::string& message, const Vec3& place, bool empty = false);
  Vec3 place;
  bool empty = false;  // nothing is left: the operation is done, but a body without points has no boundary
};

// Both bodies closed and valid; the result is regularised (no faces, edges or points without material beside them).
// Faces keep their surfaces and origins; of one that falls apart the parts are numbered: `side` becomes `side.0`,
// `side.1`. Where the solid touches itself along an edge or in a vertex these are there twice. Throws BooleanError,
// std::invalid_argument for open bodies.
Body boolean(BooleanOperation operation, const Body& a, const Body& b);

// The part of a closed body on the inner side of an open sheet, where its normals look away from, or on the outer one
// (Golovanov 2016, 6.4); pieces of the sheet become faces. Throws BooleanError as above, and where the sheet does not
// divide the body: its border lies inside.
Body cut(const Body& body, const Body& sheet, bool keep_inner);

// Turned inside out: every normal looks the other way.
Body inverted(const Body& body);

}  // namespace lekalo::geometry
