// From picture points to rays and back.
#pragma once

#include <array>
#include <memory>

#include "geometry/vectors.h"
#include "render/ray.h"

namespace lekalo::render {

// Where a point of space falls in the picture.
struct PicturePoint {
  double x = 0;              // pixels from the left edge
  double y = 0;              // pixels from the top edge
  double depth = 0;          // distance along the view direction (parallel) or from the eye (perspective): the Z layer
  bool visible_side = true;  // false for points behind the eye
};

// The projection of points before the viewer as a map of homogeneous coordinates, for what is projected whole: curves
// with their derivatives and bounds. x = row[0] . p / row[2] . p, y = row[1] . p / row[2] . p with p = (point, 1), in
// pixels; row[2] . p > 0 on the visible side.
struct PictureMap {
  std::array<geometry::Vec4, 3> row{};
};

class Camera {
 public:
  virtual ~Camera() = default;
  // Ray through the picture point (x, y) in pixels from the upper left corner of the full picture.
  virtual Ray ray(double x, double y) const = 0;
  // True if the rays of a picture point come from all of a lens: things out of focus are blurred. Then ray() goes
  // through the lens's middle, and lens_ray() through the place of it that belongs to a place of the unit square.
  virtual bool has_lens() const { return false; }
  virtual Ray lens_ray(double x, double y, const Vec2& /*lens*/) const { return ray(x, y); }
  virtual PicturePoint project(const Vec3& point) const = 0;
  // Whether straight lines have straight pictures; of other cameras picture_map() throws std::logic_error.
  virtual bool is_linear() const { return true; }
  virtual PictureMap picture_map() const = 0;  // agrees with project()
  // Width of one pixel at the given place, in scene units.
  virtual double pixel_size(const Vec3& point) const = 0;
  virtual bool is_parallel() const = 0;
  virtual bool is_graph() const { return false; }  // x and y are scaled independently: axes may stand beside it
  virtual Vec3 view_direction() const = 0;         // unit, from the viewer into the scene
  virtual int width() const = 0;                   // pixels of the full picture
  virtual int height() const = 0;
};
using CameraPtr = std::shared_ptr<const Camera>;

}  // namespace lekalo::render
