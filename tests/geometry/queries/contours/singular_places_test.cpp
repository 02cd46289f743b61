// Lines against surfaces where a derivative vanishes, has no bounds, or the surface itself has none: cusps, creases of
// doubled control points, roots at a border, steps, poles, 0/0. Lines are aimed at points that the test finds by
// itself: by de Casteljau's algorithm or the formula.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "support/tier.h"

namespace lekalo::geometry::singular_places_test {
namespace {

SurfacePtr formula(const std::array<std::string, 3>& point, const Rectangle& domain) {
  return std::make_shared<FormulaSurface>(point_formulas(point, {"u", "v"}, Coordinates::cartesian), domain,
                                          FormulaSurface::Closed{});
}
SurfacePtr height(const std::string& z, const Rectangle& domain) { return formula({"u", "v", z}, domain); }

struct Random {
  std::mt19937_64 engine{7};
  double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine); }
  // Crosswise to no coordinate plane.
  Vec3 direction() {
    const auto part = [&] { return in(0.2, 1) * (in(-1, 1) < 0 ? -1 : 1); };
    return glm::normalize(Vec3(part(), part(), part()));
  }
};

struct Counts {
  int lost = 0, invented = 0;
};

// Lines through points of the surface, from a distance of about its size. `off` tells how far a point is from the
// surface, if that is known.
Counts aim(const SurfacePtr& surface, int count, double size, const std::function<Vec3(Random&)>& point,
           const std::function<double(const Vec3&)>& off = {}) {
  const LineIntersector intersector(surface);
  Random random;
  Counts counts;
  for (int k = 0; k < count; ++k) {
    const Vec3 target = point(random), d = random.direction();
    const Line line{target - random.in(1, 3) * size * d, d};
    bool found = false;
    for (const SurfaceHit& hit : intersector.all_hits(line)) {
      const Vec3 at = line.at(hit.t);
      found = found || glm::length(at - target) <= 1e-7 * size;
      if (glm::length(at - surface->point(hit.u, hit.v)) > 1e-9 * size || (off && !(off(at) <= 1e-9 * size)))
        ++counts.invented;
    }
    if (!found) ++counts.lost;
  }
  return counts;
}

Vec3 cusp(double t) {
  const Vec3 p[] = {{0, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 0}};
  Vec3 q[4];
  std::copy(p, p + 4, q);
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) q[i] = (1 - t) * q[i] + t * q[i + 1];
  return q[0];
}

}  // namespace

TEST(SingularPlaces, CuspsInTheMiddleOfAPiece) {
  const Vec3 points[] = {{0, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 0}};
  const auto curve = std::make_shared<NurbsCurve>(bezier_curve(points));
  const Counts counts = aim(
      std::make_shared<ExtrusionSurface>(curve, Vec3(0, 2, 0)), tests::tier_count(60000, 600), 2, [](Random& random) {
        // Evenly in space about the cusp at t = 1/2, where the curve goes with (t - 1/2)^2.
        const double w = random.in(-1, 1);
        return cusp(0.5 + 0.5 * w * std::abs(w) * std::abs(w)) + Vec3(0, random.in(0.01, 1.99), 0);
      });
  EXPECT_EQ(counts.lost, 0);
  EXPECT_EQ(counts.invented, 0);
}

TEST(SingularPlaces, CreasesOfDoubledControlPoints) {
  NurbsSurfaceForm form;
  form.degree_u = 2, form.degree_v = 1;
  form.knots_u = {0, 0, 0, 1, 2, 3, 4, 4, 4};
  form.knots_v = {0, 0, 1, 1};
  for (const Vec2& p : {Vec2(-2, 0.5), Vec2(-1, 0.7), Vec2(0, -0.5), Vec2(0, -0.5), Vec2(1, -1), Vec2(2, 0.2)})
    for (const double y : {-1.0, 1.0}) form.points.push_back({p.x, y, p.y + 0.1 * y, 1});
  const auto roof = std::make_shared<NurbsSurface>(form);
  const LineIntersector intersector(roof);
  Random random;
  for (const double off : {0.0, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6, 1e-4})
    for (int k = 0; k < tests::tier_count(4000, 40); ++k) {
      const double x = random.in(-1, 1) < 0 ? -off : off, y = random.in(-0.9, 0.9);
      const std::vector<SurfaceHit> hits = intersector.all_hits({{x, y, 5}, {0, 0, -1}});
      ASSERT_EQ(hits.size(), 1u) << off;
      EXPECT_NEAR(5 - hits[0].t, -0.5 + 0.1 * y, 1e-9 + 2 * off);
    }
}

// Heights over a rectangle are met once by each vertical line, and by lines aimed at them.
TEST(SingularPlaces, HeightsByFormulas) {
  struct Case {
    const char* formula;
    std::function<double(double, double)> z;
  };
  const auto r = [](double x, double y) { return std::hypot(x, y); };
  const Case cases[] = {
      {"sin(9*sqrt(u^2 + v^2))/(9*sqrt(u^2 + v^2))",
       [&](double x, double y) { return std::sin(9 * r(x, y)) / (9 * r(x, y)); }},
      {"sin(9*max(hypot(u, v), 1e-6))/(9*max(hypot(u, v), 1e-6))",
       [&](double x, double y) { return std::sin(9 * std::max(r(x, y), 1e-6)) / (9 * std::max(r(x, y), 1e-6)); }},
      {"1/u", [](double x, double) { return 1 / x; }},
      {"1/(u^2 + v^2)", [](double x, double y) { return 1 / (x * x + y * y); }},
      {"u*v/(u^2 + v^2)", [](double x, double y) { return x * y / (x * x + y * y); }},
      {"log(abs(u))", [](double x, double) { return std::log(std::abs(x)); }},
      {"floor(4*u) + v", [](double x, double y) { return std::floor(4 * x) + y; }},
      {"mod(3*u, 1)", [](double x, double) { return 3 * x - std::floor(3 * x); }},
      {"floor(3*sqrt(u^2 + v^2))", [&](double x, double y) { return std::floor(3 * r(x, y)); }},
      {"round(3*u*v)/3", [](double x, double y) { return std::round(3 * x * y) / 3; }},
      {"ceil(2*u + v)*u", [](double x, double y) { return std::ceil(2 * x + y) * x; }},
      {"mod(2*u*v + v, 0.5)",
       [](double x, double y) { return 2 * x * y + y - 0.5 * std::floor((2 * x * y + y) / 0.5); }},
      // Too many steps to be surfaces of their own.
      {"floor(150*u)/150", [](double x, double) { return std::floor(150 * x) / 150; }},
      {"floor(8*u)/8 + floor(8*v)/8", [](double x, double y) { return std::floor(8 * x) / 8 + std::floor(8 * y) / 8; }},
      {"abs(u*v)^0.5", [](double x, double y) { return std::sqrt(std::abs(x * y)); }},
      {"u/(abs(u) + 1e-9)", [](double x, double) { return x / (std::abs(x) + 1e-9); }},
  };
  const Rectangle domain{{-1, 1.3}, {-1, 1.07}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.formula);
    const SurfacePtr surface = height(one.formula, domain);
    const LineIntersector intersector(surface);
    Random random;
    const auto place = [&] { return Vec2(random.in(-0.99, 1.29), random.in(-0.99, 1.06)); };
    for (int k = 0; k < tests::tier_count(6000, 60); ++k) {
      const Vec2 at = place();
      const double z = one.z(at.x, at.y);
      const std::vector<SurfaceHit> hits = intersector.all_hits({{at.x, at.y, z + 10}, {0, 0, -1}});
      ASSERT_EQ(hits.size(), 1u) << at.x << " " << at.y;
      EXPECT_NEAR(hits[0].t, 10, 1e-9 * (1 + std::abs(z)));
    }
    const Counts counts = aim(
        surface, tests::tier_count(6000, 60), 4,
        [&](Random& of) {
          for (;;) {
            const double x = of.in(-0.99, 1.29), y = of.in(-0.99, 1.06), z = one.z(x, y);
            if (std::abs(z) < 4) return Vec3(x, y, z);
          }
        },
        [&](const Vec3& p) { return std::abs(p.z - one.z(p.x, p.y)) / (1 + 1e3 * std::abs(p.z)); });
    EXPECT_EQ(counts.lost, 0);
  }
}

TEST(SingularPlaces, RootsOfZeroAtABorder) {
  const SurfacePtr cap = height("sqrt(1 - u^2)", {{-1, 1}, {-1, 1}});
  const LineIntersector intersector(cap);
  Random random;
  for (double z = 0.5; z > 1e-6; z *= 0.5)
    for (int k = 0; k < tests::tier_count(400, 4); ++k) {
      const Line line{{5, random.in(-0.5, 0.5), z}, {-1, random.in(-0.05, 0.05), 0}};
      const std::vector<SurfaceHit> hits = intersector.all_hits(line);
      ASSERT_EQ(hits.size(), 2u) << z;
      const double x = std::sqrt(1 - z * z);
      EXPECT_NEAR(line.at(hits[0].t).x, x, 1e-9);
      EXPECT_NEAR(line.at(hits[1].t).x, -x, 1e-9);
    }
}

// A superquadric: places evenly over its parameters and so on its faces, where powers of small numbers rise fast.
TEST(SingularPlaces, FractionalPowers) {
  for (const double e : {0.3, 0.5, 2.0}) {
    SCOPED_TRACE(e);
    const auto power = [](const std::string& x, double exponent) {
      return "sign(" + x + ")*abs(" + x + ")^" + std::to_string(exponent);
    };
    const auto value = [&](double x) { return (x < 0 ? -1 : 1) * std::pow(std::abs(x), e); };
    const std::string cos_v = power("cos(v)", e);
    const SurfacePtr surface =
        formula({cos_v + "*" + power("cos(u)", e), cos_v + "*" + power("sin(u)", e), power("sin(v)", e)},
                {{-kPi, kPi}, {-0.5 * kPi, 0.5 * kPi}});
    const Counts counts = aim(surface, tests::tier_count(4000, 40), 2, [&](Random& random) {
      const double u = random.in(-3.1, 3.1), v = random.in(-1.5, 1.5);
      return Vec3(value(std::cos(v)) * value(std::cos(u)), value(std::cos(v)) * value(std::sin(u)), value(std::sin(v)));
    });
    EXPECT_EQ(counts.lost, 0);
    EXPECT_EQ(counts.invented, 0);
  }
}

}  // namespace lekalo::geometry::singular_places_test
