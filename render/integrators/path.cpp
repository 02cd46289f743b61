// Path tracing: pictures that converge to what the light of a scene really does.
#include "render/integrators/path.h"

#include <algorithm>

#include "geometry/describe.h"
#include "render/lobes/microfacet.h"
#include "render/lobes/scattering.h"
#include "render/model/placed_objects.h"

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

namespace {

bool is_sharp(const Material& material) {
  const Scattering scattering = material.scattering({}, Wavelengths{});
  const auto medium = material.interior(Wavelengths{});
  const Sides sides{1, medium ? medium->index : 1.0};
  return std::any_of(scattering.lobes.begin(), scattering.lobes.end(), [&](const WeightedLobe& part) {
    if (const auto* metal = std::get_if<MetalLobe>(&part.lobe))
      return microfacets(metal->roughness, metal->anisotropy).smooth();
    if (const auto* coat = std::get_if<CoatLobe>(&part.lobe)) return microfacets(coat->roughness, 0).smooth();
    if (const auto* matt = std::get_if<CoatedMattLobe>(&part.lobe))
      return microfacets(matt->coat.roughness, 0).smooth();
    if (const auto* boundary = std::get_if<BoundaryLobe>(&part.lobe))
      return !boundary->mirror.is_zero() || sides.behind != sides.near;
    if (const auto* clear = std::get_if<ClearLobe>(&part.lobe))
      return !clear->thin && sides.behind != sides.near && microfacets(clear->roughness, 0).smooth();
    return false;
  });
}

}  // namespace

bool misses_light(const Model& model) {
  const bool has_points = std::any_of(model.lights.begin(), model.lights.end(), [](const LightPtr& light) {
    return light->ambient().is_zero() && light->casts_shadows() && !light->has_size();
  });
  if (!has_points) return false;
  bool found = false;
  each_object(model.objects, [&](const Object& object) {
    for (const Material* material : {object.material.get(), object.back_material.get()})
      found = found || (material && is_sharp(*material));
  });
  return found;
}

TypeDeclaration path_integrator_type() {
  return declare(
             Category::integrator, "path",
             "Path tracing: light over any number of surfaces, with its noise, which falls as the square root of "
             "the samples. Lamps that have a size are seen in mirrors and through glass; light that reaches the eye "
             "through refraction or a mirror from a point, spot or parallel light is left out; a note says "
             "so. Ambient light comes from everywhere and is shadowed.")
      .field("max_depth", integer().between(0, 1000), "reflections and refractions after the first", "64")
      .field("clamp", number().non_negative(),
             "light over two and more surfaces is at most so bright in each sample: less noise, and less light; 0: as "
             "it is",
             "0")
      .field("dispersion", boolean(),
             "true: what meets `glass` of a dielectric goes on in one wavelength, whose index counts; false: light of "
             "all colours is bent as yellow light is, which takes fewer samples",
             "false")
      .field("background_light", boolean(), "true: the background lights the scene from everywhere", "false")
      .built_by([](const Fields& f) {
        PathOptions options;
        options.max_depth = f.integer("max_depth");
        options.clamp = f.number("clamp");
        options.dispersion = f.boolean("dispersion");
        options.background_shines = f.boolean("background_light");
        return make_path_integrator(options);
      });
}

}  // namespace lekalo::render
