// What helpers draw of surfaces and triangulations, against closed forms: lines of curvature of a torus are its
// circles, its parabolic circles those of K = 0, circles of curvature have the radii 1/k.
#include "render/lines/surface_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "render/lines/strokes.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::surface_figures_test {
namespace {

using geometry::CurvePtr;
using geometry::Vec3;

LineWork drawn(const std::string& object) {
  const BuiltText text = build_text(R"(
geometry:
  torus: { type: torus_surface, major_radius: 3, minor_radius: 1 }
  egg: { type: ellipsoid, semi_axes: [3, 2, 1.2] }
  saddle: { type: formula_surface, point: [u, v, v^2 - u^2/2], domain: { u: [-1, 1], v: [-1, 1] } }
  bowl: { type: formula_surface, point: [u, v, u^2 + v^2/4], domain: { u: [-1, 1], v: [-1, 1] } }
  trough: { type: formula_surface, point: [u, v, u^2/2], domain: { u: [-1, 1], v: [-1, 1] } }
  net: { type: triangulation, points: [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1.5]] }
lights: {}
image: { size: [96, 72] }
objects:
)" + object);
  EXPECT_EQ(text.said, "");
  return drawing_work(World(std::make_shared<const Model>(text.model)));
}

std::vector<CurvePtr> curves_of(const LineWork& work, const std::string& kind) {
  std::vector<CurvePtr> curves;
  for (const Stroke& stroke : work.strokes)
    if (stroke.kind == kind) curves.push_back(stroke.curve);
  return curves;
}
std::vector<CurvePtr> curves_of(const std::string& shape, const std::string& helper, const std::string& fields) {
  return curves_of(drawn("  - { shape: " + shape + ", show: { " + helper + ": { " + fields + " } } }\n"), helper);
}

template <class Visit>
void each_place(const CurvePtr& curve, const Visit& visit) {
  const geometry::Interval domain = curve->domain();
  for (int k = 0; k <= 20; ++k) visit(curve->point(domain.clamp(domain.lo + domain.width() * k / 20)));
}

// The mesh and net of a T-spline, and of one that is moved.
TEST(SurfaceFigures, MovedTSplines) {
  const std::string spline =
      "{ type: t_spline, degree: 1, at: [[0, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]], lines: [[0, "
      "1], [2, 4], [5, 7], [0, 5], [3, 6], [1, 7]], points: [[0, 0], [2, 0], [0, 1], [1, 1, 1], [2, 1], [0, 2], [1, "
      "2], [2, 2]]";
  const auto curves = [&](const std::string& more, const std::string& helper, const std::string& fields) {
    return curves_of(spline + more + " }", helper, fields);
  };
  const Vec3 by(0, 0, 4);
  const std::string moved = ", transform: { translate: [0, 0, 4] }";
  for (const auto& [helper, fields, shift] :
       {std::tuple("control_net", "", by), std::tuple("t_mesh", "where: surface", by),
        std::tuple("t_mesh", "where: plane", Vec3(0))}) {
    const std::vector<CurvePtr> there = curves("", helper, fields), here = curves(moved, helper, fields);
    EXPECT_GT(there.size(), 5u) << helper;
    ASSERT_EQ(here.size(), there.size()) << helper;
    for (size_t k = 0; k < here.size(); ++k) {
      const double t = there[k]->domain().lo;
      EXPECT_NEAR(glm::length(here[k]->point(t) - there[k]->point(t) - shift), 0, 1e-13) << helper;
    }
  }
}

TEST(SurfaceFigures, LinesOfCurvatureOfATorus) {
  // k = -1 about the tube: the smaller one.
  for (const CurvePtr& line : curves_of("torus", "curvature_lines", "family: minimum, at_u: 5, at_v: 1")) {
    const double angle = std::atan2(line->point(0).y, line->point(0).x);
    each_place(line, [&](const Vec3& p) { EXPECT_NEAR(-std::sin(angle) * p.x + std::cos(angle) * p.y, 0, 1e-10); });
  }
  const auto parallels = curves_of("torus", "curvature_lines", "family: maximum, at_u: 1, at_v: 4");
  EXPECT_EQ(parallels.size(), 4u);
  for (const CurvePtr& line : parallels)
    each_place(line, [&](const Vec3& p) { EXPECT_NEAR(p.z, line->point(0).z, 1e-10); });
}

TEST(SurfaceFigures, NearLinesAreLeftOut) {
  // Two beginnings on one line.
  EXPECT_EQ(curves_of("torus", "curvature_lines", "family: maximum, at_u: 4, at_v: [0.5]").size(), 1u);
}

// On the saddle z = v^2 - u^2/2, II = 2 dv^2 - du^2 up to a factor: dv = +-du/sqrt 2.
TEST(SurfaceFigures, AsymptoticLinesOfASaddle) {
  const auto lines = curves_of("saddle", "asymptotic_lines", "at_u: 3, at_v: 3");
  EXPECT_GE(lines.size(), 6u);
  for (const CurvePtr& line : lines) {
    const Vec3 start = line->point(0);
    each_place(line, [&](const Vec3& p) {
      EXPECT_NEAR(std::abs(p.y - start.y), std::abs(p.x - start.x) / std::sqrt(2.0), 1e-9);
    });
  }
}

TEST(SurfaceFigures, ContourLines) {
  const auto parabolic = curves_of("torus", "contour_lines", "quantity: gaussian_curvature, levels: [0]");
  EXPECT_EQ(parabolic.size(), 2u);
  for (const CurvePtr& line : parabolic) each_place(line, [](const Vec3& p) { EXPECT_NEAR(std::abs(p.z), 1, 1e-9); });
  for (const CurvePtr& line : curves_of("bowl", "contour_lines", "formula: z, levels: [0.2]"))
    each_place(line, [](const Vec3& p) { EXPECT_NEAR(p.z, 0.2, 1e-3); });
}

TEST(SurfaceFigures, ContourLinesSayTheirNumbers) {
  const LineWork work =
      drawn("  - { shape: bowl, show: { contour_lines: { formula: z, levels: [0.2, 0.5], labels: true } } }\n");
  std::set<std::string> words;
  for (const PointText& text : work.texts) {
    words.insert(text.text);
    EXPECT_NEAR(text.point.z, std::stod(text.text), 1e-9);
  }
  EXPECT_EQ(words, (std::set<std::string>{"0.2", "0.5"}));
}

// On a disk only the chord is left of the line x = 1/2; all faces of a body have the same levels.
TEST(SurfaceFigures, FacesOfBodies) {
  const auto chords = curves_of(
      "{ type: trimmed_surface, of: { type: plane, size: [4, 4] }, loops: { type: circle, "
      "radius: 1 } }",
      "contour_lines", "formula: x, levels: [0.5]");
  ASSERT_EQ(chords.size(), 1u);
  double reach = 0;
  each_place(chords[0], [&](const Vec3& p) {
    EXPECT_NEAR(p.x, 0.5, 1e-12);
    reach = std::max(reach, std::abs(p.y));
  });
  EXPECT_NEAR(reach, std::sqrt(0.75), 1e-6);
  std::set<double> heights;
  for (const CurvePtr& line : curves_of("{ type: box, size: [2, 2, 2] }", "contour_lines", "formula: z, levels: 3"))
    heights.insert(std::round(1e9 * line->point(line->domain().lo).z) / 1e9);
  heights.erase(0), heights.erase(2);  // edges
  EXPECT_EQ(heights, (std::set<double>{0.5, 1, 1.5}));
}

TEST(SurfaceFigures, Isophotes) {
  for (const CurvePtr& line : curves_of("torus", "isophotes", "direction: z, angles: [60]"))
    each_place(line, [](const Vec3& p) { EXPECT_NEAR(p.z, 0.5, 1e-9); });
}

// Mirrored in the plane z = 0 the eye is at z = -5: lamps at the height 10 are seen at a third of their distance.
TEST(SurfaceFigures, Reflections) {
  std::vector<double> at;
  for (const CurvePtr& line : curves_of("{ type: plane, size: [6, 6] }", "reflections",
                                        "eye: [0, 0, 5], lamp: { through: [0, 0, 10], along: x }, count: 3")) {
    at.push_back(line->point(line->domain().lo).y);
    each_place(line, [&](const Vec3& p) { EXPECT_NEAR(p.y, at.back(), 1e-9); });
  }
  std::sort(at.begin(), at.end());
  ASSERT_EQ(at.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(at[k], (k - 1) / 3.0, 1e-9);
}

// A parallel of a ball of radius 2 at the latitude 0.6: k_g = tan(0.6)/2 to the north, k_n = -1/2.
TEST(SurfaceFigures, CombsOfACurveOnASurface) {
  const std::string parallel =
      "{ type: surface_curve, of: { type: sphere_surface, radius: 2 }, image: { type: segment, from: [0, 0.6], to: [2, "
      "0.6] } }";
  for (const CurvePtr& tooth : curves_of(parallel, "comb", "by: geodesic_curvature, count: 5, envelope: false")) {
    const Vec3 way = tooth->point(1) - tooth->point(0);
    EXPECT_NEAR(glm::length(way), std::tan(0.6) / 2, 1e-12);
    EXPECT_NEAR(way.z, -std::cos(0.6) * std::tan(0.6) / 2, 1e-12);
  }
  for (const CurvePtr& tooth : curves_of(parallel, "comb", "by: normal_curvature, count: 5, envelope: false"))
    EXPECT_NEAR(glm::length(tooth->point(1)), 2.5, 1e-12);
}

TEST(SurfaceFigures, UmbilicsAreMarked) {
  const LineWork work = drawn("  - { shape: egg, show: { umbilics: {} } }\n");
  ASSERT_EQ(work.marks.size(), 4u);
  const double x = 3 * std::sqrt((9 - 4) / (9 - 1.44));
  for (const Mark& mark : work.marks) EXPECT_NEAR(std::abs(mark.point.x), x, 1e-6);
}

// z = u^2 + v^2/4 curves by 2 and 1/2 at its lowest point.
TEST(SurfaceFigures, PrincipalCircles) {
  const auto circles = curves_of("bowl", "principal_circles", "u: 0, v: 0, center: false");
  ASSERT_EQ(circles.size(), 2u);
  each_place(circles[0], [](const Vec3& p) { EXPECT_NEAR(glm::length(p - Vec3(0, 0, 0.5)), 0.5, 1e-12); });
  each_place(circles[1], [](const Vec3& p) { EXPECT_NEAR(glm::length(p - Vec3(0, 0, 2)), 2, 1e-12); });
}

TEST(SurfaceFigures, DupinIndicatrix) {
  const auto on_conic = [](const std::string& shape, double k1, double k2, size_t count) {
    const auto lines = curves_of(shape, "dupin_indicatrix", "u: 0, v: 0, scale: 0.5");
    EXPECT_EQ(lines.size(), count);
    for (const CurvePtr& line : lines)
      each_place(line, [&](const Vec3& p) {
        EXPECT_NEAR(std::abs(k1 * p.x * p.x + k2 * p.y * p.y), 0.25, 1e-12);
        EXPECT_EQ(p.z, 0);
      });
  };
  on_conic("bowl", 2, 0.5, 1);
  on_conic("saddle", -1, 2, 4);
  on_conic("trough", 1, 0, 2);
}

TEST(SurfaceFigures, TangentPlaneAndDirections) {
  const auto plane = curves_of("bowl", "tangent_plane", "u: 0, v: 0, size: 2, vectors: true");
  ASSERT_EQ(plane.size(), 4u);
  each_place(plane[0], [](const Vec3& p) { EXPECT_EQ(p.z, 0); });
  EXPECT_EQ(plane[1]->point(1), Vec3(0, 0, 1));
  const auto cross = curves_of("bowl", "principal_directions", "at_u: [0], at_v: [0], length: 2");
  ASSERT_EQ(cross.size(), 2u);
  EXPECT_NEAR(std::abs(cross[0]->point(1).x), 1, 1e-12);
  EXPECT_NEAR(std::abs(cross[1]->point(1).y), 1, 1e-12);
}

TEST(SurfaceFigures, Hedgehog) {
  for (const CurvePtr& needle :
       curves_of("egg", "hedgehog", "formula: '2 + 0*x', scale: 0.5, at_u: 3, at_v: [0.2], envelope: false"))
    EXPECT_NEAR(glm::length(needle->point(1) - needle->point(0)), 1, 1e-12);
}

// Axes of the length that is asked for, across their row, at the tilt to the tangent plane of z = x^2/2.
TEST(SurfaceFigures, ToolAxes) {
  const std::vector<CurvePtr> arrows =
      curves_of("trough", "tool_axis_field", "tilt: 30 + 0*u, length: 2, at_u: [0.4, 0.9], at_v: [-0.5, 0.3]");
  ASSERT_EQ(arrows.size(), 4u);
  for (const CurvePtr& arrow : arrows) {
    const Vec3 foot = arrow->point(0), q = arrow->point(1) - foot;
    const Vec3 row(1, 0, foot.x), normal = glm::normalize(Vec3(-foot.x, 0, 1));
    EXPECT_NEAR(glm::length(q), 2, 1e-12);
    EXPECT_NEAR(glm::dot(q, normal), 1, 1e-12);
    EXPECT_NEAR(glm::dot(q, row), 0, 1e-12);
    EXPECT_LT(q.y, 0);  // on the side of t x n
  }
}

// All corners of the rectangle lie on circles through its middle; Voronoi's cell of that is a square set on a corner.
TEST(MeshFigures, CirclesAndCells) {
  for (const CurvePtr& circle : curves_of("net", "circumcircles", ""))
    EXPECT_TRUE([&] {
      bool through_middle = false;
      const geometry::Interval domain = circle->domain();
      for (int k = 0; k < 3600; ++k)
        through_middle = through_middle ||
                         glm::length(circle->point(domain.lo + domain.width() * k / 3600) - Vec3(2, 1.5, 0)) < 2e-3;
      return through_middle;
    }());
  const auto borders = curves_of("net", "voronoi", "reach: 1");
  EXPECT_EQ(borders.size(), 8u);  // four of the inner cell, four that go out
  for (const CurvePtr& border : borders)
    for (const double t : {0.0, 1.0}) {
      const Vec3 p = border->point(t);
      const double to_middle = glm::length(p - Vec3(2, 1.5, 0));
      for (const Vec3& corner : {Vec3(0), Vec3(4, 0, 0), Vec3(4, 3, 0), Vec3(0, 3, 0)})
        if (t == 0) {
          EXPECT_GE(glm::length(p - corner), to_middle - 1e-12);
        }
    }
}

TEST(SurfaceFigures, WrongPlaces) {
  const auto said = [](const std::string& object) {
    return build_text(
               "geometry: { bowl: { type: formula_surface, point: [u, v, u^2], domain: { u: [-1, 1], v: [-1, 1] } }, "
               "flat: { type: plane } }\nlights: {}\nimage: { size: [96, 72] }\nobjects: " +
               object)
        .said;
  };
  EXPECT_NE(said("{ shape: bowl, show: { tangent_plane: { u: 0, v: 9 } } }").find("has no v = 9"), std::string::npos);
  EXPECT_NE(said("{ shape: bowl, show: { principal_circles: { u: 3, v: 0 } } }").find("has no u = 3"),
            std::string::npos);
  EXPECT_NE(said("{ shape: flat, show: { isophotes: {} } }").find("unbounded"), std::string::npos);
  EXPECT_NE(
      said("{ shape: { type: circle, radius: 1 }, show: { comb: { by: geodesic_curvature } } }").find("on no surface"),
      std::string::npos);
  EXPECT_NE(said("{ shape: bowl, show: { reflections: {} } }").find("give either `along`"), std::string::npos);
  EXPECT_NE(said("{ shape: bowl, show: { isophotes: { angles: [200] } } }").find("not between 0 and 180"),
            std::string::npos);
}

}  // namespace
}  // namespace lekalo::render::surface_figures_test
