// How open to the surroundings a place is: the mean over the cosine of whether something lies near in a direction.
#include "geometry/describe.h"
#include "render/integrators/boundary.h"
#include "render/lobes/lobe.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class AmbientOcclusion final : public Integrator {
 public:
  AmbientOcclusion(double distance, int rays) : distance_(distance), rays_(rays) {}

  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    RaySample sample;
    sample.radiance = world.model().background;
    if (first.instance < 0) return sample;
    Media media;
    const Boundary seen(world, ray, first, kYellow, media);
    sample.alpha = 1;
    sample.noisy = true;
    sample.point = seen.point;
    sample.depth = first.t;
    sample.key = static_cast<uint64_t>(seen.point.instance + 1);
    const Frame frame = frame_about(Vec3(0), seen.shading_normal(ray.direction));
    Ray around;
    world.leave(seen.near_side(), seen.geometric_normal(), around);
    around.kind = RayKind::shadow;
    around.t_max = distance_;
    int open = 0;
    for (int i = 0; i < rays_; ++i) {
      around.direction = frame.direction(cosine_direction(random.next_sobol_pair()));
      open += !world.occluded(around);
    }
    sample.shadow_rays += static_cast<uint32_t>(rays_);
    sample.radiance = Spectrum(1, 1, 1) * (static_cast<float>(open) / static_cast<float>(rays_));
    return sample;
  }

 private:
  double distance_;
  int rays_;
};

}  // namespace

TypeDeclaration ambient_occlusion_type() {
  return declare(Category::integrator, "ambient_occlusion",
                 "Share of a place's surroundings that is open, whatever materials and lights: white on a free plane, "
                 "dark in corners.")
      .optional("distance", length().positive(), "things farther away hide nothing; default: all hide")
      .field("rays", integer().between(1, 4096), "tried at each place", "4")
      .built_by([](const Fields& f) -> IntegratorPtr {
        return std::make_shared<AmbientOcclusion>(f.has("distance") ? f.number("distance") : kInfinity,
                                                  f.integer("rays"));
      });
}

}  // namespace lekalo::render
