// Fillets recognised by their shape (Golovanov 2016, 6.12): faces with one constant principal curvature, a circle of
// the fillet's radius across, that are smooth with the faces beside them: cylinders, tori, canal surfaces; and the
// pieces of spheres in which such fillets end smoothly. What follows one another smoothly is a chain.
#pragma once

#include <array>
#include <vector>

#include "geometry/bodies/local/face_replacement.h"
#include "geometry/body.h"

namespace lekalo::geometry {

struct FilletChain {
  double radius = 0;
  bool convex = true;                       // material lies inside of the circle
  std::vector<int> faces;                   // bands between two faces, ascending
  std::vector<int> corners;                 // pieces of spheres, ascending
  std::vector<std::array<int, 2>> between;  // the faces beside each band
};

// Whether one of the bands of `outer` lies along a band of `inner`, as a rim does along a rounded corner.
bool is_along(const FilletChain& outer, const FilletChain& inner);

// In the order of their first faces.
std::vector<FilletChain> fillet_chains(const Body& body);

// The body without them, sharp again: each band shrinks to the edge in which the faces beside it meet, each corner, and
// each end of a band, to a vertex. Throws FieldError (that field) where the faces do not meet so.
FaceReplacement without_fillets(const Body& body, const std::vector<FilletChain>& chains, const char* field);

}  // namespace lekalo::geometry
