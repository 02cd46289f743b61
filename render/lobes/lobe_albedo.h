// Share E of the light that a rough reflecting surface sends back in one bounce, by the viewer's direction, from a
// table that is made by quadrature when it is first asked for.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "render/lobes/lobe.h"

namespace lekalo::render {

class LobeAlbedo {
 public:
  // `at`: E from a direction of the upper half space. `round`: it is the same all about the normal; otherwise it has
  // the planes x = 0 and y = 0 as planes of symmetry.
  LobeAlbedo(std::function<double(const Vec3& out)> at, bool round) : exact_(std::move(at)), round_(round) {}

  double at(const Vec3& out) const;
  double mean() const;  // over the cosine: integral of E cos / pi over the half space

 private:
  static constexpr int kHeights = 64;  // entries at cos = (i / (kHeights - 1))^2
  static constexpr int kTurns = 9;     // and at angles j / (kTurns - 1) pi / 2 from x
  int turns() const { return round_ ? 1 : kTurns; }
  void fill() const;
  double between(int turn, double root) const;

  std::function<double(const Vec3& out)> exact_;
  bool round_;
  mutable std::once_flag filled_;
  mutable std::vector<float> table_;
  mutable double mean_ = 0;
};
using LobeAlbedoPtr = std::shared_ptr<const LobeAlbedo>;

// Of GGX mirrors without loss; of a rough coat of a relative index in air; of cloth (SheenLobe) of colour 1.
LobeAlbedoPtr mirror_albedo(double roughness, double anisotropy = 0);
LobeAlbedoPtr coat_albedo(double roughness, double index);
LobeAlbedoPtr sheen_albedo(double roughness);

// The tables of a roughness that varies over a surface: it is rounded to one of some levels.
class AlbedoLevels {
 public:
  explicit AlbedoLevels(const std::function<LobeAlbedoPtr(double roughness)>& make);
  static double rounded(double roughness);
  const LobeAlbedo& operator[](double rounded_roughness) const;

 private:
  static constexpr int kLevels = 64;
  std::array<LobeAlbedoPtr, kLevels + 1> levels_;
};

}  // namespace lekalo::render
