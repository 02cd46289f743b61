// Parallel projection, at right angles to the picture plane or oblique.
#include <cmath>
#include <stdexcept>

#include "render/cameras/view_fields.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ParallelCamera final : public Camera {
 public:
  ParallelCamera(const ParallelView& view, int width, int height)
      : origin_(view.from), width_(width), height_(height), pixel_(view.height / height) {
    const Vec3 to = view.at - view.from;
    if (!(glm::length(to) > 0)) throw std::invalid_argument("the camera stands at the point that it looks at");
    if (!(view.height > 0)) throw std::invalid_argument("the height of the picture must be positive");
    normal_ = glm::normalize(to);
    axes_ = picture_axes(normal_, view.up);
    along_ = view.along == Vec3(0) ? normal_ : glm::normalize(view.along);
    if (!(glm::dot(along_, normal_) > 0))
      throw std::invalid_argument("the rays of a parallel camera must go the way that it looks");
  }

  Ray ray(double x, double y) const override {
    Ray ray;
    ray.origin = origin_ + (x - 0.5 * width_) * pixel_ * axes_.right + (0.5 * height_ - y) * pixel_ * axes_.up;
    ray.direction = along_;
    return ray;
  }

  PicturePoint project(const Vec3& point) const override {
    PicturePoint picture;
    picture.depth = glm::dot(point - origin_, normal_) / glm::dot(along_, normal_);
    const Vec3 in_plane = point - picture.depth * along_ - origin_;
    picture.x = 0.5 * width_ + glm::dot(in_plane, axes_.right) / pixel_;
    picture.y = 0.5 * height_ - glm::dot(in_plane, axes_.up) / pixel_;
    return picture;
  }

  PictureMap picture_map() const override {
    // What is left of a vector in the picture plane when it is moved there along the rays.
    const double slant = glm::dot(along_, normal_);
    const auto in_plane = [&](const Vec3& axis) { return (axis - glm::dot(axis, along_) / slant * normal_) / pixel_; };
    const Vec3 right = in_plane(axes_.right), down = -in_plane(axes_.up);
    return {{Vec4(right, 0.5 * width_ - glm::dot(right, origin_)), Vec4(down, 0.5 * height_ - glm::dot(down, origin_)),
             Vec4(0, 0, 0, 1)}};
  }

  double pixel_size(const Vec3&) const override { return pixel_; }
  bool is_parallel() const override { return true; }
  Vec3 view_direction() const override { return along_; }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  Vec3 origin_, normal_, along_;
  PictureAxes axes_;
  int width_, height_;
  double pixel_;
};

}  // namespace

CameraPtr make_camera(const ParallelView& view, int width, int height) {
  return std::make_shared<ParallelCamera>(view, width, height);
}

TypeDeclaration parallel_type() {
  TypeDeclaration type = declare(Category::camera, "parallel",
                                 "Parallel projection: the views of technical drawing, axonometric and oblique.")
                             .example("view: isometric");
  type.optional("from", point(), "a point of the picture plane, its middle; what lies before the plane is not seen")
      .optional("at", point(), "the view goes from `from` to here; default: the middle of what is framed")
      .field("up", direction(), "what is up in the picture", "z")
      .optional("height", length().positive(), "of the picture in scene units; needed with `from`");
  declare_view(type, "front");
  return type.built_by([](const Fields& f) -> CameraFactory {
    const ViewFields fields = view_fields(f);
    if (!f.has("from")) {
      for (const char* name : {"at", "height"})
        if (f.has(name))
          throw FieldError(name, "'" + std::string(name) + "' needs 'from'",
                           "or leave both out to have everything framed");
      return [=](int width, int height, const FramedContent& shown) {
        return make_view_camera(fields.view, width, height, fields.shown(shown).points(), fields.margin);
      };
    }
    check_placed(f);
    if (!f.has("height"))
      throw FieldError("height", "a parallel view with 'from' needs 'height'",
                       "the height of the picture in scene units");
    ParallelView view;
    view.from = f.vec3("from");
    view.up = f.vec3("up");
    view.height = f.number("height");
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
