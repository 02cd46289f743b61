// Straight arrows: a cylinder, a ring and a cone. Edges: three circles and the seams of shaft and head; the apex is a
// pole edge. Loops: shaft  +start +seam -neck -seam,  head  +rim +seam -apex -seam,  start disc  -start,  back of the
// head  -rim, and around its hole  +neck.
#include <cmath>
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

Body arrow_body(const Frame& frame, double length, double radius, double head_length, double head_radius) {
  if (!(radius > 0 && head_radius > radius)) throw std::invalid_argument("the head must be wider than the shaft");
  if (!(head_length > 0 && length > head_length))
    throw std::invalid_argument("the head must be shorter than the arrow");
  const Interval turn{0, kTwoPi}, height{0, 1};
  Body body;
  Frame neck_frame = frame;
  neck_frame.origin += (length - head_length) * frame.z;
  const Vec3 tip = frame.origin + length * frame.z;
  const auto circle = [&](const Frame& at, double r, const char* name) {
    const int vertex = body.add_vertex(at.origin + r * at.x, {"", name});
    return body.add_edge(std::make_shared<Circle>(at, r), vertex, vertex, {"", name});
  };
  const int start = circle(frame, radius, "start"), neck = circle(neck_frame, radius, "neck"),
            rim = circle(neck_frame, head_radius, "rim");
  const int apex_vertex = body.add_vertex(tip, {"", "apex"});
  const int apex = body.add_edge(point_curve(turn, tip), apex_vertex, apex_vertex, {"", "apex"}, EdgeKind::pole);

  // A wall between two circles, or a circle and the apex, as the side of a frustum is.
  const auto wall = [&](SurfacePtr surface, int low, int high, const char* name) {
    const int a = body.edges[low].start, b = body.edges[high].start;
    const int seam = body.add_edge(std::make_shared<Segment>(body.vertices[a].point, body.vertices[b].point), a, b,
                                   {"", std::string(name) + "_seam"}, EdgeKind::seam);
    const int face = body.add_face(std::move(surface), true, {"", name}, false);
    body.add_loop(face, {{low, true, image_line(turn, {0, 0}, {kTwoPi, 0})},
                         {seam, true, image_line(height, {kTwoPi, 0}, {kTwoPi, 1})},
                         {high, false, image_line(turn, {0, 1}, {kTwoPi, 1})},
                         {seam, false, image_line(height, {0, 0}, {0, 1})}});
  };
  // A plane that looks back; it reaches beyond its border, so that lines near the edge still meet it.
  const auto end = [&](const Frame& at, double reach, const char* name) {
    const Interval range{-1.05 * reach, 1.05 * reach};
    return body.add_face(std::make_shared<Plane>(at, Rectangle{range, range}), false, {"", name});
  };
  wall(std::make_shared<CylinderSurface>(frame, radius, length - head_length), start, neck, "shaft");
  wall(std::make_shared<ConeSurface>(neck_frame, head_radius, 0.0, head_length), rim, apex, "head");
  const auto image = [](double r) { return std::make_shared<Circle>(Frame{}, r); };
  const int disc = end(frame, radius, "start");
  body.add_loop(disc, {{start, false, image(radius)}});
  const int back = end(neck_frame, head_radius, "back");
  body.add_loop(back, {{rim, false, image(head_radius)}});
  body.add_loop(back, {{neck, true, image(radius)}});
  body.close_shell();
  return body;
}

TypeDeclaration arrow_body_type() {
  return declare(Category::body, "arrow_body",
                 "Straight arrow in space: a shaft and a cone. Faces: start, shaft, back (of the head), head.")
      .example("from: [0, 0, 0], to: [0, 0, 2]")
      .field("from", point(), "where it begins", "[0, 0, 0]")
      .optional("to", point(), "where its tip is")
      .optional("along", direction(), "the way it goes, instead of `to`")
      .optional("length", length().positive(), "from its beginning to its tip, with `along`")
      .optional("radius", length().positive(), "of the shaft; a fiftieth of the length when left out")
      .optional("head_radius", length().positive(), "of the head; 2.5 radii of the shaft when left out")
      .optional("head_length", length().positive(), "of the head; 3 of its radii when left out")
      .built_by([](const Fields& f) -> BodyPtr {
        const Vec3& from = f.vec3("from");
        if (f.has("to") == f.has("along"))
          throw FieldError(f.has("to") ? "along" : "from", "an arrow has a point 'to' or a direction 'along'",
                           "for example from: [0, 0, 0], to: [0, 0, 2]");
        if (f.has("along") != f.has("length"))
          throw FieldError(f.has("along") ? "along" : "length", "'along' and 'length' belong together",
                           "for example along: z, length: 2");
        const Vec3 way = f.has("to") ? f.vec3("to") - from : f.vec3("along");
        const double length = f.has("to") ? glm::length(way) : f.number("length");
        if (!(length > 0)) throw FieldError("to", "the arrow has no length: it ends where it begins");
        const auto given = [&](const char* field, double otherwise) {
          return f.has(field) ? f.number(field) : otherwise;
        };
        const double radius = given("radius", length / 50);
        const double head_radius = given("head_radius", 2.5 * radius);
        const double head_length = given("head_length", 3 * head_radius);
        if (!(head_radius > radius)) throw FieldError("head_radius", "the head must be wider than the shaft");
        if (!(head_length < length))
          throw FieldError(f.has("head_length")   ? "head_length"
                           : f.has("head_radius") ? "head_radius"
                                                  : "radius",
                           head_length > length ? "the head is longer than the arrow"
                                                : "the head is as long as the arrow: nothing is left of the shaft",
                           "make it shorter with 'head_length'");
        return std::make_shared<Body>(
            arrow_body(frame_about(from, glm::normalize(way)), length, radius, head_length, head_radius));
      });
}

}  // namespace lekalo::geometry
