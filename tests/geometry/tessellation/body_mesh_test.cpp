// Meshes of bodies: watertight (every triangle side used once each way), V - E + F equal to the body's Euler
// characteristic, sag measured densely, volume and area near the body's own.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/patches.h"
#include "geometry/tessellation/mesh_checks.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry::body_mesh_test {
namespace {

void check(const Body& body, const TessellationTolerance& tolerance, double min_cosine = 0.5) {
  const Mesh mesh = tessellate(body, tolerance);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(points_are_distinct(mesh));
  EXPECT_EQ(euler_characteristic(mesh), body.euler_characteristic());
  expect_good_normals(mesh, min_cosine);
  for (size_t face = 0; face < body.faces.size(); ++face)
    EXPECT_LE(measured_sag(mesh, *body.faces[face].surface, static_cast<int>(face)), tolerance.sag * 1.05)
        << "face " << face << " " << body.faces[face].origin.text();
  const MassProperties exact = measure(body, 1e-9), found = measure(mesh);
  EXPECT_NEAR(found.volume.value, exact.volume.value, tolerance.sag * exact.area.value);
  EXPECT_LE(std::abs(found.area.value - exact.area.value) / exact.area.value,
            20 * tolerance.sag / std::cbrt(exact.volume.value));
}

const Frame kTilted = frame_about({1, -2, 3}, {1, 2, -2});
const std::vector<Vec2> kArrow{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};

TEST(BodyMesh, PrimitivesAreWatertight) {
  for (double sag : {0.2, 0.02, 0.001}) {
    for (double angle : {0.35, kPi}) {
      const TessellationTolerance tolerance{sag, angle, {}};
      check(box(kTilted, {1, 2, 3}), tolerance);
      check(ball(kTilted, 2), tolerance);
      check(cylinder_body(kTilted, 1.5, 4), tolerance);
      check(frustum(kTilted, 1, 2, 3), tolerance);
      check(frustum(kTilted, 2, 0, 3), tolerance);
      check(frustum(kTilted, 0, 2, 3), tolerance);
      check(torus_body(kTilted, 3, 1), tolerance, 0.3);
      check(wedge(kTilted, {3, 2, 1}, 1), tolerance);
      check(prism(kTilted, kArrow, 2), tolerance);
      check(pyramid(kTilted, kArrow, {0.3, 0.3, 2}), tolerance);
      check(pyramid(kTilted, kArrow, {0.3, 0.3, 2}, 0.25), tolerance);
    }
  }
}

TEST(BodyMesh, CubeHasTwelveTrianglesOnEightPoints) {
  const Mesh mesh = tessellate(box(Frame{}, {1, 1, 1}), {});
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_EQ(mesh.normals.size(), 24u);
}

// Thinner than what the body's points can tell apart: its two large faces, whose areas are 1.
TEST(BodyMesh, OfABoxThatIsThinnerThanRounding) {
  for (const double thickness : {1e-13, 1e-14, 1e-15, 1e-30})
    for (const Vec3& size : {Vec3(1, 1, thickness), Vec3(thickness, 1, 1)}) {
      const Mesh mesh = tessellate(box(Frame(), size), {});
      double area = 0;
      for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.points[t.point[0]];
        area += 0.5 * glm::length(glm::cross(mesh.points[t.point[1]] - a, mesh.points[t.point[2]] - a));
      }
      EXPECT_NEAR(area, 2, 1e-12) << thickness;
    }
}

TEST(BodyMesh, MirroredBodiesStayOutside) {
  check(transformed(frustum(kTilted, 1, 2, 3), Affine::mirror({1, 2, 3})), {0.01, 0.35, {}});
  check(transformed(torus_body(kTilted, 3, 1), Affine::mirror({0, 0, 1})), {0.01, 0.35, {}});
}

// Biconvex lens: two caps of spheres of radius R whose trims are circles around their poles, in the parameter plane
// whole turns at a constant latitude; the poles are pole edges and each cap has a seam.
Body lens(double radius, double half_angle) {
  Body body;
  const double rim = radius * std::sin(half_angle), height = radius * std::cos(half_angle);
  const Interval turn{0, kTwoPi}, latitude{0.5 * kPi - half_angle, 0.5 * kPi};
  const int corner = body.add_vertex({rim, 0, 0});
  const int circle = body.add_edge(std::make_shared<Circle>(Frame{}, rim), corner, corner, {"", "rim"});
  for (double up : {1.0, -1.0}) {
    // The lower cap is the upper one turned about x, so its longitudes run the other way round.
    const Frame frame{{0, 0, -up * height}, {1, 0, 0}, {0, up, 0}, {0, 0, up}};
    const int pole = body.add_vertex(frame.origin + radius * frame.z);
    const Frame meridian{frame.origin, frame.x, frame.z, -frame.y};
    const int seam =
        body.add_edge(std::make_shared<Circle>(meridian, radius, latitude), corner, pole, {}, EdgeKind::seam);
    const int top = body.add_edge(point_curve(turn, body.vertices[pole].point), pole, pole, {}, EdgeKind::pole);
    const int face =
        body.add_face(std::make_shared<SphereSurface>(frame, radius), true, {"", up > 0 ? "end" : "start"});
    const Vec2 from(0, latitude.lo), to(kTwoPi, latitude.lo);
    body.add_loop(face, {{circle, up > 0, up > 0 ? image_line(turn, from, to) : image_line(turn, to, from)},
                         {seam, true, image_line(latitude, {kTwoPi, latitude.lo}, {kTwoPi, latitude.hi})},
                         {top, false, image_line(turn, {0, latitude.hi}, {kTwoPi, latitude.hi})},
                         {seam, false, image_line(latitude, {0, latitude.lo}, {0, latitude.hi})}});
  }
  body.close_shell();
  return body;
}

TEST(BodyMesh, LensOfTwoTrimmedCaps) {
  const Body body = lens(2, 0.7);
  for (const Violation& v : body.violations()) ADD_FAILURE() << v.condition << ": " << v.entity;
  const double h = 2 * (1 - std::cos(0.7));  // of one cap
  const MassProperties found = measure(body);
  EXPECT_NEAR(found.volume.value, 2 * kPi * h * h * (3 * 2 - h) / 3, 1e-10);
  EXPECT_NEAR(found.area.value, 2 * kTwoPi * 2 * h, 1e-10);
  for (double sag : {0.5, 0.05, 0.005, 5e-4}) check(body, {sag, 0.5, {}});
  check(body, {1, kPi, {}});
}

// A block with a round hole through it: two faces have two loops, the hole's wall is a reversed cylinder.
Body drilled_block(double radius) {
  Body body = box(Frame{{-2, -2, 0}}, {4, 4, 1});
  body.shells.clear();
  const int low = body.add_vertex({radius, 0, 0}), high = body.add_vertex({radius, 0, 1});
  Frame top;
  top.origin = {0, 0, 1};
  const int bottom_rim = body.add_edge(std::make_shared<Circle>(Frame{}, radius), low, low);
  const int top_rim = body.add_edge(std::make_shared<Circle>(top, radius), high, high);
  const int seam = body.add_edge(std::make_shared<Segment>(body.vertices[low].point, body.vertices[high].point), low,
                                 high, {}, EdgeKind::seam);
  const Interval turn{0, kTwoPi};
  const int wall = body.add_face(std::make_shared<CylinderSurface>(Frame{}, radius, 1), false, {"hole", "side"}, false);
  body.add_loop(wall, {{bottom_rim, false, image_line(turn, {0, 0}, {kTwoPi, 0})},
                       {seam, true, image_line({0, 1}, {0, 0}, {0, 1})},
                       {top_rim, true, image_line(turn, {0, 1}, {kTwoPi, 1})},
                       {seam, false, image_line({0, 1}, {kTwoPi, 0}, {kTwoPi, 1})}});
  for (size_t i = 0; i < 6; ++i) {
    const std::string name = body.faces[i].origin.text();
    if (name != "z_min" && name != "z_max") continue;
    body.faces[i].trimmed = true;
    // The planes' origin is the corner (-2, -2).
    Frame center;
    center.origin = {2, 2, 0};
    body.add_loop(static_cast<int>(i), {{name == "z_min" ? bottom_rim : top_rim, name == "z_min",
                                         std::make_shared<Circle>(center, radius)}});
  }
  body.close_shell();
  return body;
}

TEST(BodyMesh, BlockWithAHole) {
  const Body body = drilled_block(1.2);
  for (const Violation& v : body.violations()) ADD_FAILURE() << v.condition << ": " << v.entity;
  EXPECT_EQ(body.euler_characteristic(), 0);
  const MassProperties found = measure(body);
  EXPECT_NEAR(found.volume.value, 16 - kPi * 1.44, 1e-10);
  EXPECT_NEAR(found.area.value, 2 * (16 - kPi * 1.44) + 16 + kTwoPi * 1.2, 1e-10);
  for (size_t i = 0; i < body.faces.size(); ++i) {
    if (body.faces[i].origin.text() == "z_max") {
      EXPECT_NEAR(measure_face(body, static_cast<int>(i)).area.value, 16 - kPi * 1.44, 1e-10);
    }
  }
  for (double sag : {0.5, 0.05, 0.005}) check(body, {sag, 0.5, {}});
  // Nearly the whole width: at this sag the hole's polygon first crosses nothing, then must be fine enough.
  check(drilled_block(1.9999), {0.01, 0.5, {}});
}

TEST(BodyMesh, AHoleThatBreaksOutIsNoBody) {
  const std::vector<Violation> found = drilled_block(2.05).violations();
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const Violation& v) { return v.condition == "the loops of a face do not cross"; }));
  EXPECT_TRUE(drilled_block(1.9999).is_valid());
}

// Around the middle's values, by bounds of the next derivatives: |d[k + 1]| <= 1 in x and y, 2^(k + 1) height / 2 in z.
CurveEnclosure around(const CurveJet& middle, double half, double height) {
  CurveEnclosure all;
  for (int k = 0; k <= middle.order; ++k) {
    const Vec3 far = half * Vec3(1, 1, 0.5 * height * std::pow(2, k + 1));
    all.d[k] = {middle.d[k] - far, middle.d[k] + far};
  }
  return all;
}

// A cylinder with a curved, twisted top: a Bezier patch cut by the circle, so the top's rim is a space curve and the
// wall is trimmed by it.
class RimCurve final : public Curve {
 public:
  static constexpr double kHeight = 0.25;
  Interval domain() const override { return {0, kTwoPi}; }
  double period() const override { return kTwoPi; }
  CurveJet evaluate(double t, int order) const override {
    CurveJet jet;
    jet.order = order;
    for (int k = 0; k <= order; ++k)
      jet.d[k] = {std::cos(t + 0.5 * kPi * k), std::sin(t + 0.5 * kPi * k),
                  0.5 * kHeight * std::pow(2, k) * std::sin(2 * t + 0.5 * kPi * k) + (k == 0 ? 1 : 0)};
    return jet;
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    return around(evaluate(t.middle(), order), 0.5 * t.width(), kHeight);
  }
};

// Image of the rim on the wall: (t, z / height of the wall's surface).
class WallRim final : public Curve {
 public:
  Interval domain() const override { return {0, kTwoPi}; }
  CurveJet evaluate(double t, int order) const override {
    const CurveJet rim = RimCurve().evaluate(t, order);
    CurveJet jet;
    jet.order = order;
    for (int k = 0; k <= order; ++k) jet.d[k] = {k == 0 ? t : k == 1 ? 1.0 : 0.0, rim.d[k].z / 2, 0};
    return jet;
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    return around(evaluate(t.middle(), order), 0.5 * t.width(), RimCurve::kHeight);
  }
};

TEST(BodyMesh, CylinderWithASaddleTop) {
  // Top z = 1 + h x y over [-1.5, 1.5]^2, wall radius 1.
  const double h = RimCurve::kHeight, a = 1.5;
  Body body;
  const int low = body.add_vertex({1, 0, 0}), high = body.add_vertex({1, 0, 1});
  const Interval turn{0, kTwoPi};
  const int bottom = body.add_edge(std::make_shared<Circle>(Frame{}, 1.0), low, low);
  const int rim = body.add_edge(std::make_shared<RimCurve>(), high, high);
  const int seam =
      body.add_edge(std::make_shared<Segment>(Vec3(1, 0, 0), Vec3(1, 0, 1)), low, high, {}, EdgeKind::seam);
  const int wall = body.add_face(std::make_shared<CylinderSurface>(Frame{}, 1, 2), true, {"", "side"});
  body.add_loop(wall, {{bottom, true, image_line(turn, {0, 0}, {kTwoPi, 0})},
                       {seam, true, image_line({0, 1}, {kTwoPi, 0}, {kTwoPi, 0.5})},
                       {rim, false, std::make_shared<WallRim>()},
                       {seam, false, image_line({0, 1}, {0, 0}, {0, 0.5})}});
  const int base = body.add_face(std::make_shared<Plane>(Frame{}, Rectangle{{-2, 2}, {-2, 2}}), false, {"", "start"});
  body.add_loop(base, {{bottom, false, std::make_shared<Circle>(Frame{}, 1.0)}});
  Grid<Vec3> net{
      2, 2, {{-a, -a, 1 + h * a * a}, {-a, a, 1 - h * a * a}, {a, -a, 1 - h * a * a}, {a, a, 1 + h * a * a}}};
  const int top = body.add_face(std::make_shared<NurbsSurface>(bezier_surface(net)), true, {"", "end"});
  Frame middle;
  middle.origin = {0.5, 0.5, 0};
  body.add_loop(top, {{rim, true, std::make_shared<Circle>(middle, 1 / (2 * a))}});
  body.close_shell();
  for (const Violation& v : body.violations()) ADD_FAILURE() << v.condition << ": " << v.entity;
  // The saddle adds nothing to the volume.
  EXPECT_NEAR(measure(body).volume.value, kPi, 1e-10);
  for (double sag : {0.1, 0.01, 0.001, 1e-4}) check(body, {sag, 0.5, {}});
}

// Middles of the sides that only one triangle uses.
std::vector<Vec3> convex_sides(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++sides[std::minmax(t.point[k], t.point[(k + 1) % 3])];
  std::vector<Vec3> result;
  for (const auto& [side, uses] : sides)
    if (uses == 1) result.push_back(0.5 * (mesh.points[side.first] + mesh.points[side.second]));
  return result;
}

TEST(BodyMesh, SewnHalvesOfASphereAreClosed) {
  const Interval latitude{-0.5 * kPi, 0.5 * kPi};
  const std::vector<SurfacePtr> halves{std::make_shared<SphereSurface>(kTilted, 2, Rectangle{{0, kPi}, latitude}),
                                       std::make_shared<SphereSurface>(kTilted, 2, Rectangle{{kPi, kTwoPi}, latitude})};
  const Body body = sew(halves);
  for (const Violation& v : body.violations()) ADD_FAILURE() << v.condition << ": " << v.entity;
  EXPECT_EQ(body.euler_characteristic(), 2);
  for (double sag : {0.1, 0.01, 0.001}) check(body, {sag, 0.5, {}});
}

TEST(BodyMesh, SewnWholeSurfacesHaveSeamsAndPoles) {
  const std::vector<SurfacePtr> sphere{std::make_shared<SphereSurface>(kTilted, 2)};
  const Body body = sew(sphere);
  for (const Violation& v : body.violations()) ADD_FAILURE() << v.condition << ": " << v.entity;
  EXPECT_EQ(body.euler_characteristic(), 2);
  check(body, {0.01, 0.5, {}});
}

SurfacePtr kinked(const Rectangle& domain) {
  return std::make_shared<FormulaSurface>(
      point_formulas({"u", "v", "max(v, 0.3*u)"}, {"u", "v"}, Coordinates::cartesian), domain,
      FormulaSurface::Closed{});
}

// A kink across a disc: halves of planes with the slopes 1 and 0.3. Sides of the border belong to others and are not
// split: it keeps the sag by itself.
TEST(BodyMesh, KinkAcrossATrimmedFace) {
  const SurfacePtr sheet = kinked({{-2, 2}, {-2, 2}});
  const std::vector<Curve2Ptr> circle{std::make_shared<Circle>(Frame{}, 1.5)};
  const Body disc = trimmed_surface(sheet, circle);
  for (const double sag : {0.01, 1e-3, 1e-4}) {
    const Mesh mesh = tessellate(disc, {sag, 0.35, {}});
    EXPECT_TRUE(points_are_distinct(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 1);
    EXPECT_LE(measured_sag(mesh, *sheet, 0), 1.05 * sag);
    EXPECT_LE(mesh.triangles.size(), 40 / std::sqrt(sag));
    EXPECT_NEAR(measure(mesh).area.value, kPi * 1.5 * 1.5 / 2 * (std::sqrt(2) + std::sqrt(1.09)), 20 * sag);
  }
}

// Across the common side of two faces: no crack there, and as few triangles.
TEST(BodyMesh, KinkAcrossASharedEdge) {
  const std::vector<SurfacePtr> sheets{kinked({{-2, -0.5}, {-2, 2}}), kinked({{-0.5, 2}, {-2, 2}})};
  const Body body = sew(sheets);
  for (const double sag : {0.01, 1e-3, 1e-4}) {
    const Mesh mesh = tessellate(body, {sag, 0.35, {}});
    EXPECT_TRUE(points_are_distinct(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 1);
    EXPECT_LE(mesh.triangles.size(), 1000u);
    for (int face = 0; face < 2; ++face) EXPECT_LE(measured_sag(mesh, *sheets[face], face), 1.05 * sag);
    EXPECT_NEAR(measure(mesh).area.value, 8 * (std::sqrt(2) + std::sqrt(1.09)), 20 * sag);
  }
}

TEST(BodyMesh, SewnTeapotHasNoCracks) {
  std::ifstream file(LEKALO_SOURCE_DIR "/scenes/data/newell_teapot.txt");
  ASSERT_TRUE(file) << "scenes/data/newell_teapot.txt is not there";
  std::stringstream text;
  text << file.rdbuf();
  const std::vector<SurfacePtr> patches = parse_patches(text.str());
  const Body body = sew(patches);
  for (double sag : {0.1, 0.01, 0.001}) {
    const Mesh mesh = tessellate(body, {sag, 0.5, {}});
    EXPECT_TRUE(points_are_distinct(mesh));
    for (size_t face = 0; face < patches.size(); ++face)
      EXPECT_LE(measured_sag(mesh, *patches[face], static_cast<int>(face)), sag * 1.1) << face;
    // Free borders are those of the surfaces that meet no other: the rims of pot and lid, the ends of handle and spout.
    std::vector<Vec3> border;
    for (const Edge& edge : body.edges)
      if (edge.coedges.size() == 1 && edge.kind != EdgeKind::pole)
        for (int k = 0; k <= 200; ++k) border.push_back(edge.curve->point(edge.curve->domain().lo + k / 200.0));
    for (const Vec3& middle : convex_sides(mesh)) {
      double nearest = kInfinity;
      for (const Vec3& p : border) nearest = std::min(nearest, glm::length(p - middle));
      EXPECT_LE(nearest, sag + 0.01);
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::body_mesh_test
