#include "render/integrators/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "render/integrators/caustics.h"
#include "render/integrators/dispersion.h"
#include "render/integrators/light_tree.h"
#include "render/integrators/path_limits.h"
#include "render/integrators/phase_function.h"
#include "render/integrators/phong_model.h"
#include "render/lights/lights.h"
#include "render/lobes/bsdf.h"
#include "render/materials/textured_color.h"
#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/upsampling.h"

namespace lekalo::render {

using geometry::kInfinity;
using geometry::kPi;

namespace {

// Walks in milky substances live whole until their share is the inverse of this.
constexpr double kDimWalk = 5;

double power_heuristic(double own, double other) {
  const double ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

// Directions from a point to a ball: all of them from within.
struct Cone {
  Vec3 axis{0, 0, 1};
  double height = 2;  // 1 - the cosine of half its opening

  double solid_angle() const { return geometry::kTwoPi * height; }
  // Even in solid angle.
  Vec3 direction(const Vec2& square) const {
    const double h = height * square.x, s = std::sqrt(std::max(0.0, h * (2 - h))), angle = geometry::kTwoPi * square.y;
    return geometry::frame_about(Vec3(0), axis).direction({s * std::cos(angle), s * std::sin(angle), 1 - h});
  }
};

Cone cone_of(const World::Glow& glow, const Vec3& point) {
  const Vec3 to = glow.center - point;
  const double distance = glm::length(to);
  if (distance <= glow.radius) return {};
  const double sine = glow.radius / distance;
  return {to / distance, sine * sine / (1 + std::sqrt(1 - sine * sine))};
}

// Share of light that arrives along a shadow ray: nothing through what refracts, straight through the rest of what is
// clear, by Bouguer's law in substances.
Spectrum unobstructed(const World& world, const Ray& shadow_ray, const Media& around, const Wavelengths& colors,
                      RaySample& sample) {
  ++sample.shadow_rays;
  if (!world.has_transmitting_materials()) return world.occluded(shadow_ray) ? Spectrum() : whole(colors);
  Ray ray = shadow_ray;
  Media media = around;
  Spectrum share = whole(colors);
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    Hit hit;
    if (!world.nearest(ray, hit)) return share * transmittance(media.current().extinction(), ray.t_max);
    const Boundary met(world, ray, hit, is_spectral(colors) ? colors : kYellow, media);
    if (!met.material->transmits()) return {};
    share *= transmittance(media.current().extinction(), hit.t);
    if (met.changes_filling) {
      const Sides sides{media.current().index, met.behind.current().index};
      const double cosine = std::fabs(glm::dot(ray.direction, met.shading_normal(ray.direction)));
      share *= straight_share(met.material->scattering(met.point, colors), cosine, sides);
    }
    if (share.is_zero()) return {};
    media = met.behind;
    const Vec3 before = ray.origin;
    world.leave(met.far_side(), ray.direction, ray);
    ray.t_max -= glm::dot(ray.origin - before, ray.direction);
  }
  return {};
}

class PathTracer {
 public:
  // `parts`: where the light comes from, or null for who does not want to know.
  PathTracer(const World& world, SampleStream& random, const PathOptions& options, const Caustics* caustics,
             const LightTree* tree, RaySample& sample, LightParts* parts)
      : world_(world),
        random_(random),
        options_(options),
        caustics_(caustics),
        tree_(tree),
        sample_(sample),
        parts_(parts) {
    if (options.spectral) take_four_wavelengths();
  }

  void trace(Ray ray, Hit hit);

 private:
  // Where the ray was drawn: what lamps would have been asked there.
  struct Origin {
    bool eye = true;
    bool sharp = true;       // by a mirror or a smooth boundary: no lamp could have been
    bool in_medium = false;  // of scattering, which asks for no glow
    bool gathered = false;   // the last place that spread the path has counted its photons: a surface, no substance
    Vec3 point{0};
    double density = 0;                      // of the direction
    double gone = 0;                         // way to the present ray's origin
    std::vector<LightTree::Choice> choices;  // of each lamp, and of what glows; without a tree
  };

  // Light at the end of the path; `straight`: from a lamp or glowing thing to the first surface.
  void add(const Spectrum& light, int group = 0, bool straight = false);
  float clamping(const Spectrum& seen) const;
  void tell_parts(const Spectrum& light, int group, bool straight);
  void add_surroundings();
  // To be said at the first surface before the light of a direction is added.
  void note_first(const Boundary& seen, const Bsdf& bsdf, const Vec3& in);
  void add_lamps_along(const Ray& ray, double end, const Media& media);
  void add_lamp(const Boundary& seen, const Bsdf& bsdf, const Media& media, const Vec2& choice, const Vec2& square);
  // A lamp, or behind the lamps a thing that glows.
  std::optional<LightTree::Choice> choose_lamp(const Vec3& point, double random);
  void weigh_lamps(const Vec3& point);
  // That of a number at the place where the ray was drawn.
  double choice_at_origin(size_t number) const {
    return tree_ ? tree_->probability(origin_.point, number) : origin_.choices[number].probability;
  }
  void add_glow(const LightTree::Choice& chosen, const Boundary& seen, const Bsdf& bsdf, const Media& media,
                const Vec2& square);
  double weight_of_glow(const SurfacePoint& point) const;
  void add_caustic(const Boundary& seen, const Bsdf& bsdf);
  void add_caught_shadow(const Boundary& seen, const Spectrum& strength, const Media& media);
  void record(const Boundary& seen);
  // Linear Rec.709 of light in the lanes.
  Spectrum color(const Spectrum& light) const { return options_.spectral ? hero_.color(light) : light; }
  void take_four_wavelengths();
  void take_one_wavelength();
  bool is_scattered(Ray& ray, double end, const Medium& medium, const Media& media);
  void add_lamp_in_medium(const Vec3& place, const Vec3& along, const Medium& medium, const Media& media);

  const World& world_;
  SampleStream& random_;
  const PathOptions& options_;
  const Caustics* caustics_;
  const LightTree* tree_;
  RaySample& sample_;
  LightParts* parts_;
  std::vector<std::pair<const Photon*, Spectrum>> landed_;  // what add_caustic found, for the parts
  Spectrum first_matt_;  // share of matt lobes in what the first surface sends on of the path
  bool first_passed_ = false;
  Origin origin_;
  std::vector<LightTree::Choice> choices_;  // of lamps at the present place, and of what glows; without a tree
  HeroWavelengths hero_;                    // of a spectral path
  Wavelengths colors_ = kPrimaries;         // of the lanes
  Wavelengths wavelengths_ = kYellow;       // of refraction
  LinearUpsampling of_photons_;             // into the lanes
  Spectrum share_ = kWhite;                 // of the light at the end of the path that reaches the eye
  bool one_wavelength_ = false;
  bool shown_ = true;  // the path is an image in mirrors and smooth boundaries
  int bounces_ = 0, scatterings_ = 0;
  double way_ = 0;
};

void PathTracer::add(const Spectrum& light, int group, bool straight) {
  const Spectrum arriving = share_ * light, seen = color(arriving);
  if (straight) sample_.direct += seen;
  const float clamped = clamping(seen);
  sample_.radiance += clamped * seen;
  if (parts_) tell_parts(clamped * arriving, group, straight);
}

float PathTracer::clamping(const Spectrum& seen) const {
  const bool bright = options_.clamp > 0 && bounces_ > 1 && seen.largest() > options_.clamp;
  return bright ? static_cast<float>(options_.clamp / seen.largest()) : 1;
}

// `light`: in the lanes.
void PathTracer::tell_parts(const Spectrum& light, int group, bool straight) {
  const Spectrum arriving = color(light);
  parts_->groups[static_cast<size_t>(group)] += arriving;
  if (bounces_ == 0) {
    parts_->emission += arriving;
    return;
  }
  if (!straight) parts_->indirect += arriving;
  if (first_passed_) {
    parts_->transmission += arriving;
    return;
  }
  const Spectrum matt = color(first_matt_ * light);
  parts_->diffuse += matt;
  parts_->specular += arriving - matt;
}

void PathTracer::note_first(const Boundary& seen, const Bsdf& bsdf, const Vec3& in) {
  if (!parts_ || bounces_ > 0) return;
  first_passed_ = glm::dot(in, seen.geometric_normal()) < 0;
  first_matt_ = bsdf.matt_share(in);
}

void PathTracer::add_surroundings() {
  const Spectrum background = upsampled_light(world_.model().background, colors_);
  if (shown_) {
    if (world_.backdrops().empty()) add(background);  // else a lamp has brought it
    return;
  }
  if (!parts_) {
    const Spectrum ambient = upsampled_light(world_.ambient(), colors_);
    add(options_.background_shines ? ambient + background : ambient);
    return;
  }
  const std::vector<Spectrum>& ambient = world_.ambient_by_group();
  for (size_t group = 0; group < ambient.size(); ++group)
    add(upsampled_light(ambient[group], colors_), static_cast<int>(group));
  if (options_.background_shines) add(background);
}

void PathTracer::add_lamps_along(const Ray& ray, double end, const Media& media) {
  const std::vector<LightPtr>& lamps = world_.lamps();
  // Light that lamps were asked for as well is stopped by the same things: by what shadow rays see.
  const bool as_shadow = !origin_.sharp && world_.shadows_differ();
  if (as_shadow && origin_.gone > 0) return;
  for (const size_t i : origin_.eye ? world_.backdrops() : world_.lamps_with_size()) {
    if (origin_.gathered && origin_.sharp && caustics_->of_lamp[i]) continue;  // photons have brought it
    const bool through_all = !lamps[i]->casts_shadows() && !origin_.sharp;
    const bool by_shadow_ray = as_shadow && lamps[i]->casts_shadows();
    // Surroundings lie behind all that is met; to ask them is to wait for memory.
    if (end < kInfinity && lamps[i]->is_backdrop() && !through_all && !by_shadow_ray) continue;
    const std::optional<LightSample> lamp = lamps[i]->towards(origin_.point, ray.direction);
    if (!lamp || lamp->irradiance.is_zero()) continue;
    const double weight = origin_.sharp ? 1 : power_heuristic(origin_.density, choice_at_origin(i) * lamp->density);
    Spectrum light = static_cast<float>(weight * lamp->density) * light_of(*lamps[i], lamp->irradiance, colors_);
    // Without shadows the light arrives through everything, but what is seen, itself or in a mirror, still lies before
    // or behind other things.
    const bool here =
        through_all ? origin_.gone == 0 : lamp->distance > origin_.gone && lamp->distance <= origin_.gone + end;
    if (by_shadow_ray) {
      Ray shadow = ray;
      shadow.kind = RayKind::shadow;
      shadow.t_max = lamp->distance;
      light *= unobstructed(world_, shadow, media, colors_, sample_);
    } else if (here) {
      light *= transmittance(media.current().extinction(), lamp->distance - origin_.gone);
    } else {
      continue;
    }
    add(light, world_.lamp_groups()[i], bounces_ == 1 && !origin_.sharp);
  }
}

std::optional<LightTree::Choice> PathTracer::choose_lamp(const Vec3& point, double random) {
  if (tree_) return tree_->choose(point, random);
  weigh_lamps(point);
  if (choices_.empty()) return std::nullopt;
  return chosen_of(choices_, random);
}

void PathTracer::weigh_lamps(const Vec3& point) {
  const std::vector<LightPtr>& lamps = world_.lamps();
  const std::vector<World::Glow>& glows = world_.glows();
  choices_.clear();
  if (lamps.size() + glows.size() == 1) {
    choices_.push_back({0, 1});
    return;
  }
  for (size_t i = 0; i < lamps.size(); ++i) {
    const double brings = lamps[i]->sample_all(point, Vec2(0.5)).irradiance.largest();
    choices_.push_back({i, std::isfinite(brings) ? brings : 0});
  }
  for (size_t i = 0; i < glows.size(); ++i)
    choices_.push_back({lamps.size() + i, glows[i].brightness * cone_of(glows[i], point).solid_angle()});
  share_out(choices_);
}

void PathTracer::add_lamp(const Boundary& seen, const Bsdf& bsdf, const Media& media, const Vec2& choice,
                          const Vec2& square) {
  const std::optional<LightTree::Choice> chosen = choose_lamp(seen.point.position, choice.x);
  if (!chosen) return;
  if (chosen->number >= world_.lamps().size()) {
    add_glow(*chosen, seen, bsdf, media, square);
    return;
  }
  const Light& lamp = *world_.lamps()[chosen->number];
  const LightSample sample = lamp.sample_all(seen.point.position, square);
  if (sample.irradiance.is_zero()) return;
  const Spectrum reflected = bsdf.evaluate(sample.direction);
  if (reflected.is_zero()) return;
  Spectrum visible = whole(colors_);
  if (lamp.casts_shadows()) {
    const bool behind = glm::dot(sample.direction, seen.geometric_normal()) < 0;
    Ray ray;
    ray.kind = RayKind::shadow;
    world_.leave(behind ? seen.far_side() : seen.near_side(),
                 behind ? -seen.geometric_normal() : seen.geometric_normal(), ray);
    ray.direction = sample.direction;
    ray.t_max = sample.distance;
    visible = unobstructed(world_, ray, behind ? seen.behind : media, colors_, sample_);
    if (visible.is_zero()) return;
  }
  const double weight =
      sample.density > 0 ? power_heuristic(chosen->probability * sample.density, bsdf.density(sample.direction)) : 1;
  const Spectrum light = static_cast<float>(weight / chosen->probability) *
                         (visible * reflected * light_of(lamp, sample.irradiance, colors_));
  note_first(seen, bsdf, sample.direction);
  ++bounces_;
  add(light, world_.lamp_groups()[chosen->number], bounces_ == 1);
  --bounces_;
}

// What meets the glowing object first counts; light that comes straight through panes is left to drawn directions.
void PathTracer::add_glow(const LightTree::Choice& chosen, const Boundary& seen, const Bsdf& bsdf, const Media& around,
                          const Vec2& square) {
  const World::Glow& glow = world_.glows()[chosen.number - world_.lamps().size()];
  const Cone cone = cone_of(glow, seen.point.position);
  Ray ray;
  const Vec3 direction = cone.direction(square);
  const Spectrum reflected = bsdf.evaluate(direction);
  if (reflected.is_zero()) return;
  const bool behind = glm::dot(direction, seen.geometric_normal()) < 0;
  world_.leave(behind ? seen.far_side() : seen.near_side(), direction, ray);
  ray.direction = direction;
  ray.kind = RayKind::reflection;
  Hit hit;
  ++sample_.shadow_rays;
  if (!world_.nearest(ray, hit) || hit.instance != glow.instance) return;
  Media media = behind ? seen.behind : around;
  const Boundary met(world_, ray, hit, wavelengths_, media);
  if (!met.changes_filling || met.point.instance != glow.instance) return;
  const Spectrum emission = met.material->scattering(met.point, colors_).emission;
  const double density = chosen.probability / cone.solid_angle();
  const double weight = power_heuristic(density, bsdf.density(direction));
  const Spectrum light = static_cast<float>(weight / density) *
                         (reflected * emission * transmittance(media.current().extinction(), hit.t));
  note_first(seen, bsdf, direction);
  ++bounces_;
  add(light, 0, bounces_ == 1);
  --bounces_;
}

// Of the light of a surface that a drawn direction has met.
double PathTracer::weight_of_glow(const SurfacePoint& point) const {
  if (origin_.eye || origin_.sharp || origin_.in_medium || origin_.gone > 0) return 1;
  const std::vector<World::Glow>& glows = world_.glows();
  const auto glow = std::lower_bound(glows.begin(), glows.end(), point.instance,
                                     [](const World::Glow& one, int64_t instance) { return one.instance < instance; });
  if (glow == glows.end() || glow->instance != point.instance) return 1;
  const size_t number = world_.lamps().size() + static_cast<size_t>(glow - glows.begin());
  return power_heuristic(origin_.density, choice_at_origin(number) / cone_of(*glow, origin_.point).solid_angle());
}

void PathTracer::add_caustic(const Boundary& seen, const Bsdf& bsdf) {
  constexpr double kMinCosine = 1e-3;
  Spectrum sum;
  landed_.clear();
  caustics_->photons.each_near(seen.point.position, seen.geometric_normal(), [&](const Photon& photon, double density) {
    const double cosine = std::fabs(glm::dot(photon.from, bsdf.normal()));
    const auto factor = static_cast<float>(density / std::max(cosine, kMinCosine));
    const Spectrum light = factor * (bsdf.evaluate(photon.from) * of_photons_(photon.power));
    sum += light;
    if (parts_) landed_.emplace_back(&photon, light);
  });
  if (sum.is_zero()) return;
  bounces_ += 2;  // of the lamp's light at least the mirror and this surface are behind it
  const Spectrum seen_light = color(share_ * sum);
  const float clamped = clamping(seen_light);
  sample_.radiance += clamped * seen_light;
  bounces_ -= 2;
  if (!parts_) return;
  for (const auto& [photon, light] : landed_) {
    note_first(seen, bsdf, photon->from);
    bounces_ += 2;
    tell_parts(clamped * (share_ * light), photon->group, false);
    bounces_ -= 2;
  }
}

// Of all samples of all lamps together: the share of one sample alone would be that of what it meets, however little
// light it brings.
void PathTracer::add_caught_shadow(const Boundary& seen, const Spectrum& strength, const Media& media) {
  Spectrum open, lit;
  Ray ray;
  ray.kind = RayKind::shadow;
  world_.leave(seen.near_side(), seen.geometric_normal(), ray);
  for (const LightPtr& lamp : world_.lamps()) {
    for (int i = 0; i < lamp->sample_count(); ++i) {
      const Vec2 square = lamp->is_jittered() ? random_.next_sobol_pair() : Vec2(0.5);
      const LightSample sample = lamp->sample(seen.point.position, i, square.x, square.y);
      const double cosine = glm::dot(sample.direction, seen.geometric_normal());
      if (cosine <= 0) continue;
      const Spectrum light =
          static_cast<float>(sample.weight * cosine / kPi) * light_of(*lamp, sample.irradiance, colors_);
      open += light;
      ray.direction = sample.direction;
      ray.t_max = sample.distance;
      lit += lamp->casts_shadows() ? unobstructed(world_, ray, media, colors_, sample_) * light : light;
    }
  }
  Spectrum missing;
  const Spectrum ambient = upsampled_light(world_.ambient(), colors_);
  for (int i = 0; i < 4; ++i) {
    const float all = ambient[i] + open[i];
    if (all > 0) missing.set(i, strength[i] * (open[i] - lit[i]) / all);
  }
  if (bounces_ == 0) sample_.alpha = missing.largest();
  add((whole(colors_) - missing) * upsampled_light(world_.model().background, colors_));
}

void PathTracer::record(const Boundary& seen) {
  sample_.alpha = 1;
  sample_.noisy = true;
  sample_.point = seen.point;
  sample_.depth = way_;
  sample_.key = hash_combine(hash_combine(static_cast<uint64_t>(seen.point.instance + 1), seen.point.face),
                             seen.material->cell(seen.point));
}

void PathTracer::take_four_wavelengths() {
  hero_ = hero_wavelengths(random_.next_sobol_pair().x);
  colors_ = wavelengths_ = hero_.wavelengths;
  share_ = whole(colors_);
  if (caustics_) of_photons_ = LinearUpsampling(colors_);
}

// Which is the first one of four, after which a substance's index has been asked for all the time.
void PathTracer::take_one_wavelength() {
  one_wavelength_ = true;
  if (options_.spectral) {
    share_ = Spectrum(4 * share_[0], 0, 0, 0);
    return;
  }
  const WavelengthSample taken = sample_wavelength(random_.next_sobol_pair().x);
  share_ *= taken.share;
  wavelengths_.nanometres.fill(taken.nanometres);
}

// A random walk in a substance that scatters. The way to the next scattering is drawn for one of the lanes, by their
// shares, and weighted by its density for all of them; false: it lies behind `end`, and the light that gets there is
// counted. Lamps are asked where they are seen straight through the substance's boundary.
bool PathTracer::is_scattered(Ray& ray, double end, const Medium& medium, const Media& media) {
  const Spectrum loss = medium.extinction();
  const int lanes = options_.spectral ? 4 : 3;
  double sum = 0;
  for (int i = 0; i < lanes; ++i) sum += share_[i];
  const auto chance = [&](int lane) { return sum > 0 ? share_[lane] / sum : 1.0 / lanes; };
  const Vec2 choice = random_.next_pair(), square = random_.next_pair();
  int lane = 0;
  double place = choice.x;
  while (lane + 1 < lanes && place >= chance(lane)) place -= chance(lane++);
  const double way = loss[lane] > 0 ? -std::log1p(-choice.y) / loss[lane] : kInfinity;
  const Spectrum kept = transmittance(loss, std::min(way, end));
  double density = 0;
  for (int i = 0; i < lanes; ++i) density += chance(i) * kept[i] * (way < end ? loss[i] : 1);
  if (!(density > 0)) {
    share_ = Spectrum();
    return false;
  }
  share_ *= static_cast<float>(1 / density) * kept;
  if (way >= end) return false;
  share_ *= medium.scattering;
  const Vec3 at = ray.at(way);
  const Vec3 direction = phase_direction(ray.direction, medium.forward, square);
  bounces_ = std::max(bounces_, 2);  // no direct light; however long the walk, it is none over more surfaces
  const bool asks = medium.index == 1;
  if (asks) add_lamp_in_medium(at, ray.direction, medium, media);
  ++scatterings_;
  shown_ = false;
  origin_.eye = false;
  origin_.sharp = !asks;
  origin_.in_medium = true;
  origin_.gathered = false;
  origin_.point = at;
  origin_.density = phase(glm::dot(direction, ray.direction), medium.forward);
  origin_.gone = 0;
  origin_.choices.swap(choices_);
  ray = Ray();
  ray.kind = RayKind::reflection;
  ray.origin = at;
  ray.direction = direction;
  return true;
}

void PathTracer::add_lamp_in_medium(const Vec3& place, const Vec3& along, const Medium& medium, const Media& media) {
  const Vec2 choice = random_.next_pair(), square = random_.next_pair();
  const std::optional<LightTree::Choice> chosen = choose_lamp(place, choice.x);
  if (!chosen || chosen->number >= world_.lamps().size()) return;  // what glows is left to drawn directions
  const Light& lamp = *world_.lamps()[chosen->number];
  const LightSample sample = lamp.sample_all(place, square);
  if (sample.irradiance.is_zero()) return;
  Ray ray;
  ray.kind = RayKind::shadow;
  ray.origin = place;
  ray.direction = sample.direction;
  ray.t_max = sample.distance;
  const Spectrum visible = lamp.casts_shadows() ? unobstructed(world_, ray, media, colors_, sample_) : whole(colors_);
  const double turned = phase(glm::dot(sample.direction, along), medium.forward);
  const double weight = sample.density > 0 ? power_heuristic(chosen->probability * sample.density, turned) : 1;
  add(static_cast<float>(weight * turned / chosen->probability) *
      (visible * light_of(lamp, sample.irradiance, colors_)));
}

void PathTracer::trace(Ray ray, Hit hit) {
  Media media = media_at_origin(world_, ray, wavelengths_);
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    if (pass > 0 && !world_.nearest(ray, hit)) hit.instance = -1;
    const Medium medium = media.current();
    const double end = hit.instance < 0 ? kInfinity : hit.t;
    add_lamps_along(ray, end, media);
    const bool scatters = !medium.scattering.is_zero();
    if (scatters && is_scattered(ray, end, medium, media)) {
      if (scatterings_ > options_.max_scatterings) return;
      const double life = std::clamp(kDimWalk * static_cast<double>(share_.largest()), kMinLife, 1.0);
      if (random_.next_pair().x >= life) return;
      share_ *= static_cast<float>(1 / life);
      continue;
    }
    if (share_.is_zero()) return;
    if (hit.instance < 0) {
      if (!scatters) share_ *= transmittance(medium.absorption, kInfinity);
      add_surroundings();
      return;
    }
    const Media around = media;
    std::optional<Boundary> met(std::in_place, world_, ray, hit, wavelengths_, media);
    if ((options_.dispersion || options_.spectral) && !one_wavelength_ && disperses(*met->material)) {
      take_one_wavelength();
      media = around;
      met.emplace(world_, ray, hit, wavelengths_, media);
    }
    const Boundary& seen = *met;
    if (!scatters) share_ *= transmittance(media.current().absorption, hit.t);
    way_ += hit.t;
    const Scattering scattering = seen.material->scattering(seen.point, colors_);
    if (seen.changes_filling && scattering.catches_shadows && seen.front && shown_) {
      if (bounces_ == 0) record(seen);
      add_caught_shadow(seen, matt_reflectance(scattering), media);
      return;
    }
    if (!seen.changes_filling || scattering.catches_shadows) {
      media = seen.behind;
      origin_.gone += hit.t;
      world_.leave(seen.far_side(), ray.direction, ray);
      continue;
    }
    if (bounces_ == 0 && !sample_.point) record(seen);
    if (!scattering.emission.is_zero()) {
      const Spectrum light = static_cast<float>(weight_of_glow(seen.point)) * scattering.emission;
      add(light, 0, bounces_ == 1 && !origin_.sharp);
    }
    if (!seen.front && !scattering.two_sided) return;
    const Vec3 normal = seen.shading_normal(ray.direction);
    const Sides sides{media.current().index, seen.behind.current().index};
    if (bounces_ > options_.max_depth || scatterings_ > options_.max_scatterings) {
      // The last direction ends here, but for what comes straight through, which is its light as much as a lamp's.
      share_ *= straight_share(scattering, std::fabs(glm::dot(ray.direction, normal)), sides);
      if (share_.is_zero()) return;
      media = seen.behind;
      origin_.gone += hit.t;
      world_.leave(seen.far_side(), ray.direction, ray);
      continue;
    }
    const Bsdf bsdf(scattering, normal, seen.geometric_normal(), seen.point.du, -ray.direction, sides);
    if (bsdf.is_black()) return;
    if (bsdf.has_spread()) {
      const Vec2 lamp_choice = random_.next_sobol_pair(), lamp_square = random_.next_sobol_pair();
      add_lamp(seen, bsdf, media, lamp_choice, lamp_square);
      if (caustics_) add_caustic(seen, bsdf);
    } else {
      random_.skip_pairs(2);
    }
    const Vec2 lobe_choice = random_.next_sobol_pair(), lobe_square = random_.next_sobol_pair();
    const std::optional<BsdfSample> next = bsdf.sample(lobe_choice, lobe_square);
    if (!next) return;
    share_ *= next->share;
    ++sample_.other_rays;
    const bool straight = next->sharp && glm::dot(next->in, ray.direction) > 1 - 1e-14;
    if (straight) {  // for lamps as if nothing had been there
      origin_.gone += hit.t;
    } else {
      if (next->sharp && bounces_ == 0) {
        first_passed_ = glm::dot(next->in, seen.geometric_normal()) < 0;
        first_matt_ = Spectrum();
      } else {
        note_first(seen, bsdf, next->in);
      }
      ++bounces_;
      scatterings_ += !next->sharp;
      shown_ = shown_ && next->sharp;
      origin_.eye = false;
      origin_.sharp = next->sharp;
      origin_.in_medium = false;
      if (!next->sharp) origin_.gathered = caustics_ != nullptr;
      origin_.point = seen.point.position;
      origin_.density = next->density;
      origin_.gone = 0;
      origin_.choices.swap(choices_);
      if (bounces_ > kSafeBounces) {
        const double life = chance_to_live(static_cast<double>(share_.largest()));
        if (lobe_choice.y >= life) return;
        share_ *= static_cast<float>(1 / life);
      }
    }
    const bool passes = glm::dot(next->in, seen.geometric_normal()) < 0;
    if (passes) media = seen.behind;
    world_.leave(passes ? seen.far_side() : seen.near_side(), next->in, ray);
    ray.direction = next->in;
    ray.t_max = kInfinity;
    if (!origin_.eye) ray.kind = RayKind::reflection;
  }
}

}  // namespace

RaySample trace_path(const World& world, const Ray& ray, const Hit& first, SampleStream& random,
                     const PathOptions& options, const Caustics* caustics, const LightTree* tree, bool tell_parts) {
  RaySample sample;
  const auto parts = tell_parts ? std::make_shared<LightParts>() : nullptr;
  PathTracer tracer(world, random, options, caustics, tree, sample, parts.get());
  tracer.trace(ray, first);
  sample.parts = parts;
  return sample;
}

}  // namespace lekalo::render
