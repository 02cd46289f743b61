// Surroundings from a panorama: light from everywhere, more of it where the picture is bright.
//
// The picture is equirectangular, its middle in the direction +y, its upper edge in +z, what lies to the right of the
// middle in +x; `rotation` turns it about z, counterclockwise from above. A place of the unit square goes to a pixel
// with a probability as its brightness (and its neighbours', for values between pixels are joined) times its solid
// angle, and evenly to a place within it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "render/image/image_error.h"
#include "render/image/read_image.h"
#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Chooses an entry with a probability as its weight.
class Choice {
 public:
  explicit Choice(const std::vector<double>& weights) : ends_(weights.size() + 1) {
    for (size_t i = 0; i < weights.size(); ++i) ends_[i + 1] = ends_[i] + weights[i];
  }
  double sum() const { return ends_.back(); }
  double probability(size_t i) const { return (ends_[i + 1] - ends_[i]) / sum(); }
  // The entry, and the place within it that is left of the random number.
  std::pair<size_t, double> at(double random) const {
    const double place = random * sum();
    const auto after = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, place);
    const size_t i = static_cast<size_t>(after - ends_.begin()) - 1;
    const double width = ends_[i + 1] - ends_[i];
    return {i, width > 0 ? std::clamp((place - ends_[i]) / width, 0.0, 1 - 0x1p-53) : 0.5};
  }

 private:
  std::vector<double> ends_;
};

class EnvironmentLamp final : public Light {
  // What light from a direction asks for, side by side in memory.
  struct Pixel {
    float r = 0, g = 0, b = 0;
    double density = 0;  // of its choice, per unit of the picture's square
  };

 public:
  explicit EnvironmentLamp(const EnvironmentLight& light)
      : light_(light),
        scale_(static_cast<float>(light_.intensity) * rgb(light_.color)),
        width_(light_.image.width),
        height_(light_.image.height),
        pixels_(static_cast<size_t>(width_) * height_),
        rows_(row_weights()),
        middle_(sample_of(Vec2(0.5))) {}

  int sample_count() const override { return light_.sampling.n * light_.sampling.n; }
  LightSample sample(const Vec3& point, int index, double r1, double r2) const override {
    LightSample sample = sample_all(point, area_sample(light_.sampling, index, r1, r2));
    sample.weight = 1.0 / sample_count();
    return sample;
  }
  LightSample sample_all(const Vec3&, const Vec2& square) const override {
    // Asked for at every place where lamps are compared.
    return square == Vec2(0.5) ? middle_ : sample_of(square);
  }
  std::optional<LightSample> towards(const Vec3&, const Vec3& direction) const override {
    const Vec2 place = place_of(direction);
    return sample_at(direction, place, pixels_[index(pixel(place.y, height_), pixel(place.x, width_))]);
  }
  bool has_size() const override { return true; }
  bool is_backdrop() const override { return light_.visible; }
  bool is_jittered() const override { return !light_.sampling.grid; }
  bool casts_shadows() const override { return light_.shadows; }
  std::any made_from() const override { return light_; }

 private:
  static size_t pixel(double place, int count) {
    return static_cast<size_t>(std::clamp(static_cast<int>(place * count), 0, count - 1));
  }
  LightSample sample_of(const Vec2& square) const {
    const auto [row, y] = rows_.at(std::min(square.y, 1 - 0x1p-53));
    const auto [column, x] = columns_[row].at(std::min(square.x, 1 - 0x1p-53));
    const Vec3 direction =
        direction_of((static_cast<double>(column) + x) / width_, (static_cast<double>(row) + y) / height_);
    return sample_at(direction, place_of(direction), pixels_[index(row, column)]);
  }
  LightSample sample_at(const Vec3& direction, const Vec2& place, const Pixel& pixel) const {
    // Per unit of solid angle: 2 pi^2 sin(angle from z) of it to one of the picture's square.
    const double sine = std::sqrt(std::max(1e-12, 1 - direction.z * direction.z));
    LightSample sample{direction, kInfinity, {}, 1, pixel.density / (2 * kPi * kPi * sine)};
    sample.irradiance = static_cast<float>(1 / sample.density) * radiance(place);
    return sample;
  }
  // From the left and from above, in [0, 1].
  Vec2 place_of(const Vec3& w) const {
    const double turn = (0.5 * kPi - std::atan2(w.y, w.x) + light_.rotation) / kTwoPi + 0.5;
    return {turn - std::floor(turn), std::acos(std::clamp(w.z, -1.0, 1.0)) / kPi};
  }
  Vec3 direction_of(double u, double v) const {
    const double azimuth = 0.5 * kPi - kTwoPi * (u - 0.5) + light_.rotation, polar = kPi * v;
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
  }
  size_t index(size_t row, size_t column) const { return row * static_cast<size_t>(width_) + column; }
  // Of a pixel or one just beyond the picture.
  Spectrum color(int row, int column) const {
    const int y = std::clamp(row, 0, height_ - 1), x = column < 0 ? width_ - 1 : column < width_ ? column : 0;
    const Pixel& pixel = pixels_[index(static_cast<size_t>(y), static_cast<size_t>(x))];
    return {pixel.r, pixel.g, pixel.b};
  }
  Spectrum radiance(const Vec2& place) const {
    const double x = place.x * width_ - 0.5, y = place.y * height_ - 0.5;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const auto a = static_cast<float>(x - column), b = static_cast<float>(y - row);
    const Spectrum joined = (1 - b) * ((1 - a) * color(row, column) + a * color(row, column + 1)) +
                            b * ((1 - a) * color(row + 1, column) + a * color(row + 1, column + 1));
    return scale_ * joined;
  }
  // Fills in the pixels and their choice within their rows.
  Choice row_weights() {
    const ColorPlanes planes = color_planes(light_.image);
    double mean = 0;
    for (size_t i = 0; i < pixels_.size(); ++i) {
      mean += std::max({0.0f, planes.r[i], planes.g[i], planes.b[i]}) / static_cast<double>(pixels_.size());
      pixels_[i] = {std::max(0.0f, planes.r[i]), std::max(0.0f, planes.g[i]), std::max(0.0f, planes.b[i]), 0};
    }
    std::vector<double> sums, weights(static_cast<size_t>(width_));
    for (int row = 0; row < height_; ++row) {
      for (int column = 0; column < width_; ++column) {
        float brightest = 0;
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j) brightest = std::max(brightest, color(row + i, column + j).largest());
        weights[static_cast<size_t>(column)] = brightest + 1e-3 * mean + 1e-30;
      }
      columns_.emplace_back(weights);
      sums.push_back(columns_.back().sum() * std::sin(kPi * (row + 0.5) / height_));
    }
    const Choice rows(sums);
    for (size_t row = 0; row < columns_.size(); ++row)
      for (size_t column = 0; column < weights.size(); ++column)
        pixels_[index(row, column)].density =
            rows.probability(row) * height_ * columns_[row].probability(column) * width_;
    return rows;
  }

  EnvironmentLight light_;
  Spectrum scale_;
  int width_, height_;
  std::vector<Pixel> pixels_;
  std::vector<Choice> columns_;  // of each row
  Choice rows_;
  LightSample middle_;
};

// What makes a picture no panorama: one infinite pixel would take all samples.
std::optional<std::string> fault(const Image& image) {
  if (!has_color(image)) return "the panorama has no colour channels";
  const ColorPlanes planes = color_planes(image);
  for (size_t i = 0; i < planes.r.size(); ++i)
    if (!std::isfinite(planes.r[i]) || !std::isfinite(planes.g[i]) || !std::isfinite(planes.b[i]))
      return fmt::format("pixel ({}, {}) of the panorama, from the upper left, is no finite number",
                         i % static_cast<size_t>(image.width), i / static_cast<size_t>(image.width));
  return std::nullopt;
}

}  // namespace

LightPtr make_light(const EnvironmentLight& light) {
  if (const std::optional<std::string> found = fault(light.image)) throw std::invalid_argument(*found);
  return std::make_shared<EnvironmentLamp>(light);
}

TypeDeclaration environment_light_type() {
  TypeDeclaration type = declare(Category::light, "environment_light",
                                 "Surroundings from a panorama, an equirectangular picture whose middle lies in the "
                                 "direction y. They light the scene and stand behind it. Shipped: "
                                 "studio/environments/studio.exr, sunset.exr, courtyard.exr.");
  type.field("file", file(), "the picture, usually OpenEXR or Radiance HDR")
      .field("rotation", angle(), "about z, counterclockwise from above", "0")
      .field("color", color().non_negative(), "multiplies the picture", "white")
      .field("intensity", number().non_negative(), "multiplies the picture", "1")
      .field("visible", boolean(), "false: the background stays as it is", "true")
      .field("shadows", boolean(), "false: the light passes through everything", "true");
  declare_area_sampling(type);
  type.example("file: studio/environments/studio.exr, intensity: 2");
  return type.built_by([](const Fields& f) {
    EnvironmentLight light;
    try {
      light.image = read_image(f.text("file"));
    } catch (const ImageError& error) {
      throw FieldError("file", error.what());
    }
    if (!has_color(light.image))
      throw FieldError("file", "the picture has no colour channels", "R, G, B or Y are needed");
    if (const std::optional<std::string> found = fault(light.image))
      throw FieldError("file", *found, "clamp the picture to what half floats hold, 65504");
    light.rotation = f.number("rotation");
    light.color = f.vec3("color");
    light.intensity = f.number("intensity");
    light.visible = f.boolean("visible");
    light.shadows = f.boolean("shadows");
    light.sampling = area_sampling(f);
    return make_light(light);
  });
}

}  // namespace lekalo::render
