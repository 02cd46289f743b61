// A picture mapped through (u, v) by an affine map (Golovanov 2016, 8.5: (x_p, y_p) = f(u, v)).
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "render/image/image_error.h"
#include "render/image/read_image.h"
#include "render/materials/textures.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kOutside = -1;

// Index of a pixel row or column in a picture of `count` of them.
int wrapped(long long i, int count, Wrap wrap) {
  if (i >= 0 && i < count) return static_cast<int>(i);
  switch (wrap) {
    case Wrap::repeat:
      return static_cast<int>(((i % count) + count) % count);
    case Wrap::mirror: {
      const long long in_pair = ((i % (2 * count)) + 2 * count) % (2 * count);
      return static_cast<int>(in_pair < count ? in_pair : 2 * count - 1 - in_pair);
    }
    case Wrap::clamp:
      return i < 0 ? 0 : count - 1;
    case Wrap::background:
      return kOutside;
  }
  return kOutside;
}

class PictureTexture final : public Texture {
 public:
  explicit PictureTexture(const ImageTexture& source)
      : source_(source), cosine_(std::cos(source.rotation)), sine_(std::sin(source.rotation)) {
    if (!has_color(source_.image)) throw std::invalid_argument("the picture has no colour channels");
    planes_ = color_planes(source_.image);
  }

  Spectrum at(const SurfacePoint& point) const override {
    const Vec2 p = pixel_position(point);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return source_.background.at(point);
    return source_.filtered ? mean_over_pixel(point, p) : between_pixels(point, p);
  }

  uint64_t cell(const SurfacePoint& point) const override {
    const Vec2 p = pixel_position(point) - Vec2(source_.smooth ? 0.5 : 0.0);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return 0;
    return hash_combine(static_cast<uint64_t>(static_cast<long long>(std::floor(p.x))),
                        static_cast<uint64_t>(static_cast<long long>(std::floor(p.y))));
  }
  std::any made_from() const override { return source_; }

 private:
  Spectrum between_pixels(const SurfacePoint& point, const Vec2& p) const {
    if (!source_.smooth) return pixel(point, std::floor(p.x), std::floor(p.y));
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    const float a = static_cast<float>(p.x - 0.5 - x), b = static_cast<float>(p.y - 0.5 - y);
    return (1 - b) * ((1 - a) * pixel(point, x, y) + a * pixel(point, x + 1, y)) +
           b * ((1 - a) * pixel(point, x, y + 1) + a * pixel(point, x + 1, y + 1));
  }

  // A pixel of the rendered picture covers a parallelogram of the parameters; its mean by places that lie no farther
  // apart than the pixels of the texture, as far as kMaxPlaces go.
  Spectrum mean_over_pixel(const SurfacePoint& point, const Vec2& p) const {
    constexpr double kMaxPlaces = 16;
    const auto [a, b] = covered(point);
    const auto count = [=](const Vec2& side) {
      return static_cast<int>(std::clamp(std::ceil(glm::length(side)), 1.0, kMaxPlaces));
    };
    const int na = count(a), nb = count(b);
    Spectrum sum;
    for (int i = 0; i < na; ++i)
      for (int j = 0; j < nb; ++j)
        sum += between_pixels(point, p + ((i + 0.5) / na - 0.5) * a + ((j + 0.5) / nb - 0.5) * b);
    return (1.0f / static_cast<float>(na * nb)) * sum;
  }

  // Sides of that parallelogram in pixels of the texture. With r_u, r_v seen along the ray, in its plane across the ray
  // with axes e_1, e_2: the parameters that belong to a step of a pixel along each (the ray's differential, Igehy 1999,
  // of a ray that has met no mirror).
  std::pair<Vec2, Vec2> covered(const SurfacePoint& point) const {
    if (!(point.pixel_size > 0)) return {Vec2(0), Vec2(0)};
    const Frame across = frame_about(Vec3(0), point.incoming);
    const Vec2 du(glm::dot(point.du, across.x), glm::dot(point.du, across.y));
    const Vec2 dv(glm::dot(point.dv, across.x), glm::dot(point.dv, across.y));
    const double det = du.x * dv.y - du.y * dv.x;
    if (!(std::fabs(det) > 1e-9 * glm::length(du) * glm::length(dv))) return {Vec2(0), Vec2(0)};
    const double s = point.pixel_size / det;
    return {in_pixels({s * dv.y, -s * du.y}), in_pixels({-s * dv.x, s * du.x})};
  }
  Vec2 in_pixels(const Vec2& way) const {
    return {(cosine_ * way.x + sine_ * way.y) / source_.spacing.x * source_.image.width,
            -(-sine_ * way.x + cosine_ * way.y) / source_.spacing.y * source_.image.height};
  }

  // In pixels from the upper left corner of the picture.
  Vec2 pixel_position(const SurfacePoint& point) const {
    const double u = point.u - source_.offset.x, v = point.v - source_.offset.y;
    const double across = (cosine_ * u + sine_ * v) / source_.spacing.x;
    const double up = (-sine_ * u + cosine_ * v) / source_.spacing.y;
    return {across * source_.image.width, (1 - up) * source_.image.height};
  }

  Spectrum pixel(const SurfacePoint& point, double x, double y) const {
    const int column = wrapped(static_cast<long long>(x), source_.image.width, source_.wrap);
    const int row = wrapped(static_cast<long long>(y), source_.image.height, source_.wrap);
    if (column == kOutside || row == kOutside) return source_.background.at(point);
    const size_t i = static_cast<size_t>(row) * source_.image.width + column;
    const Spectrum color{planes_.r[i], planes_.g[i], planes_.b[i]};
    if (planes_.alpha.empty() || planes_.alpha[i] >= 1) return color;
    return color + (1 - planes_.alpha[i]) * source_.background.at(point);
  }

  ImageTexture source_;
  ColorPlanes planes_;
  double cosine_, sine_;
};

std::optional<std::string> not_finite(const Image& image) {
  const ColorPlanes planes = color_planes(image);
  for (size_t i = 0; i < planes.r.size(); ++i)
    if (!std::isfinite(planes.r[i]) || !std::isfinite(planes.g[i]) || !std::isfinite(planes.b[i]))
      return fmt::format("pixel ({}, {}) of the picture, from the upper left, is no finite number",
                         i % static_cast<size_t>(image.width), i / static_cast<size_t>(image.width));
  return std::nullopt;
}

}  // namespace

TexturePtr make_texture(const ImageTexture& image) { return std::make_shared<PictureTexture>(image); }

TypeDeclaration image_type() {
  return declare(Category::texture, "image", "A picture file mapped on the surface through its parameters (u, v).")
      .example("file: wood.png")
      .field("file", file(), "PNG, EXR or another picture format; colours of 8 and 16 bit files are taken as sRGB")
      .field("spacing", number().positive().for_each_direction(), "width and height of the picture in u and v", "1")
      .field("offset", number().for_each_direction(), "(u, v) of the picture's lower left corner", "0")
      .field("rotation", angle(), "of the picture about its lower left corner, from u towards v", "0")
      .field("wrap", choice({"repeat", "mirror", "clamp", "background"}), "what lies beyond the picture's edges",
             "repeat")
      .field(
          "interpolation", choice({"linear", "nearest", "filtered"}),
          "between pixels; filtered: the mean over what a pixel of the rendered picture covers, so that far pictures "
          "do not flicker",
          "linear")
      .field("values", choice({"color", "data"}),
             "of 8 and 16 bit files; data: as they stand, from 0 to 1, for normals, heights and roughness", "color")
      .field("background", textured_color(), "beyond the edges (wrap: background) and behind transparent pixels",
             "white")
      .built_by([](const Fields& f) {
        ImageTexture texture;
        try {
          texture.image =
              read_image(f.text("file"), f.text("values") == "data" ? SampleEncoding::raw : SampleEncoding::linear);
        } catch (const ImageError& error) {
          throw FieldError("file", error.what());
        }
        if (!has_color(texture.image))
          throw FieldError("file", "the picture has no colour channels", "R, G, B or Y are needed");
        if (const std::optional<std::string> found = not_finite(texture.image)) throw FieldError("file", *found);
        texture.spacing = {f.u<double>("spacing"), f.v<double>("spacing")};
        texture.offset = {f.u<double>("offset"), f.v<double>("offset")};
        texture.rotation = f.number("rotation");
        const std::string wrap = f.text("wrap");
        texture.wrap = wrap == "repeat"   ? Wrap::repeat
                       : wrap == "mirror" ? Wrap::mirror
                       : wrap == "clamp"  ? Wrap::clamp
                                          : Wrap::background;
        texture.smooth = f.text("interpolation") != "nearest";
        texture.filtered = f.text("interpolation") == "filtered";
        texture.background = color_texture(f, "background");
        return make_texture(texture);
      });
}

}  // namespace lekalo::render
