#include "geometry/surfaces/swept/extrusion.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/formula.h"
#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::extrusion_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

// A curve without a rational form: (t, sin 2t, t^2/4).
class Wave final : public Curve {
 public:
  Interval domain() const override { return {-1, 2}; }
  CurveJet evaluate(double t, int order) const override {
    return evaluate_curve_formula([](const auto& x) { return at(x); }, t, order);
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    return enclose_curve_formula([](const auto& x) { return at(x); }, t, order);
  }
  template <class T>
  static Triple<T> at(const T& t) {
    using std::sin;
    return {t, sin(2 * t), 0.25 * sqr(t)};
  }
};

TEST(ExtrusionSurface, MeetsTheGeneralChecks) {
  const auto circle = std::make_shared<Circle>(kSkewFrame, 2, Interval(0.5, 4));
  checks::check_surface(ExtrusionSurface(circle, {1, 0.5, 3}));
  checks::check_surface(ExtrusionSurface(circle, {1, 0.5, 3}, {{1, 2}, {-2, 0.5}}));
  checks::check_surface(ExtrusionSurface(std::make_shared<Wave>(), {0, -1, 2}));
  checks::check_surface(ExtrusionSurface(std::make_shared<Wave>(), {0, -1, 2}, {{0, 1}, {1, 2}}));
}

TEST(ExtrusionSurface, DerivativesAgreeWithHigherPrecision) {
  const Vec3 along(0.3, -1, 2);
  checks::check_derivatives(ExtrusionSurface(std::make_shared<Wave>(), along),
                            [&](const auto& u, const auto& v) {
                              const auto c = Wave::at(u);
                              return Triple{c.x + v * Quad(along.x), c.y + v * Quad(along.y), c.z + v * Quad(along.z)};
                            },
                            {{-1, 2}, {-1, 3}});
}

// An extruded circle is a cylinder; the normal c' x d points outward for a vector along z.
TEST(ExtrusionSurface, OfACircleIsACylinder) {
  const auto circle = std::make_shared<Circle>(kSkewFrame, 2);
  const ExtrusionSurface surface(circle, 3.0 * kSkewFrame.z);
  EXPECT_NEAR(checks::area(surface), 2 * kPi * 2 * 3, 1e-12 * 38);
  for (const double u : {0.0, 1.0, 4.0}) {
    const Vec3 out = std::cos(u) * kSkewFrame.x + std::sin(u) * kSkewFrame.y;
    EXPECT_LE(distance(surface.normal(u, 0.3), out), 1e-15);
    EXPECT_LE(distance(surface.point(u, 0.5), kSkewFrame.origin + 2.0 * out + 1.5 * kSkewFrame.z), 2e-15);
  }
}

TEST(ExtrusionSurface, RefusesAZeroVectorAndForeignParameters) {
  const auto circle = std::make_shared<Circle>(Frame(), 1, Interval(0, 1));
  EXPECT_THROW(ExtrusionSurface(circle, Vec3(0)), std::invalid_argument);
  EXPECT_THROW(ExtrusionSurface(circle, {0, 0, 1}, {{0, 2}, {0, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::extrusion_test
