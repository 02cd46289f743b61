// Cameras as plain values for C++ programs: fill in a struct, make_camera() it. Scene files build the same structs.
// The world is right-handed with z up; picture x goes right, picture y down, pixel (0, 0) is the upper left one.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/cameras/framed_content.h"

namespace lekalo::render {

// A thin lens, across the view: things at the distance `focus` along the view are sharp, others blurred.
struct Lens {
  double radius = 0;    // scene units, >= 0; 0: a pinhole, everything is sharp
  double focus = 1;     // > 0
  int blades = 0;       // of the aperture: 3 and more make a regular polygon with its corners at the radius; 0: a disc
  double rotation = 0;  // radians, of a corner of the polygon, from the picture's right upwards
};

// Central projection (Golovanov 2016, 8.5).
struct PerspectiveView {
  Vec3 from{0, -10, 0};
  Vec3 at{0};
  Vec3 up{0, 0, 1};  // need not be at right angles to the view; parallel to it: the y axis takes its place
  double field_of_view = 40 * geometry::kPi / 180;  // radians, of the picture's shorter side, in (0, pi)
  Lens lens;
};

// Parallel projection on the plane through `from` across the view from->at. A point stands where the line through it
// along `along` meets that plane; `along` other than from->at gives the oblique views (cavalier, cabinet).
// Rays begin at the plane: what lies before it is not seen.
struct ParallelView {
  Vec3 from{0, -10, 0};
  Vec3 at{0};
  Vec3 up{0, 0, 1};    // as above
  double height = 10;  // of the picture in scene units
  Vec3 along{0};       // zero: at right angles to the plane
};

// Throw std::invalid_argument if `from` and `at` coincide or a number is out of its range. width, height: pixels >= 1.
CameraPtr make_camera(const PerspectiveView& view, int width, int height);
CameraPtr make_camera(const ParallelView& view, int width, int height);

// Where a view looks from: a unit vector from the scene to the viewer, the direction that is up in the picture, and for
// oblique views how far the depth axis y is drawn along the picture's diagonal (0: not oblique).
struct ViewDirection {
  Vec3 to_viewer{0, -1, 0};
  Vec3 up{0, 0, 1};
  double oblique = 0;
};

// Names of the preset views: front back left right top bottom isometric dimetric cavalier cabinet.
const std::vector<std::string>& view_names();

// Front looks along +y (x right, z up), top down along -z (x right, y up). Isometric: all axes shortened alike
// (azimuth -45 degrees, elevation 35.26). Dimetric: x and z alike, y half of them (ISO 5456-3: axes at 7 and 42
// degrees). Cavalier and cabinet: the front view with y drawn at 45 degrees, full length or half.
// Throws std::invalid_argument for another name.
ViewDirection preset_view(std::string_view name);

// Angles in radians; azimuth from x towards y of the viewer's place, elevation above the xy plane: front is (-pi/2, 0).
ViewDirection view_from_angles(double azimuth, double elevation);

// Parallel camera with the points (at least one) in the middle of the picture, touching the margin on two sides.
// `margin`: share of the picture's shorter side left free on each side, in [0, 0.5).
CameraPtr make_view_camera(const ViewDirection& view, int width, int height, std::span<const Vec3> points,
                           double margin);

// Perspective camera that looks along -to_viewer with all points inside the margin, as near as possible, their picture
// in the middle.
PerspectiveView framed_perspective(const ViewDirection& view, double field_of_view, int width, int height,
                                   std::span<const Vec3> points, double margin);

// What a scene file's camera is until the size of the picture and what it shall show are known.
using CameraFactory = std::function<CameraPtr(int width, int height, const FramedContent& shown)>;

// Right and up of the picture for a unit view direction: up projected; the y axis where up is parallel to the view.
struct PictureAxes {
  Vec3 right{1, 0, 0};
  Vec3 up{0, 0, 1};
};
PictureAxes picture_axes(const Vec3& view_direction, const Vec3& up);

}  // namespace lekalo::render
