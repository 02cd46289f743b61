// Contours of surfaces with poles at both ends of a parameter, all in one piece, against closed forms: spheres and
// ellipsoids by formulas of every form, and a lemon, whose poles are tips.
#include <gtest/gtest.h>

#include <random>

#include "geometry/contour.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/isophote.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"
#include "geometry/transformed.h"

namespace lekalo::geometry::pole_contours_test {
namespace {

const Interval kRound{0, kTwoPi}, kLatitudes{-kPi / 2, kPi / 2}, kColatitudes{0, kPi};

SurfacePtr formula_surface(const std::array<std::string, 3>& point, const Rectangle& domain,
                           FormulaSurface::Closed closed, Coordinates coordinates = Coordinates::cartesian) {
  return std::make_shared<FormulaSurface>(point_formulas(point, {"u", "v"}, coordinates), domain, closed);
}

// The unit sphere: with poles in v and in u, by latitudes and colatitudes.
std::vector<SurfacePtr> spheres() {
  return {
      formula_surface({"cos(u)*cos(v)", "sin(u)*cos(v)", "sin(v)"}, {kRound, kLatitudes}, {true, false}),
      formula_surface({"cos(u)*sin(v)", "sin(u)*sin(v)", "cos(v)"}, {kRound, kColatitudes}, {true, false}),
      formula_surface({"cos(v)*cos(u)", "sin(v)*cos(u)", "sin(u)"}, {kLatitudes, kRound}, {false, true}),
      formula_surface({"1", "u", "v"}, {kRound, kLatitudes}, {true, false}, Coordinates::spherical),
  };
}

// Along the axis, hardly off the poles, anywhere, and across the axis, where the outline runs through both.
const std::vector<Vec3> kViews{{0, 0, 1}, {1, 1, 1e-5}, {6, -9, 5}, {1, 0, 0}, {1, 0.3, 0}};

double length_of(const Contours& found) {
  double sum = 0;
  for (const Contour& one : found.branches) sum += contour_length(one).value;
  return sum;
}

// One closed curve of this length in the plane.
void check_loop(const Contours& found, const Vec3& normal, double height, double length) {
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.points.empty());
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  EXPECT_NEAR(length_of(found), length, 1e-11 * length);
  const Curve& curve = *found.branches[0].curve;
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(glm::dot(curve.point(curve.domain().lo + curve.domain().width() * (k + 0.3) / 20), normal), height,
                1e-12);
}

TEST(PoleContours, OutlinesOfSpheresAreCircles) {
  constexpr double kEye = 1.7;
  for (const SurfacePtr& ball : spheres())
    for (const Vec3& view : kViews) {
      SCOPED_TRACE(testing::Message() << view.x << " " << view.y << " " << view.z);
      const Vec3 along = glm::normalize(view);
      check_loop(silhouette(ball, {false, view}), along, 0, kTwoPi);
      check_loop(silhouette(ball, {true, kEye * along}), along, 1 / kEye, kTwoPi * std::sqrt(1 - 1 / sqr(kEye)));
    }
}

TEST(PoleContours, IsophotesOfSpheresAreCircles) {
  const double angle = 1.0;
  for (const SurfacePtr& ball : spheres())
    // The second runs through a pole.
    for (const Vec3& light : {glm::normalize(Vec3(1, 2, 2)), Vec3(std::sin(angle), 0, std::cos(angle))}) {
      const double side = glm::dot(ball->normal(0.3, 0.3), ball->point(0.3, 0.3));
      check_loop(isophote(ball, light, angle), light, side * std::cos(angle), kTwoPi * std::sin(angle));
    }
}

// The ellipsoid A s, |s| = 1, has the normal A^-T s there: seen along d the outline is s . A^-1 d = 0, from the eye e
// it is s . A^-1 e = 1, circles of the sphere.
TEST(PoleContours, OutlinesOfEllipsoidsAreImagesOfCircles) {
  const glm::dmat3 a = {{2, 0, 0}, {0.4, 1, 0.3}, {0, -0.2, 0.7}};
  const glm::dmat3 inverse = glm::inverse(a);
  // The sum is exact but for rounding: the length of a smooth closed curve.
  const auto length_of_image = [&](const Vec3& normal, double height) {
    const Vec3 n = glm::normalize(normal);
    const Vec3 x = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    const Vec3 y = glm::cross(n, x);
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double t = kTwoPi * k / kSteps;
      sum += glm::length(a * (std::cos(t) * y - std::sin(t) * x));
    }
    return std::sqrt(1 - sqr(height / glm::length(normal))) * kTwoPi / kSteps * sum;
  };
  const SurfacePtr ellipsoid = transformed(spheres()[0], {a, Vec3(0)});
  for (const Vec3& view : kViews) {
    SCOPED_TRACE(testing::Message() << view.x << " " << view.y << " " << view.z);
    // It runs through the poles where that of the sphere, seen along `view`, does.
    const Vec3 along = a * view, normal = glm::transpose(inverse) * view;
    check_loop(silhouette(ellipsoid, {false, along}), normal, 0, length_of_image(view, 0));
    check_loop(silhouette(ellipsoid, {true, 4.0 * along}), normal, 0.25, length_of_image(4.0 * view, 1));
  }
}

// The lemon (sin v cos u, sin v sin u, v) has the normal (cos u, sin u, -cos v). Interaction along (1, 0, k) its
// outline is cos u = k cos v: two curves from tip to tip for |k| < 1, else one about the middle.
TEST(PoleContours, OutlinesOfALemonRunThroughItsTips) {
  const SurfacePtr lemon =
      formula_surface({"cos(u)*sin(v)", "sin(u)*sin(v)", "v"}, {kRound, kColatitudes}, {true, false});
  for (const double k : {0.0, 0.3, -0.95, 1.05, 3.0}) {
    SCOPED_TRACE(k);
    const Contours found = silhouette(lemon, {false, {1, 0, k}});
    EXPECT_TRUE(found.complete);
    const bool through_tips = std::abs(k) < 1;
    ASSERT_EQ(found.branches.size(), through_tips ? 2u : 1u);
    for (const Contour& branch : found.branches) {
      EXPECT_EQ(branch.closed, !through_tips);
      const Interval t = branch.curve->domain();
      for (int i = 0; i <= 20; ++i) {
        const Vec3 p = branch.curve->point(t.lo + t.width() * i / 20);
        EXPECT_NEAR(p.x, k * std::cos(p.z) * std::sin(p.z), 1e-12);
        EXPECT_NEAR(sqr(p.x) + sqr(p.y), sqr(std::sin(p.z)), 1e-12);
      }
      if (through_tips) {
        EXPECT_NEAR(std::abs(branch.curve->point(t.lo).z - branch.curve->point(t.hi).z), kPi, 1e-12);
      }
    }
  }
}

// Triangles that turn both sides to the viewer have an outline, or it is said that one is missing; plane ones have
// none.
TEST(PoleContours, TrianglesThatShowBothSidesHaveAnOutline) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int of_one_side = 0, of_both = 0;
  for (int set = 0; set < 30; ++set) {
    const int degree = 1 + set % 3;
    TriangularNet net{degree, {}};
    each_index(degree, [&](int i, int j, int) {
      const double w = set % 2 == 0 ? 1 : 1.5 + uniform(random);
      net.points.push_back(w * Vec4(i + 0.2 * uniform(random), j + 0.2 * uniform(random), 3 * uniform(random), 1));
    });
    const auto triangle = std::make_shared<BezierTriangle>(net);
    const bool central = set % 3 == 0;
    const Vec3 direction = glm::normalize(Vec3(uniform(random), uniform(random), 1.2));
    const ViewOf view{central, central ? 9.0 * direction : direction};
    bool front = false, back = false;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j) {
        const SurfaceJet jet = triangle->evaluate_over_triangle({i / 40.0, j / 40.0}, 1);
        const Vec3 sight = central ? jet.point() - view.direction_or_eye : view.direction_or_eye;
        const double side = glm::dot(glm::cross(jet.du(), jet.dv()), sight);
        front = front || side < 0;
        back = back || side > 0;
      }
    const Contours found = silhouette(triangle, view);
    if (front && back) {
      EXPECT_TRUE(!found.branches.empty() || !found.complete) << set;
    }
    (front && back ? of_both : of_one_side) += 1;
    if (degree == 1) {
      EXPECT_TRUE(found.branches.empty()) << set;
    }
  }
  EXPECT_GT(of_one_side, 8);
  EXPECT_GT(of_both, 5);
}

}  // namespace
}  // namespace lekalo::geometry::pole_contours_test
