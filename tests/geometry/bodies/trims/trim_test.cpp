// Trim regions against an oracle that counts how often the loops wind round a point: angles seen from the point, in
// long double, over Bezier arcs halved until their boxes exclude it. And trimmed surfaces against closed forms.
#include "geometry/bodies/trims/trim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/tessellation/tessellate.h"
#include "support/tier.h"

namespace lekalo::geometry::trim_test {
namespace {

using Real = long double;
struct Point4 {
  Real x, y, w;  // homogeneous
};

// The angle that an arc fills as seen from (u, v), or nothing where that cannot be told: the point lies on it.
std::optional<Real> angle_seen(const std::vector<Point4>& arc, Real u, Real v, int depth) {
  Real x_lo = INFINITY, x_hi = -INFINITY, y_lo = INFINITY, y_hi = -INFINITY;
  for (const Point4& p : arc) {
    x_lo = std::min(x_lo, p.x / p.w), x_hi = std::max(x_hi, p.x / p.w);
    y_lo = std::min(y_lo, p.y / p.w), y_hi = std::max(y_hi, p.y / p.w);
  }
  const Real ax = arc.front().x / arc.front().w - u, ay = arc.front().y / arc.front().w - v;
  const Real bx = arc.back().x / arc.back().w - u, by = arc.back().y / arc.back().w - v;
  constexpr Real kRoom = 1e-15;
  if (u < x_lo - kRoom || u > x_hi + kRoom || v < y_lo - kRoom || v > y_hi + kRoom)
    return std::atan2(ax * by - ay * bx, ax * bx + ay * by);
  if (depth == 0) return std::nullopt;
  std::vector<Point4> first, second(arc.size()), work = arc;
  for (size_t k = 0; k < arc.size(); ++k) {
    first.push_back(work.front());
    second[arc.size() - 1 - k] = work.back();
    for (size_t i = 0; i + 1 < work.size(); ++i)
      work[i] = {(work[i].x + work[i + 1].x) / 2, (work[i].y + work[i + 1].y) / 2, (work[i].w + work[i + 1].w) / 2};
    work.pop_back();
  }
  const auto a = angle_seen(first, u, v, depth - 1);
  if (!a) return a;
  const auto b = angle_seen(second, u, v, depth - 1);
  if (!b) return b;
  return *a + *b;
}

struct Loops {
  std::vector<std::vector<TrimRegion::Part>> parts;

  void add(CurvePtr curve, bool forward = true) { parts.push_back({{std::move(curve), forward}}); }
  // Whether an odd number of loops goes round the point; nothing on a border.
  std::optional<bool> holds(double u, double v) const {
    int around = 0;
    for (const auto& loop : parts) {
      Real angle = 0;
      for (const TrimRegion::Part& part : loop)
        for (const CurvePiece& piece : part.curve->pieces()) {
          std::vector<Point4> arc;
          for (const Vec4& p : piece.points) arc.push_back({p.x, p.y, p.w});
          const auto one = angle_seen(arc, u, v, 70);
          if (!one) return std::nullopt;
          angle += part.forward ? *one : -*one;
        }
      around += static_cast<int>(std::lround(angle / (2 * 3.14159265358979323846L)));
    }
    return around % 2 != 0;
  }
};

CurvePtr polygon(const std::vector<Vec3>& corners) { return std::make_shared<NurbsCurve>(polyline(corners, true)); }

CurvePtr circle_at(double x, double y, double radius) {
  Frame frame;
  frame.origin = {x, y, 0};
  return std::make_shared<Circle>(frame, radius);
}

class RandomRegions : public testing::Test {
 protected:
  std::mt19937_64 random_{17};
  std::uniform_real_distribution<double> unit_{0, 1};
  double any(double lo, double hi) { return lo + (hi - lo) * unit_(random_); }

  // A closed chain of rational cubics about the origin, and in it circles and polygons with horizontal sides.
  Loops any_loops() {
    Loops loops;
    const int count = 3 + static_cast<int>(random_() % 6);
    std::vector<Vec3> corners;
    for (int k = 0; k < count; ++k) {
      const double angle = kTwoPi * k / count, r = any(0.8, 1.6);
      // Now and then two corners at one height.
      corners.push_back({r * std::cos(angle), k % 3 == 1 ? 0.5 : r * std::sin(angle), 0});
    }
    auto& outer = loops.parts.emplace_back();
    for (int k = 0; k < count; ++k) {
      const Vec3 a = corners[k], b = corners[(k + 1) % count], off(any(-0.4, 0.4), any(-0.4, 0.4), 0);
      const bool forward = random_() % 2 == 0;
      std::vector<Vec3> points{a, a + (b - a) / 3.0 + off, b - (b - a) / 3.0 - off, b};
      std::vector<double> weights{1, any(0.3, 3), any(0.3, 3), 1};
      if (!forward) std::reverse(points.begin(), points.end());
      outer.push_back({std::make_shared<NurbsCurve>(bezier_curve(points, weights)), forward});
    }
    for (int k = 0; k < 4; ++k) loops.add(circle_at(any(-0.6, 0.6), any(-0.6, 0.6), any(0.05, 0.3)), k % 2 == 0);
    for (int k = 0; k < 2; ++k) {
      const Vec3 at(any(-0.5, 0.5), 0.25 * k, 0);
      loops.add(polygon({at, at + Vec3(0.3, 0, 0), at + Vec3(0.3, 0.25, 0), at + Vec3(0.1, 0.25, 0),
                         at + Vec3(0.1, 0.1, 0), at + Vec3(0, 0.1, 0)}));
    }
    return loops;
  }
};

TEST_F(RandomRegions, HoldWhatTheLoopsWindRound) {
  int wrong = 0, compared = 0, wrong_cells = 0, certain = 0;
  for (int k = 0; k < tests::tier_count(1000, 20); ++k) {
    const Loops loops = any_loops();
    const TrimRegion region(loops.parts);
    // Heights at which ends and horizontal tangents lie.
    std::vector<double> heights{0.5, 0, 0.25, 0.1, 0.35};
    std::vector<double> abscissas;
    for (const auto& loop : loops.parts)
      for (const TrimRegion::Part& part : loop)
        for (const CurvePiece& piece : part.curve->pieces())
          for (const Vec4& p : {piece.points.front(), piece.points.back()}) {
            heights.push_back(p.y / p.w);
            abscissas.push_back(p.x / p.w);
          }
    for (int i = 0; i < 400; ++i) {
      const double u = i % 5 == 4 ? abscissas[random_() % abscissas.size()] : any(-1.8, 1.8);
      const double v = i % 2 == 0 ? heights[random_() % heights.size()] : any(-1.8, 1.8);
      const auto expected = loops.holds(u, v);
      if (!expected) continue;
      ++compared;
      if (region.contains(u, v) != *expected) ++wrong;
    }
    for (int i = 0; i < 50; ++i) {
      const Vec2 lo(any(-1.6, 1.6), any(-1.6, 1.6)), size(any(0, 0.3), any(0, 0.3));
      const auto coverage = region.coverage({{lo.x, lo.x + size.x}, {lo.y, lo.y + size.y}});
      if (coverage == TrimRegion::Coverage::mixed) continue;
      ++certain;
      for (int j = 0; j < 5; ++j) {
        const auto expected = loops.holds(lo.x + any(0, size.x), lo.y + any(0, size.y));
        if (expected && *expected != (coverage == TrimRegion::Coverage::inside)) ++wrong_cells;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(wrong_cells, 0);
  EXPECT_GT(compared, 5000);
  EXPECT_GT(certain, 200);
  tests::report_figure("points", compared);
  tests::report_figure("wrong_points", wrong);
}

// A point between the loops and one of 400 holes; each asks the arcs of its own cell only.
TEST(TrimRegion, ManyHoles) {
  Loops loops;
  loops.add(polygon({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}}));
  for (int k = 0; k < 400; ++k) loops.add(circle_at(k % 20 + 0.5, k / 20 + 0.5, 0.3));
  const TrimRegion region(loops.parts);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 20);
  for (int i = 0; i < 20000; ++i) {
    const double u = unit(random), v = i % 3 == 0 ? std::floor(unit(random)) + (i % 2 == 0 ? 0.5 : 0.8) : unit(random);
    const double x = u - std::floor(u) - 0.5, y = v - std::floor(v) - 0.5, off = x * x + y * y - 0.09;
    if (std::abs(off) < 1e-13) continue;
    EXPECT_EQ(region.contains(u, v), off > 0) << u << ' ' << v;
    EXPECT_TRUE(region.contains(u, v, 1.01 * std::abs(std::sqrt(off + 0.09) - 0.3) + 1e-9));
  }
}

TEST(TrimRegion, CurvesWithoutRationalForm) {
  // A five-leaved star, r = 2 + cos(5 t) / 2.
  const auto star = std::make_shared<FormulaCurve>(
      point_formulas({"(2 + cos(5*t)/2)*cos(t)", "(2 + cos(5*t)/2)*sin(t)", "0"}, {"t"}, Coordinates::cartesian),
      Interval{0, kTwoPi});
  const TrimRegion region({{{star, true}}});
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-2.6, 2.6);
  for (int i = 0; i < tests::tier_count(100000); ++i) {
    const double u = unit(random), v = i % 10 == 0 ? 0 : unit(random);
    const double off = std::hypot(u, v) - 2 - std::cos(5 * std::atan2(v, u)) / 2;
    if (std::abs(off) > 1e-9) {
      EXPECT_EQ(region.contains(u, v), off < 0) << u << ' ' << v;
    }
  }
}

TEST(TrimmedSurface, AreasAndCentroids) {
  // A ring between circles in a plane, an island in it, given in any order and sense.
  const auto plane = std::make_shared<Plane>(Frame{}, Rectangle{{-2, 2}, {-2, 2}});
  Frame down{{0.3, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const Body ring =
      trimmed_surface(plane, {circle_at(0.3, 0, 0.2), std::make_shared<Circle>(down, 0.7), circle_at(0, 0, 1.5)});
  EXPECT_EQ(ring.faces.size(), 2u);
  EXPECT_TRUE(ring.is_valid()) << ring.violations().front().condition;
  EXPECT_NEAR(measure(ring).area.value, kPi * (2.25 - 0.49 + 0.04), 1e-11);
  EXPECT_NEAR(measure_face(ring, 1).centroid.x, -0.3 * 0.49 / (2.25 - 0.49), 1e-11);
  // A spherical zone's part: from u1 to u2 and v1 to v2 the area is (u2 - u1) (sin v2 - sin v1), across the seam.
  const auto sphere = std::make_shared<SphereSurface>(Frame{}, 2);
  const auto patch = polygon({{-0.5, -0.3, 0}, {0.7, -0.3, 0}, {0.7, 0.9, 0}, {-0.5, 0.9, 0}});
  EXPECT_NEAR(measure(trimmed_surface(sphere, {patch})).area.value, 4 * 1.2 * (std::sin(0.9) + std::sin(0.3)), 1e-11);
  // The rest of a torus without the same patch.
  const auto torus = std::make_shared<TorusSurface>(Frame{}, 2, 0.5);
  const double inside = measure(trimmed_surface(torus, {patch})).area.value,
               outside = measure(trimmed_surface(torus, {patch}, true)).area.value;
  EXPECT_NEAR(inside, 1.2 * 0.5 * (2 * 1.2 + 0.5 * (std::sin(0.9) + std::sin(0.3))), 1e-11);
  EXPECT_NEAR(inside + outside, 4 * kPi * kPi, 1e-10);
}

// Where a closed surface is cut open for its outside there is no border but a seam.
TEST(TrimmedSurface, OutsidesOfClosedSurfacesHaveSeams) {
  const struct {
    SurfacePtr surface;
    int seams, borders;
  } cases[] = {{std::make_shared<CylinderSurface>(Frame{}, 1, 1.5), 1, 3},
               {std::make_shared<SphereSurface>(Frame{}, 1.2), 1, 1},
               {std::make_shared<TorusSurface>(Frame{}, 1.2, 0.5), 2, 1}};
  for (const auto& [surface, seams, borders] : cases)
    for (const double at : {0.1, 3.0}) {
      const Body sheet = trimmed_surface(surface, {circle_at(at, 0.5, 0.3)}, true);
      EXPECT_TRUE(sheet.is_valid()) << sheet.violations().front().condition;
      const auto count = [&](EdgeKind kind, size_t uses) {
        return std::count_if(sheet.edges.begin(), sheet.edges.end(),
                             [&](const Edge& edge) { return edge.kind == kind && edge.coedges.size() == uses; });
      };
      EXPECT_EQ(count(EdgeKind::seam, 2), seams);
      EXPECT_EQ(count(EdgeKind::regular, 1), borders);
    }
}

// Lines meet what is left of a whole surface's hits, on every kind of surface, and the mesh has the same area.
TEST(TrimmedSurface, HitsAreThoseInsideTheLoops) {
  Grid<Vec3> net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) net.values.push_back({i - 1.5, j - 1.5, 0.6 * ((i * 7 + j * 5) % 4)});
  const SurfacePtr surfaces[] = {
      std::make_shared<NurbsSurface>(bezier_surface(net)), std::make_shared<CylinderSurface>(Frame{}, 1, 1.5),
      std::make_shared<SphereSurface>(Frame{}, 1.2), std::make_shared<TorusSurface>(Frame{}, 1.2, 0.5)};
  std::mt19937_64 random(23);
  std::normal_distribution<double> normal;
  for (const SurfacePtr& surface : surfaces) {
    // Holes across the seam where there is one.
    const bool closed = surface->periods().u > 0;
    const double x = closed ? 0.1 : 0.5, y = surface->domain().v.middle() + 0.05;
    const std::vector<CurvePtr> loops{circle_at(x, y, 0.4), circle_at(x + 0.1, y, 0.2)};
    const auto keeps = [&](double u, double v) {
      double in = 0;
      for (int turn = -1; turn <= (closed ? 1 : -1); ++turn) {
        const double du = closed ? u + turn * kTwoPi - x : u - x, dv = v - y;
        in += (du * du + dv * dv < 0.16 ? 1 : 0) + ((du - 0.1) * (du - 0.1) + dv * dv < 0.04 ? 1 : 0);
      }
      return in == 1;
    };
    for (const bool outside : {false, true}) {
      const Body sheet = trimmed_surface(surface, loops, outside);
      const LineIntersector all(surface), some(sheet);
      int wrong = 0, kept = 0;
      for (int i = 0; i < tests::tier_count(100000); ++i) {
        const Vec3 from = 3.0 * Vec3(normal(random), normal(random), normal(random));
        const Line line{from, 0.7 * Vec3(normal(random), normal(random), normal(random)) - from};
        std::vector<double> expected;
        bool close = false;
        for (const SurfaceHit& hit : all.all_hits(line)) {
          if (keeps(hit.u, hit.v) != outside) expected.push_back(hit.t);
          for (const double d : {-1e-9, 1e-9}) close = close || keeps(hit.u + d, hit.v) != keeps(hit.u - d, hit.v);
        }
        if (close) continue;
        const auto found = some.all_hits(line);
        kept += static_cast<int>(found.size());
        wrong += found.size() != expected.size();
        for (size_t h = 0; h < std::min(found.size(), expected.size()); ++h)
          EXPECT_NEAR(found[h].t, expected[h], 1e-11);
      }
      EXPECT_EQ(wrong, 0);
      EXPECT_GT(kept, 10);
      TessellationTolerance tolerance;
      tolerance.sag = 1e-3;
      const double area = measure(sheet).area.value;
      EXPECT_NEAR(measure(tessellate(sheet, tolerance)).area.value, area, 0.02 * area);
    }
  }
}

std::string error_of(const SurfacePtr& surface, const std::vector<CurvePtr>& curves, bool outside = false) {
  try {
    trimmed_surface(surface, curves, outside);
  } catch (const TrimError& error) {
    return error.what();
  }
  return "none";
}

CurvePtr rectangle(double u0, double v0, double u1, double v1) {
  return polygon({{u0, v0, 0}, {u1, v0, 0}, {u1, v1, 0}, {u0, v1, 0}});
}

// Cut out of a square along each of its sides, in corners, from side to side, and out of a loop.
TEST(TrimmedSurface, HolesOnBorders) {
  const auto plane = std::make_shared<Plane>(Frame{}, Rectangle{{-1, 1}, {-1, 1}});
  const std::vector<std::pair<std::vector<CurvePtr>, double>> cases = {
      {{rectangle(0.5, -0.5, 1, 0.5)}, 3.5},
      {{rectangle(-1, -0.5, -0.5, 0.5)}, 3.5},
      {{rectangle(-0.5, 0.5, 0.5, 1)}, 3.5},
      {{rectangle(-0.5, -1, 0.5, -0.5)}, 3.5},
      {{rectangle(0, 0, 1, 1), rectangle(-1, -1, 0, 0)}, 2},
      {{rectangle(-1, -0.2, 1, 0.2)}, 3.2},
      {{rectangle(-0.2, -1, 0.2, 1)}, 3.2},
  };
  for (const auto& [holes, area] : cases) {
    const Body sheet = trimmed_surface(plane, holes, true);
    EXPECT_NEAR(measure(sheet).area.value, area, 1e-12);
    std::vector<CurvePtr> all{rectangle(-1, -1, 1, 1)};
    all.insert(all.end(), holes.begin(), holes.end());
    EXPECT_NEAR(measure(trimmed_surface(plane, all)).area.value, area, 1e-12);
    // The grid's places are on no border.
    const LineIntersector lines(sheet);
    size_t kept = 0;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j)
        kept += lines.all_hits({{-0.975 + 0.05 * i, -0.975 + 0.05 * j, 1}, {0, 0, -1}}).size();
    EXPECT_NEAR(0.05 * 0.05 * static_cast<double>(kept), area, 1e-9);
  }
}

// Circles that touch from within or from beside, anywhere on them, are no circles that cross; those that reach over by
// less than chords are off arcs are.
TEST(TrimmedSurface, LoopsThatTouch) {
  const auto plane = std::make_shared<Plane>(Frame{}, Rectangle{{-4, 4}, {-4, 4}});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> even(0, 1);
  for (int k = 0; k < 25; ++k) {
    const double angle = 2 * kPi * even(random), radius = 0.2 + 0.7 * even(random);
    const auto circle_off = [&](double distance, double r) {
      return circle_at(distance * std::cos(angle), distance * std::sin(angle), r);
    };
    const std::vector<CurvePtr> within{circle_at(0, 0, 1), circle_off(1 - radius, radius)},
        beside{circle_at(0, 0, 1), circle_off(1 + radius, radius)};
    ASSERT_EQ(error_of(plane, within), "none") << k;
    EXPECT_NEAR(measure(trimmed_surface(plane, within)).area.value, kPi * (1 - radius * radius), 1e-11) << k;
    ASSERT_EQ(error_of(plane, beside), "none") << k;
    EXPECT_NEAR(measure(trimmed_surface(plane, beside)).area.value, kPi * (1 + radius * radius), 1e-11) << k;
    for (const double over : {1e-4, 1e-5})
      for (const double distance : {1 - radius + over, 1 + radius - over})
        EXPECT_EQ(error_of(plane, {circle_at(0, 0, 1), circle_off(distance, radius)}).substr(0, 54),
                  "the loops that begin with curve 0 and curve 1 cross ne")
            << k << " " << over;
  }
}

TEST(TrimmedSurface, ErrorsSayWhichLoopAndWhere) {
  const auto plane = std::make_shared<Plane>(Frame{}, Rectangle{{-2, 2}, {-2, 2}});
  const auto segment = [](const Vec3& a, const Vec3& b) { return std::make_shared<Segment>(a, b); };
  EXPECT_EQ(error_of(plane, {segment({0, 0, 0}, {1, 0, 0}), segment({1, 1, 0}, {1, 0, 0})}),
            "the loop that begins with curve 0 is open: it ends at (1, 1) and began at (0, 0)");
  EXPECT_EQ(error_of(plane, {segment({0, 0, 0}, {1, 0, 0}), segment({1, 1, 0}, {0.5, 1, 0})}),
            "the loop that begins with curve 0 is open: curve 1 does not go on at (1, 0)");
  // Round a sphere, with and without another loop behind.
  const auto sphere = std::make_shared<SphereSurface>(Frame{}, 1);
  const auto round = segment({0, 0.5, 0}, {kTwoPi, 0.5, 0});
  for (const auto& curves : {std::vector<CurvePtr>{round}, {round, circle_at(1, 0, 0.2)}})
    EXPECT_EQ(error_of(sphere, curves),
              "the loop that begins with curve 0 goes all round the closed surface: alone it encloses nothing");
  EXPECT_EQ(error_of(plane, {circle_at(0, 0, 1), circle_at(1.5, 0, 1)}),
            "curve 1 leaves the domain of the surface at (2.20711, 0.707107)");
  EXPECT_EQ(error_of(plane, {circle_at(0, 0, 1), circle_at(0, 1, 1), circle_at(1, 0, 0.1)}).substr(0, 54),
            "the loops that begin with curve 0 and curve 1 cross ne");
  EXPECT_EQ(error_of(plane, {polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})}),
            "the loop that begins with curve 0 crosses itself near (0.5, 0.5)");
  EXPECT_EQ(error_of(plane, {circle_at(0, 0, 1), circle_at(0, 0, 1)}),
            "the loops that begin with curve 0 and curve 1 are the same");
  EXPECT_EQ(error_of(plane, {rectangle(-2, -2, 2, 2)}, true),
            "the loops that begin with curve 0 and the surface's border are the same");
  EXPECT_EQ(error_of(plane, {rectangle(0, 0, 1, 1), rectangle(0.5, 0, 2, 1)}),
            "the loops that begin with curve 0 and curve 1 cross where they touch");
  // Through a corner of the other one and through the middle of a side of it.
  EXPECT_EQ(error_of(plane, {rectangle(-1, -1, 1, 1), polygon({{1, 1, 0}, {0.5, 0, 0}, {1, -0.5, 0}, {1.5, 0, 0}})}),
            "the loops that begin with curve 0 and curve 1 cross where they touch");
  EXPECT_EQ(error_of(plane, {std::make_shared<Circle>(Frame{{0, 0, 1}}, 1)}),
            "curve 0 does not lie in the parameter plane");
  EXPECT_EQ(error_of(std::make_shared<Plane>(Frame{}), {circle_at(0, 0, 1)}, true),
            "the surface is unbounded: it has no border for its outside to end at");
  EXPECT_EQ(error_of(std::make_shared<Plane>(Frame{}), {circle_at(0, 0, 1)}), "none");
}

}  // namespace
}  // namespace lekalo::geometry::trim_test
