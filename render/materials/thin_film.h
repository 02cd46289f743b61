// A thin film over a material: the field `film`.
#pragma once

#include "geometry/describe.h"
#include "render/lobes/film.h"
#include "render/materials/textured_color.h"

namespace lekalo::render {

// Thickness in nanometres: the same everywhere, or from `least` where the texture is black to `most` where it is white.
struct ThinFilm {
  double index = 1.33;
  double least = 0, most = 0;  // both 0: no film
  TexturePtr texture;

  bool exists() const { return most > 0; }
  double thickness(const SurfacePoint& point) const;
  // Its reflectance from air, over a substance of that index by wavelength in nanometres; null without a film.
  FilmTablePtr table(const std::function<std::complex<double>(double)>& substance) const;
};

void declare_thin_film(geometry::TypeDeclaration& type);
ThinFilm thin_film(const geometry::Fields& fields);

}  // namespace lekalo::render
