// The lines in which objects meet: the same ball given in several ways, placed by its object, against a box; the same
// solids as bodies and by formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/transformed.h"
#include "render/drawing/random_views.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "render/lines/strokes.h"
#include "support/worst.h"

namespace lekalo::render::intersections_test {
namespace {

using namespace geometry;

BodyPtr ball_at(const Vec3& center, double radius) {
  Frame frame;
  frame.origin = center;
  return std::make_shared<Body>(ball(frame, radius));
}

ShapePtr implicit(const char* formula, const ImplicitRegion& region, bool closed = true) {
  auto parsed = std::get<Expression>(Expression::parse(formula));
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  if (parsed.bind(variables)) ADD_FAILURE() << formula;
  return std::make_shared<ImplicitSurface>(std::move(parsed), 0, region, closed);
}

std::any any_of(const Entity& entity) {
  return std::visit([](const auto& shape) { return std::any(shape); }, entity);
}

void meet(SmallScene& scene, const Entity& shape, const Affine& transform, const Entity& with) {
  show(scene, shape, {"intersection"});
  Object& object = scene.model.objects.back();
  object.transform = transform;
  Look look = *object.look;
  look.lines->with = {any_of(with)};
  object.look = std::make_shared<const Look>(look);
}

struct Found {
  double length = 0;
  std::vector<Vec3> points;
  std::vector<std::string> left_out;
  int incomplete = 0;
  std::vector<Vec3> ends;  // but those where a line closes
};
Found intersections(const Entity& shape, const Affine& transform, const Entity& with,
                    const std::optional<Affine>& placed) {
  SmallScene scene;
  meet(scene, shape, transform, with);
  if (placed) {
    show(scene, with, {});
    scene.model.objects.back().transform = *placed;
  }
  Views views(3);
  views.look(scene, false);
  const LineWork work = drawing_work(*scene.world());
  Found found;
  found.left_out = work.left_out, found.incomplete = work.incomplete;
  for (const Stroke& stroke : work.strokes) {
    if (!stroke.drawn) continue;
    EXPECT_NE(stroke.met, stroke.object);
    const CurvePtr curve = transformed(stroke.curve, stroke.to_world);
    const Interval t = curve->domain();
    found.length += arc_length(*curve, t.lo, t.hi).value;
    const Vec3 begin = curve->point(t.lo), end = curve->point(t.hi);
    if (glm::length(begin - end) > 1e-9) found.ends.push_back(begin), found.ends.push_back(end);
    for (const double share : {0.1, 0.4, 0.7}) found.points.push_back(curve->point(t.lo + share * t.width()));
  }
  return found;
}

TEST(Intersections, OneBallInManyWays) {
  Frame frame = frame_from({0, 0, 0}, {1, 2, 3}, {0, 1, 0});
  const BodyPtr block = std::make_shared<Body>(box(frame, {2, 2, 2}));
  const Affine turned = Affine::rotation(0.7, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0}),
               placed = Affine::translation({0.8, 0.9, 0.7});
  const BodyPtr exact = ball_at({0, 0, 0}, 1.3);
  const Found expected = intersections(block, turned, exact, placed);
  ASSERT_GT(expected.length, 2);
  for (const Vec3& point : expected.points) {
    EXPECT_NEAR(glm::length(point - Vec3(0.8, 0.9, 0.7)), 1.3, 1e-9);
    const Vec3 in_box = turned.inverse().point(point) - frame.origin;
    double outside = -kInfinity;
    for (const Vec3& axis : {frame.x, frame.y, frame.z})
      outside = tests::worse(outside, std::abs(glm::dot(in_box, axis) - 1) - 1);
    EXPECT_NEAR(outside, 0, 1e-9);
  }
  const Entity others[] = {
      implicit("x^2 + y^2 + z^2 - 1.69", {{Vec3(-1.5), Vec3(1.5)}}),
      ShapePtr(std::make_shared<Balls>(std::vector<Vec3>{{0, 0, 0}}, std::vector<double>{1.3})),
      ShapePtr(std::make_shared<Csg>(Csg::Operation::unite,
                                     std::vector<ShapePtr>{std::make_shared<BodyShape>(exact),
                                                           std::make_shared<BodyShape>(ball_at({0, 0, 0.1}, 0.2))})),
      SurfaceSet{sphere({0, 0, 0}, 1.3), sphere({0, 0, 20}, 1)}};
  for (const Entity& other : others) {
    const Found found = intersections(block, turned, other, placed),
                turned_round = intersections(other, placed, block, turned);
    EXPECT_NEAR(found.length, expected.length, 1e-6);
    EXPECT_NEAR(turned_round.length, expected.length, 1e-6);
    EXPECT_TRUE(found.left_out.empty());
  }
}

TEST(Intersections, PlanesAndHalfSpacesCut) {
  const Entity cutting[] = {SurfacePtr(plane({0, 0, 0.5}, {0, 0, 1})),
                            ShapePtr(std::make_shared<HalfSpaceShape>(Vec3(0, 0, 0.5), Vec3(0, 0, 1)))};
  const auto segment = std::make_shared<Segment>(Vec3(0, 0, -3), Vec3(0, 0, 3));
  const Entity cut[] = {ball_at({0, 0, 0}, 1.3),
                        ShapePtr(std::make_shared<Tube>(segment, RadiusLaw(1.2), Caps::round))};
  for (const Entity& knife : cutting)
    for (const Entity& shape : cut)
      // One that no object shows stands as it is written, whatever the object's own transform.
      EXPECT_NEAR(intersections(shape, Affine::translation({5, 6, 0}), knife, std::nullopt).length, kTwoPi * 1.2, 1e-6);
}

TEST(Intersections, PlaneFacesCutTubes) {
  const auto segment = std::make_shared<Segment>(Vec3(0, 0, -3), Vec3(0, 0, 3));
  const ShapePtr tube = std::make_shared<Tube>(segment, RadiusLaw(0.5), Caps::round);
  Frame frame;
  frame.origin = {0, -2, -1};
  // From below and above, each half a circle; the side x = 0 along two straight lines.
  const Found found = intersections(std::make_shared<Body>(box(frame, {4, 4, 2})), Affine(), tube, Affine());
  EXPECT_NEAR(found.length, kTwoPi * 0.5 + 2 * 2, 1e-6);
  EXPECT_TRUE(found.left_out.empty());
}

// A bent tube and a ball, in several ways; two tubes at a right angle.
TEST(Intersections, Tubes) {
  const auto bow =
      std::make_shared<FormulaCurve>(point_formulas({"2*cos(t)", "2*sin(t)", "0.3*t"}, {"t"}), Interval{0, 4});
  const ShapePtr tube = std::make_shared<Tube>(bow, RadiusLaw(0.4), Caps::flat);
  const Affine turned = Affine::rotation(0.7, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0}),
               placed = turned * Affine::translation({2.3, 0.5, 0.2});
  const Found expected = intersections(tube, turned, ball_at({0, 0, 0}, 0.9), placed);
  ASSERT_GT(expected.length, 2);
  for (const Vec3& point : expected.points) EXPECT_NEAR(glm::length(placed.inverse().point(point)), 0.9, 1e-9);
  const Entity others[] = {
      ball_at({0, 0, 0}, 0.9),
      SurfaceSet{sphere({0, 0, 0}, 0.9), sphere({0, 0, 20}, 1)},
      implicit("x^2 + y^2 + z^2 - 0.81", {{Vec3(-1.5), Vec3(1.5)}}),
      ShapePtr(std::make_shared<Balls>(std::vector<Vec3>{{0, 0, 0}}, std::vector<double>{0.9})),
      ShapePtr(std::make_shared<Csg>(Csg::Operation::unite,
                                     std::vector<ShapePtr>{std::make_shared<BodyShape>(ball_at({0, 0, 0}, 0.9)),
                                                           std::make_shared<BodyShape>(ball_at({0, 0, 0.1}, 0.2))})),
      ShapePtr(std::make_shared<Tube>(std::make_shared<Segment>(Vec3(0, 0, -1e-7), Vec3(0, 0, 1e-7)), RadiusLaw(0.9),
                                      Caps::round))};
  for (const Entity& other : others) {
    const Found found = intersections(tube, turned, other, placed),
                turned_round = intersections(other, placed, tube, turned);
    EXPECT_NEAR(found.length, expected.length, 1e-5);
    EXPECT_NEAR(turned_round.length, expected.length, 1e-5);
    EXPECT_TRUE(found.left_out.empty());
  }
}

// What a line runs along does not count as what it goes through, whichever of the two it is a line of.
TEST(Intersections, LinesThatRunAlongBoth) {
  const auto bow =
      std::make_shared<FormulaCurve>(point_formulas({"2*cos(t)", "2*sin(t)", "0.3*t"}, {"t"}), Interval{0, 4});
  const ShapePtr tube = std::make_shared<Tube>(bow, RadiusLaw(0.4), Caps::flat),
                 balls = std::make_shared<Balls>(std::vector<Vec3>{{2, 0.5, 0.2}}, std::vector<double>{0.9});
  for (const bool swapped : {false, true}) {
    SmallScene scene;
    meet(scene, swapped ? balls : tube, Affine(), swapped ? tube : balls);
    show(scene, swapped ? tube : balls, {});
    Views views(3);
    views.look(scene, false);
    EXPECT_LT(visible_lines(*scene.world(), drawing_work(*scene.world())).statistics.rays, 100);
  }
}

// Solids by formulas, cut off by their regions, and balls, against the bodies that they are.
TEST(Intersections, PartsMeetParts) {
  const auto both = [](const char* what, std::initializer_list<Entity> ones, std::initializer_list<Entity> others,
                       const Affine& map_of_one, const Affine& map_of_other) {
    const Found expected = intersections(*ones.begin(), map_of_one, *others.begin(), map_of_other);
    ASSERT_GT(expected.length, 1) << what;
    for (const Entity& one : ones)
      for (const Entity& other : others) {
        for (const bool round : {false, true}) {
          const Found found = round ? intersections(other, map_of_other, one, map_of_one)
                                    : intersections(one, map_of_one, other, map_of_other);
          EXPECT_NEAR(found.length, expected.length, 1e-6) << what;
          EXPECT_TRUE(found.left_out.empty()) << what;
          EXPECT_EQ(found.incomplete, 0) << what;
        }
      }
  };
  const std::vector<Vec3> center{{0, 0, 0}};
  const std::vector<double> radius{1.3};
  const std::initializer_list<Entity> balls = {
      ball_at({0, 0, 0}, 1.3), implicit("x^2 + y^2 + z^2 - 1.69", {{Vec3(-1.5), Vec3(1.5)}}),
      implicit("x^2 + y^2 + z^2 - 1.69", ImplicitRegion::ball({0.1, 0, 0}, 1.5)),
      ShapePtr(std::make_shared<Balls>(center, radius))};
  const std::initializer_list<Entity> posts = {
      std::make_shared<Body>(cylinder_body(frame_from({0, 0, -1}, {0, 0, 1}, {1, 0, 0}), 0.6, 2)),
      implicit("x^2 + y^2 - 0.36", {{{-0.7, -0.7, -1}, {0.7, 0.7, 1}}})};
  // Half a ball: its region is the ball, its formula the plane.
  const std::initializer_list<Entity> halves = {
      ShapePtr(std::make_shared<Csg>(
          Csg::Operation::intersect,
          std::vector<ShapePtr>{std::make_shared<BodyShape>(ball_at({0, 0, 0}, 1.1)),
                                std::make_shared<HalfSpaceShape>(Vec3(0, 0, 0), Vec3(0, 0, -1))})),
      implicit("-z", ImplicitRegion::ball({0, 0, 0}, 1.1)),
      implicit("x^2 + y^2 + z^2 - 1.21", {{{-1.2, -1.2, 0}, {1.2, 1.2, 1.2}}})};
  const Affine turned = Affine::rotation(0.7, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0});
  Affine longer = turned;
  longer.linear *= 1.4;
  longer.linear[1] *= 0.6;
  both("balls and balls", balls, balls, Affine(), Affine::translation({0.9, 0.5, -0.3}));
  both("balls and posts", balls, posts, longer, Affine::translation({0.9, 0.5, -0.3}));
  both("posts and posts", posts, posts, turned, longer);
  both("half balls and posts", halves, posts, Affine::translation({0.4, 0.5, -0.3}), longer);
  both("half balls and balls", halves, balls, turned, Affine::translation({0.4, 0.5, -0.6}));
}

// Sheets that end at their regions against the surfaces by the same formulas.
TEST(Intersections, OpenSheetsMeet) {
  const SurfacePtr saddle = std::make_shared<FormulaSurface>(point_formulas({"u", "v", "u*v"}, {"u", "v"}),
                                                             Rectangle{{-1, 1.2}, {-1.1, 1}}, FormulaSurface::Closed{});
  const Entity same = implicit("x*y - z", {{{-1, -1.1, -2}, {1.2, 1, 2}}}, false);
  const Entity others[] = {
      implicit("x^3 + y^2 + z^2 - 0.7 + 0.3*sin(3*x*z)", ImplicitRegion::ball({0.1, 0, 0}, 1.4), false),
      implicit("cos(4*x) + cos(4*y) + cos(4*z)", {{{-1.1, -0.8, -0.9}, {0.9, 1.3, 0.4}}}, false)};
  const Affine turned = Affine::rotation(0.4, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0});
  for (const Entity& other : others) {
    const Found expected = intersections(saddle, Affine(), other, turned),
                found = intersections(same, Affine(), other, turned),
                turned_round = intersections(other, turned, same, Affine());
    ASSERT_GT(expected.length, 2);
    EXPECT_NEAR(found.length, expected.length, 1e-6);
    EXPECT_NEAR(turned_round.length, expected.length, 1e-6);
    EXPECT_EQ(found.incomplete, 0);
  }
}

// Balls that overlap, each with the spheres of the other where neither is covered: by closed form, three pairs.
TEST(Intersections, BallsMeetBalls) {
  const std::vector<Vec3> row{{0, 0, 0}, {1.2, 0, 0}, {2.4, 0, 0}}, single{{1.2, 0, 0.9}};
  const std::vector<double> one{0.9}, less{0.5};
  const Found found = intersections(ShapePtr(std::make_shared<Balls>(row, one)), Affine(),
                                    ShapePtr(std::make_shared<Balls>(single, less)), Affine());
  // Only the middle ball meets it: |p - m| = 0.9, |p - s| = 0.5 at the distance 0.9 of both.
  const double height = (0.81 + 0.81 - 0.25) / 1.8, radius = std::sqrt(0.81 - height * height);
  // Covered by a neighbour where |p - (0, 0, 0)| < 0.9: where |x - 1.2| > 0.6.
  ASSERT_LT(radius, 0.6);
  EXPECT_NEAR(found.length, kTwoPi * radius, 1e-9);
  const Found wide = intersections(ShapePtr(std::make_shared<Balls>(row, one)), Affine(),
                                   ShapePtr(std::make_shared<Balls>(single, one)), Affine());
  // The circle about the middle ball, without what the neighbours cover; those meet the other ball in parts of circles.
  const double half = std::sqrt(0.81 - 0.2025), covered = 4 * std::acos(0.6 / half);
  const double apart = std::hypot(1.2, 0.9), side = std::sqrt(0.81 - apart * apart / 4);
  // Its points are at the distance 0.9 of both; outside of the middle ball where (p - middle) . x > 0.6.
  const Vec3 along = Vec3(1.2, 0, 0.9) / apart, up(-along.z, 0, along.x);
  const double x = apart / 2 * along.x, kept = 2 * std::acos((x - 0.6) / (side * std::abs(up.x)));
  EXPECT_NEAR(wide.length, half * (kTwoPi - covered) + 2 * side * (kTwoPi - kept), 1e-9);
}

// The sides of a block [0, 2]^3 in squares of two triangles each.
MeshPtr block_of_triangles(int squares) {
  auto mesh = std::make_shared<Mesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (int i = 0; i < squares; ++i)
        for (int k = 0; k < squares; ++k) {
          const auto corner = [&](int a, int b) {
            Vec3 p(0);
            p[axis] = upper ? 2 : 0;
            p[(axis + 1) % 3] = 2.0 * (i + a) / squares, p[(axis + 2) % 3] = 2.0 * (k + b) / squares;
            mesh->points.push_back(p);
            return static_cast<int32_t>(mesh->points.size() - 1);
          };
          const int32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          mesh->triangles.push_back({upper ? std::array{a, b, c} : std::array{a, c, b}});
          mesh->triangles.push_back({upper ? std::array{a, c, d} : std::array{a, d, c}});
        }
  set_flat_normals(*mesh);
  return mesh;
}

// A block as triangles, large and small ones, against the block as a body.
TEST(Intersections, Meshes) {
  const BodyPtr block = std::make_shared<Body>(box(Frame(), {2, 2, 2}));
  const auto bow = std::make_shared<FormulaCurve>(point_formulas({"cos(t)", "sin(t)", "0.3*t"}, {"t"}), Interval{0, 4});
  const std::vector<Vec3> centers{{0, 0, 0}, {0.8, 0.3, 0}};
  const std::vector<double> radii{0.9, 0.7};
  NurbsSurfaceForm patch;
  patch.degree_u = patch.degree_v = 3;
  patch.knots_u = patch.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) patch.points.push_back(Vec4(i - 1.5, k - 1.5, 0.7 * std::sin(3.0 * i + 2.0 * k), 1));
  const Entity others[] = {ball_at({0, 0, 0}, 1.3),
                           SurfacePtr(sphere({0, 0, 0}, 0.8)),
                           std::make_shared<Body>(torus_body(Frame(), 1, 0.4)),
                           SurfacePtr(std::make_shared<NurbsSurface>(patch)),
                           ShapePtr(std::make_shared<Tube>(bow, RadiusLaw(0.4), Caps::flat)),
                           ShapePtr(std::make_shared<Balls>(centers, radii)),
                           implicit("x^4 + y^4 + z^4 - 1", {{Vec3(-1.1), Vec3(1.1, 1.1, 0.6)}}),
                           implicit("max(abs(x), abs(y)) - 0.9", {{Vec3(-1), Vec3(1)}})};
  const Affine turned = Affine::rotation(0.7, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0}),
               placed = Affine::translation({1.9, 1.1, 0.6});
  for (const Entity& other : others) {
    const Found expected = intersections(block, turned, other, placed);
    ASSERT_GT(expected.length, 1);
    for (const int squares : {1, 4}) {
      const Found found = intersections(block_of_triangles(squares), turned, other, placed);
      EXPECT_NEAR(found.length, expected.length, 1e-5);
      EXPECT_TRUE(found.left_out.empty());
      EXPECT_EQ(found.incomplete, 0);
      // Whatever ends goes on there, but at the border of the patch.
      const auto is_border = [&](const Vec3& end) {
        return std::any_of(expected.ends.begin(), expected.ends.end(),
                           [&](const Vec3& one) { return glm::length(end - one) < 1e-9; });
      };
      for (const Vec3& end : found.ends) {
        if (is_border(end)) continue;
        EXPECT_GE(std::count_if(found.ends.begin(), found.ends.end(),
                                [&](const Vec3& one) { return glm::length(end - one) < 1e-9; }),
                  2);
      }
    }
    EXPECT_NEAR(intersections(other, placed, block_of_triangles(2), turned).length, expected.length, 1e-5);
  }
}

TEST(Intersections, FormulasWithKinks) {
  const BodyPtr block = std::make_shared<Body>(box(frame_from({-0.8, -0.8, -0.8}, {0, 0, 1}, {1, 0, 0}), Vec3(1.6)));
  const Entity cube = implicit("max(abs(x), abs(y), abs(z)) - 0.8", {{Vec3(-1), Vec3(1)}});
  const Entity others[] = {ball_at({0, 0, 0}, 1), implicit("x^2 + y^2 + z^2 - 1", {{Vec3(-1.1), Vec3(1.1)}}),
                           implicit("abs(x) + abs(y) + abs(z) - 1.3", {{Vec3(-1.5), Vec3(1.5)}})};
  const Affine turned = Affine::rotation(0.7, glm::normalize(Vec3(1, -1, 2)), {0.1, 0, 0}),
               placed = Affine::translation({0.5, 0.4, 0.3});
  for (const Entity& other : others) {
    const Found expected = intersections(block, turned, other, placed),
                found = intersections(cube, turned, other, placed),
                turned_round = intersections(other, placed, cube, turned);
    ASSERT_GT(expected.length, 1);
    EXPECT_NEAR(found.length, expected.length, 1e-6);
    EXPECT_NEAR(turned_round.length, expected.length, 1e-6);
    EXPECT_EQ(found.incomplete, 0);
  }
}

}  // namespace
}  // namespace lekalo::render::intersections_test
