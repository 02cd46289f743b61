#include <gtest/gtest.h>

#include <cmath>

#include "geometry/expression/expression.h"
#include "geometry/expression/function_list.h"
#include "geometry/numerics/jet.h"

namespace lekalo::geometry::expression_blocks_test {
namespace {

Expression bound(const char* text, std::vector<Expression::Variable> variables = {},
                 std::vector<Expression::Constant> constants = {}) {
  auto parsed = Expression::parse(text);
  if (const auto* error = std::get_if<ExpressionError>(&parsed)) throw std::invalid_argument(error->message);
  Expression expression = std::get<Expression>(parsed);
  if (const auto error = expression.bind(variables, constants)) throw std::invalid_argument(error->message);
  return expression;
}

std::string message_of(const char* text, std::vector<Expression::Variable> variables = {}) {
  try {
    bound(text, variables);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ExpressionSums, are_written_out) {
  EXPECT_EQ(bound("sum(i, 1, 10, i^2)")(), 385);
  EXPECT_EQ(bound("1 + 2*sum(i, 0, n, binom(n, i)) - 1", {}, {{"n", 6}})(), 128);
  EXPECT_EQ(bound("sum(i, 3, 2, 1/0)")(), 0);
  EXPECT_EQ(bound("sum(i, 1, 3, sum(j, 1, i, i*j))")(), 25);
  EXPECT_EQ(bound("sum(i, 1, 2, i) + sum(i, 1, 3, i)")(), 9);
  // Taylor's sine with its derivatives.
  const Expression series = bound("sum(k, 0, 12, (-1)^k*t^(2*k + 1)/factorial(2*k + 1))", {{"t"}});
  const auto jet = series(Jet<double, 3>::variable(1.2)), sine = sin(Jet<double, 3>::variable(1.2));
  for (int k = 0; k <= 3; ++k) EXPECT_NEAR(jet.c[k], sine.c[k], 1e-14);
  EXPECT_TRUE(series(Interval(1, 1.5)).contains(std::sin(1.25)));
}

TEST(ExpressionIntegrals, follow_their_ends_and_variables) {
  EXPECT_NEAR(bound("integral(x, 0, 1, exp(-x^2))")(), 0.7468241328124270, 1e-15);
  const Expression sine = bound("integral(x, 0, t, cos(x))", {{"t"}});
  const auto jet = sine(Jet<double, 4>::variable(2.0)), exact = sin(Jet<double, 4>::variable(2.0));
  for (int k = 0; k <= 4; ++k) EXPECT_NEAR(jet.c[k], exact.c[k], 1e-14);
  EXPECT_TRUE(sine(Interval(1.99, 2.01)).contains(std::sin(2.0)));
  // Of a variable inside: the integral of x^t from 0 to 1 about t = 3 is 1/(t + 1).
  const auto power = bound("integral(x, 0, 1, x^t)", {{"t"}})(Jet<double, 1>::variable(3));
  EXPECT_NEAR(power.c[0], 0.25, 1e-14);
  EXPECT_NEAR(power.c[1], -1.0 / 16, 1e-10);
  EXPECT_NEAR(bound("integral(x, 0, 1, integral(v, 0, x, v))")(), 1.0 / 6, 1e-15);
}

TEST(ExpressionBlocks, errors) {
  EXPECT_EQ(message_of("sum(i, 1, t, i)", {{"t"}}), "a sum runs from one whole number to another");
  EXPECT_EQ(message_of("sum(i, 1, 2.5, i)"), "a sum runs from one whole number to another");
  EXPECT_EQ(message_of("sum(i, 1, 1e6, i)"), "a sum runs from one whole number to another");
  EXPECT_EQ(message_of("sum(1, 1, 2, 3)"), "sum begins with the name of its counter");
  EXPECT_EQ(message_of("integral(x, 1, 2)"), "integral takes 4 arguments");
  EXPECT_EQ(message_of("sum(i, 1, 2, i, i)"), "sum takes 4 arguments");
  EXPECT_EQ(message_of("sum(i, 1, 2, j)"), "unknown name 'j'");
  EXPECT_EQ(message_of("sum(i, 1, 900, sum(j, 1, 900, i*j))"), "the formula has too many operations");
  EXPECT_EQ(message_of("sum + 1"), "the function 'sum' needs its arguments in parentheses");
}

TEST(Expression, puts_formulas_into_formulas) {
  const Expression outer = bound("s^2 + v", {{"s"}, {"v"}});
  const std::vector<Expression> inner{bound("sin(t)", {{"t"}}), bound("2*t", {{"t"}})};
  const Expression both = outer.of(inner);
  EXPECT_DOUBLE_EQ(both(0.5), std::sin(0.5) * std::sin(0.5) + 1);
  EXPECT_NEAR(both(Jet<double, 1>::variable(0.5)).c[1], std::sin(1.0) + 2, 1e-15);
}

TEST(Expression, every_function_is_described) {
  for (const std::string_view name : function_names()) {
    bool found = false;
    for (const std::string_view line : function_descriptions())
      found = found || line.starts_with(std::string(name) + "(");
    EXPECT_TRUE(found) << name;
  }
  EXPECT_EQ(function_names().size(), function_descriptions().size());
}

TEST(Expression, mixes_by_a_weight) {
  EXPECT_EQ(bound("lerp(2, 6, 0.25)")(), 3);
  EXPECT_EQ(bound("binom(5, 2)")(), 10);
  EXPECT_EQ(bound("factorial(5)")(), 120);
  EXPECT_TRUE(std::isnan(bound("factorial(-1)")()));
  EXPECT_EQ(message_of("lerp(2, 6, 30 deg)"), "lerp takes a plain number, not an angle");
}

}  // namespace
}  // namespace lekalo::geometry::expression_blocks_test
