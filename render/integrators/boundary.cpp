#include "render/integrators/boundary.h"

#include <algorithm>

#include "geometry/tolerances.h"
#include "render/lobes/scattering.h"

namespace lekalo::render {

namespace {

// Where a ray meets a boundary at a flatter angle than of this sine, surfaces that lie on one another are looked for no
// further along it: it would take in what is really behind them.
constexpr double kFlattest = 1.0 / 64;

struct Crossing {
  double t;
  SurfacePoint point;
  bool front;
  const Material* material;      // of the side that is met
  std::optional<Medium> medium;  // of the body whose surface it is
};

// Length of the ray that is lost between a surface, which is met no more exactly than the ray's own places are known,
// and the place behind it where rays that leave it begin.
double lost_length(const Ray& ray, double t, const SurfacePoint& point) {
  const double place = geometry::kHitRounding * (glm::length(ray.origin) + std::abs(t));
  return (World::clearance(point) + place) /
         std::max(std::abs(glm::dot(ray.direction, point.geometric_normal)), kFlattest);
}

}  // namespace

bool Boundary::take_all(const World& world, const Ray& ray, const Hit& hit, const Wavelengths& wavelengths,
                        Media& media) {
  // Their room is kept. No ray is traced while they are in use.
  static thread_local std::vector<Hit> hits;
  static thread_local std::vector<Crossing> crossings;
  crossings.clear();
  crossings.push_back({hit.t, point, front, material, front_material_->interior(wavelengths)});
  Ray stretch = ray;
  // Of meshes the nearest hit is not always the first one.
  stretch.t_min = std::max(ray.t_min, hit.t - lost_length(ray, hit.t, point));
  double end = hit.t + lost_length(ray, hit.t, point);
  do {  // further, as long as something is found whose own neighbourhood goes on
    stretch.t_max = end;
    world.all_hits(stretch, hits);
    crossings.resize(1);
    bool has_met_first = false;
    for (const Hit& h : hits) {
      if (h.instance == hit.instance && !has_met_first) {
        has_met_first = true;
        continue;
      }
      Crossing c{h.t, world.surface_point(ray, h), false, nullptr, {}};
      c.front = glm::dot(ray.direction, c.point.geometric_normal) < 0;
      c.medium = world.material(c.point, true).interior(wavelengths);
      c.material = &world.material(c.point, c.front);
      // Not seen from behind.
      if (!c.front && c.material->scattering(c.point, wavelengths).catches_shadows) continue;
      end = std::max(end, h.t + lost_length(ray, c.t, c.point));
      crossings.push_back(c);
    }
  } while (end > stretch.t_max);
  if (crossings.size() == 1) return false;
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });

  // What lets no light through is all that is seen, and as from within what lies on it.
  for (const Crossing& c : crossings) {
    if (c.medium && c.material->transmits()) continue;
    others_.emplace(crossings.front().point, crossings.back().point);
    point = c.point;
    front = c.front;
    show(world);
    changes_filling = true;
    behind = media;
    return true;
  }

  // A body whose surface is crossed both ways here, at an edge, is left as it was.
  const auto turns = [&](int64_t instance) {
    int sum = 0;
    for (const Crossing& c : crossings)
      if (c.point.instance == instance) sum += c.front ? 1 : -1;
    return sum;
  };
  for (const Crossing& c : crossings)
    if (turns(c.point.instance) < 0 && !media.is_inside(c.point.instance)) media.enter(c.point.instance, *c.medium);
  behind = media;
  for (const Crossing& c : crossings)
    if (turns(c.point.instance) < 0) behind.leave(c.point.instance);
  for (const Crossing& c : crossings)
    if (turns(c.point.instance) > 0) behind.enter(c.point.instance, *c.medium);
  const int64_t before = media.filling(), after = behind.filling();
  changes_filling = before != after;

  // Of two bodies that touch the one of the higher priority shows its surface, of equal ones the earlier; so it is the
  // same one from both sides.
  const Crossing* shown = nullptr;
  for (const Crossing& c : crossings) {
    const int64_t body = c.point.instance;
    if (body != (c.front ? after : before) || (c.front ? turns(body) <= 0 : turns(body) >= 0)) continue;
    if (!shown || c.medium->priority > shown->medium->priority ||
        (c.medium->priority == shown->medium->priority && body < shown->point.instance))
      shown = &c;
  }
  others_.emplace(crossings.front().point, crossings.back().point);
  if (std::all_of(crossings.begin(), crossings.end(),
                  [&](const Crossing& c) { return turns(c.point.instance) == 0; })) {
    // Only edges are touched: no side of any of their faces is the one to go on from, but the place behind them is.
    SurfacePoint& behind_edges = others_->second;
    behind_edges.position = behind_edges.smooth_position = ray.origin + end * ray.direction;
    behind_edges.geometric_normal = ray.direction;
    behind_edges.instance = -1;
    behind_edges.convex_sides = {};
  }
  if (!shown) return true;
  point = shown->point;
  front = shown->front;
  show(world);
  return true;
}

Vec3 Boundary::shading_normal(const Vec3& direction) const {
  Vec3 normal = material->shading_normal(point);
  if (!front) normal = -normal;
  // Near the outline of a mesh it may look away from the viewer; then the facet's own is taken.
  return glm::dot(direction, normal) < 0 ? normal : geometric_normal();
}

Spectrum backdrop(const World& world, const Ray& ray) {
  for (const size_t i : world.backdrops())
    if (const std::optional<LightSample> seen = world.lamps()[i]->towards(ray.origin, ray.direction))
      return static_cast<float>(seen->density) * seen->irradiance;
  return world.model().background;
}

Media media_at_origin(const World& world, const Ray& ray, const Wavelengths& wavelengths) {
  Media media;
  if (!world.may_be_in_medium(ray.origin)) return media;
  std::vector<Hit> hits;
  world.all_hits(ray, hits);
  struct Body {
    int64_t instance;
    Medium medium;
    int turns = 0;   // entered or left, at the first place where it is crossed to one side
    double end = 0;  // of that place
  };
  std::vector<Body> bodies;  // the innermost first
  for (const Hit& hit : hits) {
    auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.instance == hit.instance; });
    if (body != bodies.end() && body->turns != 0 && hit.t > body->end) continue;
    const SurfacePoint point = world.surface_point(ray, hit);
    if (body == bodies.end()) {
      const auto medium = world.material(point, true).interior(wavelengths);
      if (!medium) continue;
      body = bodies.insert(body, Body{hit.instance, *medium});
    }
    body->turns += glm::dot(ray.direction, point.geometric_normal) < 0 ? 1 : -1;
    body->end = hit.t + lost_length(ray, hit.t, point);
  }
  for (auto body = bodies.rbegin(); body != bodies.rend(); ++body)
    if (body->turns < 0) media.enter(body->instance, body->medium);
  return media;
}

}  // namespace lekalo::render
