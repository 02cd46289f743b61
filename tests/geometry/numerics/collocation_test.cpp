#include "geometry/numerics/collocation.h"

#include <gtest/gtest.h>

namespace lekalo::geometry::collocation_test {
namespace {

using State = std::array<double, 2>;

double polynomial(const std::array<double, 17>& powers, double x) {
  double sum = 0;
  for (size_t k = powers.size(); k-- > 0;) sum = sum * x + powers[k];
  return sum;
}

TEST(Collocation, FollowsAnOscillationToRounding) {
  const auto step = collocate<2>({0, 1}, 1.5, [](const State& y) { return std::optional(State{y[1], -y[0]}); });
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->end[0], std::sin(1.5), 1e-15);
  EXPECT_NEAR(step->end[1], std::cos(1.5), 1e-15);
  const auto powers = step->powers(0);
  for (double x = -1; x <= 1; x += 0.01) EXPECT_NEAR(polynomial(powers, x), std::sin(0.75 * (1 + x)), 1e-15);
  EXPECT_LE(step->tail[0], 1e-14);
}

TEST(Collocation, ItsTailTellsTheError) {
  // y' = 1 + y^2 from 0: tan t, whose pole is at pi/2.
  const auto tangent = [](const std::array<double, 1>& y) { return std::optional(std::array{1 + y[0] * y[0]}); };
  for (const double h : {0.3, 0.6, 0.8}) {
    const auto step = collocate<1>({0.0}, h, tangent);
    ASSERT_TRUE(step);
    EXPECT_LE(std::abs(step->end[0] - std::tan(h)), step->tail[0] + 1e-15) << h;
  }
}

TEST(Collocation, IsExactForPolynomialsOfItsDegree) {
  const auto step = collocate<2>({0, 0}, 1, [](const State& y) {
    return std::optional(State{1, 16 * std::pow(y[0], 15)});
  });
  ASSERT_TRUE(step);
  for (size_t j = 0; j < 16; ++j) EXPECT_NEAR(step->states[j][1], std::pow(step->states[j][0], 16), 4e-15);
  EXPECT_NEAR(step->end[1], 1, 4e-15);
}

TEST(Collocation, EndsWhereThereIsNoRate) {
  const auto step = collocate<1>({0.0}, 1, [](const std::array<double, 1>& y) {
    return y[0] < 0.5 ? std::optional(std::array{1.0}) : std::nullopt;
  });
  EXPECT_FALSE(step);
}

}  // namespace
}  // namespace lekalo::geometry::collocation_test
