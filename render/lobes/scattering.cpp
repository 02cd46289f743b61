#include "render/lobes/scattering.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

float Cover::passes(const Vec3& out, const Vec3& in) const {
  const double more = std::max(albedo->at(out), albedo->at(in.z < 0 ? -in : in));
  return std::max(0.0f, 1 - weight * static_cast<float>(more));
}

float WeightedLobe::passes(const Vec3& out, const Vec3& in) const {
  float share = 1;
  for (int i = 0; i < cover_count; ++i) share *= covers[i].passes(out, in);
  return share;
}

void LobeList::lay_over(const LobeAlbedo& albedo, float weight) {
  if (weight == 0) return;
  for (int i = 0; i < count_; ++i) {
    WeightedLobe& below = lobes_[i];
    if (below.cover_count < static_cast<int>(below.covers.size()))
      below.covers[below.cover_count++] = {&albedo, weight};
  }
}

void LobeList::append(const LobeList& others, const Spectrum& weight) {
  for (const WeightedLobe& other : others) {
    if (count_ == kMaxLobes || weight.is_zero()) return;
    ::new (&lobes_[count_]) WeightedLobe(other);
    lobes_[count_++].weight *= weight;
  }
}

Spectrum matt_reflectance(const Scattering& scattering) {
  Spectrum sum;
  for (const WeightedLobe& part : scattering.lobes) {
    if (const auto* matt = std::get_if<LambertLobe>(&part.lobe)) sum += part.weight * matt->albedo;
    if (const auto* rough = std::get_if<RoughMattLobe>(&part.lobe)) sum += part.weight * rough->albedo;
    if (const auto* coated = std::get_if<CoatedMattLobe>(&part.lobe)) sum += part.weight * coated->albedo;
    if (const auto* sheet = std::get_if<SheetLobe>(&part.lobe)) sum += part.weight * sheet->reflectance;
  }
  return sum;
}

}  // namespace lekalo::render
