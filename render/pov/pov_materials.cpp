// Materials in POV-Ray's terms (POV-Ray 3.7 documentation, "Finish", "Interior"; Golovanov 2016, 8.4).
//
// POV-Ray shows, with pigment p, its opacity o, and for every light of colour I
//
//   o p (emission + ambient I_a + diffuse I cos(theta)) + phong I cos(alpha)^phong_size
//   + reflection radiance(mirror ray) + filter radiance(refracted ray),
//
// the classic model with k_a = o p ambient, k_d = o p diffuse (a number), k_s = phong (a number) and the I_p of the
// book as colour of the light: neither divides by pi, neither normalises the lobe. The interior's exponential fading
// (fade_power from 1000) is e^(-(1 - fade_color) l / fade_distance): Bouguer's law.
#include <fmt/format.h>

#include <cmath>

#include "render/integrators/classic_reading.h"
#include "render/lobes/fresnel.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"
#include "render/materials/textures.h"
#include "render/pov/pov_parts.h"

namespace lekalo::render {

using namespace geometry;

namespace {

bool is_grey(const Spectrum& s) { return s[0] == s[1] && s[1] == s[2]; }

Spectrum divided(const Spectrum& s, const Spectrum& by) {
  Spectrum q;
  for (int i = 0; i < 3; ++i) q.set(i, by[i] != 0 ? s[i] / by[i] : 0);
  return q;
}

bool is_lost(const Spectrum& s, const Spectrum& pigment) {
  for (int i = 0; i < 3; ++i)
    if (s[i] != 0 && pigment[i] == 0) return true;
  return false;
}

std::string reflection(const ClassicCoefficients& c, const std::string& name, PovNotes& notes) {
  switch (c.fresnel) {
    case Fresnel::none:
      return c.mirror.is_zero() ? "" : fmt::format(" reflection {{ {} }}", pov_rgb(c.mirror));
    case Fresnel::coat:
      if (c.mirror.is_zero()) return "";
      return fmt::format(" reflection {{ rgb 0, {} fresnel on }}", pov_rgb(c.mirror));
    case Fresnel::boundary:
      if (!c.mirror.is_zero() || c.transmission != Spectrum(1, 1, 1))
        notes.add(name +
                  ": with Fresnel's reflectance POV-Ray lets 1 - mirror - F transmission through, not "
                  "(1 - F) transmission");
      return fmt::format(" reflection {{ {}, {} fresnel on }} conserve_energy", pov_rgb(c.mirror),
                         pov_rgb(c.mirror + c.transmission));
    case Fresnel::pane: {
      notes.add(name + ": POV-Ray has no panes of one surface; their reflectance at right angles is taken");
      const auto both = static_cast<float>(pane_reflectance(fresnel_dielectric(1, c.index)[0]));
      return fmt::format(" reflection {{ {} }}", pov_rgb(c.mirror + both * c.transmission));
    }
    case Fresnel::conductor:
      if (c.mirror.is_zero()) return "";
      notes.add(name + ": POV-Ray has no reflectance of metals by angle; that at right angles is taken");
      return fmt::format(" reflection {{ {} }}", pov_rgb(c.mirror * fresnel_conductor(1, c.index, c.extinction)));
  }
  return "";
}

// `pigment { ... } finish { ... }`.
std::string texture(const ClassicCoefficients& c, const std::string& name, PovNotes& notes) {
  const Spectrum own = c.diffuse + c.ambient + c.emission;
  Spectrum pigment{1, 1, 1};
  float diffuse = 0;
  if (!c.diffuse.is_zero()) {
    diffuse = c.diffuse.largest();
    pigment = divided(c.diffuse, Spectrum(diffuse));
    if (is_lost(c.ambient, pigment) || is_lost(c.emission, pigment))
      notes.add(name + ": POV-Ray's ambient light and emission cannot have a colour that its diffuse light lacks");
  }
  const Spectrum ambient = divided(c.ambient, pigment), emission = divided(c.emission, pigment);
  std::string color;
  if (c.transmission.is_zero()) {
    color = pov_rgb(pigment);
  } else if (own.is_zero()) {
    color = pov_rgb(c.transmission) + " filter 1";
  } else if (is_grey(c.transmission) && c.transmission[0] < 1) {
    color = fmt::format("{} transmit {}", pov_rgb((1 / (1 - c.transmission[0])) * pigment), c.transmission[0]);
  } else {
    notes.add(name + ": what is clear or lets coloured light through shows no ambient and diffuse light in POV-Ray");
    color = pov_rgb(c.transmission) + " filter 1";
  }
  std::string text = fmt::format("pigment {{ {} }} finish {{ ambient {} diffuse {}", color, pov_rgb(ambient), diffuse);
  if (!c.emission.is_zero()) text += " emission " + pov_rgb(emission);
  if (!c.specular.is_zero()) {
    if (!is_grey(c.specular)) notes.add(name + ": POV-Ray's highlight is white here; its mean height is kept");
    const float height = is_grey(c.specular) ? c.specular[0] : (c.specular[0] + c.specular[1] + c.specular[2]) / 3;
    text += fmt::format(" phong {} phong_size {}", height, c.exponent);
  }
  if (c.spread > 0) notes.add(name + ": POV-Ray shows no lamps through clear surfaces");
  if (!c.two_sided) notes.add(name + ": POV-Ray lights both sides of a surface");
  if (c.catches_shadows) notes.add(name + ": POV-Ray has no ground that shows only shadows");
  return text + reflection(c, name, notes) + " }";
}

std::string interior(const Material& material, const ClassicCoefficients& c, const std::string& name, PovNotes& notes) {
  if (c.fresnel == Fresnel::coat) return fmt::format(" interior {{ ior {} }}", c.index[0]);
  const auto medium = material.interior(Wavelengths{{kLineD, kLineD, kLineD, kLineD}});
  if (!medium) return "";
  if (medium->priority != 0)
    notes.add(name + ": POV-Ray has no priorities of overlapping substances; the one entered last counts");
  if (c.fresnel == Fresnel::none && c.transmission != Spectrum(1, 1, 1) && medium->index != 1)
    notes.add(name + ": POV-Ray does not filter light after total internal reflection");
  std::string text = fmt::format(" interior {{ ior {}", medium->index);
  const float most = medium->absorption.largest();
  if (most > 0) {
    text += fmt::format(" fade_power 1001 fade_distance {} fade_color {}", 1 / most,
                        pov_rgb(Spectrum(1) - divided(medium->absorption, Spectrum(most))));
    if (!c.mirror.is_zero() || c.fresnel != Fresnel::none || !c.specular.is_zero())
      notes.add(name + ": POV-Ray does not absorb the light of highlights and mirror images on the inside");
  }
  return text + " }";
}

// What a material's looks vary with, found in the plain value it was made from.
struct Pattern {
  std::optional<Checker> checker;
  bool other = false;  // textures that cannot be written
  bool rough = false;

  void read(const TexturedColor& color) {
    if (!color.texture()) return;
    const std::any value = color.texture()->made_from();
    const auto* found = std::any_cast<Checker>(&value);
    const auto same = [&] { return found->spacing == checker->spacing && found->offset == checker->offset; };
    if (found == nullptr || found->color.texture() || found->background.texture() || (checker && !same()))
      other = true;
    else
      checker = *found;
  }
  void read(const Roughness& roughness) { other = other || roughness.texture; }
  void read(const NormalDeviation& deviation) { rough = deviation.amplitude > 0; }
};

Pattern pattern(const Material& material) {
  const std::any value = material.made_from();
  Pattern p;
  if (const auto* look = std::any_cast<ClassicLook>(&value)) {
    for (const TexturedColor* color : {&look->color, &look->ambient, &look->diffuse, &look->specular, &look->mirror,
                                       &look->transmission, &look->emission})
      p.read(*color);
    p.read(look->normal_deviation);
  } else if (const auto* diffuse = std::any_cast<Diffuse>(&value)) {
    p.read(diffuse->color);
    p.read(diffuse->roughness);
    p.read(diffuse->normal_deviation);
  } else if (const auto* plastic = std::any_cast<Plastic>(&value)) {
    p.read(plastic->color);
    p.read(plastic->roughness);
    p.read(plastic->normal_deviation);
  } else if (const auto* conductor = std::any_cast<Conductor>(&value)) {
    p.read(conductor->color);
    p.read(conductor->roughness);
    p.read(conductor->normal_deviation);
  } else if (const auto* dielectric = std::any_cast<Dielectric>(&value)) {
    p.read(dielectric->roughness);
    p.read(dielectric->normal_deviation);
  } else if (const auto* emission = std::any_cast<Emission>(&value)) {
    p.read(emission->color);
  } else {
    p.other = material.uses_parameters();
  }
  return p;
}

}  // namespace

std::string pov_material(const Material& material, const std::string& name, const std::optional<Frame>& parameters,
                         PovNotes& notes) {
  const Pattern p = pattern(material);
  if (p.rough) notes.add(name + ": POV-Ray cannot repeat the random deviation of normals");
  SurfacePoint point;
  std::string text;
  if (p.checker && !p.other && parameters) {
    // POV-Ray's checker fills space; the plane runs through the middle of a layer of cells.
    const Checker& k = *p.checker;
    point.u = k.offset.x + 0.5 * k.spacing.x;
    point.v = k.offset.y + 0.5 * k.spacing.y;
    const std::string even = texture(classic_reading(material, point, Wavelengths{}), name, notes);
    point.u += k.spacing.x;
    const std::string odd = texture(classic_reading(material, point, Wavelengths{}), name, notes);
    const Affine cells{Mat3(k.spacing.x, 0, 0, 0, k.spacing.y, 0, 0, 0, 1), Vec3(k.offset, -0.5)};
    text = fmt::format("\n    checker\n    texture {{ {} }}\n    texture {{ {} }}\n   {}", even, odd,
                       pov(pov_frame(*parameters) * cells));
  } else {
    if (p.checker || p.other)
      notes.add(name + ": of textures only one checker on planes is written; elsewhere the colour at u = v = 0");
    text = texture(classic_reading(material, point, Wavelengths{}), name, notes);
  }
  return fmt::format("\n  material {{ texture {{ {} }}{} }}", text,
                     interior(material, classic_reading(material, point, Wavelengths{}), name, notes));
}

}  // namespace lekalo::render
