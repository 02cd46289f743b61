// Meshes of surfaces: sag measured densely, welds, counts near those of Golovanov 2016, 8.7, where both directions
// share the tolerance (ours keeps the sag on the diagonals too).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/tessellation/mesh_checks.h"
#include "geometry/tessellation/tessellate.h"
#include "support/surface_of_formula.h"

namespace lekalo::geometry::surface_mesh_test {
namespace {

TessellationTolerance sag_only(double sag) { return {sag, kPi, {}}; }

TEST(SurfaceMesh, SphereIsClosedAndKeepsTheSag) {
  const SphereSurface sphere(Frame{}, 1);
  for (double sag : {0.1, 0.01, 1e-3, 1e-4}) {
    const Mesh mesh = tessellate(sphere, sag_only(sag));
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_TRUE(points_are_distinct(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    expect_good_normals(mesh);
    EXPECT_LE(measured_sag(mesh, sphere), sag * 1.02);
    const double volume = measure(mesh).volume.value;
    EXPECT_LT(volume, 4 * kPi / 3);
    EXPECT_GT(volume, 4 * kPi / 3 * (1 - 3 * sag));
  }
  // Half the sag in each direction needs twice the 506 triangles of the book, whose diagonals deviate by 1.76 sags.
  EXPECT_LE(tessellate(sphere, sag_only(0.01)).triangles.size(), 1040u);
}

TEST(SurfaceMesh, NormalsAndParametersAreTheSurfacesOwn) {
  SphereSurface sphere(frame_about({1, 2, 3}, {1, 1, 1}), 2);
  sphere.set_reversed(true);
  const Mesh mesh = tessellate(sphere, sag_only(0.01));
  EXPECT_LT(measure(mesh).volume.value, 0);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.points[t.point[k]];
      const Vec2 uv = mesh.parameters[t.parameter[k]];
      EXPECT_LT(glm::length(p - sphere.point(uv.x, uv.y)), 1e-14 * 10);
      EXPECT_LT(glm::length(mesh.normals[t.normal[k]] - (Vec3(1, 2, 3) - p) / 2.0), 1e-12);
    }
}

TEST(SurfaceMesh, CylinderUsesItsToleranceInOneDirection) {
  const CylinderSurface cylinder(Frame{}, 1, 5);
  const Mesh mesh = tessellate(cylinder, sag_only(0.01));
  // 23 strips, 46 triangles.
  EXPECT_EQ(mesh.triangles.size(), 46u);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_LE(measured_sag(mesh, cylinder), 0.01);
}

TEST(SurfaceMesh, ConeApexIsAFanWithItsOwnNormals) {
  const ConeSurface cone(Frame{}, 2, 0, 3);
  const Mesh mesh = tessellate(cone, sag_only(0.01));
  EXPECT_EQ(euler_characteristic(mesh), 1);
  expect_good_normals(mesh, 0.99);
  EXPECT_LE(measured_sag(mesh, cone), 0.0101);
}

TEST(SurfaceMesh, PlaneIsTwoTrianglesAndTheSaddleIsNot) {
  EXPECT_EQ(tessellate(Plane(Frame{}, {{0, 3}, {0, 2}}), sag_only(1e-9)).triangles.size(), 2u);
  // z = u v: no curvature along the lines, deviation 1/4 at the center of two triangles.
  Grid<Vec3> net{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}}};
  const NurbsSurface saddle = bezier_surface(net);
  EXPECT_GT(measured_sag(tessellate(saddle, sag_only(1)), saddle), 0.1);
  for (double sag : {0.05, 0.01, 1e-4}) {
    const Mesh mesh = tessellate(saddle, sag_only(sag));
    EXPECT_LE(measured_sag(mesh, saddle), sag * (1 + 1e-9));
    // The area twice over: 1/4 by n^2 cells, so 1/(4 sag) cells.
    EXPECT_LE(mesh.triangles.size(), 2 * 1.3 / (4 * sag) + 8);
  }
}

TEST(SurfaceMesh, BicubicPatchWithACollapsedEdge) {
  Grid<Vec3> net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      net.values.push_back(Vec3(j * (i - 1.5), j, 0.8 * std::sin(1.3 * i + 0.7) * j * (3 - 0.5 * j)));
  const NurbsSurface patch = bezier_surface(net);  // v = 0 is the point 0
  for (double sag : {0.1, 0.01, 1e-3}) {
    const Mesh mesh = tessellate(patch, {sag, 0.35, {}});
    EXPECT_EQ(euler_characteristic(mesh), 1);
    EXPECT_LE(measured_sag(mesh, patch), sag * 1.05);
    expect_good_normals(mesh);
  }
}

TEST(SurfaceMesh, CreasesHaveANormalForEachSide) {
  // A roof: degree 1 in u with a ridge, a parabola in v.
  const SplineAxis across(1, {0, 0, 1, 2, 2}, Extension::tangent);
  const SplineAxis along(2, {0, 0, 0, 1, 1, 1}, Extension::analytic);
  std::vector<Vec3> points;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) points.push_back({i - 1.0, 2.0 * j, (i == 1) + (j == 1)});
  const NurbsSurface roof(across, along, points);
  const Mesh mesh = tessellate(roof, {0.01, 0.3, {}});
  expect_good_normals(mesh, 0.98);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_TRUE(points_are_distinct(mesh));
  EXPECT_LE(measured_sag(mesh, roof), 0.0101);
}

TEST(SurfaceMesh, RandomRationalSurfacesKeepTheSag) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 8; ++round) {
    const int p = 2 + round % 4, q = 5 - round % 4;
    std::vector<double> ku(p + 1, 0.0), kv(q + 1, 0.0);
    for (int k = 1; k < 4; ++k) ku.push_back(k), kv.push_back(k);
    ku.insert(ku.end(), p + 1, 4.0);
    kv.insert(kv.end(), q + 1, 4.0);
    const int m = p + 4, n = q + 4;
    std::vector<Vec3> points;
    std::vector<double> weights;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j) {
        points.push_back({i + 0.3 * uniform(random), j + 0.3 * uniform(random), 1.5 * uniform(random)});
        weights.push_back(1 + 0.7 * uniform(random));
      }
    const NurbsSurface surface(SplineAxis(p, ku, Extension::tangent), SplineAxis(q, kv, Extension::tangent), points,
                               weights);
    const double sag = round % 2 ? 0.05 : 0.005;
    const Mesh mesh = tessellate(surface, {sag, 0.5, {}});
    EXPECT_EQ(euler_characteristic(mesh), 1);
    EXPECT_LE(measured_sag(mesh, surface), 1.1 * sag);
  }
}

// Normals turn about such points however short the sides are; only what is near them becomes denser.
TEST(SurfaceMesh, SingularPointsAreNoReasonForMillionsOfTriangles) {
  const auto formula = [](const std::array<std::string, 3>& point) {
    return FormulaSurface(point_formulas(point, {"u", "v"}, Coordinates::cartesian), {{-1, 1}, {-1, 1}}, {});
  };
  const std::array<FormulaSurface, 3> surfaces{formula({"u*v", "u", "v^2"}),         // Whitney's umbrella
                                               formula({"u^2", "u^3", "v"}),         // a cuspidal edge
                                               formula({"u", "v^3 - u*v", "v^2"})};  // crosses itself up to a point
  for (const FormulaSurface& surface : surfaces)
    for (const double sag : {0.01, 1e-3, 1e-4}) {
      const Mesh mesh = tessellate(surface, {sag, 0.35, {}});
      EXPECT_LE(measured_sag(mesh, surface), 1.05 * sag);
      EXPECT_LE(mesh.triangles.size(), 40 / sag);
    }
}

FormulaSurface over_square(const std::string& height) {
  return {point_formulas({"u", "v", height}, {"u", "v"}, Coordinates::cartesian), {{-2, 2}, {-2, 2}}, {}};
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * glm::length(glm::cross(mesh.points[t.point[1]] - mesh.points[t.point[0]],
                                        mesh.points[t.point[2]] - mesh.points[t.point[0]]));
  return sum;
}

// Kinks that are no parameter lines: the mesh follows them.
TEST(SurfaceMesh, PlanesWithKinksNeedAFewTriangles) {
  // Each with its area: sqrt(2) above the kink v = 0.3 u and sqrt(1.09) below, half of the square each; sqrt(2.1369);
  // and a crossing of two, with slopes (+-c, 1) above and (0.3 +- c, 0) below.
  const double c = 0.3;
  const std::array<std::pair<std::string, double>, 3> heights{{
      {"max(v, 0.3*u)", 8 * std::sqrt(2) + 8 * std::sqrt(1.09)},
      {"abs(u - 0.37*v)", 16 * std::sqrt(2 + 0.37 * 0.37)},
      {"0.3*abs(u) + max(v, 0.3*u)", 8 * std::sqrt(2 + c * c) + (4 + 0.6) * std::sqrt(1 + 4 * c * c) + (4 - 0.6)},
  }};
  for (const auto& [height, area] : heights)
    for (const double sag : {0.01, 1e-4, 1e-6}) {
      const FormulaSurface surface = over_square(height);
      const Mesh mesh = tessellate(surface, {sag, 10 * kPi / 180, {}});
      EXPECT_LE(mesh.triangles.size(), 40u) << height;
      EXPECT_LE(measured_sag(mesh, surface), sag) << height;
      EXPECT_EQ(euler_characteristic(mesh), 1) << height;
      EXPECT_NEAR(area_of(mesh), area, 4 * sag) << height;
      expect_good_normals(mesh, 1 - 1e-6);
    }
}

TEST(SurfaceMesh, BentKinksGrowLikeSmoothSurfaces) {
  for (const std::string height :
       {"abs(u^2 + v^2 - 1.1)", "max(exp(-u^2 - v^2), 0.5) + 0.1*sin(3*u)", "max(sqrt(u + 2), 1 + 0.1*v)"}) {
    const FormulaSurface surface = over_square(height);
    for (const double sag : {0.01, 1e-3, 1e-4}) {
      const Mesh mesh = tessellate(surface, {sag, 20 * kPi / 180, {}});
      EXPECT_LE(mesh.triangles.size(), 20 / sag) << height;
      EXPECT_LE(measured_sag(mesh, surface), 1.05 * sag) << height;
      EXPECT_EQ(euler_characteristic(mesh), 1) << height;
    }
  }
}

// Kinks that run over the seam and into the poles of a closed surface: no cracks.
TEST(SurfaceMesh, KinksOfClosedSurfacesLeaveNoCracks) {
  const std::string radius = "(1 + 0.2*abs(sin(3*u + v)))";
  const FormulaSurface surface(point_formulas({radius + "*cos(v/2)*cos(u)", radius + "*cos(v/2)*sin(u)", "sin(v/2)"},
                                              {"u", "v"}, Coordinates::cartesian),
                               {{0, kTwoPi}, {-kPi, kPi}}, {true, false});
  for (const double sag : {0.01, 1e-3}) {
    const Mesh mesh = tessellate(surface, {sag, 0.35, {}});
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LE(measured_sag(mesh, surface), 1.1 * sag);
    EXPECT_LE(mesh.triangles.size(), 100 / sag);
  }
}

// A step leaves a gap: two plane rectangles, without a triangle between them.
TEST(SurfaceMesh, StepsHaveNoWalls) {
  const FormulaSurface surface = over_square("floor(0.25*u + 0.1*v + 0.03)");
  for (const double sag : {0.01, 1e-3}) {
    const Mesh mesh = tessellate(surface, {sag, 0.35, {}});
    for (const auto& t : mesh.triangles) {
      const double z = mesh.points[t.point[0]].z;
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(mesh.points[t.point[k]].z, z, 1e-12);
    }
    EXPECT_NEAR(area_of(mesh), 16, 1e-6);
    EXPECT_LE(mesh.triangles.size(), 5000u);
  }
}

TEST(SurfaceMesh, UnevenWeightsAndEdgesThatArePoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 6; ++round) {
    Grid<Vec3> net{4, 4, {}};
    std::vector<double> weights;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        // Every other one has two neighbouring sides that are one point.
        const bool is_point = round % 2 && (i == 0 || j == 3);
        net.values.push_back(is_point ? Vec3(0, 3, 0) : Vec3(i, j, uniform(random)));
        weights.push_back(std::pow(10, 2 * uniform(random)));
      }
    const NurbsSurface surface = bezier_surface(net, weights);
    const Mesh mesh = tessellate(surface, {0.02, 0.35, {}});
    EXPECT_LE(measured_sag(mesh, surface), 1.1 * 0.02) << round;
    EXPECT_LE(mesh.triangles.size(), 200000u) << round;
  }
}

TEST(SurfaceMesh, RingTorusOfTheBook) {
  // 45 x 23 cells where the diagonals may deviate by 1.9 sags; twice as many where they may not.
  const TorusSurface torus(Frame{}, 3, 1);
  const Mesh mesh = tessellate(torus, sag_only(0.01));
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_LE(measured_sag(mesh, torus), 0.01);
  EXPECT_LE(mesh.triangles.size(), 2 * 2070u + 200);
}

TEST(SurfaceMesh, SagAsAFunctionOfPlace) {
  const SphereSurface sphere(Frame{}, 1);
  TessellationTolerance tolerance{1, kPi, [](const Vec3& p) { return p.z > 0 ? 1e-3 : 1e-2; }};
  const Mesh mesh = tessellate(sphere, tolerance);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_LT(mesh.triangles.size(), tessellate(sphere, sag_only(1e-3)).triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 m = (mesh.points[t.point[0]] + mesh.points[t.point[1]] + mesh.points[t.point[2]]) / 3.0;
    EXPECT_LE(1 - glm::length(m), m.z > 0.1 ? 1.02e-3 : 1.02e-2);
  }
}

// A plane ring, and a part of it: no triangle leaves the plane, but chords leave out what lies behind the borders.
TEST(SurfaceMesh, BordersOfPlaneSurfacesKeepTheSag) {
  const auto polar = [](const auto& u, const auto& v) {
    using std::cos;
    using std::sin;
    return Triple{v * cos(u), v * sin(u), 0.0 * v};
  };
  for (const double turn : {kTwoPi, 3.0})
    for (const double inner : {0.0, 0.5})
      for (const double sag : {0.1, 1e-3, 1e-5}) {
        const tests::SurfaceOfFormula ring(polar, Rectangle{{0, turn}, {inner, 1}});
        const double missing = turn / 2 * (1 - inner * inner) - measure(tessellate(ring, sag_only(sag))).area.value;
        EXPECT_LE(std::abs(missing), turn * sag);
      }
}

TEST(SurfaceMesh, RefusesWhatCannotBeDone) {
  EXPECT_THROW(tessellate(Plane(Frame{}), sag_only(0.1)), std::invalid_argument);
  EXPECT_THROW(tessellate(SphereSurface(Frame{}, 1), sag_only(1e-12)), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::surface_mesh_test
