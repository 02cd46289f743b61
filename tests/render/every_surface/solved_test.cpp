// Surfaces whose points are solutions of equations: the equations, solved anew in 113 bits, and their derivatives by
// implicit differentiation. Fillets and chamfers between two graphs along a straight guide (Golovanov 2016, 4.9, 4.10).
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <functional>

#include "geometry/numerics/jet.h"
#include "geometry/surfaces/surface_checks.h"
#include "render/every_surface/examples.h"
#include "render/every_surface/formulas.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::solved_test {
namespace {

using namespace geometry;
using namespace every_surface;

constexpr const char* kFloor =
    "{ type: formula_surface, point: [u, v, 0.2*sin(u)*cos(v)], domain: { u: [-4, 4], v: [-4, 4] } }";
constexpr const char* kWall =
    "{ type: formula_surface, point: [u, 1.5 + 0.2*sin(u) + 0.3*v, v], domain: { u: [-4, 4], v: [-4, 4] } }";

// A point and the unit normal towards the ball.
template <class T>
struct Touch {
  Triple<T> point, normal;
};

template <class T>
Touch<T> touch(const Triple<T>& point, const Triple<T>& along_u, const Triple<T>& along_v) {
  const Triple<T> n = cross(along_u, along_v);
  return {point, (1.0 / length(n)) * n};
}
template <class T>
Touch<T> floor_at(const T& u, const T& v) {
  return touch<T>({u, v, 0.2 * sin(u) * cos(v)}, {T(1), T(0), 0.2 * cos(u) * cos(v)},
                  {T(0), T(1), -0.2 * sin(u) * sin(v)});
}
template <class T>
Touch<T> wall_at(const T& u, const T& v) {
  return touch<T>({u, 1.5 + 0.2 * sin(u) + 0.3 * v, v}, {T(1), 0.2 * cos(u), T(0)}, {T(0), T(0.3), T(1)});
}

template <class T>
using Unknowns = std::array<T, 4>;

// Sizes at the guide's parameter t, which is the fraction of its length.
struct Ball {
  template <class T>
  T radius(const T& t) const {
    return 0.4 + 0.2 * t;
  }
  // Where a ball that touches has its center, as each of the two surfaces tells.
  template <class T>
  std::array<Triple<T>, 2> centers(const Unknowns<T>& x, const T& t) const {
    const Touch<T> a = floor_at(x[0], x[1]), b = wall_at(x[2], x[3]);
    return {a.point + radius(t) * a.normal, b.point + radius(t) * b.normal};
  }
};
struct Bevel {
  // Where the legs, along the tangent planes and across both normals, meet.
  template <class T>
  std::array<Triple<T>, 2> centers(const Unknowns<T>& x, const T&) const {
    const Touch<T> a = floor_at(x[0], x[1]), b = wall_at(x[2], x[3]);
    const T cosine = dot(a.normal, b.normal), sine = length(cross(a.normal, b.normal));
    return {a.point + (0.5 / sine) * (cosine * a.normal - b.normal),
            b.point + (0.7 / sine) * (cosine * b.normal - a.normal)};
  }
};

// Both are one point, in the plane across the guide, which runs along x from -2 to 2.
template <class Blend, class T>
std::array<T, 4> equations(const Blend& blend, const Unknowns<T>& x, const T& t) {
  const auto [a, b] = blend.centers(x, t);
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.x - (4.0 * t - 2.0)};
}

using Series = Jet<Quad, kMaxSurfaceOrder>;
using Slope = Jet<Quad, 1>;

template <class Blend>
Eigen::Matrix4d jacobian(const Blend& blend, const Unknowns<Quad>& x, Quad t) {
  Eigen::Matrix4d result;
  for (int j = 0; j < 4; ++j) {
    Unknowns<Slope> moved;
    for (int i = 0; i < 4; ++i) moved[i] = i == j ? Slope::variable(x[i]) : Slope(x[i]);
    const std::array<Slope, 4> f = equations(blend, moved, Slope(t));
    for (int i = 0; i < 4; ++i) result(i, j) = static_cast<double>(f[i].c[1]);
  }
  return result;
}

// The Taylor polynomials of the solution about t: Newton's iteration with the derivatives at t, in double, gains 15
// digits of each coefficient a step.
template <class Blend>
Unknowns<Series> solution(const Blend& blend, double t, const std::array<double, 4>& start) {
  Unknowns<Series> x;
  for (int i = 0; i < 4; ++i) x[i] = Series(Quad(start[i]));
  for (int step = 0; step < 40; ++step) {
    Unknowns<Quad> at;
    for (int i = 0; i < 4; ++i) at[i] = x[i].c[0];
    const Eigen::Matrix4d inverse = jacobian(blend, at, Quad(t)).inverse();
    const std::array<Series, 4> f = equations(blend, x, Series::variable(Quad(t)));
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) x[i] = x[i] - Quad(inverse(i, j)) * f[j];
  }
  return x;
}

// A function of t as one of u and v.
J of_u(const Series& series) {
  J result(Quad(0));
  for (int n = 0; n <= kMaxSurfaceOrder; ++n) result.c[J::index(n, 0)] = series.c[n];
  return result;
}
Point of_u(const Triple<Series>& p) { return {of_u(p.x), of_u(p.y), of_u(p.z)}; }

Point section(const Ball& ball, const Unknowns<Series>& x, double t, const J& v) {
  const Touch<Series> a = floor_at(x[0], x[1]), b = wall_at(x[2], x[3]);
  const Triple<Series> center = ball.centers(x, Series::variable(Quad(t)))[0];
  const Series square = 0.5 * (1.0 + dot(a.normal, b.normal));  // of the middle weight
  const Triple<Series> middle =
      0.5 * (a.point + b.point - ((1.0 - square) / square) * (2.0 * center - a.point - b.point));
  const J b0 = (1.0 - v) * (1.0 - v), b1 = 2.0 * v * (1.0 - v) * of_u(sqrt(square)), b2 = v * v;
  return (1.0 / (b0 + b1 + b2)) * (b0 * of_u(a.point) + b1 * of_u(middle) + b2 * of_u(b.point));
}
Point section(const Bevel&, const Unknowns<Series>& x, double, const J& v) {
  return mix(v, of_u(floor_at(x[0], x[1]).point), of_u(wall_at(x[2], x[3]).point));
}

Vec3 derivative(const Point& p, int i, int j) {
  return {static_cast<double>(p.x.derivative(i, j)), static_cast<double>(p.y.derivative(i, j)),
          static_cast<double>(p.z.derivative(i, j))};
}

// Contacts are polynomials that agree with the solutions to 1e-13: each derivative loses two digits or more.
constexpr Tolerances kOfContacts{1e-12, 5e-10, 1e-7, 1e-5, 1e-3};

template <class Blend>
void expect_solved(const SurfacePtr& surface, const Blend& blend) {
  std::mt19937_64 random(81);
  const double size = checks::size_of(bounds(*surface));
  Tolerances worst{};
  for (int k = 0; k < tests::tier_count(500, 20); ++k) {
    const Vec2 at = checks::random_place(surface->domain(), random);
    // The contacts are the borders v = 0 and v = 1.
    const Vec3 a = surface->point(at.x, 0), b = surface->point(at.x, 1);
    const Unknowns<Series> x = solution(blend, at.x, {a.x, a.y, b.x, b.z});
    for (const Series& f : equations(blend, x, Series::variable(Quad(at.x))))
      for (const Quad& c : f.c) ASSERT_LT(static_cast<double>(abs(c)), 1e-28);
    for (const auto& [i, solved] : {std::pair(0, a.x), std::pair(1, a.y), std::pair(2, b.x), std::pair(3, b.z)})
      EXPECT_NEAR(static_cast<double>(x[i].c[0]), solved, 1e-12 * size);
    const Point exact = section(blend, x, at.x, J::v_variable(Quad(at.y)));
    const SurfaceJet jet = surface->evaluate(at.x, at.y, surface->max_order());
    double scale = size;
    for (int n = 0; n <= surface->max_order(); ++n) {
      for (int j = 0; j <= n; ++j) scale = std::max(scale, glm::length(derivative(exact, n - j, j)));
      for (int j = 0; j <= n; ++j)
        worst[n] = tests::worse(worst[n], glm::length(jet.d(n - j, j) - derivative(exact, n - j, j)) / scale);
    }
  }
  for (int n = 0; n <= surface->max_order(); ++n) EXPECT_LE(worst[n], kOfContacts[n]) << "order " << n;
}

const std::string kBetween =
    std::string("of: [") + kFloor + ", " + kWall + "], guide: { type: segment, from: [-2, 1, 0.5], to: [2, 1, 0.5] } }";

TEST(Solved, FilletOfAVariableRadius) {
  expect_solved(surface_of("{ type: fillet_surface, radius: 0.4 + 0.2*s, " + kBetween), Ball());
}

TEST(Solved, ChamferOfTwoLegs) {
  expect_solved(surface_of("{ type: chamfer_surface, legs: [0.5, 0.7], " + kBetween), Bevel());
}

}  // namespace
}  // namespace lekalo::render::solved_test
