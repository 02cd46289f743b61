// What is chosen is counted on bodies whose faces and edges are known.
#include "geometry/bodies/topology/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/landmarks.h"
#include "geometry/describe.h"

namespace lekalo::geometry::selection_test {
namespace {

Body block() { return box({}, {2, 3, 4}); }

size_t edges(const Body& body, const Selector& selector) { return select(body, Element::edge, selector).size(); }

TEST(Selection, NamesStandForFamilies) {
  EXPECT_TRUE(stands_for("blank.side.2", "blank.side.2"));
  EXPECT_TRUE(stands_for("blank.side", "blank.side.2"));
  EXPECT_TRUE(stands_for("blank", "blank.side.2"));
  EXPECT_TRUE(stands_for("hole.side", "hole.3.side"));
  EXPECT_TRUE(stands_for("hole.3", "hole.3.side.1"));
  EXPECT_FALSE(stands_for("hole.3", "hole.4.side.3"));
  EXPECT_FALSE(stands_for("blank.side.2", "blank.side.21"));
  EXPECT_FALSE(stands_for("blank.side.2", "blank.side"));
  EXPECT_FALSE(stands_for("side", "blank.side"));
}

TEST(Selection, ByName) {
  const Body body = with_feature(block(), "part");
  EXPECT_EQ(called(body, Element::face, "part.x_min").size(), 1u);
  EXPECT_EQ(called(body, Element::face, "x_min").size(), 1u);
  EXPECT_EQ(called(body, Element::face, "part").size(), 6u);
  EXPECT_EQ(called(body, Element::face, "y"), std::vector<int>{});
  EXPECT_EQ(called(body, Element::edge, "edge.7"), std::vector<int>{7});
  EXPECT_EQ(called(body, Element::edge, "edge.12"), std::vector<int>{});
}

TEST(Selection, OfTheEdgesOfABox) {
  const Body body = block();
  Selector between, top, upright, of_face, not_upright, both;
  between.between = {"x_max", "z_max"};
  EXPECT_EQ(edges(body, between), 1u);
  top.extreme = Vec3(0, 0, 1);
  EXPECT_EQ(edges(body, top), 4u);
  EXPECT_EQ(select(body, Element::face, top).size(), 1u);
  EXPECT_EQ(select(body, Element::vertex, top).size(), 4u);
  upright.parallel = Vec3(0, 0, 1);
  EXPECT_EQ(edges(body, upright), 4u);
  EXPECT_EQ(select(body, Element::face, upright).size(), 2u);
  of_face.of_face = {"z_max"};
  EXPECT_EQ(edges(body, of_face), 4u);
  EXPECT_EQ(select(body, Element::vertex, of_face).size(), 4u);
  not_upright.none = {upright};
  EXPECT_EQ(edges(body, not_upright), 8u);
  both.all = {upright};
  both.extreme = Vec3(1, 1, 0);
  EXPECT_EQ(edges(body, both), 1u);
}

TEST(Selection, WhatIsNew) {
  const auto old = std::make_shared<const Body>(block());
  const Body longer = box({}, {2, 3, 5});
  Selector fresh;
  fresh.new_to = std::vector<BodyPtr>{old};
  EXPECT_EQ(edges(*old, fresh), 0u);
  EXPECT_EQ(edges(longer, fresh), 8u);  // the lower side is that of the old one
  EXPECT_EQ(select(longer, Element::vertex, fresh).size(), 4u);
}

TEST(Selection, SeamsAndPolesAreNone) {
  const Body body = ball({}, 1);
  EXPECT_EQ(edges(body, Selector{}), 0u);
  EXPECT_EQ(select(body, Element::face, Selector{}).size(), 1u);
}

TEST(Selection, RefusesNamesThatNothingHas) {
  const Body body = block();
  Selector wrong;
  wrong.between = {"x_max", "z_mox"};
  EXPECT_THROW(select(body, Element::edge, wrong), FieldError);
  wrong = {};
  wrong.names = {"edge.99"};
  EXPECT_THROW(select(body, Element::edge, wrong), FieldError);
  wrong = {};
  wrong.between = {"x_max", "z_max"};
  EXPECT_THROW(select(body, Element::face, wrong), FieldError);
}

TEST(Landmarks, FarthestPoints) {
  const Body round = ball({}, 2);
  const Vec3 way = glm::normalize(Vec3(1, 2, -2));
  EXPECT_LE(glm::length(extreme_point(&round, bounds(round), 5.0 * way) - 2.0 * way), 1e-7);
  EXPECT_NEAR(glm::dot(extreme_point(&round, bounds(round), way), way), 2, 1e-13);
  const Body cuboid = block();
  for (const Vec3& p : points_at_end(cuboid, {0, 0, 1})) EXPECT_NEAR(p.z, bounds(cuboid).hi.z, 1e-12);
  const Body cylinder = cylinder_body({}, 1, 3);
  EXPECT_NEAR(extreme_point(&cylinder, bounds(cylinder), {1, 1, 0}).x, std::sqrt(0.5), 1e-9);
}

TEST(Landmarks, InsideOfFaces) {
  const Body cuboid = block();
  const int top = called(cuboid, Element::face, "z_max").front();
  const Vec3 middle = inner_point(cuboid, top);
  EXPECT_LE(glm::length(middle - Vec3(bounds(cuboid).center().x, bounds(cuboid).center().y, bounds(cuboid).hi.z)), 0.2);
}

}  // namespace
}  // namespace lekalo::geometry::selection_test
