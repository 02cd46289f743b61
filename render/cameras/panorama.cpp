// Central projections on a sphere and on a cylinder (Zavyalov et al. 1985, VI.1), unrolled, and the usual wide ones.
//
// With the point's coordinates X to the right, Y up and Z forward of the eye, and angles in radians:
//
//   sphere               x = atan(X/Z), y = atan(Y/Z): dihedral angles; what lies behind the eye is not seen
//   cylinder             x = angle of (X, Z) from Z, y = Y / sqrt(X^2 + Z^2)
//   longitude_latitude   x = angle of (X, Z) from Z, y = angle above the plane X, Z
//   fisheye              x, y = the angle from Z along the direction (X, Y)
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "render/cameras/view_fields.h"

namespace lekalo::render {

using namespace geometry;

namespace {

enum class Onto { sphere, cylinder, longitude_latitude, fisheye };

// Unit direction of the place (x, y), components to the right, up and forward.
Vec3 direction_of(Onto onto, double x, double y) {
  switch (onto) {
    case Onto::sphere: {
      constexpr double kEnd = 0.5 * kPi - 1e-9;
      return glm::normalize(Vec3(std::tan(std::clamp(x, -kEnd, kEnd)), std::tan(std::clamp(y, -kEnd, kEnd)), 1));
    }
    case Onto::cylinder:
      return glm::normalize(Vec3(std::sin(x), y, std::cos(x)));
    case Onto::longitude_latitude: {
      const double latitude = std::clamp(y, -0.5 * kPi, 0.5 * kPi);
      return {std::sin(x) * std::cos(latitude), std::sin(latitude), std::cos(x) * std::cos(latitude)};
    }
    case Onto::fisheye: {
      const double angle = std::hypot(x, y), turned = std::min(angle, kPi);
      const double share = angle > 0 ? std::sin(turned) / angle : 1;
      return {share * x, share * y, std::cos(turned)};
    }
  }
  return {0, 0, 1};
}

// The place of a vector from the eye.
Vec2 place_of(Onto onto, const Vec3& p) {
  const double across = std::hypot(p.x, p.z);
  switch (onto) {
    case Onto::sphere:
      return {std::atan2(p.x, p.z), std::atan2(p.y, p.z)};
    case Onto::cylinder:
      return {std::atan2(p.x, p.z), p.y / across};
    case Onto::longitude_latitude:
      return {std::atan2(p.x, p.z), std::atan2(p.y, across)};
    case Onto::fisheye: {
      const double aside = std::hypot(p.x, p.y), angle = std::atan2(aside, p.z);
      return aside > 0 ? Vec2(angle * p.x / aside, angle * p.y / aside) : Vec2(0);
    }
  }
  return Vec2(0);
}

struct PanoramaView {
  Onto onto = Onto::longitude_latitude;
  Vec3 from{0};
  Vec3 forward{0, 1, 0};  // unit
  Vec3 up{0, 0, 1};
  double field_of_view = kTwoPi;  // across the picture's width
};

class PanoramaCamera final : public Camera {
 public:
  PanoramaCamera(const PanoramaView& view, int width, int height)
      : view_(view),
        axes_(picture_axes(view.forward, view.up)),
        pixel_(view.field_of_view / width),
        width_(width),
        height_(height) {}

  Ray ray(double x, double y) const override {
    const Vec3 d = direction_of(view_.onto, (x - 0.5 * width_) * pixel_, (0.5 * height_ - y) * pixel_);
    Ray ray;
    ray.origin = view_.from;
    ray.direction = d.x * axes_.right + d.y * axes_.up + d.z * view_.forward;
    return ray;
  }
  PicturePoint project(const Vec3& point) const override {
    const Vec3 to = point - view_.from;
    const Vec3 local{glm::dot(to, axes_.right), glm::dot(to, axes_.up), glm::dot(to, view_.forward)};
    const Vec2 place = place_of(view_.onto, local);
    PicturePoint picture;
    picture.x = 0.5 * width_ + place.x / pixel_;
    picture.y = 0.5 * height_ - place.y / pixel_;
    picture.depth = glm::length(to);
    picture.visible_side = view_.onto != Onto::sphere || local.z > 0;
    return picture;
  }
  bool is_linear() const override { return false; }
  PictureMap picture_map() const override { throw std::logic_error("straight lines are bent in this picture"); }
  double pixel_size(const Vec3& point) const override { return pixel_ * glm::length(point - view_.from); }
  bool is_parallel() const override { return false; }
  Vec3 view_direction() const override { return view_.forward; }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  PanoramaView view_;
  PictureAxes axes_;
  double pixel_;  // radians
  int width_, height_;
};

}  // namespace

TypeDeclaration panorama_type() {
  return declare(
             Category::camera, "panorama",
             "All round the eye: central projection on a sphere or cylinder, unrolled to the picture. Straight lines "
             "are bent, so drawings and lines in pictures do not take it.")
      .example("from: [0, 0, 1], at: [0, 5, 1], onto: longitude_latitude")
      .field("from", point(), "where the eye is")
      .optional("at", point(), "the middle of the picture; default: the middle of what is shown")
      .field("up", direction(), "what is up in the picture", "z")
      .field(
          "onto", choice({"sphere", "cylinder", "longitude_latitude", "fisheye"}),
          "sphere: by the angles of planes through the eye, of what lies before it; cylinder: angles across, heights "
          "up; longitude_latitude: angles both ways, the whole sphere at a width of twice the height; fisheye: the "
          "angle from the middle of the picture",
          "longitude_latitude")
      .optional("field_of_view", angle().positive().at_most(kTwoPi),
                "across the picture's width; default 120 of a sphere, 180 of a fisheye, else 360")
      .built_by([](const Fields& f) -> CameraFactory {
        PanoramaView view;
        const std::string& onto = f.text("onto");
        view.onto = onto == "sphere"     ? Onto::sphere
                    : onto == "cylinder" ? Onto::cylinder
                    : onto == "fisheye"  ? Onto::fisheye
                                         : Onto::longitude_latitude;
        view.from = f.vec3("from");
        view.up = f.vec3("up");
        const bool has_at = f.has("at");
        const Vec3 at = has_at ? f.vec3("at") : Vec3(0);
        if (has_at && at == view.from)
          throw FieldError("at", "the camera stands at the point that it looks at", "move 'from' or 'at'");
        view.field_of_view = f.has("field_of_view")       ? f.number("field_of_view")
                             : view.onto == Onto::sphere  ? kPi * 2 / 3
                             : view.onto == Onto::fisheye ? kPi
                                                          : kTwoPi;
        if (view.onto == Onto::sphere && !(view.field_of_view < kPi))
          throw FieldError("field_of_view", "on a sphere by the angles of planes only what lies before the eye is seen",
                           "less than 180, or onto: longitude_latitude");
        return [=](int width, int height, const FramedContent& shown) mutable -> CameraPtr {
          const Vec3 to = (has_at ? at : middle(shown.box)) - view.from;
          view.forward = glm::length(to) > 0 ? glm::normalize(to) : Vec3(0, 1, 0);
          return std::make_shared<PanoramaCamera>(view, width, height);
        };
      });
}

}  // namespace lekalo::render
