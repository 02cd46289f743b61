// What surfaces that are made of others promise, on random data: nets and lofts contain their curves, sweeps keep their
// sections, offsets their distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "geometry/curve.h"
#include "geometry/surface.h"
#include "render/every_surface/examples.h"
#include "support/tier.h"

namespace lekalo::render::promises_test {
namespace {

using namespace geometry;
using every_surface::surface_of;

constexpr int kPlaces = 20;

std::string in_scene(const Vec3& p) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p.x, p.y, p.z); }

class Promises : public testing::Test {
 protected:
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Vec3 off(double by) { return {number(-by, by), number(-by, by), number(-by, by)}; }
  // A cubic from a to b.
  std::string curve(const Vec3& a, const Vec3& b) {
    return fmt::format("{{ type: bezier_curve, points: [{}, {}, {}, {}] }}", in_scene(a),
                       in_scene(a + (b - a) / 3.0 + off(0.4)), in_scene(a + (b - a) / 1.5 + off(0.4)), in_scene(b));
  }
  static int count() { return tests::tier_count(500, 5); }

 private:
  std::mt19937_64 random_{71};
};

CurvePtr curve_of(const std::string& fields) {
  const BuiltText built = build_text("geometry:\n  c: " + fields + "\n");
  return std::get<CurvePtr>(built.model.geometry.at("c"));
}

Vec3 at_share(const Curve& curve, double share) {
  return curve.point(curve.domain().lo + share * curve.domain().width());
}

// The curve lies at v, at equal shares of its parameter and the surface's u.
void expect_at_v(const Surface& surface, double v, const std::string& fields) {
  const CurvePtr curve = curve_of(fields);
  const Interval u = surface.domain().u;
  for (int i = 0; i <= kPlaces; ++i) {
    const double share = static_cast<double>(i) / kPlaces;
    EXPECT_LE(glm::length(surface.point(u.lo + share * u.width(), v) - at_share(*curve, share)), 1e-12)
        << v << " " << i;
  }
}
void expect_at_u(const Surface& surface, double u, const std::string& fields) {
  const CurvePtr curve = curve_of(fields);
  const Interval v = surface.domain().v;
  for (int i = 0; i <= kPlaces; ++i) {
    const double share = static_cast<double>(i) / kPlaces;
    EXPECT_LE(glm::length(surface.point(u, v.lo + share * v.width()) - at_share(*curve, share)), 1e-12)
        << u << " " << i;
  }
}

std::string joined(const std::vector<std::string>& curves) {
  std::string text;
  for (const std::string& one : curves) text += (text.empty() ? "" : ", ") + one;
  return text;
}

TEST_F(Promises, CoonsAndGordonContainTheirCurves) {
  for (int k = 0; k < count(); ++k) {
    const Vec3 a = off(0.3), b = Vec3(3, 0, 0) + off(0.3), c = Vec3(3, 3, 0) + off(0.3), d = Vec3(0, 3, 0) + off(0.3);
    const std::vector<std::string> u_lines{curve(a, b), curve(d, c)}, v_lines{curve(a, d), curve(b, c)};
    for (const std::string type : {"coons_surface", "gordon"}) {
      const SurfacePtr surface = surface_of(
          fmt::format("{{ type: {}, u_lines: [{}], v_lines: [{}] }}", type, joined(u_lines), joined(v_lines)));
      SCOPED_TRACE(type);
      for (int i = 0; i < 2; ++i) {
        expect_at_v(*surface, i, u_lines[i]);
        expect_at_u(*surface, i, v_lines[i]);
      }
    }
  }
}

// Parabolas through the nodes of a net.
TEST_F(Promises, GordonOfLargerNets) {
  for (int k = 0; k < count(); ++k) {
    std::array<std::array<Vec3, 3>, 3> nodes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) nodes[i][j] = Vec3(i, j, 0) + off(0.3);
    // The parabola through three points at 0, 1/2, 1.
    const auto parabola = [](const Vec3& p, const Vec3& q, const Vec3& r) {
      return fmt::format("{{ type: bezier_curve, points: [{}, {}, {}] }}", in_scene(p),
                         in_scene(2.0 * q - 0.5 * (p + r)), in_scene(r));
    };
    std::vector<std::string> u_lines, v_lines;
    for (int j = 0; j < 3; ++j) u_lines.push_back(parabola(nodes[0][j], nodes[1][j], nodes[2][j]));
    for (int i = 0; i < 3; ++i) v_lines.push_back(parabola(nodes[i][0], nodes[i][1], nodes[i][2]));
    for (const std::string method : {"lagrange", "spline", "hermite"}) {
      const SurfacePtr surface = surface_of(fmt::format("{{ type: gordon, method: {}, u_lines: [{}], v_lines: [{}] }}",
                                                        method, joined(u_lines), joined(v_lines)));
      SCOPED_TRACE(method);
      for (int i = 0; i < 3; ++i) {
        expect_at_v(*surface, 0.5 * i, u_lines[i]);
        expect_at_u(*surface, 0.5 * i, v_lines[i]);
      }
    }
  }
}

TEST_F(Promises, LoftsContainTheirCurves) {
  for (int k = 0; k < count(); ++k) {
    std::vector<std::string> curves;
    for (int i = 0; i < 4; ++i) curves.push_back(curve(Vec3(0, i, 0) + off(0.3), Vec3(3, i, 0) + off(0.3)));
    for (const std::string method : {"hermite", "spline", "lagrange"}) {
      const SurfacePtr surface = surface_of(
          fmt::format("{{ type: loft_surface, method: {}, at_v: [0, 1, 2.5, 3], of: [{}] }}", method, joined(curves)));
      SCOPED_TRACE(method);
      for (int i = 0; i < 4; ++i) expect_at_v(*surface, std::array{0.0, 1.0, 2.5, 3.0}[i], curves[i]);
    }
    const SurfacePtr guided = surface_of(
        fmt::format("{{ type: guided_loft, at_v: [0, 0.3, 0.7, 1], frame: {{ fixed: z }}, along: {}, of: [{}] }}",
                    curve(Vec3(1, 0, 0), Vec3(1, 3, 0)), joined(curves)));
    SCOPED_TRACE("guided");
    for (int i = 0; i < 4; ++i) expect_at_v(*guided, std::array{0.0, 0.3, 0.7, 1.0}[i], curves[i]);
  }
}

TEST_F(Promises, SweepsKeepTheirSection) {
  for (int k = 0; k < count(); ++k) {
    const std::string section = curve(Vec3(0), Vec3(0.4, 0.3, 0)), path = curve(off(0.2), Vec3(4, 0, 0) + off(0.2));
    const CurvePtr own = curve_of(section);
    for (const std::string frame : {"rotation_minimizing", "{ fixed: z }",
                                    "{ given: { type: segment, from: [0, 9, 0], "
                                    "to: [4, 9, 3] } }"}) {
      const SurfacePtr surface = surface_of(fmt::format(
          "{{ type: sweep_surface, path: {}, section: {}, frame: {}, twist: 70 deg*s }}", path, section, frame));
      for (int i = 0; i < kPlaces; ++i)
        for (int j = 0; j <= kPlaces; ++j) {
          const double a = static_cast<double>(i) / kPlaces, v = static_cast<double>(j) / kPlaces;
          const double chord = glm::length(own->point(1) - own->point(a));
          EXPECT_NEAR(glm::length(surface->point(1, v) - surface->point(a, v)), chord, 1e-12) << frame;
        }
    }
  }
}

// (0, 0) of the section on the path, (1, 0) on the rail, by equal fractions of their lengths.
TEST_F(Promises, SweepsBetweenRailsContainBoth) {
  for (int k = 0; k < count(); ++k) {
    const std::string path = curve(off(0.2), Vec3(4, 0, 0) + off(0.2)),
                      rail = curve(Vec3(0, 2, 0) + off(0.2), Vec3(4, 2, 0) + off(0.2));
    const SurfacePtr surface = surface_of(fmt::format("{{ type: sweep_surface, path: {}, rail: {}, section: {} }}",
                                                      path, rail, curve(Vec3(0), Vec3(1, 0, 0))));
    for (const auto& [u, of] : {std::pair(0.0, path), std::pair(1.0, rail)})
      expect_at_u(*surface, u, "{ type: reparametrized_curve, arc_length: true, of: " + of + " }");
  }
}

// Along the normal, which stays.
TEST_F(Promises, OffsetsKeepTheirDistance) {
  for (int k = 0; k < count(); ++k) {
    const std::string of = fmt::format("{{ type: ruled_surface, of: [{}, {}] }}", curve(off(0.2), Vec3(3, 0, 0)),
                                       curve(Vec3(0, 3, 0) + off(0.2), Vec3(3, 3, 0)));
    const double distance = number(-0.3, 0.3);
    const SurfacePtr base = surface_of(of),
                     surface =
                         surface_of(fmt::format("{{ type: offset_surface, distance: {:.17g}, of: {} }}", distance, of));
    for (int i = 0; i <= kPlaces; ++i)
      for (int j = 0; j <= kPlaces; ++j) {
        const double u = static_cast<double>(i) / kPlaces, v = static_cast<double>(j) / kPlaces;
        const Vec3 n = base->normal(u, v), d = surface->point(u, v) - base->point(u, v);
        EXPECT_NEAR(glm::dot(d, n), distance, 1e-10);
        EXPECT_NEAR(glm::length(d), std::abs(distance), 1e-10);
      }
  }
}

}  // namespace
}  // namespace lekalo::render::promises_test
