// Texts of drawings. The expected texts follow from the rules at the top of text_template.h; balanced braces and dollar
// signs are TeX's own rule.
#include "render/model/text_template.h"

#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::text_template_test {
namespace {

// The label of an annotation beside a parameter a = 2/3 and a counter n of a repeat over 7, 12.
TextTemplate label(const std::string& text) {
  const BuiltText built = build_text(
      "parameters: { a: 2/3 }\nlights: {}\ndrawing: { annotations: [{ repeat: { n: [7, 12] }, type: label, at: [0, 0], "
      "text: '" +
      text + "' }] }\n");
  EXPECT_EQ(built.said, "") << text;
  return built.model.drawing.annotations.at(0).values.get<TextTemplate>("text");
}

// The label of control points, whose counter is i.
std::string point_label(const std::string& text, double i) {
  const BuiltText built = build_text(
      "lights: {}\nobjects: [{ shape: { type: bezier_curve, points: [[0, 0], [1, 1]] }, show: { control_polygon: { "
      "label: "
      "'" +
      text + "' } } }]\n");
  EXPECT_EQ(built.said, "") << text;
  const TextTemplate made = built.model.objects.at(0).look->helpers.at(0).values.get<TextTemplate>("label");
  return made.text({&i, 1});
}

TEST(TextTemplate, NumbersOfParametersAndCounters) {
  EXPECT_EQ(label("$w = %(a)$").text(), "$w = 0.666667$");
  EXPECT_EQ(label("%n of %(n + 1)").text(), "7 of 8");
  EXPECT_EQ(label("%03n, %3n").text(), "007,   7");
  EXPECT_EQ(label("12 %%, 100 %%").text(), "12 %, 100 %");
  EXPECT_EQ(label("%(-n)").text(), "-7");
  EXPECT_EQ(label("%03(-n)").text(), "-07");
  EXPECT_EQ(label("12 × ").text(), "12 × ");
  EXPECT_EQ(label("$\\{%nth\\}$").text(), "$\\{7th\\}$");
}

// A script is one thing in TeX: t_12 would be t_{1}2.
TEST(TextTemplate, CountersOfTheField) {
  EXPECT_EQ(point_label("$\\mathbf{p}_{%i%i}$", 3), "$\\mathbf{p}_{33}$");
  EXPECT_EQ(point_label("$t_%(2*i + 1)$", 3), "$t_7$");
  EXPECT_EQ(point_label("$t_%(4*i)$", 3), "$t_{12}$");
}

std::string said(const std::string& text) {
  return build_text("lights: {}\ndrawing:\n  annotations:\n    - { type: label, at: [0, 0], text: " + text + " }\n")
      .said;
}

// The text begins in column 41, behind its quote.
TEST(TextTemplate, WhatIsWrongIsSaidAtItsPlace) {
  EXPECT_EQ(said("'ab %q'"), "5:45 unknown counter '%q' of a text\n");
  EXPECT_EQ(said("'ab %'"), "5:44 a percent sign stands for a number here\n");
  EXPECT_EQ(said("'50 % of'"), "5:44 a percent sign stands for a number here\n");
  EXPECT_EQ(said("'ab %(1 + 2'"), "5:45 this parenthesis is not closed\n");
  EXPECT_EQ(said("'ab %( )'"), "5:45 there is no formula between the parentheses\n");
  EXPECT_EQ(said("'ab %(b + 2)'"), "5:46 unknown name 'b'\n");
  EXPECT_EQ(said("'%(1/0)'"), "5:43 the formula has no finite value\n");
  EXPECT_EQ(said("'%(1 < 2)'"), "5:43 expected a number, found a condition\n");
  EXPECT_EQ(said("'%999999i'"), "5:41 a number of more than 20 digits\n");
  EXPECT_EQ(said("'a $x'"), "5:43 this $ has no partner\n");
  EXPECT_EQ(said("'$x_{1$'"), "5:44 this brace is not closed\n");
  EXPECT_EQ(said("'x_{1'"), "5:43 this brace is not closed\n");
  EXPECT_EQ(said("'x}'"), "5:42 this brace closes nothing\n");
  EXPECT_EQ(said("'\\mathbf{a $x}$'"), "5:51 a formula begins inside braces and does not end there\n");
  EXPECT_EQ(said("'\\$ \\{ \\} $\\alpha$'"), "");
  EXPECT_EQ(said("[1]"), "5:40 expected a text, found a list\n");
}

}  // namespace
}  // namespace lekalo::render::text_template_test
