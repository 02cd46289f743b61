#include "bare_scene.h"

#include <cmath>

namespace lekalo::benchmarks {

using geometry::Vec3;

std::vector<FloatRay> in_float(std::span<const render::Ray> rays, const Vec3& center) {
  std::vector<FloatRay> result;
  result.reserve(rays.size());
  for (const render::Ray& ray : rays) {
    const Vec3 o = ray.origin - center;
    FloatRay r{};
    for (int k = 0; k < 3; ++k) {
      r.origin[k] = static_cast<float>(o[k]);
      r.direction[k] = static_cast<float>(ray.direction[k]);
    }
    r.end = ray.t_max < 1e30 ? static_cast<float>(ray.t_max) : INFINITY;
    result.push_back(r);
  }
  return result;
}

BareScene::BareScene(const geometry::Mesh& mesh, const Vec3& center) : device_(rtcNewDevice("threads=2")) {
  rtcSetDeviceMemoryMonitorFunction(
      device_,
      [](void* counted, ssize_t bytes, bool) {
        *static_cast<size_t*>(counted) += static_cast<size_t>(bytes);
        return true;
      },
      &bytes_);
  scene_ = rtcNewScene(device_);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh.points.size()));
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) *points++ = static_cast<float>(p[k] - center[k]);
  auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(uint32_t), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle.point) *corners++ = static_cast<uint32_t>(corner);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(scene_);
}

BareScene::~BareScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

namespace {

void fill(RTCRay& to, const FloatRay& from) {
  to.org_x = from.origin[0], to.org_y = from.origin[1], to.org_z = from.origin[2];
  to.dir_x = from.direction[0], to.dir_y = from.direction[1], to.dir_z = from.direction[2];
  to.tfar = from.end;
  to.mask = ~0u;
}

RTCIntersectContext context_for(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

size_t BareScene::nearest(std::span<const FloatRay> rays, bool coherent) const {
  RTCIntersectContext context = context_for(coherent);
  size_t count = 0;
  for (const FloatRay& ray : rays) {
    RTCRayHit hit{};
    fill(hit.ray, ray);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &hit);
    count += hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  return count;
}

size_t BareScene::occluded(std::span<const FloatRay> rays, bool coherent) const {
  RTCIntersectContext context = context_for(coherent);
  size_t count = 0;
  for (const FloatRay& ray : rays) {
    RTCRay r{};
    fill(r, ray);
    rtcOccluded1(scene_, &context, &r);
    count += r.tfar < 0;
  }
  return count;
}

}  // namespace lekalo::benchmarks
