// Recursive ray tracing (Golovanov 2016, 8.5, algorithm 2): a ray that meets a surface brings the light of the classic
// model there (8.4.4) and splits into the mirror ray and the refracted ray. Terms in the order of the code:
//
//   emission + k_a I_a / (1 + k_r (r - r_0)) + sum over lights of V E / pi (k_d cos(theta) + k_s cos(alpha)^n)
//   + k_t sum over lights behind of V E / pi cos(beta)^n (where it is asked for)
//   + mirror radiance(mirror ray) + k_t radiance(refracted ray), all of it times e^(-mu l) of the way to the surface,
//
// E / pi the I_p of the book (lights/light.h), V the share of a light sample that shadows let through. Total internal
// reflection adds k_t to the mirror share. Light refracted at the index for yellow light (line d) is the same for all
// lanes: the classic model has no dispersion.
#include "render/integrators/classic.h"

#include <bit>

#include "geometry/describe.h"
#include "render/integrators/boundary.h"
#include "render/integrators/classic_reading.h"
#include "render/integrators/path_limits.h"
#include "render/integrators/phong_model.h"
#include "render/lobes/fresnel.h"
#include "render/materials/textured_color.h"
#include "render/trace/world.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Light of a highlight below which its grain is not seen.
constexpr float kGrain = 0.004f;
constexpr float kOverPi = static_cast<float>(1 / kPi);

// The light of lights at a point, before the coefficients.
struct Illumination {
  Spectrum diffuse;       // sum of V E / pi cos(theta)
  Spectrum specular;      // sum of V E / pi cos(alpha)^n
  Spectrum unobstructed;  // sum of E / pi cos(theta), where shadows are caught
};

// What a ray sees, all normals on the viewer's side.
struct Interaction : Boundary {
  Interaction(const World& world, const Ray& ray, const Hit& hit, double way, Media& media)
      : Boundary(world, ray, hit, kYellow, media),
        length(way + hit.t),
        smooth_normal(front ? point.normal : -point.normal) {}

  double length;       // of the way from the eye
  Vec3 smooth_normal;  // of the surface that a facet stands for
  Vec3 normal;         // after bumps; set where light is reflected
};

// A sample of a light at a surface point.
struct LightContribution {
  double cosine = 0;
  double lobe = 0;
  float highlight = 0;
  Spectrum light_per_pi;

  bool is_dark() const { return cosine == 0; }  // nothing comes from there
};

// Samples of one light whose shadow rays are asked together.
constexpr int kMaxTogether = 16;

class Tracer {
 public:
  // `whole`: the sample gets its point, depth and key, too.
  Tracer(const World& world, const ClassicOptions& options, double reference_depth, SampleStream& random,
         RaySample& sample, bool whole)
      : world_(world),
        options_(options),
        reference_depth_(reference_depth),
        transmits_(world.has_transmitting_materials()),
        tinted_(options.shadows == ShadowMode::transparent && transmits_),
        whole_(whole),
        random_(random),
        sample_(sample) {}

  // `hit`: what the ray meets, instance -1 for nothing; `weight`: what the light of this ray is multiplied with on its
  // way to the eye; `length`: of the way up to its origin.
  Spectrum radiance(const Ray& ray, const Hit& hit, const Media& media, int depth, const Spectrum& weight,
                    double length);

 private:
  Spectrum shade(const Ray& ray, const Interaction& seen, ClassicCoefficients& c, const Media& media, int depth,
                 const Spectrum& weight);
  Illumination illuminate(const Ray& ray, const Interaction& seen, const ClassicCoefficients& c, const Media& media);
  // The share of light that arrives along a ray, and the same of one that meets `first` (instance -1: nothing).
  Spectrum visible_share(const Ray& shadow_ray, const Obstacles& among, const Media& media) {
    if (!tinted_) return world_.occluded(shadow_ray, among) ? Spectrum() : kWhite;
    Hit first;
    if (!world_.nearest(shadow_ray, first, among)) {
      if (media.is_air()) return kWhite;
      first.instance = -1;
    }
    return passing(shadow_ray, first, media);
  }
  Spectrum shining_through(const Ray& ray, const Interaction& seen, double exponent, const Media& media);
  Spectrum passing(const Ray& shadow_ray, const Hit& first, const Media& media);
  Spectrum caught_shadow(const Illumination& light, const ClassicCoefficients& c, bool first);
  void record(const Interaction& seen);
  Hit met(const Ray& ray) const {
    Hit hit;
    if (!world_.nearest(ray, hit)) hit.instance = -1;
    return hit;
  }
  // Of the face of the copy of an object; two of them differ.
  void mix_place(const SurfacePoint& point) {
    mix(std::rotl(static_cast<uint64_t>(point.instance), 32) ^ static_cast<uint32_t>(point.face));
  }
  void mix(uint64_t value) {
    if (whole_) sample_.key = (std::rotl(sample_.key, 23) ^ value) * 0x9e3779b97f4a7c15u;
  }

  const World& world_;
  const ClassicOptions& options_;
  double reference_depth_;
  bool transmits_;  // some material; where none does no body has a medium
  bool tinted_;     // shadows
  bool whole_;
  SampleStream& random_;
  RaySample& sample_;
};

Spectrum Tracer::radiance(const Ray& first_ray, const Hit& first_hit, const Media& around, int depth,
                          const Spectrum& weight, double length) {
  Spectrum through = kWhite;
  Media media = around;
  // Behind a boundary that is none for light; mostly there is none of these, so that they are not initialised.
  struct Beyond {
    Beyond() {}
    union {
      Ray ray;
    };
    union {
      Hit hit;
    };
  } beyond;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    if (pass > 0) beyond.hit = met(beyond.ray);
    const Ray& ray = pass > 0 ? beyond.ray : first_ray;
    const Hit& hit = pass > 0 ? beyond.hit : first_hit;
    if (hit.instance < 0) {
      mix(0);
      if (!media.is_air()) through *= transmittance(media.current().absorption, kInfinity);
      return through * backdrop(world_, ray);
    }
    Interaction seen(world_, ray, hit, length, media);
    if (!media.is_air()) through *= transmittance(media.current().absorption, hit.t);
    ClassicCoefficients c = classic_reading(*seen.material, seen.point, kPrimaries);
    // Pieces of the same substance that touch or overlap are one.
    const bool is_joint = c.fresnel == Fresnel::boundary && !media.is_air() && !seen.behind.is_air() &&
                          media.current().index == seen.behind.current().index;
    if (seen.changes_filling && !is_joint && (seen.front || !c.catches_shadows)) {
      seen.normal = seen.material->shading_normal(seen.point);
      if (!seen.front) seen.normal = -seen.normal;
      return through * shade(ray, seen, c, media, depth, weight * through);
    }
    media = seen.behind;
    length = seen.length;
    if (pass == 0) beyond.ray = first_ray;
    world_.leave(seen.far_side(), beyond.ray.direction, beyond.ray);
  }
  return {};
}

Spectrum Tracer::shade(const Ray& ray, const Interaction& seen, ClassicCoefficients& c, const Media& media, int depth,
                       const Spectrum& weight) {
  if (!seen.front && !c.two_sided) c.diffuse = c.specular = c.mirror = {};
  mix_place(seen.point);
  mix(seen.front);
  if (whole_) mix(seen.material->cell(seen.point));
  if (depth == 0) record(seen);

  const Illumination light = illuminate(ray, seen, c, media);
  if (c.catches_shadows) return caught_shadow(light, c, depth == 0);

  const float fading = options_.depth_attenuation > 0
                           ? static_cast<float>(depth_factor(options_.depth_attenuation, seen.length, reference_depth_))
                           : 1.0f;
  const Spectrum direct =
      fading * (c.ambient * world_.ambient()) +
      (options_.attenuate_lights ? fading : 1.0f) * (c.diffuse * light.diffuse + c.specular * light.specular);
  if (depth == 0) sample_.direct = direct;
  Spectrum sum = c.emission + direct;
  if (c.spread > 0) sum += c.transmission * shining_through(ray, seen, c.spread, media);

  Spectrum mirror = c.mirror, transmission = c.transmission;
  if (mirror.is_zero() && transmission.is_zero()) return sum;
  const double n0 = media.current().index, n1 = seen.behind.current().index;
  // A smooth normal may look away from the viewer near the outline of a mesh; then the facet's own is taken.
  const Vec3 m = glm::dot(ray.direction, seen.normal) < 0 ? seen.normal : seen.geometric_normal();
  const double cosine = -glm::dot(ray.direction, m);
  const float per_n0 = static_cast<float>(1 / n0);
  switch (c.fresnel) {
    case Fresnel::none:
      break;
    case Fresnel::boundary: {
      const float f = static_cast<float>(fresnel_dielectric(cosine, n0, n1));
      mirror += f * transmission;
      transmission *= 1 - f;
      break;
    }
    case Fresnel::pane: {
      const auto both = static_cast<float>(pane_reflectance(fresnel_dielectric(cosine, per_n0 * c.index)[0]));
      mirror += both * transmission;
      transmission *= 1 - both;
      break;
    }
    case Fresnel::coat:
      mirror *= fresnel_dielectric(cosine, per_n0 * c.index);
      break;
    case Fresnel::conductor:
      mirror *= fresnel_conductor(cosine, per_n0 * c.index, per_n0 * c.extinction);
      break;
  }
  std::optional<Vec3> inward;
  if (!transmission.is_zero()) {
    inward = refracted(ray.direction, m, n0, n1);
    if (inward && glm::dot(*inward, seen.geometric_normal()) >= 0)
      inward = refracted(ray.direction, seen.geometric_normal(), n0, n1);
    if (!inward) mirror += transmission;
  }

  const auto follow = [&](const SurfacePoint& from, const Vec3& direction, const Spectrum& share, const Media& inside) {
    if (depth >= options_.max_depth || (weight * share).largest() <= options_.weight_cutoff) {
      mix(1);
      return Spectrum();
    }
    Ray next;
    world_.leave(from, direction, next);
    next.direction = direction;
    next.kind = RayKind::reflection;
    ++sample_.other_rays;
    return share * radiance(next, met(next), inside, depth + 1, weight * share, seen.length);
  };
  if (!mirror.is_zero()) {
    Vec3 direction = reflected(ray.direction, m);
    if (glm::dot(direction, seen.geometric_normal()) <= 0)
      direction = reflected(ray.direction, seen.geometric_normal());
    mix(2);
    sum += follow(seen.near_side(), direction, mirror, media);
  }
  if (inward) {
    mix(3);
    sum += follow(seen.far_side(), *inward, transmission, seen.behind);
  }
  return sum;
}

Illumination Tracer::illuminate(const Ray& ray, const Interaction& seen, const ClassicCoefficients& c,
                                const Media& media) {
  Illumination sum;
  const bool diffuse = !c.diffuse.is_zero(), specular = !c.specular.is_zero();
  if (!diffuse && !specular) return sum;
  const double m_v = -glm::dot(seen.normal, ray.direction);
  // Shadow rays start on the lit side of the surface, from the smooth surface where a facet stands for it; made when
  // the first is needed.
  Ray shadow_ray;
  bool has_left = false;
  const auto leave = [&] {
    if (has_left) return;
    has_left = true;
    shadow_ray.kind = RayKind::shadow;
    world_.leave(seen.near_side(), seen.geometric_normal(), shadow_ray);
  };
  for (const LightPtr& light : world_.lamps()) {
    const int count = light->sample_count();
    const bool jittered = light->is_jittered();
    const bool shadows = options_.shadows != ShadowMode::none && light->casts_shadows();
    // What a cone of light brings is known, and each of its samples brings the same share of that: where nothing or
    // all of it is hidden there is no noise.
    std::optional<ConeLight> cone;
    Spectrum all_of_cone, share_of_cone;  // the sum of what is seen of its samples
    if (diffuse && jittered && seen.normal == seen.smooth_normal) cone = light->cone(seen.point.position);
    if (cone) {
      const double mean_cosine = cone->mean_cosine(glm::dot(seen.normal, cone->axis));
      if (mean_cosine == 0) {  // all of it below the horizon
        mix(4);
        continue;
      }
      all_of_cone = static_cast<float>(mean_cosine) * kOverPi * cone->irradiance;
      sum.unobstructed += all_of_cone;
    }
    Obstacles obstacles;
    if (shadows && count > 1)
      if (const Box3 places = light->places(); places.bounded()) {
        leave();
        obstacles = world_.obstacles(shadow_ray, places);
      }
    // In air what meets nothing is in full light; inside a body light fades on any way.
    const bool asks_first = !tinted_ || media.filling() < 0;
    const bool clear = !shadows || (obstacles.none() && asks_first);
    if (clear && cone && !specular) {
      sum.diffuse += all_of_cone;
      for (int i = 0; i < count; ++i) mix(6);
      continue;
    }
    // A sample, whose ray shadow_ray becomes; none if it matters to nothing. (Inline: twice called, it would not be.)
    const auto take = [&](int i) __attribute__((always_inline))->std::optional<LightContribution> {
      LightContribution taken;
      Vec3 direction;
      double distance;
      if (cone) {
        direction = cone->direction(seen.normal, i, random_);
        distance = cone->distance_along(direction);
        taken.cosine = glm::dot(seen.normal, direction);
        if (!(taken.cosine > 0)) return LightContribution();
        taken.light_per_pi = static_cast<float>(1 / (count * taken.cosine)) * all_of_cone;
      } else {
        const Vec2 r = jittered ? random_.next_pair() : Vec2(0.5);
        const LightSample sample = light->sample(seen.point.position, i, r.x, r.y);
        direction = sample.direction;
        distance = sample.distance;
        taken.cosine = glm::dot(seen.normal, direction);
        if (taken.cosine <= 0 || glm::dot(seen.smooth_normal, direction) <= 0 || sample.irradiance.is_zero())
          return LightContribution();
        taken.light_per_pi = static_cast<float>(sample.weight) * kOverPi * sample.irradiance;
      }
      // R.V with R = 2 (m.L) m - L and V = -d
      const double cos_alpha = 2 * taken.cosine * m_v + glm::dot(direction, ray.direction);
      // Beside diffuse light no float shows what of a highlight is below e^-20, and alone none is as small as e^-104:
      // cos^n <= e^(-n (1 - cos)).
      const bool is_lost = c.exponent * (1 - cos_alpha) > (diffuse ? 20 : 104);
      if (specular && !is_lost) {
        taken.lobe = phong_lobe(cos_alpha, c.exponent);
        taken.highlight = static_cast<float>(taken.lobe) * (c.specular * taken.light_per_pi).largest();
      }
      if (!diffuse && taken.highlight == 0) return std::nullopt;
      leave();
      shadow_ray.direction = direction;
      shadow_ray.t_max = distance;
      return taken;
    };
    // What a sample brings, of which the share `visible` arrives.
    const auto add = [&](const LightContribution& taken, const Spectrum& visible) __attribute__((always_inline)) {
      if (taken.is_dark()) {
        mix(4);
        return;
      }
      if (!cone && c.catches_shadows) sum.unobstructed += static_cast<float>(taken.cosine) * taken.light_per_pi;
      if (shadows) ++sample_.shadow_rays;
      // A highlight jitters with the places on the light.
      if (jittered && (!cone || visible != kWhite || taken.highlight > kGrain)) sample_.noisy = true;
      if (whole_) mix(visible.is_zero() ? 5 : 6);
      if (cone)
        share_of_cone += visible;
      else
        sum.diffuse += static_cast<float>(taken.cosine) * (visible * taken.light_per_pi);
      if (taken.lobe != 0) sum.specular += static_cast<float>(taken.lobe) * (visible * taken.light_per_pi);
    };
    if (count == 1 || clear || !asks_first || !world_.gains_by_lists()) {
      for (int i = 0; i < count; ++i) {
        const std::optional<LightContribution> taken = take(i);
        if (!taken) continue;
        add(*taken, clear || taken->is_dark() ? kWhite : visible_share(shadow_ray, obstacles, media));
      }
    } else {
      static thread_local std::vector<LightContribution> samples;  // their room is kept
      static thread_local std::vector<Ray> shadow_rays;
      for (int begin = 0; begin < count; begin += kMaxTogether) {
        samples.clear();
        shadow_rays.clear();
        for (int i = begin; i < std::min(begin + kMaxTogether, count); ++i)
          if (const std::optional<LightContribution> taken = take(i)) {
            samples.push_back(*taken);
            if (!taken->is_dark()) shadow_rays.push_back(shadow_ray);
          }
        bool hidden[kMaxTogether] = {};
        world_.occluded(shadow_rays, obstacles, {hidden, shadow_rays.size()});
        size_t next = 0;
        for (const LightContribution& taken : samples) {
          if (taken.is_dark()) {
            add(taken, kWhite);
            continue;
          }
          const Ray& to_light = shadow_rays[next];
          add(taken, !hidden[next] ? kWhite : tinted_ ? passing(to_light, met(to_light), media) : Spectrum());
          ++next;
        }
      }
    }
    if (cone) {  // all of it, or nothing, exactly
      const auto n = static_cast<float>(count);
      sum.diffuse += Spectrum(share_of_cone[0] / n, share_of_cone[1] / n, share_of_cone[2] / n, share_of_cone[3] / n) *
                     all_of_cone;
    }
  }
  return sum;
}

// Directed transmission (Golovanov 2016, 8.4): sum of V E / pi cos(beta)^n over the lights behind the surface, beta the
// angle between their refracted light and the way to the viewer.
Spectrum Tracer::shining_through(const Ray& ray, const Interaction& seen, double exponent, const Media& media) {
  Spectrum sum;
  Ray shadow_ray;
  shadow_ray.kind = RayKind::shadow;
  world_.leave(seen.far_side(), -seen.geometric_normal(), shadow_ray);
  for (const LightPtr& light : world_.lamps()) {
    const bool shadows = options_.shadows != ShadowMode::none && light->casts_shadows();
    for (int i = 0; i < light->sample_count(); ++i) {
      const Vec2 r = light->is_jittered() ? random_.next_pair() : Vec2(0.5);
      const LightSample sample = light->sample(seen.point.position, i, r.x, r.y);
      if (glm::dot(sample.direction, seen.normal) >= 0 || glm::dot(sample.direction, seen.geometric_normal()) >= 0)
        continue;
      const std::optional<Vec3> out =
          refracted(-sample.direction, -seen.normal, seen.behind.current().index, media.current().index);
      const double lobe = out ? phong_lobe(-glm::dot(*out, ray.direction), exponent) : 0;
      if (lobe == 0 || sample.irradiance.is_zero()) continue;
      shadow_ray.direction = sample.direction;
      shadow_ray.t_max = sample.distance;
      if (shadows) ++sample_.shadow_rays;
      const Spectrum visible = shadows ? visible_share(shadow_ray, {}, seen.behind) : kWhite;
      mix(visible.is_zero() ? 5 : 6);
      sample_.noisy = sample_.noisy || light->is_jittered();
      sum += static_cast<float>(lobe * sample.weight) * kOverPi * (visible * sample.irradiance);
    }
  }
  return sum;
}

Spectrum Tracer::passing(const Ray& shadow_ray, const Hit& first, const Media& around) {
  Ray ray = shadow_ray;
  Media media = around;
  Spectrum share = kWhite;
  Hit hit = first;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    if (pass > 0) {
      ++sample_.shadow_rays;
      hit = met(ray);
    }
    if (hit.instance < 0) return share * transmittance(media.current().absorption, ray.t_max);
    const Boundary boundary(world_, ray, hit, kYellow, media);
    if (!boundary.material->transmits()) return {};
    share *= transmittance(media.current().absorption, hit.t);
    if (boundary.changes_filling) share *= classic_reading(*boundary.material, boundary.point, kPrimaries).transmission;
    if (share.is_zero()) return {};
    media = boundary.behind;
    mix_place(boundary.point);
    const Vec3 before = ray.origin;
    world_.leave(boundary.far_side(), ray.direction, ray);
    ray.t_max -= glm::dot(ray.origin - before, ray.direction);
  }
  return {};
}

Spectrum Tracer::caught_shadow(const Illumination& light, const ClassicCoefficients& c, bool first) {
  Spectrum missing;  // share of the light that does not arrive, times the strength of shadows
  for (int i = 0; i < 4; ++i) {
    const float open = world_.ambient()[i] + light.unobstructed[i];
    if (open > 0) missing.set(i, c.diffuse[i] * (light.unobstructed[i] - light.diffuse[i]) / open);
  }
  if (first) sample_.alpha = missing.largest();
  return (kWhite - missing) * world_.model().background;
}

void Tracer::record(const Interaction& seen) {
  sample_.alpha = 1;
  if (!whole_) return;
  sample_.point = seen.point;
  sample_.depth = seen.length;
}

class ClassicIntegrator final : public Integrator {
 public:
  explicit ClassicIntegrator(const ClassicOptions& options) : options_(options) {}

  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return sample(world, ray, first, random, true);
  }
  RaySample trace_color(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
    return sample(world, ray, first, random, false);
  }
  std::any made_from() const override { return options_; }

 private:
  RaySample sample(const World& world, const Ray& ray, const Hit& first, SampleStream& random, bool whole) const {
    RaySample sample;
    Tracer tracer(world, options_, reference_depth(world, ray), random, sample, whole);
    sample.radiance = tracer.radiance(ray, first, media_at_origin(world, ray, kYellow), 0, kWhite, 0);
    return sample;
  }
  double reference_depth(const World& world, const Ray& ray) const {
    if (options_.depth_attenuation == 0) return 0;
    if (options_.reference_depth) return *options_.reference_depth;
    const Vec3 to_center = world.center() - ray.origin;
    const bool parallel = world.model().camera && world.model().camera->is_parallel();
    return (parallel ? glm::dot(to_center, ray.direction) : glm::length(to_center)) - world.radius();
  }

  ClassicOptions options_;
};

}  // namespace

IntegratorPtr make_classic_integrator(const ClassicOptions& options) {
  return std::make_shared<ClassicIntegrator>(options);
}

TypeDeclaration classic_integrator_type() {
  return declare(
             Category::integrator, "classic",
             "Recursive ray tracing with the classic light model: ambient light, Lambert, Phong, mirror reflection, "
             "refraction, absorption, hard and soft shadows.")
      .field("max_depth", integer().between(0, 100), "mirror reflections and refractions in a row", "12")
      .field("weight_cutoff", number().between(0, 1),
             "rays that would bring a smaller share of their light are left out", "1/512")
      .field(
          "shadows", choice({"none", "opaque", "transparent"}),
          "opaque: everything in the way stops light; transparent: clear bodies let the share k_t e^(-mu l) through, "
          "straight on",
          "transparent")
      .field("depth_attenuation", number().non_negative(),
             "k_r per unit of length: ambient light is divided by 1 + k_r (r - r_0), r the distance from the eye", "0")
      .field("reference_depth", number().or_word({"nearest"}), "r_0; nearest: where the scene begins", "nearest")
      .field("attenuate", choice({"ambient", "all"}), "what the depth term acts on: ambient light, or lights as well",
             "ambient")
      .built_by([](const Fields& f) {
        ClassicOptions options;
        options.max_depth = f.integer("max_depth");
        options.weight_cutoff = f.number("weight_cutoff");
        const std::string& shadows = f.text("shadows");
        options.shadows = shadows == "none"     ? ShadowMode::none
                          : shadows == "opaque" ? ShadowMode::opaque
                                                : ShadowMode::transparent;
        options.depth_attenuation = f.number("depth_attenuation");
        if (f.holds<double>("reference_depth")) options.reference_depth = f.number("reference_depth");
        options.attenuate_lights = f.text("attenuate") == "all";
        return make_classic_integrator(options);
      });
}

}  // namespace lekalo::render
