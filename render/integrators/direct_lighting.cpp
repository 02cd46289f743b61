// Light that comes from lamps, surroundings and glowing objects directly, or by way of mirrors and clear bodies alone.
#include "geometry/describe.h"
#include "render/integrators/path.h"

namespace lekalo::render {

using namespace geometry;

TypeDeclaration direct_lighting_type() {
  return declare(Category::integrator, "direct_lighting",
                 "Path tracing without light between surfaces: what lamps, surroundings and glowing objects throw on "
                 "things directly, with mirrors and clear bodies.")
      .field("bounces", integer().between(0, 1000), "mirror reflections and refractions after the first", "16")
      .field("spectral", boolean(), kSpectralText, "false")
      .field("background_light", boolean(), "true: the background lights the scene from everywhere", "false")
      .built_by([](const Fields& f) {
        PathOptions options;
        options.max_depth = f.integer("bounces");
        options.max_scatterings = 0;
        options.spectral = f.boolean("spectral");
        options.background_shines = f.boolean("background_light");
        return make_path_integrator(options);
      });
}

}  // namespace lekalo::render
