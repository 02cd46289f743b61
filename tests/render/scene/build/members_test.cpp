// Members of families by counters: c.%i and { of: c, member: i }.
#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::members_test {
namespace {

const std::string kCircles = "  c: { repeat: { i: 0..3 }, type: circle, radius: i + 1 }\n";

TEST(Members, by_counters) {
  const BuiltText scene =
      build_text("geometry:\n" + kCircles +
                 "  P: { of: { of: c, member: 2 }, t: 0 }\n"
                 "  net: { repeat: { j: 1..2, k: 0..1 }, type: circle, radius: j + k }\n"
                 "  Q: { of: { of: net, member: [1, 1] }, t: 0 }\n"
                 "  a: { repeat: { i: 0..2 }, type: segment, from: [0, 0], to: { of: c.%i, t: 0 } }\n"
                 "  b: { repeat: { i: 0..2 }, type: segment, from: [0, 0], to: { of: 'c.%(i + 1)', "
                 "t: 0 } }\nlights: {}\n");
  EXPECT_EQ(scene.said, "");
  const auto& all = scene.model.geometry;
  EXPECT_EQ(std::get<Vec3>(all.at("P")), Vec3(3, 0, 0));
  EXPECT_EQ(std::get<Vec3>(all.at("Q")), Vec3(3, 0, 0));
  EXPECT_EQ(std::get<geometry::CurvePtr>(all.at("a.2"))->point(1), Vec3(3, 0, 0));
  EXPECT_EQ(std::get<geometry::CurvePtr>(all.at("b.2"))->point(1), Vec3(4, 0, 0));
}

TEST(Members, slips_are_named) {
  const auto said = [](const std::string& place) {
    return build_text("geometry:\n" + kCircles + "  P: { of: " + place + ", t: 0 }\nlights: {}\n").said;
  };
  EXPECT_NE(said("{ of: c, member: 9 }").find("'c' has no member '9'"), std::string::npos);
  EXPECT_NE(said("{ of: c, member: 1.5 }").find("whole number"), std::string::npos);
  EXPECT_NE(said("c.%i").find("no counter 'i'"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::render::members_test
