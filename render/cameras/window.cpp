#include "render/cameras/window.h"

namespace lekalo::render {

namespace {

class WindowCamera final : public Camera {
 public:
  WindowCamera(CameraPtr camera, double x, double y, double zoom, int width, int height)
      : camera_(std::move(camera)), x_(x), y_(y), zoom_(zoom), width_(width), height_(height) {}

  Ray ray(double px, double py) const override { return camera_->ray(x_ + px / zoom_, y_ + py / zoom_); }
  bool has_lens() const override { return camera_->has_lens(); }
  Ray lens_ray(double px, double py, const Vec2& lens) const override {
    return camera_->lens_ray(x_ + px / zoom_, y_ + py / zoom_, lens);
  }
  PicturePoint project(const Vec3& point) const override {
    PicturePoint picture = camera_->project(point);
    picture.x = (picture.x - x_) * zoom_;
    picture.y = (picture.y - y_) * zoom_;
    return picture;
  }
  PictureMap picture_map() const override {
    PictureMap map = camera_->picture_map();
    map.row[0] = zoom_ * (map.row[0] - x_ * map.row[2]);
    map.row[1] = zoom_ * (map.row[1] - y_ * map.row[2]);
    return map;
  }
  double pixel_size(const Vec3& point) const override { return camera_->pixel_size(point) / zoom_; }
  bool is_parallel() const override { return camera_->is_parallel(); }
  Vec3 view_direction() const override { return camera_->view_direction(); }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  CameraPtr camera_;
  double x_, y_, zoom_;
  int width_, height_;
};

}  // namespace

CameraPtr window_of(CameraPtr camera, double x, double y, double zoom, int width, int height) {
  return std::make_shared<WindowCamera>(std::move(camera), x, y, zoom, width, height);
}

}  // namespace lekalo::render
