// What a scene file may say about splines: each choice of fields builds the curve or surface that it describes, and
// wrong values are refused at the field that holds them, with the numbers.
#include <gtest/gtest.h>

#include "geometry/describe.h"

namespace lekalo::geometry {

TypeDeclaration segment_type();
TypeDeclaration polyline_type();
TypeDeclaration bezier_curve_type();
TypeDeclaration nurbs_curve_type();
TypeDeclaration bezier_surface_type();
TypeDeclaration nurbs_surface_type();

}  // namespace lekalo::geometry

namespace lekalo::geometry::spline_declarations_test {

namespace {

using Values = std::vector<std::pair<std::string, std::any>>;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

Fields fields_of(const Values& values) {
  Fields fields;
  for (const auto& [name, value] : values) fields.set(name, value);
  return fields;
}

CurvePtr curve(const TypeDeclaration& type, const Values& values) {
  return std::any_cast<CurvePtr>(type.build(fields_of(values)));
}

Values with(Values values, const Values& others) {
  values.insert(values.end(), others.begin(), others.end());
  return values;
}

std::string refusal(const TypeDeclaration& type, const Values& values) {
  try {
    type.build(fields_of(values));
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

const Points kPoints = {{0, 0, 0}, {1, 2, 0}, {3, 2, 0}, {4, 0, 0}, {6, 0, 0}};
const Values kCubic = {{"points", kPoints}, {"degree", 3}, {"knots", Knots{"clamped", {}}}, {"closed", false}};

TEST(CurveDeclarations, BuildTheCurvesTheyDescribe) {
  EXPECT_EQ(curve(segment_type(), {{"from", Vec3(0)}, {"to", Vec3(2, 0, 0)}})->point(0.5), Vec3(1, 0, 0));
  EXPECT_EQ(curve(polyline_type(), {{"points", kPoints}, {"closed", true}})->period(), 5);
  const CurvePtr bezier = curve(bezier_curve_type(), {{"points", kPoints}, {"domain", Interval(0, 0.5)}});
  EXPECT_EQ(bezier->domain(), Interval(0, 0.5));
  EXPECT_EQ(curve(nurbs_curve_type(), kCubic)->domain(), Interval(0, 2));
  EXPECT_EQ(curve(nurbs_curve_type(), with(kCubic, {{"domain", Interval(0.5, 1)}}))->domain(), Interval(0.5, 1));
  const CurvePtr closed = curve(nurbs_curve_type(), with(kCubic, {{"closed", true}, {"weights", List{1, 2, 1, 2, 1}}}));
  EXPECT_EQ(closed->period(), 5);
  EXPECT_TRUE(closed->is_closed());
  const CurvePtr spaced = curve(nurbs_curve_type(), with(kCubic, {{"knots", Knots{"chord_length", {}}}}));
  EXPECT_NEAR(spaced->domain().hi, 2 * std::sqrt(5) + 4, 1e-14);
}

TEST(CurveDeclarations, RefuseWrongValuesWhereTheyStand) {
  EXPECT_EQ(refusal(segment_type(), {{"from", Vec3(1)}, {"to", Vec3(1)}}), "to: the ends of the segment coincide");
  EXPECT_EQ(refusal(bezier_curve_type(), {{"points", kPoints}, {"domain", Interval(0, 2)}}),
            "domain: [0, 2] is not inside the knots' domain [0, 1]");
  EXPECT_EQ(refusal(nurbs_curve_type(), with(kCubic, {{"degree", 5}})),
            "points: a spline of degree 5 needs at least 6 points, not 5");
  EXPECT_EQ(refusal(nurbs_curve_type(), with(kCubic, {{"weights", List{1, 2}}})),
            "weights: 2 weights do not fit 5 points");
  EXPECT_EQ(refusal(nurbs_curve_type(), with(kCubic, {{"knots", Knots{"", {0, 0, 0, 0, 1, 1, 1, 1}}}})),
            "knots: 5 points of degree 3 need 9 knots, not 8");
  EXPECT_EQ(refusal(nurbs_curve_type(), with(kCubic, {{"weights", List{1, -9, 1, 1, 1}}})),
            "weights: the denominator vanishes between t = 0.03515625 and t = 0.035400390625: the curve goes through "
            "infinity");
  EXPECT_EQ(refusal(nurbs_curve_type(), with(kCubic, {{"closed", true}, {"domain", Interval(0, 6)}})),
            "domain: [0, 6] is longer than the period 5");
}

Grid<Vec3> net(int rows, int columns) {
  Grid<Vec3> grid{rows, columns, {}};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) grid.values.push_back({i, 2 * j, i * j});
  return grid;
}

const Values kSurface = {{"points", net(5, 4)},
                         {"degree.u", 3},
                         {"degree.v", 2},
                         {"knots.u", Knots{"clamped", {}}},
                         {"knots.v", Knots{"chord_length", {}}},
                         {"closed.u", false},
                         {"closed.v", false}};

TEST(SurfaceDeclarations, BuildTheSurfacesTheyDescribe) {
  const auto surface = [](const TypeDeclaration& type, const Values& values) {
    return std::any_cast<SurfacePtr>(type.build(fields_of(values)));
  };
  const Rectangle unit{{0, 1}, {0, 1}};
  const SurfacePtr bezier = surface(bezier_surface_type(), {{"points", net(3, 2)}, {"domain", unit}});
  EXPECT_EQ(bezier->point(1, 0), Vec3(2, 0, 0));
  EXPECT_EQ(bezier->point(0, 1), Vec3(0, 2, 0));
  const SurfacePtr nurbs = surface(nurbs_surface_type(), kSurface);
  EXPECT_EQ(nurbs->domain().u, Interval(0, 2));
  // Mean chord lengths of the five rows: steps sqrt(4 + i^2).
  EXPECT_NEAR(nurbs->domain().v.hi, 3 * (2 + std::sqrt(5.) + std::sqrt(8.) + std::sqrt(13.) + std::sqrt(20.)) / 5,
              1e-14);
  const SurfacePtr tube = surface(nurbs_surface_type(), with(kSurface, {{"closed.u", true}}));
  EXPECT_EQ(tube->periods().u, 5);
  EXPECT_EQ(tube->periods().v, 0);
}

TEST(SurfaceDeclarations, RefuseWrongValuesWhereTheyStand) {
  EXPECT_EQ(refusal(nurbs_surface_type(), with(kSurface, {{"degree.v", 4}})),
            "points: in direction v: a spline of degree 4 needs at least 5 points, not 4");
  EXPECT_EQ(refusal(nurbs_surface_type(), with(kSurface, {{"weights", Grid<double>{4, 5, List(20, 1)}}})),
            "weights: 4 x 5 weights do not fit 5 x 4 points");
  EXPECT_EQ(refusal(nurbs_surface_type(), with(kSurface, {{"domain", Rectangle{{0, 3}, {0, 1}}}})),
            "domain.u: in direction u: [0, 3] is not inside the knots' domain [0, 2]");
  EXPECT_EQ(refusal(bezier_surface_type(), {{"points", net(30, 4)}, {"domain", Rectangle{{0, 1}, {0, 1}}}}),
            "points: a Bezier surface has 2 to 26 rows and columns of points, not 30 x 4");
}

}  // namespace
}  // namespace lekalo::geometry::spline_declarations_test
