// Splines through points: numbers of Golovanov 2016 and Zavyalov et al. 1985, what the definitions say on random
// points, and what is refused.
#include "geometry/curves/interpolation/spline_curve.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/interpolation/point_parameters.h"

namespace lekalo::geometry::spline_curve_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

const Points kFive = {{0, 0, 0}, {1, 2, 0}, {3, 3, 0}, {4, 0, 0}, {6, 1, 0}};

struct Data {
  Points points;
  List parameters;
};

Data random_data(int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Data data;
  double t = uniform(random);
  for (int i = 0; i <= count; ++i) {
    if (i < count) data.points.push_back({uniform(random), uniform(random), uniform(random)});
    data.parameters.push_back(t);
    t += 1.1 + uniform(random);
  }
  return data;
}

NurbsCurve open_spline(const Data& data, int degree, EndRule rule = EndRule::not_a_knot,
                       std::vector<PointTangent> tangents = {}) {
  const List t(data.parameters.begin(), data.parameters.end() - 1);
  return spline_curve(data.points, t, degree, {rule, {}, {}}, {rule, {}, {}}, tangents);
}

template <class Build>
std::string refusal(const Build& build) {
  try {
    build();
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

// Golovanov 2016, 2.14: control points of the clamped cubic, by chord length.
TEST(SplineCurve, ClampedCubicHasTheBooksControlPoints) {
  const NurbsCurve curve = spline_curve(kFive, point_parameters({"chord_length", {}}, kFive, false), 3,
                                        {EndRule::natural, Vec3(1, 2, 0), {}}, {EndRule::natural, Vec3(2, 1, 0), {}});
  const Points book = {{0, 0, 0},
                       {0.74535599249993, 1.49071198499986, 0},
                       {0.413511864161598, 1.65201840016098, 0},
                       {3.85180999747907, 4.30355267058474, 0},
                       {3.70724252119808, -1.13809506893255, 0},
                       {4.50928801500014, 0.25464400750007, 0},
                       {6, 1, 0}};
  ASSERT_EQ(curve.points().size(), book.size());
  for (size_t i = 0; i < book.size(); ++i) EXPECT_LE(distance(Vec3(curve.points()[i]), book[i]), 1e-14) << i;
  EXPECT_EQ(curve.point(0), kFive.front());
}

TEST(SplineCurve, PassesThroughItsPointsWithAllDerivativesButOne) {
  for (const int degree : {1, 2, 3, 4, 5, 7}) {
    const Data data = random_data(9, 7 + degree);
    const NurbsCurve open = open_spline(data, degree);
    const NurbsCurve closed = closed_spline_curve(data.points, data.parameters, degree);
    for (size_t i = 0; i < data.points.size(); ++i) {
      EXPECT_LE(distance(open.point(data.parameters[i]), data.points[i]), 1e-13) << degree;
      EXPECT_LE(distance(closed.point(data.parameters[i]), data.points[i]), 1e-12) << degree;
    }
    EXPECT_NEAR(closed.period(), data.parameters.back() - data.parameters.front(), 1e-14);
    EXPECT_EQ(closed.domain().lo, data.parameters.front());
    for (const double knot : closed.axis().knots())
      for (int k = 0; k < degree && k <= kMaxCurveOrder; ++k) {
        const Vec3 left = closed.evaluate(knot - 1e-9, k).d[k], right = closed.evaluate(knot + 1e-9, k).d[k];
        EXPECT_LE(distance(left, right), 1e-5 * (1 + glm::length(left))) << degree << " " << k;
      }
    checks::check_pieces(closed, 1e-12);
    checks::check_enclosures(closed, closed.domain());
  }
}

TEST(SplineCurve, EndsAreWhatTheyAreCalled) {
  const Data data = random_data(8, 3);
  const Interval range(data.parameters.front(), data.parameters[7]);
  const NurbsCurve natural = open_spline(data, 3, EndRule::natural), quintic = open_spline(data, 5, EndRule::natural);
  const NurbsCurve parabolic = open_spline(data, 3, EndRule::parabolic);
  for (const double t : {range.lo, range.hi}) {
    EXPECT_LE(glm::length(natural.evaluate(t, 2).d[2]), 1e-12);
    EXPECT_LE(glm::length(quintic.evaluate(t, 3).d[3]), 1e-11);
    EXPECT_LE(glm::length(quintic.evaluate(t, 4).d[4]), 1e-10);
    EXPECT_LE(glm::length(parabolic.evaluate(t, 3).d[3]), 1e-12);
  }
}

TEST(SplineCurve, TangentsAreMetAtAnyPoints) {
  for (const int degree : {2, 3, 4, 5})
    for (const std::vector<int>& at : {std::vector<int>{2}, {0, 3}, {1, 2, 3, 4}, {0, 1, 2, 3, 4, 5, 6}}) {
      const Data data = random_data(7, 31);
      std::vector<PointTangent> tangents;
      for (const int point : at) tangents.push_back({point, Vec3(0.5, point, -1)});
      const NurbsCurve open = open_spline(data, degree, EndRule::not_a_knot, tangents);
      const NurbsCurve closed = closed_spline_curve(data.points, data.parameters, degree, tangents);
      for (const NurbsCurve* curve : {&open, &closed}) {
        for (size_t i = 0; i < data.points.size(); ++i)
          EXPECT_LE(distance(curve->point(data.parameters[i]), data.points[i]), 1e-11) << degree;
        for (const PointTangent& one : tangents)
          EXPECT_LE(distance(curve->evaluate(data.parameters[one.point], 1).d[1], one.tangent), 1e-11) << degree;
      }
    }
}

TEST(SplineCurve, ReproducesPolynomialsOfItsDegree) {
  const auto cubic = [](double t) { return Vec3(t, t * t * t - t, 1 - t * t); };
  const List t = {0, 0.3, 1, 1.2, 2.5, 3};
  Points points;
  for (const double x : t) points.push_back(cubic(x));
  const NurbsCurve curve = spline_curve(points, t, 3, {}, {});
  for (int i = 0; i <= 30; ++i) EXPECT_LE(distance(curve.point(0.1 * i), cubic(0.1 * i)), 3e-14);
}

TEST(SplineCurve, FewPointsGiveLinesAndParabolas) {
  const Points two = {{0, 0, 0}, {2, 1, 0}}, three = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  for (const EndRule rule : {EndRule::natural, EndRule::parabolic, EndRule::not_a_knot})
    EXPECT_LE(distance(spline_curve(two, List{0, 1}, 3, {rule, {}, {}}, {rule, {}, {}}).point(0.5), Vec3(1, 0.5, 0)),
              1e-15);
  EXPECT_EQ(spline_curve(three, List{0, 1, 2}, 3, {}, {}).degree(), 2);
  EXPECT_LE(distance(spline_curve(three, List{0, 1, 2}, 3, {}, {}).point(0.5), Vec3(0.5, 0.75, 0)), 1e-15);
}

TEST(SplineCurve, RefusesWithWordsWhatCannotBe) {
  const List t = {0, 1, 2, 3, 4};
  const SplineEnd natural{EndRule::natural, {}, {}}, both{EndRule::natural, Vec3(1), Vec3(1)};
  EXPECT_EQ(refusal([&] { spline_curve(kFive, t, 3, both, natural); }),
            "ends: a spline of degree 3 has room for 1 derivative at an end, not 2");
  EXPECT_EQ(refusal([&] { spline_curve(kFive, t, 4, natural, natural); }),
            "ends: natural ends are those of odd degrees up to 7, not of 4");
  EXPECT_EQ(refusal([&] {
              spline_curve(kFive, t, 5, {EndRule::parabolic, {}, {}}, natural);
            }),
            "ends: parabolic ends are those of degree 3, not of 5");
  EXPECT_EQ(refusal([&] {
              spline_curve(kFive, t, 3, {}, {}, std::vector<PointTangent>{{5, Vec3(1)}});
            }),
            "tangents: there is no point 5: the 5 points are numbered from 0");
  EXPECT_EQ(refusal([&] {
              point_parameters({"", {0, 1, 2}}, kFive, false);
            }),
            "knots: 5 points need 5 parameters, not 3");
  EXPECT_EQ(refusal([&] {
              point_parameters({"", {0, 1, 2, 3, 4}}, kFive, true);
            }),
            "knots: 5 points, closed, need 6 parameters, not 5");
  EXPECT_EQ(refusal([&] {
              point_parameters({"", {0, 1, 1, 2, 3}}, kFive, false);
            }),
            "knots: parameters of points must increase, but that of point 1 is 1 and that of point 2 is 1");
  EXPECT_EQ(refusal([&] {
              point_parameters({"uniform", {}}, Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, true);
            }),
            "points: the last point repeats the first");
  EXPECT_EQ(refusal([&] {
              point_parameters({"uniform", {}}, Points{{0, 0, 0}, {1, 0, 0}}, true);
            }),
            "points: a closed curve through points needs at least 3 points, not 2");
}

}  // namespace
}  // namespace lekalo::geometry::spline_curve_test
