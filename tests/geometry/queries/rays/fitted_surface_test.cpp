#include "geometry/queries/rays/fitted_surface.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/composition.h"
#include "geometry/numerics/triple.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {
namespace {

// A tube with waves on a ring.
struct Ring {
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    using std::cos;
    using std::sin;
    const T r = 1.0 + 0.2 * cos(3.0 * u) * sin(v);
    return {(3.0 + r * cos(u)) * cos(v), (3.0 + r * cos(u)) * sin(v), r * sin(u)};
  }
};

SurfacePtr ring() {
  SurfaceProperties properties;
  properties.domain = {{0, 6}, {0, 5}};
  properties.breaks_u = {0, 6};
  properties.breaks_v = {0, 2, 5};
  return std::make_shared<ComposedSurface<Ring>>(Ring{}, properties);
}

// kFitDistance of a size of 8 times T_8^(k)(1) = 1, 64, 1344, 16128, 126720 (Markov) by parts a quarter wide.
constexpr double kAgree[] = {8e-12, 4.1e-9, 6.9e-7, 6.7e-5, 4.2e-3};

TEST(FittedSurface, AgreesWithItsDerivatives) {
  const SurfacePtr surface = ring(), copy = fitted_copy(surface);
  ASSERT_NE(copy, surface);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 6), v(0, 5);
  for (int k = 0; k < 500; ++k) {
    const double a = u(random), b = v(random);
    const SurfaceJet there = surface->evaluate(a, b, 4), found = copy->evaluate(a, b, 4);
    for (int n = 0; n <= 4; ++n)
      for (int j = 0; j <= n; ++j)
        ASSERT_LT(glm::length(found.d(n - j, j) - there.d(n - j, j)), kAgree[n]) << n << ' ' << j;
  }
}

TEST(FittedSurface, EnclosuresContainBoth) {
  const SurfacePtr surface = ring(), copy = fitted_copy(surface);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 400; ++k) {
    const double width = std::pow(10, -9 * unit(random)), a = (6 - width) * unit(random),
                 b = (5 - width) * unit(random);
    const Rectangle box{{a, a + width}, {b, b + width}};
    const SurfaceEnclosure boxes = copy->enclose(box, 4);
    for (int i = 0; i < 10; ++i) {
      const double s = std::min(a + unit(random) * width, box.u.hi), t = std::min(b + unit(random) * width, box.v.hi);
      for (const Surface* of : {surface.get(), copy.get()}) {
        const SurfaceJet jet = of->evaluate(s, t, 4);
        for (int d = 0; d <= SurfaceJet::index(0, 4); ++d)
          for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(boxes.values[d].lo[axis], jet.values[d][axis]) << width << ' ' << d;
            ASSERT_GE(boxes.values[d].hi[axis], jet.values[d][axis]) << width << ' ' << d;
          }
      }
    }
    // The point's box is as narrow as the rectangle lets it be.
    EXPECT_LT(boxes.d(0, 0).diameter(), 40 * width + 1e-10);
  }
}

TEST(FittedSurface, OthersAreTheirOwnCopies) {
  const SurfacePtr torus = std::make_shared<TorusSurface>(Frame{}, 2, 1);
  EXPECT_EQ(fitted_copy(torus), torus);
}

}  // namespace
}  // namespace lekalo::geometry
