// Lines on surfaces against closed forms (great circles, helices, developments, Clairaut's relation, confocal quadrics,
// rulings, the theorem of Beltrami and Enneper), an integration of the same equation in another way, and the shortest
// way over a fine grid.
#include "geometry/queries/surface_lines/surface_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <random>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/describe.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::surface_lines_test {
namespace {

FormulaSurface formula(const std::array<std::string, 3>& point, const Rectangle& domain) {
  return FormulaSurface(point_formulas(point, {"u", "v"}), domain, {});
}

// The line in space; the surface must live as long.
SurfaceCurve in_space(const Surface& surface, const SurfaceLine& line) {
  return SurfaceCurve(SurfacePtr(SurfacePtr(), &surface), line.image, line.error);
}

template <class Visit>
void along_line(const Curve& curve, const Visit& visit, int count = 400) {
  const Interval range = curve.domain();
  for (int i = 0; i <= count; ++i) visit(range.clamp(range.lo + range.width() * i / count));
}

std::string refusal(const std::function<void()>& what) {
  try {
    what();
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

// A hilly bicubic patch.
NurbsSurface hills(const std::vector<double>& knots_u) {
  std::vector<Vec3> points;
  const int rows = static_cast<int>(knots_u.size()) - 4;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 4; ++j) points.push_back({i, j, 0.8 * std::sin(1.7 * i + 0.3) * std::cos(2.1 * j)});
  return NurbsSurface(SplineAxis(3, knots_u, Extension::tangent),
                      SplineAxis(3, {0, 0, 0, 0, 1, 1, 1, 1}, Extension::tangent), points);
}

TEST(Geodesics, OfSpheresAreGreatCircles) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0, worst_error = 0;
  const int count = tests::tier_count(2000, 30);
  for (int sample = 0; sample < count; ++sample) {
    const double radius = std::exp(4 * uniform(random) - 2);
    const SphereSurface sphere(frame_from(Vec3(uniform(random)), {uniform(random), 1, uniform(random)}, {1, 0, 0.2}),
                               radius);
    const Vec2 start(kTwoPi * uniform(random), 2 * uniform(random) - 1);
    // Not nearly through a pole, where parameters are no measure.
    const double angle = (uniform(random) < 0.5 ? 0 : kPi) + 2.6 * (uniform(random) - 0.5);
    const SurfaceLine line = geodesic(sphere, start, angle, 8 * radius);
    EXPECT_EQ(line.ends, LineEnd::length);
    const SurfaceCurve curve = in_space(sphere, line);
    const SurfaceJet at = sphere.evaluate(start.x, start.y, 1);
    const Vec3 center = sphere.frame().origin, p = at.point() - center, x = glm::normalize(at.du());
    const Vec3 d = std::cos(angle) * x + std::sin(angle) * glm::cross(glm::normalize(p), x);
    along_line(
        curve,
        [&](double t) {
          const Vec3 exact = center + std::cos(t / radius) * p + radius * std::sin(t / radius) * d;
          worst = tests::worse(worst, glm::length(curve.point(t) - exact) / radius);
        },
        50);
    worst_error = tests::worse(worst_error, line.error / radius);
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(worst_error, 1e-12);
  tests::report_figure("largest_error_of_radius", worst);
}

TEST(Geodesics, OfCylindersAreHelicesAndWrap) {
  const CylinderSurface cylinder(Frame{}, 1.5, 40);
  const double angle = 0.4;
  const SurfaceLine line = geodesic(cylinder, {6, 0.1}, angle, 60);
  const SurfaceCurve helix = in_space(cylinder, line);
  EXPECT_EQ(helix.domain(), Interval(0, 60));
  along_line(helix, [&](double t) {
    const double u = 6 + t * std::cos(angle) / 1.5;
    EXPECT_LE(glm::length(helix.point(t) - Vec3(1.5 * std::cos(u), 1.5 * std::sin(u), 4 + t * std::sin(angle))), 1e-12);
    EXPECT_NEAR(line.image->point(t).x, u, 1e-12);  // not wrapped
  });
  checks::check_enclosures(helix, helix.domain());
  checks::check_pieces(helix);
}

TEST(Geodesics, OfConesAreStraightInTheDevelopment) {
  const double radius = 2, height = 3, slant = std::hypot(radius, height);
  const ConeSurface cone(Frame{}, radius, 0.2, height);
  const double taper = (radius - 0.2) / height, apex = radius / taper, sine = taper / std::hypot(1.0, taper);
  (void)slant;
  const auto developed = [&](const Vec3& p, double u) {
    const double distance = (apex - p.z) * std::hypot(1.0, taper);
    return distance * Vec2(std::cos(u * sine), std::sin(u * sine));
  };
  const SurfaceLine line = geodesic(cone, {1, 0.2}, 0.3, 9);
  const SurfaceCurve curve = in_space(cone, line);
  const double end = curve.domain().hi;
  const auto place = [&](double t) { return developed(curve.point(t), line.image->point(t).x); };
  const Vec2 first = place(0), last = place(end);
  EXPECT_NEAR(glm::length(last - first), end, 1e-12);
  along_line(curve, [&](double t) { EXPECT_LE(glm::length(place(t) - (first + t / end * (last - first))), 1e-12); });
}

TEST(Geodesics, ObeyClairautsRelation) {
  const TorusSurface torus(Frame{}, 3, 1);
  const auto profile = std::make_shared<NurbsCurve>(
      bezier_curve(std::vector<Vec3>{{1, 0, 0}, {2.5, 0, 0.5}, {0.3, 0, 1.4}, {1.2, 0, 2.5}}, {{1, 2, 0.7, 1}}));
  const RevolutionSurface vase(profile, {});
  const Surface* surfaces[] = {&torus, &vase};
  for (const Surface* surface : surfaces) {
    const bool u_turns = surface == &torus;
    for (const double angle : {0.2, 0.9, 1.4, 2.5}) {
      const SurfaceLine line = geodesic(*surface, u_turns ? Vec2(0.3, 0.2) : Vec2(0.4, 1), angle, 30);
      const SurfaceCurve curve = in_space(*surface, line);
      double first = 0;
      along_line(curve, [&](double t) {
        const CurveJet at = curve.evaluate(t, 1);
        EXPECT_NEAR(glm::length(at.d[1]), 1, 1e-12);
        const double momentum = at.d[0].x * at.d[1].y - at.d[0].y * at.d[1].x;
        if (t == 0) first = momentum;
        EXPECT_NEAR(momentum, first, 2e-12);
      });
      EXPECT_LE(line.error, 1e-12 * 8);
    }
  }
}

// The same equation with Christoffel's symbols from the derivatives of the first form, by the classical method of Runge
// and Kutta with tiny steps.
std::array<double, 4> by_runge_kutta(const Surface& surface, std::array<double, 4> y, double length, int steps) {
  const auto f = [&](const std::array<double, 4>& y) {
    const SurfaceJet s = surface.evaluate(y[0], y[1], 2);
    const auto g = [&](const Vec3& a, const Vec3& b) { return glm::dot(a, b); };
    const double e = g(s.du(), s.du()), f = g(s.du(), s.dv()), h = g(s.dv(), s.dv()), det = e * h - f * f;
    const double eu = 2 * g(s.duu(), s.du()), ev = 2 * g(s.duv(), s.du()), hu = 2 * g(s.duv(), s.dv()),
                 hv = 2 * g(s.dvv(), s.dv());
    const double fu = g(s.duu(), s.dv()) + g(s.du(), s.duv()), fv = g(s.duv(), s.dv()) + g(s.du(), s.dvv());
    const double p = y[2], q = y[3];
    const double u11 = (h * eu - 2 * f * fu + f * ev) / (2 * det), v11 = (2 * e * fu - e * ev - f * eu) / (2 * det);
    const double u12 = (h * ev - f * hu) / (2 * det), v12 = (e * hu - f * ev) / (2 * det);
    const double u22 = (2 * h * fv - h * hu - f * hv) / (2 * det), v22 = (e * hv - 2 * f * fv + f * hu) / (2 * det);
    return std::array{p, q, -(u11 * p * p + 2 * u12 * p * q + u22 * q * q),
                      -(v11 * p * p + 2 * v12 * p * q + v22 * q * q)};
  };
  const auto plus = [](const std::array<double, 4>& a, double h, const std::array<double, 4>& b) {
    return std::array{a[0] + h * b[0], a[1] + h * b[1], a[2] + h * b[2], a[3] + h * b[3]};
  };
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const auto k1 = f(y), k2 = f(plus(y, h / 2, k1)), k3 = f(plus(y, h / 2, k2)), k4 = f(plus(y, h, k3));
    for (int k = 0; k < 4; ++k) y[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
  }
  return y;
}

TEST(Geodesics, AgreeWithAnotherIntegration) {
  const NurbsSurface patch = hills({0, 0, 0, 0, 1, 1, 1, 1});
  for (const double angle : {0.3, 0.7, 1.2}) {
    const SurfaceLine line = geodesic(patch, {0.1, 0.15}, angle, 2);
    const SurfaceCurve curve = in_space(patch, line);
    const double end = curve.domain().hi;
    const CurveJet at = line.image->evaluate(0, 1);
    const auto reached = by_runge_kutta(patch, {at.d[0].x, at.d[0].y, at.d[1].x, at.d[1].y}, end, 4000);
    EXPECT_LE(glm::length(patch.point(reached[0], reached[1]) - curve.point(end)), 1e-11) << angle;
    EXPECT_LE(line.error, 1e-12);
  }
}

TEST(Geodesics, GoOnOverKnots) {
  // Derivatives jump from the second (triple knot: the first) on.
  for (const std::vector<double>& knots :
       {std::vector<double>{0, 0, 0, 0, 0.4, 1, 1, 1, 1}, std::vector<double>{0, 0, 0, 0, 0.4, 0.4, 1, 1, 1, 1}}) {
    const NurbsSurface patch = hills(knots);
    const SurfaceLine line = geodesic(patch, {0.05, 0.2}, 0.3, 20);
    EXPECT_EQ(line.ends, LineEnd::border);
    EXPECT_LE(line.error, 1e-12 * 5);
    const SurfaceCurve curve = in_space(patch, line);
    const Vec3 end = line.image->point(curve.domain().hi);
    EXPECT_TRUE(std::abs(end.x - 1) < 1e-15 || std::abs(end.y - 0.5) > 0.5 - 1e-15) << end.x << ' ' << end.y;
    along_line(curve, [&](double t) {
      const Vec3 uv = line.image->point(t);
      const CurveJet at = curve.evaluate(t, 2);
      EXPECT_NEAR(glm::length(at.d[1]), 1, 1e-11);
      EXPECT_NEAR(glm::dot(glm::cross(at.d[1], at.d[2]), patch.normal(uv.x, uv.y)), 0, 1e-9);
    });
    checks::check_enclosures(curve, curve.domain());
  }
}

TEST(Geodesics, KeepTheirAngleOverACrease) {
  // A folded sheet; unfolded it is plane.
  const auto profile =
      std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {4, 0, 1}}, false));
  const ExtrusionSurface roof(profile, {0, 5, 0});
  const double sides[] = {std::sqrt(2.0), std::sqrt(2.0), std::sqrt(5.0)};
  const auto unfolded = [&](const Vec3& uv, bool u_profile) {
    const double along = u_profile ? uv.x : uv.y;
    double length = 0;
    for (int i = 0; i < 3; ++i) length += sides[i] * std::clamp(along - i, 0.0, 1.0);
    return Vec2(length, 0);
  };
  const bool u_profile = roof.domain().u.width() == 3;
  const SurfaceLine line =
      geodesic(roof, u_profile ? Vec2(0.2, 0.1) : Vec2(0.1, 0.2), u_profile ? 0.7 : kPi / 2 - 0.7, 4.5);
  const SurfaceCurve curve = in_space(roof, line);
  ASSERT_EQ(curve.domain().hi, 4.5);
  const auto place = [&](double t) { return unfolded(line.image->point(t), u_profile) + Vec2(0, curve.point(t).y); };
  along_line(curve, [&](double t) {
    EXPECT_LE(glm::length(place(t) - (place(0) + t * Vec2(std::cos(0.7), std::sin(0.7)))), 1e-13);
  });
  EXPECT_GE(curve.pieces().size(), 3u);
  const Vec2 there(place(4.5));
  const SurfaceLine shortest = shortest_geodesic(roof, Vec2(line.image->point(0)), Vec2(line.image->point(4.5)));
  EXPECT_NEAR(shortest.image->domain().hi, glm::length(there - place(0)), 1e-12);
}

TEST(Geodesics, EndAtBordersAndPoles) {
  const SphereSurface half(Frame{}, 2, {{0, kPi}, {-0.5 * kPi, 0.5 * kPi}});
  const SurfaceLine line = geodesic(half, {1, 0}, 0, 100);
  EXPECT_EQ(line.ends, LineEnd::border);
  EXPECT_NEAR(line.image->domain().hi, 2 * (kPi - 1), 1e-14);
  const SurfaceLine meridian = geodesic(half, {1, 0}, kPi / 2, 100);
  EXPECT_EQ(meridian.ends, LineEnd::pole);
  EXPECT_NEAR(meridian.image->domain().hi, kPi, 1e-12);
  const SurfaceLine edge = geodesic(half, {0, 0}, kPi / 2, 1);  // along the border
  EXPECT_EQ(edge.ends, LineEnd::length);
  const Plane sheet(Frame{});
  const SurfaceCurve straight = in_space(sheet, geodesic(sheet, {1, 2}, 0.5, 1000));
  EXPECT_LE(glm::length(straight.point(1000) - Vec3(1 + 1000 * std::cos(0.5), 2 + 1000 * std::sin(0.5), 0)), 1e-10);
}

TEST(Geodesics, RefuseWhatIsNone) {
  const SphereSurface ball(Frame{}, 1, {{0, 3}, {-1, 0.5 * kPi}});
  EXPECT_EQ(refusal([&] {
              geodesic(ball, {4, 0}, 0, 1);
            }),
            "from: (4, 0) lies outside of the surface's domain, u in [0, 3], v in [-1, 1.5708]");
  EXPECT_EQ(refusal([&] { geodesic(ball, {1, 0.5 * kPi}, 0, 1); }).substr(0, 20), "from: this is a pole");
  EXPECT_EQ(refusal([&] { geodesic(ball, {0, 0}, kPi, 1); }), "from: the geodesic leaves the surface's domain at once");
  EXPECT_EQ(refusal([&] { shortest_geodesic(ball, {1, 0}, {1, 0}); }), "to: 'from' and 'to' are one point");
  // A notch that the shortest way goes round.
  const SphereSurface zone(Frame{}, 1, {{0, 6.2}, {-0.1, 0.1}});
  EXPECT_EQ(refusal([&] {
              shortest_geodesic(zone, {0.1, 0.1}, {2.5, 0.1});
            }),
            "to: no geodesic joins the two points in the surface's domain");
}

TEST(ShortestGeodesics, OfSpheresAndCylinders) {
  const SphereSurface ball(Frame{}, 2);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int sample = 0; sample < tests::tier_count(500, 8); ++sample) {
    const Vec2 a(kTwoPi * uniform(random), 2.8 * uniform(random) - 1.4),
        b(kTwoPi * uniform(random), 2.8 * uniform(random) - 1.4);
    const Vec3 p = ball.point(a.x, a.y), q = ball.point(b.x, b.y);
    const SurfaceLine line = shortest_geodesic(ball, a, b);
    EXPECT_NEAR(line.image->domain().hi, 2 * std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q)), 1e-12);
    EXPECT_LE(glm::length(in_space(ball, line).point(line.image->domain().hi) - q), 1e-12);
    EXPECT_LE(line.error, 1e-12);
  }
  const CylinderSurface cylinder(Frame{}, 1, 10);
  const SurfaceLine seam = shortest_geodesic(cylinder, {0.5, 0.1}, {6, 0.3});
  EXPECT_NEAR(seam.image->domain().hi, std::hypot(kTwoPi - 5.5, 2.0), 1e-13);
}

// The shortest way over the lines of a grid with many directions in each node: no shorter than the geodesic, and hardly
// longer.
double over_grid(const Surface& surface, const Vec2& from, const Vec2& to, int n) {
  const Rectangle domain = surface.domain();
  const Periods periods = closed_periods(surface);
  const Vec2 step(domain.u.width() / n, domain.v.width() / n);
  std::vector<Vec3> points;
  const auto at = [&](int i, int j) { return static_cast<size_t>(i) * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) points.push_back(surface.point(domain.u.lo + i * step.x, domain.v.lo + j * step.y));
  const auto node = [&](const Vec2& uv) {
    return at(static_cast<int>(std::lround((uv.x - domain.u.lo) / step.x)),
              static_cast<int>(std::lround((uv.y - domain.v.lo) / step.y)));
  };
  std::vector<double> distance(points.size(), kInfinity);
  std::priority_queue<std::pair<double, size_t>, std::vector<std::pair<double, size_t>>, std::greater<>> open;
  distance[node(from)] = 0;
  open.push({0, node(from)});
  while (!open.empty()) {
    const auto [so_far, k] = open.top();
    open.pop();
    if (so_far > distance[k]) continue;
    if (k == node(to)) return so_far;
    const int i = static_cast<int>(k) / (n + 1), j = static_cast<int>(k) % (n + 1);
    for (int a = -5; a <= 5; ++a)
      for (int b = -5; b <= 5; ++b) {
        int x = i + a, y = j + b;
        if (periods.u > 0) x = (x % n + n) % n;
        if (periods.v > 0) y = (y % n + n) % n;
        if (x < 0 || x > n || y < 0 || y > n) continue;
        const double further = so_far + glm::length(points[at(x, y)] - points[k]);
        if (further < distance[at(x, y)]) distance[at(x, y)] = further, open.push({further, at(x, y)});
      }
  }
  return kInfinity;
}

TEST(ShortestGeodesics, AreTheShortestOfAll) {
  const TorusSurface torus(Frame{}, 3, 1);
  const Ellipsoid egg(Frame{}, {3, 2, 1});
  const NurbsSurface patch = hills({0, 0, 0, 0, 0.4, 1, 1, 1, 1});
  struct Case {
    const Surface* surface;
    Vec2 from, to;
  };
  constexpr int n = 160;
  for (const Case& one : {Case{&torus, {0, 0}, {kPi, 0}}, Case{&torus, {0, 0}, {0.75 * kPi, -0.5 * kPi}},
                          Case{&torus, {0, 0.75 * kPi}, {1.5 * kPi, -0.75 * kPi}},
                          Case{&egg, {0.5 * kPi, 0}, {1.5 * kPi, 0}}, Case{&egg, {0, 0.25 * kPi}, {kPi, -0.25 * kPi}},
                          Case{&patch, {0.1, 0.1}, {0.9, 0.9}}, Case{&patch, {0.05, 0.5}, {0.95, 0.5}}}) {
    const SurfaceLine line = shortest_geodesic(*one.surface, one.from, one.to);
    const double length = line.image->domain().hi, other = over_grid(*one.surface, one.from, one.to, n);
    EXPECT_LE(length, other * (1 + 5e-3));  // chords are shorter than the surface
    EXPECT_GE(length, 0.97 * other);
    EXPECT_LE(line.error, 1e-11);
    const SurfaceCurve curve = in_space(*one.surface, line);
    EXPECT_NEAR(arc_length(curve, 0, length).value, length, 1e-11);
  }
}

// On an ellipsoid x^2/(A - m) + y^2/(B - m) + z^2/(C - m) = 1 for m = 0 and two others, one of which stays along a line
// of curvature.
std::array<double, 2> confocal(const Vec3& p, const Vec3& axes) {
  const double a = axes.x * axes.x, b = axes.y * axes.y, c = axes.z * axes.z;
  // Divided by m the equation is quadratic: m^2 - s m + t = 0 with the sum and product of the two.
  const double s = a + b + c - (p.x * p.x + p.y * p.y + p.z * p.z);
  const double t = a * b + b * c + c * a - (p.x * p.x * (b + c) + p.y * p.y * (c + a) + p.z * p.z * (a + b));
  const double root = std::sqrt(std::max(0.0, 0.25 * s * s - t));
  return {0.5 * s - root, 0.5 * s + root};
}

TEST(CurvatureLines, OfEllipsoidsLieOnConfocalQuadrics) {
  const Vec3 axes(3, 2, 1);
  const Ellipsoid egg(Frame{}, axes);
  for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
    for (const Vec2& through : {Vec2(0.5, 0.3), Vec2(1.2, 0.9), Vec2(5, -0.4)}) {
      const SurfaceLine line = curvature_line(egg, through, family, {});
      EXPECT_TRUE(line.closed);
      EXPECT_LE(line.error, 3e-12);
      const SurfaceCurve curve = in_space(egg, line);
      EXPECT_TRUE(curve.is_closed());
      const auto first = confocal(curve.point(0), axes);
      const int which = std::abs(confocal(curve.point(0.3), axes)[0] - first[0]) < 1e-9 ? 0 : 1;
      along_line(curve, [&](double t) { EXPECT_NEAR(confocal(curve.point(t), axes)[which], first[which], 2e-11); });
    }
  }
}

TEST(CurvatureLines, EndAtUmbilics) {
  const Ellipsoid egg(Frame{}, {3, 2, 1});
  const Vec3 umbilic(3 * std::sqrt(5.0 / 8), 0, std::sqrt(3.0 / 8));
  const SurfaceLine line = curvature_line(egg, {0, 0.2}, CurvatureFamily::minimum, {});
  const SurfaceCurve curve = in_space(egg, line);
  EXPECT_EQ(line.begins, LineEnd::singular);
  EXPECT_EQ(line.ends, LineEnd::singular);
  for (const double t : {curve.domain().lo, curve.domain().hi}) {
    const Vec3 p = curve.point(t);
    EXPECT_LE(glm::length(Vec3(p.x, p.y, std::abs(p.z)) - umbilic), 1e-7);
  }
  const SphereSurface ball(Frame{}, 1);
  EXPECT_EQ(refusal([&] {
              curvature_line(ball, {1, 0}, CurvatureFamily::maximum, {});
            }),
            "through: this is an umbilic: the curvature is the same in all directions");
}

TEST(CurvatureLines, OfRevolutionsAreMeridiansAndParallels) {
  TorusSurface torus(Frame{}, 3, 1);
  const auto parallel = curvature_line(torus, {0.3, 0.7}, CurvatureFamily::maximum, {});
  EXPECT_TRUE(parallel.closed);
  EXPECT_NEAR(parallel.image->domain().hi, kTwoPi * (3 + std::cos(0.7)), 1e-12);
  along_line(*parallel.image, [&](double t) { EXPECT_NEAR(parallel.image->point(t).y, 0.7, 1e-13); });
  EXPECT_EQ(in_space(torus, parallel).period(), parallel.image->domain().width());
  const auto meridian = curvature_line(torus, {0.3, 0.7}, CurvatureFamily::minimum, {});
  EXPECT_NEAR(meridian.image->domain().hi, kTwoPi, 1e-13);
  along_line(*meridian.image, [&](double t) { EXPECT_NEAR(meridian.image->point(t).x, 0.3, 1e-13); });
  // From the seam.
  const auto seam = curvature_line(torus, {0, -1}, CurvatureFamily::maximum, {});
  EXPECT_TRUE(seam.closed);
  EXPECT_NEAR(seam.image->domain().hi, kTwoPi * (3 + std::cos(1.0)), 1e-12);
  // The other side sees the other curvature.
  torus.set_reversed(true);
  EXPECT_NEAR(curvature_line(torus, {0.3, 0.7}, CurvatureFamily::maximum, {}).image->domain().hi, kTwoPi, 1e-13);
  const auto part = curvature_line(torus, {0.3, 0.7}, CurvatureFamily::maximum, 1.0);
  EXPECT_EQ(part.image->domain(), Interval(-0.5, 0.5));
  EXPECT_FALSE(part.closed);
}

TEST(CurvatureLines, OfEnnepersSurfaceAreItsParameterLines) {
  const FormulaSurface enneper =
      formula({"u - u^3/3 + u*v^2", "v - v^3/3 + v*u^2", "u^2 - v^2"}, {{-1.5, 1.5}, {-1.5, 1.5}});
  for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
    const SurfaceLine line = curvature_line(enneper, {0.4, -0.6}, family, {});
    EXPECT_EQ(line.begins, LineEnd::border);
    EXPECT_EQ(line.ends, LineEnd::border);
    const bool along_u = std::abs(line.image->evaluate(0, 1).d[1].y) < 1e-9;
    along_line(*line.image, [&](double t) {
      const Vec3 uv = line.image->point(t);
      EXPECT_NEAR(along_u ? uv.y + 0.6 : uv.x - 0.4, 0, 1e-13);
    });
    // |r_u| = |r_v| = 1 + u^2 + v^2.
    const double at = along_u ? 0.6 : 0.4;
    EXPECT_NEAR(line.image->domain().width(), 3 * (1 + at * at) + 2 * 1.5 * 1.5 * 1.5 / 3, 1e-12);
  }
}

TEST(AsymptoticLines, OfRuledQuadricsAreStraight) {
  const HyperboloidOneSheet tower(Frame{}, {1, 0.8, 1.2}, {{0, kTwoPi}, {-1, 1}});
  const HyperbolicParaboloid saddle(Frame{}, 1, 0.7, {{-2, 2}, {-2, 2}});
  const Surface* surfaces[] = {&tower, &saddle};
  for (const Surface* surface : surfaces) {
    Vec3 directions[2];
    for (const AsymptoticFamily family : {AsymptoticFamily::first, AsymptoticFamily::second}) {
      const SurfaceLine line = asymptotic_line(*surface, {0.4, 0.3}, family, {});
      EXPECT_EQ(line.begins, LineEnd::border);
      EXPECT_EQ(line.ends, LineEnd::border);
      const SurfaceCurve curve = in_space(*surface, line);
      const Interval range = curve.domain();
      const Vec3 from = curve.point(range.lo), to = curve.point(range.hi);
      EXPECT_NEAR(glm::length(to - from), range.width(), 1e-12);
      along_line(curve, [&](double t) {
        EXPECT_LE(glm::length(curve.point(t) - (from + (t - range.lo) / range.width() * (to - from))), 1e-12);
      });
      directions[family == AsymptoticFamily::first ? 0 : 1] = glm::normalize(to - from);
    }
    EXPECT_LT(std::abs(glm::dot(directions[0], directions[1])), 0.99);
  }
}

TEST(AsymptoticLines, OfTheHelicoidAreRulingsAndHelices) {
  const FormulaSurface helicoid = formula({"v*cos(u)", "v*sin(u)", "0.5*u"}, {{-4, 4}, {0.2, 2}});
  bool ruling = false, helix = false;
  for (const AsymptoticFamily family : {AsymptoticFamily::first, AsymptoticFamily::second}) {
    const SurfaceLine line = asymptotic_line(helicoid, {0.3, 1}, family, {});
    const Vec3 end = line.image->point(line.image->domain().hi);
    const double length = line.image->domain().width();
    ruling = ruling || (std::abs(end.x - 0.3) < 1e-12 && std::abs(length - 1.8) < 1e-13);
    helix = helix || (std::abs(end.y - 1) < 1e-12 && std::abs(length - 8 * std::hypot(1.0, 0.5)) < 1e-12);
  }
  EXPECT_TRUE(ruling && helix);
}

TEST(AsymptoticLines, HaveTheTorsionOfBeltramiAndEnneper) {
  // |torsion| = sqrt(-K): 1 on the pseudosphere.
  const FormulaSurface pseudosphere =
      formula({"cos(u)/cosh(v)", "sin(u)/cosh(v)", "v - tanh(v)"}, {{-20, 20}, {0.3, 3}});
  const TorusSurface torus(Frame{}, 3, 1);
  const Surface* surfaces[] = {&pseudosphere, &torus};
  for (const Surface* surface : surfaces) {
    for (const AsymptoticFamily family : {AsymptoticFamily::first, AsymptoticFamily::second}) {
      const SurfaceLine line = asymptotic_line(*surface, surface == &torus ? Vec2(0.3, 3) : Vec2(0.3, 1), family, {});
      const SurfaceCurve curve = in_space(*surface, line);
      const Interval range = curve.domain();
      for (double part = 0.05; part < 1; part += 0.1) {
        const double t = range.lo + part * range.width();
        const Vec3 uv = line.image->point(t);
        const Vec3 normal = surface->normal(uv.x, uv.y);
        const double gaussian = curvature(surface->evaluate(uv.x, uv.y, 2), normal).gaussian;
        const CurveJet at = curve.evaluate(t, 3);
        EXPECT_NEAR(glm::dot(at.d[2], normal), 0, 1e-9);
        EXPECT_NEAR(std::abs(curvature(at).torsion), std::sqrt(-gaussian), 1e-6);
      }
      if (surface != &torus) continue;
      // To the parabolic circles.
      EXPECT_EQ(line.begins, LineEnd::singular);
      EXPECT_NEAR(std::abs(curve.point(range.hi).z), 1, 1e-9);
      EXPECT_NEAR(std::abs(curve.point(range.lo).z), 1, 1e-9);
    }
  }
  EXPECT_EQ(refusal([&] {
              asymptotic_line(torus, {0, 0}, AsymptoticFamily::first, {});
            }),
            "through: there are no asymptotic directions: the Gaussian curvature is not negative here");
}

TEST(SurfaceLines, EndWhereTheyShouldOnAnyPatch) {
  const NurbsSurface patch = hills({0, 0, 0, 0, 0.4, 1, 1, 1, 1});
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  const double size = bounds(patch).diameter();
  double worst = 0;
  int lines = 0;
  const auto check = [&](const std::function<SurfaceLine()>& make) {
    SurfaceLine line;
    const std::string refused = refusal([&] { line = make(); });
    if (refused != "none") {
      EXPECT_TRUE(refused.find("not negative") != std::string::npos) << refused;
      return;
    }
    ++lines;
    worst = tests::worse(worst, line.error / size);
    const Vec3 end = line.image->point(line.image->domain().hi);
    const double room = std::min({end.x, end.y, 1 - end.x, 1 - end.y});
    if (line.ends == LineEnd::border) {
      EXPECT_LE(std::abs(room), 1e-14);
    } else {
      EXPECT_GE(room, 0);
    }
  };
  for (int sample = 0; sample < tests::tier_count(2000, 20); ++sample) {
    const Vec2 start(uniform(random), uniform(random));
    const double angle = kTwoPi * uniform(random);
    check([&] { return geodesic(patch, start, angle, 30); });
    check([&] { return curvature_line(patch, start, CurvatureFamily::maximum, 30.0); });
    check([&] { return curvature_line(patch, start, CurvatureFamily::minimum, 30.0); });
    check([&] { return asymptotic_line(patch, start, AsymptoticFamily::first, 30.0); });
    check([&] { return asymptotic_line(patch, start, AsymptoticFamily::second, 30.0); });
  }
  EXPECT_LE(worst, 1e-11);
  tests::report_figure("lines", lines);
  tests::report_figure("largest_error_of_size", worst);
}

}  // namespace
}  // namespace lekalo::geometry::surface_lines_test
