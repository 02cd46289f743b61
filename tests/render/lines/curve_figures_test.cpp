// What helpers draw of curves: osculating circles and evolutes are what is known of them, polygons are those of
// insertion and elevation, colours follow the curvature, polar forms have their arguments.
#include "render/lines/curve_figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/lines/strokes.h"
#include "render/model/color_scale.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::curve_figures_test {
namespace {

using geometry::Vec3;

LineWork drawn(const std::string& object) {
  const BuiltText text = build_text(R"(
geometry:
  oval: { type: ellipse, semi_axes: [3, 2] }
  cubic: { type: bezier_curve, points: [[0, 0], [1, 3], [4, 2], [5, -1]] }
  spline: { type: nurbs_curve, points: [[0, 0], [1, 2], [3, 2.4], [4, 0], [6, 0.2], [7, 2], [9, 1]] }
  helix: { type: formula_curve, point: [2*cos(t), 2*sin(t), t/2], domain: [0, 6] }
lights: {}
image: { size: [96, 72] }
objects:
)" + object);
  EXPECT_EQ(text.said, "");
  return drawing_work(World(std::make_shared<const Model>(text.model)));
}

std::vector<geometry::CurvePtr> curves_of(const LineWork& work, const std::string& kind) {
  std::vector<geometry::CurvePtr> curves;
  for (const Stroke& stroke : work.strokes)
    if (stroke.kind == kind) curves.push_back(stroke.curve);
  return curves;
}

// Of the ellipse the centres are (a^2 - b^2)/a cos^3 t, -(a^2 - b^2)/b sin^3 t.
Vec3 center_of_oval(double t) { return {5.0 / 3 * std::pow(std::cos(t), 3), -2.5 * std::pow(std::sin(t), 3), 0}; }

TEST(CurveFigures, OsculatingCirclesTouch) {
  const auto circles =
      curves_of(drawn("  - { shape: oval, show: { osculating_circle: { at: [40 deg], center: false } } }\n"),
                "osculating_circle");
  ASSERT_EQ(circles.size(), 1u);
  const double t = 40 * geometry::kPi / 180;
  const Vec3 point(3 * std::cos(t), 2 * std::sin(t), 0);
  EXPECT_LT(glm::length(circles[0]->point(0) - point), 1e-13);
  for (const double x : {0.3, 2.0, 5.0})
    EXPECT_NEAR(glm::length(circles[0]->point(x) - center_of_oval(t)), glm::length(point - center_of_oval(t)), 1e-13);
}

// Lame's curve (a x)^(2/3) + (b y)^(2/3) = (a^2 - b^2)^(2/3).
TEST(CurveFigures, EvoluteOfAnEllipse) {
  int seen = 0;
  for (const auto& part : curves_of(drawn("  - { shape: oval, show: { evolute: { reach: 9 } } }\n"), "evolute"))
    for (double t = part->domain().lo; t <= part->domain().hi; ++t, ++seen) {
      const Vec3 p = part->point(t);
      EXPECT_NEAR(std::cbrt(9 * p.x * p.x) + std::cbrt(4 * p.y * p.y), std::cbrt(25.0), 1e-9);
    }
  EXPECT_GT(seen, 1000);
}

TEST(CurveFigures, PolygonsOfInsertionAndElevation) {
  const auto inserted =
      curves_of(drawn("  - { shape: cubic, show: { insertion: { at: [0.5], times: 3 } } }\n"), "insertion");
  ASSERT_EQ(inserted.size(), 1u);
  EXPECT_EQ(inserted[0]->domain().hi, 6);  // de Casteljau's points of both halves
  EXPECT_LT(glm::length(inserted[0]->point(3) - Vec3(2.5, 1.75, 0)), 1e-14);
  const auto elevated = curves_of(drawn("  - { shape: cubic, show: elevation }\n"), "elevation");
  ASSERT_EQ(elevated.size(), 1u);
  EXPECT_LT(glm::length(elevated[0]->point(1) - Vec3(0.75, 2.25, 0)), 1e-14);  // (p_0 + 3 p_1)/4
}

// Only the part between the knots i and i + p + 1 moves.
TEST(CurveFigures, MovedPoint) {
  const auto lines =
      curves_of(drawn("  - { shape: spline, show: { moved_point: { index: 3, by: [0, 1] } } }\n"), "moved_point");
  ASSERT_EQ(lines.size(), 3u);  // the part, the sides, the way
  EXPECT_EQ(lines[0]->domain(), geometry::Interval(0, 4));
  const auto first =
      curves_of(drawn("  - { shape: spline, show: { moved_point: { index: 0, by: [0, 1] } } }\n"), "moved_point");
  EXPECT_EQ(first[0]->domain(), geometry::Interval(0, 1));
  EXPECT_EQ(first[0]->point(0), Vec3(0, 1, 0));
}

// The line y = 0.5 meets sides 0 and 2 of the cubic's polygon, sides 0, 2 and 4 of the spline's.
TEST(CurveFigures, CrossingsAreCounted) {
  const LineWork of_cubic = drawn(
      "  - { shape: cubic, show: { crossings: { line: { through: [0, 0.5], along: x }, label: '%i of %j' } } }\n");
  ASSERT_EQ(of_cubic.marks.size(), 2u);
  for (const auto& mark : of_cubic.marks) EXPECT_NEAR(mark.point.y, 0.5, 1e-12);
  ASSERT_EQ(of_cubic.texts.size(), 1u);
  EXPECT_EQ(of_cubic.texts[0].text, "2 of 2");
  const LineWork of_polygon =
      drawn("  - { shape: spline, show: { crossings: { line: { through: [0, 0.5], along: x }, of: polygon } } }\n");
  EXPECT_EQ(of_polygon.marks.size(), 3u);
}

TEST(CurveFigures, FeaturesAreMarked) {
  EXPECT_EQ(drawn("  - { shape: oval, show: features }\n").marks.size(), 4u);
  EXPECT_EQ(drawn("  - { shape: oval, show: { features: { kinds: [inflection] } } }\n").marks.size(), 0u);
  const LineWork cubic = drawn("  - { shape: spline, show: { features: { kinds: [inflection] } } }\n");
  EXPECT_EQ(cubic.marks.size(), 2u);
}

// A helix (2 cos t, 2 sin t, t/2) has the torsion c/(4 + c^2), c = 1/2, along the binormal.
TEST(CurveFigures, TorsionComb) {
  const auto teeth = curves_of(
      drawn("  - { shape: helix, show: { comb: { by: torsion, count: 3, scale: 2, envelope: false } } }\n"), "comb");
  ASSERT_EQ(teeth.size(), 3u);
  for (const auto& tooth : teeth) {
    const Vec3 way = tooth->point(1) - tooth->point(0);
    EXPECT_NEAR(glm::length(way), 2 * 0.5 / 4.25, 1e-13);
    EXPECT_GT(way.z, 0);
  }
}

TEST(CurveFigures, HullsHoldTheCurve) {
  const auto borders = curves_of(drawn("  - { shape: cubic, show: hulls }\n"), "hulls");
  ASSERT_EQ(borders.size(), 1u);
  EXPECT_EQ(borders[0]->domain().hi, 4);
}

TEST(CurveFigures, ColorsFollowTheCurvature) {
  std::vector<Spectrum> colors;
  for (const Stroke& stroke : drawn("  - { shape: oval, show: { colored: { count: 40, colors: grey } } }\n").strokes)
    if (stroke.kind == "colored") colors.push_back(stroke.look.color);
  ASSERT_EQ(colors.size(), 40u);
  EXPECT_GT(colors[0][0], colors[9][0]);  // most curved at t = 0, least at pi/2
  EXPECT_EQ(color_at("viridis", -1), color_at("viridis", 0));
  EXPECT_EQ(color_at("viridis", 2), color_at("viridis", 1));
}

TEST(CurveFigures, BlossomLabels) {
  const LineWork work =
      drawn("  - { shape: cubic, show: { de_casteljau: { t: 0.4, levels: [2, 3], blossom: true } } }\n");
  std::vector<std::string> texts;
  for (const PointText& text : work.texts) texts.push_back(text.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"$(0, 0.4, 0.4)$", "$(0.4, 0.4, 1)$", "$(0.4, 0.4, 0.4)$"}));
}

TEST(CurveFigures, HodographAndTangents) {
  const auto hodograph =
      curves_of(drawn("  - { shape: cubic, show: { hodograph: { scale: 2, at: [1, 0] } } }\n"), "hodograph");
  ASSERT_EQ(hodograph.size(), 1u);
  EXPECT_LT(glm::length(hodograph[0]->point(0) - Vec3(7, 18, 0)), 1e-13);  // 2 * 3 (p_1 - p_0) + at
  const auto tangents =
      curves_of(drawn("  - { shape: cubic, show: { tangents: { at: [0], length: 2 } } }\n"), "tangents");
  ASSERT_EQ(tangents.size(), 1u);
  EXPECT_LT(glm::length(tangents[0]->point(1) - 2.0 * glm::normalize(Vec3(1, 3, 0))), 1e-13);
  EXPECT_EQ(curves_of(drawn("  - { shape: oval, show: { direction: { count: 3 } } }\n"), "direction").size(), 3u);
}

}  // namespace
}  // namespace lekalo::render::curve_figures_test
