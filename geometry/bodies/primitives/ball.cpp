// Ball (Golovanov 2016, 5.6): one face, the sphere by longitude and latitude; the seam runs along longitude 0, the
// poles are pole edges. Loop: +south +seam -north -seam.
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry {

Body ball(const Frame& frame, double radius) {
  const Interval turn{0, kTwoPi}, latitude{-0.5 * kPi, 0.5 * kPi};
  Body body;
  const int south = body.add_vertex(frame.origin - radius * frame.z, {"", "south"});
  const int north = body.add_vertex(frame.origin + radius * frame.z, {"", "north"});
  const int south_pole =
      body.add_edge(point_curve(turn, body.vertices[south].point), south, south, {"", "south"}, EdgeKind::pole);
  const int north_pole =
      body.add_edge(point_curve(turn, body.vertices[north].point), north, north, {"", "north"}, EdgeKind::pole);
  const Frame meridian{frame.origin, frame.x, frame.z, -frame.y};
  const int seam =
      body.add_edge(std::make_shared<Circle>(meridian, radius, latitude), south, north, {"", "seam"}, EdgeKind::seam);
  const int face = body.add_face(std::make_shared<SphereSurface>(frame, radius), true, {"", "side"}, false);
  body.add_loop(face, {{south_pole, true, image_line(turn, {0, latitude.lo}, {kTwoPi, latitude.lo})},
                       {seam, true, image_line(latitude, {kTwoPi, latitude.lo}, {kTwoPi, latitude.hi})},
                       {north_pole, false, image_line(turn, {0, latitude.hi}, {kTwoPi, latitude.hi})},
                       {seam, false, image_line(latitude, {0, latitude.lo}, {0, latitude.hi})}});
  body.close_shell();
  return body;
}

TypeDeclaration ball_type() {
  return declare(Category::body, "ball", "Solid sphere. Face: side.")
      .field("frame", frame(), "placement: the center, the axis z through the poles, x at longitude 0", "{}")
      .field("radius", length().positive(), "radius")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(ball(f.frame(), f.number("radius"))); });
}

}  // namespace lekalo::geometry
