#include "geometry/surfaces/splines/nurbs_surface.h"

#include <set>

#include "geometry/curves/spline_oracle.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/worst.h"

namespace lekalo::geometry::nurbs_surface_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LE(distance(a, b), tolerance); }

SplineAxis open_axis(int degree, const List& knots) { return {degree, knots, Extension::tangent}; }
SplineAxis closed_axis(int degree, int points) {
  return {degree, knots_by_rule("uniform", degree, points, true, {}), Extension::periodic};
}

// Coursework 2024, 1.4.4: two arches with a crease along y = 1; u runs with y, v with x.
NurbsSurface arches() {
  Points points;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j) points.push_back({j, i / 2.0, i % 2 == 0 ? 0 : j == 1 ? 1.2 : 1.3});
  return NurbsSurface(open_axis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), open_axis(2, {0, 0, 0, 1, 1, 1}), points);
}

TEST(NurbsSurface, ArchesHaveThePublishedDerivatives) {
  const NurbsSurface s = arches();
  const auto check = [&](double u, double v, const Vec3& p, const Vec3& du, const Vec3& dv) {
    const SurfaceJet jet = s.evaluate(u, v, 1);
    expect_near(jet.point(), p, 1e-15);
    expect_near(jet.du(), du, 4e-15);
    expect_near(jet.dv(), dv, 4e-15);
  };
  check(0.25, 0.5, {1, 0.5, 0.625}, {0, 2, 0}, {2, 0, 0});
  check(0.25, 0, {0, 0.5, 0.65}, {0, 2, 0}, {2, 0, -0.1});
  check(0.1, 0.2, {0.4, 0.2, 0.40576}, {0, 2, 3.0432}, {2, 0, -0.0384});
  expect_near(s.point(0.8, 0.3), {0.6, 1.6, 0.60384}, 1e-15);
  expect_near(s.evaluate(0.8, 0.3, 1).du(), {0, 2, -1.0064}, 4e-15);
  expect_near(s.evaluate(0.5, 0.5, 1).du(), {0, 2, 5}, 4e-15);
  expect_near(s.evaluate(std::nextafter(0.5, 0.0), 0.5, 1).du(), {0, 2, -5}, 1e-14);
  EXPECT_EQ(s.pieces().size(), 2u);
}

// Golovanov 2016, 3.8: impulse and Greville points on the 9 x 7 integer net (i with v there: here v is the second
// index).
TEST(NurbsSurface, IntegerKnotNetHasTheBooksImpulseAndReproducesItsParameters) {
  const List ku = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}, kv = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
  const List xi = {0, 1. / 3, 1, 2, 3, 4, 5, 17. / 3, 6}, eta = {0, 1. / 3, 1, 2, 3, 11. / 3, 4};
  Points points;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 7; ++i) points.push_back({xi[j], eta[i], i == 3 && j == 4 ? 1 : 0});
  const NurbsSurface s(open_axis(3, ku), open_axis(3, kv), points);
  expect_near(s.point(3, 2), {3, 2, 4. / 9}, 1e-15);
  for (double u = 0; u <= 6; u += 0.4)
    for (double v = 0; v <= 4; v += 0.4) {
      EXPECT_NEAR(s.point(u, v).x, u, 2e-15);
      EXPECT_NEAR(s.point(u, v).y, v, 2e-15);
    }
}

// Golovanov 2016, 3.8: the whole unit sphere with poles at v = 0 and v = 1.
NurbsSurface sphere() {
  const double h = std::sqrt(0.5);
  const double circle[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  const double meridian[5][2] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}};
  Points points;
  List weights;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 5; ++i) {
      points.push_back({meridian[i][0] * circle[j][0], meridian[i][0] * circle[j][1], meridian[i][1]});
      weights.push_back((i % 2 ? h : 1) * (j % 2 ? h : 1));
    }
  return NurbsSurface(open_axis(2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}),
                      open_axis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), points, weights);
}

TEST(NurbsSurface, SphereIsASphereWithItsNormals) {
  const NurbsSurface s = sphere();
  expect_near(s.point(0.1, 0.3), {0.662312816954606, 0.472921293084019, -0.581108581114919}, 1e-14);
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const Vec3 p = s.point(i / 40.0, j / 40.0);
      EXPECT_NEAR(glm::length(p), 1, 1e-15);
      expect_near(s.normal(i / 40.0, j / 40.0), p, 1e-14);  // poles included
    }
  // Through the poles without a step, however near.
  for (double d = 1e-15; d < 1e-3; d *= 10) {
    expect_near(s.normal(0.3, d), s.point(0.3, d), 4e-8);
    expect_near(s.normal(0.3, 1 - d), s.point(0.3, 1 - d), 4e-8);
  }
  const DegenerateEdges edges = s.degenerate_edges();
  EXPECT_TRUE(edges.v_min && edges.v_max && !edges.u_min && !edges.u_max);
  checks::check_degenerate_edges(s);
  checks::check_nurbs(s);
  checks::check_pieces(s);
  for (const SurfacePiece& piece : s.pieces()) checks::check_enclosures(s, piece.domain);
}

// Golovanov 2016, 3.8: closed bicubic net around a torus.
TEST(NurbsSurface, ClosedNetHasTheBooksPoints) {
  Points points;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 6; ++i) {
      const double rho = 3 + std::cos(kTwoPi * i / 6);
      points.push_back({rho * std::cos(kTwoPi * j / 8), rho * std::sin(kTwoPi * j / 8), std::sin(kTwoPi * i / 6)});
    }
  const NurbsSurface s(closed_axis(3, 8), closed_axis(3, 6), points);
  EXPECT_EQ(s.periods().u, 8);
  EXPECT_EQ(s.periods().v, 6);
  const Vec3 corner(2.180076557147136, 2.180076557147136, 0.721687836487032);
  expect_near(s.point(0, 0), corner, 2e-15);
  expect_near(s.point(8, 6), corner, 2e-15);
  expect_near(s.point(-8, 12), corner, 2e-15);
  expect_near(s.point(2.5, 1.25), {-2.009153992321184, 0.832218832515484, 0.588626641634736}, 2e-15);
  for (int k = 0; k < 6; ++k) expect_near(s.evaluate(0, 2.2, 2).values[k], s.evaluate(8, 2.2, 2).values[k], 2e-14);
  checks::check_nurbs(s);
  checks::check_pieces(s);
  checks::check_enclosures(s, s.domain());
  checks::check_degenerate_edges(s);
}

struct RandomSurfaces {
  std::mt19937_64 random{19};
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

  // Clamped or not, with repeated knots (at most `degree` equal ones inside), spans that differ by a factor of 100.
  List knots(int degree, int count) {
    const bool clamped = uniform(0, 1) < 0.5;
    List result(clamped ? degree + 1 : 1, uniform(-3, 3));
    const int inner = clamped ? count - degree - 1 : count + degree;
    for (int i = 0, run = degree; i < inner; ++i) {
      run = run < degree && uniform(0, 1) < 0.3 ? run + 1 : 1;
      result.push_back(result.back() + (run > 1 ? 0 : std::pow(10, uniform(-1, 1))));
    }
    if (clamped) result.insert(result.end(), degree + 1, result.back() + 1);
    return result[degree] < result[count] ? result : knots(degree, count);
  }
  NurbsSurface surface(int p, int q, int rows, int columns, double decades) {
    Points points;
    List weights;
    for (int k = 0; k < rows * columns; ++k) {
      points.push_back({uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)});
      weights.push_back(std::pow(10, uniform(-decades, decades)));
    }
    return NurbsSurface(open_axis(p, knots(p, rows)), open_axis(q, knots(q, columns)), points,
                        decades > 0 ? weights : List());
  }
};

// Points and derivatives to order 4 against 113 bits: within 64 eps of the formula's absolute terms.
TEST(NurbsSurface, DerivativesAgreeWithHigherPrecision) {
  RandomSurfaces some;
  double worst = 0;
  for (int sample = 0; sample < 20; ++sample) {
    const int p = 1 + sample % 5, q = 1 + sample % 3;
    const NurbsSurface s = some.surface(p, q, p + 1 + sample % 3, q + 2, sample % 4);
    const NurbsSurfaceForm form = *s.as_nurbs();
    for (int i = 0; i < 3; ++i) {
      const Rectangle d = s.domain();
      const double u = i == 0 ? d.u.hi : some.uniform(d.u.lo, d.u.hi), v = some.uniform(d.v.lo, d.v.hi);
      const auto exact = oracle::surface_derivatives(form, u, v, kMaxSurfaceOrder);
      const SurfaceJet jet = s.evaluate(u, v, kMaxSurfaceOrder);
      for (size_t k = 0; k < exact.size(); ++k)
        worst = tests::worse(worst, oracle::error_in_eps(jet.values[k], exact[k]));
      // Lower orders give the same numbers.
      for (int order = 0; order < kMaxSurfaceOrder; ++order)
        for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k)
          EXPECT_EQ(s.evaluate(u, v, order).values[k], jet.values[k]);
    }
  }
  EXPECT_LE(worst, 64);
  RecordProperty("worst_error_in_eps", std::to_string(worst));
}

TEST(NurbsSurface, RandomSurfacesMeetTheGeneralChecks) {
  RandomSurfaces some;
  for (int sample = 0; sample < 8; ++sample) {
    const int p = 1 + sample % 4, q = 1 + sample % 3;
    const NurbsSurface s = some.surface(p, q, p + 3, q + 2, sample % 2);
    checks::check_nurbs(s, 1e-12);
    checks::check_pieces(s, 1e-12);
    checks::check_degenerate_edges(s);
    for (const SurfacePiece& piece : s.pieces()) checks::check_enclosures(s, piece.domain);
    if (HasFailure()) return;
  }
}

// A form read back is the same surface, bit for bit.
TEST(NurbsSurface, FormRoundTrip) {
  RandomSurfaces some;
  const NurbsSurface s = some.surface(3, 2, 6, 5, 1);
  const NurbsSurface again(*s.as_nurbs());
  for (double f = 0; f <= 1; f += 0.1) {
    const double u = s.domain().u.clamp(s.domain().u.lo + f * s.domain().u.width());
    const double v = s.domain().v.clamp(s.domain().v.hi - f * s.domain().v.width());
    for (int k = 0; k < 6; ++k) EXPECT_EQ(s.evaluate(u, v, 2).values[k], again.evaluate(u, v, 2).values[k]);
  }
}

TEST(NurbsSurface, PartsKeepTheParameters) {
  RandomSurfaces some;
  Points points;
  for (int k = 0; k < 7 * 6; ++k) points.push_back({some.uniform(-5, 5), some.uniform(-5, 5), some.uniform(-5, 5)});
  SplineAxis u = closed_axis(3, 7), v = open_axis(2, {0, 0, 0, 1, 2, 3, 4, 4, 4});
  const NurbsSurface whole(u, v, points);
  u.restrict_to({5.25, 9.5});  // over the seam
  v.restrict_to({0.5, 3});
  const NurbsSurface part(u, v, points);
  EXPECT_EQ(part.domain().u, Interval(5.25, 9.5));
  for (double a = 5.25; a <= 9.5; a += 0.25)
    for (double b = 0.5; b <= 3; b += 0.25) expect_near(part.point(a, b), whole.point(a, b), 1e-14);
  checks::check_nurbs(part);
  checks::check_pieces(part);
  checks::check_enclosures(part, {{5.25, 6.5}, {0.5, 1}});
}

// Beyond an edge along r_u, beyond a corner bilinearly; derivatives of the continuation against differences.
TEST(NurbsSurface, ContinuesAlongItsTangents) {
  RandomSurfaces some;
  const NurbsSurface s = some.surface(3, 3, 5, 5, 0.3);
  const Rectangle d = s.domain();
  const double u = d.u.hi + 0.5, v = d.v.middle();
  const SurfaceJet edge = s.evaluate(d.u.hi, v, 2);
  expect_near(s.point(u, v), edge.point() + 0.5 * edge.du(), 1e-13);
  const SurfaceJet corner = s.evaluate(d.u.lo, d.v.hi, 2);
  expect_near(s.point(d.u.lo - 0.25, d.v.hi + 2),
              corner.point() - 0.25 * corner.du() + 2.0 * corner.dv() - 0.5 * corner.duv(), 1e-12);
  checks::check_differences(s, {{d.u.hi + 0.1, d.u.hi + 1}, {d.v.lo, d.v.lo + 0.5 * (s.axis_v().knots()[4] - d.v.lo)}},
                            4);
  checks::check_differences(s, {{d.u.hi + 0.1, d.u.hi + 1}, {d.v.hi + 0.1, d.v.hi + 1}}, 4);
}

TEST(NurbsSurface, NeighbouringPiecesShareTheirBorders) {
  RandomSurfaces some;
  for (int sample = 0; sample < 6; ++sample) {
    const NurbsSurface s = some.surface(3, 2, 7, 5, 1);
    const auto pieces = s.pieces();
    int neighbours_u = 0, neighbours_v = 0;
    for (const SurfacePiece& a : pieces)
      for (const SurfacePiece& b : pieces) {
        const int p = a.degree_u, q = a.degree_v;
        if (a.domain.u.hi == b.domain.u.lo && a.domain.v == b.domain.v) {
          ++neighbours_u;
          for (int j = 0; j <= q; ++j) EXPECT_EQ(a.points[p * (q + 1) + j], b.points[j]);
        }
        if (a.domain.v.hi == b.domain.v.lo && a.domain.u == b.domain.u) {
          ++neighbours_v;
          for (int i = 0; i <= p; ++i) EXPECT_EQ(a.points[i * (q + 1) + q], b.points[i * (q + 1)]);
        }
      }
    // Rows of spans between the different knots of the domain.
    const auto spans = [](const SplineAxis& axis) {
      const std::set<double> knots(axis.knots().begin() + axis.degree(), axis.knots().end() - axis.degree());
      return static_cast<int>(knots.size()) - 1;
    };
    const int m = spans(s.axis_u()), n = spans(s.axis_v());
    EXPECT_EQ(static_cast<int>(pieces.size()), m * n);
    EXPECT_EQ(neighbours_u, (m - 1) * n);
    EXPECT_EQ(neighbours_v, m * (n - 1));
    EXPECT_GT(neighbours_u + neighbours_v, 0);
  }
}

}  // namespace
}  // namespace lekalo::geometry::nurbs_surface_test
