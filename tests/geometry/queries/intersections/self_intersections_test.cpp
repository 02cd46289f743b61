// Where curves and surfaces meet themselves: closed forms, singular cases whose truth is known, and random ones against
// crossings of chords and of triangles.
#include "geometry/queries/intersections/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"
#include "support/tier.h"

namespace lekalo::geometry::self_intersections_test {
namespace {

constexpr double kTurn = 2 * kPi;

FormulaCurve curve(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false) {
  return FormulaCurve(point_formulas(point, {"t"}, Coordinates::cartesian), domain, closed);
}
SurfacePtr surface(const std::array<std::string, 3>& point, const Rectangle& domain,
                   FormulaSurface::Closed closed = {}) {
  return std::make_shared<FormulaSurface>(point_formulas(point, {"u", "v"}, Coordinates::cartesian), domain, closed);
}

void check_meets(const Curve& one, const CurveSelfIntersections& found) {
  for (const CurveSelfIntersection& intersection : found.points) {
    EXPECT_LE(intersection.s, intersection.t);
    EXPECT_LT(glm::length(one.point(intersection.s) - one.point(intersection.t)), 1e-12);
    EXPECT_LT(glm::length(one.point(intersection.s) - intersection.point), 1e-12);
    EXPECT_EQ(intersection.kind == SelfIntersectionKind::cusp, intersection.s == intersection.t);
  }
}
// The same with the number of points of one kind, and none of another.
CurveSelfIntersections intersections_of(const Curve& one, size_t count,
                                        SelfIntersectionKind kind = SelfIntersectionKind::crossing) {
  const CurveSelfIntersections found = self_intersections(one);
  EXPECT_EQ(found.points.size(), count);
  for (const CurveSelfIntersection& intersection : found.points)
    EXPECT_EQ(intersection.kind, kind) << intersection.s << " " << intersection.t;
  check_meets(one, found);
  return found;
}

TEST(CurveWithItself, NodesOfPlaneCurves) {
  const CurveSelfIntersections node = intersections_of(curve({"t^2-1", "t^3-t", "0"}, {-2, 1.7}), 1);
  EXPECT_NEAR(node.points[0].s, -1, 1e-14);
  EXPECT_NEAR(node.points[0].t, 1, 1e-14);
  const CurveSelfIntersections limacon =
      intersections_of(curve({"(1+2*cos(t))*cos(t)", "(1+2*cos(t))*sin(t)", "0"}, {0, kTurn}, true), 1);
  EXPECT_NEAR(limacon.points[0].s, kTurn / 3, 1e-14);
  EXPECT_NEAR(limacon.points[0].t, 2 * kTurn / 3, 1e-14);
  intersections_of(curve({"sin(t)+2*sin(2*t)", "cos(t)-2*cos(2*t)", "0"}, {0, kTurn}, true), 3);
  // A loop of a part in 10000 of the curve.
  intersections_of(curve({"t^2-1e-8", "t^3-1e-8*t", "0"}, {-2, 1.7}), 1);
}

// sin(a t), sin(b t + phase) crosses itself in 2 a b - a - b points.
TEST(CurveWithItself, LissajousFiguresHaveTheirNumberOfNodes) {
  intersections_of(curve({"sin(3*t)", "sin(2*t+0.3)", "0"}, {0, kTurn}, true), 7);
  intersections_of(curve({"sin(9*t)", "sin(8*t+0.3)", "0"}, {0, kTurn}, true), 127);
}

TEST(CurveWithItself, ANodeOnTheSeamCountsOnce) {
  const CurveSelfIntersections eight = intersections_of(curve({"sin(t)", "sin(2*t)", "0"}, {0, kTurn}, true), 1);
  EXPECT_NEAR(eight.points[0].s, 0, 1e-14);
  EXPECT_NEAR(eight.points[0].t, kPi, 1e-14);
}

TEST(CurveWithItself, KnotsSeamsAndCornersAreNone) {
  intersections_of(Circle(Frame(), 2), 0);
  intersections_of(curve({"sin(t)+2*sin(2*t)", "cos(t)-2*cos(2*t)", "-sin(3*t)"}, {0, kTurn}, true), 0);
  intersections_of(curve({"cos(t)", "sin(t)", "0"}, {0, kTurn}), 0);
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  intersections_of(polyline(square, true), 0);
  const std::vector<Vec3> needle{{0, 0, 0}, {1, 0, 0}, {0, 0.002, 0}};
  intersections_of(polyline(needle, false), 0);
}

TEST(CurveWithItself, CrossingsOfAPentagram) {
  std::vector<Vec3> points;
  for (int k = 0; k < 5; ++k) points.push_back({std::cos(2 * k * kTurn / 5), std::sin(2 * k * kTurn / 5), 0});
  const CurveSelfIntersections found = intersections_of(polyline(points, true), 5);
  for (const CurveSelfIntersection& one : found.points)
    EXPECT_NEAR(glm::length(one.point), std::cos(kTurn / 5) / std::cos(kTurn / 10), 1e-14);
}

TEST(CurveWithItself, CuspsAreNamed) {
  EXPECT_NEAR(intersections_of(curve({"t^2", "t^3", "0"}, {-2, 1.7}), 1, SelfIntersectionKind::cusp).points[0].s, 0,
              1e-15);
  intersections_of(curve({"t^2", "t^3", "t^4"}, {-1, 1}), 1, SelfIntersectionKind::cusp);
  intersections_of(curve({"t-sin(t)", "1-cos(t)", "0"}, {-7, 14}), 4, SelfIntersectionKind::cusp);
  intersections_of(curve({"cos(t)^3", "sin(t)^3", "0"}, {0, kTurn}, true), 4, SelfIntersectionKind::cusp);
  // Beside a cusp the arms of a five-pointed hypocycloid are within the tolerance of each other.
  const FormulaCurve hypocycloid =
      curve({"3*cos(0.4*t)+2*cos(0.6*t)", "3*sin(0.4*t)-2*sin(0.6*t)", "0"}, {0, 5 * kTurn}, true);
  const CurveSelfIntersections found = self_intersections(hypocycloid);
  check_meets(hypocycloid, found);
  EXPECT_EQ(found.points.size(), 10u);
  EXPECT_EQ(std::count_if(found.points.begin(), found.points.end(),
                          [](const CurveSelfIntersection& one) { return one.kind == SelfIntersectionKind::cusp; }),
            5);
  // On its way back the parabola leaves the way there: no part is common.
  intersections_of(curve({"t^2", "t^4+t^5/2", "0"}, {-1, 1}), 1, SelfIntersectionKind::cusp);
}

// A helix whose derivatives are not enclosed about t = 1, as those of traced curves beside poles.
class HalfKnown final : public Curve {
 public:
  Interval domain() const override { return helix_.domain(); }
  CurveJet evaluate(double t, int order) const override { return helix_.evaluate(t, order); }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    CurveEnclosure result = helix_.enclose(t, order);
    if (intersect(t, {1 - 1e-6, 1 + 1e-6}).empty()) return result;
    for (int k = 1; k <= order; ++k) result.d[k] = {Vec3(-2), Vec3(2)};
    return result;
  }

 private:
  FormulaCurve helix_ = curve({"cos(t)", "sin(t)", "0.1*t"}, {0, 2});
};

TEST(CurveWithItself, WideEnclosuresAreNoCusps) { intersections_of(HalfKnown(), 0); }

TEST(CurveWithItself, TouchesItself) {
  const CurveSelfIntersections found =
      intersections_of(curve({"cos(t)", "sin(t)*cos(t)^2", "0"}, {0.1, kTurn - 0.1}), 1, SelfIntersectionKind::contact);
  EXPECT_NEAR(found.points[0].s, kPi / 2, 1e-9);
  EXPECT_NEAR(found.points[0].t, 3 * kPi / 2, 1e-9);
}

// A parabola y = x^2 that comes back along y = d.
TEST(CurveWithItself, CrossingsBesideATangentAreTwo) {
  const SplineAxis axis(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}, Extension::tangent);
  for (const double d : {1e-8, 1e-10, 1e-12}) {
    const std::vector<Vec3> points{{-1, 1, 0}, {0, -1, 0}, {1, 1, 0}, {3, 2, 0}, {2, d, 0}, {0, d, 0}, {-2, d, 0}};
    const CurveSelfIntersections met = intersections_of(NurbsCurve(axis, points), 2);
    EXPECT_NEAR(met.points[0].point.x, -std::sqrt(d), 1e-16 / std::sqrt(d)) << d;
    EXPECT_NEAR(met.points[1].point.x, std::sqrt(d), 1e-16 / std::sqrt(d)) << d;
  }
}

TEST(CurveWithItself, PartsRunTwice) {
  const CurveSelfIntersections twice = intersections_of(curve({"cos(t)", "sin(t)", "0"}, {0, 2 * kTurn}), 0);
  ASSERT_EQ(twice.common.size(), 1u);
  EXPECT_NEAR(twice.common[0].s.lo, 0, 1e-12);
  EXPECT_NEAR(twice.common[0].s.hi, kTurn, 1e-12);
  EXPECT_NEAR(twice.common[0].begin, kTurn, 1e-12);
  EXPECT_NEAR(twice.common[0].end, 2 * kTurn, 1e-12);
  const std::vector<Vec3> there_and_back{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const CurveSelfIntersections back = intersections_of(polyline(there_and_back, false), 0);
  ASSERT_EQ(back.common.size(), 1u);
  EXPECT_NEAR(back.common[0].begin, 2, 1e-12);
  EXPECT_NEAR(back.common[0].end, 1, 1e-12);
  const CurveSelfIntersections folded = intersections_of(curve({"t^2", "t^4", "0"}, {-1, 1}), 0);
  ASSERT_EQ(folded.common.size(), 1u);
  EXPECT_NEAR(folded.common[0].s.hi, 0, 1e-8);
  // Three times over a half turn: each pair of runs.
  EXPECT_EQ(self_intersections(curve({"cos(t)", "sin(t)", "0"}, {0, 2.5 * kTurn})).common.size(), 3u);
}

// Crossings of so many chords, not of neighbours. Their places too, for what is left unclear.
int crossings_of_chords(const Curve& one, int chords) {
  std::vector<Vec3> p;
  const Interval domain = one.domain();
  for (int k = 0; k <= chords; ++k) p.push_back(one.point(domain.lo + domain.width() * k / chords));
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  int count = 0;
  for (int i = 0; i < chords; ++i)
    for (int j = i + 2; j < chords; ++j)
      if (side(p[i], p[i + 1], p[j]) != side(p[i], p[i + 1], p[j + 1]) &&
          side(p[j], p[j + 1], p[i]) != side(p[j], p[j + 1], p[i + 1]))
        ++count;
  return count;
}

TEST(CurveWithItself, RandomPlaneCurvesAgainstChords) {
  std::mt19937 random(71);
  std::uniform_real_distribution<double> d(-1, 1);
  const int curves = tests::tier_count(2000, 40);
  int intersections = 0, unclear = 0;
  for (int k = 0; k < curves; ++k) {
    std::vector<Vec3> points;
    std::vector<double> weights;
    for (int i = 0; i < 5 + k % 6; ++i) {
      points.push_back({d(random), d(random), 0});
      weights.push_back(std::exp(d(random)));
    }
    const auto one = bezier_curve(points, weights);
    const int coarse = crossings_of_chords(one, 401), fine = crossings_of_chords(one, 997);
    if (coarse != fine) {
      ++unclear;
      continue;
    }
    const CurveSelfIntersections found = self_intersections(one);
    EXPECT_EQ(static_cast<int>(found.points.size()), fine) << k;
    check_meets(one, found);
    intersections += fine;
  }
  EXPECT_GT(intersections, curves / 4);
  EXPECT_LE(unclear, 1 + curves / 100);
  tests::report_figure("self_meetings_of_curves", intersections);
}

// What each branch promises.
void check_promises(const SurfacePtr& of, const Contours& found) {
  const double size = bounds(*of).diameter();
  for (const Contour& branch : found.branches) {
    EXPECT_LT(branch.error, 1e-13 * size);
    ASSERT_EQ(branch.images.size(), 2u);
    const Interval t = branch.curve->domain();
    for (int k = 0; k <= 60; ++k) {
      const double at = t.lo + t.width() * k / 60;
      const Vec3 p = branch.curve->point(at);
      // Next to a pinch point the branch is its chord.
      const bool at_chord = std::any_of(found.points.begin(), found.points.end(), [&](const ContourPoint& point) {
        return glm::length(point.point - p) < 6e-5 * size;
      });
      for (const Curve2Ptr& image : branch.images) {
        const Vec3 place = image->point(at);
        EXPECT_LT(glm::length(of->point(place.x, place.y) - p), (at_chord ? 1e-6 : 1e-12) * size) << at;
      }
    }
  }
}

TEST(SurfaceWithItself, WhitneysUmbrellaEndsAtItsPinchPoint) {
  const SurfacePtr umbrella = surface({"u*v", "u", "v^2"}, {{-1.2, 1.2}, {-1.2, 1.2}});
  const Contours found = self_intersection(umbrella);
  EXPECT_TRUE(found.complete);
  ASSERT_EQ(found.branches.size(), 1u);
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points[0].kind, ContourPointKind::end);
  EXPECT_LT(glm::length(found.points[0].point), 1e-12);
  const Contour& line = found.branches[0];
  EXPECT_FALSE(line.closed);
  EXPECT_NEAR(contour_length(line).value, 1.44, 1e-12);
  const Interval t = line.curve->domain();
  EXPECT_LT(std::min(line.curve->point(t.lo).z, line.curve->point(t.hi).z), 1e-12);
  for (int k = 0; k <= 40; ++k) {
    const double at = t.lo + t.width() * k / 40;
    const Vec3 a = line.images[0]->point(at), b = line.images[1]->point(at);
    EXPECT_NEAR(a.x, 0, 1e-12);
    EXPECT_NEAR(a.y, -b.y, 1e-12);
    EXPECT_GE(a.y * line.images[0]->point(t.middle()).y, 0);  // the first image stays the first
  }
  check_promises(umbrella, found);
}

TEST(SurfaceWithItself, ACylinderOverAnEightMeetsItselfInALine) {
  const SurfacePtr tube = surface({"sin(v)", "sin(2*v)", "u"}, {{-1, 1.5}, {0, kTurn}}, {false, true});
  const Contours found = self_intersection(tube);
  EXPECT_TRUE(found.complete && found.points.empty());
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_NEAR(contour_length(found.branches[0]).value, 2.5, 1e-13);
  check_promises(tube, found);
}

// The eight's two strands pass each other 0.4 apart along z.
TEST(SurfaceWithItself, ExtrusionsMeetThemselvesWhereTheirProfileDoesAsItIsSeen) {
  const auto eight = std::make_shared<FormulaCurve>(curve({"cos(t)", "sin(t)*cos(t)", "0.2*sin(t)"}, {0, kTurn}, true));
  for (const double length : {1.0, 0.3}) {
    const SurfacePtr wall = std::make_shared<ExtrusionSurface>(eight, Vec3(0, 0, length));
    const SurfacePtr turned = transformed(wall, Affine::rotation(0.7, Vec3(1, 2, 2) / 3.0, Vec3(3, 1, 0)));
    for (const SurfacePtr& one : {wall, turned}) {
      const Contours found = self_intersection(one);
      EXPECT_TRUE(found.complete && found.points.empty());
      ASSERT_EQ(found.branches.size(), length > 0.4 ? 1u : 0u);
      if (found.branches.empty()) continue;
      EXPECT_NEAR(contour_length(found.branches[0]).value, 0.6, 1e-13);
      check_promises(one, found);
    }
  }
}

// x = 23/7 where t (1 - t) = 1/7.
TEST(SurfaceWithItself, RevolutionsMeetThemselvesInCircles) {
  const std::vector<Vec3> points{{2, 0, -1}, {5, 0, 2}, {5, 0, -2}, {2, 0, 1}};
  const auto loop = std::make_shared<NurbsCurve>(bezier_curve(points));
  const Axis axis{Vec3(0), Vec3(0, 0, 1)};
  for (const double angle : {kTurn, 1.5}) {
    const SurfacePtr ring = std::make_shared<RevolutionSurface>(loop, axis, angle);
    const Contours found = self_intersection(ring);
    EXPECT_TRUE(found.complete && found.points.empty());
    ASSERT_EQ(found.branches.size(), 1u);
    EXPECT_EQ(found.branches[0].closed, angle == kTurn);
    EXPECT_NEAR(contour_length(found.branches[0]).value, angle * 23 / 7, 1e-12);
    check_promises(ring, found);
  }
}

TEST(SurfaceWithItself, KleinsBottleOfAnEightMeetsItselfInACircle) {
  const SurfacePtr bottle =
      surface({"(2 + cos(u/2)*sin(v) - sin(u/2)*sin(2*v))*cos(u)", "(2 + cos(u/2)*sin(v) - sin(u/2)*sin(2*v))*sin(u)",
               "sin(u/2)*sin(v) + cos(u/2)*sin(2*v)"},
              {{0, kTurn}, {0, kTurn}}, {false, true});
  const Contours found = self_intersection(bottle);
  EXPECT_TRUE(found.complete && found.points.empty());
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  EXPECT_NEAR(contour_length(found.branches[0]).value, 2 * kTurn, 1e-12);
  check_promises(bottle, found);
}

// Its double curves lie in the planes x = 0 and y = 0, where v^2 = 3 + 3 u^2 and u^2 = 3 + 3 v^2.
TEST(SurfaceWithItself, EnnepersSurface) {
  for (const double half : {1.7, 1.8, 2.2}) {
    const SurfacePtr enneper = surface({"u-u^3/3+u*v^2", "v-v^3/3+v*u^2", "u^2-v^2"}, {{-half, half}, {-half, half}});
    const Contours found = self_intersection(enneper);
    EXPECT_TRUE(found.complete && found.points.empty());
    ASSERT_EQ(found.branches.size(), half * half > 3 ? 2u : 0u);
    for (const Contour& branch : found.branches) {
      const Interval t = branch.curve->domain();
      for (int k = 0; k <= 20; ++k) {
        const Vec3 at = branch.images[0]->point(t.lo + t.width() * k / 20);
        const double a = at.x * at.x, b = at.y * at.y;
        EXPECT_NEAR(std::max(a, b), 3 + 3 * std::min(a, b), 1e-11);
      }
    }
    check_promises(enneper, found);
  }
}

TEST(SurfaceWithItself, SeamsAndPolesAreNone) {
  const std::vector<SurfacePtr> simple{
      std::make_shared<SphereSurface>(Frame(), 1.0), std::make_shared<TorusSurface>(Frame(), 3.0, 1.0),
      std::make_shared<TorusSurface>(Frame(), 1.0, 2.0),
      surface({"(2+v*cos(u/2))*cos(u)", "(2+v*cos(u/2))*sin(u)", "v*sin(u/2)"}, {{0, kTurn}, {-0.7, 0.7}}),
      surface({"v*cos(u)", "v*sin(u)", "v"}, {{0, kTurn}, {0, 1}}, {true, false})};
  for (const SurfacePtr& one : simple) {
    const Contours found = self_intersection(one);
    EXPECT_TRUE(found.complete && found.branches.empty() && found.points.empty()) << found.points.size();
  }
}

TEST(SurfaceWithItself, PointsThroughWhichItRunsAgain) {
  const Contours spindle = self_intersection(
      surface({"(1+2*cos(v))*cos(u)", "(1+2*cos(v))*sin(u)", "2*sin(v)"}, {{0, kTurn}, {0, kTurn}}, {true, true}));
  EXPECT_TRUE(spindle.complete && spindle.branches.empty());
  ASSERT_EQ(spindle.points.size(), 2u);
  for (const ContourPoint& point : spindle.points) {
    EXPECT_EQ(point.kind, ContourPointKind::contact);
    EXPECT_LT(glm::length(Vec3(0, 0, std::sqrt(3)) - glm::abs(point.point)), 1e-12);
  }
  const Contours cone = self_intersection(surface({"v*cos(u)", "v*sin(u)", "v"}, {{0, kTurn}, {-1, 1}}, {true, false}));
  EXPECT_TRUE(cone.complete && cone.branches.empty());
  EXPECT_EQ(cone.points.size(), 1u);
}

TEST(SurfaceWithItself, WhatIsNoCurveIsSaidToBeLeftOut) {
  EXPECT_FALSE(self_intersection(surface({"cos(u)", "sin(u)", "v"}, {{0, 2 * kTurn}, {0, 1}})).complete);
  EXPECT_FALSE(self_intersection(surface({"u^2", "u^3", "v"}, {{-1, 1}, {0, 1}})).complete);
  EXPECT_THROW(self_intersection(std::make_shared<Plane>(Frame())), std::invalid_argument);
}

// Triangles of a grid of so many sides, and the segments in which those that have no common corner meet.
std::vector<std::array<Vec3, 2>> intersections_of_triangles(const Surface& of, int sides) {
  struct Triangle {
    std::array<Vec3, 3> p;
    int i, j;
    Box3 box;
  };
  std::vector<Triangle> triangles;
  const auto point = [&](int i, int j) { return of.point(double(i) / sides, double(j) / sides); };
  for (int i = 0; i < sides; ++i)
    for (int j = 0; j < sides; ++j)
      for (const bool upper : {false, true}) {
        Triangle t{
            {point(i, j), upper ? point(i + 1, j + 1) : point(i + 1, j), upper ? point(i, j + 1) : point(i + 1, j + 1)},
            i,
            j,
            {}};
        for (const Vec3& p : t.p) t.box.include(p);
        triangles.push_back(t);
      }
  // Where the sides of one triangle pierce the other.
  const auto pierce = [](const Triangle& a, const Triangle& b, std::vector<Vec3>& at) {
    const Vec3 n = glm::cross(b.p[1] - b.p[0], b.p[2] - b.p[0]);
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = a.p[k], to = a.p[(k + 1) % 3];
      const double h0 = glm::dot(n, from - b.p[0]), h1 = glm::dot(n, to - b.p[0]);
      if ((h0 > 0) == (h1 > 0)) continue;
      const Vec3 x = from + h0 / (h0 - h1) * (to - from);
      bool inside = true;
      for (int c = 0; c < 3; ++c)
        inside = inside && glm::dot(n, glm::cross(b.p[(c + 1) % 3] - b.p[c], x - b.p[c])) >= 0;
      if (inside) at.push_back(x);
    }
  };
  std::vector<std::array<Vec3, 2>> segments;
  for (size_t a = 0; a < triangles.size(); ++a)
    for (size_t b = a + 1; b < triangles.size(); ++b) {
      const Triangle &x = triangles[a], &y = triangles[b];
      if (glm::any(glm::lessThan(x.box.hi, y.box.lo)) || glm::any(glm::lessThan(y.box.hi, x.box.lo))) continue;
      if (std::abs(x.i - y.i) <= 1 && std::abs(x.j - y.j) <= 1) continue;
      std::vector<Vec3> at;
      pierce(x, y, at);
      pierce(y, x, at);
      if (at.size() >= 2) segments.push_back({at[0], at[1]});
    }
  return segments;
}

double distance_to(const Vec3& p, const std::array<Vec3, 2>& segment) {
  const Vec3 way = segment[1] - segment[0];
  const double square = glm::dot(way, way);
  const double share = square > 0 ? std::clamp(glm::dot(p - segment[0], way) / square, 0.0, 1.0) : 0;
  return glm::length(segment[0] + share * way - p);
}

TEST(SurfaceWithItself, RandomBentPatchesAgainstTriangles) {
  std::mt19937 random(73);
  std::uniform_real_distribution<double> d(-1, 1);
  constexpr int kSides = 40;
  const int patches = tests::tier_count(300, 12);
  int branches = 0, pinches = 0;
  for (int k = 0; k < patches; ++k) {
    // A loop of a cubic that opens along v or not.
    Grid<Vec3> points{4, 4, std::vector<Vec3>(16)};
    const double unrest = 0.15 + 0.5 * std::abs(d(random)), opens = 1.3 * d(random);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const std::array<double, 4> x{-1, 2, -2, 1}, y{0, 1.4, 1.4, 0};
        const double loop = 1 - std::max(0.0, opens) * j / 3;
        points.at(i, j) =
            Vec3((i == 1 || i == 2 ? loop : 1) * x[i], y[i], 0.8 * j) + unrest * Vec3(d(random), d(random), d(random));
      }
    const SurfacePtr patch = std::make_shared<NurbsSurface>(bezier_surface(points));
    const Contours found = self_intersection(patch);
    EXPECT_TRUE(found.complete) << k;
    check_promises(patch, found);
    const std::vector<std::array<Vec3, 2>> segments = intersections_of_triangles(*patch, kSides);
    // Places of our branches, as segments.
    std::vector<std::array<Vec3, 2>> ours;
    std::vector<Vec3> ends;
    for (const Contour& branch : found.branches) {
      const Interval t = branch.curve->domain();
      for (int i = 0; i < 400; ++i)
        ours.push_back(
            {branch.curve->point(t.lo + t.width() * i / 400), branch.curve->point(t.lo + t.width() * (i + 1) / 400)});
      ends.push_back(branch.curve->point(t.lo)), ends.push_back(branch.curve->point(t.hi));
    }
    // A chord of the grid leaves the patch by less than this; where sheets meet at a small angle the curve moves more.
    constexpr double kGrid = 0.05;
    int lost = 0, false_ones = 0;
    for (const auto& segment : segments) {
      double nearest = kInfinity;
      for (const auto& one : ours) nearest = std::min(nearest, distance_to(0.5 * (segment[0] + segment[1]), one));
      lost += nearest > kGrid;
    }
    for (const auto& one : ours) {
      double nearest = kInfinity;
      for (const auto& segment : segments) nearest = std::min(nearest, distance_to(one[0], segment));
      for (const Vec3& end : ends) nearest = std::min(nearest, glm::length(end - one[0]) / 6);
      false_ones += nearest > kGrid;
    }
    EXPECT_EQ(lost, 0) << k << " of " << segments.size();
    EXPECT_EQ(false_ones, 0) << k << " of " << ours.size();
    branches += static_cast<int>(found.branches.size());
    for (const ContourPoint& point : found.points) pinches += point.kind == ContourPointKind::end;
  }
  EXPECT_GT(branches, patches / 2);
  tests::report_figure("double_curves", branches);
  tests::report_figure("pinch_points", pinches);
}

}  // namespace
}  // namespace lekalo::geometry::self_intersections_test
