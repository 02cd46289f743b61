// Central projection: rays from the eye through a picture plane at distance 1.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/cameras/view_fields.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class PerspectiveCamera final : public Camera {
 public:
  PerspectiveCamera(const PerspectiveView& view, int width, int height)
      : from_(view.from), width_(width), height_(height) {
    const Vec3 to = view.at - view.from;
    const double distance = glm::length(to);
    if (!(distance > 0)) throw std::invalid_argument("the camera stands at the point that it looks at");
    if (!(view.field_of_view > 0 && view.field_of_view < kPi))
      throw std::invalid_argument("the field of view must lie between 0 and 180 degrees");
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
  double pixel_;  // width of a pixel at distance 1
  int width_, height_;
};

}  // namespace

CameraPtr make_camera(const PerspectiveView& view, int width, int height) {
  return std::make_shared<PerspectiveCamera>(view, width, height);
}

TypeDeclaration perspective_type() {
  TypeDeclaration type = declare(Category::camera, "perspective", "Central projection, as an eye or a camera sees.")
                             .example("from: [4, -7, 4], at: [0, 0, 0], field_of_view: 40");
  type.optional("from", point(), "where the eye is; without it all is framed, seen as `view` says")
      .optional("at", point(), "the middle of the picture; default: the middle of what is framed")
      .field("up", direction(), "what is up in the picture", "z")
      .field("field_of_view", angle().positive().at_most(kPi * 170 / 180), "of the picture's shorter side", "40");
  declare_view(type, "{ azimuth: -60, elevation: 25 }");
  return type.built_by([](const Fields& f) -> CameraFactory {
    const ViewFields fields = view_fields(f);
    const double field_of_view = f.number("field_of_view");
    if (fields.view.oblique != 0)
      throw FieldError("view", "oblique views exist only in parallel projection", "use type: parallel");
    if (!f.has("from")) {
      if (f.has("at")) throw FieldError("at", "'at' needs 'from'", "give both, or none to have everything framed");
      return [=](int width, int height, const FramedContent& shown) {
        return make_camera(
            framed_perspective(fields.view, field_of_view, width, height, fields.shown(shown).points(), fields.margin),
            width, height);
      };
    }
    check_placed(f);
    PerspectiveView view{f.vec3("from"), {}, f.vec3("up"), field_of_view};
    const bool has_at = f.has("at");
    if (has_at) view.at = f.vec3("at");
    if (has_at && view.at == view.from)
      throw FieldError("at", "the camera stands at the point that it looks at", "move 'from' or 'at'");
    return [=](int width, int height, const FramedContent& shown) mutable {
      if (!has_at) view.at = middle(fields.shown(shown).box);
      return make_camera(view, width, height);
    };
  });
}

}  // namespace lekalo::render
