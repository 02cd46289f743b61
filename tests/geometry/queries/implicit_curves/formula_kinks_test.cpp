// Formulas with kinks: their branches against the formulas themselves, creases and outlines against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/expression/branches.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/shapes/csg/csg_contours.h"
#include "geometry/shapes/implicit/implicit_contours.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "support/curve_places.h"

namespace lekalo::geometry::formula_kinks_test {
namespace {

Expression formula(const std::string& text) {
  auto parsed = Expression::parse(text);
  Expression& result = std::get<Expression>(parsed);
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  EXPECT_FALSE(result.bind(variables)) << text;
  return result;
}

ImplicitSurface surface(const std::string& text, double half, bool closed = false) {
  return {formula(text), 0, {{Vec3(-half), Vec3(half)}}, closed};
}

constexpr int kChords = 2000;  // of a line

double length_of(const ImplicitContours& lines) {
  double length = 0;
  for (const ImplicitContour& line : lines.lines) length += checks::chord_length(*line.curve, kChords);
  return length;
}

const ViewOf kView{false, {0.48, -0.61, 0.63}};

// At each place just one of the branches holds, and has the value of the whole.
void expect_parted(const Expression& whole, const std::vector<ExpressionBranch>& branches, double error) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int k = 0; k < 200; ++k) {
    const double x = number(random), y = number(random), z = number(random);
    int holding = 0;
    for (const ExpressionBranch& branch : branches) {
      bool holds = true;
      for (const ExpressionBranch::Side& side : branch.sides)
        holds = holds && side.height(x, y, z) * (side.positive ? 1 : -1) >= 0;
      if (!holds) continue;
      ++holding;
      EXPECT_NEAR(branch.formulas[0](x, y, z), whole(x, y, z), error) << whole.text();
    }
    EXPECT_EQ(holding, 1) << whole.text();
  }
}

TEST(ExpressionBranches, EachIsTheFormulaWhereItsSidesHold) {
  const struct {
    const char* text;
    size_t branches;
  } cases[] = {{"x*y - sin(z)", 1},
               {"abs(x) + abs(y) + abs(z)", 8},
               {"max(abs(x), abs(y), abs(z))", 6},
               {"abs(x)*y + abs(x)*z", 2},
               {"min(x, y)*max(x, y)", 4},
               {"clamp(x, -y, y)", 3},
               {"sign(x)*x + floor(y)", 2},
               {"x if x > y and not z > 0 or y <= -z else abs(z) if x == y else z^2", 2},
               {"abs(abs(x) - abs(y))", 8},
               {"sqrt(abs(x - max(y, z)))", 4}};
  for (const auto& one : cases) {
    const Expression whole = formula(one.text);
    const auto branches = expression_branches({&whole, 1});
    ASSERT_TRUE(branches);
    EXPECT_EQ(branches->size(), one.branches) << one.text;
    expect_parted(whole, *branches, 0);
  }
  const Expression many =
      formula("abs(x) + abs(y) + abs(z) + abs(x+1) + abs(y+1) + abs(z+1) + abs(x+2) + abs(y+2) + abs(z+2)");
  EXPECT_FALSE(expression_branches({&many, 1}));
}

// Steps are branches where the ranges of the variables tell how many there are.
TEST(ExpressionBranches, StepsAreThoseInTheRanges) {
  const struct {
    const char* text;
    size_t branches;
  } cases[] = {{"floor(2*x) + y", 8},
               {"ceil(x + y)", 8},
               {"round(x)*z", 5},
               {"mod(x, 2)", 2},
               {"mod(x*y, 3) + floor(x*y)", 32},
               {"x - floor(x)*floor(x)", 4},
               {"abs(floor(x)) + mod(y, -2)", 8},
               {"sign(floor(x)) + max(floor(y), 0.5)", 16},
               {"1 if mod(floor(x) + floor(y), 2) == 0 else z", 16},
               {"x if floor(x) > 0 and y > z else -x", 5},
               {"floor(100*x)", 1},
               {"mod(x, y)", 1}};
  const Expression unknown = formula("floor(2*x) + y");
  EXPECT_EQ(expression_branches({&unknown, 1})->size(), 1u);
  const std::array ranges{Interval{-2, 2}, Interval{-2, 2}, Interval{-2, 2}};
  for (const auto& one : cases) {
    const Expression whole = formula(one.text);
    const auto branches = expression_branches({&whole, 1}, ranges);
    ASSERT_TRUE(branches);
    EXPECT_EQ(branches->size(), one.branches) << one.text;
    expect_parted(whole, *branches, 1e-14);
  }
}

TEST(FormulaKinks, CubeAndOctahedron) {
  const ImplicitSurface cube = surface("max(abs(x), abs(y), abs(z)) - 1", 1.3, true),
                        octahedron = surface("abs(x) + abs(y) + abs(z) - 1", 1.3, true);
  const ImplicitContours edges = creases(cube, kView), ridges = creases(octahedron, kView);
  EXPECT_TRUE(edges.complete && ridges.complete);
  ASSERT_EQ(edges.lines.size(), 12u);
  ASSERT_EQ(ridges.lines.size(), 12u);
  for (const ImplicitContour& line : edges.lines) {
    EXPECT_NEAR(checks::chord_length(*line.curve, kChords), 2, 1e-10);
    EXPECT_TRUE(line.turns.empty());
    const Interval t = line.curve->domain();
    for (const double end : {t.lo, t.hi}) EXPECT_LT(glm::length(glm::abs(line.curve->point(end)) - Vec3(1)), 1e-10);
    const Vec3 middle = glm::abs(line.curve->point(t.middle()));
    EXPECT_NEAR(middle.x + middle.y + middle.z, 2, 1e-10);
  }
  for (const ImplicitContour& line : ridges.lines) {
    EXPECT_NEAR(checks::chord_length(*line.curve, kChords), std::sqrt(2.0), 1e-10);
    for (const double x : {0.0, 0.3, 1.0}) {
      const Vec3 p = glm::abs(line.curve->point(line.curve->domain().lo + x * line.curve->domain().width()));
      EXPECT_NEAR(p.x + p.y + p.z, 1, 1e-12);
      EXPECT_NEAR(std::min({p.x, p.y, p.z}), 0, 1e-12);
    }
  }
  for (const ImplicitSurface* one : {&cube, &octahedron}) {
    const ImplicitContours outline = silhouette(*one, kView), rim = border(*one, kView);
    EXPECT_TRUE(outline.complete && rim.complete);
    EXPECT_TRUE(outline.lines.empty() && rim.lines.empty());
  }
  // Across a diagonal of space: regular hexagons.
  const ImplicitContours of_cube = plane_section(cube, {0, 0, 0}, {1, 1, 1}, kView),
                         of_octahedron = plane_section(octahedron, {0, 0, 0}, {1, 1, 1}, kView);
  EXPECT_TRUE(of_cube.complete && of_octahedron.complete);
  EXPECT_NEAR(length_of(of_cube), 6 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(length_of(of_octahedron), 6 * std::sqrt(0.5), 1e-9);
}

// Two balls as one formula, against their union.
TEST(FormulaKinks, BallsThatOverlap) {
  const ImplicitSurface both = surface("min(x^2 + y^2 + z^2, (x - 0.9)^2 + (y - 0.2)^2 + z^2 + 0.3) - 1", 2.1, true);
  const std::vector<Vec3> centers{{0, 0, 0}, {0.9, 0.2, 0}};
  const std::vector<double> radii{1, std::sqrt(0.7)};
  const Csg expected(Csg::Operation::unite, {std::make_shared<Balls>(centers, radii)});
  for (const ViewOf& view : {kView, ViewOf{true, {4, 3, 5}}, ViewOf{false, {0, 0, 1}}}) {
    const ImplicitContours crease = creases(both, view), outline = silhouette(both, view);
    EXPECT_TRUE(crease.complete && outline.complete);
    ASSERT_EQ(crease.lines.size(), 1u);
    EXPECT_TRUE(crease.lines[0].closed);
    double of_edges = 0, of_outlines = 0;
    for (const CsgLine& line : csg_lines(expected, view).lines)
      (line.kind == CsgLine::Kind::silhouette ? of_outlines : of_edges) += checks::chord_length(*line.curve, kChords);
    EXPECT_NEAR(length_of(crease), of_edges, 1e-5);
    EXPECT_NEAR(length_of(outline), of_outlines, 1e-5);
  }
}

TEST(FormulaKinks, SheetsWithCreases) {
  // Along both axes; along x = 0; nowhere; where the branch changes; a circle.
  const struct {
    const char* text;
    double length;
  } cases[] = {{"z - abs(x*y)", 4},
               {"z - abs(x) - 0.3*y", 2 * std::sqrt(1.09)},
               {"z - x*abs(x)", 0},
               {"z - (x^2 if x > 0 else -x)", 2},
               {"z - max(0.5, x^2 + y^2)", kTwoPi * std::sqrt(0.5)},
               {"z - 0.5*sign(x)*x", 2}};
  for (const auto& one : cases) {
    const ImplicitContours found = creases(surface(one.text, 1), kView);
    EXPECT_TRUE(found.complete) << one.text;
    EXPECT_NEAR(length_of(found), one.length, 2e-5) << one.text;
  }
  EXPECT_FALSE(creases(surface("z - (0.5 if x > 0.1*y else 0)", 1), kView).complete);
}

TEST(FormulaKinks, SurfacesByParameters) {
  const struct {
    const char* z;
    double length;
    size_t parts;
  } cases[] = {{"u*v", 0, 1},
               {"abs(u*v)", 4, 2},
               {"abs(u) + abs(v)", 4 * std::sqrt(2.0), 4},
               {"v*abs(v)", 0, 2},
               // u = v from 0.25 on; u and v at 0.25 below that.
               {"max(u, v, 0.25)", 0.75 * std::sqrt(3.0) + 2 * 1.25, 3}};
  for (const auto& one : cases) {
    const SurfacePtr sheet = std::make_shared<FormulaSurface>(point_formulas({"u", "v", one.z}, {"u", "v"}),
                                                              Rectangle{{-1, 1}, {-1, 1}}, FormulaSurface::Closed{});
    const std::vector<SmoothPart> parts = smooth_parts(sheet);
    ASSERT_EQ(parts.size(), one.parts) << one.z;
    const FreeCreases found = free_creases(parts);
    EXPECT_TRUE(found.complete);
    double length = 0;
    for (const FreeCrease& crease : found.lines) {
      const Interval t = crease.image->domain();
      Vec3 before(0);
      for (int k = 0; k <= 1000; ++k) {
        const Vec3 uv = crease.image->point(t.lo + t.width() * k / 1000);
        const Vec3 p = sheet->point(uv.x, uv.y);
        for (const int part : crease.parts)
          EXPECT_LT(glm::length(parts[static_cast<size_t>(part)].surface->point(uv.x, uv.y) - p), 1e-12);
        if (k > 0) length += glm::length(p - before);
        before = p;
      }
    }
    EXPECT_NEAR(length, one.length, 1e-5) << one.z;
  }
}

// The edges of steps, once on each side.
TEST(FormulaKinks, StepsOfSurfaces) {
  const double corner = std::acos(0.8);  // of the circle of radius 1.25 about a square of half side 1
  const struct {
    const char* z;
    double length;
    size_t parts;
  } cases[] = {{"sign(u^2 + v^2 - 0.49)", 2 * kPi * 0.7, 2},
               {"floor(4*hypot(u, v))", 2 * kPi * (0.25 + 0.5 + 0.75 + 1) + 1.25 * (2 * kPi - 8 * corner), 6},
               {"ceil(2*u)", 3 * 2.0, 4},
               {"round(u + v)", 2 * std::sqrt(2.0) * (1.5 + 0.5), 5},
               {"mod(1.5*u + v, 2) + v^2", 2 * std::hypot(2.0 / 3, 1) + 2 * std::hypot(1.0 / 3, 0.5), 4}};
  for (const auto& one : cases) {
    const SurfacePtr sheet = std::make_shared<FormulaSurface>(point_formulas({"u", "v", one.z}, {"u", "v"}),
                                                              Rectangle{{-1, 1}, {-1, 1}}, FormulaSurface::Closed{});
    const std::vector<SmoothPart> parts = smooth_parts(sheet);
    EXPECT_EQ(parts.size(), one.parts) << one.z;
    const FreeCreases found = free_creases(parts);
    EXPECT_TRUE(found.complete) << one.z;
    double length = 0;
    for (const FreeCrease& crease : found.lines) {
      EXPECT_TRUE(crease.step);
      const Interval t = crease.image->domain();
      constexpr int kSteps = 4000;
      for (int k = 0; k < kSteps; ++k)
        length += glm::length(crease.image->point(t.lo + t.width() * (k + 1) / kSteps) -
                              crease.image->point(t.lo + t.width() * k / kSteps));
    }
    EXPECT_NEAR(length, one.length, 2e-5) << one.z;
  }
}

}  // namespace
}  // namespace lekalo::geometry::formula_kinks_test
