// A picture mapped through (u, v) by an affine map (Golovanov 2016, 8.5: (x_p, y_p) = f(u, v)).
#include <array>
#include <cmath>
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
    if (!source_.smooth) return pixel(point, std::floor(p.x), std::floor(p.y));
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    const float a = static_cast<float>(p.x - 0.5 - x), b = static_cast<float>(p.y - 0.5 - y);
    return (1 - b) * ((1 - a) * pixel(point, x, y) + a * pixel(point, x + 1, y)) +
           b * ((1 - a) * pixel(point, x, y + 1) + a * pixel(point, x + 1, y + 1));
  }

  uint64_t cell(const SurfacePoint& point) const override {
    const Vec2 p = pixel_position(point) - Vec2(source_.smooth ? 0.5 : 0.0);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return 0;
    return hash_combine(static_cast<uint64_t>(static_cast<long long>(std::floor(p.x))),
                        static_cast<uint64_t>(static_cast<long long>(std::floor(p.y))));
  }
  std::any made_from() const override { return source_; }

 private:
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

}  // namespace

TexturePtr make_texture(const ImageTexture& image) { return std::make_shared<PictureTexture>(image); }

TypeDeclaration image_type() {
  return declare(Category::texture, "image", "A picture file mapped on the surface through its parameters (u, v).")
      .example("file: wood.png")
      .field("file", file(), "PNG, EXR or another picture format; 8 and 16 bit files are taken as sRGB")
      .field("spacing", number().positive().for_each_direction(), "width and height of the picture in u and v", "1")
      .field("offset", number().for_each_direction(), "(u, v) of the picture's lower left corner", "0")
      .field("rotation", angle(), "of the picture about its lower left corner, from u towards v", "0")
      .field("wrap", choice({"repeat", "mirror", "clamp", "background"}), "what lies beyond the picture's edges",
             "repeat")
      .field("interpolation", choice({"linear", "nearest"}), "between pixels", "linear")
      .field("background", textured_color(), "beyond the edges (wrap: background) and behind transparent pixels",
             "white")
      .built_by([](const Fields& f) {
        ImageTexture texture;
        try {
          texture.image = read_image(f.text("file"));
        } catch (const ImageError& error) {
          throw FieldError("file", error.what());
        }
        if (!has_color(texture.image))
          throw FieldError("file", "the picture has no colour channels", "R, G, B or Y are needed");
        texture.spacing = {f.u<double>("spacing"), f.v<double>("spacing")};
        texture.offset = {f.u<double>("offset"), f.v<double>("offset")};
        texture.rotation = f.number("rotation");
        const std::string wrap = f.text("wrap");
        texture.wrap = wrap == "repeat"   ? Wrap::repeat
                       : wrap == "mirror" ? Wrap::mirror
                       : wrap == "clamp"  ? Wrap::clamp
                                          : Wrap::background;
        texture.smooth = f.text("interpolation") == "linear";
        texture.background = color_texture(f, "background");
        return make_texture(texture);
      });
}

}  // namespace lekalo::render
