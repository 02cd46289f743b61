// One scene's rays: ours with complete hits in double (t, u, v, point, normal) against a bare loop over rtcIntersect1
// on triangles of the same shapes, the same rays, one thread each, processor time.
//
//   rays_benchmark CASE TEAPOT.yaml RUNS [SAG]     prints one JSON object
//
// SAG: of the triangles, as a part of the diameter; left out: a tenth of a pixel.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "bare_scene.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/tessellation/tessellate.h"
#include "ray_cases.h"
#include "render/trace/world.h"
#include "shape_mesh.h"
#include "timed.h"

using namespace lekalo;
using benchmarks::seconds;
using benchmarks::Timed;
using geometry::Mesh;
using geometry::Vec3;

namespace {

constexpr int kWidth = 960, kHeight = 720;
constexpr double kMeshPixels = 0.1;

void append(Mesh& all, const Mesh& part) {
  const auto points = static_cast<int32_t>(all.points.size()), normals = static_cast<int32_t>(all.normals.size()),
             parameters = static_cast<int32_t>(all.parameters.size());
  all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  all.normals.insert(all.normals.end(), part.normals.begin(), part.normals.end());
  all.parameters.insert(all.parameters.end(), part.parameters.begin(), part.parameters.end());
  for (Mesh::Triangle triangle : part.triangles) {
    for (int k = 0; k < 3; ++k) {
      triangle.point[k] += points;
      if (triangle.normal[k] >= 0) triangle.normal[k] += normals;
      if (triangle.parameter[k] >= 0) triangle.parameter[k] += parameters;
    }
    all.triangles.push_back(triangle);
  }
}

// Triangles of all bounded objects. `sag`: in parts of the diameter; 0: in pixels.
Mesh mesh_of(const render::Model& model, double sag) {
  Mesh all;
  const geometry::Box3 box = render::bounds(model);
  for (const render::Object& object : model.objects) {
    geometry::TessellationTolerance tolerance;
    tolerance.angle = 0.5 * geometry::kPi;
    if (sag > 0)
      tolerance.sag = sag * box.diameter();
    else
      tolerance.sag_at = [&](const Vec3& p) {
        return kMeshPixels * model.camera->pixel_size(object.transform.point(p));
      };
    Mesh mesh;
    if (const auto* set = std::get_if<render::SurfaceSet>(&object.shape)) {
      mesh = geometry::tessellate(geometry::sew(*set), tolerance);
    } else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&object.shape)) {
      mesh = geometry::tessellate(**surface, tolerance);
    } else if (const auto* body = std::get_if<geometry::BodyPtr>(&object.shape)) {
      mesh = geometry::tessellate(**body, tolerance);
    } else if (const auto* shape = std::get_if<geometry::ShapePtr>(&object.shape)) {
      // Cubes as large as a surface of the box's own curvature lets them be for that sag.
      const double at = sag > 0 ? tolerance.sag : tolerance.sag_at((*shape)->bounds().center());
      const double size = (*shape)->bounds().diameter();
      mesh = benchmarks::marching_mesh(**shape, std::clamp(static_cast<int>(std::sqrt(size / at)), 32, 320));
    }
    append(all, object.transform.is_identity() ? mesh : transformed(mesh, object.transform));
  }
  return all;
}

struct Rays {
  std::vector<render::Ray> primary, shadow, incoherent;
};

Rays rays_of(const render::Model& model, const render::World& world) {
  Rays rays;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const Vec3 lamp = world.center() + 3 * world.radius() * glm::normalize(Vec3(-0.4, -0.5, 0.8));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      rays.primary.push_back(model.camera->ray(x + 0.5, y + 0.5));
      const render::Ray& ray = rays.primary.back();
      render::Hit hit;
      if (!world.nearest(ray, hit)) continue;
      const render::SurfacePoint point = world.surface_point(ray, hit);
      const Vec3 side =
          glm::dot(point.geometric_normal, ray.direction) < 0 ? point.geometric_normal : -point.geometric_normal;
      render::Ray next;
      // Far enough off for the triangles too.
      next.origin = point.position + 1e-3 * world.radius() * side;
      const Vec3 to_lamp = lamp - next.origin;
      if (glm::dot(to_lamp, side) > 0) {
        next.direction = glm::normalize(to_lamp);
        next.t_max = glm::length(to_lamp);
        next.kind = render::RayKind::shadow;
        rays.shadow.push_back(next);
      }
      Vec3 any(normal(random), normal(random), normal(random));
      any = glm::normalize(any);
      next.direction = glm::dot(any, side) < 0 ? -any : any;
      next.t_max = geometry::kInfinity;
      next.kind = render::RayKind::reflection;
      rays.incoherent.push_back(next);
    }
  return rays;
}

// Rays that are asked together, so few that their hits stay in the cache.
constexpr size_t kTogether = 256;

size_t nearest(const render::World& world, std::span<const render::Ray> rays) {
  size_t count = 0;
  double sum = 0;  // so that the compiler keeps the points
  render::Hit hits[kTogether];
  for (size_t first = 0; first < rays.size(); first += kTogether) {
    const std::span<const render::Ray> some = rays.subspan(first, std::min(kTogether, rays.size() - first));
    world.nearest(some, std::span(hits, some.size()));
    for (size_t i = 0; i < some.size(); ++i) {
      if (hits[i].instance < 0) continue;
      ++count;
      sum += world.surface_point(some[i], hits[i]).normal.z;
    }
  }
  if (!std::isfinite(sum)) fmt::print(stderr, "a normal is not a number\n");
  return count;
}

size_t occluded(const render::World& world, std::span<const render::Ray> rays) {
  size_t count = 0;
  bool hidden[kTogether];
  for (size_t first = 0; first < rays.size(); first += kTogether) {
    const std::span<const render::Ray> some = rays.subspan(first, std::min(kTogether, rays.size() - first));
    world.occluded(some, {}, std::span(hidden, some.size()));
    count += static_cast<size_t>(std::count(hidden, hidden + some.size(), true));
  }
  return count;
}

// One kind of rays on all three.
std::string race(const char* name, const benchmarks::BareScene& bare, const render::World& direct,
                 const render::World* meshes, std::span<const render::Ray> rays, int runs, bool occlusion) {
  const std::vector<benchmarks::FloatRay> floats = benchmarks::in_float(rays, direct.center());
  Timed coherent, incoherent, ours, mesh;
  for (int run = 0; run < runs; ++run) {
    coherent.run([&] { return occlusion ? bare.occluded(floats, true) : bare.nearest(floats, true); });
    incoherent.run([&] { return occlusion ? bare.occluded(floats, false) : bare.nearest(floats, false); });
    ours.run([&] { return occlusion ? occluded(direct, rays) : nearest(direct, rays); });
    if (meshes) mesh.run([&] { return occlusion ? occluded(*meshes, rays) : nearest(*meshes, rays); });
  }
  const double count = static_cast<double>(rays.size()), theirs = std::min(coherent.least(), incoherent.least());
  return fmt::format(
      "\"{}\": {{\"rays\": {}, \"hit_share\": {:.4f}, \"bare_hit_share\": {:.4f}, \"bare\": {:.4f}, \"direct\": "
      "{:.4f}, "
      "\"mesh\": {:.4f}}}",
      name, rays.size(), ours.result() / count, incoherent.result() / count, 1e-6 * count / theirs,
      1e-6 * count / ours.least(), meshes ? 1e-6 * count / mesh.least() : 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    fmt::print(stderr, "usage: rays_benchmark CASE TEAPOT.yaml RUNS [SAG]\n");
    return 2;
  }
  const int runs = std::atoi(argv[3]);
  const double sag = argc == 5 ? std::atof(argv[4]) : 0;
  const auto model = benchmarks::ray_case(argv[1], argv[2], kWidth, kHeight);

  { const render::World warm(std::make_shared<render::Model>()); }  // Embree's device and its threads
  double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
  const render::World direct(model);
  const double direct_cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  const size_t direct_bytes = direct.statistics().bytes + direct.statistics().hierarchy_bytes;

  cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
  auto mesh = std::make_shared<Mesh>(mesh_of(*model, sag));
  const benchmarks::BareScene bare(*mesh, direct.center());
  const double mesh_cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  const size_t bare_bytes = bare.memory();

  auto as_mesh = std::make_shared<render::Model>(*model);
  as_mesh->objects.resize(1);
  as_mesh->objects[0].shape = geometry::MeshPtr(mesh);
  as_mesh->objects[0].transform = {};
  const render::World meshes(as_mesh);

  const Rays rays = rays_of(*model, direct);
  fmt::print(
      "{{\"pieces\": {}, \"triangles\": {}, \"direct_build\": {:.4f}, \"direct_wall\": {:.4f}, \"mesh_build\": {:.4f}, "
      "\"direct_bytes\": {}, \"bare_bytes\": {}",
      direct.statistics().pieces, mesh->triangles.size(), direct_cpu, direct.statistics().build_seconds, mesh_cpu,
      direct_bytes, bare_bytes);
  fmt::print(", {}", race("primary", bare, direct, &meshes, rays.primary, runs, false));
  fmt::print(", {}", race("shadow", bare, direct, &meshes, rays.shadow, runs, true));
  fmt::print(", {}}}\n", race("incoherent", bare, direct, &meshes, rays.incoherent, runs, false));
  return 0;
}
