// Places and directions on curves and surfaces: every expected point follows from elementary geometry.
#include <gtest/gtest.h>

#include <cmath>

#include "render/scene/scene_text.h"

namespace lekalo::render::places_test {
namespace {

using geometry::kPi;

const std::string kThings =
    "geometry:\n"
    "  l: { type: segment, from: [1, 0], to: [5, 0] }\n"
    "  c: { type: circle, radius: 2 }\n"
    "  b: { type: bezier_curve, points: [[0, 0], [1, 3], [4, 2], [5, -1]], weights: [1, 2, 3, 1] }\n"
    "  moved: { like: b, transform: [{ translate: [0, 0, 7] }, { scale: 2 }] }\n"
    "  line: { type: polyline, points: [[0, 0], [3, 0], [3, 1]] }\n"
    "  s: { type: sphere_surface, radius: 2 }\n"
    "  patch: { type: nurbs_surface, degree: { u: 2, v: 1 }, points: [[[0, 0], [0, 1]], [[1, 0, 5], [1, 1]], [[2, 0], "
    "[2, 1]], [[3, 0], [3, 1, 4]]] }\n"
    "  body: { type: ball, radius: 1 }\n";

Vec3 point(const std::string& place) {
  const BuiltText scene =
      build_text(kThings + "  found: { type: segment, from: " + place + ", to: [99, 99, 99] }\nlights: {}\n");
  EXPECT_EQ(scene.said, "") << place;
  return std::get<geometry::CurvePtr>(scene.model.geometry.at("found"))->point(0);
}
Vec3 direction(const std::string& place) {
  const BuiltText scene =
      build_text(kThings + "  found: { type: plane, origin: [0, 0], normal: " + place + " }\nlights: {}\n");
  EXPECT_EQ(scene.said, "") << place;
  return std::get<geometry::SurfacePtr>(scene.model.geometry.at("found"))->normal(0, 0);
}

void expect_near(const Vec3& found, const Vec3& expected, double tolerance = 1e-14) {
  EXPECT_LE(glm::length(found - expected), tolerance) << found.x << " " << found.y << " " << found.z << " is not "
                                                      << expected.x << " " << expected.y << " " << expected.z;
}

TEST(Places, ByParameter) {
  expect_near(point("{ of: l, t: 0.25 }"), {2, 0, 0});
  expect_near(point("{ of: c, t: 90 deg }"), {0, 2, 0});
  expect_near(point("{ of: s, u: 0, v: 90 deg }"), {0, 0, 2});
  expect_near(point("{ of: body.side, u: 0, v: 0 }"), {1, 0, 0});
}

TEST(Places, ByFractionOfLength) {
  expect_near(point("{ of: l, s: 0.75 }"), {4, 0, 0});
  expect_near(point("{ of: c, s: 1/8 }"), {std::sqrt(2.0), std::sqrt(2.0), 0});
  // The sides are 3 and 1 long.
  expect_near(point("{ of: line, s: 0.5 }"), {2, 0, 0});
  expect_near(point("{ of: line, s: 7/8 }"), {3, 0.5, 0});
  expect_near(point("{ of: line, s: 1 }"), {3, 1, 0});
}

TEST(Places, ControlPoints) {
  expect_near(point("{ of: b, point: 2 }"), {4, 2, 0});
  expect_near(point("{ of: moved, point: 1 }"), {2, 6, 14});
  expect_near(point("{ of: line, point: 2 }"), {3, 1, 0});
  expect_near(point("{ of: patch, point: [1, 0] }"), {1, 0, 5});
  expect_near(point("{ of: patch, point: [3, 1] }"), {3, 1, 4});
}

TEST(Places, Directions) {
  expect_near(direction("{ of: c, t: 0, vector: tangent }"), {0, 1, 0});
  expect_near(direction("{ of: c, t: 0, vector: normal }"), {-1, 0, 0});
  expect_near(direction("{ of: c, s: 0.25, vector: binormal }"), {0, 0, 1});
  expect_near(direction("{ of: s, u: 0, v: 0, vector: du }"), {0, 1, 0});
  expect_near(direction("{ of: s, u: 0, v: 0, vector: dv }"), {0, 0, 1});
  expect_near(direction("{ of: s, u: 0, v: 0, vector: normal }"), {1, 0, 0});
}

// The place begins in column 43 of line 11.
std::string said(const std::string& place) {
  return build_text(kThings + "  x: { type: segment, to: [99, 99], from: " + place + " }\nlights: {}\n").said;
}
std::string said_of_direction(const std::string& place) {
  return build_text(kThings + "  x: { type: circle, radius: 1, normal: " + place + " }\nlights: {}\n").said;
}

TEST(Places, Errors) {
  EXPECT_EQ(said("{ of: c }"), "11:43 missing 't' of a place on a curve\n");
  EXPECT_EQ(said("{ of: s, u: 0 }"), "11:43 missing 'v' of a place on a surface\n");
  EXPECT_EQ(said("{ of: c, u: 0, v: 0 }"), "11:55 'u' is no parameter of a curve\n");
  EXPECT_EQ(said("{ of: s, t: 0 }"), "11:55 't' is no parameter of a surface\n");
  EXPECT_EQ(said("{ of: c, t: 0, s: 0 }"), "11:61 't' and 's' both say where: leave one out\n");
  EXPECT_EQ(said("{ of: c, s: 1.5 }"), "11:55 expected a value between 0 and 1, found 1.5\n");
  EXPECT_EQ(said("{ of: c, t: 0/0 }"), "11:55 the formula has no finite value (not a number)\n");
  EXPECT_EQ(said("{ of: c, tt: 0 }"), "11:52 unknown field 'tt' of a place (did you mean 't'?)\n");
  EXPECT_EQ(said("{ of: body, u: 0, v: 0 }"), "11:49 'body' is a body, but a curve or a surface is wanted here\n");
  EXPECT_EQ(said("{ of: b, point: 4 }"), "11:59 there is no control point 4: the index goes from 0 to 3\n");
  EXPECT_EQ(said("{ of: b, point: [1, 2] }"), "11:59 a control point of a curve has one index\n");
  EXPECT_EQ(said("{ of: patch, point: 2 }"), "11:63 a control point of a surface has two indices\n");
  EXPECT_EQ(said("{ of: patch, point: [1, 2] }"), "11:67 there is no control point 2: j goes from 0 to 1\n");
  EXPECT_EQ(said("{ of: patch, point: [0.5, 0] }"), "11:64 expected a whole number, found 0.5\n");
  EXPECT_EQ(said("{ of: s, point: [0, 0] }"), "11:49 this has no control points\n");
  EXPECT_EQ(said("{ of: b, point: 1, t: 0 }"), "11:62 't' does not go with 'point'\n");
  EXPECT_EQ(said("{ page: [5 mm, 8 mm] }"), "11:43 a place on the page is no point of space\n");
  EXPECT_EQ(said("{ of: c, t: 0, vector: tangent }"), "11:66 a place has no 'vector'\n");
}

// What goes round comes back, what has no end has places everywhere; other parameters have a range.
TEST(Places, OutsideOfTheDomain) {
  expect_near(point("{ of: c, t: 450 deg }"), {0, 2, 0});
  expect_near(point("{ of: s, u: 360 deg, v: 90 deg }"), {0, 0, 2});
  expect_near(point("{ of: b, t: 1 + 1e-12 }"), {5, -1, 0}, 1e-10);
  expect_near(point("{ of: { type: plane, origin: [0, 0] }, u: 70, v: -80 }"), {70, -80, 0});
  EXPECT_EQ(said("{ of: b, t: 1.5 }"), "11:55 t = 1.5 lies outside of the curve\n");
  EXPECT_EQ(said("{ of: l, t: -0.1 }"), "11:55 t = -0.1 lies outside of the curve\n");
  EXPECT_EQ(said("{ of: s, u: 0, v: 91 deg }"), "11:61 v = 91 deg lies outside of the surface\n");
  EXPECT_EQ(said("{ of: patch, u: 0.5, v: 2 }"), "11:67 v = 2 lies outside of the surface\n");
  EXPECT_EQ(said_of_direction("{ of: b, t: 2, vector: tangent }"), "11:53 t = 2 lies outside of the curve\n");
}

TEST(Places, ErrorsOfDirections) {
  EXPECT_EQ(said_of_direction("{ of: c, t: 0, vector: tangnet }"),
            "11:64 'tangnet' is no vector of a curve (did you mean 'tangent'?)\n");
  EXPECT_EQ(said_of_direction("{ of: s, u: 0, v: 0, vector: binormal }"),
            "11:70 'binormal' is no vector of a surface (did you mean 'normal'?)\n");
  EXPECT_EQ(said_of_direction("{ of: l, t: 0, vector: normal }"),
            "11:64 the curve is straight here: it has no normal\n");
  EXPECT_EQ(said_of_direction("{ of: c, t: 0 }"), "11:41 expected a direction\n");
  EXPECT_EQ(said_of_direction("{ of: c, vector: tangent }"), "11:41 missing 't' of a direction on a curve\n");
  EXPECT_EQ(said_of_direction("{ of: s, u: 0, v: 90 deg, vector: du }"), "");
}

// An entry of `geometry` that is a place is a point, with the vectors that its curve or surface has there.
TEST(Places, WithNames) {
  const std::string names =
      "  P: { of: c, t: 90 deg }\n  Q: { of: s, u: 0, v: 0 }\n  E: { of: b, point: 2 }\n"
      "  R: { repeat: { i: 0..2 }, of: l, s: i/2 }\n";
  const auto with = [&](const std::string& more) { return build_text(kThings + names + more + "lights: {}\n"); };
  const BuiltText scene = with(
      "  a: { type: segment, from: P, to: R.1 }\n  e: { type: segment, from: E, to: Q }\n"
      "  n: { type: plane, origin: P, normal: { of: P, vector: tangent } }\n"
      "  m: { type: plane, origin: Q, normal: { of: Q, vector: normal } }\n");
  EXPECT_EQ(scene.said, "");
  const auto curve = [&](const char* name) { return std::get<geometry::CurvePtr>(scene.model.geometry.at(name)); };
  const auto normal = [&](const char* name) {
    return std::get<geometry::SurfacePtr>(scene.model.geometry.at(name))->normal(0, 0);
  };
  expect_near(std::get<Vec3>(scene.model.geometry.at("P")), {0, 2, 0});
  expect_near(std::get<Vec3>(scene.model.geometry.at("R.2")), {5, 0, 0});
  expect_near(curve("a")->point(0), {0, 2, 0});
  expect_near(curve("a")->point(1), {3, 0, 0});
  expect_near(curve("e")->point(0), {4, 2, 0});
  expect_near(curve("e")->point(1), {2, 0, 0});
  expect_near(normal("n"), {-1, 0, 0});
  expect_near(normal("m"), {1, 0, 0});
  // The curve that it is on is shown like everything that nothing is made of.
  const BuiltText shown = build_text("geometry: { c: { type: circle, radius: 1 }, P: { of: c, t: 1 } }\nlights: {}\n");
  EXPECT_EQ(shown.said, "");
  EXPECT_EQ(shown.model.objects.size(), 2u);
  // What is said twice, what is of itself, and what is no place.
  EXPECT_EQ(with("  x: { type: segment, from: { of: P, t: 1 }, to: Q }\n").said,
            "15:38 'P' is a place: it says 't' itself\n");
  EXPECT_NE(build_text("geometry: { P: { of: P, t: 1 } }\nlights: {}\n").said, "");
  EXPECT_NE(with("  x: { of: c }\n").said.find("missing 'type'"), std::string::npos);
  EXPECT_EQ(with("  x: { of: c, t: 99 }\n").said.find("missing 'type'"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::render::places_test
