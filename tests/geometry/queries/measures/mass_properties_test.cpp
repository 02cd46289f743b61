// Lengths, areas, volumes and moments against closed forms: Golovanov 2016, 5.6 and 8.9-8.11, Pappus.
#include "geometry/queries/measures/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::geometry::mass_properties_test {
namespace {

constexpr double kExact = 1e-11;

void expect_near(const Measured& found, double exact) {
  EXPECT_NEAR(found.value, exact, kExact * std::abs(exact));
  // The stated error covers the true one, up to the last digits.
  EXPECT_LE(std::abs(found.value - exact), found.error + 1e-14 * std::abs(exact));
  EXPECT_LE(found.error, 1e-9 * std::abs(exact));
}

void expect_near(const Vec3& found, const Vec3& exact, double size) {
  EXPECT_LT(glm::length(found - exact), kExact * size);
}

TEST(MassProperties, LengthsOfCurves) {
  expect_near(measure(Circle(Frame{}, 2)).length, 4 * kPi);
  // Perimeter of the ellipse with the semi-axes 3 and 2 (complete elliptic integral).
  expect_near(measure(Ellipse(Frame{}, 3, 2)).length, 15.86543958929059);
  const CurveMeasures half = measure(Circle(Frame{}, 1, {0, kPi}));
  expect_near(half.centroid, {0, 2 / kPi, 0}, 1);
  const Measured back = arc_length(Circle(Frame{}, 1), 2, 0.5);
  EXPECT_NEAR(back.value, -1.5, 1e-13);
}

FormulaCurve graph(const std::string& y, const Interval& domain = {-1, 1}) {
  return FormulaCurve(point_formulas({"t", y, "0"}, {"t"}, Coordinates::cartesian), domain, false);
}

// Turns that are sharper than the nodes of a rule are apart: the claimed errors hold. The ellipse by its complete
// elliptic integral, the hairpin in closed form, the cubic by composite quadrature with 40 digits, the conic as its
// polygon.
TEST(MassProperties, LengthsOfCurvesWithSharpTurns) {
  const auto expect_length = [](const Curve& curve, long double length) {
    const CurveMeasures found = measure(curve);
    EXPECT_LE(std::abs(found.length.value - length), found.length.error) << static_cast<double>(length);
    const Interval t = curve.domain();
    const Measured along = arc_length(curve, t.lo, t.hi);
    EXPECT_LE(std::abs(along.value - length), along.error) << static_cast<double>(length);
    return found;
  };
  const CurveMeasures flat = expect_length(Ellipse(Frame(), 1e6, 1), 4000000.00002940360984L);
  EXPECT_NEAR(flat.length.value, 4000000.00002940360984, 4e-9);
  EXPECT_LT(glm::length(flat.centroid), flat.centroid_error);
  const FormulaCurve hairpin(point_formulas({"t^2", "1e-6*t", "0"}, {"t"}, Coordinates::cartesian), {-1, 1});
  EXPECT_NEAR(expect_length(hairpin, 2.00000000000785090246L).length.value, 2.00000000000785090246, 4e-15);
  const NurbsCurve loop = bezier_curve(std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {1e-5, 1, 0}, {1, 0, 0}});
  EXPECT_NEAR(expect_length(loop, 1.828425838081975532803L).length.value, 1.828425838081975532803, 4e-15);
  // Nearly all of it lies within the last digits of the parameter's ends.
  const std::vector<Vec3> corner{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  for (const auto& [weight, missing] : {std::pair(1e6, 1.19813882052e-6L), std::pair(1e18, 1.198140234736e-18L)})
    expect_length(bezier_curve(corner, std::vector<double>{1, weight, 1}), 2 * std::sqrt(2.0L) - missing);
}

// y = |x|^p over [-1, 1], by the substitution x = y^(1/p) where that is smoother. For p = 1/2, with x = y^2, the length
// is that of two arcs of a parabola, sqrt 5 + asinh(2)/2; for p = 3/2 twice (13^1.5 - 8)/27. The heights of the
// centroids and the length for p = 1/3 are integrals of smooth functions in 50 digits.
TEST(MassProperties, CurvesWithInfiniteSlopes) {
  const CurveMeasures cusp = measure(graph("abs(t)^1.5"));
  expect_near(cusp.length, 2 * (std::pow(13, 1.5) - 8) / 27);
  EXPECT_NEAR(cusp.centroid.y, 0.446513, 1e-6);
  EXPECT_NEAR(cusp.centroid.x, 0, 1e-12);
  const CurveMeasures root = measure(graph("sqrt(abs(t))"));
  expect_near(root.length, std::sqrt(5) + 0.5 * std::asinh(2.0));
  EXPECT_NEAR(root.centroid.y, 0.57363, 1e-5);
  expect_near(measure(graph("abs(t)^0.5")).length, std::sqrt(5) + 0.5 * std::asinh(2.0));
  // x = y^3: 2 int_0^1 sqrt(1 + 9 y^4) dy
  const auto arc = [](double y, std::span<double> f) { f[0] = 2 * std::sqrt(1 + 9 * y * y * y * y); };
  expect_near(measure(graph("cbrt(t)")).length, integrate(arc, 1, Interval(0, 1), {0, 1e-14}).value[0]);
  // Away from zero the rounding of the parameter takes some digits, and the error says how many.
  const Measured moved = measure(graph("sqrt(abs(t - 0.3))", {-0.7, 1.3})).length;
  EXPECT_NEAR(moved.value, std::sqrt(5) + 0.5 * std::asinh(2.0), moved.error);
  EXPECT_LE(moved.error, 1e-6);
  for (const char* infinite : {"1/(t - 0.1)", "log(abs(t - 0.1))", "1/(t - 0.1)^2"})
    EXPECT_THROW(measure(graph(infinite)), std::invalid_argument) << infinite;
}

// z = |x|^1.5 has the length of that curve for an area; z = sqrt(x^2 + y^2) sqrt 2 times that of the square.
TEST(MassProperties, SurfacesWithRootsOfZero) {
  const auto area = [](const std::string& z) {
    return measure(FormulaSurface(point_formulas({"u", "v", z}, {"u", "v"}, Coordinates::cartesian), {{-1, 1}, {-1, 1}},
                                  FormulaSurface::Closed{}))
        .area;
  };
  expect_near(area("abs(u)^1.5"), 4 * (std::pow(13, 1.5) - 8) / 27);
  expect_near(area("sqrt(u^2 + v^2)"), 4 * std::sqrt(2));
  expect_near(area("sqrt(abs(u))"), 2 * std::sqrt(5) + std::asinh(2.0));
}

// Derivatives that jump along curves askew to the parameter lines: a paraboloid, a cone and a disk cut out of the plane
// z = x over a plane, and a fold.
TEST(MassProperties, SurfacesWithCurvedCreases) {
  const auto measured = [](const std::string& z) {
    return measure(FormulaSurface(point_formulas({"u", "v", z}, {"u", "v"}, Coordinates::cartesian), {{-1, 1}, {-1, 1}},
                                  FormulaSurface::Closed{}));
  };
  const auto expect_within = [](const Measured& found, double exact) {
    EXPECT_LE(std::abs(found.value - exact), found.error);
    EXPECT_LE(found.error, 1e-6);
  };
  const double disk = kPi / 2;  // of the radius sqrt(1/2)
  const SurfaceMeasures cap = measured("max(0, 0.5 - u^2 - v^2)");
  expect_within(cap.area, 4 - disk + kPi / 6 * (std::pow(3, 1.5) - 1));
  EXPECT_LE(std::max(std::abs(cap.centroid.x), std::abs(cap.centroid.y)), cap.centroid_error);
  expect_within(measured("u if u^2 + v^2 < 0.5 else 0").area, 4 + (std::sqrt(2) - 1) * disk);
  expect_within(measured("max(0, 0.5 - hypot(u - 0.1, v))").area, 4 + (std::sqrt(2) - 1) * kPi / 4);
  expect_within(measured("abs(u - 0.3*v)").area, 4 * std::sqrt(2.09));
  // What is infinite stays so.
  for (const char* infinite : {"1/(u - 0.3*v - 0.07)", "max(0, 1/(u^2 + v^2 - 0.5))"})
    EXPECT_THROW(measured(infinite), std::invalid_argument) << infinite;
}

TEST(MassProperties, AreasOfSurfaces) {
  expect_near(measure(SphereSurface(Frame{}, 3)).area, 36 * kPi);
  const SurfaceMeasures half = measure(SphereSurface(Frame{}, 1, {{0, kTwoPi}, {0, 0.5 * kPi}}));
  expect_near(half.area, 2 * kPi);
  expect_near(half.centroid, {0, 0, 0.5}, 1);
}

TEST(MassProperties, BoxAtItsCorner) {
  const MassProperties found = measure(box(Frame{}, {1, 2, 3}));
  expect_near(found.volume, 6);
  expect_near(found.area, 22);
  expect_near(found.centroid, {0.5, 1, 1.5}, 1);
  expect_near(found.principal_moments, {2.5, 5, 6.5}, 10);
  const Mat3 corner = inertia_about(found, Vec3(0));
  expect_near(corner[0], {26, -3, -4.5}, 30);
  expect_near(corner[1], {-3, 20, -9}, 30);
  expect_near(corner[2], {-4.5, -9, 10}, 30);
  Vec3 moments;
  Mat3 axes;
  principal_moments(corner, moments, axes);
  expect_near(moments, {3.4132039467999142, 25.2530905607229815, 27.3337054924771150}, 30);
  EXPECT_NEAR(std::abs(glm::dot(axes[0], Vec3(0.23255647275, 0.49600132014, 0.83660036900))), 1, 1e-10);
  EXPECT_NEAR(glm::determinant(axes), 1, 1e-12);
}

TEST(MassProperties, PrincipalMomentsOfTheBook) {
  Vec3 moments;
  Mat3 axes;
  principal_moments(Mat3(Vec3(2, -1, 0), Vec3(-1, 2, -1), Vec3(0, -1, 2)), moments, axes);
  expect_near(moments, {2 - std::sqrt(2.0), 2, 2 + std::sqrt(2.0)}, 4);
  principal_moments(Mat3(Vec3(6, -1, -2), Vec3(-1, 5, -1), Vec3(-2, -1, 4)), moments, axes);
  expect_near(moments, {2.1048934840724693, 5.6027049307029095, 7.2924015852246217}, 8);
  principal_moments(Mat3(Vec3(5, -1, -1), Vec3(-1, 5, -1), Vec3(-1, -1, 5)), moments, axes);
  expect_near(moments, {3, 6, 6}, 6);
  EXPECT_NEAR(std::abs(glm::dot(axes[0], Vec3(1, 1, 1) / std::sqrt(3.0))), 1, 1e-12);
}

TEST(MassProperties, CylinderConesAndBall) {
  const Frame frame = frame_about({5, -3, 2}, {1, 2, 2});
  const double r = 1.5, h = 4;
  const MassProperties cylinder = measure(cylinder_body(frame, r, h));
  expect_near(cylinder.volume, kPi * r * r * h);
  expect_near(cylinder.area, kTwoPi * r * (r + h));
  expect_near(cylinder.centroid, frame.point({0, 0, h / 2}), 5);
  const double mass = kPi * r * r * h;
  expect_near(cylinder.principal_moments,
              {mass * r * r / 2, mass * (3 * r * r + h * h) / 12, mass * (3 * r * r + h * h) / 12}, 40);

  // Frustum r = 2, h = 3, half-angle -15 degrees.
  const double top = 2 + 3 * std::tan(-15 * kPi / 180);
  EXPECT_NEAR(top, 1.196152422706632, 1e-15);
  expect_near(measure(frustum(Frame{}, 2, top, 3)).volume, 24.57694782135417);

  const MassProperties cone = measure(frustum(Frame{}, 2, 0, 3));
  expect_near(cone.area, 35.2207174126371);
  expect_near(cone.volume, 12.5663706143592);
  expect_near(cone.centroid, {0, 0, 0.75}, 1);
  const Mat3 base = inertia_about(cone, Vec3(0));
  EXPECT_NEAR(base[2][2], 15.0796447372310, 1e-11);
  EXPECT_NEAR(base[0][0], 18.8495559215388, 1e-11);
  // The apex below.
  expect_near(measure(frustum(Frame{}, 0, 2, 3)).volume, 4 * kPi);

  const MassProperties ball_found = measure(ball(frame_about({100, 0, 0}, {0, 1, 1}), 2));
  expect_near(ball_found.volume, 32 * kPi / 3);
  expect_near(ball_found.area, 16 * kPi);
  expect_near(ball_found.centroid, {100, 0, 0}, 2);
}

TEST(MassProperties, TorusOfTheBook) {
  Frame frame;
  frame.origin = {1, 2, 3};
  const MassProperties found = measure(torus_body(frame, 3, 1));
  expect_near(found.area, 118.4352528130723);
  expect_near(found.volume, 59.21762640653615);
  expect_near(found.centroid, {1, 2, 3}, 1);
  const Mat3 origin = inertia_about(found, Vec3(0));
  expect_near(origin[0], {1073.3194786184677, -118.4352528130723, -177.6528792196085}, 1000);
  expect_near(origin[1], {-118.4352528130723, 895.6665993988593, -355.3057584392169}, 1000);
  expect_near(origin[2], {-177.6528792196085, -355.3057584392169, 873.4599894964082}, 1000);
}

// Coordinates of a million have ten digits less behind the point: the stated errors grow with them, and bound the true
// ones. What is nothing but that rounding ends soon.
TEST(MassProperties, FarFromTheOrigin) {
  const auto expect_bounded = [](const Measured& found, double exact, double most) {
    EXPECT_LE(std::abs(found.value - exact), found.error);
    EXPECT_LE(found.error, most);
  };
  for (const double away : {0.0, 1e3, 1e6, 1e9}) {
    const Vec3 at(away, -0.7 * away, 0.3 * away);
    const double most = 1e-11 + 1e-14 * away;
    const MassProperties block = measure(box(frame_from(at, {1, 2, 3}, {1, 0, 0}), {1, 2, 3}));
    expect_bounded(block.area, 22, 4 * most);
    expect_bounded(block.volume, 6, 4 * most);
    const MassProperties round = measure(ball(Frame{at}, 1));
    expect_bounded(round.area, 4 * kPi, 4 * most);
    expect_bounded(round.volume, 4 * kPi / 3, 4 * most);
    EXPECT_LE(glm::length(round.centroid - at), round.centroid_error);
    const MassProperties cylinder = measure(frustum(frame_from(at, {1, 2, 3}, {1, 0, 0}), 0.7, 0.7, 1.3));
    expect_bounded(cylinder.volume, kPi * 0.49 * 1.3, 4 * most);
    // A ring of a plane: two of the three moments are nothing but rounding along some of its lines.
    const auto plane = std::make_shared<Plane>(frame_from(at, {0.1, 0.2, 1}, {1, 0, 0}), Rectangle{{-2, 2}, {-2, 2}});
    const auto hole = std::make_shared<Circle>(Frame{}, 0.5), rim = std::make_shared<Circle>(Frame{}, 1);
    const Body ring = trimmed_surface(plane, {rim, hole});
    const SurfaceMeasures flat = measure_face(ring, 0);
    expect_bounded(flat.area, 0.75 * kPi, 4 * most);
    EXPECT_LE(glm::length(flat.centroid - at), flat.centroid_error);
  }
}

TEST(MassProperties, MeshesAreExactPolyhedra) {
  const Mesh cube = tessellate(box(Frame{Vec3(10, 20, 30)}, {1, 2, 3}), {});
  const MassProperties found = measure(cube);
  EXPECT_TRUE(found.closed);
  expect_near(found.volume, 6);
  expect_near(found.area, 22);
  expect_near(found.centroid, {10.5, 21, 31.5}, 1);
  expect_near(found.principal_moments, {2.5, 5, 6.5}, 10);
  // Independent of the origin because it is closed.
  const Mesh moved = transformed(cube, Affine::translation({10, 20, 30}));
  EXPECT_NEAR(measure(moved).volume.value, 6, 1e-12);
  // The error of a ball's volume falls with the sag (the counts of lines are whole, hence the room).
  const double exact = 4 * kPi / 3;
  const double coarse = exact - measure(tessellate(ball(Frame{}, 1), {1e-2, kPi, {}})).volume.value;
  const double fine = exact - measure(tessellate(ball(Frame{}, 1), {1e-4, kPi, {}})).volume.value;
  EXPECT_NEAR(coarse / fine, 100, 20);
}

}  // namespace
}  // namespace lekalo::geometry::mass_properties_test
