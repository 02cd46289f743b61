#include "geometry/curves/splines/nurbs_operations.h"

#include <functional>

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "support/worst.h"

namespace lekalo::geometry::nurbs_operations_test {
namespace {

using checks::distance;

NurbsCurveForm form_of(int degree, std::vector<double> knots, const std::vector<Vec3>& points,
                       const std::vector<double>& weights = {}) {
  NurbsCurveForm form{degree, std::move(knots), {}, {}};
  for (size_t i = 0; i < points.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    form.points.emplace_back(w * points[i], w);
  }
  return form;
}

const NurbsCurveForm kNine =
    form_of(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6},
            {{0, 0, 0}, {1, 2, 0}, {2, -1, 0}, {3, 3, 0}, {4, 0, 0}, {5, 2, 0}, {6, -2, 0}, {7, 1, 0}, {8, 0, 0}});

// Random forms: clamped and not, repeated knots, weights over two decades.
std::vector<NurbsCurveForm> random_forms() {
  std::mt19937_64 random(41);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  std::vector<NurbsCurveForm> forms;
  for (int sample = 0; sample < 30; ++sample) {
    const int degree = 1 + sample % 6, count = degree + 2 + sample % 4;
    std::vector<double> knots;
    if (sample % 2) {
      knots.assign(degree + 1, 0);
      for (int i = 1; i < count - degree; ++i) knots.push_back(i % 3 == 2 && degree > 1 ? knots.back() : i);
      knots.insert(knots.end(), degree + 1, count - degree);
    } else {
      for (int i = 0; i < count + degree + 1; ++i) knots.push_back((i ? knots.back() : 0) + uniform(0.5, 2));
    }
    std::vector<Vec3> points;
    std::vector<double> weights;
    for (int i = 0; i < count; ++i) {
      points.push_back({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
      weights.push_back(std::pow(10, uniform(-1, 1)));
    }
    forms.push_back(form_of(degree, knots, points, weights));
  }
  return forms;
}

// Largest distance of the curves a(t) and b(map(t)) over a's domain.
double deviation(const NurbsCurveForm& a, const NurbsCurveForm& b, const std::function<double(double)>& map) {
  const NurbsCurve first(a), second(b);
  const Interval domain = a.domain();
  double worst = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = domain.clamp(domain.lo + domain.width() * i / 100);
    worst = tests::worse(worst, distance(first.point(t), second.point(map(t))));
  }
  return worst;
}
double same(double t) { return t; }

// Golovanov 2016, 2.11.
TEST(NurbsOperations, InsertedKnotHasTheBooksPoints) {
  const NurbsCurveForm once = insert_knot(kNine, 2.5);
  ASSERT_EQ(once.points.size(), 10u);
  const Vec3 expected[] = {{17. / 6, 7. / 3, 0}, {3.5, 1.5, 0}, {25. / 6, 1. / 3, 0}};
  for (int i = 0; i < 3; ++i) EXPECT_LE(distance(Vec3(once.points[3 + i]), expected[i]), 2e-15);
  EXPECT_EQ(once.points[2], kNine.points[2]);
  EXPECT_EQ(once.points[6], kNine.points[5]);
  const NurbsCurveForm thrice = insert_knot(kNine, 2.5, 3);
  const Vec3 around[] = {{10. / 3, 41. / 24, 0}, {3.5, 35. / 24, 0}, {11. / 3, 29. / 24, 0}};
  for (int i = 0; i < 3; ++i) EXPECT_LE(distance(Vec3(thrice.points[4 + i]), around[i]), 2e-15);
  EXPECT_LE(deviation(kNine, thrice, same), 1e-14);
  EXPECT_THROW(insert_knot(kNine, 2.5, 4), std::invalid_argument);
  EXPECT_THROW(insert_knot(kNine, 6), std::invalid_argument);
}

TEST(NurbsOperations, InsertionKeepsTheCurve) {
  for (const NurbsCurveForm& form : random_forms()) {
    const Interval domain = form.domain();
    NurbsCurveForm refined = form;
    for (const double f : {0.2113, 0.5077, 0.7711}) refined = insert_knot(refined, domain.lo + f * domain.width());
    EXPECT_LE(deviation(form, refined, same), 1e-13);
  }
}

// Golovanov 2016, 2.6: the quarter circle symmetric about the x axis.
TEST(NurbsOperations, ElevatedArcHasTheBooksPoints) {
  const double h = std::sqrt(0.5);
  const NurbsCurveForm arc = form_of(2, {0, 0, 0, 1, 1, 1}, {{h, -h, 0}, {1 / h, 0, 0}, {h, h, 0}}, {1, h, 1});
  const NurbsCurveForm cubic = elevate_degree(arc);
  ASSERT_EQ(cubic.degree, 3);
  EXPECT_EQ(cubic.knots, std::vector<double>({0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_NEAR(cubic.points[1].w, 0.804737854124365, 1e-15);
  EXPECT_NEAR(cubic.points[2].w, 0.804737854124365, 1e-15);
  EXPECT_LE(distance(Vec3(cubic.points[1]) / cubic.points[1].w, {1.12132034355964, -0.292893218813452, 0}), 1e-14);
  EXPECT_LE(distance(Vec3(cubic.points[2]) / cubic.points[2].w, {1.12132034355964, 0.292893218813452, 0}), 1e-14);
  EXPECT_LE(deviation(arc, cubic, same), 1e-15);
}

TEST(NurbsOperations, ElevationKeepsTheCurveAndItsSmoothness) {
  for (const NurbsCurveForm& form : random_forms()) {
    const NurbsCurveForm higher = elevate_degree(form, 2);
    EXPECT_EQ(higher.degree, form.degree + 2);
    EXPECT_EQ(higher.points.size() + higher.degree + 1, higher.knots.size());
    EXPECT_EQ(higher.domain(), form.domain());
    EXPECT_LE(deviation(form, higher, same), 1e-12);
    for (const double knot : form.knots)
      if (knot > form.domain().lo && knot < form.domain().hi) {
        EXPECT_EQ(std::count(higher.knots.begin(), higher.knots.end(), knot),
                  std::count(form.knots.begin(), form.knots.end(), knot) + 2);
      }
  }
  EXPECT_THROW(elevate_degree(kNine, 23), std::invalid_argument);
}

TEST(NurbsOperations, PartsMakeTheWhole) {
  for (const NurbsCurveForm& form : random_forms()) {
    const Interval domain = form.domain();
    for (const double t : {domain.lo + 0.37 * domain.width(), form.knots[form.degree + 1]}) {
      if (!(t > domain.lo && t < domain.hi)) continue;
      const auto [before, after] = split(form, t);
      EXPECT_EQ(before.domain(), Interval(domain.lo, t));
      EXPECT_EQ(after.domain(), Interval(t, domain.hi));
      EXPECT_EQ(before.points.back(), after.points.front());
      EXPECT_LE(deviation(before, form, same), 1e-13);
      EXPECT_LE(deviation(after, form, same), 1e-13);
    }
  }
  EXPECT_THROW(split(kNine, 0), std::invalid_argument);
}

TEST(NurbsOperations, SplitAtABreakKeepsBothPoints) {
  const NurbsCurveForm broken = form_of(1, {0, 0, 1, 1, 2, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}});
  const auto [before, after] = split(broken, 1);
  EXPECT_EQ(before.points.size(), 2u);
  EXPECT_EQ(after.points.size(), 2u);
  EXPECT_EQ(Vec3(before.points.back()), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(after.points.front()), Vec3(1, 1, 0));
}

TEST(NurbsOperations, ReversalAndReparametrisationMoveTheParameterOnly) {
  for (const NurbsCurveForm& form : random_forms()) {
    const Interval domain = form.domain();
    EXPECT_LE(deviation(form, reversed(form), [&](double t) { return domain.lo + (domain.hi - t); }), 1e-13);
    const Interval other(-2, 11);
    const NurbsCurveForm moved = reparametrized(form, other);
    EXPECT_EQ(moved.domain(), other);
    EXPECT_LE(
        deviation(form, moved, [&](double t) { return other.lo + other.width() * (t - domain.lo) / domain.width(); }),
        1e-12);
  }
}

TEST(NurbsOperations, RefuseTranscendentalParameters) {
  NurbsCurveForm arc = kNine;
  arc.maps.assign(6, {ParameterMap::Kind::half_angle, 0, 1});
  EXPECT_THROW(insert_knot(arc, 0.5), std::invalid_argument);
  EXPECT_THROW(elevate_degree(arc), std::invalid_argument);
  EXPECT_THROW(reversed(arc), std::invalid_argument);
}

// A Bezier curve is the NURBS curve on the knots 0, .., 0, 1, .., 1 (Golovanov 2016, 2.13): its piece has its points.
TEST(NurbsOperations, BezierKnotsGiveBezierPoints) {
  for (const NurbsCurveForm& form : random_forms()) {
    NurbsCurveForm bezier{form.degree, {}, {}, {}};
    bezier.knots.assign(form.degree + 1, 0);
    bezier.knots.insert(bezier.knots.end(), form.degree + 1, 1);
    bezier.points.assign(form.points.begin(), form.points.begin() + form.degree + 1);
    const auto pieces = bezier_pieces(bezier, {0, 1});
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].points, bezier.points);
  }
}

}  // namespace
}  // namespace lekalo::geometry::nurbs_operations_test
