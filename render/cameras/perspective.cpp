// Central projection: rays from the eye through a picture plane at distance 1; or from a thin lens around the eye
// through the plane in focus, where the ray through the lens's middle meets it.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/cameras/view_fields.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// The place of a lens of radius 1 that belongs to a place of the unit square, area preserving.
Vec2 on_lens(const Lens& lens, const Vec2& square) {
  const double outwards = std::sqrt(square.x);
  if (lens.blades < 3) {
    const double angle = kTwoPi * square.y;
    return outwards * Vec2(std::cos(angle), std::sin(angle));
  }
  // Triangles from the middle to each side.
  const auto corner = [&](double k) {
    const double angle = lens.rotation + kTwoPi * k / lens.blades;
    return Vec2(std::cos(angle), std::sin(angle));
  };
  const double side = std::floor(square.y * lens.blades), along = square.y * lens.blades - side;
  return outwards * glm::mix(corner(side), corner(side + 1), along);
}

class PerspectiveCamera final : public Camera {
 public:
  PerspectiveCamera(const PerspectiveView& view, int width, int height)
      : from_(view.from), lens_(view.lens), width_(width), height_(height) {
    const Vec3 to = view.at - view.from;
    const double distance = glm::length(to);
    if (!(distance > 0)) throw std::invalid_argument("the camera stands at the point that it looks at");
    if (!(view.field_of_view > 0 && view.field_of_view < kPi))
      throw std::invalid_argument("the field of view must lie between 0 and 180 degrees");
    if (!(view.lens.radius >= 0 && view.lens.focus > 0))
      throw std::invalid_argument("a lens has a radius of 0 or more and is focused before the camera");
    forward_ = to / distance;
    axes_ = picture_axes(forward_, view.up);
    pixel_ = 2 * std::tan(0.5 * view.field_of_view) / std::min(width, height);
  }

  Ray ray(double x, double y) const override {
    Ray ray;
    ray.origin = from_;
    ray.direction =
        glm::normalize(forward_ + (x - 0.5 * width_) * pixel_ * axes_.right + (0.5 * height_ - y) * pixel_ * axes_.up);
    return ray;
  }

  bool has_lens() const override { return lens_.radius > 0; }
  Ray lens_ray(double x, double y, const Vec2& square) const override {
    Ray ray = this->ray(x, y);
    const Vec3 sharp = (lens_.focus / glm::dot(ray.direction, forward_)) * ray.direction;
    const Vec2 place = lens_.radius * on_lens(lens_, square);
    const Vec3 aside = place.x * axes_.right + place.y * axes_.up;
    ray.origin += aside;
    ray.direction = glm::normalize(sharp - aside);
    return ray;
  }

  PicturePoint project(const Vec3& point) const override {
    const Vec3 to = point - from_;
    const double z = glm::dot(to, forward_);
    PicturePoint picture;
    picture.depth = glm::length(to);
    picture.visible_side = z > 0;
    picture.x = 0.5 * width_ + glm::dot(to, axes_.right) / (z * pixel_);
    picture.y = 0.5 * height_ - glm::dot(to, axes_.up) / (z * pixel_);
    return picture;
  }

  PictureMap picture_map() const override {
    const Vec4 depth(forward_, -glm::dot(forward_, from_));
    const Vec3 right = axes_.right / pixel_, down = -axes_.up / pixel_;
    return {{Vec4(right, -glm::dot(right, from_)) + 0.5 * width_ * depth,
             Vec4(down, -glm::dot(down, from_)) + 0.5 * height_ * depth, depth}};
  }

  double pixel_size(const Vec3& point) const override { return pixel_ * std::fabs(glm::dot(point - from_, forward_)); }
  bool is_parallel() const override { return false; }
  Vec3 view_direction() const override { return forward_; }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  Vec3 from_, forward_;
  PictureAxes axes_;
  Lens lens_;
  double pixel_;  // width of a pixel at distance 1
  int width_, height_;
};

}  // namespace

CameraPtr make_camera(const PerspectiveView& view, int width, int height) {
  return std::make_shared<PerspectiveCamera>(view, width, height);
}

namespace {

// What puts the lens of the fields into a view that knows where it looks.
std::function<void(PerspectiveView&)> lens_of(const Fields& f) {
  if (!f.has("lens")) return [](PerspectiveView&) {};
  const Fields& g = f.group("lens");
  Lens lens;
  lens.radius = 0.5 * g.number("diameter");
  lens.blades = g.has("blades") ? g.integer("blades") : 0;
  lens.rotation = g.number("rotation");
  const double focus = g.has("focus") ? g.number("focus") : 0;
  return [lens, focus](PerspectiveView& view) {
    view.lens = lens;
    view.lens.focus = focus > 0 ? focus : glm::length(view.at - view.from);
  };
}

}  // namespace

TypeDeclaration perspective_type() {
  TypeDeclaration type = declare(Category::camera, "perspective", "Central projection, as an eye or a camera sees.")
                             .example("from: [4, -7, 4], at: [0, 0, 0], field_of_view: 40");
  type.optional("from", point(), "where the eye is; without it all is framed, seen as `view` says")
      .optional("at", point(), "the middle of the picture; default: the middle of what is framed")
      .field("up", direction(), "what is up in the picture", "z")
      .field("field_of_view", angle().positive().at_most(kPi * 170 / 180), "of the picture's shorter side", "40")
      .optional(
          "lens",
          group(
              {{"diameter", length().positive(), "of the opening of the lens", true, {}},
               {"focus", length().positive(), "distance along the view of what is sharp; default: of `at`", false, {}},
               {"blades", integer().between(3, 100), "corners of the opening; default: it is round", false, {}},
               {"rotation", angle(), "of a corner, from the picture's right upwards", false, "0"}}),
          "a thin lens: things nearer and farther than its focus are blurred; without it everything is sharp");
  declare_view(type, "{ azimuth: -60, elevation: 25 }");
  return type.built_by([](const Fields& f) -> CameraFactory {
    const ViewFields fields = view_fields(f);
    const double field_of_view = f.number("field_of_view");
    const std::function<void(PerspectiveView&)> put_lens = lens_of(f);
    if (fields.view.oblique != 0)
      throw FieldError("view", "oblique views exist only in parallel projection", "use type: parallel");
    if (!f.has("from")) {
      if (f.has("at")) throw FieldError("at", "'at' needs 'from'", "give both, or none to have everything framed");
      return [=](int width, int height, const FramedContent& shown) {
        PerspectiveView view =
            framed_perspective(fields.view, field_of_view, width, height, fields.shown(shown).points(), fields.margin);
        put_lens(view);
        return make_camera(view, width, height);
      };
    }
    check_placed(f);
    PerspectiveView view{f.vec3("from"), {}, f.vec3("up"), field_of_view, {}};
    const bool has_at = f.has("at");
    if (has_at) view.at = f.vec3("at");
    if (has_at && view.at == view.from)
      throw FieldError("at", "the camera stands at the point that it looks at", "move 'from' or 'at'");
    return [=](int width, int height, const FramedContent& shown) mutable {
      if (!has_at) view.at = middle(fields.shown(shown).box);
      put_lens(view);
      return make_camera(view, width, height);
    };
  });
}

}  // namespace lekalo::render
