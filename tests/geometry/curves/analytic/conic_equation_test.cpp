#include "geometry/curves/analytic/conic_equation.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/queries/quadrics/conic_of_curve.h"

namespace lekalo::geometry::conic_equation_test {
namespace {

using Kind = CanonicalConic::Kind;

Frame random_frame(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  return frame_from(10.0 * vector(), vector(), vector());
}

void expect_same(const std::optional<CanonicalConic>& found, Kind kind, const Frame& frame, double a, double b) {
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, kind);
  EXPECT_NEAR(found->a, a, 1e-7 * a);
  if (kind != Kind::parabola) {
    EXPECT_NEAR(found->b, b, 1e-7 * a);
  }
  EXPECT_LT(glm::length(found->frame.origin - frame.origin), 1e-6 * a);
  EXPECT_NEAR(std::abs(glm::dot(found->frame.x, frame.x)), 1, 1e-7);
}

// The curves' own frames come back from their rational forms, wherever they lie.
TEST(ConicEquation, finds_axes_of_known_conics) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  for (int k = 0; k < 50; ++k) {
    const Frame frame = random_frame(random);
    const double b = uniform(random), a = b + uniform(random);
    expect_same(conic_of(Ellipse(frame, a, b, {0.3, 0.3 + 2 * uniform(random)})), Kind::ellipse, frame, a, b);
    expect_same(conic_of(Hyperbola(frame, a, b, {-0.4, uniform(random)})), Kind::hyperbola, frame, a, b);
    expect_same(conic_of(Parabola(frame, a, {-0.4, uniform(random)})), Kind::parabola, frame, a, 0);
  }
}

TEST(ConicEquation, pencils_pass_through_their_points) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Frame plane = random_frame(random);
  for (int k = 0; k < 50; ++k) {
    std::array<Vec3, 5> p;
    for (Vec3& point : p) point = plane.point({uniform(random), uniform(random), 0});
    const std::array<Vec3, 4> four{p[0], p[1], p[2], p[3]};
    const ConicEquation conic = pencil_member(plane, four, pencil_number(plane, four, p[4]));
    double size = 0;
    for (int i = 0; i < 3; ++i) size += glm::length(conic.q[i]);
    for (const Vec3& point : p) {
      const Vec3 local = plane.to_local_point(point), x(local.x, local.y, 1);
      EXPECT_LT(std::abs(glm::dot(x, conic.q * x)), 1e-12 * size);
    }
  }
}

TEST(ConicEquation, axes_point_forward) {
  const std::array<Vec3, 4> p{Vec3(0, 0, 0), Vec3(-3, 0, 0), Vec3(0, -1, 0), Vec3(-3, -1, 0)};
  const Frame plane = plane_of(p, "points");
  const auto ellipse = canonical(pencil_member(plane, p, 0.7));
  ASSERT_TRUE(ellipse);
  EXPECT_GT(ellipse->frame.x.x + ellipse->frame.x.y, 0);
  const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  EXPECT_EQ(canonical(pencil_member(plane_of(square, "points"), square, 0.5))->frame.x, Vec3(1, 0, 0));
}

TEST(ConicEquation, lines_and_points_are_none) {
  const Frame plane;
  const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  EXPECT_FALSE(canonical(pencil_member(plane, square, 0)));
  EXPECT_FALSE(canonical(pencil_member(plane, square, 1)));
  EXPECT_TRUE(canonical(pencil_member(plane, square, 0.5)));
  EXPECT_FALSE(canonical({plane, Mat3(1.0)}));
}

}  // namespace
}  // namespace lekalo::geometry::conic_equation_test
