// Camera rays to a scene's meshes: the World's nearest hit in double precision against a bare loop over rtcIntersect1
// with a ROBUST scene of the same triangles and the same rays.
//
//   visibility_benchmark SCENE RUNS
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "geometry/bodies/sew.h"
#include "geometry/mesh.h"
#include "geometry/tessellation/tessellate.h"
#include "render/scene/load.h"
#include "render/trace/world.h"

using namespace lekalo;

namespace {

constexpr int kWidth = 1280, kHeight = 960, kThreads = 2;

// Seconds that `work(y)` takes over all rows, shared by two threads.
template <class Work>
double time_rows(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> threads;
  for (int k = 0; k < kThreads; ++k)
    threads.emplace_back([&, k] {
      for (int y = k; y < kHeight; y += kThreads) work(y);
    });
  for (std::thread& thread : threads) thread.join();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Bare {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  ~Bare() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  void add(const geometry::Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.points.size()));
    for (const geometry::Vec3& p : mesh.points)
      for (int i = 0; i < 3; ++i) *points++ = static_cast<float>(p[i]);
    auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(uint32_t), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles)
      for (const int corner : triangle.point) *corners++ = static_cast<uint32_t>(corner);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  void commit() {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: visibility_benchmark SCENE RUNS\n");
    return 2;
  }
  render::LoadedScene scene = render::load_scene(argv[1], {});
  auto model = std::make_shared<render::Model>(*scene.model);
  model->film.width = kWidth;
  model->film.height = kHeight;
  model->camera = scene.model->make_camera(kWidth, kHeight);
  // The bounded shapes as triangles, the same for both.
  Bare bare;
  std::vector<render::Object> objects;
  size_t triangles = 0;
  for (const render::Object& object : model->objects) {
    const auto* set = std::get_if<render::SurfaceSet>(&object.shape);
    if (!set) continue;
    const double size = geometry::bounds(*set->front()).diameter();
    geometry::TessellationTolerance tolerance;
    tolerance.sag = 1e-4 * size;
    render::Object as_mesh = object;
    auto mesh = std::make_shared<geometry::Mesh>(geometry::tessellate(geometry::sew(*set), tolerance));
    triangles += mesh->triangles.size();
    bare.add(*mesh);
    as_mesh.shape = geometry::MeshPtr(mesh);
    objects.push_back(as_mesh);
  }
  bare.commit();
  model->objects = objects;
  const render::World world(model);

  std::vector<render::Ray> rays;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) rays.push_back(model->camera->ray(x + 0.5, y + 0.5));

  double ours = 1e30, theirs = 1e30;
  std::vector<int> hits(kHeight), bare_hits(kHeight);
  for (int run = 0; run < std::atoi(argv[2]); ++run) {
    theirs = std::min(theirs, time_rows([&](int y) {
                        int count = 0;
                        for (int x = 0; x < kWidth; ++x) {
                          const render::Ray& r = rays[static_cast<size_t>(y) * kWidth + x];
                          RTCIntersectContext context;
                          rtcInitIntersectContext(&context);
                          RTCRayHit hit{};
                          hit.ray.org_x = static_cast<float>(r.origin.x);
                          hit.ray.org_y = static_cast<float>(r.origin.y);
                          hit.ray.org_z = static_cast<float>(r.origin.z);
                          hit.ray.dir_x = static_cast<float>(r.direction.x);
                          hit.ray.dir_y = static_cast<float>(r.direction.y);
                          hit.ray.dir_z = static_cast<float>(r.direction.z);
                          hit.ray.tfar = INFINITY;
                          hit.ray.mask = ~0u;
                          hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                          rtcIntersect1(bare.scene, &context, &hit);
                          count += hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
                        }
                        bare_hits[y] = count;
                      }));
    ours = std::min(ours, time_rows([&](int y) {
                      int count = 0;
                      render::Hit hit;
                      for (int x = 0; x < kWidth; ++x)
                        count += world.nearest(rays[static_cast<size_t>(y) * kWidth + x], hit);
                      hits[y] = count;
                    }));
  }
  long total = 0, bare_total = 0;
  for (int y = 0; y < kHeight; ++y) total += hits[y], bare_total += bare_hits[y];
  fmt::print(
      "| triangles | rays | hits, Embree | hits, Lekalo | Embree, Mrays/s | Lekalo, Mrays/s | ratio |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n"
      "| {} | {} | {} | {} | {:.2f} | {:.2f} | **{:.2f}** |\n",
      triangles, rays.size(), bare_total, total, rays.size() / theirs / 1e6, rays.size() / ours / 1e6, theirs / ours);
  return 0;
}
