// Groups and what cameras frame: every expected value follows from the scene's own text.
#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::groups_test {
namespace {

using geometry::Box3;

BuiltText built(const std::string& text) {
  BuiltText result = build_text("lights: {}\n" + text);
  EXPECT_EQ(result.said, "") << text;
  return result;
}
std::string said(const std::string& text) { return build_text("lights: {}\n" + text).said; }

const Group& group(const Object& object) { return *std::get<GroupPtr>(object.shape); }

// Boxes are a few rounding errors wider than what they hold.
void expect_near(const Vec3& found, const Vec3& expected) { EXPECT_LE(glm::length(found - expected), 1e-13); }

const std::string kPair =
    "materials: { red: { type: diffuse, color: red }, blue: { type: diffuse, color: blue } }\n"
    "geometry:\n"
    "  ball: { type: ball, radius: 1 }\n"
    "  pair:\n"
    "    type: group\n"
    "    of:\n"
    "      - { shape: ball, material: red }\n"
    "      - { shape: ball, transform: { translate: [4, 0, 0] } }\n";

TEST(Groups, HoldObjectsWithTransforms) {
  const Model m = built(kPair + "objects: [{ shape: pair, transform: { translate: [0, 0, 1] } }]\n").model;
  ASSERT_EQ(m.objects.size(), 1u);
  const Group& pair = group(m.objects[0]);
  ASSERT_EQ(pair.objects.size(), 2u);
  EXPECT_EQ(pair.objects[0].name, "ball");
  EXPECT_EQ(pair.objects[0].material, m.materials.at("red"));
  EXPECT_EQ(pair.objects[1].transform.point({0, 0, 0}), Vec3(4, 0, 0));
  const Box3 box = bounds(m);
  expect_near(box.lo, Vec3(-1, -1, 0));
  expect_near(box.hi, Vec3(5, 1, 2));
}

TEST(Groups, RepeatedOnesAreInstances) {
  const Model m =
      built(kPair +
            "objects:\n"
            "  - { repeat: { i: 0..2 }, shape: pair, material: blue, transform: { translate: [0, 3*i, 0] } }\n"
            "  - { shape: pair }\n")
          .model;
  ASSERT_EQ(m.objects.size(), 4u);
  EXPECT_EQ(&group(m.objects[0]), &group(m.objects[1]));
  EXPECT_EQ(&group(m.objects[0]), &group(m.objects[2]));
  // Members without a material have that of the object that shows the group.
  EXPECT_EQ(group(m.objects[0]).objects[0].material, m.materials.at("red"));
  EXPECT_EQ(group(m.objects[0]).objects[1].material, m.materials.at("blue"));
  EXPECT_NE(&group(m.objects[0]), &group(m.objects[3]));
  ASSERT_NE(group(m.objects[3]).objects[1].material, nullptr);
  EXPECT_NE(group(m.objects[3]).objects[1].material, m.materials.at("blue"));
}

TEST(Groups, InsideGroupsAndWithTransformsOfTheirOwn) {
  const Model m =
      built(kPair +
            "  row: { type: group, of: { repeat: { k: 0..9 }, shape: pair, transform: { translate: [0, 10*k, 0] } } }\n"
            "  turned: { like: row, transform: { mirror: x } }\n"
            "objects: [{ shape: row }, { shape: turned, material: blue }]\n")
          .model;
  const Group& row = group(m.objects[0]);
  ASSERT_EQ(row.objects.size(), 10u);
  EXPECT_EQ(&group(row.objects[0]), &group(row.objects[9]));
  expect_near(bounds(m).lo, Vec3(-5, -1, -1));
  expect_near(bounds(m).hi, Vec3(5, 91, 1));
  // A transform of a group wraps it.
  const Group& turned = group(m.objects[1]);
  ASSERT_EQ(turned.objects.size(), 1u);
  EXPECT_EQ(group(group(turned.objects[0]).objects[0]).objects[1].material, m.materials.at("blue"));
}

// A family's groups that differ only in their transforms are one.
TEST(Groups, FamiliesShareWhatTheyHold) {
  const Model m =
      built(kPair +
            "  moved: { like: pair, repeat: { i: 0..9, j: [0, 1] }, transform: { translate: [i, 0, 3*j] } }\n"
            "  grown: { repeat: { i: 1..2 }, type: group, of: { shape: { type: ball, radius: i } } }\n"
            "objects: [{ shape: moved, material: blue }, { shape: grown }]\n")
          .model;
  ASSERT_EQ(m.objects.size(), 22u);
  EXPECT_EQ(&group(group(m.objects[1]).objects[0]), &group(group(m.objects[19]).objects[0]));
  EXPECT_EQ(group(m.objects[19]).objects[0].transform.point({0, 0, 0}), Vec3(9, 0, 3));
  expect_near(bounds(group(m.objects[20]).objects[0].shape).hi, Vec3(1, 1, 1));
  expect_near(bounds(group(m.objects[21]).objects[0].shape).hi, Vec3(2, 2, 2));
}

TEST(Groups, AreShownByDefault) {
  const BuiltText scene = built("geometry: { g: { type: group, of: { shape: { type: ball, radius: 1 } } } }\n");
  ASSERT_EQ(scene.model.objects.size(), 1u);
  EXPECT_NE(group(scene.model.objects[0]).objects[0].material, nullptr);
}

TEST(Groups, Errors) {
  EXPECT_EQ(said("geometry: { g: { type: group } }\n"), "3:16 missing field 'of' of 'group'\n");
  EXPECT_EQ(said("geometry: { g: { type: group, of: [{ material: { type: diffuse } }] } }\n"),
            "3:36 missing field 'shape' of an object\n");
  EXPECT_EQ(said("geometry: { g: { type: group, of: [{ shape: g }] } }\n"), "3:16 'g' is built from itself\n");
  EXPECT_EQ(said("geometry: { g: { type: group, of: [{ shape: h, colour: red }] } }\n"),
            "3:45 there is no geometry called 'h'\n3:48 unknown field 'colour' of an object\n");
  EXPECT_EQ(said("geometry: { g: { type: group, of: [7] } }\n"),
            "3:36 expected an object as a map of fields, found a single value\n");
  EXPECT_EQ(said("geometry: { g: { type: group, of: [] } }\n"), "3:35 expected at least 1 value, found 0\n");
  EXPECT_EQ(said(kPair + "objects: [{ shape: pair, representation: mesh }]\n"),
            "11:42 'representation' is for single shapes, and this is a group\n");
  EXPECT_EQ(said(kPair + "  r: { type: revolution_surface, of: pair, axis: z }\n"),
            "11:38 'pair' is a group, but a curve is wanted here\n");
}

// Places in the picture of the two ends of a thing in x.
std::pair<double, double> ends(const Model& m, double x0, double x1) {
  return {m.camera->project({x0, 0, 0}).x, m.camera->project({x1, 0, 0}).x};
}

TEST(Framing, FollowsTheTransformsOfObjects) {
  const std::string camera = "camera: { view: top, frame: small, margin: 0 }\nimage: { size: [100, 100] }\n";
  const std::string shapes =
      "geometry: { small: { type: box, size: [2, 2, 2] }, large: { type: box, size: [50, 50, 1] } }\n";
  const Model moved =
      built(shapes + "objects: [{ shape: large }, { shape: small, transform: { translate: [10, 0, 0] } }]\n" + camera)
          .model;
  const auto [a, b] = ends(moved, bounds(moved.objects[1].shape).lo.x + 10, bounds(moved.objects[1].shape).hi.x + 10);
  EXPECT_NEAR(a, 0, 1e-9);
  EXPECT_NEAR(b, 100, 1e-9);
  // Twice: both are in the picture.
  const Model twice =
      built(shapes + "objects: [{ repeat: { i: 0..1 }, shape: small, transform: { translate: [10*i, 0, 0] } }]\n" +
            camera)
          .model;
  EXPECT_NEAR(twice.camera->project({bounds(twice).lo.x, 0, 0}).x, 0, 1e-9);
  EXPECT_NEAR(twice.camera->project({bounds(twice).hi.x, 0, 0}).x, 100, 1e-9);
  // Inside a group.
  const Model grouped =
      built(shapes +
            "objects: [{ shape: { type: group, of: [{ shape: large }, { shape: small, transform: { translate: "
            "[5, 0, 0] } }] }, transform: { translate: [5, 0, 0] } }]\n" +
            camera)
          .model;
  EXPECT_NEAR(grouped.camera->project({bounds(moved.objects[1].shape).lo.x + 10, 0, 0}).x, 0, 1e-9);
  // What no object shows stands where it is.
  const Model hidden = built(shapes + "objects: [{ shape: large }]\n" + camera).model;
  EXPECT_NEAR(hidden.camera->project({bounds(hidden.geometry.at("small")).lo.x, 0, 0}).x, 0, 1e-9);
}

TEST(Framing, ConflictsOfCameras) {
  const auto camera = [](const std::string& fields) {
    return said("geometry: { b: { type: ball, radius: 1 } }\ncamera: { from: [0, -5, 0], " + fields + " }\n");
  };
  EXPECT_EQ(camera("view: top"), "4:35 'view' and 'from' both say from where the scene is seen\n");
  EXPECT_EQ(camera("margin: 0.1"), "4:37 'margin' is for a camera that frames the scene; this one stands at 'from'\n");
  EXPECT_EQ(camera("at: [0, 0], frame: b"),
            "4:48 'frame' is for a camera that frames the scene; this one looks from 'from' at 'at'\n");
  EXPECT_EQ(camera("frame: b"), "");
  EXPECT_EQ(camera("type: parallel, height: 3, view: top"),
            "4:62 'view' and 'from' both say from where the scene is seen\n");
}

}  // namespace
}  // namespace lekalo::render::groups_test
