#include "geometry/surfaces/swept/revolution.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/formula.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::revolution_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

// A vase without a rational form, from the axis outward and back: (sin t, 0, t + cos(2 t)/4), t in [0, pi].
class Vase final : public Curve {
 public:
  Interval domain() const override { return {0, kPi}; }
  CurveJet evaluate(double t, int order) const override {
    return evaluate_curve_formula([](const auto& x) { return at(x); }, t, order);
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    return enclose_curve_formula([](const auto& x) { return at(x); }, t, order);
  }
  template <class T>
  static Triple<T> at(const T& t) {
    using std::cos;
    using std::sin;
    return {sin(t), 0 * t, t + 0.25 * cos(2 * t)};
  }
};

// A circle in the half-plane x > 0 of a frame, running upward on its outside.
std::shared_ptr<Circle> section(double major, double minor, const Interval& arc = {0, kTwoPi}) {
  Frame plane;
  plane.origin = kSkewFrame.point({major, 0, 0});
  plane.x = kSkewFrame.x;
  plane.y = kSkewFrame.z;
  plane.z = -kSkewFrame.y;
  return std::make_shared<Circle>(plane, minor, arc);
}

const Axis kAxis{kSkewFrame.origin, kSkewFrame.z};

TEST(RevolutionSurface, MeetsTheGeneralChecks) {
  checks::check_surface(RevolutionSurface(section(3, 1), kAxis));
  checks::check_surface(RevolutionSurface(section(3, 1, {-1, 2}), {{1, 2, 3}, glm::normalize(Vec3(-1, 1, 0.3))}, 3));
  checks::check_surface(RevolutionSurface(section(0, 2, {-kPi / 2, kPi / 2}), kAxis));
  checks::check_surface(RevolutionSurface(std::make_shared<Vase>(), Axis()));
  checks::check_surface(RevolutionSurface(std::make_shared<Vase>(), Axis(), Rectangle{{0.5, 2}, {-1, 1}}));
}

TEST(RevolutionSurface, DerivativesAgreeWithHigherPrecision) {
  const Axis axis{{0.5, -0.2, 0.1}, glm::normalize(Vec3(0.2, 0.3, 1))};
  const Frame frame = frame_about(axis.through, axis.along);
  const auto formula = [&](const auto& u, const auto& v) {
    auto c = Vase::at(u);
    c.x -= Quad(frame.origin.x), c.y -= Quad(frame.origin.y), c.z -= Quad(frame.origin.z);
    const auto along = [&](const Vec3& e) { return c.x * Quad(e.x) + c.y * Quad(e.y) + c.z * Quad(e.z); };
    const auto x = along(frame.x), y = along(frame.y), z = along(frame.z);
    const auto across_x = x * cos(v) - y * sin(v), across_y = x * sin(v) + y * cos(v);
    const auto coordinate = [&](int i) {
      return across_x * Quad(frame.x[i]) + across_y * Quad(frame.y[i]) + z * Quad(frame.z[i]) + Quad(frame.origin[i]);
    };
    return Triple{coordinate(0), coordinate(1), coordinate(2)};
  };
  checks::check_derivatives(RevolutionSurface(std::make_shared<Vase>(), axis), formula, {{0, kPi}, {-4, 7}});
}

// The torus with the parameters exchanged and the normal turned round.
TEST(RevolutionSurface, OfACircleIsATorus) {
  const RevolutionSurface surface(section(3, 1), kAxis);
  const TorusSurface torus(kSkewFrame, 3, 1);
  for (const double u : {0.3, 2.0, 5.0}) {
    for (const double v : {0.0, 1.0, 4.0}) {
      EXPECT_LE(distance(surface.point(u, v), torus.point(v, u)), 1e-14);
      EXPECT_LE(distance(surface.normal(u, v), -torus.normal(v, u)), 1e-14);
    }
  }
  EXPECT_NEAR(checks::area(surface), 118.435252813072, 1e-10);
}

// Golovanov 2016, 3.3: axis through (1, 0, 0) along (1, 2, 2)/3, the point (2, 3, -1), 60 degrees.
TEST(RevolutionSurface, TurnsThePointOfTheTextbook) {
  const Axis axis{{1, 0, 0}, Vec3(1, 2, 2) / 3.0};
  const auto circle = std::make_shared<Circle>(frame_about({2, 3, -3}, {1, 1, 0}), 2);
  double t = 0;  // the parameter at (2, 3, -1), a point of this circle
  for (int k = 0; k < 4; ++k)
    if (distance(circle->point(k * kPi / 2), {2, 3, -1}) < 1e-9) t = k * kPi / 2;
  ASSERT_LE(distance(circle->point(t), {2, 3, -1}), 1e-14);
  const RevolutionSurface surface(circle, axis);
  EXPECT_LE(distance(surface.point(t, kPi / 3), {-0.531623298980725, 2.921580959339994, 0.344230690150368}), 1e-14);
}

// A half circle about its diameter: a sphere; at the poles the normal is the axis, inward as the profile runs upward.
TEST(RevolutionSurface, HasNormalsAtItsPoles) {
  const RevolutionSurface sphere(section(0, 2, {-kPi / 2, kPi / 2}), kAxis);
  EXPECT_TRUE(sphere.degenerate_edges().u_min && sphere.degenerate_edges().u_max);
  for (const double v : {0.0, 1.0, 4.0}) {
    EXPECT_LE(distance(sphere.normal(kPi / 2, v), -kSkewFrame.z), 1e-12);
    EXPECT_LE(distance(sphere.normal(-kPi / 2, v), kSkewFrame.z), 1e-12);
  }
  // All control points of a pole are one point.
  const auto form = sphere.as_nurbs();
  for (int j = 1; j < form->count_v(); ++j)
    EXPECT_LE(distance(Vec3(form->points[j]) / form->points[j].w, Vec3(form->points[0])), 1e-15 * 5);
}

TEST(RevolutionSurface, RefusesMoreThanATurn) {
  EXPECT_THROW(RevolutionSurface(section(3, 1), kAxis, 6.3), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::revolution_test
