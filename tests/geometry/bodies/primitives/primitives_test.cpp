// Elementary bodies: validity, and the counts of Golovanov 2016, 5.2. Volumes are in queries/mass_properties_test.cpp.
#include "geometry/bodies/primitives/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry::primitives_test {
namespace {

std::string text(const Body& body) {
  std::string result;
  for (const Violation& v : body.violations()) result += v.condition + ": " + v.entity + "\n";
  return result;
}

void expect_counts(const Body& body, int faces, int real_edges, int vertices, int loops, int characteristic) {
  EXPECT_EQ(text(body), "");
  EXPECT_TRUE(body.is_closed());
  EXPECT_EQ(static_cast<int>(body.faces.size()), faces);
  int edges = 0;
  for (const Edge& edge : body.edges) edges += edge.kind != EdgeKind::pole;
  EXPECT_EQ(edges, real_edges);
  EXPECT_EQ(static_cast<int>(body.vertices.size()), vertices);
  EXPECT_EQ(static_cast<int>(body.loops.size()), loops);
  EXPECT_EQ(body.euler_characteristic(), characteristic);
}

std::set<std::string> names(const Body& body) {
  std::set<std::string> result;
  for (const Face& face : body.faces) result.insert(face.origin.text());
  return result;
}

const Frame kTilted = frame_about({1, -2, 3}, {1, 2, -2});
const std::vector<Vec2> kArrow{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};

TEST(Primitives, CountsOfTheBook) {
  expect_counts(box(kTilted, {1, 2, 3}), 6, 12, 8, 6, 2);
  expect_counts(cylinder_body(kTilted, 1, 2), 3, 3, 2, 3, 2);
  expect_counts(frustum(kTilted, 1, 2, 3), 3, 3, 2, 3, 2);
  expect_counts(frustum(kTilted, 2, 0, 3), 2, 2, 2, 2, 2);
  expect_counts(frustum(kTilted, 0, 2, 3), 2, 2, 2, 2, 2);
  expect_counts(ball(kTilted, 2), 1, 1, 2, 1, 2);
  expect_counts(arrow_body(kTilted, 4, 0.2, 1, 0.5), 4, 5, 4, 5, 2);
  expect_counts(pyramid(kTilted, {{0, 0}, {1, 0}, {0, 1}}, {0, 0, 1}), 4, 6, 4, 4, 2);
}

TEST(Primitives, PrismsPyramidsAndWedges) {
  expect_counts(torus_body(kTilted, 3, 1), 1, 2, 1, 1, 0);
  expect_counts(prism(kTilted, kArrow, 2), 6, 12, 8, 6, 2);
  expect_counts(pyramid(kTilted, kArrow, {0.3, 0.3, 2}), 5, 8, 5, 5, 2);
  expect_counts(pyramid(kTilted, kArrow, {0.3, 0.3, 2}, 0.25), 6, 12, 8, 6, 2);
  expect_counts(wedge(kTilted, {3, 2, 1}, 1), 6, 12, 8, 6, 2);
  expect_counts(wedge(kTilted, {3, 2, 1}, 4), 6, 12, 8, 6, 2);
  expect_counts(wedge(kTilted, {3, 2, 1}, 0), 5, 9, 6, 5, 2);
}

TEST(Primitives, Volumes) {
  const double arrow = 1.0;  // shoelace: (0 + (2*.5 - .5*0) + (.5*2 - 0) + 0) / 2
  EXPECT_NEAR(measure(prism(kTilted, kArrow, 2)).volume.value, 2 * arrow, 1e-11);
  EXPECT_NEAR(measure(pyramid(kTilted, kArrow, {0.3, 0.3, 2})).volume.value, 2 * arrow / 3, 1e-11);
  EXPECT_NEAR(measure(pyramid(kTilted, kArrow, {0.3, 0.3, 2}, 0.5)).volume.value, 2 * arrow / 3 * 7 / 8, 1e-11);
  EXPECT_NEAR(measure(wedge(kTilted, {3, 2, 1}, 1)).volume.value, 4, 1e-11);
  EXPECT_NEAR(measure(wedge(kTilted, {3, 2, 1}, 0)).volume.value, 3, 1e-11);
}

TEST(Primitives, FacesHaveConstructionNames) {
  EXPECT_EQ(names(box(Frame{}, {1, 1, 1})),
            (std::set<std::string>{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}));
  EXPECT_EQ(names(cylinder_body(Frame{}, 1, 1)), (std::set<std::string>{"start", "end", "side"}));
  EXPECT_EQ(names(prism(Frame{}, kArrow, 1)),
            (std::set<std::string>{"start", "end", "side.0", "side.1", "side.2", "side.3"}));
}

TEST(Primitives, NamedFacesLookTheirWay) {
  const Body body = box(Frame{}, {1, 2, 3});
  for (size_t i = 0; i < body.faces.size(); ++i) {
    const std::string name = body.faces[i].origin.text();
    Vec3 expected(0);
    expected[name[0] - 'x'] = name.substr(2) == "max" ? 1 : -1;
    EXPECT_EQ(body.normal(static_cast<int>(i), 0.5, 0.5), expected) << name;
  }
}

TEST(Primitives, BoundsAreTightForUprightBodies) {
  const Box3 found = bounds(cylinder_body(Frame{}, 1.5, 4));
  EXPECT_LT(glm::length(found.lo - Vec3(-1.5, -1.5, 0)) + glm::length(found.hi - Vec3(1.5, 1.5, 4)), 1e-12);
}

TEST(Primitives, MapsKeepBodiesValid) {
  Affine squeeze;
  squeeze.linear = Mat3(Vec3(1, 0.2, 0), Vec3(0, 2, 0.3), Vec3(0.1, 0, 0.5));
  squeeze.offset = {4, 5, 6};
  for (const Body& body : {box(kTilted, {1, 2, 3}), frustum(kTilted, 2, 0, 3), ball(kTilted, 2)}) {
    const double volume = measure(body).volume.value;
    for (const Affine& map : {squeeze, Affine::mirror({1, 1, 0}) * squeeze}) {
      const Body image = transformed(body, map);
      EXPECT_EQ(text(image), "");
      EXPECT_NEAR(measure(image).volume.value, std::abs(map.determinant()) * volume, 1e-10 * volume);
    }
  }
}

TEST(Primitives, ImpossibleDimensionsAreRefused) {
  EXPECT_THROW(box(Frame{}, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(frustum(Frame{}, 0, 0, 1), std::invalid_argument);
  EXPECT_THROW(frustum(Frame{}, 1, 1, -1), std::invalid_argument);
  EXPECT_THROW(pyramid(Frame{}, kArrow, {0, 0, -1}), std::invalid_argument);
  EXPECT_THROW(arrow_body(Frame{}, 1, 0.1, 1, 0.2), std::invalid_argument);
  EXPECT_THROW(arrow_body(Frame{}, 1, 0.2, 0.5, 0.2), std::invalid_argument);
}

// Cylinder and cone.
TEST(Primitives, VolumeOfAnArrow) {
  const double volume = kPi * (0.2 * 0.2 * 3 + 0.5 * 0.5 * 1 / 3);
  EXPECT_NEAR(measure(arrow_body(kTilted, 4, 0.2, 1, 0.5)).volume.value, volume, 1e-12 * volume);
}

bool names_condition(const Body& body, const std::string& part) {
  for (const Violation& v : body.violations())
    if (v.condition.find(part) != std::string::npos) return true;
  return false;
}

TEST(Violations, EachIsNamed) {
  const Body good = box(Frame{}, {1, 2, 3});
  Body body = good;
  body.edges[3].end = 77;
  EXPECT_TRUE(names_condition(body, "runs between vertices"));

  body = good;
  body.edges[0].curve = std::make_shared<Segment>(body.vertices[0].point, Vec3(1, 1, 1));
  EXPECT_TRUE(names_condition(body, "ends at its vertices"));
  EXPECT_TRUE(names_condition(body, "coincide"));

  body = good;
  body.faces[2].forward = !body.faces[2].forward;
  EXPECT_TRUE(names_condition(body, "face on the left"));

  body = good;
  Coedge& coedge = body.coedges[0];
  coedge.forward = !coedge.forward;
  EXPECT_TRUE(names_condition(body, "opposite directions"));
  EXPECT_TRUE(names_condition(body, "begins at the vertex"));

  // All faces turned inside out, loops too: consistent, but it looks inward.
  body = good;
  for (Face& face : body.faces) face.forward = !face.forward;
  for (Loop& loop : body.loops) std::reverse(loop.coedges.begin(), loop.coedges.end());
  for (Coedge& each : body.coedges) each.forward = !each.forward;
  EXPECT_TRUE(names_condition(body, "look outward"));

  // A face missing from a closed shell.
  body = Body();
  const int a = body.add_vertex({1, 0, 0});
  const int edge = body.add_edge(std::make_shared<Circle>(Frame{}, 1.0), a, a);
  Body disc = cylinder_body(Frame{}, 1, 1);
  const int face = body.add_face(disc.faces[2].surface, true);
  body.add_loop(face, {{edge, true, std::make_shared<Circle>(Frame{}, 1.0)}});
  body.close_shell();
  EXPECT_TRUE(names_condition(body, "closed shell is used twice"));
}

TEST(Violations, CubesThatShareAnEdgeOrAVertexAreNotManifold) {
  // Two unit cubes glued along one edge of each (four uses), built by renaming one cube's entities.
  const auto merged = [](const Vec3& offset) {
    Body body = box(Frame{}, {1, 1, 1});
    const Body other = box(Frame{offset}, {1, 1, 1});
    std::vector<int> vertex, edge;
    for (const Vertex& v : other.vertices) {
      int found = -1;
      for (size_t i = 0; i < 8; ++i)
        if (body.vertices[i].point == v.point) found = static_cast<int>(i);
      vertex.push_back(found >= 0 ? found : body.add_vertex(v.point));
    }
    for (const Edge& e : other.edges) {
      int found = -1;
      for (size_t i = 0; i < 12; ++i)
        if (body.edges[i].start == vertex[e.start] && body.edges[i].end == vertex[e.end]) found = static_cast<int>(i);
      edge.push_back(found >= 0 ? found : body.add_edge(e.curve, vertex[e.start], vertex[e.end]));
    }
    for (const Face& f : other.faces) {
      const int face = body.add_face(f.surface, f.forward, f.origin, f.trimmed);
      std::vector<Body::Use> uses;
      for (int c : other.loops[f.loops[0]].coedges)
        uses.push_back({edge[other.coedges[c].edge], other.coedges[c].forward, other.coedges[c].image});
      body.add_loop(face, uses);
    }
    body.close_shell();
    return body;
  };
  const Body by_edge = merged({1, 1, 0});
  EXPECT_TRUE(names_condition(by_edge, "at most two faces"));
  const Body by_vertex = merged({1, 1, 1});
  EXPECT_FALSE(names_condition(by_vertex, "at most two faces"));
  EXPECT_TRUE(names_condition(by_vertex, "one fan"));
}

}  // namespace
}  // namespace lekalo::geometry::primitives_test
