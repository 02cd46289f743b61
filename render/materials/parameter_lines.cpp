// Parameter lines of constant width in the picture.
//
// With du', dv' the derivatives projected along the ray onto the plane across it, the line u = u_k lies, to first
// order, at the distance |u - u_k| |du' x dv'| / |dv'| in that plane; divided by the width of a pixel this is the
// distance in the picture. A line covers a pixel by the share of a pixel-wide box filter, so that one sample a pixel is
// smooth.
#include <algorithm>
#include <cmath>

#include "render/materials/textures.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ParameterLineTexture final : public Texture {
 public:
  explicit ParameterLineTexture(const ParameterLines& lines) : lines_(lines) {}

  Spectrum at(const SurfacePoint& point) const override {
    const float share = static_cast<float>(coverage(point));
    if (share <= 0) return lines_.background.at(point);
    if (share >= 1) return lines_.color.at(point);
    return share * lines_.color.at(point) + (1 - share) * lines_.background.at(point);
  }

  uint64_t cell(const SurfacePoint& point) const override {
    const double share = coverage(point);
    return share <= 0 ? 0 : share >= 1 ? 1 : 2;
  }
  std::any made_from() const override { return lines_; }

 private:
  double coverage(const SurfacePoint& point) const {
    if (point.pixel_size <= 0) return 0;
    const Vec3 du = point.du - glm::dot(point.du, point.incoming) * point.incoming;
    const Vec3 dv = point.dv - glm::dot(point.dv, point.incoming) * point.incoming;
    const double area = glm::length(glm::cross(du, dv));
    return std::max(covered(point.u - lines_.offset.x, lines_.spacing.x, area / (glm::length(dv) * point.pixel_size)),
                    covered(point.v - lines_.offset.y, lines_.spacing.y, area / (glm::length(du) * point.pixel_size)));
  }

  // Share of a pixel that lies in the nearest line; `scale` turns parameters into pixels.
  double covered(double parameter, double spacing, double scale) const {
    if (std::isinf(spacing) || !(scale > 0)) return 0;  // scale is 0 at silhouettes and NaN at poles
    const double distance = std::fabs(std::remainder(parameter, spacing)) * scale;
    const double half = 0.5 * lines_.width;
    return std::clamp(std::min(half, distance + 0.5) - std::max(-half, distance - 0.5), 0.0, 1.0);
  }

  ParameterLines lines_;
};

}  // namespace

TexturePtr make_texture(const ParameterLines& lines) { return std::make_shared<ParameterLineTexture>(lines); }

TypeDeclaration parameter_lines_type() {
  return declare(Category::texture, "parameter_lines",
                 "Lines u = const and v = const of constant width in the picture.")
      .field("spacing", number().positive().or_word({"none"}).for_each_direction(),
             "from line to line in u and v; none: no lines in that direction", "1")
      .field("offset", number().for_each_direction(), "where a line lies", "0")
      .field("width", number().positive(), "of the lines in pixels", "1.5")
      .field("color", textured_color(), "of the lines", "black")
      .field("background", textured_color(), "between the lines", "white")
      .built_by([](const Fields& f) {
        return make_texture(ParameterLines{line_spacing(f),
                                           {f.u<double>("offset"), f.v<double>("offset")},
                                           f.number("width"),
                                           color_texture(f, "color"),
                                           color_texture(f, "background")});
      });
}

}  // namespace lekalo::render
