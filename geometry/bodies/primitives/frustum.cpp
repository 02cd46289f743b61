// Cylinder, cone and frustum bodies (Golovanov 2016, 5.6).
//
// Side r_1 = p + rho(v) (cos u x + sin u y) + h v z, u in [0, 2 pi], v in [0, 1]; ends are discs in planes trimmed by
// circles. Edges: the two circles and the seam u = 0 = 2 pi. An end of radius 0 is a pole edge and has no face.
// Loops: side  +start +seam -end -seam,  start disc  -start,  end disc  +end.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

Body frustum(const Frame& frame, double radius, double top_radius, double height) {
  if (!(height > 0)) throw std::invalid_argument("the height must be positive");
  if (!(radius >= 0 && top_radius >= 0 && radius + top_radius > 0))
    throw std::invalid_argument("the radii must not be negative, nor both zero");
  const Interval turn{0, kTwoPi};
  Body body;

  struct End {
    double radius;
    Frame frame;
    int vertex, edge;
    double v;
  };
  std::array<End, 2> ends{{{radius, frame, -1, -1, 0}, {top_radius, frame, -1, -1, 1}}};
  ends[1].frame.origin += height * frame.z;
  for (int k = 0; k < 2; ++k) {
    End& end = ends[k];
    const Origin origin{"", k == 0 ? "start" : "end"};
    end.vertex = body.add_vertex(end.frame.origin + end.radius * frame.x, origin);
    end.edge = end.radius > 0
                   ? body.add_edge(std::make_shared<Circle>(end.frame, end.radius), end.vertex, end.vertex, origin)
                   : body.add_edge(point_curve(turn, end.frame.origin), end.vertex, end.vertex, origin, EdgeKind::pole);
  }
  const int seam =
      body.add_edge(std::make_shared<Segment>(body.vertices[ends[0].vertex].point, body.vertices[ends[1].vertex].point),
                    ends[0].vertex, ends[1].vertex, {"", "seam"}, EdgeKind::seam);

  SurfacePtr side_surface;
  if (radius == top_radius)
    side_surface = std::make_shared<CylinderSurface>(frame, radius, height);
  else
    side_surface = std::make_shared<ConeSurface>(frame, radius, top_radius, height);
  const int side = body.add_face(std::move(side_surface), true, {"", "side"}, false);
  body.add_loop(side, {{ends[0].edge, true, image_line(turn, {0, 0}, {kTwoPi, 0})},
                       {seam, true, image_line({0, 1}, {kTwoPi, 0}, {kTwoPi, 1})},
                       {ends[1].edge, false, image_line(turn, {0, 1}, {kTwoPi, 1})},
                       {seam, false, image_line({0, 1}, {0, 0}, {0, 1})}});
  for (int k = 0; k < 2; ++k) {
    const End& end = ends[k];
    if (!(end.radius > 0)) continue;
    // The plane reaches beyond the circle, so that lines near the edge still meet it.
    const Interval reach{-1.05 * end.radius, 1.05 * end.radius};
    const int face = body.add_face(std::make_shared<Plane>(end.frame, Rectangle{reach, reach}), k == 1,
                                   {"", k == 0 ? "start" : "end"});
    body.add_loop(face, {{end.edge, k == 1, std::make_shared<Circle>(Frame{}, end.radius)}});
  }
  body.close_shell();
  return body;
}

TypeDeclaration cylinder_body_type() {
  TypeDeclaration type =
      declare(Category::body, "cylinder_body", "Circular cylinder. Faces: start (the base), end, side.")
          .example("radius: 1, height: 2");
  declare_axis(type);
  type.field("radius", length().positive(), "radius").built_by([](const Fields& f) -> BodyPtr {
    const AxialPlacement place = axial_placement(f);
    return std::make_shared<Body>(frustum(place.frame, f.number("radius"), f.number("radius"), place.height));
  });
  return type;
}

TypeDeclaration cone_body_type() {
  TypeDeclaration type = declare(Category::body, "cone_body",
                                 "Circular cone or frustum. Faces: start (the base), end (the top of a frustum), side.")
                             .example("radius: 1, height: 2");
  declare_axis(type);
  type.field("radius", length().non_negative(), "radius of the base circle")
      .optional("top_radius", length().non_negative(), "radius of the top circle; 0, the apex, when left out")
      .optional("half_angle", angle().between(-89.9999 * kPi / 180, 89.9999 * kPi / 180),
                "angle between generatrix and axis, positive where the cone widens upward; in place of top_radius")
      .built_by([](const Fields& f) -> BodyPtr {
        const AxialPlacement place = axial_placement(f);
        const double radius = f.number("radius");
        if (f.has("top_radius") && f.has("half_angle"))
          throw FieldError("half_angle", "a cone has a top_radius or a half_angle, not both");
        double top = f.has("top_radius") ? f.number("top_radius") : 0.0;
        if (f.has("half_angle")) {
          const double slope = std::tan(f.number("half_angle"));
          top = radius + place.height * slope;
          // An apex that was meant exactly comes out within rounding of zero.
          if (std::abs(top) <= 1e-14 * radius) top = 0;
          if (top < 0)
            throw FieldError("half_angle", "the cone comes to its apex before the height is reached",
                             fmt::format("the apex is at the height {:.6g}", -radius / slope));
        }
        if (radius == 0 && top == 0) throw FieldError("radius", "the cone has no width: both radii are zero");
        return std::make_shared<Body>(frustum(place.frame, radius, top, place.height));
      });
  return type;
}

}  // namespace lekalo::geometry
