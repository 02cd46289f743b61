// Control meshes of subdivision surfaces as scene files give them.
#pragma once

#include "geometry/bodies/triangulations/connected_mesh.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// Of the fields points, faces, creases and corners; edges of one face are sharp. Throws FieldError where faces do not
// lie side by side.
PolygonMesh control_mesh(const Fields& fields);

}  // namespace lekalo::geometry
