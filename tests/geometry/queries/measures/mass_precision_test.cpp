// Integrals of free forms against composite Gauss-Legendre quadrature in long double: 1e-11 of the value.
//
// The composite rule splits every smooth piece into equal parts and uses ten nodes in each, computed here; its own
// error is told by halving the parts. It shares the integrand's values with the product, which have tests of their own.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"

namespace lekalo::geometry::mass_precision_test {
namespace {

using Real = long double;
constexpr int kNodes = 10;
constexpr double kExact = 1e-11;

struct Rule {
  std::array<Real, kNodes> x, w;  // on [0, 1]
};

// Nodes as the zeros of the Legendre polynomial, by Newton's method.
Rule make_rule() {
  Rule rule;
  for (int i = 0; i < kNodes; ++i) {
    Real x = std::cos(static_cast<Real>(kPi) * (i + 0.75L) / (kNodes + 0.5L)), slope = 0;
    for (int step = 0; step < 100; ++step) {
      Real previous = 1, value = x;
      for (int k = 2; k <= kNodes; ++k) {
        const Real next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      slope = kNodes * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    rule.x[i] = (1 + x) / 2;
    rule.w[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}
const Rule kRule = make_rule();

Real integrate(const std::vector<Interval>& pieces, int parts, const std::function<Real(double)>& f) {
  Real sum = 0;
  for (const Interval& piece : pieces)
    for (int part = 0; part < parts; ++part)
      for (int i = 0; i < kNodes; ++i) {
        const Real h = static_cast<Real>(piece.width()) / parts;
        sum += h * kRule.w[i] * f(static_cast<double>(piece.lo + h * (part + kRule.x[i])));
      }
  return sum;
}

Real length(const Vec3& v) {
  const Real x = v.x, y = v.y, z = v.z;
  return std::sqrt(x * x + y * y + z * z);
}

// The value with parts enough: halving them again changes nothing that matters.
double settled(const std::function<Real(int)>& with_parts) {
  int parts = 8;
  Real before = with_parts(parts), now = with_parts(2 * parts);
  for (; std::abs(now - before) > 1e-13L * std::abs(now) && parts < 128; parts *= 2) {
    before = now;
    now = with_parts(4 * parts);
  }
  EXPECT_LE(std::abs(now - before), 1e-13L * std::abs(now)) << "the composite rule does not settle";
  return static_cast<double>(now);
}

std::vector<Vec3> random_points(std::mt19937_64& random, int m, int n) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = i + 0.3 * unit(random), y = j + 0.3 * unit(random);
      points.push_back({x, y, 0.8 * unit(random)});
    }
  return points;
}

std::vector<double> random_weights(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> weights(count);
  for (double& w : weights) w = std::exp2(unit(random));
  return weights;
}

SplineAxis axis_of(int degree) {
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), {1, 1.75, 3});
  knots.insert(knots.end(), degree + 1, 4.0);
  return SplineAxis(degree, knots, Extension::tangent);
}

void expect_area(const Surface& surface, const std::vector<Interval>& u, const std::vector<Interval>& v) {
  const double area = settled([&](int parts) {
    return integrate(u, parts, [&](double a) {
      return integrate(v, parts, [&](double b) {
        const SurfaceJet jet = surface.evaluate(a, b, 1);
        return length(glm::cross(jet.du(), jet.dv()));
      });
    });
  });
  const SurfaceMeasures found = measure(surface);
  EXPECT_NEAR(found.area.value, area, kExact * area);
  EXPECT_LE(std::abs(found.area.value - area), found.area.error + 1e-13 * area);
}

const std::vector<Interval> kSpans{{0, 1}, {1, 1.75}, {1.75, 3}, {3, 4}};

TEST(MassPrecision, LengthsOfSplines) {
  std::mt19937_64 random(1);
  for (int degree = 2; degree <= 6; ++degree) {
    SCOPED_TRACE(degree);
    const SplineAxis axis = axis_of(degree);
    const NurbsCurve curve(axis, random_points(random, axis.count(), 1), random_weights(random, axis.count()));
    const double exact = settled([&](int parts) {
      return integrate(kSpans, parts, [&](double t) { return length(curve.evaluate(t, 1).d[1]); });
    });
    const CurveMeasures found = measure(curve);
    EXPECT_NEAR(found.length.value, exact, kExact * exact);
    EXPECT_LE(std::abs(found.length.value - exact), found.length.error + 1e-13 * exact);
  }
}

TEST(MassPrecision, AreasOfSplines) {
  std::mt19937_64 random(2);
  const SplineAxis u = axis_of(2), v = axis_of(3);
  const NurbsSurface surface(u, v, random_points(random, u.count(), v.count()),
                             random_weights(random, u.count() * v.count()));
  expect_area(surface, kSpans, kSpans);
}

TEST(MassPrecision, AreasOfSweptSplines) {
  std::mt19937_64 random(3);
  const SplineAxis axis = axis_of(3);
  const auto curve =
      std::make_shared<NurbsCurve>(axis, random_points(random, axis.count(), 1), random_weights(random, axis.count()));
  expect_area(ExtrusionSurface(curve, {0.2, 0.3, 2}), kSpans, {{0, 1}});
  expect_area(RevolutionSurface(curve, Axis{{0, -3, 0}, {1, 0, 0}}, 2.5), kSpans, {{0, 2.5}});
}

}  // namespace
}  // namespace lekalo::geometry::mass_precision_test
