// What a surface does to light at a point: a sum of lobes.
#pragma once

#include <array>
#include <new>
#include <variant>

#include "render/lobes/classic_lobes.h"
#include "render/lobes/clear_lobe.h"
#include "render/lobes/coated_lobe.h"
#include "render/lobes/matt_lobes.h"
#include "render/lobes/metal_lobe.h"
#include "render/lobes/sheen_lobe.h"

namespace lekalo::render {

using Lobe = std::variant<LambertLobe, RoughMattLobe, SheetLobe, PhongLobe, BoundaryLobe, MetalLobe, ClearLobe,
                          CoatLobe, CoatedMattLobe, SheenLobe>;

// What lies over a lobe keeps from it the light that it sends back itself: the lobe is multiplied with
// min(T(out), T(in)), T = 1 - weight E by the angle, so that the whole reflects no more than what falls on it.
struct Cover {
  const LobeAlbedo* albedo = nullptr;  // E of the cover's own lobe at weight 1
  float weight = 0;

  float passes(const Vec3& out, const Vec3& in) const;
};

struct WeightedLobe {
  Lobe lobe;
  Spectrum weight{1.0f};
  std::array<Cover, 2> covers{};
  int cover_count = 0;

  float passes(const Vec3& out, const Vec3& in) const;  // of all covers
};

// A few lobes; room for more is not touched.
class LobeList {
 public:
  static constexpr int kMaxLobes = 12;

  LobeList() : count_(0) {}
  LobeList(const LobeList& other) : count_(0) { append(other, Spectrum(1.0f)); }
  LobeList& operator=(const LobeList& other) {
    if (this == &other) return *this;
    count_ = 0;
    append(other, Spectrum(1.0f));
    return *this;
  }

  // Nothing if the weight is zero, or the list full; mixes, which could fill it, are refused (materials/mix.cpp).
  template <class AnyLobe>
  void add(const AnyLobe& lobe, const Spectrum& weight = Spectrum(1.0f)) {
    if (count_ == kMaxLobes || weight.is_zero()) return;
    WeightedLobe* const place = ::new (&lobes_[count_]) WeightedLobe;
    place->lobe.template emplace<AnyLobe>(lobe);
    place->weight = weight;
    ++count_;
  }
  // Lays a lobe over all those of the list.
  template <class AnyLobe>
  void cover(const AnyLobe& lobe, const Spectrum& weight, const LobeAlbedo& albedo) {
    lay_over(albedo, weight.largest());
    add(lobe, weight);
  }
  void append(const LobeList& others, const Spectrum& weight);

  const WeightedLobe* begin() const { return lobes_.data(); }
  const WeightedLobe* end() const { return lobes_.data() + count_; }
  int size() const { return count_; }
  const WeightedLobe& operator[](int i) const { return lobes_[i]; }

 private:
  void lay_over(const LobeAlbedo& albedo, float weight);

  union {
    std::array<WeightedLobe, kMaxLobes> lobes_;  // not initialised: most of it is never used
  };
  int count_;
};

struct Scattering {
  LobeList lobes;
  Spectrum emission;                // radiance added whatever the light
  std::optional<Spectrum> ambient;  // share of the light of ambient lights that the matt lobes send back in the classic
                                    // model, where that is not what they reflect
  bool two_sided = true;            // false: the back shows only emission and ambient light
  bool catches_shadows = false;     // shows the background, darkened where lights do not reach; not seen from behind
  bool unbalanced = false;          // the lobes may send back more than what falls on them
};

// Share of the light that the matt lobes reflect: the albedo layer.
Spectrum matt_reflectance(const Scattering& scattering);

}  // namespace lekalo::render
