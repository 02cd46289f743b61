#include "geometry/surfaces/splines/t_spline.h"

#include <gtest/gtest.h>

#include <set>

#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/describe.h"
#include "geometry/surfaces/splines/t_refinement.h"
#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry::t_spline_test {
namespace {

using namespace checks;

// The grid 0..5 x 0..5, vertex (i, j) being 6 i + j.
struct Grid6 {
  std::vector<Vec3> at;
  std::vector<std::vector<int>> lines;
  Grid6() {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) at.emplace_back(i, j, 0);
      lines.push_back({6 * i, 6 * i + 5});
      lines.push_back({i, 30 + i});
    }
  }
  TMesh mesh() const { return t_mesh(at, lines); }
};

double uneven(int i) { return std::sin(12.9898 * i) * 43758.5453 - std::floor(std::sin(12.9898 * i) * 43758.5453); }

std::vector<Vec3> bumps(const std::vector<Vec3>& at) {
  std::vector<Vec3> points;
  for (size_t i = 0; i < at.size(); ++i)
    points.push_back(at[i] + Vec3(uneven(3 * i), uneven(3 * i + 1), 2 * uneven(3 * i + 2)));
  return points;
}

TEST(TSpline, KnotsOfVertices) {
  Grid6 grid;
  grid.at.insert(grid.at.end(), {{2.5, 2, 0}, {2.5, 3, 0}});
  grid.lines.push_back({36, 37});
  auto knots = inferred_knots(grid.mesh(), 3);
  EXPECT_EQ(knots[6 * 3 + 3].u, (std::vector<double>{2, 2.5, 3, 4, 5}));
  EXPECT_EQ(knots[6 * 3 + 3].v, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(knots[37].u, (std::vector<double>{1, 2, 2.5, 3, 4}));
  EXPECT_EQ(knots[37].v, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(knots[0].u, (std::vector<double>{0, 0, 0, 1, 2}));
  grid.at.insert(grid.at.end(), {{3, 3.5, 0}, {4, 3.5, 0}});
  grid.lines.push_back({38, 39});
  knots = inferred_knots(grid.mesh(), 3);
  EXPECT_EQ(knots[6 * 3 + 3].v, (std::vector<double>{1, 2, 3, 3.5, 4}));
  // Of degree 5 a border vertex has the border's knot four times, the one next to it three times.
  knots = inferred_knots(Grid6().mesh(), 5);
  EXPECT_EQ(knots[0].u, (std::vector<double>{0, 0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(knots[6].u, (std::vector<double>{0, 0, 0, 1, 2, 3, 4}));
}

TEST(TSpline, OnAFullGridIsTheNurbsSurface) {
  const Grid6 grid;
  const auto functions = inferred_knots(grid.mesh(), 3);
  const Rectangle domain = valid_domain(grid.mesh(), functions);
  EXPECT_EQ(domain.u, Interval(1, 4));
  EXPECT_EQ(domain.v, Interval(1, 4));
  const std::vector<Vec3> points = bumps(grid.at);
  std::vector<double> weights;
  for (int i = 0; i < 36; ++i) weights.push_back(0.5 + uneven(i + 500));
  const TSpline spline(functions, points, weights, domain);
  const std::vector<double> knots{0, 0, 0, 1, 2, 3, 4, 5, 5, 5};
  const SplineAxis axis(3, knots, Extension::tangent);
  const NurbsSurface nurbs(axis, axis, points, weights);
  std::mt19937_64 random(4);
  for (int k = 0; k < 200; ++k) {
    const Vec2 p = random_place(domain, random);
    const SurfaceJet a = spline.evaluate(p.x, p.y, 2), b = nurbs.evaluate(p.x, p.y, 2);
    for (int n = 0; n < 6; ++n) EXPECT_LE(glm::length(a.values[n] - b.values[n]), 1e-12) << p.x << ' ' << p.y;
  }
  check_enclosures(spline, domain);
}

// An edge at u = 2.5 between v = 2 and v = 3 changes the functions of those two rows alone: Boehm's knot insertion
// along them leaves the surface as it was.
TEST(TSpline, KeepsTheSurfaceWhenRowsAreRefined) {
  Grid6 grid;
  std::vector<Vec3> points = bumps(grid.at);
  const auto plain = inferred_knots(grid.mesh(), 3);
  const Rectangle domain = valid_domain(grid.mesh(), plain);
  const TSpline before(plain, points, {}, domain);
  grid.at.insert(grid.at.end(), {{2.5, 2, 0}, {2.5, 3, 0}});
  grid.lines.push_back({36, 37});
  for (const int row : {2, 3}) {
    NurbsCurveForm form{3, {0, 0, 0, 1, 2, 3, 4, 5, 5, 5}, {}, {}};
    for (int i = 0; i < 6; ++i) form.points.emplace_back(points[6 * i + row], 1);
    const NurbsCurveForm finer = insert_knot(form, 2.5);
    for (int i = 0; i < 6; ++i) points[6 * i + row] = Vec3(finer.points[i < 3 ? i : i + 1]);
    points.emplace_back(finer.points[3]);
  }
  const TSpline after(inferred_knots(grid.mesh(), 3), points, {}, domain, grid.mesh().edges);
  std::mt19937_64 random(5);
  for (int k = 0; k < 200; ++k) {
    const Vec2 p = random_place(domain, random);
    EXPECT_LE(glm::length(after.point(p.x, p.y) - before.point(p.x, p.y)), 1e-13) << p.x << ' ' << p.y;
  }
  // The new vertices cut two edges of the 60 and have one between them.
  EXPECT_EQ(after.edges().size(), 60u + 3u);
}

// Cubic surfaces are in the space of a mesh whose lines go all the way, and in that of the one with a short edge.
TEST(TSpline, FitOfASurfaceInItsSpace) {
  Grid6 grid;
  grid.at.insert(grid.at.end(), {{2.5, 2, 0}, {2.5, 3, 0}});
  grid.lines.push_back({36, 37});
  const auto functions = inferred_knots(grid.mesh(), 3);
  const Rectangle domain = valid_domain(grid.mesh(), functions);
  NurbsSurfaceForm form{3, 3, {0, 0, 0, 0, 5, 5, 5, 5}, {0, 0, 0, 0, 5, 5, 5, 5}, {}, {}, {}};
  for (int i = 0; i < 16; ++i) form.points.emplace_back(uneven(i), uneven(i + 20), uneven(i + 40), 1);
  const NurbsSurface cubic(form);
  const TSpline fit(functions, fitted_points(functions, {}, domain, cubic), {}, domain);
  std::mt19937_64 random(6);
  for (int k = 0; k < 100; ++k) {
    const Vec2 p = random_place(domain, random);
    EXPECT_LE(glm::length(fit.point(p.x, p.y) - cubic.point(p.x, p.y)), 1e-13);
  }
}

// A bump on a flat surface, by cubics and quintics: as near as wanted, with functions that sum to 1 and are fewer than
// those of full rows and columns.
TEST(TSpline, MeshMadeForATolerance) {
  std::vector<Vec3> points;
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 15; ++j) points.emplace_back(i, j, i == 2 && j == 3 ? 2 : 0);
  const std::vector<double> knots{0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 12, 12, 12};
  const SplineAxis axis(3, knots, Extension::tangent);
  const NurbsSurface bump(axis, axis, points);
  for (const auto& [degree, tolerance] : {std::pair(3, 0.01), std::pair(5, 0.06)}) {
    const TSpline spline = t_spline_within(bump, degree, 5, 5, tolerance);
    std::set<double> lines_u, lines_v;
    for (size_t i = 0; i < spline.points().size(); ++i) {
      lines_u.insert(spline.place(static_cast<int>(i)).x);
      lines_v.insert(spline.place(static_cast<int>(i)).y);
    }
    EXPECT_LT(spline.points().size(), 0.8 * lines_u.size() * lines_v.size()) << degree;
    for (int k = 0; k <= 60; ++k)
      for (int l = 0; l <= 60; ++l)
        EXPECT_LE(glm::length(spline.point(0.2 * k, 0.2 * l) - bump.point(0.2 * k, 0.2 * l)), 1.2 * tolerance);
    // Polynomial where the functions sum to 1.
    const auto form = spline.as_nurbs();
    for (const Vec4& p : form->points) EXPECT_NEAR(p.w, 1, 1e-13);
  }
}

std::string refused(const std::vector<Vec3>& at, const std::vector<std::vector<int>>& lines) {
  try {
    t_mesh(at, lines);
  } catch (const FieldError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(TSpline, MeshesThatBreakARule) {
  const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
  const std::vector<std::vector<int>> outline{{0, 1}, {2, 3}, {0, 2}, {1, 3}};
  EXPECT_EQ(refused(square, outline), "nothing");
  const auto with = [&](std::vector<Vec3> more, std::vector<std::vector<int>> lines) {
    more.insert(more.begin(), square.begin(), square.end());
    lines.insert(lines.begin(), outline.begin(), outline.end());
    return refused(more, lines);
  };
  EXPECT_EQ(with({}, {{0, 3}}), "the line from vertex 0 at (0, 0) to vertex 3 at (2, 2) is not parallel to an axis");
  EXPECT_EQ(with({{1, 0, 0}, {1, 2, 0}, {0, 1, 0}, {2, 1, 0}}, {{4, 5}, {6, 7}}),
            "lines cross at (1, 1), where there is no vertex");
  EXPECT_EQ(with({{1, 0, 0}, {1, 1, 0}}, {{4, 5}}),
            "at vertex 5 at (1, 1) a line ends or turns: the cells there are not rectangles");
  EXPECT_EQ(with({{1, 1, 0}}, {}), "vertex 4 at (1, 1) is on no line");
  EXPECT_EQ(with({{1, 0, 0}, {1, 2, 0}}, {}),
            "vertex 4 at (1, 0) and vertex 5 at (1, 2) face each other across a cell");
  EXPECT_EQ(refused(square, {{0, 1}, {2, 3}, {0, 2}}), "the right border has a gap beside vertex 1 at (2, 0)");
  EXPECT_EQ(with({{0, 0, 0}}, {}), "vertices 0 and 4 are both at (0, 0)");
  // A square that hangs in the middle has corners.
  EXPECT_NE(with({{.5, .5, 0}, {1, .5, 0}, {.5, 1, 0}, {1, 1, 0}}, {{4, 5}, {6, 7}, {4, 6}, {5, 7}}), "nothing");
}

}  // namespace
}  // namespace lekalo::geometry::t_spline_test
