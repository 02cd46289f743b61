#include "render/integrators/photon_map.h"

#include <algorithm>
#include <bit>

namespace lekalo::render {

namespace {

constexpr size_t kNear = 60;                             // photons within the radius of one in the middle of the crowd
constexpr size_t kProbes = 101;                          // of which the middle one decides
constexpr double kLeastShare = 1e-5, kMostShare = 0.05;  // radius over the size of the box of all photons

// Distance to the kNear-th neighbour, of the middle one of some photons.
double usual_distance(const std::vector<Photon>& photons) {
  geometry::Box3 box;
  for (const Photon& photon : photons) box.include(photon.position);
  const double size = std::max(box.diameter(), 1e-300);
  const size_t near = std::min(kNear, photons.size() - 1), probes = std::min(kProbes, photons.size());
  std::vector<double> found, squares(photons.size());
  for (size_t probe = 0; probe < probes; ++probe) {
    const Vec3 place = photons[probe * photons.size() / probes].position;
    for (size_t i = 0; i < photons.size(); ++i) {
      const Vec3 off = photons[i].position - place;
      squares[i] = glm::dot(off, off);
    }
    std::nth_element(squares.begin(), squares.begin() + near, squares.end());
    found.push_back(std::sqrt(squares[near]));
  }
  std::nth_element(found.begin(), found.begin() + found.size() / 2, found.end());
  return std::clamp(found[found.size() / 2], kLeastShare * size, kMostShare * size);
}

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) {
  if (photons.empty()) return;
  radius_ = usual_distance(photons);
  begins_.assign(std::bit_ceil(photons.size()) + 1, 0);
  for (const Photon& photon : photons) ++begins_[bucket_of(cell_of(photon.position)) + 1];
  for (size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  photons_.resize(photons.size());
  std::vector<uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (const Photon& photon : photons) photons_[next[bucket_of(cell_of(photon.position))]++] = photon;
}

}  // namespace lekalo::render
