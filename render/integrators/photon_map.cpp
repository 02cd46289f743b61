#include "render/integrators/photon_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace lekalo::render {

namespace {

constexpr size_t kNear = 60;                          // photons within the radius of one in the middle of the crowd
constexpr size_t kProbes = 101;                       // of which the middle one decides
constexpr double kMinShare = 1e-5, kMaxShare = 0.05;  // radius over the size of the box of all photons

// Distance to the kNear-th neighbour, of the middle one of some photons.
double usual_distance(const std::vector<Photon>& photons) {
  geometry::Box3 box;
  for (const Photon& photon : photons) box.include(photon.position);
  const double size = std::max(box.diameter(), 1e-300);
  const size_t near = std::min(kNear, photons.size() - 1), probes = std::min(kProbes, photons.size());
  std::vector<double> found(probes);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, probes), [&](const tbb::blocked_range<size_t>& range) {
    std::vector<double> squares(photons.size());
    for (size_t probe = range.begin(); probe < range.end(); ++probe) {
      const Vec3 place = photons[probe * photons.size() / probes].position;
      for (size_t i = 0; i < photons.size(); ++i) {
        const Vec3 off = photons[i].position - place;
        squares[i] = glm::dot(off, off);
      }
      std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(near), squares.end());
      found[probe] = std::sqrt(squares[near]);
    }
  });
  std::nth_element(found.begin(), found.begin() + found.size() / 2, found.end());
  return std::clamp(found[found.size() / 2], kMinShare * size, kMaxShare * size);
}

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
  if (photons_.empty()) return;
  radius_ = usual_distance(photons_);
  begins_.assign(std::bit_ceil(photons_.size()) + 1, 0);
  for (const Photon& photon : photons_) ++begins_[bucket_of(cell_of(photon.position)) + 1];
  for (size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  // Each photon to its place, without a second copy of all.
  std::vector<uint32_t> next(begins_.begin(), begins_.end() - 1), places(photons_.size());
  for (size_t i = 0; i < photons_.size(); ++i) places[i] = next[bucket_of(cell_of(photons_[i].position))]++;
  for (size_t i = 0; i < photons_.size(); ++i)
    while (places[i] != i) {
      const size_t place = places[i];
      std::swap(photons_[i], photons_[place]);
      std::swap(places[i], places[place]);
    }
}

}  // namespace lekalo::render
