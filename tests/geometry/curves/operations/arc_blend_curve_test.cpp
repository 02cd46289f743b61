#include "geometry/curves/operations/arc_blend_curve.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry::arc_blend_curve_test {
namespace {

const std::vector<Vec3> kNodes{{0, 0, 0}, {1, 0.8, 0.3}, {2.2, 0.9, -0.2}, {3, 0, 0.5}, {4.2, -0.4, 0.1}};

TEST(ArcBlendCurve, MeetsTheGeneralChecks) {
  const ArcBlendCurve open(kNodes, false);
  const ArcBlendCurve closed({{2, 0, 0}, {1, 1.4, 0.4}, {-1, 1.6, 0}, {-2.2, 0, 0.3}, {-1, -1.5, 0}, {1.2, -1.3, 0.2}},
                             true);
  for (const ArcBlendCurve* curve : {&open, &closed}) {
    checks::check_enclosures(*curve, curve->domain());
    checks::check_pieces(*curve);
    checks::check_period(*curve);
    for (const CurvePiece& piece : curve->pieces()) checks::check_differences(*curve, piece.domain);
  }
}

// The tangent at a node is that of the circle through it and its neighbours.
TEST(ArcBlendCurve, TouchesTheCircles) {
  const ArcBlendCurve curve(kNodes, false);
  double t = 0;
  for (size_t i = 1; i + 1 < kNodes.size(); ++i) {
    t += glm::length(kNodes[i] - kNodes[i - 1]);
    const Circle circle = arc_through(kNodes[i - 1], kNodes[i], kNodes[i + 1]);
    const Vec3 radius = kNodes[i] - circle.frame().origin;
    for (const double at : {next_down(t), t}) {
      const Vec3 tangent = glm::normalize(curve.evaluate(at, 1).d[1]);
      EXPECT_LE(std::abs(glm::dot(tangent, glm::normalize(radius))), 1e-14);
      EXPECT_LE(std::abs(glm::dot(tangent, circle.frame().z)), 1e-14);
    }
  }
}

TEST(ArcBlendCurve, IsExactOnCirclesAndLines) {
  const Circle circle(frame_from({1, 2, 3}, {1, 2, 2}, {1, 0, 0}), 2.5, {0, 5});
  std::vector<Vec3> nodes;
  for (const double t : {0.0, 0.4, 1.3, 1.9, 3.1, 4.2, 5.0}) nodes.push_back(circle.point(t));
  const ArcBlendCurve curve(nodes, false);
  for (int i = 0; i <= 300; ++i) {
    const Vec3 p = circle.frame().to_local_point(curve.point(curve.domain().hi * i / 300));
    EXPECT_NEAR(std::hypot(p.x, p.y), 2.5, 2e-15 * 5);
    EXPECT_NEAR(p.z, 0, 2e-15);
  }
  const ArcBlendCurve line({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, false);
  EXPECT_LE(glm::length(line.point(2.5) - Vec3(2.5 / std::sqrt(3.0))), 1e-15);
}

// Points of y = x^2 about the chord from (0.5 - d/2) to (0.5 + d/2): Zavyalov's check, and brute force.
TEST(ArcBlendCurve, LiesBetweenBothArcs) {
  for (const auto& [d, middle] :
       {std::pair(1.0, Vec3(0.62132034356, 0.37867965644, 0)), std::pair(0.5, Vec3(0.537290715725, 0.275209284275, 0)),
        std::pair(0.25, Vec3(0.508347895273, 0.257277104727, 0))}) {
    std::vector<Vec3> nodes;
    for (int k = -1; k <= 2; ++k) {
      const double x = 0.5 + d * (k - 0.5);
      nodes.push_back({x, x * x, 0});
    }
    const ArcBlendCurve curve(nodes, false);
    const Interval part = curve.pieces()[1].domain;
    EXPECT_LE(glm::length(curve.point(part.middle()) - middle), 2e-12) << d;
  }
}

// The same nodes: the largest distance from y = x^2 along the normal of the chord, by bisection.
TEST(ArcBlendCurve, DeviatesFromAParabolaByTheThirdOrder) {
  for (const auto& [d, deviation] :
       {std::pair(1.0, 0.0199), std::pair(0.5, 0.0145), std::pair(0.25, 1.615e-3), std::pair(0.125, 1.680e-4)}) {
    std::vector<Vec3> nodes;
    for (int k = -1; k <= 2; ++k) {
      const double x = 0.5 + d * (k - 0.5);
      nodes.push_back({x, x * x, 0});
    }
    const ArcBlendCurve curve(nodes, false);
    const Interval part = curve.pieces()[1].domain;
    const Vec3 along = glm::normalize(nodes[2] - nodes[1]), across(-along.y, along.x, 0);
    double largest = 0;
    for (int i = 1; i < 400; ++i) {
      const Vec3 p = curve.point(part.lo + part.width() * i / 400);
      double below = -1, above = 1;
      while (above - below > 1e-15) {
        const Vec3 q = p + 0.5 * (below + above) * across;
        (q.y < q.x * q.x ? below : above) = 0.5 * (below + above);
      }
      largest = std::max(largest, std::abs(below));
    }
    EXPECT_NEAR(largest / deviation, 1, 3e-3) << d;
  }
}

// The distance from a curve of samples, brute force.
double farthest(const Curve& blend, const Curve& curve) {
  std::vector<Vec3> samples;
  constexpr int kSamples = 20000;
  for (int i = 0; i <= kSamples; ++i)
    samples.push_back(curve.point(curve.domain().lo + curve.domain().width() * i / kSamples));
  double result = 0;
  size_t near = 0;
  for (int i = 0; i <= 400; ++i) {
    const Vec3 p = blend.point(blend.domain().lo + blend.domain().width() * i / 400);
    // Nearest goes on with the parameter.
    while (near + 1 < samples.size() && glm::length(samples[near + 1] - p) <= glm::length(samples[near] - p)) ++near;
    const Vec3 a = samples[near > 0 ? near - 1 : 0], b = samples[std::min(near + 1, samples.size() - 1)];
    result = std::max(result, glm::length(glm::cross(p - a, glm::normalize(b - a))));
  }
  return result;
}

TEST(ArcBlendCurve, IsWithinItsBounds) {
  const Parabola parabola(Frame(), 0.5, {-1, 2});
  const Ellipse ellipse(frame_from({1, 0, 0}, {1, 1, 3}, {1, 0, 0}), 2, 1.3, {0.2, 5});
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 1, 0.3}, {2.4, 2, 1}};
  const NurbsCurve cubic = bezier_curve(points);
  for (const Curve* curve :
       {static_cast<const Curve*>(&parabola), static_cast<const Curve*>(&ellipse), static_cast<const Curve*>(&cubic)}) {
    double before = 0;
    for (const int count : {8, 16, 32}) {
      const std::vector<double> parameters = parameters_at_even_lengths(ArcFraction(*curve), curve->domain(), count);
      std::vector<Vec3> nodes;
      for (const double t : parameters) nodes.push_back(curve->point(t));
      const auto bounds = arc_blend_bounds(*curve, parameters);
      if (!bounds) {
        EXPECT_LT(count, 16);
        continue;
      }
      const double distance = farthest(ArcBlendCurve(nodes, false), *curve);
      EXPECT_LE(distance, bounds->position);
      // Third order.
      if (before > 0) {
        EXPECT_LE(distance, before / 4);
      }
      before = distance;
    }
  }
}

TEST(ArcBlendCurve, RefusesHalfCircles) {
  EXPECT_THROW(ArcBlendCurve({{0, 0, 0}, {0.2, 1, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}, false), FieldError);
  EXPECT_THROW(ArcBlendCurve({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}}, false), FieldError);
  EXPECT_THROW(ArcBlendCurve({{0, 1, 0}, {0, 0, 0}, {1, 1 - 1e-7, 0}}, false), FieldError);
  const ArcBlendCurve nearly({{0, 1, 0}, {0, 0, 0}, {1, 1 - 1e-4, 0}}, false);
  checks::check_enclosures(nearly, nearly.domain());
}

TEST(EpsilonNet, IsANet) {
  const Ellipse ellipse(Frame(), 3, 1, {0, kTwoPi});
  Fields f;
  f.set("of", CurvePtr(std::make_shared<Ellipse>(ellipse)));
  f.set("epsilon", 0.1);
  for (const TypeDeclaration& type : geometry_types()) {
    if (type.name != "epsilon_net") continue;
    const CurvePtr net = std::any_cast<CurvePtr>(type.build(f));
    const int count = static_cast<int>(net->domain().hi);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = ellipse.point(kTwoPi * i / 1000);
      double nearest = kInfinity;
      for (int k = 0; k < count; ++k) nearest = std::min(nearest, glm::length(net->point(k) - p));
      EXPECT_LE(nearest, 0.1);
    }
    // Ramanujan: the length is 13.36489322.
    EXPECT_EQ(count, 67);
    EXPECT_TRUE(net->is_closed());
  }
}

TEST(ArcFraction, CutsIntoPartsOfEqualLength) {
  const Parabola parabola(Frame(), 0.5, {-1, 2});
  const ArcFraction lengths(parabola);
  const std::vector<double> t = parameters_at_even_lengths(lengths, parabola.domain(), 7);
  ASSERT_EQ(t.size(), 8u);
  for (int i = 0; i <= 7; ++i) EXPECT_NEAR(lengths.at(t[i]), i / 7.0, 1e-14);
}

}  // namespace
}  // namespace lekalo::geometry::arc_blend_curve_test
