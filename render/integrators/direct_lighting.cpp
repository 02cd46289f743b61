// Light that comes from lamps, surroundings and glowing objects directly, or by way of mirrors and clear bodies alone.
#include "geometry/describe.h"
#include "render/integrators/path_tracer.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class DirectLighting final : public Integrator {
 public:
  explicit DirectLighting(const PathOptions& options) : options_(options) {}

  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return trace_path(world, ray, first, random, options_);
  }
  std::any made_from() const override { return options_; }

 private:
  PathOptions options_;
};

}  // namespace

TypeDeclaration direct_lighting_type() {
  return declare(Category::integrator, "direct_lighting",
                 "Path tracing without light between surfaces: what lamps, surroundings and glowing objects throw on "
                 "things directly, with mirrors and clear bodies.")
      .field("max_depth", integer().between(0, 1000), "mirror reflections and refractions after the first", "16")
      .field("background_light", boolean(), "true: the background lights the scene from everywhere", "false")
      .built_by([](const Fields& f) -> IntegratorPtr {
        PathOptions options;
        options.max_depth = f.integer("max_depth");
        options.max_scatterings = 0;
        options.background_shines = f.boolean("background_light");
        return std::make_shared<DirectLighting>(options);
      });
}

}  // namespace lekalo::render
