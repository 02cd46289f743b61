#include "render/lobes/bsdf.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

namespace {

// Viewers that look along the surface are taken a little above it.
constexpr double kMinCosine = 1e-5;

geometry::Frame surface_frame(const Vec3& normal, const Vec3& along) {
  const Vec3 x = along - glm::dot(along, normal) * normal;
  const double length = glm::length(x);
  if (!(length > 0) || !std::isfinite(length)) return geometry::frame_about(Vec3(0), normal);
  return {Vec3(0), x / length, glm::cross(normal, x / length), normal};
}

Vec3 above(Vec3 out) {
  if (out.z >= kMinCosine) return out;
  out.z = kMinCosine;
  return glm::normalize(out);
}

double importance(const WeightedLobe& part, const Vec3& out, const Sides& sides) {
  return part.weight.largest() * part.passes(out, out) *
         std::visit([&](const auto& lobe) { return lobe.importance(out, sides); }, part.lobe);
}

bool spreads(const Lobe& lobe, const Sides& sides) {
  if (const auto* metal = std::get_if<MetalLobe>(&lobe))
    return !microfacets(metal->roughness, metal->anisotropy).smooth();
  if (const auto* coat = std::get_if<CoatLobe>(&lobe)) return !microfacets(coat->roughness, 0).smooth();
  if (const auto* clear = std::get_if<ClearLobe>(&lobe)) return !clear->smooth(sides);
  return !std::holds_alternative<BoundaryLobe>(lobe);
}

Spectrum evaluate_lobe(const Lobe& lobe, const Vec3& out, const Vec3& in, const Sides& sides) {
  return std::visit([&](const auto& kind) { return kind.evaluate(out, in, sides); }, lobe);
}

// What matt bodies and nap send on of it, not the coat over them.
Spectrum evaluate_matt(const Lobe& lobe, const Vec3& out, const Vec3& in, const Sides& sides) {
  if (const auto* coated = std::get_if<CoatedMattLobe>(&lobe)) return coated->evaluate_body(out, in);
  const bool is_matt = std::holds_alternative<LambertLobe>(lobe) || std::holds_alternative<RoughMattLobe>(lobe) ||
                       std::holds_alternative<SheetLobe>(lobe) || std::holds_alternative<SheenLobe>(lobe);
  return is_matt ? evaluate_lobe(lobe, out, in, sides) : Spectrum();
}

// What the lobes are multiplied with so that they send back no more than what falls on them.
float balance(const Scattering& scattering, const Vec3& out, const Sides& sides) {
  if (!scattering.unbalanced) return 1;
  double sum = 0;
  for (const WeightedLobe& part : scattering.lobes) sum += importance(part, out, sides);
  return sum > 1 ? static_cast<float>(1 / sum) : 1;
}

}  // namespace

Bsdf::Bsdf(const Scattering& scattering, const Vec3& normal, const Vec3& geometric_normal, const Vec3& along,
           const Vec3& out, const Sides& sides)
    : scattering_(scattering),
      frame_(surface_frame(normal, along)),
      geometric_normal_(geometric_normal),
      out_(above(frame_.to_local_direction(out))),
      sides_(sides),
      scale_(balance(scattering, out_, sides)) {
  for (int i = 0; i < scattering.lobes.size(); ++i)
    total_ += importance_[i] = importance(scattering.lobes[i], out_, sides_);
}

bool Bsdf::has_spread() const {
  return std::any_of(scattering_.lobes.begin(), scattering_.lobes.end(),
                     [&](const WeightedLobe& part) { return spreads(part.lobe, sides_); });
}

// Of what `evaluate` says of each lobe.
template <class Evaluate>
Spectrum Bsdf::sum_over(const Vec3& in, const Evaluate& evaluate) const {
  const Vec3 local_in = frame_.to_local_direction(in);
  Spectrum sum;
  if (!is_possible(in, local_in)) return sum;
  for (const WeightedLobe& part : scattering_.lobes) {
    const Spectrum value = evaluate(part.lobe, out_, local_in, sides_);
    if (!value.is_zero()) sum += (scale_ * part.passes(out_, local_in)) * (part.weight * value);
  }
  return sum;
}

Spectrum Bsdf::evaluate(const Vec3& in) const { return sum_over(in, evaluate_lobe); }

Spectrum Bsdf::matt_share(const Vec3& in) const {
  const Spectrum all = evaluate(in), matt = sum_over(in, evaluate_matt);
  Spectrum share;
  for (int i = 0; i < 4; ++i)
    if (all[i] > 0) share.set(i, matt[i] / all[i]);
  return share;
}

double Bsdf::density(const Vec3& in) const {
  const Vec3 local_in = frame_.to_local_direction(in);
  if (total_ <= 0) return 0;
  double sum = 0;
  for (int i = 0; i < scattering_.lobes.size(); ++i)
    if (importance_[i] > 0)
      sum +=
          importance_[i] / total_ *
          std::visit([&](const auto& lobe) { return lobe.density(out_, local_in, sides_); }, scattering_.lobes[i].lobe);
  return sum;
}

std::optional<BsdfSample> Bsdf::sample(const Vec2& choice, const Vec2& square) const {
  if (total_ <= 0) return std::nullopt;
  double place = choice.x * total_;
  int chosen = 0;
  while (chosen + 1 < scattering_.lobes.size() && place >= importance_[chosen]) place -= importance_[chosen++];
  if (!(importance_[chosen] > 0)) return std::nullopt;
  const WeightedLobe& part = scattering_.lobes[chosen];
  // What is left of the number is as random as it was.
  const Vec2 left(std::min(place / importance_[chosen], 1 - 0x1p-53), choice.y);
  const LobeSample taken =
      std::visit([&](const auto& lobe) { return lobe.sample(out_, left, square, sides_); }, part.lobe);
  if (!(taken.density > 0)) return std::nullopt;
  BsdfSample sample;
  sample.in = frame_.direction(taken.in);
  if (!is_possible(sample.in, taken.in)) return std::nullopt;
  sample.sharp = taken.sharp;
  if (taken.sharp) {
    sample.density = taken.density * importance_[chosen] / total_;
    sample.share =
        static_cast<float>(scale_ * part.passes(out_, taken.in) / sample.density) * (part.weight * taken.value);
  } else {
    sample.density = density(sample.in);
    if (!(sample.density > 0)) return std::nullopt;
    sample.share = static_cast<float>(1 / sample.density) * evaluate(sample.in);
  }
  if (sample.share.is_zero()) return std::nullopt;
  return sample;
}

Spectrum straight_share(const Scattering& scattering, double cosine, const Sides& sides) {
  const Vec3 out(std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, std::max(cosine, kMinCosine));
  Spectrum sum;
  for (const WeightedLobe& part : scattering.lobes) {
    Spectrum share;
    if (const auto* boundary = std::get_if<BoundaryLobe>(&part.lobe))
      share = boundary->straight_share(sides);
    else if (const auto* clear = std::get_if<ClearLobe>(&part.lobe))
      share = clear->straight_share(out, sides);
    sum += part.passes(out, -out) * (part.weight * share);
  }
  return balance(scattering, out, sides) * sum;
}

}  // namespace lekalo::render
