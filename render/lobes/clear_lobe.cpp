#include "render/lobes/clear_lobe.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/classic_lobes.h"
#include "render/lobes/fresnel.h"
#include "render/lobes/microfacet.h"
#include "render/spectra/hero_wavelengths.h"

namespace lekalo::render {

namespace {

// The facet that reflects or refracts one direction into the other, on the viewer's side; none for a facet whose other
// side is met.
std::optional<Vec3> facet(const Vec3& out, const Vec3& in, double eta) {
  Vec3 h = in.z > 0 ? out + in : out + eta * in;
  const double length = glm::length(h);
  if (length < 1e-12) return std::nullopt;
  h = h / length;
  if (h.z < 0) h = -h;
  if (glm::dot(out, h) <= 0 || glm::dot(in, h) * in.z <= 0) return std::nullopt;
  return h;
}

// What the lobe chooses to reflect: the mean of its lanes. For four wavelengths that is the balance heuristic over the
// choices that each of them would make (Wilkie et al. 2014).
double chosen(const Spectrum& reflectance, const Wavelengths& wavelengths) {
  const float sum = reflectance[0] + reflectance[1] + reflectance[2];
  return std::clamp(is_spectral(wavelengths) ? (sum + reflectance[3]) / 4.0 : sum / 3.0, 0.0, 1.0);
}
Spectrum rest(const Spectrum& share) { return Spectrum(1.0f) - share; }

Vec3 flipped(const Vec3& w) { return {w.x, w.y, -w.z}; }

}  // namespace

bool ClearLobe::smooth(const Sides& sides) const {
  return microfacets(roughness, 0).smooth() || (!thin && sides.near == sides.behind);
}

double ClearLobe::pane_reflectance(double cosine, const Sides& sides) const {
  return render::pane_reflectance(fresnel_dielectric(cosine, sides.near, index));
}

Spectrum ClearLobe::reflectance(double cosine, const Sides& sides) const {
  if (!film) {
    const double f = thin ? pane_reflectance(cosine, sides) : fresnel_dielectric(cosine, sides.near, sides.behind);
    return Spectrum(static_cast<float>(f));
  }
  if (thin) {  // all bounces between the face with the film and the other one
    const Spectrum coated = film->reflectance(thickness, cosine, wavelengths);
    const auto bare = static_cast<float>(fresnel_dielectric(cosine, sides.near, index));
    Spectrum sum = coated;
    for (int i = 0; i < 4; ++i)
      sum.set(i, std::min(1.0f, coated[i] + (1 - coated[i]) * (1 - coated[i]) * bare / (1 - coated[i] * bare + 1e-9f)));
    return sum;
  }
  if (sides.near <= sides.behind) return film->reflectance(thickness, cosine, wavelengths);
  // From within: the same as for the light that comes the other way.
  const double ratio = sides.near / sides.behind, sine = ratio * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return sine >= 1 ? Spectrum(1.0f) : film->reflectance(thickness, std::sqrt(1 - sine * sine), wavelengths);
}

Spectrum ClearLobe::evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const {
  if (smooth(sides) || in.z == 0) return {};
  const Microfacets facets = microfacets(roughness, 0);
  const double eta = thin ? 1 : sides.behind / sides.near;
  // What passes through a rough pane is spread as its mirror image is.
  const bool passes = in.z < 0;
  const Vec3 to = thin && passes ? flipped(in) : in;
  const std::optional<Vec3> h = facet(out, to, eta);
  if (!h) return {};
  const double along = glm::dot(out, *h);
  const Spectrum f = reflectance(along, sides);
  const double share = facets.facets(*h) * facets.seen_and_lit(out, to) / out.z;
  if (!passes) return static_cast<float>(share / 4) * f;
  if (thin) return static_cast<float>(share / 4) * (rest(f) * tint);
  const double across = glm::dot(in, *h), width = across + along / eta;
  return static_cast<float>(share * std::fabs(across * along) / (width * width)) * (rest(f) * tint);
}

double ClearLobe::density(const Vec3& out, const Vec3& in, const Sides& sides) const {
  if (smooth(sides) || in.z == 0) return 0;
  const Microfacets facets = microfacets(roughness, 0);
  const double eta = thin ? 1 : sides.behind / sides.near;
  const bool passes = in.z < 0;
  const std::optional<Vec3> h = facet(out, thin && passes ? flipped(in) : in, eta);
  if (!h) return 0;
  const double along = glm::dot(out, *h), visible = facets.visible_facets(out, *h);
  const double f = chosen(reflectance(along, sides), wavelengths);
  if (!passes || thin) return (passes ? 1 - f : f) * visible / (4 * along);
  const double across = glm::dot(in, *h), width = across + along / eta;
  return (1 - f) * visible * std::fabs(across) / (width * width);
}

Spectrum ClearLobe::straight_share(const Vec3& out, const Sides& sides) const {
  if (!smooth(sides)) return {};
  if (thin) return rest(reflectance(out.z, sides)) * tint;
  return sides.near == sides.behind ? tint : Spectrum();
}

LobeSample ClearLobe::smooth_sample(const Vec3& out, double choice, const Sides& sides) const {
  const Spectrum reflected = reflectance(out.z, sides);
  const double f = chosen(reflected, wavelengths);
  if (choice < f) return {mirrored(out), true, f, reflected};
  const std::optional<Vec3> behind = thin ? -out : refracted_behind(out, sides);
  if (!behind) return {};
  return {*behind, true, 1 - f, rest(reflected) * tint};
}

LobeSample ClearLobe::sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const {
  if (smooth(sides)) return smooth_sample(out, choice.x, sides);
  const Vec3 h = microfacets(roughness, 0).visible_facet(out, square);
  const double along = glm::dot(out, h);
  const double f = chosen(reflectance(along, sides), wavelengths);
  Vec3 in = 2 * along * h - out;
  if (choice.x < f) {
    if (in.z <= 0) return {};
  } else if (thin) {
    if (in.z <= 0) return {};
    in = flipped(in);
  } else {
    const double eta = sides.near / sides.behind, square_cosine = 1 - eta * eta * (1 - along * along);
    if (square_cosine <= 0) return {};
    in = -eta * out + (eta * along - std::sqrt(square_cosine)) * h;
    if (in.z >= 0) return {};
  }
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

}  // namespace lekalo::render
