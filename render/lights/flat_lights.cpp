// Light from a flat area, rectangle or disc: penumbras (Golovanov 2016, 8.5). A point gets the mean of the light of
// point lights over the area; of a one-sided area, a matt emitter, each counts with the cosine at the area, so that
// with decay inverse_square it is an emitter of the radiance pi I / area.
#include <algorithm>
#include <cmath>

#include <vector>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class FlatLamp : public SpectralLight {
 public:
  FlatLamp(const Frame& frame, bool one_sided, const AreaSampling& sampling, const Lamp& lamp)
      : SpectralLight(lamp),
        frame_(frame),
        one_sided_(one_sided),
        weight_(1.0 / (sampling.n * sampling.n)),
        sampling_(sampling),
        lamp_(lamp),
        irradiance_(lamp) {}

  int sample_count() const override { return sampling_.n * sampling_.n; }

  LightSample sample(const Vec3& point, int index, double r1, double r2) const override {
    LightSample sample = sample_at(point, sampling_.grid ? grid_[index] : place(index, r1, r2));
    sample.weight = weight_;
    return sample;
  }
  LightSample sample_all(const Vec3& point, const Vec2& square) const override {
    return sample_at(point, frame_.point(Vec3(on_area(square), 0)));
  }
  std::optional<LightSample> towards(const Vec3& point, const Vec3& direction) const override {
    const double t = glm::dot(frame_.origin - point, frame_.z) / glm::dot(direction, frame_.z);
    if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
    const Vec3 place = point + t * direction;
    const Vec3 local = frame_.to_local_point(place);
    if (!is_on_area({local.x, local.y})) return std::nullopt;
    return sample_at(point, place);
  }
  bool has_size() const override { return true; }
  bool is_jittered() const override { return !sampling_.grid; }
  Box3 places() const override { return places_; }
  bool casts_shadows() const override { return lamp_.shadows; }

 protected:
  // To be called when on_area knows the light's shape, which lies within +-half along the axes of the frame.
  void lay_out(const Vec2& half) {
    for (const double x : {-half.x, half.x})
      for (const double y : {-half.y, half.y}) places_.include(frame_.point({x, y, 0}));
    places_ = places_.inflated(1e-12 * (places_.diameter() + glm::length(frame_.origin)));
    if (!sampling_.grid) return;
    for (int i = 0; i < sample_count(); ++i) grid_.push_back(place(i, 0, 0));
  }
  // Place in the frame's xy plane of a place in the unit square, area preserving up to a factor.
  virtual Vec2 on_area(const Vec2& square) const = 0;
  virtual bool is_on_area(const Vec2& place) const = 0;
  virtual double area() const = 0;

 private:
  LightSample sample_at(const Vec3& point, const Vec3& place) const {
    const Vec3 to_light = place - point;
    const double distance = glm::length(to_light);
    const Vec3 direction = (1 / distance) * to_light;
    const double cosine = -glm::dot(direction, frame_.z);
    LightSample sample{direction, distance, irradiance_.at(distance)};
    if (one_sided_) sample.irradiance *= static_cast<float>(std::max(0.0, cosine));
    sample.density = distance * distance / (area() * std::max(std::fabs(cosine), 1e-12));
    return sample;
  }
  Vec3 place(int index, double r1, double r2) const {
    return frame_.point(Vec3(on_area(area_sample(sampling_, index, r1, r2)), 0));
  }

  std::vector<Vec3> grid_;  // the fixed places
  Box3 places_;
  Frame frame_;
  bool one_sided_;
  double weight_;  // of a sample
  AreaSampling sampling_;
  Lamp lamp_;
  Irradiance irradiance_;
};

class RectangleLamp final : public FlatLamp {
 public:
  explicit RectangleLamp(const RectangleLight& light)
      : FlatLamp(light.frame, light.one_sided, light.sampling, light.lamp), light_(light) {
    lay_out(0.5 * light.size);
  }
  Vec2 on_area(const Vec2& square) const override { return (square - 0.5) * light_.size; }
  bool is_on_area(const Vec2& place) const override {
    return std::fabs(place.x) <= 0.5 * light_.size.x && std::fabs(place.y) <= 0.5 * light_.size.y;
  }
  double area() const override { return light_.size.x * light_.size.y; }
  std::any made_from() const override { return light_; }

 private:
  RectangleLight light_;
};

class DiscLamp final : public FlatLamp {
 public:
  explicit DiscLamp(const DiscLight& light)
      : FlatLamp(light.frame, light.one_sided, light.sampling, light.lamp), light_(light) {
    lay_out(Vec2(light.radius));
  }
  Vec2 on_area(const Vec2& square) const override { return light_.radius * concentric_disc(square); }
  bool is_on_area(const Vec2& place) const override { return glm::dot(place, place) <= light_.radius * light_.radius; }
  double area() const override { return kPi * light_.radius * light_.radius; }
  std::any made_from() const override { return light_; }

 private:
  DiscLight light_;
};

void declare_area(TypeDeclaration& type) {
  type.field(
      "one_sided", boolean(),
      "true: shines to the side of z only, less to the edges (cosine), as a glowing panel does; false: evenly in all "
      "directions",
      "false");
  declare_area_sampling(type);
  declare_lamp(type);
}

}  // namespace

LightPtr make_light(const RectangleLight& light) { return std::make_shared<RectangleLamp>(light); }
LightPtr make_light(const DiscLight& light) { return std::make_shared<DiscLamp>(light); }

TypeDeclaration rectangle_light_type() {
  TypeDeclaration type = declare(Category::light, "rectangle_light", "Light from a rectangle: soft shadows.");
  type.field("frame", frame(), "the rectangle lies in its xy plane, centred at the origin", "{}")
      .field("size", numbers().positive().count(2, 2), "along x and y of the frame");
  declare_area(type);
  type.example("frame: { origin: [3, -4, 5], z: [-3, 4, -5] }, size: [2, 2]");
  return type.built_by([](const Fields& f) {
    const std::vector<double>& size = f.numbers("size");
    return make_light(RectangleLight{f.frame(), {size[0], size[1]}, f.boolean("one_sided"), area_sampling(f), lamp(f)});
  });
}

TypeDeclaration disc_light_type() {
  TypeDeclaration type = declare(Category::light, "disc_light", "Light from a disc: soft shadows.");
  type.field("frame", frame(), "the disc lies in its xy plane, centred at the origin", "{}")
      .field("radius", length().positive(), "of the disc");
  declare_area(type);
  type.example("frame: { origin: [3, -4, 5], z: [-3, 4, -5] }, radius: 1");
  return type.built_by([](const Fields& f) {
    return make_light(DiscLight{f.frame(), f.number("radius"), f.boolean("one_sided"), area_sampling(f), lamp(f)});
  });
}

}  // namespace lekalo::render
