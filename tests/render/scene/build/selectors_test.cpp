// Faces, edges and vertices of bodies by conditions, where a surface, a curve or a point may stand. The box is 2 x 3 x
// 4 from the origin.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/scene/scene_text.h"

namespace lekalo::render::selectors_test {
namespace {

const std::string kThings =
    "geometry:\n"
    "  part: { type: box, size: [2, 3, 4] }\n"
    "  hole: { repeat: { i: 0..2 }, type: cylinder_body, axis: { through: [i, 0, 0], along: z }, radius: 0.2, heights: "
    "[0, 1] }\n"
    "  apart: { type: exploded_body, of: part, factor: 1 }\n"
    "  peg: { type: cylinder_body, radius: 0.5, height: 2, center: [1, 1.5, 3] }\n"
    "  whole: { type: union, of: [part, peg] }\n"
    "  aside: { type: difference, of: part, minus: peg, transform: { translate: [9, 0, 0] } }\n";

geometry::CurvePtr curve(const std::string& written) {
  const BuiltText scene =
      build_text(kThings + "  found: { type: composite_curve, of: [" + written + "] }\nlights: {}\n");
  EXPECT_EQ(scene.said, "") << written;
  const auto found = scene.model.geometry.find("found");
  return found == scene.model.geometry.end() ? nullptr : std::get<geometry::CurvePtr>(found->second);
}

std::vector<Object> objects(const std::string& shape) {
  const BuiltText scene = build_text(kThings + "objects: [ { shape: " + shape + " } ]\nlights: {}\n");
  EXPECT_EQ(scene.said, "") << shape;
  return scene.model.objects;
}

Vec3 point(const std::string& written) {
  const BuiltText scene =
      build_text(kThings + "  found: { type: segment, from: " + written + ", to: [99, 99, 99] }\nlights: {}\n");
  EXPECT_EQ(scene.said, "") << written;
  return std::get<geometry::CurvePtr>(scene.model.geometry.at("found"))->point(0);
}

std::string complaint(const std::string& shape) {
  return build_text(kThings + "objects: [ { shape: " + shape + " } ]\nlights: {}\n").said;
}

TEST(Selectors, OneEdgeIsACurve) {
  const auto chord = [](const geometry::CurvePtr& c) { return c->point(c->domain().hi) - c->point(c->domain().lo); };
  EXPECT_NEAR(glm::length(chord(curve("{ of: part, between: [x_max, z_max] }"))), 3, 1e-12);
  EXPECT_EQ(chord(curve("part.edge.0")), chord(curve("{ of: part, edge: 0 }")));
}

TEST(Selectors, ManyAreManyObjects) {
  EXPECT_EQ(objects("{ of: part, extreme: z }").size(), 4u);
  EXPECT_EQ(objects("{ of: part, face: [x_min, x_max] }").size(), 2u);
  EXPECT_EQ(objects("hole.side").size(), 3u);
  EXPECT_EQ(objects("hole.1.side").size(), 1u);
  EXPECT_EQ(objects("{ of: part, parallel: x, not: { of_face: z_max } }").size(), 2u);
}

TEST(Selectors, NumbersMayBeFormulasOfCounters) {
  const BuiltText scene = build_text(kThings +
                                     "  some: { repeat: { i: 1..2 }, of: part, edge: 2*i + 1 }\n"
                                     "  third: { of: part, edge: 3 }\nlights: {}\n");
  EXPECT_EQ(scene.said, "");
  const auto begin = [&](const char* name) {
    return std::get<geometry::CurvePtr>(scene.model.geometry.at(name))->point(0);
  };
  EXPECT_EQ(begin("some.0"), begin("third"));
  EXPECT_NE(begin("some.1"), begin("third"));
}

TEST(Selectors, OperandsLendTheirNames) {
  EXPECT_EQ(objects("apart.part.x_min").size(), 1u);
  EXPECT_EQ(objects("apart.x_min").size(), 1u);
  EXPECT_EQ(objects("{ of: apart, new_in: apart, of_face: part.x_max }").size(), 4u);
}

TEST(Selectors, SolidsPutTogetherHaveNewEdges) {
  EXPECT_NEAR(curve("{ of: whole, new_in: whole }")->point(0.3).z, 4, 1e-12);
  EXPECT_EQ(objects("{ of: aside, new_in: aside }").size(), 1u);
}

TEST(Selectors, Places) {
  EXPECT_EQ(point("{ of: part, vertex: 0 }"), point("part.vertex.0"));
  EXPECT_NEAR(point("{ of: part, extreme: -x }").x, 0, 1e-12);
  EXPECT_NEAR(point("{ of: hole.2, extreme: [0, 1] }").y, 0.2, 1e-12);
  EXPECT_NEAR(point("{ of: part, face: z_max }").z, 4, 1e-12);
  EXPECT_LE(glm::length(point("{ of: part, between: [x_max, z_max] }") - Vec3(2, 1.5, 4)), 1e-12);
}

TEST(Selectors, NamedOnes) {
  const BuiltText scene = build_text(kThings +
                                     "  top: { of: part, extreme: z }\n  rim: { of: part, between: [x_max, z_max] }\n"
                                     "lights: {}\n");
  EXPECT_EQ(scene.said, "");
  EXPECT_NEAR(std::get<Vec3>(scene.model.geometry.at("top")).z, 4, 1e-12);
  EXPECT_TRUE(std::holds_alternative<geometry::CurvePtr>(scene.model.geometry.at("rim")));
}

TEST(Selectors, Complaints) {
  EXPECT_NE(complaint("{ of: part, face: x_mix }").find("no face 'x_mix'"), std::string::npos);
  EXPECT_NE(complaint("{ of: part, betwen: [x_min, z_min] }").find("did you mean 'between'"), std::string::npos);
  EXPECT_NE(complaint("{ of: part, between: [x_min, x_max] }").find("nothing of the body is like that"),
            std::string::npos);
  EXPECT_NE(complaint("{ of: part, new_in: part }").find("made of no other body"), std::string::npos);
  EXPECT_NE(complaint("part.edge.77").find("no edge 'edge.77'"), std::string::npos);
  const BuiltText many =
      build_text(kThings + "  found: { type: trimmed_curve, of: { of: part, extreme: z }, from: 0, to: 1 }\n");
  EXPECT_NE(many.said.find("4 things are meant"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::render::selectors_test
