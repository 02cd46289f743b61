// Lines, marks, ribbons and arrows in scenes: what is collected from the objects, and what is said about wrong ones.
#include <gtest/gtest.h>

#include <cmath>

#include "render/lines/strokes.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::lines_test {
namespace {

std::string said_about(const std::string& map) {
  const BuiltText text = build_text("geometry:\n  c: { type: circle, radius: 1 }\n  a: " + map + "\n");
  return text.said + text.hints;
}

TEST(LinesOfScenes, WrongRibbonsAndArrowsAreExplained) {
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 0.1 }"), "");
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 0.1, on: { type: plane, size: [3, 3] } }"), "");
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 0 }"), "4:36 expected a value greater than 0, found 0\n\n");
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 1, across: norma }"),
            "4:47 expected a direction, found 'norma'\nx, y, z, -x, -y, -z or components [a, b, c]\n");
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 1, across: x }"),
            "4:47 the curve runs along this direction at t = 1.5708\nchoose one across the curve\n");
  EXPECT_EQ(
      said_about("{ type: ribbon, of: c, width: 1, across: z, twist: 90 }"),
      "4:57 'twist' is of frames that turn no more than they must\nleave it out, or across: rotation_minimizing\n");
  EXPECT_EQ(said_about("{ type: ribbon, of: c, width: 1, on: { type: sphere_surface, radius: 3 } }"),
            "4:43 the curve does not lie on the surface at t = 1.56745\nto lie flat it must lie on it\n");
  EXPECT_EQ(said_about("{ type: ribbon, of: { type: polyline, points: [[0, 0], [1, 0], [1, 1]] }, width: 1 }"),
            "4:26 the curve has a corner at t = 1\nwhat goes along it needs a smooth curve\n");
  EXPECT_EQ(said_about("{ type: arrow_body, to: [0, 0, 1] }"), "");
  EXPECT_EQ(said_about("{ type: arrow_body, along: z, length: 2, radius: 0.1 }"), "");
  EXPECT_EQ(said_about("{ type: arrow_body }"),
            "4:6 an arrow has a point 'to' or a direction 'along'\nfor example from: [0, 0, 0], to: [0, 0, 2]\n");
  EXPECT_EQ(said_about("{ type: arrow_body, along: z }"),
            "4:33 'along' and 'length' belong together\nfor example along: z, length: 2\n");
  EXPECT_EQ(said_about("{ type: arrow_body, to: [0, 0] }"),
            "4:30 the arrow has no length: it ends where it begins\n\n");
  EXPECT_EQ(said_about("{ type: arrow_body, to: [0, 0, 1], radius: 0.2 }"),
            "4:49 the head is longer than the arrow\nmake it shorter with 'head_length'\n");
  EXPECT_EQ(
      said_about("{ type: arrow_body, to: [0, 0, 1], radius: 0.1, head_length: 1 }"),
      "4:67 the head is as long as the arrow: nothing is left of the shaft\nmake it shorter with 'head_length'\n");
  EXPECT_EQ(said_about("{ type: arrow_body, to: [0, 0, 1], radius: 0.2, head_radius: 0.1 }"),
            "4:67 the head must be wider than the shaft\n\n");
}

// Helpers at parameters that the curve or surface has not, and levels beyond its degree.
TEST(LinesOfScenes, HelpersOutsideOfTheDomain) {
  const auto said = [](const std::string& shape, const std::string& show) {
    const BuiltText text = build_text(
        "lights: {}\ngeometry:\n  c: { type: circle, radius: 1 }\n"
        "  r: { type: bezier_curve, points: [[0, 0], [1, 2], [2, 0]] }\n"
        "  s: { type: bezier_surface, points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]] }\n"
        "objects:\n  - shape: " +
        shape + "\n    show: " + show + "\n");
    return text.said + text.hints;
  };
  EXPECT_EQ(said("r", "{ de_casteljau: { t: 1.5 } }"), "9:32 t = 1.5 lies outside of the curve\nt goes from 0 to 1\n");
  EXPECT_EQ(said("r", "{ de_casteljau: { t: 0.5, levels: 1..9 } }"),
            "9:45 there is no level 3: the curve is of degree 2\nlevels go from 1 to 2\n");
  EXPECT_EQ(said("r", "{ de_casteljau: { t: 0.5, levels: 1..2 } }"), "");
  EXPECT_EQ(said("r", "{ frames: { at: [0, 4] } }"), "9:31 t = 4 lies outside of the curve\nt goes from 0 to 1\n");
  EXPECT_EQ(said("c", "{ frames: { at: [0, 400 deg] } }"), "");
  EXPECT_EQ(said("c", "{ frames: { surfaces: [s] } }"), "9:33 'kind: on_surfaces' and 'surfaces' belong together\n\n");
  EXPECT_EQ(said("s", "{ normals: { at_u: [0, 1], at_v: [0.5, -2] } }"),
            "9:50 v = -2 lies outside of the shape\nv goes from 0 to 1\n");
}

LineWork work_of(const std::string& objects) {
  const BuiltText text = build_text(R"(
geometry:
  c: { type: circle, radius: 1 }
  p: [1, 2, 3]
  box: { type: box, size: [1, 2, 3] }
  can: { type: cylinder_body, radius: 1, height: 2 }
  ring: { type: torus_surface, major_radius: 2, minor_radius: 0.7 }
  half: { type: torus_surface, major_radius: 2, minor_radius: 0.7, domain: { u: [0, pi], v: [0, 2*pi] } }
  ball: { type: sphere_surface, radius: 1 }
  s: { type: bezier_surface, points: [[[0, 0, 0], [0, 1, 0], [0, 2, 0]], [[1, 0, 0], [1, 1, 1], [1, 2, 0]]] }
  r: { type: bezier_curve, points: [[0, 0], [1, 1], [2, 0]] }
  loop: { type: nurbs_curve, degree: 2, closed: true, points: [[0, 0], [1, 0], [1, 1], [0, 1]] }
image: { size: [96, 48] }
lights: {}
objects:
)" + objects);
  EXPECT_EQ(text.said, "");
  return line_work(World(std::make_shared<Model>(text.model)));
}

TEST(LinesOfScenes, ObjectsGiveTheLinesThatTheyAskFor) {
  EXPECT_EQ(work_of("  - { shape: box }\n").strokes.size(), 0u);
  EXPECT_EQ(work_of("  - { shape: c }\n").strokes.size(), 1u);
  EXPECT_EQ(work_of("  - { shape: p }\n").marks.size(), 1u);
  EXPECT_EQ(work_of("  - { shape: c, visible_to: [shadow] }\n").strokes.size(), 0u);
  EXPECT_EQ(work_of("  - { shape: box, lines: { sharp: thick, smooth: thin } }\n").strokes.size(), 12u);
  EXPECT_EQ(work_of("  - { shape: can, lines: { sharp: thick, smooth: thin } }\n").strokes.size(), 2u);
  EXPECT_EQ(work_of("  - { shape: ring, lines: { boundary: thick } }\n").strokes.size(), 0u);
  EXPECT_EQ(work_of("  - { shape: half, lines: { boundary: thick } }\n").strokes.size(), 2u);
  EXPECT_EQ(work_of("  - { shape: ball, lines: { boundary: thick } }\n").strokes.size(), 0u);
  EXPECT_EQ(work_of("  - { shape: s, lines: { boundary: thick } }\n").strokes.size(), 4u);
  EXPECT_EQ(work_of("  - { shape: ring, lines: { parameter: { at_u: 6, at_v: [0, 1] } } }\n").strokes.size(), 8u);
  EXPECT_EQ(work_of("  - { shape: ring, lines: { parameter: { at_v: [0, 450 deg] } } }\n").strokes.size(), 2u);
  // The poles are no lines.
  EXPECT_EQ(work_of("  - { shape: ball, lines: { parameter: { at_v: 5 } } }\n").strokes.size(), 3u);
  const LineWork group = work_of(
      "  - { shape: { type: group, of: [{ shape: c }, { shape: p }] }, transform: { translate: [0, 0, 5] } }\n");
  ASSERT_EQ(group.strokes.size(), 1u);
  EXPECT_EQ(group.strokes[0].to_world.offset.z, 5);
  ASSERT_EQ(group.marks.size(), 1u);
  EXPECT_EQ(group.marks[0].point, Vec3(1, 2, 8));
}

TEST(LinesOfScenes, ObjectsHaveTheNamesOfTheirShapes) {
  const BuiltText text = build_text(R"(geometry:
  box: { type: box, size: [1, 1, 1] }
  cans: { repeat: { i: 0..1 }, type: cylinder_body, center: [3 * i + 3, 0, 0], radius: 1, height: 2 }
objects:
  - { shape: [box, cans, { type: ball, radius: 1 }] }
  - { shape: [box, cans.1], name: both }
)");
  EXPECT_EQ(text.said, "");
  std::vector<std::string> names;
  for (const Object& object : text.model.objects) names.push_back(object.name);
  EXPECT_EQ(names, (std::vector<std::string>{"box", "cans", "cans", "", "both", "both"}));
}

TEST(LinesOfScenes, ControlPolygonsAndNets) {
  const LineWork curve = work_of("  - { shape: r, show: control_polygon }\n");
  EXPECT_EQ(curve.strokes.size(), 2u);
  EXPECT_EQ(curve.marks.size(), 3u);
  const LineWork loop = work_of("  - { shape: loop, show: { control_polygon: { marker: none } } }\n");
  ASSERT_EQ(loop.strokes.size(), 2u);
  EXPECT_TRUE(loop.strokes[1].curve->is_closed());
  EXPECT_EQ(loop.strokes[1].curve->domain().width(), 4);
  EXPECT_EQ(loop.marks.size(), 0u);
  const LineWork net = work_of("  - { shape: s, show: control_net }\n");
  EXPECT_EQ(net.strokes.size(), 5u);
  EXPECT_EQ(net.marks.size(), 6u);
}

// The last point of both constructions is the curve's own.
TEST(LinesOfScenes, TrianglesEndOnTheCurve) {
  for (const std::string show : {"r, show: { de_casteljau: { t: 0.3 } }", "loop, show: { de_boor: { t: 0.3 } }"}) {
    const LineWork work = work_of("  - { shape: " + show + " }\n");
    EXPECT_EQ(work.strokes.size(), 2u);  // the curve, and a side
    ASSERT_EQ(work.marks.size(), 3u);
    EXPECT_LE(glm::length(work.marks[2].point - work.strokes[0].curve->point(0.3)), 1e-15) << show;
  }
  EXPECT_EQ(work_of("  - { shape: r, show: { de_casteljau: { t: 0.3, levels: [2] } } }\n").marks.size(), 1u);
}

// What a drawing shows of one object of these shapes.
LineWork drawn_of(const std::string& objects) {
  const BuiltText text = build_text(R"(
geometry:
  spline:
    type: nurbs_curve
    degree: 3
    knots: [0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6]
    points: [[0, 0], [1, 2], [2, -1], [3, 3], [4, 0], [5, 2], [6, -2], [7, 1], [8, 0]]
  cubic: { type: bezier_curve, points: [[0, 0, 0], [1, 0, 0], [2, 3, 1], [0, 1, 2]], weights: [1, 2, 3, 0.5] }
  ball: { type: sphere_surface, center: [1, 2, 3], radius: 2 }
  rim: { type: circle, radius: 2 }
lights: {}
image: { size: [96, 72] }
objects:
)" + objects);
  EXPECT_EQ(text.said, "");
  return drawing_work(World(std::make_shared<const Model>(text.model)));
}

// De Boor's triangle of Golovanov 2016, 2.10 and 2.11: in the span t_5 <= t < t_6 level k has the indices 2 + k to 5.
TEST(LinesOfScenes, DeBoorsTriangleHasItsIndices) {
  const LineWork work = drawn_of("  - { shape: spline, show: { de_boor: { t: 2.5, label: '%i|%k' } } }\n");
  const std::vector<std::pair<std::string, Vec3>> expected{
      {"3|1", {17.0 / 6, 7.0 / 3, 0}},   {"4|1", {3.5, 1.5, 0}},
      {"5|1", {25.0 / 6, 1.0 / 3, 0}},   {"4|2", {10.0 / 3, 41.0 / 24, 0}},
      {"5|2", {11.0 / 3, 29.0 / 24, 0}}, {"5|3", {3.5, 35.0 / 24, 0}}};
  ASSERT_EQ(work.texts.size(), expected.size());
  for (size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(work.texts[k].text, expected[k].first);
    EXPECT_LT(glm::length(work.texts[k].point - expected[k].second), 1e-14) << expected[k].first;
  }
  // De Casteljau's count from 0 on every level.
  const LineWork bezier = drawn_of("  - { shape: cubic, show: { de_casteljau: { t: 0.5, label: '%i|%k' } } }\n");
  std::vector<std::string> labels;
  for (const PointText& text : bezier.texts) labels.push_back(text.text);
  EXPECT_EQ(labels, (std::vector<std::string>{"0|1", "1|1", "2|1", "0|2", "1|2", "0|3"}));
}

std::vector<Vec3> ends_of(const LineWork& work, const std::string& kind) {
  std::vector<Vec3> ends;
  for (const Stroke& stroke : work.strokes)
    if (stroke.kind == kind) ends.push_back(stroke.to_world.point(stroke.curve->point(stroke.curve->domain().hi)));
  return ends;
}

// Grezdov, Filippenko 2010, 10: t along u, n, t x n, where u = v = 0 on a sphere.
TEST(LinesOfScenes, FramesOfSurfaces) {
  const LineWork work =
      drawn_of("  - { shape: ball, show: { normals: { at_u: [0], at_v: [0], length: 0.5, frames: true } } }\n");
  const std::vector<Vec3> ends = ends_of(work, "normals"), expected{{3.5, 2, 3}, {3, 2.5, 3}, {3, 2, 2.5}};
  ASSERT_EQ(ends.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(ends[k] - expected[k]), 1e-14) << k;
  // At a pole r_u vanishes: the normal alone.
  EXPECT_EQ(ends_of(drawn_of("  - { shape: ball, show: { normals: { at_u: [0], at_v: [90 deg], frames: true } } }\n"),
                    "normals")
                .size(),
            1u);
}

// Frenet's frame on a circle: along it, to its middle, across its plane.
TEST(LinesOfScenes, FramesOfCurves) {
  const LineWork work = drawn_of("  - { shape: rim, show: { frames: { at: [90 deg], length: 0.5 } } }\n");
  const std::vector<Vec3> ends = ends_of(work, "frames"), expected{{-0.5, 2, 0}, {0, 1.5, 0}, {0, 2, 0.5}};
  ASSERT_EQ(ends.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(ends[k] - expected[k]), 1e-14) << k;
}

// The same on a sphere, whose normal is outward, and between that and a plane's.
TEST(LinesOfScenes, FramesOfCurvesOnSurfaces) {
  const std::string ball = "{ type: sphere_surface, radius: 2 }", lid = "{ type: plane, size: [6, 6] }";
  const auto ends_on = [](const std::string& surfaces) {
    return ends_of(drawn_of("  - { shape: rim, show: { frames: { kind: on_surfaces, surfaces: [" + surfaces +
                            "], at: [90 deg], length: 0.5 } } }\n"),
                   "frames");
  };
  const std::vector<Vec3> one = ends_on(ball), both = ends_on(ball + ", " + lid);
  const double half = std::sqrt(0.125);
  const std::vector<Vec3> of_one{{-0.5, 2, 0}, {0, 2.5, 0}, {0, 2, -0.5}};
  const std::vector<Vec3> of_both{{-0.5, 2, 0}, {0, 2 + half, half}, {0, 2 + half, -half}};
  ASSERT_EQ(one.size(), 3u);
  ASSERT_EQ(both.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(glm::length(one[k] - of_one[k]), 1e-13) << k;
    EXPECT_LT(glm::length(both[k] - of_both[k]), 1e-13) << k;
  }
}

// The vectors of curvature at the ends of a rational cubic (Korotkij, Studenova 2024): of the length
// 2/3 w0 w2/w1^2 |R0Q x QP| / |R0Q|^3, across the tangent towards P.
TEST(LinesOfScenes, CurvatureVectorsAtTheEnds) {
  const LineWork work = drawn_of(
      "  - { shape: cubic, show: { comb: { count: 2, scale: -1, envelope: false, style: { arrows: end } } } }\n");
  const std::vector<Vec3> ends = ends_of(work, "comb");
  ASSERT_EQ(ends.size(), 2u);
  const auto vector = [](const Vec3& end, const Vec3& next, const Vec3& far, double weights) {
    const Vec3 a = next - end, b = far - next, across = glm::cross(glm::cross(a, b), a);
    return 2.0 / 3 * weights * glm::length(glm::cross(a, b)) / std::pow(glm::length(a), 3) * glm::normalize(across);
  };
  const Vec3 r0{0, 0, 0}, q{1, 0, 0}, p{2, 3, 1}, r1{0, 1, 2};
  EXPECT_LT(glm::length(ends[0] - (r0 + vector(r0, q, p, 1.0 * 3 / (2 * 2)))), 1e-14);
  EXPECT_LT(glm::length(ends[1] - (r1 + vector(r1, p, q, 2.0 * 0.5 / (3 * 3)))), 1e-14);
}

TEST(LinesOfScenes, LooksAreInPixels) {
  const LineWork work = work_of(R"(  - { shape: c, lines: { curve: { width: 3 px, color: cycle }, hidden: faded } }
  - { shape: c, lines: { curve: { width: 0.5 px, color: cycle } } }
  - { shape: c, lines: { curve: { width: 1 mm, opacity: 0.5, dash: [2 px, 1 px], cap: round }, hidden: thin } }
)");
  ASSERT_EQ(work.strokes.size(), 3u);
  EXPECT_NEAR(work.strokes[0].look.half_width, 1.5, 1e-12);
  EXPECT_NEAR(work.strokes[0].hidden->opacity, 1.0 / 3, 1e-12);
  EXPECT_EQ(work.strokes[1].look.half_width, 0.5);
  EXPECT_NEAR(work.strokes[1].look.opacity, 0.5, 1e-12);
  EXPECT_FALSE(work.strokes[1].hidden);
  EXPECT_FALSE(work.strokes[0].look.color == work.strokes[1].look.color);
  EXPECT_NEAR(work.strokes[2].look.half_width, 0.5 * 96 / 25.4, 1e-12);
  EXPECT_NEAR(work.strokes[2].hidden->half_width, 0.25 * 96 / 25.4, 1e-12);
  EXPECT_EQ(work.strokes[2].hidden->opacity, 0.5);
  ASSERT_EQ(work.strokes[2].look.dash.size(), 2u);
  EXPECT_NEAR(work.strokes[2].look.dash[0], 2, 1e-12);
}

}  // namespace
}  // namespace lekalo::render::lines_test
