// Graphs of functions: the x, y plane seen from above, both axes scaled independently to the picture.
#include <stdexcept>

#include "render/cameras/view_fields.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class GraphCamera final : public Camera {
 public:
  GraphCamera(const Interval& x, const Interval& y, double above, int width, int height)
      : x_(x), y_(y), above_(above), width_(width), height_(height) {}

  Ray ray(double px, double py) const override {
    Ray ray;
    ray.origin = {x_.lo + px / width_ * (x_.hi - x_.lo), y_.hi - py / height_ * (y_.hi - y_.lo), above_};
    ray.direction = {0, 0, -1};
    return ray;
  }

  PicturePoint project(const Vec3& point) const override {
    PicturePoint picture;
    picture.x = (point.x - x_.lo) / (x_.hi - x_.lo) * width_;
    picture.y = (y_.hi - point.y) / (y_.hi - y_.lo) * height_;
    picture.depth = above_ - point.z;
    return picture;
  }

  PictureMap picture_map() const override {
    const double right = width_ / (x_.hi - x_.lo), down = -height_ / (y_.hi - y_.lo);
    return {{Vec4(right, 0, 0, -right * x_.lo), Vec4(0, down, 0, -down * y_.hi), Vec4(0, 0, 0, 1)}};
  }

  double pixel_size(const Vec3&) const override {
    return std::min((x_.hi - x_.lo) / width_, (y_.hi - y_.lo) / height_);
  }
  bool is_parallel() const override { return true; }
  bool is_graph() const override { return true; }
  Vec3 view_direction() const override { return {0, 0, -1}; }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  Interval x_, y_;
  double above_;  // height of the picture plane
  int width_, height_;
};

// The range that is shown of one axis: as given, or all that there is.
Interval shown_range(const std::optional<Interval>& given, double lo, double hi) {
  if (given) return *given;
  return hi > lo ? Interval{lo, hi} : Interval{lo - 0.5, lo + 0.5};
}

}  // namespace

TypeDeclaration graph_type() {
  TypeDeclaration type =
      declare(Category::camera, "graph", "Graphs of functions: the x, y plane, both axes scaled to the picture.");
  return type.optional("x", range(), "part of the x axis that is shown; all by default")
      .optional("y", range(), "part of the y axis that is shown; all by default")
      .built_by([](const Fields& f) -> CameraFactory {
        std::optional<Interval> x, y;
        if (f.has("x")) x = f.range("x");
        if (f.has("y")) y = f.range("y");
        return [x, y](int width, int height, const FramedContent& shown) -> CameraPtr {
          const Box3& box = shown.tight_box();
          return std::make_shared<GraphCamera>(shown_range(x, box.lo.x, box.hi.x), shown_range(y, box.lo.y, box.hi.y),
                                               box.hi.z + std::max(1.0, box.size().z), width, height);
        };
      });
}

}  // namespace lekalo::render
