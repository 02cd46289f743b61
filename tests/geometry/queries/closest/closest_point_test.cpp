// All foot points of points on curves and surfaces: the checks of Golovanov 2016, 4.1 and 4.2, closed forms, and counts
// against a search by sampling.
#include "geometry/queries/closest/closest_point.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/queries/closest/nearest_on_surface.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "support/root_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::closest_point_test {
namespace {

TEST(PointOnCurve, AnEllipseSeenFromOutsideHasTwoFeet) {
  const Ellipse ellipse(Frame(), 3, 1);
  const CurveFootPoints found = project({2, 2, 0}, ellipse);
  ASSERT_EQ(found.foot_points.size(), 2u);
  EXPECT_NEAR(found.foot_points[0].t, 0.95878005667540448735, 1e-15);
  EXPECT_NEAR(found.foot_points[0].distance, 1.2134181759280895, 1e-15);
  EXPECT_EQ(found.foot_points[0].kind, FootPointKind::minimum);
  EXPECT_NEAR(found.foot_points[1].t, 3.2843076863330900374, 1e-15);
  EXPECT_NEAR(found.foot_points[1].distance, 5.4115698877204800, 2e-15);
  EXPECT_EQ(found.foot_points[1].kind, FootPointKind::maximum);
}

TEST(PointOnCurve, AnEllipseSeenFromInsideItsEvoluteHasFour) {
  const Ellipse ellipse(Frame(), 3, 1);
  const CurveFootPoints found = project({0.5, 0.25, 0}, ellipse);
  ASSERT_EQ(found.foot_points.size(), 4u);
  const double t[] = {1.3880560138528246, 4.9072895131392039, 6.2447076993398143, 3.1679100416171234};
  const double distance[] = {0.73473948417309830, 1.2337292720851672, 2.5143818735657148, 3.5098545222674713};
  const FootPointKind kind[] = {FootPointKind::minimum, FootPointKind::minimum, FootPointKind::maximum,
                                FootPointKind::maximum};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(found.foot_points[k].t, t[k], 2e-15);
    EXPECT_NEAR(found.foot_points[k].distance, distance[k], 2e-15);
    EXPECT_EQ(found.foot_points[k].kind, kind[k]);
  }
}

TEST(PointOnCurve, TheCentreOfACircleIsAsFarFromAllOfIt) {
  const Circle circle(Frame(), 2);
  const CurveFootPoints found = project({0, 0, 1}, circle);
  ASSERT_EQ(found.arcs.size(), 1u);
  EXPECT_EQ(found.arcs[0], circle.domain());
  ASSERT_EQ(found.foot_points.size(), 1u);
  EXPECT_NEAR(found.foot_points[0].distance, std::sqrt(5.0), 1e-15);
}

// Where pieces meet, rounding may put the foot point beyond the end of either.
TEST(PointOnCurve, AFootAtASeamIsFound) {
  const Circle circle(Frame(), 1);
  for (const double y : {0.0, -4.8985871965894128e-16, 3e-16, -1e-300}) {
    const CurveFootPoints found = project({3, y, 0}, circle);
    ASSERT_EQ(found.foot_points.size(), 2u) << y;
    EXPECT_NEAR(found.foot_points[0].distance, 2, 1e-15);
    EXPECT_EQ(found.foot_points[0].kind, FootPointKind::minimum);
  }
  const CurveFootPoints above = project({1e-16, 3, 0}, circle);  // between the first two quarters
  ASSERT_EQ(above.foot_points.size(), 2u);
  EXPECT_NEAR(above.foot_points[0].distance, 2, 1e-15);
}

TEST(PointOnCurve, AnArcOfACircleHasEnds) {
  const Circle arc(Frame(), 2, {0, 1});
  const CurveFootPoints found = project({0, -3, 0}, arc);
  ASSERT_EQ(found.foot_points.size(), 1u);
  EXPECT_EQ(found.foot_points[0].kind, FootPointKind::border);
  EXPECT_EQ(found.foot_points[0].t, 0);
  EXPECT_NEAR(found.foot_points[0].distance, std::sqrt(13.0), 1e-15);
}

TEST(PointOnCurve, AKinkFarAlongAPolylineIsAFoot) {
  // The knots are 0, 1, .., 100: one rounding error of a knot is more than 1e-15.
  std::vector<Vec3> points;
  for (int k = 0; k <= 100; ++k) points.emplace_back(0.1 * k, k % 2 ? 0.3 : 0.0, 0);
  const NurbsCurve zigzag = polyline(points);
  for (int k = 1; k < 100; k += 2) {
    const CurveFootPoint nearest = project(Vec3(0.1 * k, 5, 0), zigzag).foot_points.at(0);
    EXPECT_EQ(nearest.kind, FootPointKind::border);
    EXPECT_NEAR(nearest.t, k, 1e-12);
    EXPECT_NEAR(nearest.distance, 4.7, 1e-14);
  }
}

TEST(PointOnSurface, ATorusHasFourFeet) {
  const TorusSurface torus(Frame(), 3, 1);
  const SurfaceFootPoints found = project({1, 2, 2}, torus);
  ASSERT_EQ(found.foot_points.size(), 4u);
  EXPECT_NEAR(found.foot_points[0].u, 1.1071487177940905, 1e-15);
  EXPECT_NEAR(found.foot_points[0].v, 1.9356601549083798, 1e-15);
  EXPECT_NEAR(found.foot_points[0].distance, 1.1409325386385396, 1e-15);
  EXPECT_EQ(found.foot_points[0].kind, FootPointKind::minimum);
  EXPECT_EQ(found.foot_points[3].kind, FootPointKind::maximum);
}

TEST(PointOnSurface, ASphereHasTwoFeet) {
  const SphereSurface sphere(Frame(), 2);
  const SurfaceFootPoints found = project({1, 2, 2}, sphere);
  ASSERT_EQ(found.foot_points.size(), 2u);
  EXPECT_NEAR(found.foot_points[0].distance, 1, 1e-15);
  EXPECT_NEAR(found.foot_points[1].distance, 5, 1e-15);
  const SurfaceFootPoints above = project({0, 0, 5}, sphere);
  ASSERT_EQ(above.foot_points.size(), 2u);
  EXPECT_NEAR(above.foot_points[0].distance, 3, 1e-15);
  EXPECT_NEAR(above.foot_points[1].distance, 7, 1e-15);
}

TEST(PointOnSurface, CornersEdgesAndInsideOfASquare) {
  const NurbsSurface square = bezier_surface(Grid<Vec3>{2, 2, {{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 0}}});
  const auto nearest = [&](const Vec3& p) { return project(p, square).foot_points.at(0); };
  EXPECT_EQ(nearest({1, 0.5, 3}).kind, FootPointKind::minimum);
  EXPECT_NEAR(nearest({1, 0.5, 3}).distance, 3, 1e-15);
  EXPECT_EQ(nearest({3, 0.5, 0}).kind, FootPointKind::border);
  EXPECT_NEAR(nearest({3, 0.5, 0}).distance, 1, 1e-15);
  EXPECT_NEAR(nearest({5, 6, 0}).distance, 5, 1e-15);
  EXPECT_EQ(project({5, 6, 0}, square).foot_points.size(), 1u);
}

// Random points against halving of Bernstein forms.

using tests::Bernstein;
using tests::changes_sign;
using tests::derivative;
using tests::dot;

double unit(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

Bernstein<3> way_from(const Vec3& p, const std::vector<Vec3>& points, const std::array<int, 3>& degree) {
  Bernstein<3> way;
  way.degree = degree;
  for (const Vec3& q : points) way.c.push_back({q.x - p.x, q.y - p.y, q.z - p.z});
  return way;
}

TEST(RandomFootPoints, NoneOnACurveIsLost) {
  std::mt19937_64 random(3);
  int compared = 0, foot_points = 0, unclear_points = 0;
  for (int trial = tests::tier_count(10000); trial > 0; --trial) {
    const int n = 2 + trial % 6;
    std::vector<Vec3> points(n + 1);
    for (Vec3& p : points) p = {unit(random), unit(random), unit(random)};
    const Vec3 p(unit(random), unit(random), unit(random));
    const Bernstein<3> way = way_from(p, points, {n, 0, 0});
    bool unclear = false;
    const auto truth = tests::roots_by_halving<1, Bernstein<1>>(
        dot(way, derivative(way, 0)), 1e-10, changes_sign,
        [](const Bernstein<1>& f, int, bool upper) { return f.half(0, upper); }, unclear);
    if (unclear) {
      ++unclear_points;
      continue;
    }
    const NurbsCurve curve = bezier_curve(points);
    const CurveFootPoints found = project(p, curve);
    const auto stationary =
        std::count_if(found.foot_points.begin(), found.foot_points.end(),
                      [](const CurveFootPoint& foot_point) { return foot_point.kind != FootPointKind::border; });
    ++compared;
    foot_points += static_cast<int>(truth.size());
    EXPECT_EQ(stationary, static_cast<int>(truth.size())) << "trial " << trial;
    for (const auto& root : truth)
      EXPECT_TRUE(
          std::any_of(found.foot_points.begin(), found.foot_points.end(),
                      [&](const CurveFootPoint& foot_point) { return std::abs(foot_point.t - root[0]) < 1e-7; }))
          << "trial " << trial << " at " << root[0];
    // The first is the nearest of all points.
    for (int k = 0; k <= 64; ++k)
      EXPECT_LE(found.foot_points[0].distance, glm::length(curve.point(k / 64.0) - p) + 1e-15);
  }
  EXPECT_LT(unclear_points, compared / 50 + 2);
  tests::report_figure("points", compared);
  tests::report_figure("feet", foot_points);
}

TEST(RandomFootPoints, NoneOnASurfaceIsLost) {
  std::mt19937_64 random(4);
  int compared = 0, foot_points = 0, unclear_points = 0;
  using Two = std::array<Bernstein<1>, 2>;
  for (int trial = tests::tier_count(1000); trial > 0; --trial) {
    const int n = 1 + trial % 3, m = 1 + trial / 3 % 3;
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j)
        points.emplace_back((i + 0.6 * unit(random)) / n, (j + 0.6 * unit(random)) / m, unit(random));
    const Vec3 p(unit(random), unit(random), 2 * unit(random) - 0.5);
    const Bernstein<3> way = way_from(p, points, {n, m, 0});
    bool unclear = false;
    const auto truth = tests::roots_by_halving<2, Two>(
        {dot(way, derivative(way, 0)), dot(way, derivative(way, 1))}, 1e-9,
        [](const Two& f) { return changes_sign(f[0]) && changes_sign(f[1]); },
        [](const Two& f, int axis, bool upper) {
          return Two{f[0].half(axis, upper), f[1].half(axis, upper)};
        },
        unclear);
    if (unclear) {
      ++unclear_points;
      continue;
    }
    const NurbsSurface surface = bezier_surface(Grid<Vec3>{n + 1, m + 1, points});
    const SurfaceFootPoints found = project(p, surface);
    const auto stationary =
        std::count_if(found.foot_points.begin(), found.foot_points.end(),
                      [](const SurfaceFootPoint& foot_point) { return foot_point.kind != FootPointKind::border; });
    ++compared;
    foot_points += static_cast<int>(truth.size());
    EXPECT_EQ(stationary, static_cast<int>(truth.size())) << "trial " << trial;
    for (const auto& root : truth)
      EXPECT_TRUE(std::any_of(found.foot_points.begin(), found.foot_points.end(),
                              [&](const SurfaceFootPoint& foot_point) {
                                return std::abs(foot_point.u - root[0]) < 1e-6 &&
                                       std::abs(foot_point.v - root[1]) < 1e-6;
                              }))
          << "trial " << trial << " at " << root[0] << ", " << root[1];
    for (int i = 0; i <= 16; ++i)
      for (int j = 0; j <= 16; ++j)
        EXPECT_LE(found.foot_points[0].distance, glm::length(surface.point(i / 16.0, j / 16.0) - p) + 1e-15);
  }
  EXPECT_GT(foot_points, compared / 4);
  EXPECT_LT(unclear_points, compared / 20 + 2);
  tests::report_figure("points", compared);
  tests::report_figure("feet", foot_points);
}

// Rational pieces are searched by the signs of polynomials, others by intervals: the same shape is seen as both.

// The surface without the Bezier points of its pieces.
class WithoutBezierPoints final : public Surface {
 public:
  explicit WithoutBezierPoints(SurfacePtr surface) : surface_(std::move(surface)) {}
  Rectangle domain() const override { return surface_->domain(); }
  Periods periods() const override { return surface_->periods(); }
  SurfaceJet evaluate(double u, double v, int order) const override { return surface_->evaluate(u, v, order); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override { return surface_->enclose(box, order); }
  DegenerateEdges degenerate_edges() const override { return surface_->degenerate_edges(); }
  std::vector<SurfacePiece> pieces() const override {
    std::vector<SurfacePiece> pieces = surface_->pieces();
    for (SurfacePiece& piece : pieces) piece.points.clear();
    return pieces;
  }

 private:
  SurfacePtr surface_;
};

template <class FootPoints>
void expect_same_foot_points(const FootPoints& a, const FootPoints& b) {
  ASSERT_EQ(a.foot_points.size(), b.foot_points.size());
  std::vector<bool> taken(b.foot_points.size());
  for (const auto& foot_point : a.foot_points) {
    size_t k = 0;
    while (k < b.foot_points.size() && (taken[k] || b.foot_points[k].kind != foot_point.kind ||
                                        !(glm::length(b.foot_points[k].point - foot_point.point) < 1e-10)))
      ++k;
    ASSERT_LT(k, b.foot_points.size()) << "no partner at the distance " << foot_point.distance;
    taken[k] = true;
  }
}

SplineAxis random_axis(std::mt19937_64& random, int degree, int count) {
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < count - degree; ++i) {
    const bool twice = degree > 1 && i > 1 && random() % 4 == 0 && knots.back() != knots[knots.size() - 2];
    knots.push_back(knots.back() + (twice ? 0.0 : 0.3 + unit(random)));
  }
  knots.insert(knots.end(), degree + 1, knots.back() + 1);
  return SplineAxis(degree, knots, Extension::tangent);
}

// So that some points lie on the curve, some far off.
Vec3 random_place(std::mt19937_64& random, const Vec3& on) {
  const Vec3 p(2 * unit(random) - 0.5, 2 * unit(random) - 0.5, 2 * unit(random) - 0.5);
  const int kind = static_cast<int>(random() % 8);
  return kind == 0 ? on : kind == 1 ? on + 1e-5 * p : kind == 2 ? 300.0 * p : p;
}

TEST(RandomFootPoints, OfCurvesByPolynomialsAndByIntervals) {
  std::mt19937_64 random(8);
  int foot_points = 0;
  for (int trial = tests::tier_count(5000); trial > 0; --trial) {
    SCOPED_TRACE(trial);
    CurvePtr curve;
    if (trial % 5 == 0) {
      curve = std::make_shared<Ellipse>(frame_from({1, 2, 0}, {0.2, 0.3, 1}, {1, 0, 0}), 0.5 + unit(random), 1);
    } else {
      const int degree = 1 + trial % 5, count = degree + 1 + trial % 4;
      std::vector<Vec3> points(count);
      std::vector<double> weights(count);
      for (Vec3& p : points) p = {unit(random), unit(random), unit(random)};
      for (double& w : weights) w = std::exp2(6 * unit(random) - 3);
      curve = std::make_shared<NurbsCurve>(random_axis(random, degree, count), points, weights);
    }
    std::vector<CurvePiece> pieces = curve->pieces();
    for (CurvePiece& piece : pieces) piece.points.clear();
    const CurveProjector by_polynomials(curve), by_intervals(curve, pieces);
    for (int k = 0; k < 4; ++k) {
      const Interval t = curve->domain();
      const Vec3 p = random_place(random, curve->point(t.lo + t.width() * unit(random)));
      const CurveFootPoints found = by_polynomials.foot_points(p);
      foot_points += static_cast<int>(found.foot_points.size());
      expect_same_foot_points(found, by_intervals.foot_points(p));
    }
  }
  tests::report_figure("feet", foot_points);
}

TEST(RandomFootPoints, OfSurfacesByPolynomialsAndByIntervals) {
  std::mt19937_64 random(9);
  int foot_points = 0;
  for (int trial = tests::tier_count(1000); trial > 0; --trial) {
    SCOPED_TRACE(trial);
    SurfacePtr surface;
    if (trial % 5 == 0) {
      surface =
          std::make_shared<TorusSurface>(frame_from({1, 2, 0}, {0.2, 0.3, 1}, {1, 0, 0}), 0.5 + unit(random), 0.3);
    } else {
      const int p = 1 + trial % 4, q = 1 + trial / 4 % 3, m = p + 1 + trial % 3, n = q + 1 + trial % 2;
      std::vector<Vec3> points;
      std::vector<double> weights;
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
          points.emplace_back((i + 0.6 * unit(random)) / m, (j + 0.6 * unit(random)) / n, unit(random));
          weights.push_back(std::exp2(4 * unit(random) - 2));
        }
      surface = std::make_shared<NurbsSurface>(random_axis(random, p, m), random_axis(random, q, n), points, weights);
    }
    const SurfaceProjector by_polynomials(surface), by_intervals(std::make_shared<WithoutBezierPoints>(surface));
    for (int k = 0; k < 4; ++k) {
      const Rectangle domain = surface->domain();
      const Vec3 p = random_place(random, surface->point(domain.u.lo + domain.u.width() * unit(random),
                                                         domain.v.lo + domain.v.width() * unit(random)));
      const SurfaceFootPoints found = by_polynomials.foot_points(p);
      foot_points += static_cast<int>(found.foot_points.size());
      expect_same_foot_points(found, by_intervals.foot_points(p));
    }
  }
  tests::report_figure("feet", foot_points);
}

// Among few cells of the surface: patches, intervals, poles, seams and edges.
TEST(NearestOnSurface, IsTheFirstOfAllFootPoints) {
  std::mt19937_64 random(11);
  const std::array<SurfacePtr, 4> surfaces{
      std::make_shared<TorusSurface>(Frame{}, 0.5, 0.2, Rectangle{{0, kTwoPi}, {0, kTwoPi}}),
      std::make_shared<WithoutBezierPoints>(
          std::make_shared<TorusSurface>(Frame{}, 0.5, 0.2, Rectangle{{0.2, 3}, {0, kTwoPi}})),
      std::make_shared<WithoutBezierPoints>(
          std::make_shared<SphereSurface>(Frame{}, 0.6, Rectangle{{0, kTwoPi}, {-0.4, kPi / 2}})),
      std::make_shared<NurbsSurface>(
          bezier_surface(Grid<Vec3>{3, 2, {{0, 0, 0}, {0, 1, 0.3}, {0.5, 0, 1}, {0.5, 1, -1}, {1, 0, 0}, {1, 1, 0}}}))};
  for (const SurfacePtr& surface : surfaces) {
    const NearestOnSurface nearest_on(surface);
    const Rectangle domain = surface->domain();
    for (int k = tests::tier_count(20000); k > 0; --k) {
      const Vec3 on =
          surface->point(domain.u.lo + unit(random) * domain.u.width(), domain.v.lo + unit(random) * domain.v.width());
      const Vec3 p = random_place(random, on);
      const SurfaceFootPoints all = project(p, *surface);
      const auto nearest = nearest_on(p);
      ASSERT_TRUE(nearest.has_value());
      EXPECT_NEAR(nearest->distance, all.foot_points.front().distance, 1e-14 * (1 + glm::length(p)));
      EXPECT_LE(glm::length(surface->point(nearest->u, nearest->v) - nearest->point), 1e-15);
    }
  }
}

// Rounding puts points of a border to either side of it.
TEST(ClosestPointOnSurface, OfPointsOnItsBordersIsThere) {
  const std::array<TorusSurface, 2> parts{TorusSurface(Frame{}, 2.5, 0.5, {{0, kTwoPi}, {kPi / 2, 2.8}}),
                                          TorusSurface(Frame{}, 2.5, 0.5, {{0.1, 1.3}, {kPi / 2, kPi}})};
  for (const TorusSurface& part : parts) {
    const Rectangle domain = part.domain();
    for (int k = 0; k <= 20; ++k)
      for (const double off : {0.0, 1e-15, -1e-15})
        for (const double v : {domain.v.lo, domain.v.hi}) {
          const Vec3 p = part.point(domain.u.lo + domain.u.width() * k / 20, v) + Vec3(0, off, off);
          const SurfaceFootPoints found = project(p, part);
          ASSERT_FALSE(found.foot_points.empty());
          EXPECT_LE(found.foot_points.front().distance, 1e-14);
        }
  }
}

// The middle of a torus has a circle of foot points, of which the search finds boxes 2e-5 wide.
TEST(ClosestPointOnSurface, OfPointsOnTheAxisOfATorusIsExact) {
  const TorusSurface torus(Frame{}, 3, 1);
  for (const double z : {0.0, 0.5, -2.0, 7.0})
    EXPECT_NEAR(project({0, 0, z}, torus).foot_points.front().distance, std::hypot(3, z) - 1, 2e-15);
  EXPECT_NEAR(project({0, 3, 0}, torus).foot_points.front().distance, 1, 4e-16);
}

}  // namespace
}  // namespace lekalo::geometry::closest_point_test
