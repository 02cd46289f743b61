#include "render/lobes/coated_lobe.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/classic_lobes.h"
#include "render/lobes/fresnel.h"
#include "render/lobes/microfacet.h"

namespace lekalo::render {

using geometry::kPi;

CoatLobe coat_lobe(double index) {
  CoatLobe coat;
  coat.index = index;
  coat.facing = fresnel_dielectric(1, 1, index);
  return coat;
}

Spectrum CoatLobe::evaluate(const Vec3& out, const Vec3& in, const Sides&) const {
  const Microfacets facets = microfacets(roughness, 0);
  if (in.z <= 0 || facets.smooth()) return {};
  const Vec3 h = glm::normalize(out + in);
  const double f = fresnel_dielectric(glm::dot(out, h), 1, index);
  return Spectrum(static_cast<float>(f * facets.facets(h) * facets.seen_and_lit(out, in) / (4 * out.z)));
}

double CoatLobe::density(const Vec3& out, const Vec3& in, const Sides&) const {
  const Microfacets facets = microfacets(roughness, 0);
  if (in.z <= 0 || facets.smooth()) return 0;
  return facets.seen(out) * facets.facets(glm::normalize(out + in)) / (4 * out.z);
}

LobeSample CoatLobe::sample(const Vec3& out, const Vec2&, const Vec2& square, const Sides& sides) const {
  const Microfacets facets = microfacets(roughness, 0);
  if (facets.smooth())
    return {mirrored(out), true, 1, Spectrum(static_cast<float>(fresnel_dielectric(out.z, 1, index)))};
  const Vec3 h = facets.visible_facet(out, square);
  const Vec3 in = 2 * glm::dot(out, h) * h - out;
  if (in.z <= 0) return {};
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

double CoatLobe::importance(const Vec3& out, const Sides&) const { return albedo->at(out); }

double CoatedMattLobe::importance(const Vec3& out, const Sides& sides) const {
  const double coat_share = coat.importance(out, sides);
  return coat_share + (1 - coat_share) * albedo.largest();
}

double CoatedMattLobe::coat_probability(const Vec3& out) const {
  const double mirror = coat.importance(out, {}), body = (1 - mirror) * albedo.largest();
  return mirror / std::max(mirror + body, 1e-9);
}

Spectrum CoatedMattLobe::evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const {
  if (in.z <= 0) return {};
  return coat.evaluate(out, in, sides) + evaluate_body(out, in);
}

Spectrum CoatedMattLobe::evaluate_body(const Vec3& out, const Vec3& in) const {
  if (in.z <= 0) return {};
  const double passes = (1 - coat.albedo->at(out)) * (1 - coat.albedo->at(in)) / (1 - coat.albedo->mean());
  return static_cast<float>(passes * in.z / kPi) * albedo;
}

double CoatedMattLobe::density(const Vec3& out, const Vec3& in, const Sides& sides) const {
  const double probability = coat_probability(out);
  return probability * coat.density(out, in, sides) + (1 - probability) * cosine_density(in);
}

LobeSample CoatedMattLobe::sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const {
  const double probability = coat_probability(out);
  LobeSample taken;
  if (choice.x < probability) {
    taken = coat.sample(out, choice, square, sides);
    if (taken.sharp) {
      taken.density = probability;
      return taken;
    }
    if (taken.density == 0) return taken;
  } else {
    taken.in = cosine_direction(square);
  }
  taken.density = density(out, taken.in, sides);
  taken.value = evaluate(out, taken.in, sides);
  return taken;
}

}  // namespace lekalo::render
