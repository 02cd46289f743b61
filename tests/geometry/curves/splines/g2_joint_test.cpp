#include "geometry/curves/splines/g2_joint.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/queries/differential/continuity.h"
#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry::g2_joint_test {
namespace {

RationalCubic random_cubic(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-10, 10), weight(0.3, 3);
  RationalCubic cubic;
  for (int i = 0; i < 4; ++i) {
    cubic.points[i] = {place(random), place(random), place(random)};
    cubic.weights[i] = weight(random);
  }
  return cubic;
}

NurbsCurve curve_of(const RationalCubic& cubic) { return bezier_curve(cubic.points, cubic.weights); }

// The closed forms at the ends against curvature and torsion from derivatives (Korotkij, Studenova 2024, formula 4).
TEST(RationalCubic, HasTheCurvatureOfItsDerivatives) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    const RationalCubic cubic = random_cubic(random);
    const NurbsCurve curve = curve_of(cubic);
    for (const bool end : {false, true}) {
      const CurveCurvature c = curvature(curve, end ? 1 : 0);
      const Vec3 k = end ? cubic.end_curvature() : cubic.start_curvature();
      EXPECT_LE(glm::length(k - c.curvature * c.binormal), 1e-11 * c.curvature);
      const Vec3 a = cubic.points[1] - cubic.points[0], b = cubic.points[2] - cubic.points[1];
      const Vec3 d = cubic.points[3] - cubic.points[2];
      const Vec3 area = end ? glm::cross(b, d) : glm::cross(a, b);
      const double torsion =
          cubic.start_invariant() * cubic.end_invariant() / 3 * glm::dot(glm::cross(a, b), d) / glm::dot(area, area);
      // Rounding is in proportion to the terms, not to their difference.
      EXPECT_NEAR(c.torsion, torsion, 1e-10 * (std::abs(torsion) + c.curvature));
    }
  }
}

TEST(RationalCubic, KeepsItsShapeInStandardForm) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 50; ++i) {
    RationalCubic cubic = random_cubic(random);
    const double start = cubic.start_invariant(), end = cubic.end_invariant();
    cubic.weights = weights_of_invariants(start, end);
    EXPECT_NEAR(cubic.start_invariant(), start, 1e-14 * start);
    EXPECT_NEAR(cubic.end_invariant(), end, 1e-14 * end);
    EXPECT_EQ(cubic.weights[0], 1);
    EXPECT_EQ(cubic.weights[3], 1);
  }
}

TEST(RationalCubic, GetsTheCurvatureAskedFor) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    RationalCubic cubic = random_cubic(random);
    const auto& p = cubic.points;
    cubic.weights = weights_of_invariants(invariant_of_curvature(0.4, p[0], p[1], p[2], "start_curvature"),
                                          invariant_of_curvature(1.7, p[3], p[2], p[1], "end_curvature"));
    EXPECT_NEAR(glm::length(cubic.start_curvature()), 0.4, 1e-14);
    EXPECT_NEAR(glm::length(cubic.end_curvature()), 1.7, 1e-14);
  }
  EXPECT_THROW(invariant_of_curvature(1, Vec3(0), {1, 0, 0}, {2, 0, 0}, "start_curvature"), FieldError);
}

// What lies between two parts of one cubic is the only cubic that joins them.
TEST(G2Transition, FindsTheMiddleOfACubicAgain) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  for (int i = 0; i < 50; ++i) {
    const RationalCubic whole = random_cubic(random);
    const double t0 = std::min(uniform(random), 0.5), t1 = t0 + 0.05 + 0.3 * uniform(random);
    const NurbsCurveForm form = *curve_of(whole).as_nurbs();
    const auto [before, rest] = split(form, t0);
    const auto [middle, after] = split(rest, t1);
    RationalCubic found;
    try {
      found = g2_transition(g2_end(NurbsCurve(before), true, "from"), g2_end(NurbsCurve(after), false, "to"),
                            std::nullopt, CubicWeights::standard);
    } catch (const FieldError& error) {
      ADD_FAILURE() << "cubic " << i << ": " << error.what();
      continue;
    }
    RationalCubic expected;
    for (int k = 0; k < 4; ++k) {
      expected.points[k] = Vec3(middle.points[k]) / middle.points[k].w;
      expected.weights[k] = middle.points[k].w;
    }
    for (int k = 0; k < 4; ++k) EXPECT_LE(glm::length(found.points[k] - expected.points[k]), 1e-7) << "cubic " << i;
    EXPECT_NEAR(found.start_invariant() / expected.start_invariant(), 1, 1e-6) << "cubic " << i;
    EXPECT_NEAR(found.end_invariant() / expected.end_invariant(), 1, 1e-6) << "cubic " << i;
  }
}

// A continuation, with handles of its own, against the joint report; both forms of knots are one curve.
TEST(G2Continuation, JoinsWithContinuousCurvature) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.3, 3);
  int joined = 0;
  for (int i = 0; i < 200; ++i) {
    const RationalCubic first = random_cubic(random), other = random_cubic(random);
    G2Continuation wish;
    wish.to = other.points[0];
    wish.line = other.points[1] - other.points[0];
    if (i % 2) wish.handle = uniform(random);
    wish.end_invariant = uniform(random);
    std::vector<RationalCubic> chain{first};
    try {
      chain.push_back(g2_continuation(g2_end(first), wish, CubicWeights::standard, 2));
    } catch (const FieldError&) {
      continue;  // on the wrong side: half of them
    }
    ++joined;
    EXPECT_EQ(joint(curve_of(first), curve_of(chain[1])).continuity.order, 2);
    EXPECT_LE(glm::length(chain[1].start_curvature() - first.end_curvature()),
              1e-12 * glm::length(first.end_curvature()));
    try {
      const NurbsCurve smooth(g2_chain_with_double_knots(chain));
      for (const CurvePiece& piece : smooth.pieces()) {
        const RationalCubic& segment = chain[piece.domain.lo > 0 ? 1 : 0];
        for (int k = 0; k < 4; ++k)
          EXPECT_LE(glm::length(Vec3(piece.points[k]) / piece.points[k].w - segment.points[k]), 1e-10);
      }
      // Homogeneous C1: the first derivative runs on.
      const double knot = smooth.pieces()[0].domain.hi;
      const Vec3 left = smooth.evaluate(next_down(knot), 1).d[1], right = smooth.evaluate(knot, 1).d[1];
      EXPECT_LE(glm::length(left - right), 1e-9 * glm::length(left));
    } catch (const FieldError& error) {
      EXPECT_EQ(error.field, "knots");
    }
  }
  EXPECT_GT(joined, 50);
}

// Three arcs of one circle have plane ends: the middle one comes out nearly round, G2 and polynomial.
TEST(G2Transition, OfPlaneCurvesIsPolynomial) {
  const G2End from{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, to{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  const RationalCubic cubic = g2_transition(from, to, std::nullopt, CubicWeights::standard);
  EXPECT_NEAR(cubic.start_invariant(), 1, 1e-13);
  EXPECT_NEAR(cubic.end_invariant(), 1, 1e-13);
  // x^2 = 2/3 (1 - x)
  const double length = (std::sqrt(7.0) - 1) / 3;
  EXPECT_NEAR(cubic.points[1].y, length, 1e-14);
  EXPECT_NEAR(cubic.points[2].x, length, 1e-14);
  const RationalCubic other = g2_transition(from, to, std::array<double, 2>{0.3, 0.6}, CubicWeights::standard);
  EXPECT_LE(glm::length(other.start_curvature() - Vec3(0, 0, 1)), 1e-14);
  EXPECT_LE(glm::length(other.end_curvature() - Vec3(0, 0, 1)), 1e-14);
}

// Of any ends, straight ones and those that turn away from each other too.
TEST(G2Transition, OfDegreeFiveJoinsAnyEnds) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20; ++i) {
    RationalCubic before = random_cubic(random);
    if (i == 0) before.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
    const NurbsCurve from = curve_of(before), to = curve_of(random_cubic(random));
    const std::vector<BezierSegment> segment{g2_quintic(g2_end(from, true, "from"), g2_end(to, false, "to"))};
    const NurbsCurve quintic(bezier_chain(segment));
    EXPECT_EQ(quintic.degree(), 5);
    for (const bool end : {false, true}) {
      const CurveCurvature a = curvature(quintic, end ? 1 : 0), b = curvature(end ? to : from, end ? 0 : 1);
      EXPECT_LE(glm::length(a.tangent - b.tangent), 1e-13);
      EXPECT_LE(glm::length(a.curvature * a.normal - b.curvature * b.normal), 1e-11 * (b.curvature + 1));
    }
  }
}

TEST(G2Transition, SaysWhichConditionFails) {
  const G2End from{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto field_of = [&](const G2End& to) {
    try {
      g2_transition(from, to, std::nullopt, CubicWeights::standard);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what();
    }
    return std::string();
  };
  EXPECT_EQ(field_of({{0, 1, 1}, {-1, 0, 0}, Vec3(0)}),
            "to: the curvature at its beginning is 0: there is no osculating plane");
  EXPECT_EQ(field_of({{0, 1, 1}, {-1, 0, 0}, {0, 0, 1}}),
            "from: its tangent at the end is parallel to the osculating plane of `to`: no single cubic joins them");
  EXPECT_EQ(
      field_of({{0, 1, 1}, {-1, 0, 0}, {0, 1, 0.5}}),
      "to: its tangent at the beginning is parallel to the osculating plane of `from`: no single cubic joins them");
}

}  // namespace
}  // namespace lekalo::geometry::g2_joint_test
