// Sections and edges of solids that are put together of others: their lengths against closed forms, and against those
// of the same solids made of other leaves.
#include "geometry/shapes/csg/csg_contours.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"

namespace lekalo::geometry::csg_contours_test {
namespace {

using Operation = Csg::Operation;
using Kind = CsgLine::Kind;

// Complete elliptic integral of the second kind, of the parameter 1/2, and the lemniscate constant.
constexpr double kEOfHalf = 1.3506438810476755, kLemniscate = 2.622057554292119;

ShapePtr shape_of(Body body) { return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body))); }
ShapePtr cube() { return shape_of(box(frame_from({-1, -1, -1}, {0, 0, 1}, {1, 0, 0}), {2, 2, 2})); }
ShapePtr ball_at(const Vec3& center, double radius) {
  return shape_of(ball(frame_from(center, {0, 0, 1}, {1, 0, 0}), radius));
}
ShapePtr pipe(const Vec3& from, const Vec3& axis, double radius, double height) {
  return shape_of(cylinder_body(frame_about(from, axis), radius, height));
}
ShapePtr implicit(const char* formula, const ImplicitRegion& region) {
  auto parsed = std::get<Expression>(Expression::parse(formula));
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  EXPECT_FALSE(parsed.bind(variables));
  return std::make_shared<ImplicitSurface>(parsed, 0, region, true);
}

double length_of(const CsgLines& found, Kind kind) {
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.left_out.empty());
  double length = 0;
  for (const CsgLine& line : found.lines) {
    const Interval t = line.curve->domain();
    if (line.kind == kind) length += arc_length(*line.curve, t.lo, t.hi).value;
  }
  return length;
}
CsgLines lines_of(const Csg& solid) { return csg_lines(solid, {false, glm::normalize(Vec3(-0.4, 0.7, -0.5))}); }
double length_of(const Csg& solid, Kind kind) { return length_of(lines_of(solid), kind); }

// Of all lines of the section, which lie in the plane.
double length_of_section(const Csg& solid, const Vec3& origin, const Vec3& normal) {
  const CsgLines section = csg_section(solid, origin, normal, {});
  for (const CsgLine& line : section.lines) {
    const Interval t = line.curve->domain();
    for (const double x : {0.1, 0.4, 0.9})
      EXPECT_NEAR(glm::dot(line.curve->point(t.lo + x * t.width()) - origin, normal), 0, 1e-10);
  }
  return length_of(section, Kind::section);
}

TEST(CsgSection, OfADifference) {
  const Csg cup(Operation::subtract, {cube(), ball_at({0, 0, 1}, 0.5)});
  // A square with half a circle out of its upper side.
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0}, {2, 0, 0}), 8 - 1 + 0.5 * kPi, 1e-9);
  // Below the ball a square, above it cut by a circle's chord: none of the ball is left out at z = 0.8 but the circle.
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0.2}, {0, 0, 1}), 8, 1e-9);
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0.8}, {0, 0, 1}), 8 + kTwoPi * std::sqrt(0.25 - 0.04), 1e-9);
  EXPECT_EQ(length_of_section(cup, {0, 0, 1.5}, {0, 0, 1}), 0);
}

TEST(CsgSection, OfAUnionAndAnIntersection) {
  // Two unit circles whose centres are 1 apart, 2 pi / 3 of each inside of the other.
  const std::vector<ShapePtr> balls = {ball_at({0, 0, 0}, 1), ball_at({1, 0, 0}, 1)};
  EXPECT_NEAR(length_of_section(Csg(Operation::unite, balls), {0, 0, 0}, {0, 0, 1}), 2 * (kTwoPi - kTwoPi / 3), 1e-9);
  EXPECT_NEAR(length_of_section(Csg(Operation::intersect, balls), {0, 0, 0}, {0, 0, 1}), 2 * kTwoPi / 3, 1e-9);
}

TEST(CsgSection, OfAHalfSpace) {
  const Csg part(Operation::intersect,
                 {ball_at({0, 0, 0}, 1), std::make_shared<HalfSpaceShape>(Vec3(0, 0, 0.3), Vec3(0, 0, 1))});
  const double chord = 2 * std::sqrt(1 - 0.09), arc = 2 * (kPi - std::acos(0.3));
  EXPECT_NEAR(length_of_section(part, {0, 0, 0}, {1, 0, 0}), chord + arc, 1e-9);
}

// Of leaves without surfaces: a cube with half a ball out of it, as an implicit surface.
TEST(CsgSection, OfAnImplicitLeaf) {
  const Csg cup(Operation::subtract, {cube(), implicit("x^2 + y^2 + (z - 1)^2 - 0.25", {{Vec3(-2), Vec3(2)}})});
  EXPECT_NEAR(length_of_section(cup, {0, 0, 0}, {2, 0, 0}), 8 - 1 + 0.5 * kPi, 1e-9);
}

// Lines in which leaves meet that cross themselves.
TEST(CsgLines, CrossingThemselves) {
  const ShapePtr upright = pipe({0, 0, -2}, {0, 0, 1}, 1, 4), lying = pipe({-2.5, 0, 0}, {1, 0, 0}, 1, 5);
  const double ellipses = 2 * 4 * std::sqrt(2.0) * kEOfHalf;
  EXPECT_NEAR(length_of(Csg(Operation::unite, {upright, lying}), Kind::sharp), ellipses + 4 * kTwoPi, 1e-8);
  EXPECT_NEAR(length_of(Csg(Operation::intersect, {upright, lying}), Kind::sharp), ellipses, 1e-8);
  EXPECT_NEAR(length_of(Csg(Operation::subtract, {upright, lying}), Kind::sharp), ellipses + 2 * kTwoPi, 1e-8);
  // Viviani's curve is as long as one of the ellipses.
  const ShapePtr ball = ball_at({0, 0, 0}, 1), drill = pipe({0.5, 0, -2}, {0, 0, 1}, 0.5, 4);
  const double viviani = 4 * std::sqrt(2.0) * kEOfHalf;
  EXPECT_NEAR(length_of(Csg(Operation::subtract, {ball, drill}), Kind::sharp), viviani, 1e-8);
  EXPECT_NEAR(length_of(Csg(Operation::intersect, {ball, drill}), Kind::sharp), viviani, 1e-8);
  EXPECT_NEAR(length_of(Csg(Operation::unite, {ball, drill}), Kind::sharp), viviani + 2 * kPi, 1e-8);
  // A torus that a plane touches from inside: Bernoulli's lemniscate.
  const ShapePtr ring = shape_of(torus_body(Frame(), 2, 1));
  for (const double side : {1.0, -1.0})
    EXPECT_NEAR(
        length_of(Csg(Operation::intersect, {ring, std::make_shared<HalfSpaceShape>(Vec3(1, 0, 0), Vec3(side, 0, 0))}),
                  Kind::sharp),
        2 * kLemniscate * std::sqrt(8.0), 1e-7);
}

TEST(CsgLines, SmoothEdges) {
  // A cylinder that ends in a ball; the same cylinder twice, one on top of the other, is one smooth surface.
  const ShapePtr shaft = pipe({0, 0, 0}, {0, 0, 1}, 1, 3);
  const CsgLines capsule = lines_of(Csg(Operation::unite, {shaft, ball_at({0, 0, 3}, 1)})),
                 column = lines_of(Csg(Operation::unite, {shaft, pipe({0, 0, 3}, {0, 0, 1}, 1, 3)}));
  EXPECT_GE(length_of(capsule, Kind::smooth), kTwoPi - 1e-9);
  EXPECT_NEAR(length_of(capsule, Kind::sharp), kTwoPi, 1e-9);
  EXPECT_EQ(length_of(column, Kind::smooth), 0);
  EXPECT_NEAR(length_of(column, Kind::sharp), 2 * kTwoPi, 1e-9);
  // A plate with a round end, of several sizes: the edge where it goes on in that is an edge of the box, too.
  for (const double r : {1.0, 0.8, 0.5, 0.37}) {
    const Csg plate(Operation::unite, {shape_of(box(frame_from({-3, -r, 0}, {0, 0, 1}, {1, 0, 0}), {3, 2 * r, 0.5})),
                                       pipe({0, 0, 0}, {0, 0, 1}, r, 0.5)});
    const double around = 3 * 2 + (2 + kPi) * r;
    const CsgLines of_plate = lines_of(plate);
    EXPECT_GE(length_of(of_plate, Kind::smooth), 2 * 0.5 - 1e-9) << r;
    for (const CsgLine& line : of_plate.lines) {
      if (line.kind != Kind::smooth) continue;
      const Vec3 p = line.curve->point(line.curve->domain().middle());
      EXPECT_NEAR(p.x, 0, 1e-9);
      EXPECT_NEAR(std::abs(p.y), r, 1e-9);
    }
    EXPECT_GE(length_of(of_plate, Kind::sharp), 2 * around + 2 * 0.5 - 1e-8) << r;
    // Only the upper and the lower sides are one.
    std::set<std::set<int>> one(of_plate.one_face.begin(), of_plate.one_face.end());
    EXPECT_EQ(one.size(), 2u) << r;
  }
}

// Balls that touch inside of one another leave an edge without an angle.
TEST(CsgLines, Cusps) {
  const Csg crescent(Operation::subtract, {pipe({0, 0, -2}, {0, 0, 1}, 1, 4), ball_at({0, 0, 0}, 1)});
  EXPECT_NEAR(length_of(crescent, Kind::sharp), 3 * kTwoPi, 1e-8);
}

struct Leaves {
  const char* name;
  ShapePtr one, other;
};

// The same solids of leaves that have surfaces and of some that have none.
TEST(CsgLines, OfLeavesWithoutSurfaces) {
  const Frame frame = frame_from({0.31, -0.12, 0.23}, {0, 0, 1}, {1, 0, 0});
  const std::array<Vec3, 1> center{frame.origin};
  const std::array<double, 1> radius{0.9};
  const auto circle = std::make_shared<FormulaCurve>(
      point_formulas({"0.31 + 0.9*cos(t)", "0.9*sin(t) - 0.12", "0.23"}, {"t"}), Interval{0, kTwoPi});
  const Vec3 from(-1.6, -0.4, 0.1), to(1.5, 0.5, 0.4);
  const Affine map =
      Affine::translation({-0.1, 0.2, 0.1}) * Affine::rotation(0.7, {1, 2, -1}) * Affine::scaling({1.2, 0.9, 0.8});
  const std::vector<Leaves> leaves = {
      {"implicit ball", ball_at(frame.origin, 0.9),
       implicit("(x - 0.31)^2 + (y + 0.12)^2 + (z - 0.23)^2 - 0.81", {{Vec3(-1.5), Vec3(1.5)}})},
      {"implicit ball in a box",
       std::make_shared<Csg>(
           Operation::intersect,
           std::vector<ShapePtr>{ball_at(frame.origin, 0.9),
                                 shape_of(box(frame_from({-0.4, -0.7, -0.5}, {0, 0, 1}, {1, 0, 0}), {1.1, 1.2, 1.3}))}),
       implicit("(x - 0.31)^2 + (y + 0.12)^2 + (z - 0.23)^2 - 0.81", {{Vec3(-0.4, -0.7, -0.5), Vec3(0.7, 0.5, 0.8)}})},
      {"ball of balls", ball_at(frame.origin, 0.9), std::make_shared<Balls>(center, radius)},
      {"straight tube", pipe(from, glm::normalize(to - from), 0.3, glm::length(to - from)),
       std::make_shared<Tube>(std::make_shared<Segment>(from, to), RadiusLaw(0.3), Caps::flat)},
      {"implicit torus", shape_of(torus_body(frame, 0.9, 0.35)),
       implicit("((x - 0.31)^2 + (y + 0.12)^2 + (z - 0.23)^2 + 0.6875)^2 - 3.24*((x - 0.31)^2 + (y + 0.12)^2)",
                {{Vec3(-2), Vec3(2)}})},
      {"ring of a tube", shape_of(torus_body(frame, 0.9, 0.35)),
       std::make_shared<Tube>(circle, RadiusLaw(0.35), Caps::round)},
      {"moved implicit ball", transformed(ball_at(frame.origin, 0.9), map),
       transformed(implicit("(x - 0.31)^2 + (y + 0.12)^2 + (z - 0.23)^2 - 0.81", {{Vec3(-1.5), Vec3(1.5)}}), map)},
      {"moved ring of a tube", transformed(shape_of(torus_body(frame, 0.9, 0.35)), map),
       transformed(std::make_shared<Tube>(circle, RadiusLaw(0.35), Caps::round), map)},
  };
  const std::vector<std::pair<const char*, ShapePtr>> others = {
      {"cube", shape_of(box(frame_from({-0.2, -0.9, -0.8}, {0.1, 0.2, 1}, {1, 0, 0}), {1.1, 1.3, 1.2}))},
      {"cylinder", pipe({0.2, 0.3, -1}, glm::normalize(Vec3(0.2, 0.1, 1)), 0.6, 2.1)},
      {"ball", ball_at({-0.3, 0.4, 0.2}, 0.7)}};
  for (const Leaves& leaf : leaves)
    for (const auto& [name, other] : others) {
      for (const Operation operation : {Operation::unite, Operation::intersect, Operation::subtract})
        for (const bool first : {true, false}) {
          if (!first && operation != Operation::subtract) continue;
          const auto solid = [&](const ShapePtr& one) {
            return Csg(operation, first ? std::vector{one, other} : std::vector{other, one});
          };
          const CsgLines with_surfaces = lines_of(solid(leaf.one)), without = lines_of(solid(leaf.other));
          for (const Kind kind : {Kind::sharp, Kind::silhouette})
            EXPECT_NEAR(length_of(without, kind), length_of(with_surfaces, kind), 1e-6)
                << leaf.name << " and " << name << ", operation " << static_cast<int>(operation)
                << (first ? "" : " the other way round") << (kind == Kind::sharp ? " edges" : " outlines");
        }
    }
}

// Two of them: balls whose circle is known.
TEST(CsgLines, OfTwoImplicitLeaves) {
  const ShapePtr one = implicit("x^2 + y^2 + z^2 - 1", {{Vec3(-1.5), Vec3(1.5)}});
  const ShapePtr other =
      transformed(implicit("x^2 + y^2 + 4*z^2 - 1", {{Vec3(-1.5), Vec3(1.5)}}),
                  Affine::rotation(0.4, {0, 1, 0}) * Affine{Mat3(1, 0, 0, 0, 1, 0, 0, 0, 2), Vec3(0.3, 0.4, 1.2)});
  // Unit balls 1.3 apart: a half of the way from the centres to the circle.
  const double circle = kTwoPi * std::sqrt(1 - 0.65 * 0.65);
  for (const Operation operation : {Operation::unite, Operation::intersect, Operation::subtract})
    EXPECT_NEAR(length_of(Csg(operation, {one, other}), Kind::sharp), circle, 1e-8);
}

// A cube cut by a ball of radius r < sqrt(2): the middle lines of its faces are chords; the ball's are cut where they
// go through the faces.
TEST(CsgLines, ParameterLines) {
  const double r = 1.2, edge = std::acos(1 / r), corner = std::asin(1 / r);
  const auto length = [](const Csg& solid, const ParameterNet& net) {
    return length_of(csg_parameter_lines(solid, net, {false, glm::normalize(Vec3(-0.4, 0.7, -0.5))}), Kind::parameter);
  };
  const double chords = 6 * 2 * 2 * std::sqrt(r * r - 1), equator = r * (kTwoPi - 8 * edge);
  // At u = 0, 120 and 240 degrees.
  const double slanted = std::acos(1 / (r * std::sqrt(0.75))), meridians = 2 * r * (3 * corner - edge - 2 * slanted);
  const ParameterNet net{{3, {}}, {3, {}}};
  EXPECT_NEAR(length(Csg(Operation::intersect, {cube(), ball_at({0, 0, 0}, r)}), net), chords + equator + meridians,
              1e-9);
  // United all that was cut away: edges of the cube, which are lines of two faces.
  const double all = 6 * 6 * 2 + kTwoPi * r + 3 * kPi * r;
  EXPECT_NEAR(length(Csg(Operation::unite, {cube(), ball_at({0, 0, 0}, r)}), net), all - chords - equator - meridians,
              1e-9);
  // The ball as one of several.
  const std::array<Vec3, 1> center{Vec3(0)};
  const std::array<double, 1> radius{r};
  EXPECT_NEAR(length(Csg(Operation::intersect, {std::make_shared<Balls>(center, radius), cube()}), net),
              chords + equator + meridians, 1e-9);
  // Tubes have their own: a ring about a circle, and a rod, which are bodies inside.
  const ShapePtr ring = std::make_shared<Tube>(std::make_shared<Circle>(Frame(), 2.0), RadiusLaw(0.5), Caps::round),
                 rod = std::make_shared<Tube>(std::make_shared<Segment>(Vec3(-3, 0, 0), Vec3(3, 0, 0)), RadiusLaw(0.5),
                                              Caps::round);
  const ShapePtr half = std::make_shared<BodyShape>(
      std::make_shared<Body>(box(frame_from({-4, 0, -4}, {0, 0, 1}, {1, 0, 0}), {8, 8, 8})));
  const auto of_tube = [&](const ShapePtr& tube, const ParameterNet& asked) {
    const CsgLines found = csg_parameter_lines(Csg(Operation::intersect, {tube, half}), asked, {false, {0, 0, -1}});
    double sum = 0;
    for (const CsgLine& line : found.lines) {
      const Interval t = line.curve->domain();
      if (line.supporting_surfaces.empty()) sum += arc_length(*line.curve, t.lo, t.hi).value;
    }
    return sum;
  };
  EXPECT_NEAR(of_tube(ring, {{0, {0.3, 2, 4}}, {}}), 2 * kTwoPi * 0.5, 1e-9);
  EXPECT_NEAR(of_tube(ring, {{}, {6, {}}}), 6 * kPi * 2, 1e-9);
  EXPECT_NEAR(of_tube(rod, {{5, {}}, {}}), 5 * kPi * 0.5, 1e-9);
  // Of the two at opposite angles one is on either side.
  EXPECT_NEAR(of_tube(rod, {{}, {0, {0.3, 0.3 + kPi}}}), 6, 1e-9);
  // Half-spaces and formulas have none, and it is said.
  const Csg open(Operation::intersect, {cube(), std::make_shared<HalfSpaceShape>(Vec3(0, 0, 0.3), Vec3(0, 0, 1))});
  EXPECT_EQ(csg_parameter_lines(open, net, {}).left_out.count("parameter lines of half-spaces"), 1u);
}

// What is not known is named.
TEST(CsgLines, LeftOut) {
  const auto bend =
      std::make_shared<FormulaCurve>(point_formulas({"0.5*cos(t)", "0.5*sin(t)", "0.3*t"}, {"t"}), Interval{0, 1.5});
  const Csg part(Operation::subtract,
                 {ball_at({0, 0, 0}, 1.2), std::make_shared<Tube>(bend, RadiusLaw(0.9), Caps::round)});
  const CsgLines found = csg_lines(part, {});
  EXPECT_EQ(found.left_out, std::set<std::string>{"some edges along which a tube goes through itself"});
}

// The hollow of a ball in a cube, filled to a little below the ball's lowest place: the wedges that are left are thin.
TEST(CsgLines, EdgesOfThinWedges) {
  const double edges_of_cube = 24, radius = 0.5;
  for (const double depth : {0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto hollow =
        std::make_shared<Csg>(Operation::subtract, std::vector<ShapePtr>{cube(), ball_at({0, 0, 0}, radius)});
    const ShapePtr fill = shape_of(box(frame_from({-0.9, -0.9, -0.9}, {0, 0, 1}, {1, 0, 0}), {1.8, 1.8, 0.4 + depth}));
    const Csg solid(Operation::unite, {hollow, fill});
    EXPECT_NEAR(length_of(solid, Kind::sharp), edges_of_cube + kTwoPi * std::sqrt(depth * (2 * radius - depth)), 1e-9)
        << depth;
    // The lens that both have in common, whose edges are as thin.
    const Csg lens(Operation::intersect, {fill, ball_at({0, 0, 0}, radius)});
    EXPECT_NEAR(length_of(lens, Kind::sharp), kTwoPi * std::sqrt(depth * (2 * radius - depth)), 1e-9) << depth;
  }
}

// Where leaves end flush each has the edge: it is one line.
TEST(CsgLines, LeavesThatEndFlush) {
  const double edges_of_cube = 24;
  // A bore from face to face.
  const Csg bored(Operation::subtract, {cube(), pipe({0, -1, 0}, {0, 1, 0}, 0.6, 2)});
  EXPECT_NEAR(length_of(bored, Kind::sharp), edges_of_cube + 2 * kTwoPi * 0.6, 1e-9);
  // Cubes beside one another, shifted by half an edge: two sides of 2 x 2 are one of 2 x 3, another lies within.
  const Csg pair(Operation::unite, {cube(), shape_of(box(frame_from({0, -1, -1}, {0, 0, 1}, {1, 0, 0}), {2, 2, 2}))});
  EXPECT_NEAR(length_of(pair, Kind::sharp), 4 * (3 + 2 + 2), 1e-9);
  EXPECT_NEAR(length_of_section(pair, {0, 0, 0.1}, {0, 0, 1}), 2 * (3 + 2), 1e-9);
  // Two rods of one radius that overlap, seen from the side.
  const Csg rod(Operation::unite, {pipe({0, 0, 0}, {0, 0, 1}, 0.5, 2), pipe({0, 0, 1}, {0, 0, 1}, 0.5, 2)});
  EXPECT_NEAR(length_of(csg_lines(rod, {false, {1, 0, 0}}), Kind::silhouette), 2 * 3, 1e-9);
  // Crossed slabs whose inner corners are rounded off by rods: a rectangle with round corners, and a hole.
  const ShapePtr a = shape_of(box(frame_from({-3, -1.2, 0}, {0, 0, 1}, {1, 0, 0}), {6, 2.4, 2})),
                 b = shape_of(box(frame_from({-2.2, -2, 0}, {0, 0, 1}, {1, 0, 0}), {4.4, 4, 2}));
  std::vector<ShapePtr> parts{a, b};
  for (const double x : {-2.2, 2.2})
    for (const double y : {-1.2, 1.2}) parts.push_back(pipe({x, y, 0}, {0, 0, 1}, 0.8, 2));
  const Csg plate(Operation::subtract,
                  {std::make_shared<Csg>(Operation::unite, parts), pipe({0, 0, -0.1}, {0, 0, 1}, 0.8, 2.2)});
  const CsgLines lines = lines_of(plate);
  EXPECT_NEAR(length_of(lines, Kind::sharp), 2 * (2 * (4.4 + 2.4) + kTwoPi * 0.8) + 2 * kTwoPi * 0.8, 1e-9);
  EXPECT_NEAR(length_of(lines, Kind::smooth), 8 * 2, 1e-9);
  // From another side the edges are the same, and the outlines its own.
  const ViewOf side{false, glm::normalize(Vec3(0.2, 0.1, -0.9))};
  const CsgLines anew = csg_lines(plate, side), taken = csg_lines(plate, side, &lines);
  for (const Kind kind : {Kind::sharp, Kind::smooth, Kind::silhouette})
    EXPECT_EQ(length_of(taken, kind), length_of(anew, kind));
  EXPECT_EQ(taken.one_face, anew.one_face);
}

}  // namespace
}  // namespace lekalo::geometry::csg_contours_test
