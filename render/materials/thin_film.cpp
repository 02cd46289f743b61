#include "render/materials/thin_film.h"

#include <algorithm>

namespace lekalo::render {

using namespace geometry;

double ThinFilm::thickness(const SurfacePoint& point) const {
  if (!texture) return least;
  return least + (most - least) * std::clamp(static_cast<double>(texture->at(point)[0]), 0.0, 1.0);
}

FilmTablePtr ThinFilm::table(const std::function<std::complex<double>(double)>& substance) const {
  if (!exists()) return nullptr;
  return std::make_shared<FilmTable>(index, least, texture ? most : least, substance);
}

void declare_thin_film(TypeDeclaration& type) {
  type.optional(
      "film",
      group({{"thickness", number().positive().at_most(20000), "in nanometres, where the texture is black", true, {}},
             {"to", number().positive().at_most(20000), "in nanometres, where the texture is white", false, {}},
             {"texture", reference({Category::texture}), "between the two, by its red channel", false, {}},
             {"index", number().between(1, 5), "refractive index of the film", false, "1.33"}}),
      "a film so thin that light of both its faces interferes: soap, oil, oxide");
}

ThinFilm thin_film(const Fields& fields) {
  if (!fields.has("film")) return {};
  const Fields& f = fields.group("film");
  if (f.has("texture") != f.has("to"))
    throw FieldError(f.has("to") ? "film.texture" : "film.to", "a film of changing thickness needs 'to' and 'texture'",
                     "thickness: 200, to: 700, texture: { type: noise } goes from 200 to 700 nanometres");
  ThinFilm film;
  film.index = f.number("index");
  film.least = film.most = f.number("thickness");
  if (!f.has("to")) return film;
  film.most = f.number("to");
  film.texture = f.get<TexturePtr>("texture");
  if (!(film.most > film.least))
    throw FieldError("film.to", "the film is to grow to a thickness that is not larger", "give the smaller one first");
  return film;
}

}  // namespace lekalo::render
