#include "geometry/curves/interpolation/local_interpolant.h"

#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::local_interpolant_test {
namespace {

const std::vector<Vec3> kNodes{{0, 0, 0}, {1, 2, 0.5}, {3, 1, -1}, {4, 4, 2}, {2, 5, 1}};
constexpr LocalKernel kKernels[] = {LocalKernel::cardinal, LocalKernel::linear_core, LocalKernel::quadratic};

// The kernels as sums over four nodes (Grezdov, Filippenko 2010, formula 3), written out.
std::array<long double, 4> weights(LocalKernel kernel, long double b, long double x) {
  const long double h10 = x * (1 - x) * (1 - x), h11 = -x * x * (1 - x), h01 = 3 * x * x - 2 * x * x * x;
  switch (kernel) {
    case LocalKernel::cardinal:
      return {-b / 2 * h10, 1 - h01 - b / 2 * h11, h01 + b / 2 * h10, b / 2 * h11};
    case LocalKernel::linear_core:
      return {-b / 2 * x * (1 - x) * (1 - x), 1 - x + b / 2 * x * (1 - x) * (2 - 3 * x),
              x + b / 2 * x * (1 - x) * (3 * x - 1), -b / 2 * x * x * (1 - x)};
    case LocalKernel::quadratic:
      break;
  }
  const long double shell = b / 4 * x * (1 - x);
  return {-shell, 1 - x + shell, x + shell, -shell};
}

TEST(LocalInterpolant, IsTheSumOverFourNodes) {
  for (const LocalKernel kernel : kKernels)
    for (const double beta : {-3.0, 0.0, 0.7, 1.0, 2.5}) {
      const NurbsCurve curve = local_interpolant(kNodes, true, kernel, beta, GhostNodes::quadratic, {0, 5});
      for (int cell = 0; cell < 5; ++cell)
        for (int k = 0; k <= 10; ++k) {
          const long double x = k / 10.0L;
          const auto w = weights(kernel, beta, x);
          Vec3 expected(0);
          for (int j = 0; j < 4; ++j) expected += static_cast<double>(w[j]) * kNodes[(cell + j + 4) % 5];
          EXPECT_LE(glm::length(curve.point(cell + static_cast<double>(x)) - expected), 2e-14);
        }
    }
}

TEST(LocalInterpolant, MeetsTheGeneralChecks) {
  for (const bool closed : {false, true})
    for (const LocalKernel kernel : kKernels) {
      const NurbsCurve curve = local_interpolant(kNodes, closed, kernel, 1.3, GhostNodes::linear, {-1, 2});
      checks::check_enclosures(curve, curve.domain());
      checks::check_nurbs(curve);
      checks::check_pieces(curve);
      checks::check_period(curve);
    }
}

// The first kernel is smooth for every beta, the others are not.
TEST(LocalInterpolant, JoinsSmoothlyWithTheCardinalKernel) {
  for (const LocalKernel kernel : kKernels) {
    const NurbsCurve curve = local_interpolant(kNodes, true, kernel, 0.4, GhostNodes::quadratic, {0, 5});
    double jump = 0;
    for (int knot = 1; knot < 5; ++knot)
      jump = std::max(jump, glm::length(curve.evaluate(next_down(knot), 1).d[1] - curve.evaluate(knot, 1).d[1]));
    if (kernel == LocalKernel::cardinal) {
      EXPECT_LE(jump, 1e-13);
    } else {
      EXPECT_GE(jump, 0.1);
    }
  }
}

TEST(LocalInterpolant, HasGhostsForFewNodes) {
  const std::vector<Vec3> two{{0, 0, 0}, {2, 4, 0}};
  const NurbsCurve line = local_interpolant(two, false, LocalKernel::cardinal, 1, GhostNodes::quadratic, {0, 1});
  EXPECT_LE(glm::length(line.point(0.3) - Vec3(0.6, 1.2, 0)), 1e-15);
}

// 4 tan(pi/2N) / sin(2 pi/N)
TEST(LocalInterpolant, KnowsTheValuesOfCircles) {
  for (int n = 3; n < 100; ++n) {
    EXPECT_NEAR(circle_beta(n), 4 * std::tan(kPi / (2 * n)) / std::sin(kTwoPi / n), 1e-13);
    EXPECT_NEAR(rose_beta(n) * sqr(std::sin(kPi / n)), -2, 1e-13);
  }
}

}  // namespace
}  // namespace lekalo::geometry::local_interpolant_test
