// Daylight: the clear sky as a panorama, the sun as a disc of it. Both in one unit, 10 kcd/m^2: at intensity 1 a white
// matt surface in the midday sun shows about 3.
#include <cmath>

#include "render/image/image.h"
#include "render/lights/daylight.h"
#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kUnit = 10;  // kcd/m^2 of a radiance of 1
constexpr double kSunDiameter = 0.533 * kPi / 180;
constexpr int kHeight = 256;  // of the panorama, a pixel 0.7 degrees

// Direction of a pixel of a panorama (environment_light.cpp).
Vec3 direction_of(int column, int row) {
  const double azimuth = 0.5 * kPi - kTwoPi * ((column + 0.5) / (2 * kHeight) - 0.5);
  const double polar = kPi * (row + 0.5) / kHeight;
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

// Light of the sky on level ground, the integral of radiance times cosine.
Vec3 on_ground(const std::vector<Vec3>& upper) {
  Vec3 sum(0);
  const double cell = kPi / kHeight;
  for (int row = 0; row < kHeight / 2; ++row)
    for (int column = 0; column < 2 * kHeight; ++column) {
      const Vec3 w = direction_of(column, row);
      sum += upper[static_cast<size_t>(row) * 2 * kHeight + static_cast<size_t>(column)] *
             (w.z * std::hypot(w.x, w.y) * cell * cell);
    }
  return sum;
}

Image panorama(const Vec3& to_sun, double turbidity, const Vec3& ground) {
  const Daylight day(to_sun, turbidity);
  std::vector<Vec3> colors;
  for (int row = 0; row < kHeight / 2; ++row)
    for (int column = 0; column < 2 * kHeight; ++column)
      colors.push_back(day.radiance(direction_of(column, row)) / kUnit);
  const Vec3 below = ground * (on_ground(colors) + std::max(0.0, to_sun.z) * day.sun() / kUnit) / kPi;
  colors.resize(2 * colors.size(), below);
  Image image = make_image(2 * kHeight, kHeight);
  for (int c = 0; c < 3; ++c) {
    Channel& channel = add_channel(image, std::string(1, "RGB"[c]));
    for (size_t i = 0; i < colors.size(); ++i) channel.values[i] = static_cast<float>(colors[i][c]);
  }
  return image;
}

void declare_daylight(TypeDeclaration& type) {
  type.field("sun", direction(), "towards the sun")
      .field("turbidity", number().between(1.7, 10), "haze of the air: 2 is a very clear day, 6 a hazy one", "2.5")
      .field("intensity", number().non_negative(), "multiplies it; 1: a radiance of 1 is 10 kcd/m^2", "1");
}

Vec3 to_sun(const Fields& f) {
  const Vec3 sun = glm::normalize(f.vec3("sun"));
  if (!(sun.z > 0)) throw FieldError("sun", "the sun stands below the horizon", "give a direction with z above 0");
  return sun;
}

}  // namespace

TypeDeclaration sky_light_type() {
  TypeDeclaration type =
      declare(Category::light, "sky_light",
              "Clear sky by day, all around and behind everything, by the model of Preetham, Shirley "
              "and Smits (1999); without the disc of the sun, which is sun_light.");
  declare_daylight(type);
  type.field("ground", color().between(0, 1), "share of the light that the ground below the horizon sends back", "0.2")
      .field("visible", boolean(), "false: the background stays as it is", "true")
      .field("shadows", boolean(), "false: the light passes through everything", "true");
  declare_area_sampling(type);
  type.example("sun: [-2, -3, 3], intensity: 0.3");
  return type.built_by([](const Fields& f) {
    EnvironmentLight light;
    light.image = panorama(to_sun(f), f.number("turbidity"), f.vec3("ground"));
    light.intensity = f.number("intensity");
    light.visible = f.boolean("visible");
    light.shadows = f.boolean("shadows");
    light.sampling = area_sampling(f);
    return make_light(light);
  });
}

TypeDeclaration sun_light_type() {
  TypeDeclaration type =
      declare(Category::light, "sun_light",
              "The sun on a clear day, 0.53 degrees wide, in the colour that the way through the air "
              "leaves it, by the model of Preetham, Shirley and Smits (1999).");
  declare_daylight(type);
  type.field("shadows", boolean(), "false: the light passes through everything", "true");
  declare_area_sampling(type);
  type.example("sun: [-2, -3, 3], intensity: 0.3");
  return type.built_by([](const Fields& f) {
    DistantLight light;
    light.direction = -to_sun(f);
    light.angular_diameter = kSunDiameter;
    light.sampling = area_sampling(f);
    const Daylight day(-light.direction, f.number("turbidity"));
    light.lamp.color = day.sun() / (kPi * kUnit);
    light.lamp.spectrum =
        std::make_shared<LampSpectrum>([day](double nanometres) { return day.sun_power(nanometres); });
    light.lamp.intensity = f.number("intensity");
    light.lamp.shadows = f.boolean("shadows");
    return make_light(light);
  });
}

}  // namespace lekalo::render
