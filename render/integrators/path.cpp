// Path tracing: pictures that converge to what the light of a scene really does.
#include "render/integrators/path.h"

#include "geometry/describe.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class PathIntegrator final : public Integrator {
 public:
  explicit PathIntegrator(const PathOptions& options) : options_(options) {}

  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return trace_path(world, ray, first, random, options_);
  }
  std::any made_from() const override { return options_; }

 private:
  PathOptions options_;
};

}  // namespace

IntegratorPtr make_path_integrator(const PathOptions& options) { return std::make_shared<PathIntegrator>(options); }

TypeDeclaration path_integrator_type() {
  return declare(
             Category::integrator, "path",
             "Path tracing: light over any number of surfaces, with its noise, which falls as the square root of "
             "the samples. Lamps that have a size are seen in mirrors and through glass; light that reaches the eye "
             "through refraction or a mirror from a point, spot or parallel light is left out, as are Phong "
             "highlights of smooth surfaces. Ambient light comes from everywhere and is shadowed.")
      .field("max_depth", integer().between(0, 1000), "reflections and refractions in a row", "64")
      .field("clamp", number().non_negative(),
             "light over two and more surfaces is at most so bright in each sample: less noise, and less light; 0: as "
             "it is",
             "0")
      .field("background_light", boolean(), "true: the background lights the scene from everywhere", "false")
      .built_by([](const Fields& f) {
        PathOptions options;
        options.max_depth = f.integer("max_depth");
        options.clamp = f.number("clamp");
        options.background_shines = f.boolean("background_light");
        return make_path_integrator(options);
      });
}

}  // namespace lekalo::render
