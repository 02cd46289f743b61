// Ruled lines in the parameter plane, as on squared paper.
#include <cmath>

#include "render/materials/textures.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Distance from x to the nearest multiple of the spacing.
double distance_to_multiple(double x, double spacing) {
  return std::isinf(spacing) ? kInfinity : std::fabs(std::remainder(x, spacing));
}

class GridTexture final : public Texture {
 public:
  explicit GridTexture(const GridLines& grid) : grid_(grid) {}

  Spectrum at(const SurfacePoint& point) const override { return shown(point).at(point); }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(on_line(point), shown(point).cell(point));
  }
  std::any made_from() const override { return grid_; }

 private:
  bool on_line(const SurfacePoint& point) const {
    return distance_to_multiple(point.u - grid_.offset.x, grid_.spacing.x) <= 0.5 * grid_.width.x ||
           distance_to_multiple(point.v - grid_.offset.y, grid_.spacing.y) <= 0.5 * grid_.width.y;
  }
  const TexturedColor& shown(const SurfacePoint& point) const {
    return on_line(point) ? grid_.color : grid_.background;
  }

  GridLines grid_;
};

}  // namespace

TexturePtr make_texture(const GridLines& grid) { return std::make_shared<GridTexture>(grid); }

TypeDeclaration grid_type() {
  return declare(Category::texture, "grid", "Ruled lines in the surface's parameters (u, v), as on squared paper.")
      .field("spacing", number().positive().or_word({"none"}).for_each_direction(),
             "from line to line in u and v; none: no lines in that direction", "1")
      .field("offset", number().for_each_direction(), "where a line lies", "0")
      .field("width", number().non_negative().for_each_direction(), "of the lines, in parameters", "0.05")
      .field("color", textured_color(), "of the lines", "black")
      .field("background", textured_color(), "between the lines", "white")
      .built_by([](const Fields& f) {
        return make_texture(GridLines{line_spacing(f),
                                      {f.u<double>("offset"), f.v<double>("offset")},
                                      {f.u<double>("width"), f.v<double>("width")},
                                      color_texture(f, "color"),
                                      color_texture(f, "background")});
      });
}

}  // namespace lekalo::render
