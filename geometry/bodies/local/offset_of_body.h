// Bodies with faces set off along their outward normals (Golovanov 2016, 6.7).
#pragma once

#include "geometry/bodies/local/face_replacement.h"

namespace lekalo::geometry {

// Each face by its distance, positive outward. Throws FieldError (that field, with the hint) where nothing valid comes
// of it.
FaceReplacement offset_of_body(const Body& body, const std::vector<double>& distances, const char* field,
                               const char* hint);

}  // namespace lekalo::geometry
