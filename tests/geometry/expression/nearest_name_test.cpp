#include "geometry/expression/nearest_name.h"

#include <gtest/gtest.h>

#include <vector>

namespace lekalo::geometry::nearest_name_test {
namespace {

TEST(NearestName, edit_distance) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook example
  EXPECT_EQ(edit_distance("axes", "axis"), 1);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1);  // a swap
  EXPECT_EQ(edit_distance("Radius", "radius"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(NearestName, suggests_only_what_is_near) {
  const std::vector<std::string> names{"radius", "center", "major_radius", "normal", "axis"};
  EXPECT_EQ(nearest_name("raduis", names), "radius");
  EXPECT_EQ(nearest_name("centre", names), "center");
  EXPECT_EQ(nearest_name("axes", names), "axis");
  EXPECT_EQ(nearest_name("majorradius", names), "major_radius");
  EXPECT_EQ(nearest_name("RADIUS", names), "radius");
  EXPECT_FALSE(nearest_name("colour", names));
  EXPECT_FALSE(nearest_name("x", std::vector<std::string>{"y", "z"}));
  EXPECT_EQ(nearest_name("T", std::vector<std::string>{"s", "t"}), "t");
  EXPECT_EQ(nearest_name("sine", std::vector<std::string>{"sinh", "sin"}), "sinh");
}

}  // namespace
}  // namespace lekalo::geometry::nearest_name_test
