#include "render/integrators/caustics.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "render/integrators/boundary.h"
#include "render/integrators/dispersion.h"
#include "render/integrators/path_limits.h"
#include "render/integrators/phong_model.h"
#include "render/lights/lights.h"
#include "render/lobes/bsdf.h"
#include "render/lobes/microfacet.h"
#include "render/model/face_materials.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using geometry::kPi;

namespace {

// With more things that throw light they share one ball.
constexpr size_t kMaxBalls = 64;
// Share of light that a clear coat throws, against 1 of glass and metal; of the choice alone.
constexpr double kCoat = 0.05;
// Share of the choice of lamps and balls that does not look at how much light there is.
constexpr double kBlindChoice = 0.05;

// How much of the light a lobe throws in one direction, roughly.
double thrown_by(const Lobe& lobe, const Sides& sides) {
  if (const auto* metal = std::get_if<MetalLobe>(&lobe))
    return microfacets(metal->roughness, metal->anisotropy).smooth() ? 1 : 0;
  if (const auto* coat = std::get_if<CoatLobe>(&lobe)) return microfacets(coat->roughness, 0).smooth() ? kCoat : 0;
  if (const auto* matt = std::get_if<CoatedMattLobe>(&lobe))
    return microfacets(matt->coat.roughness, 0).smooth() ? kCoat : 0;
  if (const auto* boundary = std::get_if<BoundaryLobe>(&lobe))
    return !boundary->mirror.is_zero() || sides.behind != sides.near ? 1 : 0;
  if (const auto* clear = std::get_if<ClearLobe>(&lobe))
    return clear->thin ? kCoat : sides.behind != sides.near && microfacets(clear->roughness, 0).smooth() ? 1 : 0;
  return 0;
}

// Places of a shape as textures look at them: all over its parameters, or its box. Where the ranges of parameters are
// not known, some are in the unit square and some as far apart as the shape is wide.
std::vector<SurfacePoint> places_on(const Entity& shape) {
  constexpr int kPlaces = 128;
  geometry::Box3 box = bounds(shape);
  if (box.empty() || !box.bounded()) box = {Vec3(-10), Vec3(10)};
  geometry::Box3 uv;
  const auto include = [&](const geometry::Surface& surface) {
    const geometry::Rectangle domain = surface.domain();
    uv.include({domain.u.lo, domain.v.lo, 0});
    uv.include({domain.u.hi, domain.v.hi, 0});
  };
  if (const auto* surface = std::get_if<geometry::SurfacePtr>(&shape)) include(**surface);
  if (const auto* set = std::get_if<SurfaceSet>(&shape))
    for (const geometry::SurfacePtr& surface : *set) include(*surface);
  if (const auto* body = std::get_if<geometry::BodyPtr>(&shape))
    for (const auto& face : (*body)->faces) include(*face.surface);
  if (const auto* mesh = std::get_if<geometry::MeshPtr>(&shape))
    for (const Vec2& place : (*mesh)->parameters) uv.include(Vec3(place, 0));
  const bool known = !uv.empty() && uv.bounded();
  const double half = 0.5 * box.diameter();
  std::vector<SurfacePoint> places(kPlaces);
  for (int i = 0; i < kPlaces; ++i) {
    const geometry::Box3 range = known        ? uv
                                 : i % 2 == 0 ? geometry::Box3{Vec3(0), Vec3(1)}
                                              : geometry::Box3{Vec3(-half), Vec3(half)};
    // Evenly, by the powers of the inverse of the root of x^4 = x + 1.
    const Vec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    const Vec3 share = glm::fract(0.5 + static_cast<double>(i) * step), at = range.lo + share * range.size();
    places[static_cast<size_t>(i)].u = at.x, places[static_cast<size_t>(i)].v = at.y;
    places[static_cast<size_t>(i)].position = places[static_cast<size_t>(i)].smooth_position =
        box.lo + share * box.size();
  }
  return places;
}

double thrown_by(const Material& material, const SurfacePoint& place) {
  const auto medium = material.interior(Wavelengths{});
  const Sides sides{1, medium ? medium->index : 1.0};
  const Scattering scattering = material.scattering(place, Wavelengths{});
  double most = 0;
  for (const WeightedLobe& part : scattering.lobes)
    if (!part.weight.is_zero()) most = std::max(most, thrown_by(part.lobe, sides));
  return most;
}

double thrown_by(const Object& object) {
  double most = 0;
  for (const Material* material : materials_of(object)) {
    if (!material->uses_parameters()) {
      most = std::max(most, thrown_by(*material, {}));
      continue;
    }
    for (const SurfacePoint& place : places_on(object.shape)) {
      if (most >= 1) break;
      most = std::max(most, thrown_by(*material, place));
    }
  }
  return most;
}

struct Ball {
  Vec3 center;
  double radius, thrown;

  bool contains(const Vec3& p) const { return glm::dot(p - center, p - center) < radius * radius; }
  bool meets(const Ray& ray) const {
    if (contains(ray.origin)) return true;
    const Vec3 to = center - ray.origin;
    const double along = glm::dot(to, ray.direction);
    return along > 0 && glm::dot(to, to) - along * along < radius * radius;
  }
};

// Places on a ball, as close as the light of a lamp falls there if all of it came from one place: those of directions
// from it that are even in solid angle, or of parallel light even across. A few lie anywhere, where other places of the
// lamp look.
class Target {
 public:
  Target(const Ball& ball, const Light& lamp) : ball_(ball) {
    const LightSample light = lamp.sample_all(ball.center, Vec2(0.5));
    far_ = !std::isfinite(light.distance);
    axis_ = light.direction;
    if (far_) return;
    const geometry::Box3 places = lamp.places();
    place_ = places.bounded() ? 0.5 * (places.lo + places.hi) : ball.center + light.distance * light.direction;
    const double sine = ball.radius / glm::length(place_ - ball.center);
    within_ = !(sine < 1);
    height_ = within_ ? 2 : sine * sine / (1 + std::sqrt(1 - sine * sine));
  }

  // Unit, from the ball's centre.
  Vec3 sample(double choice, const Vec2& square) const {
    if (choice < kAnywhere) return on_sphere(2 * square.x, square.y, Vec3(0, 0, 1));
    if (far_) {
      const Vec2 disc = concentric_disc(square);
      const double z = std::sqrt(std::max(0.0, 1 - glm::dot(disc, disc)));
      return geometry::frame_about(Vec3(0), axis_).direction({disc.x, disc.y, z});
    }
    const Vec3 direction = on_sphere(height_ * square.x, square.y, -axis_), to = ball_.center - place_;
    const double along = glm::dot(to, direction), square_off = glm::dot(to, to) - along * along;
    const double half = std::sqrt(std::max(0.0, ball_.radius * ball_.radius - square_off));
    return glm::normalize(place_ + (within_ ? along + half : along - half) * direction - ball_.center);
  }
  // Per unit of area, of sample().
  double density(const Vec3& outward) const {
    const double square = ball_.radius * ball_.radius, anywhere = kAnywhere / (4 * kPi * square);
    if (far_) return anywhere + (1 - kAnywhere) * std::max(0.0, glm::dot(outward, axis_)) / (kPi * square);
    const Vec3 way = ball_.center + ball_.radius * outward - place_;
    const double distance = glm::length(way), cosine = glm::dot(way, outward) / distance * (within_ ? 1 : -1);
    const double of_place = std::max(0.0, cosine) / (distance * distance * geometry::kTwoPi * height_);
    return anywhere + (1 - kAnywhere) * of_place;
  }

 private:
  static constexpr double kAnywhere = 0.1;

  static Vec3 on_sphere(double height, double turn, const Vec3& axis) {
    const double s = std::sqrt(std::max(0.0, height * (2 - height))), angle = geometry::kTwoPi * turn;
    return geometry::frame_about(Vec3(0), axis).direction({s * std::cos(angle), s * std::sin(angle), 1 - height});
  }

  const Ball& ball_;
  bool far_ = false, within_ = false;
  Vec3 axis_{0, 0, 1}, place_{0};  // to the lamp; of it
  double height_ = 2;              // 1 - the cosine of half the cone in which the place sees the ball
};

// Around what throws light. Groups are asked once each: they may place more than can be visited.
class ThrownBox {
 public:
  geometry::Box3 of(const std::vector<Object>& objects) {
    geometry::Box3 box;
    for (const Object& object : objects) {
      const auto* group = std::get_if<GroupPtr>(&object.shape);
      const geometry::Box3 own = group ? of(**group) : thrown_by(object) > 0 ? bounds(object.shape) : geometry::Box3();
      if (!own.empty()) box.include(transformed(own, object.transform));
    }
    return box;
  }

 private:
  geometry::Box3 of(const Group& group) {
    const auto known = of_groups_.find(&group);
    if (known != of_groups_.end()) return known->second;
    const geometry::Box3 box = of(group.objects);
    of_groups_.emplace(&group, box);
    return box;
  }

  std::unordered_map<const Group*, geometry::Box3> of_groups_;
};

// None at all where something without bounds throws light.
std::vector<Ball> balls_of(const World& world) {
  const PlacedObjects placed(world.model().objects, [](const Object& object) { return thrown_by(object) > 0; });
  const bool shared = placed.count() > kMaxBalls;
  std::vector<Ball> balls;
  bool bounded = true;
  const auto add = [&](const geometry::Box3& box, double thrown) {
    if (box.empty()) return;
    bounded = bounded && box.bounded();
    balls.push_back({0.5 * (box.lo + box.hi), std::max(0.5 * box.diameter(), 1e-300) * (1 + 1e-6), thrown});
  };
  if (shared) {
    add(ThrownBox().of(world.model().objects), 1);
  } else {
    placed.visit([&](const Object& object, const geometry::Affine& to_world, int) {
      add(transformed(bounds(object.shape), to_world), thrown_by(object));
    });
  }
  return bounded ? balls : std::vector<Ball>();
}

// Smooth skies light by chance well enough, and would take all photons.
bool sends_photons(const Light& lamp) {
  const std::any made = lamp.made_from();
  return lamp.casts_shadows() && !std::any_cast<EnvironmentLight>(&made);
}

// How much brighter photons of a lamp whose light does not fall off count than they were sent: they thin out as the
// square of the distance from the place that the law is about, or from that of its picture in mirrors and glass.
struct Spread {
  Vec3 to_ray{0};        // from that place to the photon's ray, at right angles
  double along = 0;      // from there to the ray's beginning
  double at_target = 0;  // square of the distance where the power was asked for; 0: the light falls off

  double after(double way) const {
    return at_target > 0 ? (glm::dot(to_ray, to_ray) + (along + way) * (along + way)) / at_target : 1;
  }
};

// The laws of lamps by distance: true where they give the same light at all of them.
template <class... Lamps>
bool is_even(const std::any& made) {
  const auto says_so = [](const auto* light) { return light && !light->lamp.inverse_square; };
  return (says_so(std::any_cast<Lamps>(&made)) || ...);
}
bool is_even(const Light& lamp) {
  return is_even<PointLight, SpotLight, RectangleLight, DiscLight, SphereLight, ProfileLight>(lamp.made_from());
}

// Of the ray from the lamp to the target. A ball's law is about its centre, that of others about each place of them.
Spread spread_of(const Light& lamp, const Ray& ray, const Vec3& target) {
  const std::any made = lamp.made_from();
  const auto* ball = std::any_cast<SphereLight>(&made);
  const Vec3 place = ball ? ball->center : ray.origin, from = ray.origin - place;
  const double along = glm::dot(from, ray.direction);
  return {from - along * ray.direction, along, glm::dot(target - place, target - place)};
}

// What a photon may begin with.
struct Start {
  size_t lamp, ball;
  double probability;
};

std::vector<Start> starts(const World& world, const std::vector<Ball>& balls) {
  std::vector<Start> list;
  double sum = 0;
  for (size_t i = 0; i < world.lamps().size(); ++i) {
    if (!sends_photons(*world.lamps()[i])) continue;
    for (size_t k = 0; k < balls.size(); ++k) {
      const LightSample light = world.lamps()[i]->sample_all(balls[k].center, Vec2(0.5));
      double power = balls[k].thrown * balls[k].radius * balls[k].radius * light.irradiance.largest();
      if (!std::isfinite(power)) power = 0;
      list.push_back({i, k, power});
      sum += power;
    }
  }
  const double n = static_cast<double>(list.size());
  for (Start& start : list)
    start.probability = sum > 0 ? (1 - kBlindChoice) * start.probability / sum + kBlindChoice / n : 1 / n;
  return list;
}

class PhotonTracer {
 public:
  PhotonTracer(const World& world, const CausticOptions& options)
      : world_(world), options_(options), balls_(balls_of(world)), starts_(starts(world, balls_)) {}

  bool has_starts() const { return !starts_.empty(); }
  void trace(uint32_t number, std::vector<Photon>& landed) const;

 private:
  void follow(Ray ray, Spectrum power, const Spread& spread, int group, SampleStream& random,
              std::vector<Photon>& landed) const;

  const World& world_;
  const CausticOptions& options_;
  std::vector<Ball> balls_;
  std::vector<Start> starts_;
};

void PhotonTracer::trace(uint32_t number, std::vector<Photon>& landed) const {
  SampleStream random(0, 0, number, static_cast<uint32_t>(options_.photons), ~world_.model().film.seed);
  const Vec2 choice = random.next_sobol_pair(), on_ball = random.next_sobol_pair(), on_lamp = random.next_sobol_pair();
  double place = choice.x;
  size_t s = 0;
  while (s + 1 < starts_.size() && place >= starts_[s].probability) place -= starts_[s++].probability;
  const Ball& ball = balls_[starts_[s].ball];
  const Light& lamp = *world_.lamps()[starts_[s].lamp];
  const Target target(ball, lamp);
  const Vec3 outward = target.sample(choice.y, on_ball);
  const Vec3 point = ball.center + ball.radius * outward;
  const LightSample light = lamp.sample_all(point, on_lamp);
  if (light.irradiance.is_zero() || !light.irradiance.is_finite()) return;
  const bool far = !std::isfinite(light.distance);
  // Of what comes from far away nothing lies before the scene.
  const double way = far ? glm::length(point - world_.center()) + 1.01 * world_.radius() : light.distance;
  Ray ray;
  ray.origin = point + way * light.direction;
  ray.direction = -light.direction;
  ray.kind = RayKind::reflection;
  const bool within = !far && ball.contains(ray.origin);
  const double cosine = glm::dot(light.direction, outward) * (within ? -1 : 1);
  if (cosine <= 0) return;
  for (size_t k = 0; k < starts_[s].ball; ++k)
    if (balls_[k].meets(ray)) return;
  const auto share = static_cast<float>(cosine / (target.density(outward) * starts_[s].probability * options_.photons));
  const Spread spread = !far && is_even(lamp) ? spread_of(lamp, ray, point) : Spread();
  follow(ray, share * light.irradiance, spread, world_.lamp_groups()[starts_[s].lamp], random, landed);
}

void PhotonTracer::follow(Ray ray, Spectrum power, const Spread& spread, int group, SampleStream& random,
                          std::vector<Photon>& landed) const {
  Media media = media_at_origin(world_, ray, kYellow);
  Wavelengths wavelengths = kYellow;
  const float begun = power.largest();
  bool one_wavelength = false;
  int bounces = 0;
  double way = 0;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    Hit hit;
    if (!world_.nearest(ray, hit)) return;
    const Media around = media;
    std::optional<Boundary> met(std::in_place, world_, ray, hit, wavelengths, media);
    if (options_.dispersion && !one_wavelength && disperses(*met->material)) {
      const WavelengthSample taken = sample_wavelength(random.next_sobol_pair().x);
      power *= taken.share;
      wavelengths.nanometres.fill(taken.nanometres);
      one_wavelength = true;
      media = around;
      met.emplace(world_, ray, hit, wavelengths, media);
    }
    const Boundary& seen = *met;
    power *= transmittance(media.current().extinction(), hit.t);
    way += hit.t;
    const Scattering scattering = seen.material->scattering(seen.point, kPrimaries);
    if (!seen.changes_filling || scattering.catches_shadows) {
      media = seen.behind;
      world_.leave(seen.far_side(), ray.direction, ray);
      continue;
    }
    if (!seen.front && !scattering.two_sided) return;
    const Sides sides{media.current().index, seen.behind.current().index};
    const Bsdf bsdf(scattering, seen.shading_normal(ray.direction), seen.geometric_normal(), seen.point.du,
                    -ray.direction, sides);
    if (bsdf.is_black()) return;
    if (bounces > 0 && bsdf.has_spread()) {
      landed.push_back({seen.point.position, -ray.direction, seen.geometric_normal(),
                        static_cast<float>(spread.after(way)) * power, group});
    }
    const Vec2 choice = random.next_sobol_pair(), square = random.next_sobol_pair();
    const std::optional<BsdfSample> next = bsdf.sample(choice, square);
    if (!next || !next->sharp) return;  // what goes on spread is the business of paths from the eye
    power *= next->share;
    // Straight on through panes: for lamps as if nothing had been there. Light that happens to meet a boundary at a
    // right angle is not stopped by it, but refracted all the same.
    const bool straight =
        glm::dot(next->in, ray.direction) > 1 - 1e-14 &&
        !straight_share(scattering, std::fabs(glm::dot(ray.direction, bsdf.normal())), sides).is_zero();
    bounces += !straight;
    if (bounces > options_.max_depth) return;
    if (bounces > kSafeBounces) {
      const double life = chance_to_live(static_cast<double>(power.largest() / begun));
      if (choice.y >= life) return;
      power *= static_cast<float>(1 / life);
    }
    const bool passes = glm::dot(next->in, seen.geometric_normal()) < 0;
    if (passes) media = seen.behind;
    world_.leave(passes ? seen.far_side() : seen.near_side(), next->in, ray);
    ray.direction = next->in;
    ray.t_max = geometry::kInfinity;
  }
}

}  // namespace

bool throws_caustics(const Object& object) { return thrown_by(object) > 0; }

std::shared_ptr<const Caustics> trace_caustics(const World& world, const CausticOptions& options) {
  const PhotonTracer tracer(world, options);
  if (!tracer.has_starts()) return nullptr;
  // In runs, so that the order of photons is that of their numbers.
  constexpr int kRun = 4096;
  const int runs = (options.photons + kRun - 1) / kRun;
  std::vector<std::vector<Photon>> landed(static_cast<size_t>(runs));
  tbb::parallel_for(tbb::blocked_range<int>(0, runs, 1), [&](const tbb::blocked_range<int>& range) {
    for (int run = range.begin(); run < range.end(); ++run)
      for (int i = run * kRun; i < std::min((run + 1) * kRun, options.photons); ++i)
        tracer.trace(static_cast<uint32_t>(i), landed[static_cast<size_t>(run)]);
  });
  size_t count = 0;
  for (const std::vector<Photon>& some : landed) count += some.size();
  std::vector<Photon> all;
  all.reserve(count);
  for (std::vector<Photon>& some : landed) {
    all.insert(all.end(), some.begin(), some.end());
    some = {};
  }
  auto caustics = std::make_shared<Caustics>(Caustics{PhotonMap(std::move(all)), {}});
  for (const LightPtr& lamp : world.lamps()) caustics->of_lamp.push_back(sends_photons(*lamp));
  return caustics;
}

}  // namespace lekalo::render
