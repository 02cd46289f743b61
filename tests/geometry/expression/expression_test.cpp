// Expressions against hand values, against the same formulas in C++ over jets and intervals, and every error message.
#include "geometry/expression/expression.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace lekalo::geometry::expression_test {
namespace {

constexpr double kPi = std::numbers::pi;

Expression parsed(std::string_view text) {
  auto result = Expression::parse(text);
  if (const auto* error = std::get_if<ExpressionError>(&result)) {
    ADD_FAILURE() << text << ": " << error->message;
    return {};
  }
  return std::get<Expression>(std::move(result));
}

Expression bound(std::string_view text, std::vector<Expression::Variable> variables,
                 std::vector<Expression::Constant> constants = {}) {
  Expression result = parsed(text);
  const auto error = result.bind(variables, constants);
  EXPECT_FALSE(error) << text << ": " << error->message;
  return result;
}

double number(std::string_view text) { return parsed(text)(); }

double angle(std::string_view text) {
  Expression e = parsed(text);
  const auto error = e.convert_to_angle();
  EXPECT_FALSE(error) << text << ": " << error->message;
  return e();
}

TEST(Expression, numbers) {
  EXPECT_EQ(number("12"), 12);
  EXPECT_EQ(number(" 0.5 "), 0.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("1e-3"), 0.001);
  EXPECT_EQ(number("1E+3"), 1000);
  EXPECT_EQ(number("0"), 0);
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("-0.25"), -0.25);
}

TEST(Expression, operators_and_their_order) {
  EXPECT_EQ(number("1 + 2*3"), 7);
  EXPECT_EQ(number("(1 + 2)*3"), 9);
  EXPECT_EQ(number("8/4/2"), 1);
  EXPECT_EQ(number("8 - 4 - 2"), 2);
  EXPECT_EQ(number("2^3^2"), 512);
  EXPECT_EQ(number("-2^2"), -4);
  EXPECT_EQ(number("2^-1"), 0.5);
  EXPECT_EQ(number("(-2)^3"), -8);
  EXPECT_EQ(number("4^0.5"), 2);
  EXPECT_EQ(number("--3"), 3);
  EXPECT_EQ(number("+3 - -3"), 6);
  EXPECT_EQ(number("2*-3"), -6);
  EXPECT_EQ(number("2^20"), 1048576);
  EXPECT_EQ(number("2^(1+1)"), 4);
}

TEST(Expression, conditions) {
  EXPECT_EQ(number("1 if 2 > 1 else 3"), 1);
  EXPECT_EQ(number("1 if 2 < 1 else 3"), 3);
  EXPECT_EQ(number("1 if 2 < 1 else 2 if 2 < 2 else 3"), 3);
  EXPECT_EQ(number("1 if 1 <= 1 and 2 >= 3 or not 1 == 2 else 0"), 1);
  EXPECT_EQ(number("1 if not (1 == 1 or 1 == 2) else 0"), 0);
  EXPECT_EQ(number("1 if 1 != 1 else 0"), 0);
  EXPECT_EQ(number("2 + (1 if 1 > 0 else 5)*3"), 5);
  const Expression condition = bound("a > -b", {{"a"}, {"b"}});
  EXPECT_EQ(condition.measure(), Measure::truth);
  EXPECT_EQ(condition(1.0, 2.0), 1.0);
  EXPECT_EQ(condition(-3.0, 2.0), 0.0);
}

TEST(Expression, functions) {
  EXPECT_DOUBLE_EQ(number("sin(pi/6)"), 0.5);
  EXPECT_DOUBLE_EQ(number("cos(60 deg)"), 0.5);
  EXPECT_DOUBLE_EQ(number("tan(pi/4)"), 1);
  EXPECT_DOUBLE_EQ(number("exp(1)"), std::numbers::e);
  EXPECT_DOUBLE_EQ(number("log(exp(2))"), 2);
  EXPECT_DOUBLE_EQ(number("log10(1000)"), 3);
  EXPECT_DOUBLE_EQ(number("sqrt(2)^2"), 2);
  EXPECT_DOUBLE_EQ(number("cbrt(-27)"), -3);
  EXPECT_DOUBLE_EQ(number("sinh(1) + cosh(1)"), std::numbers::e);
  EXPECT_DOUBLE_EQ(number("tanh(atanh(0.3))"), 0.3);
  EXPECT_DOUBLE_EQ(number("sinh(asinh(2))"), 2);
  EXPECT_DOUBLE_EQ(number("cosh(acosh(2))"), 2);
  EXPECT_EQ(number("abs(-3)"), 3);
  EXPECT_EQ(number("sign(-3) + sign(0)"), -1);
  EXPECT_EQ(number("floor(-1.5)"), -2);
  EXPECT_EQ(number("ceil(-1.5)"), -1);
  EXPECT_EQ(number("round(2.5)"), 3);
  EXPECT_EQ(number("min(3, 1, 2)"), 1);
  EXPECT_EQ(number("max(3, 1, 5, 2)"), 5);
  EXPECT_EQ(number("hypot(3, 4)"), 5);
  EXPECT_EQ(number("hypot(2, 3, 6)"), 7);
  EXPECT_EQ(number("mod(7, 3)"), 1);
  EXPECT_EQ(number("mod(-7, 3)"), 2);
  EXPECT_EQ(number("mod(7, -3)"), -2);
  EXPECT_EQ(number("clamp(5, 0, 1)"), 1);
  EXPECT_EQ(number("clamp(-5, 0, 1)"), 0);
}

TEST(Expression, angles) {
  EXPECT_EQ(number("180 deg"), kPi);
  EXPECT_EQ(number("90deg"), kPi / 2);
  EXPECT_EQ(number("-360 deg"), -2 * kPi);
  EXPECT_EQ(number("0.25 turn"), kPi / 2);
  EXPECT_EQ(number("1.2 rad"), 1.2);
  EXPECT_DOUBLE_EQ(number("30 deg + 0.5 rad"), kPi / 6 + 0.5);
  EXPECT_EQ(number("180 deg*2/4"), kPi / 2);
  EXPECT_EQ(number("2*(45 deg)"), kPi / 2);
  EXPECT_DOUBLE_EQ(number("(1 + 2) deg"), kPi / 60);
  EXPECT_EQ(number("pi rad"), kPi);
  EXPECT_EQ(number("sqrt(4) rad"), 2);
  EXPECT_EQ(number("90 deg/(1 deg)"), 90);
  EXPECT_EQ(number("abs(-90 deg)"), kPi / 2);
  EXPECT_EQ(number("90 deg if 30 deg > 0 else 0"), kPi / 2);
  EXPECT_NEAR(number("mod(370 deg, 360 deg)"), kPi / 18, 1e-15);
  EXPECT_EQ(parsed("2*asin(1)").measure(), Measure::angle);
  EXPECT_EQ(parsed("cos(asin(1))").measure(), Measure::plain);
  EXPECT_EQ(parsed("90 deg/(1 deg)").measure(), Measure::plain);
  EXPECT_EQ(parsed("atan2(1, 0)").measure(), Measure::angle);
  EXPECT_EQ(parsed("0").measure(), Measure::plain);
}

TEST(Expression, plain_numbers_in_an_angle_field_are_degrees) {
  EXPECT_EQ(angle("180"), kPi);
  EXPECT_EQ(angle("360*3/12"), kPi / 2);
  EXPECT_EQ(angle("1 rad"), 1);
  EXPECT_EQ(angle("asin(1)"), kPi / 2);
  EXPECT_DOUBLE_EQ(angle("90*cos(pi/3)"), kPi / 4);  // the pi is spent
  Expression law = bound("90*s", {{"s"}});
  ASSERT_FALSE(law.convert_to_angle());
  EXPECT_EQ(law(2.0), kPi);
  EXPECT_EQ(law(Jet<double, 1>::variable(2.0)).derivative(1), 90 / 180.0 * kPi);
  Expression in_degrees = bound("180 deg*s", {{"s"}});
  ASSERT_FALSE(in_degrees.convert_to_angle());
  EXPECT_EQ(in_degrees(1.0), kPi);
}

TEST(Expression, names_and_binding) {
  Expression e = parsed("a + b*t^2 - a");
  EXPECT_EQ(e.names(), (std::vector<std::string>{"a", "b", "t"}));
  EXPECT_FALSE(e.is_constant());
  ASSERT_FALSE(e.bind(std::vector<Expression::Variable>{{"t"}}, std::vector<Expression::Constant>{{"b", 3}, {"a", 1}}));
  EXPECT_EQ(e(2.0), 12);
  ASSERT_FALSE(e.bind(std::vector<Expression::Variable>{{"b"}, {"a"}, {"t"}}));
  EXPECT_EQ(e(2.0, 7.0, 3.0), 18);
  EXPECT_EQ(e.text(), "a + b*t^2 - a");
  const Expression turned = bound("cos(phi)", {}, {{"phi", kPi / 3, Measure::angle}});
  EXPECT_DOUBLE_EQ(turned(), 0.5);
  Expression half = bound("half", {}, {{"half", kPi / 2, Measure::plain, true}});
  EXPECT_TRUE(half.convert_to_angle());  // the parameter was written with pi
}

// The same formula in C++ for every number type.
template <class T>
T by_hand(const T& u, const T& v) {
  using std::exp, std::sin, std::sqrt, std::atan2, std::cos, std::abs;
  return exp(u * v) * sin(2.0 * u) / (1.0 + u * u) + sqrt(v + 3.0) * atan2(v, u + 2.0) - abs(cos(v) - 2.0);
}
constexpr std::string_view kByHand =
    "exp(u*v)*sin(2*u)/(1 + u^2) + sqrt(v + 3)*(atan2(v, u + 2)/(1 rad)) - abs(cos(v) - 2)";

TEST(Expression, jets_and_intervals_are_those_of_the_formula) {
  const Expression e = bound(kByHand, {{"u"}, {"v"}});
  EXPECT_DOUBLE_EQ(e(0.3, 0.4), by_hand(0.3, 0.4));
  const auto jet = e(Jet2<double, 4>::u_variable(0.3), Jet2<double, 4>::v_variable(0.4));
  const auto expected = by_hand(Jet2<double, 4>::u_variable(0.3), Jet2<double, 4>::v_variable(0.4));
  for (int k = 0; k < 15; ++k) EXPECT_NEAR(jet.c[k], expected.c[k], 1e-14) << k;
  const auto line = e(Jet<double, 6>::variable(0.3), Jet<double, 6>(0.4));
  for (int k = 0; k <= 4; ++k) EXPECT_NEAR(line.c[k], (jet.c[Jet2<double, 4>::index(k, 0)]), 1e-14) << k;
  const auto box = e(Jet2<Interval, 2>::u_variable({0.29, 0.31}), Jet2<Interval, 2>::v_variable({0.39, 0.41}));
  for (int k = 0; k < 6; ++k) EXPECT_TRUE(box.c[k].contains(jet.c[k])) << k;
  EXPECT_LT(box.c[0].width(), 0.3);
  EXPECT_TRUE(e(Interval(0.2, 0.4), Interval(0.3, 0.5)).contains(e(0.25, 0.45)));
}

// All operations that a program treats in a way of its own: with constants on either side, powers, sines with cosines.
TEST(Expression, programs_of_several_formulas_share_their_parts) {
  const std::vector<std::string> texts{"sin(u)*cos(u) + cos(v)/sin(v) + 2*sin(2*u) - cos(2*u)",
                                       "3 - u*v + (u*v)^2 - (v*u)^3/5 + (u + v)^-2 + v/4 + 4/v - 2",
                                       "(sin(u) + 1)^5*2^3 - pi*cos(v + pi/2) + u*u + (v - 2)*(1 - 0.5*u)",
                                       "7*2 + 0*3"};
  std::vector<Expression> formulas;
  for (const std::string& text : texts) formulas.push_back(bound(text, {{"u"}, {"v"}}));
  const FormulaProgram program(formulas);
  const double u = 0.7, v = 0.4, s = std::sin(u), c = std::cos(u), w = u * v;
  const std::array<double, 4> expected{
      s * c + std::cos(v) / std::sin(v) + 2 * std::sin(2 * u) - std::cos(2 * u),
      3 - w + w * w - w * w * w / 5 + 1 / ((u + v) * (u + v)) + v / 4 + 4 / v - 2,
      std::pow(s + 1, 5) * 8 - kPi * std::cos(v + kPi / 2) + u * u + (v - 2) * (1 - 0.5 * u), 14};
  std::array<double, 4> values{};
  program.evaluate(std::span<const double>(std::array{u, v}), std::span<double>(values));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(values[k], expected[k], 1e-13) << k;
  using Pair = Jet2<double, 1>;
  std::array<Gradient<double>, 4> gradients;
  std::array<Interval, 4> boxes;
  program.evaluate(
      std::span<const Gradient<double>>(std::array{Gradient<double>::variable(u, 0), Gradient<double>::variable(v, 2)}),
      std::span<Gradient<double>>(gradients));
  program.evaluate(std::span<const Interval>(std::array{Interval(u - 1e-3, u), Interval(v, v + 1e-3)}),
                   std::span<Interval>(boxes));
  for (int k = 0; k < 4; ++k) {
    EXPECT_TRUE(boxes[k].contains(values[k])) << k;
    EXPECT_LT(boxes[k].width(), 0.5) << k;
    const Pair jet = formulas[k](Pair::u_variable(u), Pair::v_variable(v));
    EXPECT_DOUBLE_EQ(gradients[k].c[0], values[k]) << k;
    EXPECT_NEAR(gradients[k].c[1], jet.c[1], 1e-13 * (1 + std::abs(jet.c[1]))) << k;
    EXPECT_EQ(gradients[k].c[2], 0) << k;
    EXPECT_NEAR(gradients[k].c[3], jet.c[2], 1e-13 * (1 + std::abs(jet.c[2]))) << k;
  }
}

// Whole numbers are exact: sums and products of parts that are used once and more than once, in any order.
TEST(Expression, sums_of_products_that_are_used_again) {
  std::mt19937 random(1);
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
  for (int n = 0; n < 200; ++n) {
    std::vector<std::pair<std::string, double>> parts{{"u", 2}, {"v", -3}, {"w", 5}};
    while (parts.size() < 14) {
      const auto [a, x] = parts[below(parts.size())];
      const auto [b, y] = parts[below(parts.size())];
      const bool is_product = below(2) == 0;
      if (a.size() + b.size() > 300 || std::abs(x * y) > 1e12) continue;
      parts.push_back({"(" + a + (is_product ? "*" : "+") + b + ")", is_product ? x * y : x + y});
    }
    std::vector<Expression> formulas;
    for (const auto& part : parts) formulas.push_back(bound(part.first, {{"u"}, {"v"}, {"w"}}));
    std::vector<double> values(parts.size());
    FormulaProgram(formulas).evaluate(std::span<const double>(std::array{2.0, -3.0, 5.0}), std::span<double>(values));
    for (size_t k = 0; k < parts.size(); ++k) {
      EXPECT_EQ(values[k], parts[k].second) << parts[k].first;
      EXPECT_EQ(formulas[k](2.0, -3.0, 5.0), parts[k].second) << parts[k].first;
    }
  }
}

TEST(Expression, intervals_keep_open_questions_open) {
  const Expression choice = bound("t if t < 1 else 5", {{"t"}});
  EXPECT_EQ(choice(Interval(0, 0.5)), Interval(0, 0.5));
  EXPECT_EQ(choice(Interval(2, 3)), Interval(5));
  EXPECT_EQ(choice(Interval(0, 2)), Interval(0, 5));
  EXPECT_EQ(bound("t < 1", {{"t"}})(Interval(0, 2)), Interval(0, 1));
  EXPECT_EQ(bound("t < 1 or t >= 0", {{"t"}})(Interval(0, 2)), Interval(1));
  EXPECT_EQ(bound("t == 1", {{"t"}})(Interval(0, 2)), Interval(0, 1));
  EXPECT_EQ(bound("t != 3", {{"t"}})(Interval(0, 2)), Interval(1));
  const Interval kink = bound("t if t < 1 else 2 - t", {{"t"}})(Jet<Interval, 1>::variable({0, 2})).c[1];
  EXPECT_TRUE(kink.contains(Interval(-1, 1)));
  EXPECT_LT(kink.width(), 2.001);
  const Interval remainder = bound("mod(t, 2)", {{"t"}})(Interval(5, 5.5));
  EXPECT_TRUE(remainder.contains(Interval(1, 1.5)));
  EXPECT_LT(remainder.width(), 0.5 + 1e-14);
  EXPECT_EQ(bound("mod(t, 2)", {{"t"}})(Interval(5, 6.5)), Interval(0, 2));
}

// The rounding of constants is no question: what a formula of numbers alone is, it is over intervals too.
TEST(Expression, jumps_of_constants_are_closed_questions) {
  EXPECT_EQ(bound("floor(k/3)", {{"t"}}, {{"k", 3}})(Interval(0)), Interval(1));
  EXPECT_EQ(bound("1 if k/3 >= 1 else 0", {{"t"}}, {{"k", 3}})(Interval(0)), Interval(1));
  EXPECT_EQ(bound("round(k/4)", {{"t"}}, {{"k", 10}})(Interval(0)), Interval(number("round(10/4)")));
}

TEST(Expression, singular_values_are_not_errors) {
  EXPECT_TRUE(std::isinf(number("1/0")));
  EXPECT_TRUE(std::isnan(number("0/0")));
  EXPECT_TRUE(std::isnan(number("sqrt(-1)")));
  EXPECT_TRUE(std::isnan(number("(-8)^(1/3)")));
  EXPECT_TRUE(std::isnan(number("asin(2)")));
  EXPECT_TRUE(std::isinf(number("log(0)")));
  EXPECT_EQ(bound("1/t", {{"t"}})(Interval(-1, 1)), Interval::entire());
}

TEST(Expression, deep_and_long_input_is_refused_not_overrun) {
  const auto repeated = [](std::string_view part, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += part;
    return text;
  };
  EXPECT_EQ(number(repeated("(", 150) + "1" + repeated(")", 150)), 1);
  EXPECT_EQ(number(repeated("1 + (", 150) + "1" + repeated(")", 150)), 151);
  EXPECT_EQ(number(std::string("0") + repeated(" + 1", 2000)), 2000);
  for (const std::string& text :
       {repeated("(", 3000) + "1" + repeated(")", 3000), repeated("-", 5000) + "1",
        std::string("1") + repeated("^1", 3000), repeated("sin(", 1500) + "1" + repeated(")", 1500),
        repeated("not ", 1000) + "1 > 0", std::string("1") + repeated(" if 1 > 0 else 1", 500)}) {
    const auto result = Expression::parse(text);
    ASSERT_TRUE(std::holds_alternative<ExpressionError>(result));
    EXPECT_EQ(std::get<ExpressionError>(result).message, "the formula is nested more than 200 deep");
  }
  const auto result = Expression::parse(repeated("1 + ", 5000) + "1");
  ASSERT_TRUE(std::holds_alternative<ExpressionError>(result));
  EXPECT_EQ(std::get<ExpressionError>(result).message, "the formula is longer than 10000 characters");
}

struct Wrong {
  std::string_view text;
  std::size_t offset;
  std::string_view message, hint;
};

TEST(Expression, every_message_of_parsing) {
  const Wrong cases[] = {
      {"", 0, "the formula is empty", "write a number or a formula"},
      {"  ", 0, "the formula is empty", "write a number or a formula"},
      {"0x1F", 0, "hexadecimal numbers are not allowed", "write the number in decimal"},
      {"007", 0, "a number may not begin with a zero", "write '7'"},
      {"00", 0, "a number may not begin with a zero", "write '0'"},
      {"1.2.3", 0, "a number has one decimal point", ""},
      {"2 + 1_000", 4, "a number has no '_' in it", "write the digits without spaces between them"},
      {"2e", 0, "an exponent needs digits", "write 2e3 for 2000; there is no constant e, write exp(1)"},
      {"1e999", 0, "the number 1e999 is outside the range of double precision",
       "numbers lie between 1e-307 and 1.7e308"},
      {"hole.3 + 1", 0, "'hole.3' is not a number: dots join the names of geometry",
       "formulas know parameters, counters and variables"},
      {"2**3", 1, "'**' is not an operator", "powers are written with '^': a^b"},
      {"a && b", 2, "'&&' is not an operator", "write 'and'"},
      {"1 if a = b else 0", 7, "'=' is not an operator", "comparison is written '=='"},
      {"7 % 2", 2, "'%' is not an operator", "the remainder is mod(a, b)"},
      {"a > 0 ? 1 : 2", 6, "'?' is not an operator", "a choice is written: a if condition else b"},
      {"a[1]", 1, "a formula has no brackets '['", "use parentheses ( )"},
      {"\\sqrt{2}", 0, "a formula has no backslash", "formulas are not written in TeX: sqrt(x), sin(x), pi"},
      {"2 − 1", 2, "'−' (U+2212) is not the minus sign of formulas", "write '-'"},
      {"2π", 1, "'π' (U+03C0) is not a name", "write 'pi'"},
      {"90°", 2, "'°' (U+00B0) is not a unit", "write 'deg'"},
      {"2*х", 2, "unexpected character 'х' (U+0445)",
       "formulas are written in ASCII letters; some letters of other alphabets look the same"},
      {"2 @ 3", 2, "unexpected character '@'", ""},
      {"2 \xFF", 2, "unexpected byte 0xFF", "formulas are written in ASCII letters"},
      {"2*(3 + 4", 2, "unbalanced parentheses: this '(' is not closed",
       "inside [ ] or { } a formula with commas is written in quotes: \"atan2(y, x)\""},
      {"2*3)", 3, "unbalanced parentheses: this ')' closes nothing", ""},
      {"2 3", 2, "missing operator between '2' and '3'", "a product is written with '*': 2*3"},
      {"2x", 1, "missing operator between '2' and 'x'", "a product is written with '*': 2*x"},
      {"2 pi", 2, "missing operator between '2' and 'pi'", "a product is written with '*': 2*pi"},
      {"2(3)", 1, "missing operator between '2' and '('", "a product is written with '*': 2*("},
      {"a b", 2, "missing operator between 'a' and 'b'", "a product is written with '*': a*b"},
      {"n deg", 2, "the unit 'deg' may follow a number or parentheses only", "write '(n) deg'"},
      {"deg*2", 0, "the unit 'deg' must follow a number", "write '1 deg'"},
      {"5 mm", 2, "the unit 'mm' is not allowed in a formula",
       "model lengths carry no unit; angles have deg, rad or turn"},
      {"1 < 2 < 3", 6, "comparisons do not chain", "write: a < b and b < c"},
      {"1 if 2 > 1", 2, "'if' without 'else'", "a choice is written: a if condition else b"},
      {"if 1 > 2 else 3", 0, "expected a value before 'if'", "a choice is written: a if condition else b"},
      {"1 else 2", 2, "'else' without 'if'", "a choice is written: a if condition else b"},
      {"1,5", 1, "unexpected ','", "a decimal point is written '.': 1.5"},
      {"a, b", 1, "unexpected ','", "commas separate the arguments of functions only"},
      {"1..2", 1, "a range 'a..b' is not allowed here", "write one number"},
      {"*2", 0, "a formula may not begin with '*'", ""},
      {"/2", 0, "expected a value before '/'", ""},
      {"2 + ", 4, "expected a value between '+' and the end", ""},
      {"2 + * 3", 4, "expected a value between '+' and '*'", ""},
      {"()", 0, "empty parentheses", ""},
      {"sin x", 0, "the function 'sin' needs its arguments in parentheses", "write sin(x)"},
      {"sine(1)", 0, "unknown function 'sine'", "did you mean 'sin'?"},
      {"1 + ln(2)", 4, "unknown function 'ln'", "the natural logarithm is log(x)"},
      {"sin(1, 2)", 0, "sin takes 1 argument, not 2", ""},
      {"sin()", 0, "sin takes 1 argument, not 0", ""},
      {"atan2(1)", 0, "atan2 takes 2 arguments, not 1", ""},
      {"clamp(1, 2)", 0, "clamp takes 3 arguments, not 2", ""},
      {"min(1)", 0, "min takes at least 2 arguments, not 1", ""},
  };
  for (const Wrong& wrong : cases) {
    const auto result = Expression::parse(wrong.text);
    const auto* error = std::get_if<ExpressionError>(&result);
    ASSERT_TRUE(error) << wrong.text;
    EXPECT_EQ(error->message, wrong.message) << wrong.text;
    EXPECT_EQ(error->hint, wrong.hint) << wrong.text;
    EXPECT_EQ(error->offset, wrong.offset) << wrong.text;
  }
}

// The functions there are; what has several arguments is no product.
TEST(ExpressionErrors, UnknownFunctionsNameThoseThereAre) {
  const auto hint = [](const char* text) { return std::get<ExpressionError>(Expression::parse(text)).hint; };
  const std::string of_two = hint("choose(4, 2)*x^2"), of_one = hint("radius((1 + 2))");
  for (const std::string_view name : function_names()) {
    EXPECT_NE(of_two.find(name), std::string::npos) << name;
    EXPECT_NE(of_one.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(of_two.find("product"), std::string::npos);
  EXPECT_TRUE(of_one.ends_with("; a product is written with '*': radius*(...)"));
}

TEST(Expression, every_message_of_binding) {
  constexpr std::string_view mixed =
      "give the plain number a unit ('deg' or 'rad'), or divide the angle by one: a/(1 deg)";
  constexpr std::string_view truth = "for a number write: 1 if a < b else 0";
  const std::vector<Expression::Variable> variables{{"u"}, {"v"}, {"phi", Measure::angle}};
  const std::vector<Expression::Constant> constants{{"radius", 2}};
  const Wrong cases[] = {
      {"2*raduis", 2, "unknown name 'raduis'", "did you mean 'radius'?"},
      {"e^u", 0, "unknown name 'e'", "there is no constant e; write exp(1)"},
      {"2*PI", 2, "unknown name 'PI'", "write 'pi'"},
      {"u + width", 4, "unknown name 'width'",
       "this formula is one of 'u', 'v', 'phi'; other names are defined under 'parameters'"},
      {"u + phi", 2, "cannot add an angle and a plain number", mixed},
      {"30 deg - 1", 7, "cannot subtract an angle and a plain number", mixed},
      {"u if phi > 1 else v", 9, "cannot compare an angle and a plain number", mixed},
      {"u if u > 1 else phi", 2, "cannot choose between an angle and a plain number", mixed},
      {"min(u, phi)", 0, "cannot take min of an angle and a plain number", mixed},
      {"phi*phi", 3, "cannot multiply two angles", "divide one of them by its unit: a/(1 deg)"},
      {"pi/2 rad", 2, "cannot divide a plain number by an angle",
       "divide the angle by its unit first: a/(1 rad); '(pi/2) rad' needs its parentheses"},
      {"phi^2", 3, "an angle cannot stand in a power", "divide the angle by its unit: (a/(1 rad))^2"},
      {"2^phi", 1, "an angle cannot stand in a power", "divide the angle by its unit: (a/(1 rad))^2"},
      {"sqrt(phi)", 0, "sqrt takes a plain number, not an angle", "divide the angle by its unit: sqrt(a/(1 deg))"},
      {"(phi) deg", 6, "an angle already has its unit", "remove one of the units"},
      {"(u > v) deg", 8, "a comparison has no unit", truth},
      {"(u > v) + 1", 8, "cannot add comparisons", truth},
      {"2*(u > v)", 1, "cannot multiply comparisons", truth},
      {"2/(u > v)", 1, "cannot divide comparisons", truth},
      {"(u > v)^2", 7, "cannot raise comparisons to a power", truth},
      {"-(u > v)", 0, "a comparison has no sign", truth},
      {"sin(u > v)", 0, "sin of a comparison", truth},
      {"(u > v) == (v > u)", 8, "cannot compare comparisons", truth},
      {"1 if u else 2", 2, "'if' needs a comparison, not a plain number", "write for instance: a if x > 0 else b"},
      {"1 if phi and u > v else 2", 9, "'and' needs a comparison, not an angle", "write for instance: x > 0"},
      {"1 if not u else 2", 5, "'not' needs a comparison, not a plain number", "write for instance: x > 0"},
  };
  for (const Wrong& wrong : cases) {
    // Without names an expression is bound as it is parsed.
    auto result = Expression::parse(wrong.text);
    std::optional<ExpressionError> error;
    if (auto* e = std::get_if<Expression>(&result)) {
      error = e->bind(variables, constants);
    } else {
      error = std::get<ExpressionError>(result);
    }
    ASSERT_TRUE(error) << wrong.text;
    EXPECT_EQ(error->message, wrong.message) << wrong.text;
    EXPECT_EQ(error->hint, wrong.hint) << wrong.text;
    EXPECT_EQ(error->offset, wrong.offset) << wrong.text;
  }
  Expression alone = parsed("n + 1");
  EXPECT_EQ(alone.bind({})->hint, "names of numbers are defined under 'parameters'");
  Expression in_pi = parsed("2*pi");
  EXPECT_TRUE(in_pi.holds_pi());
  EXPECT_EQ(in_pi.convert_to_angle()->message, "pi without a unit: a plain number means degrees here");
  EXPECT_EQ(in_pi.convert_to_angle()->hint, "write '(2*pi) rad', or give the angle in degrees");
  Expression compared = parsed("1 > 2");
  EXPECT_EQ(compared.convert_to_angle()->message, "expected an angle, found a comparison");
}

TEST(Expression, reserved_words) {
  for (const std::string_view word : {"sin", "clamp", "deg", "turn", "pi", "if", "not"})
    EXPECT_TRUE(is_reserved_word(word));
  for (const std::string_view word : {"radius", "e", "u", "Sin"}) EXPECT_FALSE(is_reserved_word(word));
}

}  // namespace
}  // namespace lekalo::geometry::expression_test
