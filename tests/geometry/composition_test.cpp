// The chain rule of all orders against formulas written out over jets of 113-bit numbers.
#include "geometry/composition.h"

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/analytic/torus.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry {
namespace {

constexpr double kA = 3, kB = 2, kDistance = 0.25;

CurvePtr oval() { return std::make_shared<Ellipse>(Frame{}, kA, kB, Interval(0, kTwoPi)); }

struct Parallel {
  CurvePtr of;
  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> along = curve_at(*of, t, 1);
    return curve_at(*of, t) + (kDistance / length(along)) * Triple<T>{-along.y, along.x, T(0)};
  }
};

struct Squared {
  CurvePtr of;
  template <class T>
  Triple<T> operator()(const T& w) const {
    return curve_at(*of, w * w);
  }
};

NurbsCurve spline() {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 1}, {3, 2, -1}, {4, 0, 0}, {6, 1, 2}};
  const std::vector<double> weights{1, 2, 0.5, 1, 1};
  return NurbsCurve(SplineAxis(3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1}, Extension::tangent), points, weights);
}

TEST(Composition, ParallelOfAnEllipse) {
  const ComposedCurve curve(Parallel{oval()}, properties_of(*oval(), 1));
  EXPECT_EQ(curve.max_order(), kMaxCurveOrder - 1);
  EXPECT_EQ(curve.enclosure_order(), kMaxCurveEnclosureOrder - 1);
  checks::check_derivatives(
      curve,
      [](const auto& t) {
        const auto x = -kA * sin(t), y = kB * cos(t), speed = sqrt(x * x + y * y);
        return Triple{kA * cos(t) - kDistance * y / speed, kB * sin(t) + kDistance * x / speed, t - t};
      },
      curve.domain(), 1e-13);
  checks::check_enclosures(curve, curve.domain());
}

TEST(Composition, EnclosuresOfAllOrdersHoldSamples) {
  const NurbsCurve curve = spline();
  for (int i = 0; i < 200; ++i) {
    const double lo = 0.99 * std::fmod(i * 0.618, 1), hi = std::min(1.0, lo + 0.2 * std::fmod(i * 0.414, 1));
    const CurveEnclosure boxes = curve.enclose({lo, hi}, kMaxCurveEnclosureOrder);
    for (int j = 0; j < 8; ++j) {
      const CurveJet jet = curve.evaluate(lo + (hi - lo) * j / 8, kMaxCurveEnclosureOrder);
      for (int k = 0; k <= kMaxCurveEnclosureOrder; ++k) {
        ASSERT_TRUE(boxes.d[k].contains(jet.d[k])) << k << " over " << lo << ", " << hi;
      }
    }
  }
}

// Newton's quotient of the derivative before, in a small interval: an enclosure must hold it and shrink to it.
TEST(Composition, EnclosuresOfHighOrdersAreNarrow) {
  const NurbsCurve curve = spline();
  const CurveEnclosure boxes = curve.enclose({0.7, 0.7 + 1e-6}, kMaxCurveEnclosureOrder);
  const CurveJet jet = curve.evaluate(0.7, kMaxCurveEnclosureOrder);
  for (int k = 0; k <= kMaxCurveEnclosureOrder; ++k) {
    EXPECT_LT(boxes.d[k].diameter(), 1e-3 * (1 + glm::length(jet.d[k]))) << k;
  }
}

TEST(Composition, InnerFunction) {
  const auto of = std::make_shared<NurbsCurve>(spline());
  CurveProperties properties = properties_of(*of);
  cut_to(properties, {0.7, 1});
  const ComposedCurve curve(Squared{of}, properties);
  for (const double w : {0.72, 0.8, 0.93}) {
    const CurveJet jet = curve.evaluate(w, 3), inner = of->evaluate(w * w, 3);
    EXPECT_LT(glm::length(jet.d[1] - 2 * w * inner.d[1]), 1e-13);
    EXPECT_LT(glm::length(jet.d[2] - (4 * w * w * inner.d[2] + 2.0 * inner.d[1])), 1e-12);
    EXPECT_LT(glm::length(jet.d[3] - (8 * w * w * w * inner.d[3] + 12 * w * inner.d[2])), 1e-11);
  }
}

struct OverTorus {
  SurfacePtr of;
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    return surface_at(*of, u + v * v, 2.0 * v) + 0.5 * surface_at(*of, u + v * v, 2.0 * v, 0, 1);
  }
};

// The torus with its formula put in.
TEST(Composition, OfASurface) {
  const auto torus = std::make_shared<TorusSurface>(Frame{}, 3, 1);
  SurfaceProperties properties = properties_of(*torus, 1);
  properties.domain = {{0.5, 1.5}, {0.2, 1.1}};
  properties.breaks_u = {0.5, 1.5}, properties.breaks_v = {0.2, 1.1};
  const ComposedSurface surface(OverTorus{torus}, properties);
  const auto formula = [](const auto& u, const auto& v) {
    using std::cos;
    using std::sin;
    const auto a = u + v * v, b = 2.0 * v;
    const auto across = 3.0 + cos(b) - 0.5 * sin(b), up = sin(b) + 0.5 * cos(b);
    return Triple{across * cos(a), across * sin(a), up};
  };
  for (const auto& [u, v] : {std::pair(0.7, 0.4), std::pair(1.2, 1.0), std::pair(0.9, 0.3)}) {
    const SurfaceJet jet = surface.evaluate(u, v, 3), expected = evaluate_surface_formula(formula, u, v, 3);
    for (int k = 0; k < 10; ++k) EXPECT_LT(glm::length(jet.values[k] - expected.values[k]), 1e-12) << k;
    EXPECT_TRUE(std::isnan(surface.evaluate(u, v, 4).d(4, 0).x));
    const SurfaceEnclosure boxes = surface.enclose({{u, u + 1e-3}, {v, v + 1e-3}}, 2);
    const SurfaceJet inside = evaluate_surface_formula(formula, u + 4e-4, v + 7e-4, 2);
    for (int k = 0; k < 6; ++k) EXPECT_TRUE(boxes.values[k].contains(inside.values[k])) << k;
    // Mean values: the width beyond the surface's own falls with the square.
    EXPECT_LT(boxes.values[0].diameter(), 1.1e-3 * (glm::length(jet.du()) + glm::length(jet.dv())) + 1e-4);
  }
}

}  // namespace
}  // namespace lekalo::geometry
