// Ring torus body (Golovanov 2016, 5.6): one face, both edges closed seams, the inner equator (v = -pi = pi) and the
// meridian u = 0 = 2 pi. Loop: +equator +meridian -equator -meridian.
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

Body torus_body(const Frame& frame, double major_radius, double minor_radius) {
  if (!(minor_radius > 0 && major_radius > minor_radius))
    throw std::invalid_argument("a torus body needs 0 < minor_radius < major_radius; others meet themselves");
  const Interval turn{0, kTwoPi}, tube{-kPi, kPi};
  Body body;
  const int vertex = body.add_vertex(frame.origin + (major_radius - minor_radius) * frame.x);
  const int equator = body.add_edge(std::make_shared<Circle>(frame, major_radius - minor_radius), vertex, vertex,
                                    {"", "equator"}, EdgeKind::seam);
  const Frame section{frame.origin + major_radius * frame.x, frame.x, frame.z, -frame.y};
  const int meridian = body.add_edge(std::make_shared<Circle>(section, minor_radius, tube), vertex, vertex,
                                     {"", "meridian"}, EdgeKind::seam);
  const int face =
      body.add_face(std::make_shared<TorusSurface>(frame, major_radius, minor_radius, Rectangle{turn, tube}), true,
                    {"", "side"}, false);
  body.add_loop(face, {{equator, true, image_line(turn, {0, tube.lo}, {kTwoPi, tube.lo})},
                       {meridian, true, image_line(tube, {kTwoPi, tube.lo}, {kTwoPi, tube.hi})},
                       {equator, false, image_line(turn, {0, tube.hi}, {kTwoPi, tube.hi})},
                       {meridian, false, image_line(tube, {0, tube.lo}, {0, tube.hi})}});
  body.close_shell();
  return body;
}

TypeDeclaration torus_body_type() {
  return declare(Category::body, "torus_body", "Solid ring torus. Face: side.")
      .example("major_radius: 2, minor_radius: 0.5")
      .field("frame", frame(), "placement: the center, the axis of revolution z, x at the angle 0", "{}")
      .field("major_radius", length().positive(), "radius of the center circle of the tube")
      .field("minor_radius", length().positive(), "radius of the tube")
      .check("major_radius > minor_radius", "a tube thicker than its ring meets itself: no body")
      .built_by([](const Fields& f) -> BodyPtr {
        return std::make_shared<Body>(torus_body(f.frame(), f.number("major_radius"), f.number("minor_radius")));
      });
}

}  // namespace lekalo::geometry
