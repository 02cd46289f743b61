// How fine the meshes and polygons are that stand for shapes (`representation: mesh` of an object).
#pragma once

#include "geometry/tessellation/tessellate.h"
#include "render/model/model.h"

namespace lekalo::render {

// Sag and angle that an object asks for, in the shape's own space, for the map that shows it largest among those given.
// Without a sag in scene units the camera says how long a pixel is; without a camera it is a thousandth of the shape's
// size.
geometry::TessellationTolerance mesh_tolerance(const Object& object, const geometry::Affine& to_world,
                                               const CameraPtr& camera);

// The curve as the polygon that stands for it.
geometry::CurvePtr polygon_of(const geometry::Curve& curve, const geometry::TessellationTolerance& tolerance);

}  // namespace lekalo::render
