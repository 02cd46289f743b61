// A group shown twice is the same picture as its members written out: all places are sums and products of powers of
// two, so that the rays meet the same numbers.
#include <gtest/gtest.h>

#include "render/film/render.h"
#include "render/scene/scene_text.h"
#include "render/trace/world.h"
#include "support/worst.h"

namespace lekalo::render::groups_picture_test {
namespace {

Image picture(const std::string& text) {
  BuiltText built = build_text(
      "materials: { red: { type: plastic, color: red }, glass: { type: dielectric, index: 1.5 } }\n"
      "lights: { sun: { type: distant_light, direction: [1, 2, -4] }, sky: { type: ambient_light, intensity: 0.2 } }\n"
      "camera: { type: perspective, from: [6, -9, 5], at: [1, 0, 0], field_of_view: 40 }\n"
      "image: { size: [96, 64], samples: 4 }\n" +
      text);
  EXPECT_EQ(built.said, "");
  const World world(std::make_shared<const Model>(std::move(built.model)));
  return render(world, {.threads = 1}).image;
}

const std::string kShapes =
    "geometry:\n"
    "  ring: { type: torus_body, major_radius: 1, minor_radius: 0.25 }\n"
    "  ball: { type: ball, radius: 0.5 }\n"
    "  patch: { type: nurbs_surface, degree: 2, points: [[[-1, -1, -1], [-1, 0, 0], [-1, 1, -1]],\n"
    "           [[0, -1, 0], [0, 0, -1], [0, 1, 0]], [[1, -1, -1], [1, 0, 0], [1, 1, -1]]] }\n";

TEST(GroupPictures, TwiceIsTheSameAsWrittenOut) {
  const Image grouped = picture(kShapes +
                                "  pair:\n"
                                "    type: group\n"
                                "    of:\n"
                                "      - { shape: ring, material: glass }\n"
                                "      - { shape: ball, transform: { translate: [0, 0, 0.5] } }\n"
                                "      - { shape: patch }\n"
                                "objects:\n"
                                "  - { shape: pair, material: red, transform: { translate: [-1, 0, 0] } }\n"
                                "  - { shape: pair, transform: [{ scale: 2 }, { translate: [3, 1, 0] }] }\n");
  const Image plain =
      picture(kShapes +
              "objects:\n"
              "  - { shape: ring, material: glass, transform: { translate: [-1, 0, 0] } }\n"
              "  - { shape: ball, material: red, transform: { translate: [-1, 0, 0.5] } }\n"
              "  - { shape: patch, material: red, transform: { translate: [-1, 0, 0] } }\n"
              "  - { shape: ring, material: glass, transform: [{ scale: 2 }, { translate: [3, 1, 0] }] }\n"
              "  - { shape: ball, transform: [{ scale: 2 }, { translate: [3, 1, 1] }] }\n"
              "  - { shape: patch, transform: [{ scale: 2 }, { translate: [3, 1, 0] }] }\n");
  double reddest = 0, largest = 0;
  for (const Channel& channel : grouped.channels) {
    if (channel.name.starts_with("id.") || channel.values.empty()) continue;  // groups have numbers of their own
    const Channel* other = find_channel(plain, channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    for (size_t i = 0; i < channel.values.size(); ++i)
      largest = tests::worse(largest, std::fabs(static_cast<double>(channel.values[i]) - other->values[i]));
    if (channel.name == "R")
      for (size_t i = 0; i < channel.values.size(); ++i)
        reddest = std::max(reddest, static_cast<double>(channel.values[i] - find_channel(grouped, "G")->values[i]));
  }
  EXPECT_GT(reddest, 0.2);   // something is in the picture
  EXPECT_LE(largest, 1e-5);  // float layers of points some ten units away
}

}  // namespace
}  // namespace lekalo::render::groups_picture_test
