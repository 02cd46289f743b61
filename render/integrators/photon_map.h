// Photons where they lie: light that mirrors and smooth boundaries have thrown on surfaces that spread it (Jensen,
// "Global illumination using photon maps", 1996). The radiance towards a viewer at a point p is about
//
//   sum over photons within r of p:  f(in, out) power K(d) ,   K(d) = 2 / (pi r^2) (1 - d^2 / r^2),
//
// with the kernel of Epanechnikov, whose integral over a plane is 1: light is moved by less than r, none is lost but at
// edges, creases and strong bends.
#pragma once

#include <cstdint>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

struct Photon {
  Vec3 position{0};
  Vec3 from{0, 0, 1};    // unit, to where it came from
  Vec3 normal{0, 0, 1};  // unit, of the surface, on the side that it met
  Spectrum power;        // flux
  int group = 0;         // of its lamp (LightParts)
};

class PhotonMap {
 public:
  // Photons in the order in which they are to be summed. Chooses the radius so that about half of them have kNear
  // others within it; none at all need none.
  explicit PhotonMap(std::vector<Photon> photons);

  double radius() const { return radius_; }
  const std::vector<Photon>& photons() const { return photons_; }

  // visit(photon, K) for those on the surface of that normal that count at the point, always in the same order.
  template <class Visit>
  void each_near(const Vec3& point, const Vec3& normal, const Visit& visit) const {
    if (photons_.empty()) return;
    const double square = radius_ * radius_;
    const Cell cell = cell_of(point);
    for (int64_t z = cell.z - 1; z <= cell.z + 1; ++z)
      for (int64_t y = cell.y - 1; y <= cell.y + 1; ++y)
        for (int64_t x = cell.x - 1; x <= cell.x + 1; ++x) {
          const Cell other{x, y, z};
          const size_t bucket = bucket_of(other);
          for (uint32_t i = begins_[bucket]; i < begins_[bucket + 1]; ++i) {
            const Photon& photon = photons_[i];
            const Vec3 off = photon.position - point;
            const double distance = glm::dot(off, off);
            if (distance >= square || !(cell_of(photon.position) == other)) continue;
            if (glm::dot(photon.normal, normal) < kSameSurface || std::fabs(glm::dot(off, normal)) > kFlat * radius_)
              continue;
            visit(photon, 2 / (geometry::kPi * square) * (1 - distance / square));
          }
        }
  }

 private:
  struct Cell {
    int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  // Photons of walls and edges beside the surface do not count on it: cosine of the normals, and height above the plane
  // over r.
  static constexpr double kSameSurface = 0.7, kFlat = 0.3;

  Cell cell_of(const Vec3& p) const {
    const Vec3 q = glm::floor(p / radius_);
    return {static_cast<int64_t>(q.x), static_cast<int64_t>(q.y), static_cast<int64_t>(q.z)};
  }
  size_t bucket_of(const Cell& cell) const {
    const uint64_t key = static_cast<uint64_t>(cell.x) * 73856093u ^ static_cast<uint64_t>(cell.y) * 19349663u ^
                         static_cast<uint64_t>(cell.z) * 83492791u;
    return (key ^ (key >> 32)) & (begins_.size() - 2);
  }

  std::vector<Photon> photons_;   // by bucket
  std::vector<uint32_t> begins_;  // of the buckets, a power of two of them, and the end
  double radius_ = 0;
};

}  // namespace lekalo::render
