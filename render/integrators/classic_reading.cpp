#include "render/integrators/classic_reading.h"

#include "render/integrators/gloss.h"

namespace lekalo::render {

namespace {

// Adds a lobe of the given weight to the coefficients; a matt one to the ambient share only if that is not known.
class Reader {
 public:
  Reader(ClassicCoefficients& c, const Spectrum& weight, bool knows_ambient)
      : c_(c), weight_(weight), knows_ambient_(knows_ambient) {}

  void operator()(const LambertLobe& lobe) { matt(lobe.albedo); }
  void operator()(const RoughMattLobe& lobe) { matt(lobe.albedo); }
  void operator()(const SheetLobe& lobe) { matt(lobe.reflectance); }
  void operator()(const SheenLobe&) {}
  void operator()(const PhongLobe& lobe) {
    c_.specular += weight_ * lobe.height;
    c_.exponent = static_cast<float>(lobe.exponent);
  }
  void operator()(const BoundaryLobe& lobe) {
    c_.mirror += weight_ * lobe.mirror;
    c_.transmission += weight_ * lobe.transmission;
    c_.fresnel = lobe.fresnel ? Fresnel::boundary : Fresnel::none;
    c_.spread = static_cast<float>(lobe.spread);
  }
  void operator()(const CoatLobe& lobe) {
    gloss(lobe.roughness, lobe.facing);
    c_.mirror += weight_ * rgb(Vec3(mirror_share(lobe.roughness)));
    c_.fresnel = Fresnel::coat;
    c_.index = Spectrum(static_cast<float>(lobe.index));
  }
  void operator()(const CoatedMattLobe& lobe) {
    matt(lobe.albedo);
    (*this)(lobe.coat);
  }
  void operator()(const MetalLobe& lobe) {
    const double share = mirror_share(lobe.roughness);
    const Spectrum reflectance = lobe.reflectance.at(1);
    c_.exponent = phong_exponent(lobe.roughness);
    const Spectrum ambient = static_cast<float>(1 - share) * reflectance;
    c_.ambient += weight_ * ambient;
    c_.diffuse += weight_ * (static_cast<float>(lobe.roughness) * ambient);
    c_.specular += weight_ * (static_cast<float>(phong_height(c_.exponent, 1 - share)) * reflectance);
    const Spectrum mirror(static_cast<float>(share));
    if (lobe.reflectance.measured() && !lobe.reflectance.film) {
      c_.mirror += weight_ * mirror;
      c_.fresnel = Fresnel::conductor;
      c_.index = lobe.reflectance.n;
      c_.extinction = lobe.reflectance.k;
    } else {
      c_.mirror += weight_ * (mirror * reflectance);
      c_.fresnel = Fresnel::none;
    }
  }
  void operator()(const ClearLobe& lobe) {
    gloss(lobe.roughness, lobe.facing);
    c_.transmission += weight_ * lobe.tint * Spectrum(1, 1, 1, 0);
    c_.fresnel = lobe.thin ? Fresnel::pane : Fresnel::boundary;
    if (lobe.thin) c_.index = Spectrum(static_cast<float>(lobe.index));
  }

 private:
  void matt(const Spectrum& albedo) {
    if (!knows_ambient_) c_.ambient += weight_ * albedo;
    c_.diffuse += weight_ * albedo;
  }
  void gloss(double roughness, double reflectance) {
    c_.exponent = phong_exponent(roughness);
    c_.specular += weight_ * rgb(Vec3(phong_height(c_.exponent, reflectance)));
  }

  ClassicCoefficients& c_;
  Spectrum weight_;
  bool knows_ambient_;
};

}  // namespace

ClassicCoefficients classic_reading(const Scattering& scattering) {
  ClassicCoefficients c;
  c.emission = scattering.emission;
  c.two_sided = scattering.two_sided;
  c.catches_shadows = scattering.catches_shadows;
  const bool knows_ambient = scattering.ambient.has_value();
  if (knows_ambient) c.ambient = *scattering.ambient;
  for (const WeightedLobe& part : scattering.lobes) std::visit(Reader(c, part.weight, knows_ambient), part.lobe);
  return c;
}

}  // namespace lekalo::render
