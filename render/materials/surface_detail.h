// What every material may have besides: bumps, a map of normals, holes. A material around the one that has them.
#pragma once

#include "geometry/describe.h"
#include "render/materials/textured_color.h"

namespace lekalo::render {

struct SurfaceDetail {
  TexturePtr bump;    // heights by its brightness; null: none
  double height = 0;  // of white over black, scene units
  TexturePtr normal_map;
  double strength = 1;  // multiplies the slopes of the map
  TexturedColor opacity = 1.0;
  bool has_holes = false;  // else `opacity` does not count
};

// The material with the detail, or itself where there is none.
MaterialPtr with_surface_detail(MaterialPtr plain, const SurfaceDetail& detail);

// The declaration with the fields `bump`, `normal_map` and `opacity`, and materials that have what they say.
geometry::TypeDeclaration with_surface_detail(geometry::TypeDeclaration type);

}  // namespace lekalo::render
