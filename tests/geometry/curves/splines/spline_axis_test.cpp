#include "geometry/curves/splines/spline_axis.h"

#include <gtest/gtest.h>

#include <functional>

namespace lekalo::geometry::spline_axis_test {
namespace {

using List = std::vector<double>;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "no error";
}

// Golovanov 2016, 2.12 and 3.8.
TEST(SplineAxis, RulesMakeTheBooksKnots) {
  EXPECT_EQ(knots_by_rule("clamped", 3, 9, false, {}), List({0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}));
  EXPECT_EQ(knots_by_rule("clamped", 3, 7, false, {}), List({0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}));
  EXPECT_EQ(knots_by_rule("uniform", 3, 7, false, {}), List({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(knots_by_rule("uniform", 3, 6, true, {}), List({-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(knots_by_rule("clamped", 3, 6, true, {}), knots_by_rule("uniform", 3, 6, true, {}));
  EXPECT_EQ(knots_by_rule("clamped", 7, 8, false, {}).size(), 16u);
}

// Means of neighbouring places: quadratic, polygon sides 1, 3, 2, 4.
TEST(SplineAxis, ChordLengthAveragesPlaces) {
  EXPECT_EQ(knots_by_rule("chord_length", 2, 5, false, {0, 1, 4, 6, 10}), List({0, 0, 0, 2.5, 5, 10, 10, 10}));
  // Closed with equal sides: uniform knots, scaled.
  const List closed = knots_by_rule("chord_length", 3, 5, true, {0, 2, 4, 6, 8, 10});
  const List uniform = knots_by_rule("uniform", 3, 5, true, {});
  ASSERT_EQ(closed.size(), uniform.size());
  for (size_t i = 0; i < closed.size(); ++i) EXPECT_NEAR(closed[i], 2 * uniform[i], 1e-14);
  // Centripetal takes square roots of the sides: here 1, 2, 1, 3.
  const SplineAxis axis = make_axis(2, {"centripetal", {}}, false, 5, {1, 4, 1, 9});
  EXPECT_EQ(axis.knots(), List({0, 0, 0, 2, 3.5, 7, 7, 7}));
}

TEST(SplineAxis, ChordLengthOfAClosedPolygonRepeats) {
  const SplineAxis axis = make_axis(3, {"chord_length", {}}, true, 5, {1, 2.5, 0.75, 3, 1.25});
  EXPECT_NEAR(axis.period(), 8.5, 1e-14);
  EXPECT_EQ(axis.domain().lo, 0);
  EXPECT_EQ(axis.distinct(), 5);
  EXPECT_EQ(axis.count(), 8);
}

TEST(SplineAxis, ErrorsNameTheFieldAndTheNumbers) {
  EXPECT_EQ(message_of([] { SplineAxis(1000, List(2002), Extension::tangent); }),
            "degree: degree 1000 is not between 1 and 25");
  EXPECT_EQ(message_of([] {
              make_axis(1000, {"clamped", {}}, false, 2000, {});
            }),
            "degree: degree 1000 is not between 1 and 25");
  EXPECT_EQ(message_of([] {
              make_axis(3, {"clamped", {}}, false, 3, {});
            }),
            "points: a spline of degree 3 needs at least 4 points, not 3");
  EXPECT_EQ(message_of([] {
              make_axis(2, {"", {0, 0, 0, 1, 1}}, false, 3, {});
            }),
            "knots: 3 points of degree 2 need 6 knots, not 5");
  EXPECT_EQ(message_of([] {
              make_axis(2, {"", {0, 0, 0, 1, 1, 1}}, true, 3, {});
            }),
            "knots: 3 points of degree 2, closed, need 8 knots, not 6");
  EXPECT_EQ(message_of([] {
              SplineAxis(2, {0, 0, 0, 2, 1, 3, 3, 3}, Extension::tangent);
            }),
            "knots: knots must not decrease, but knot 3 is 2 and knot 4 is 1");
  EXPECT_EQ(message_of([] {
              SplineAxis(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2}, Extension::tangent);
            }),
            "knots: the knot 1 stands 4 times; degree 2 allows at most 3");
  EXPECT_EQ(message_of([] {
              SplineAxis(2, {0, 1, 2, 2, 3, 4}, Extension::tangent);
            }),
            "knots: the domain is empty: knot 2 and knot 3 are both 2");
  EXPECT_EQ(message_of([] {
              SplineAxis(1, {-1, 0, 1, 2, 3.5}, Extension::periodic);
            }),
            "knots: the knots of a closed curve must repeat after the period 2: knot 4 should be 3, not 3.5");
  EXPECT_EQ(message_of([] {
              SplineAxis axis(1, {0, 0, 1, 2, 2}, Extension::tangent);
              axis.restrict_to({-1, 1});
            }),
            "domain: [-1, 1] is not inside the knots' domain [0, 2]");
}

TEST(SplineAxis, NearlyEqualKnotsBecomeEqual) {
  const SplineAxis axis(2, {0, 0, 1e-13, 0.5, 0.5 + 1e-12, 1, 1, 1}, Extension::tangent);
  EXPECT_EQ(axis.knots(), List({0, 0, 0, 0.5, 0.5, 1, 1, 1}));
}

// Golovanov 2016, 3.8: closed knots with intervals 1, 2, 1, 3, 1, 2.
TEST(SplineAxis, AcceptsUnevenClosedKnots) {
  const SplineAxis axis(3, {-6, -3, -2, 0, 1, 3, 4, 7, 8, 10, 11, 13, 14}, Extension::periodic);
  EXPECT_EQ(axis.domain(), Interval(0, 10));
  EXPECT_EQ(axis.period(), 10);
  EXPECT_EQ(axis.distinct(), 6);
  EXPECT_EQ(axis.place(13.5).span, axis.place(3.5).span);
  EXPECT_NEAR(axis.place(-1).t, 9, 1e-15);
}

TEST(SplineAxis, ContinuesAlongTangentsOnlyBeyondItsKnots) {
  SplineAxis axis(2, {0, 0, 0, 1, 2, 3, 3, 3}, Extension::tangent);
  axis.restrict_to({0.5, 2});
  EXPECT_EQ(axis.place(0.25).beyond, 0);
  EXPECT_EQ(axis.place(-1).beyond, -1);
  EXPECT_EQ(axis.place(3.5).beyond, 0.5);
  EXPECT_EQ(axis.place(2).span, 3);  // the end of the part: from the left
  EXPECT_EQ(axis.spans_over({0.5, 1}), std::vector<int>({2}));
  EXPECT_EQ(axis.spans_over({0.5, 2}), std::vector<int>({2, 3}));
}

}  // namespace
}  // namespace lekalo::geometry::spline_axis_test
