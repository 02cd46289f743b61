// Checker board in the parameter plane (Golovanov 2016, 8.5: a picture on a surface through (u, v)).
#include <cmath>
#include <cstdint>

#include "render/materials/textures.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class CheckerTexture final : public Texture {
 public:
  explicit CheckerTexture(const Checker& checker) : checker_(checker) {}

  Spectrum at(const SurfacePoint& point) const override { return color(is_even(point)).at(point); }
  uint64_t cell(const SurfacePoint& point) const override {
    const bool even = is_even(point);
    return hash_combine(even, color(even).cell(point));
  }
  std::any made_from() const override { return checker_; }

 private:
  bool is_even(const SurfacePoint& point) const {
    const double i = std::floor((point.u - checker_.offset.x) / checker_.spacing.x);
    const double j = std::floor((point.v - checker_.offset.y) / checker_.spacing.y);
    const double sum = i + j;
    return std::abs(sum) < 0x1p62 ? static_cast<int64_t>(sum) % 2 == 0 : std::fmod(sum, 2) == 0;
  }
  const TexturedColor& color(bool even) const { return even ? checker_.color : checker_.background; }

  Checker checker_;
};

}  // namespace

TexturePtr make_texture(const Checker& checker) { return std::make_shared<CheckerTexture>(checker); }

TypeDeclaration checker_type() {
  return declare(Category::texture, "checker", "Squares in two colours in the surface's parameters (u, v).")
      .field("spacing", number().positive().for_each_direction(), "side of a square in u and v", "1")
      .field("offset", number().for_each_direction(), "where a corner of a square lies", "0")
      .field("color", textured_color(), "colour of the square at the offset and of every second one", "black")
      .field("background", textured_color(), "colour of the other squares", "white")
      .built_by([](const Fields& f) {
        return make_texture(Checker{{f.u<double>("spacing"), f.v<double>("spacing")},
                                    {f.u<double>("offset"), f.v<double>("offset")},
                                    color_texture(f, "color"),
                                    color_texture(f, "background")});
      });
}

}  // namespace lekalo::render
