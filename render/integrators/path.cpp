// Path tracing: pictures that converge to what the light of a scene really does.
#include "render/integrators/path.h"

#include <algorithm>

#include "geometry/describe.h"
#include "render/integrators/caustics.h"
#include "render/integrators/light_tree.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class PathIntegrator final : public Integrator {
 public:
  explicit PathIntegrator(const PathOptions& options, std::shared_ptr<const Caustics> caustics = nullptr,
                          std::shared_ptr<const LightTree> tree = nullptr)
      : options_(options), caustics_(std::move(caustics)), tree_(std::move(tree)) {}

  IntegratorPtr prepared(const World& world) const override {
    std::shared_ptr<const LightTree> tree = make_light_tree(world);
    std::shared_ptr<const Caustics> caustics;
    if (options_.photons > 0)
      caustics =
          trace_caustics(world, {options_.photons, options_.max_depth, options_.dispersion || options_.spectral});
    if (!caustics && !tree) return nullptr;
    return std::make_shared<PathIntegrator>(options_, std::move(caustics), std::move(tree));
  }
  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return trace_path(world, ray, first, random, options_, caustics_.get(), tree_.get());
  }
  bool tells_parts() const override { return true; }
  RaySample trace_parts(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return trace_path(world, ray, first, random, options_, caustics_.get(), tree_.get(), true);
  }
  std::any made_from() const override { return options_; }

 private:
  PathOptions options_;
  std::shared_ptr<const Caustics> caustics_;
  std::shared_ptr<const LightTree> tree_;
};

}  // namespace

IntegratorPtr make_path_integrator(const PathOptions& options) { return std::make_shared<PathIntegrator>(options); }

bool misses_light(const Model& model) {
  const bool has_points = std::any_of(model.lights.begin(), model.lights.end(), [](const LightPtr& light) {
    return light->ambient().is_zero() && light->casts_shadows() && !light->has_size();
  });
  if (!has_points) return false;
  bool found = false;
  each_object(model.objects, [&](const Object& object) {
    found = found || (!std::holds_alternative<GroupPtr>(object.shape) && throws_caustics(object));
  });
  return found;
}

std::string without_photons(const Model& model) {
  std::string found;
  int number = 0;
  each_object(model.objects, [&](const Object& object) {
    ++number;
    if (found.empty() && !std::holds_alternative<GroupPtr>(object.shape) && !bounds(object.shape).bounded() &&
        throws_caustics(object))
      found = object.name.empty() ? "object " + std::to_string(number) : object.name;
  });
  return found;
}

TypeDeclaration path_integrator_type() {
  return declare(Category::integrator, "path",
                 "Path tracing: light over any number of surfaces, with its noise, which falls as the square root of "
                 "the samples. What lamps throw through glass and by mirrors on other things (caustics) is brought by "
                 "photons; "
                 "it is blurred a little, and has a noise of its own, which falls with their number. Ambient light "
                 "comes from "
                 "everywhere and is shadowed.")
      .field("bounces", integer().between(0, 1000), "reflections and refractions after the first", "64")
      .field("clamp", number().non_negative(),
             "light over two and more surfaces is at most so bright in each sample: less noise, and less light; 0: as "
             "it is",
             "0")
      .field(
          "photons", integer().between(0, 100'000'000),
          "for caustics, sent before the picture is begun; 0: caustics are found by chance, which lamps without a size "
          "never are",
          "200000")
      .field("dispersion", boolean(),
             "true: what meets `glass` of a dielectric goes on in one wavelength, whose index counts; false: light of "
             "all colours is bent as yellow light is, which takes fewer samples",
             "false")
      .field("spectral", boolean(), kSpectralText, "false")
      .field("background_light", boolean(), "true: the background lights the scene from everywhere", "false")
      .built_by([](const Fields& f) {
        PathOptions options;
        options.max_depth = f.integer("bounces");
        options.clamp = f.number("clamp");
        options.photons = static_cast<int>(f.integer("photons"));
        options.dispersion = f.boolean("dispersion");
        options.spectral = f.boolean("spectral");
        options.background_shines = f.boolean("background_light");
        return make_path_integrator(options);
      });
}

}  // namespace lekalo::render
