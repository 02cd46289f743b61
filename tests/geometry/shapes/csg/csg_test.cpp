// CSG against an oracle that knows only which points lie in a solid: along a line the solid changes where the answers
// at the middles of all stretches between formula roots of its leaves do.
#include "geometry/shapes/csg/csg.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/measures/shape_measures.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/torus.h"
#include "support/solid_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::csg_test {
namespace {

using Real = long double;
using Operation = Csg::Operation;

ShapePtr solid(Body body) { return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body))); }
ShapePtr solid_box(const Vec3& lo, const Vec3& hi) { return solid(box(Frame{lo}, hi - lo)); }
ShapePtr solid_ball(const Vec3& center, double radius) { return solid(ball(Frame{center}, radius)); }
ShapePtr combined(Operation operation, std::vector<ShapePtr> operands) {
  return std::make_shared<Csg>(operation, std::move(operands));
}
std::vector<SurfaceHit> hits_of(const Shape& shape, const Line& line, const Interval& t = Interval::entire()) {
  std::vector<SurfaceHit> hits;
  shape.all_hits(line, t, hits);
  return hits;
}

// A tree of balls, boxes and half-spaces as the oracle sees it, and as the product does.
using Plan = oracle::Solid;
ShapePtr shape_of(const Plan& plan) {
  switch (plan.kind) {
    case Plan::Kind::ball:
      return solid_ball(plan.a, plan.radius);
    case Plan::Kind::box:
      return solid_box(plan.a, plan.b);
    case Plan::Kind::half_space:
      return std::make_shared<HalfSpaceShape>(plan.a, plan.b);
    default:
      break;
  }
  std::vector<ShapePtr> shapes;
  for (const Plan& one : plan.operands) shapes.push_back(shape_of(one));
  return combined(plan.kind == Plan::Kind::unite       ? Operation::unite
                  : plan.kind == Plan::Kind::intersect ? Operation::intersect
                                                       : Operation::subtract,
                  shapes);
}

class RandomTrees : public testing::Test {
 protected:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{0, 1};
  std::normal_distribution<double> normal_;

  Vec3 any_point(double reach) {
    const double x = reach * (2 * unit_(random_) - 1), y = reach * (2 * unit_(random_) - 1);
    return {x, y, reach * (2 * unit_(random_) - 1)};
  }
  Vec3 any_direction() {
    const double x = normal_(random_), y = normal_(random_);
    return glm::normalize(Vec3(x, y, normal_(random_)));
  }
  Plan any_leaf() {
    const int kind = static_cast<int>(random_() % 5);
    if (kind < 2) return {Plan::Kind::ball, any_point(1), Vec3(0), 0.3 + unit_(random_), {}};
    if (kind < 4) {
      const Vec3 lo = any_point(1);
      return {Plan::Kind::box, lo, lo + Vec3(0.3) + 0.7 * (any_point(1) + Vec3(1)), 0, {}};
    }
    return {Plan::Kind::half_space, any_point(0.5), any_direction(), 0, {}};
  }
  Plan any_tree(int depth) {
    if (depth == 0) return any_leaf();
    Plan plan{Plan::Kind::unite, Vec3(0), Vec3(0), 0, {}};
    plan.kind = static_cast<Plan::Kind>(3 + random_() % 3);
    const int count = 2 + static_cast<int>(random_() % 2);
    for (int k = 0; k < count; ++k) plan.operands.push_back(any_tree(depth - 1));
    return plan;
  }
};

TEST_F(RandomTrees, CrossWhereTheOracleDoes) {
  const int trees = tests::tier_count(2000), lines = 200;
  int wrong = 0, odd = 0, compared = 0;
  double worst = 0;
  for (int k = 0; k < trees; ++k) {
    const Plan plan = any_tree(1 + k % 3);
    ShapePtr shape;
    try {
      shape = shape_of(plan);
    } catch (const std::invalid_argument&) {
      continue;  // nothing in common
    }
    for (int i = 0; i < lines; ++i) {
      const double away = i % 4 == 0 ? 1000 : i % 4 == 1 ? 0.5 : 4;
      Line line{away * any_direction(), {}};
      line.direction = (i % 3 == 0 ? 0.25 : 1) * (any_point(1) - line.origin);
      std::vector<Real> roots, expected;
      plan.roots(line, roots);
      std::sort(roots.begin(), roots.end());
      bool close = false;  // the tangency band, and shared places that the tolerance decides
      for (size_t r = 1; r < roots.size(); ++r)
        close = close || (roots[r] - roots[r - 1]) * glm::length(line.direction) < 1e-8;
      if (close) continue;
      const auto holds = [&](Real t) {
        return plan.holds(line.origin.x + t * line.direction.x, line.origin.y + t * line.direction.y,
                          line.origin.z + t * line.direction.z);
      };
      for (size_t r = 0; r < roots.size(); ++r) {
        const Real before = r == 0 ? roots[r] - 1 : (roots[r - 1] + roots[r]) / 2;
        const Real after = r + 1 == roots.size() ? roots[r] + 1 : (roots[r] + roots[r + 1]) / 2;
        if (holds(before) != holds(after)) expected.push_back(roots[r]);
      }
      const std::vector<SurfaceHit> found = hits_of(*shape, line);
      ++compared;
      bool inside = shape->begins_inside(line);
      EXPECT_EQ(inside, roots.empty() ? holds(0) : holds(roots.front() - 1));
      if (found.size() != expected.size()) {
        ++wrong;
        continue;
      }
      for (size_t h = 0; h < found.size(); ++h) {
        const ShapePoint at = shape->point(found[h], line.at(found[h].t));
        // Along the normal: a line that grazes moves its hits by more. The coordinates of those on half-spaces may
        // exceed 1000, and their rounding with them.
        const double beyond = std::max(1.0, glm::length(at.position) / 1000);
        worst = std::max(
            worst,
            std::abs(static_cast<double>(found[h].t - expected[h]) * glm::dot(at.normal, line.direction)) / beyond);
        inside = !inside;
        if ((glm::dot(at.normal, line.direction) < 0) != inside) ++odd;
      }
      // A part of the line has the hits in that part.
      if (found.size() > 1) {
        const double middle = 0.5 * (found[0].t + found[1].t);
        EXPECT_EQ(hits_of(*shape, line, {middle, kInfinity}).size(), found.size() - 1);
        EXPECT_EQ(hits_of(*shape, line, {-kInfinity, middle}).size(), 1u);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(odd, 0) << "normals that do not look outward";
  EXPECT_LT(worst, 1e-12);  // coordinates up to 1000
  EXPECT_GT(compared, trees * lines / 4);
  tests::report_figure("lines", compared);
  tests::report_figure("wrong_counts", wrong);
  tests::report_figure("largest_error_of_t", worst);
}

const Line kAlongX{{-5, 0.31, 0.37}, {1, 0, 0}};

TEST(Csg, SharedFaces) {
  const ShapePtr left = solid_box({0, 0, 0}, {1, 1, 1}), right = solid_box({1, 0, 0}, {2, 1, 1});
  // Boxes that touch unite without a wall.
  auto hits = hits_of(*combined(Operation::unite, {left, right}), kAlongX);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].t, 5, 1e-14);
  EXPECT_NEAR(hits[1].t, 7, 1e-14);
  // What they have in common is a face without a volume.
  EXPECT_EQ(hits_of(*combined(Operation::intersect, {left, right}), kAlongX).size(), 0u);
  // Taking away what only touches changes nothing; the first one's face is kept.
  hits = hits_of(*combined(Operation::subtract, {left, right}), kAlongX);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[1].face % 2, 0);
  // A flush cut leaves no skin.
  const ShapePtr end = solid_box({0.5, 0, 0}, {1, 1, 1});
  hits = hits_of(*combined(Operation::subtract, {left, end}), kAlongX);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[1].t, 5.5, 1e-14);
  // Twice the same: one face each.
  hits = hits_of(*combined(Operation::unite, {left, solid_box({0, 0, 0}, {1, 1, 1})}), kAlongX);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].face % 2, 0);
  EXPECT_EQ(hits_of(*combined(Operation::subtract, {left, solid_box({0, 0, 0}, {1, 1, 1})}), kAlongX).size(), 0u);
}

TEST(Csg, SharedFacesMetAtAnyAngle) {
  const ShapePtr cut =
      combined(Operation::subtract, {solid_box({0, 0, 0}, {1, 1, 1}), solid_box({0.25, 0.25, 0.5}, {0.75, 0.75, 1})});
  const ShapePtr whole = combined(Operation::unite, {cut, solid_box({0.25, 0.25, 0.5}, {0.75, 0.75, 1})});
  const ShapePtr plain = solid_box({0, 0, 0}, {1, 1, 1});
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int wrong = 0;
  for (int k = 0; k < tests::tier_count(1000000); ++k) {
    Vec3 d(normal(random), normal(random), normal(random) * (k % 2 ? 1e-4 : 1));
    if (k % 3 == 0) d = Vec3(d.z, d.x, d.y);
    const Vec3 through(0.5 + 0.3 * normal(random), 0.5 + 0.3 * normal(random), 0.5 + 0.3 * normal(random));
    const Line line{through - 3.0 * d, d};
    wrong += hits_of(*whole, line).size() != hits_of(*plain, line).size();
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Csg, OpenOperandsAndEmptyResultsAreErrors) {
  EXPECT_THROW(combined(Operation::intersect, {solid_ball({0, 0, 0}, 1), solid_ball({5, 0, 0}, 1)}),
               std::invalid_argument);
  EXPECT_THROW(combined(Operation::unite, {}), std::invalid_argument);
}

// Two and three cylinders of radius 1 at right angles: volumes 16/3 and 8 (2 - sqrt 2), areas 16 and 24 (2 - sqrt 2).
TEST(Csg, MeasuresOfCrossedCylinders) {
  const auto cylinder_along = [](const Vec3& axis) { return solid(frustum(frame_about(-2.0 * axis, axis), 1, 1, 4)); };
  const ShapePtr x = cylinder_along({1, 0, 0}), y = cylinder_along({0, 1, 0}), z = cylinder_along({0, 0, 1});
  const ShapeMeasures two = measure(*combined(Operation::intersect, {x, y}));
  EXPECT_NEAR(two.volume.value, 16.0 / 3, two.volume.error);
  EXPECT_NEAR(two.area.value, 16, two.area.error);
  EXPECT_LT(glm::length(two.centroid), two.centroid_error);
  EXPECT_LT(two.volume.error, 1e-2);
  EXPECT_LT(two.area.error, 0.1);
  const ShapeMeasures three = measure(*combined(Operation::intersect, {x, y, z}));
  EXPECT_NEAR(three.volume.value, 8 * (2 - std::sqrt(2.0)), three.volume.error);
  EXPECT_NEAR(three.area.value, 24 * (2 - std::sqrt(2.0)), three.area.error);
  // Off the origin, and a ball taken away: the centroid moves.
  const ShapeMeasures rest =
      measure(*combined(Operation::subtract, {solid_box({10, 0, 0}, {12, 2, 2}), solid_ball({12, 1, 1}, 0.5)}));
  const double half_ball = kTwoPi / 3 * 0.125, volume = 8 - half_ball;
  EXPECT_NEAR(rest.volume.value, volume, rest.volume.error);
  EXPECT_NEAR(rest.centroid.x, (8 * 11 - half_ball * (12 - 3.0 / 8 * 0.5)) / volume, rest.centroid_error);
  EXPECT_THROW(measure(HalfSpaceShape({0, 0, 0}, {0, 0, 1})), std::invalid_argument);
}

// Closed forms against the faces' own hits: what a leaf answers must be what its body's surfaces say.
TEST(Csg, ClosedFormsOfConvexBodies) {
  const Frame tilted = frame_from({0.3, -0.2, 0.4}, {1, 2, 3}, {1, 0, 0});
  Affine shear;
  shear.linear = Mat3(Vec3(1.2, 0.3, 0), Vec3(-0.4, 0.8, 0.1), Vec3(0.2, 0, -1.5));
  shear.offset = {0.5, 0, 1};
  const std::vector<Vec2> pentagon{{1, 0}, {0.3, 1}, {-0.8, 0.6}, {-0.8, -0.6}, {0.3, -1}};
  const std::vector<Body> plain{ball(tilted, 0.9),
                                frustum(tilted, 0.7, 0.7, 1.3),
                                frustum(tilted, 0.9, 0, 1.1),
                                frustum(tilted, 0, 0.8, 1.2),
                                frustum(tilted, 0.9, 0.4, 0.7),
                                box(tilted, {1, 0.5, 0.7}),
                                wedge(tilted, {1, 0.5, 0.7}, 0.3),
                                prism(tilted, pentagon, 0.8),
                                pyramid(tilted, pentagon, {0.2, 0.1, 1.2})};
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  int compared = 0, wrong = 0;
  double worst = 0, worst_point = 0, worst_normal = 0;
  for (size_t k = 0; k < 2 * plain.size(); ++k) {
    const bool moved = k >= plain.size();
    const Body& one = plain[k % plain.size()];
    const auto body = std::make_shared<Body>(moved ? transformed(one, shear) : one);
    ASSERT_TRUE(ConvexSolid::of(*body)) << "body " << k;
    const ShapePtr faces = std::make_shared<BodyShape>(body), leaf = combined(Operation::unite, {faces});
    const Vec3 middle = bounds(*body).center();
    for (int i = 0; i < tests::tier_count(100000); ++i) {
      const Vec3 from = (i % 4 == 0 ? 300.0 : 3.0) * any();
      Line line{middle + from, {}};
      line.direction = middle + 0.4 * any() - line.origin;
      if (i % 8 == 5) line = {tilted.point(0.4 * any()) - 3.0 * tilted.z, tilted.z};
      if (i % 8 == 6) line = {tilted.point(0.4 * any()) - 3.0 * tilted.x, tilted.x};
      const auto expected = hits_of(*faces, line), found = hits_of(*leaf, line);
      // Twice or not at all where a line grazes or meets an edge.
      if (expected.size() != found.size()) {
        const auto& both = expected.empty() ? found : expected;
        const double apart = both.back().t - both.front().t;
        if (apart * glm::length(line.direction) > 1e-6) ++wrong;
        continue;
      }
      for (size_t h = 0; h < found.size(); ++h) {
        const Vec3 near = line.at(found[h].t);
        const ShapePoint a = faces->point(expected[h], line.at(expected[h].t)), b = leaf->point(found[h], near);
        const double sine = std::abs(glm::dot(a.normal, glm::normalize(line.direction)));
        if (sine < 1e-3) continue;
        ++compared;
        if (expected[h].face != found[h].face) {
          ++wrong;
          continue;
        }
        const double size = 1 + glm::length(from);
        worst = tests::worse(worst, std::abs(found[h].t - expected[h].t) * glm::length(line.direction) * sine / size);
        worst_point = tests::worse(worst_point, glm::length(a.position - b.position) * sine / size);
        worst_normal = tests::worse(worst_normal, glm::length(a.normal - b.normal) * sine / size);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(worst_point, 1e-13);
  EXPECT_LT(worst_normal, 1e-12);
  // Bodies of other forms have none.
  EXPECT_FALSE(ConvexSolid::of(torus_body(tilted, 1, 0.3)));
  EXPECT_FALSE(ConvexSolid::of(prism(tilted, {{1, 0}, {0, 0.2}, {-1, 0}, {0, 2}}, 1)));
}

TEST(Csg, ClosedSurfacesEncloseSolids) {
  const auto torus = std::make_shared<TorusSurface>(Frame{}, 1, 0.4);
  const ShapePtr exact = solid(torus_body(Frame{}, 1, 0.4));
  for (const bool reversed : {false, true}) {
    auto surface = std::make_shared<TorusSurface>(*torus);
    surface->set_reversed(reversed);
    const SurfacePtr set[] = {surface};
    const Body body = enclosed_by(set);
    EXPECT_TRUE(body.is_valid());
    EXPECT_NEAR(measure(body).volume.value, 2 * kPi * kPi * 0.16, 1e-9);
    const Line line{{-3, 0.1, 0.05}, {1, 0.02, 0.01}};
    const auto a = hits_of(*exact, line), b = hits_of(*solid(body), line);
    ASSERT_EQ(a.size(), 4u);
    ASSERT_EQ(b.size(), 4u);
  }
  // A cylinder's side has an opening at either end; its ends as one more surface each close nothing by themselves.
  const SurfacePtr side = std::make_shared<CylinderSurface>(Frame{}, 1, 2);
  EXPECT_THROW(enclosed_by(std::span(&side, 1)), std::invalid_argument);
  // Six rectangles, some looking inward, make a box.
  const Body cube = box(Frame{}, {1, 2, 3});
  std::vector<SurfacePtr> sides;
  for (const Face& face : cube.faces) sides.push_back(face.surface);
  EXPECT_NEAR(measure(enclosed_by(sides)).volume.value, 6, 1e-12);
  sides.pop_back();
  try {
    enclosed_by(sides);
    FAIL() << "an open box";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "it is open: 4 of its edges are free, one of them at (0, 1, 3)");
  }
}

TEST(Csg, UnderAMap) {
  Affine map;
  map.linear = Mat3(Vec3(2, 0.3, 0), Vec3(0, 0.5, 0.1), Vec3(0, 0, -1.5));
  map.offset = {3, 1, -2};
  const ShapePtr lens = combined(Operation::intersect, {solid_ball({0, 0, 0.6}, 1), solid_ball({0, 0, -0.6}, 1)});
  const ShapePtr image = transformed(lens, map);
  const Line line{{0.1, -0.05, -3}, {0.02, 0.03, 1}};
  const Line moved{map.point(line.origin), map.direction(line.direction)};
  const auto a = hits_of(*lens, line), b = hits_of(*image, moved);
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(a[k].t, b[k].t, 1e-12);
    const ShapePoint p = lens->point(a[k], line.at(a[k].t)), q = image->point(b[k], moved.at(b[k].t));
    EXPECT_LT(glm::length(map.point(p.position) - q.position), 1e-12);
    EXPECT_EQ(glm::dot(p.normal, line.direction) < 0, glm::dot(q.normal, moved.direction) < 0);
  }
  EXPECT_THROW(transformed(lens, Affine{Mat3(0.0), Vec3(0)}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::csg_test
