// Triangles in a ROBUST Embree scene and bare loops over it: what every ratio of the benchmarks is taken against.
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "geometry/mesh.h"
#include "render/ray.h"

namespace lekalo::benchmarks {

// A ray as Embree takes it.
struct FloatRay {
  float origin[3], direction[3], end;
};
std::vector<FloatRay> in_float(std::span<const render::Ray> rays, const geometry::Vec3& center);

// One triangle geometry in coordinates relative to `center`.
class BareScene {
 public:
  BareScene(const geometry::Mesh& mesh, const geometry::Vec3& center);
  ~BareScene();
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  // Numbers of rays that meet a triangle; `coherent` sets Embree's flag.
  size_t nearest(std::span<const FloatRay> rays, bool coherent) const;
  size_t occluded(std::span<const FloatRay> rays, bool coherent) const;
  size_t memory() const { return bytes_; }  // that Embree holds

 private:
  size_t bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace lekalo::benchmarks
