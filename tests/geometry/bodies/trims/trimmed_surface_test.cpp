// Outsides of loops on closed surfaces that no straight line could cut open: areas in closed form, rays against a
// cylinder solved here, and holes counted in meshes (Euler's number).
#include "geometry/bodies/trims/trimmed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/contours/body_contours.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/tessellation/tessellate.h"
#include "support/tier.h"

namespace lekalo::geometry::trimmed_surface_test {
namespace {

struct Hole {
  double u, v, radius;
};

// Rows of holes, every other row moved by half a pitch.
std::vector<Hole> staggered(int rows, int in_row, double first, double step, double radius) {
  std::vector<Hole> holes;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < in_row; ++i) holes.push_back({(i + 0.5 * (j % 2)) * kTwoPi / in_row, first + j * step, radius});
  return holes;
}

std::vector<CurvePtr> circles(const std::vector<Hole>& holes) {
  std::vector<CurvePtr> loops;
  for (const Hole& h : holes) loops.push_back(std::make_shared<Circle>(Frame{{h.u, h.v, 0}}, h.radius));
  return loops;
}

CurvePtr polygon(const std::vector<Vec2>& points) {
  std::vector<Vec3> in_space;
  for (const Vec2& p : points) in_space.emplace_back(p, 0);
  return std::make_shared<NurbsCurve>(polyline(in_space, true));
}

// One face with as many holes, cut open along so many seams.
void check_topology(const Body& sheet, size_t holes, int seams) {
  ASSERT_TRUE(sheet.is_valid()) << sheet.violations().front().condition;
  ASSERT_EQ(sheet.faces.size(), 1u);
  EXPECT_EQ(sheet.faces[0].loops.size(), holes + 1);
  EXPECT_EQ(std::count_if(sheet.edges.begin(), sheet.edges.end(),
                          [](const Edge& edge) { return edge.kind == EdgeKind::seam && edge.coedges.size() == 2; }),
            seams);
}

// Corners - sides + triangles.
int euler_number(const Mesh& mesh) {
  std::set<int> corners;
  std::set<std::pair<int, int>> sides;
  for (const Mesh::Triangle& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      corners.insert(triangle.point[k]);
      sides.insert(std::minmax(static_cast<int>(triangle.point[k]), static_cast<int>(triangle.point[(k + 1) % 3])));
    }
  return static_cast<int>(corners.size()) - static_cast<int>(sides.size()) + static_cast<int>(mesh.triangles.size());
}

TEST(TrimmedSurface, StaggeredHolesOfACylinder) {
  // At radius 1 angle and height measure lengths.
  const auto tube = std::make_shared<CylinderSurface>(Frame{}, 1, 1, Rectangle{{0, kTwoPi}, {0, 3}});
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> even(-1, 1);
  for (const auto& holes :
       {staggered(2, 6, 1, 0.6, 0.3), staggered(9, 12, 0.3, 0.3, 0.17), staggered(5, 3, 0.5, 0.5, 0.45)}) {
    const Body sheet = trimmed_surface(tube, circles(holes), true);
    check_topology(sheet, holes.size(), 1);
    const double radius = holes[0].radius,
                 area = 3 * kTwoPi - static_cast<double>(holes.size()) * kPi * radius * radius;
    EXPECT_NEAR(measure(sheet).area.value, area, 1e-10);
    TessellationTolerance tolerance;
    tolerance.sag = 1e-3;
    const Mesh mesh = tessellate(sheet, tolerance);
    EXPECT_EQ(euler_number(mesh), -static_cast<int>(holes.size()));
    EXPECT_NEAR(measure(mesh).area.value, area, 0.01 * area);
    const LineIntersector lines(sheet);
    int wrong = 0, kept = 0;
    for (int k = 0; k < tests::tier_count(100000); ++k) {
      const Vec3 a(2 * even(random), 2 * even(random), 1.5 + 2 * even(random)),
          b(even(random), even(random), 1.5 + 1.5 * even(random)), along = b - a;
      const double square = along.x * along.x + along.y * along.y, half = a.x * along.x + a.y * along.y,
                   root = half * half - square * (a.x * a.x + a.y * a.y - 1);
      if (!(root > 1e-9)) continue;
      size_t expected = 0;
      bool close = false;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-half + sign * std::sqrt(root)) / square;
        const Vec3 p = a + t * along;
        bool keeps = p.z > 0 && p.z < 3;
        close = close || std::abs(p.z) < 1e-9 || std::abs(p.z - 3) < 1e-9;
        for (const Hole& h : holes) {
          const double off = std::hypot(std::remainder(std::atan2(p.y, p.x) - h.u, kTwoPi), p.z - h.v) - h.radius;
          keeps = keeps && off > 0;
          close = close || std::abs(off) < 1e-9;
        }
        expected += keeps ? 1 : 0;
      }
      if (close) continue;
      const size_t found = lines.all_hits({a, along}).size();
      wrong += found != expected ? 1 : 0;
      kept += static_cast<int>(found);
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(kept, 100);
  }
}

// Rays aimed at the seam itself: each meets the sheet there once.
TEST(TrimmedSurface, NothingIsLostAlongASeam) {
  const auto tube = std::make_shared<CylinderSurface>(Frame{}, 1, 1, Rectangle{{0, kTwoPi}, {0, 3}});
  const Body sheet = trimmed_surface(tube, circles(staggered(9, 12, 0.3, 0.3, 0.17)), true);
  const auto seam = std::find_if(sheet.edges.begin(), sheet.edges.end(),
                                 [](const Edge& edge) { return edge.kind == EdgeKind::seam; });
  ASSERT_NE(seam, sheet.edges.end());
  const LineIntersector lines(sheet);
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> even(0, 1);
  const Interval t = seam->curve->domain();
  for (int k = 0; k < tests::tier_count(100000); ++k) {
    const Vec3 p = seam->curve->point(t.lo + t.width() * (0.001 + 0.998 * even(random)));
    const Vec3 out(p.x, p.y, even(random) - 0.5);
    EXPECT_EQ(lines.all_hits({p + out, -1.5 * out}, {0, 1}).size(), 1u);
  }
}

// Closed forms by integrals over discs: that of cos(v) is 2 pi r J1(r) times cos(v) in the middle.
TEST(TrimmedSurface, StaggeredHolesOfOtherSurfaces) {
  const auto sum = [](const std::vector<Hole>& holes, auto&& term) {
    double result = 0;
    for (const Hole& h : holes) result += term(h);
    return result;
  };
  const auto of_cosine = [](const Hole& h) {
    return kTwoPi * h.radius * std::cyl_bessel_j(1, h.radius) * std::cos(h.v);
  };
  const auto holes = staggered(4, 8, -0.75, 0.5, 0.27);
  const Body ball = trimmed_surface(std::make_shared<SphereSurface>(Frame{}, 2), circles(holes), true);
  check_topology(ball, holes.size(), 1);
  EXPECT_NEAR(measure(ball).area.value, 4 * (2 * kTwoPi - sum(holes, of_cosine)), 1e-10);
  TessellationTolerance tolerance;
  EXPECT_EQ(euler_number(tessellate(ball, tolerance)), 2 - static_cast<int>(holes.size()));

  const auto of_torus = [&](const Hole& h) { return 0.5 * (2 * kPi * h.radius * h.radius + 0.5 * of_cosine(h)); };
  const auto torus = std::make_shared<TorusSurface>(Frame{}, 2, 0.5);
  // A straight line parts the rows here, there none but along them.
  auto turned = staggered(4, 8, 0, kPi / 2, 0.3);
  for (Hole& h : turned) std::swap(h.u, h.v);
  for (const auto& of_either : {staggered(4, 8, 0, kPi / 2, 0.3), turned}) {
    const Body ring = trimmed_surface(torus, circles(of_either), true);
    check_topology(ring, of_either.size(), 2);
    EXPECT_NEAR(measure(ring).area.value, 4 * kPi * kPi - sum(of_either, of_torus), 1e-10);
    EXPECT_EQ(euler_number(tessellate(ring, tolerance)), -static_cast<int>(of_either.size()));
  }

  // Closed in v alone: a cylinder by its height, in thirds of it, and its angle.
  const auto lathe = std::make_shared<RevolutionSurface>(std::make_shared<Segment>(Vec3(1, 0, 0), Vec3(1, 0, 3)),
                                                         Axis{Vec3(0), Vec3(0, 0, 1)});
  auto upright = staggered(2, 12, 0.25, 0.5, 0.2);
  for (Hole& h : upright) std::swap(h.u, h.v);
  const Body sheet = trimmed_surface(lathe, circles(upright), true);
  check_topology(sheet, upright.size(), 1);
  EXPECT_NEAR(measure(sheet).area.value, 3 * (kTwoPi - 24 * kPi * 0.04), 1e-10);
}

// What a plane through a row of holes cuts of the tube: the arcs between them, one across the seam, one across the end
// of the circle that the plane cuts of the whole cylinder.
TEST(TrimmedSurface, SectionsPassOverSeams) {
  const auto tube = std::make_shared<CylinderSurface>(Frame{}, 1, 1, Rectangle{{0, kTwoPi}, {0, 3}});
  for (const double turn : {0.0, kPi / 12, 1.0}) {
    auto holes = staggered(9, 12, 0.3, 0.3, 0.17);
    for (Hole& h : holes) h.u += turn;
    const Body sheet = trimmed_surface(tube, circles(holes), true);
    for (const int row : {0, 3, 4, 8}) {
      const BodyContours found = plane_section(sheet, {0, 0, 0.3 + 0.3 * row}, {0, 0, 1});
      ASSERT_EQ(found.branches.size(), 12u);
      for (const BodyContour& branch : found.branches) {
        double length = 0;
        for (const BodyContourPart& part : branch.parts) length += contour_length(part.contour, part.t).value;
        EXPECT_FALSE(branch.closed);
        EXPECT_NEAR(length, kTwoPi / 12 - 0.34, 1e-11);
      }
    }
    const BodyContours between = plane_section(sheet, {0, 0, 0.06}, {0, 0, 1});
    ASSERT_EQ(between.branches.size(), 1u);
    EXPECT_TRUE(between.branches[0].closed);
  }
}

// Parameter lines are whole but for the chords of the holes, wherever the seam goes.
TEST(TrimmedSurface, ParameterLinesEndAtHoles) {
  const auto tube = std::make_shared<CylinderSurface>(Frame{}, 1, 1, Rectangle{{0, kTwoPi}, {0, 3}});
  const auto holes = staggered(9, 12, 0.3, 0.3, 0.17);
  const Body sheet = trimmed_surface(tube, circles(holes), true);
  const auto chord = [](const Hole& h, double off) {
    return 2 * std::sqrt(std::max(0.0, h.radius * h.radius - off * off));
  };
  for (int k = 0; k < 63; ++k) {
    const double u = 0.1 * k + 0.05, v = 2.9 * k / 63 + 0.013;
    double along_u = kTwoPi, along_v = 3;
    for (const Hole& h : holes) {
      along_u -= chord(h, v - h.v);
      along_v -= chord(h, std::remainder(u - h.u, kTwoPi));
    }
    for (const NetLine& line : parameter_lines(sheet, {{0, {u}}, {0, {v}}}))
      (line.held == IsoDirection::u ? along_v : along_u) -= line.along.width();
    EXPECT_NEAR(along_u, 0, 1e-9) << v;
    EXPECT_NEAR(along_v, 0, 1e-9) << u;
  }
}

// A border may run along a parameter line: beyond its ends the line goes on inside, or not at all.
TEST(TrimmedSurface, ParameterLinesAlongABorder) {
  const auto sheet = std::make_shared<Plane>(Frame{}, Rectangle{{-9, 9}, {-9, 9}});
  const std::vector<Vec3> narrow{{1, 0, 0}, {3, 0, 0}, {3.5, 2, 0}, {0.5, 2, 0}},
      step{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {5, 1, 0}, {5, 3, 0}, {0, 3, 0}};
  const auto along = [&](const std::vector<Vec3>& corners, double v) {
    Interval all{kInfinity, -kInfinity};
    const Curve2Ptr loop = std::make_shared<NurbsCurve>(polyline(corners, true));
    for (const NetLine& line : parameter_lines(trimmed_surface(sheet, {loop}), {{0, {}}, {0, {v}}}))
      all = {std::min(all.lo, line.along.lo), std::max(all.hi, line.along.hi)};
    return all;
  };
  // On the border itself rounding may take either side.
  for (const auto& [corners, v, within] :
       {std::tuple{narrow, 0.0, Interval{1, 3}}, {narrow, 2.0, {0.5, 3.5}}, {step, 0.0, {0, 2}}, {step, 1.0, {0, 5}}}) {
    const Interval found = along(corners, v);
    EXPECT_GE(found.lo, within.lo - 1e-12) << v;
    EXPECT_LE(found.hi, within.hi + 1e-12) << v;
  }
  EXPECT_LE(along(step, 1).lo, 1e-12);
  EXPECT_GE(along(step, 1).hi, 2 - 1e-12);
}

// Loops between which no way keeps climbing, long slots that overlap all round, and islands in holes.
TEST(TrimmedSurface, LoopsThatLeaveNarrowWays) {
  const auto tube = std::make_shared<CylinderSurface>(Frame{}, 1, 1, Rectangle{{0, kTwoPi}, {0, 3}});
  // Hooks with slanting roofs, each over the next one's: an arm hangs down from the roof beyond a spike on the next.
  const auto under = [](double x) { return 1.5 + 0.75 / 1.4 * x; };
  const std::vector<Vec2> hook{
      {0, 0.5},    {0.05, 0.5},         {0.05, under(0.05)},        {1.3, under(1.3)}, {1.3, 1.8},
      {1.35, 1.8}, {1.35, under(1.35)}, {1.4, under(1.4)},          {1.4, 2.3},        {0.2, under(0.2) + 0.05},
      {0.2, 1.85}, {0.15, 1.85},        {0.15, under(0.15) + 0.05}, {0, 1.55}};
  double area = 0;
  for (size_t k = 0; k < hook.size(); ++k) {
    const Vec2 &a = hook[k], &b = hook[(k + 1) % hook.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  std::vector<CurvePtr> hooks;
  for (int k = 0; k < 6; ++k) {
    std::vector<Vec2> points = hook;
    for (Vec2& p : points) p.x += k * kPi / 3;
    hooks.push_back(polygon(points));
  }
  const Body hooked = trimmed_surface(tube, hooks, true);
  check_topology(hooked, hooks.size(), 1);
  EXPECT_NEAR(measure(hooked).area.value, 3 * kTwoPi - 6 * area, 1e-10);
  EXPECT_EQ(euler_number(tessellate(hooked, {})), -6);
  // Slots that climb while they run four fifths round.
  std::vector<CurvePtr> slots;
  for (int k = 0; k < 8; ++k) {
    const double u = k * kPi / 4;
    slots.push_back(polygon({{u, 0.5}, {u + 0.2, 0.5}, {u + 5, 2.5}, {u + 4.8, 2.5}}));
  }
  const Body slotted = trimmed_surface(tube, slots, true);
  check_topology(slotted, slots.size(), 1);
  EXPECT_NEAR(measure(slotted).area.value, 3 * kTwoPi - 8 * 0.2 * 2, 1e-10);
  // An island in each hole is kept as a face of its own, with its hole.
  const auto holes = staggered(3, 4, 0.7, 0.8, 0.5);
  auto islands = holes;
  for (Hole& h : islands) h.radius = 0.2, h.u -= kTwoPi;
  auto all = circles(holes);
  for (const CurvePtr& island : circles(islands)) all.push_back(island);
  const Body dotted = trimmed_surface(tube, all, true);
  EXPECT_TRUE(dotted.is_valid());
  EXPECT_EQ(dotted.faces.size(), 1 + islands.size());
  EXPECT_NEAR(measure(dotted).area.value, 3 * kTwoPi - 12 * kPi * (0.25 - 0.04), 1e-10);
}

CurvePtr formula(const std::string& v, const Interval& t) {
  return std::make_shared<FormulaCurve>(point_formulas({"t", v, "0"}, {"t"}, Coordinates::cartesian), t);
}
CurvePtr segment(const Vec2& a, const Vec2& b) { return std::make_shared<Segment>(Vec3(a, 0), Vec3(b, 0)); }

double area_of(const Body& sheet) { return measure(sheet).area.value; }

// A pipe with an oblique end: loops that go all round have a band between them, wherever they begin, whichever way and
// in whatever order they run, of one curve or of several; a hole on the seam.
TEST(TrimmedSurface, RingsBoundABand) {
  const auto pipe = std::make_shared<CylinderSurface>(Frame{}, 1, 3);
  const double radius = 0.05, area = 3 * kTwoPi * 0.4 - 3 * kPi * radius * radius;
  for (const double begin : {0.0, 1.0, -4.0}) {
    const CurvePtr wave = formula("0.5 + 0.15*sin(t)", {begin, begin + kTwoPi});
    const std::vector<CurvePtr> lows[] = {{segment({0, 0.1}, {kTwoPi, 0.1})},
                                          {segment({kTwoPi + 0.4, 0.1}, {0.4, 0.1})},
                                          {segment({0.2, 0.1}, {2, 0.1}), segment({kTwoPi + 0.2, 0.1}, {2, 0.1})}};
    for (const std::vector<CurvePtr>& low : lows)
      for (const bool wave_first : {true, false})
        for (const double hole : {0.0, begin, 3.0, 20.0}) {
          std::vector<CurvePtr> curves = low;
          curves.insert(wave_first ? curves.begin() : curves.end(), wave);
          curves.push_back(std::make_shared<Circle>(Frame{{hole, 0.25, 0}}, radius));
          const Body sheet = trimmed_surface(pipe, curves);
          check_topology(sheet, 1, 1);
          EXPECT_NEAR(area_of(sheet), area, 1e-10) << begin << " " << hole;
          const Mesh mesh = tessellate(sheet, {1e-3, kPi, {}});
          EXPECT_EQ(euler_number(mesh), -1);
          EXPECT_NEAR(measure(mesh).area.value, area, 0.02);
        }
    // What is above and below.
    const Body rest = trimmed_surface(pipe, {wave, segment({begin, 0.1}, {begin + kTwoPi, 0.1})}, true);
    EXPECT_TRUE(rest.is_valid());
    EXPECT_EQ(rest.faces.size(), 2u);
    EXPECT_NEAR(area_of(rest), 3 * kTwoPi * 0.6, 1e-10);
  }
}

// Lines meet of the pipe what lies in the band.
TEST(TrimmedSurface, LinesMeetTheBand) {
  const auto pipe = std::make_shared<CylinderSurface>(Frame{}, 1, 3);
  const Body sheet =
      trimmed_surface(pipe, {formula("0.5 + 0.15*sin(t)", {1, 1 + kTwoPi}), segment({kTwoPi, 0.1}, {0, 0.1})});
  const LineIntersector of_sheet(sheet), of_pipe(pipe);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int met = 0;
  for (int i = 0; i < tests::tier_count(200000); ++i) {
    const Vec3 from(4 * unit(random), 4 * unit(random), 4 * unit(random)),
        to(unit(random), unit(random), 1.5 + 1.5 * unit(random));
    const Line line{from, to - from};
    size_t expected = 0;
    bool near_border = false;
    for (const SurfaceHit& hit : of_pipe.all_hits(line)) {
      const double low = hit.v - 0.1, high = 0.5 + 0.15 * std::sin(hit.u) - hit.v;
      near_border = near_border || std::min(std::abs(low), std::abs(high)) < 1e-9;
      expected += low > 0 && high > 0;
    }
    if (near_border) continue;
    EXPECT_EQ(of_sheet.all_hits(line).size(), expected) << i;
    met += expected > 0;
  }
  EXPECT_GT(met, 200);
}

// An oblique cap of a sphere, over its pole: 2 pi r h.
TEST(TrimmedSurface, RingAndPoleBoundACap) {
  const auto ball = std::make_shared<SphereSurface>(Frame{}, 1);
  const CurvePtr circle =
      formula("atan2(cos(0.3), cos(t)*sin(0.3)) - acos(0.5/sqrt(cos(0.3)^2 + (cos(t)*sin(0.3))^2))", {0, kTwoPi});
  const Body cap = trimmed_surface(ball, {circle, segment({0, kPi / 2}, {kTwoPi, kPi / 2})});
  ASSERT_TRUE(cap.is_valid()) << cap.violations().front().condition;
  EXPECT_NEAR(area_of(cap), kPi, 1e-10);
  EXPECT_EQ(euler_number(tessellate(cap, {1e-3, kPi, {}})), 1);
  const Body rest = trimmed_surface(ball, {circle, segment({0, kPi / 2}, {kTwoPi, kPi / 2})}, true);
  EXPECT_NEAR(area_of(rest), 3 * kPi, 1e-10);
}

// Round a torus either way; the band between two rings, and what lies outside of it.
TEST(TrimmedSurface, RingsOfATorus) {
  const double big = 2, small = 0.7, all = kTwoPi * kTwoPi * big * small;
  const auto torus = std::make_shared<TorusSurface>(Frame{}, big, small);
  // Along u from v = 2 to 4 + sin(u)/2: the integral over v in closed form, over u by a sum that is exact for it.
  double along_u = 0;
  for (int k = 0; k < 64; ++k) {
    const double u = kTwoPi * k / 64, top = 4 + 0.5 * std::sin(u);
    along_u += kTwoPi / 64 * small * (big * (top - 2) + small * (std::sin(top) - std::sin(2.0)));
  }
  const std::vector<CurvePtr> rings{formula("4 + 0.5*sin(t)", {0, kTwoPi}), segment({0, 2}, {kTwoPi, 2})};
  EXPECT_NEAR(area_of(trimmed_surface(torus, rings)), along_u, 1e-9);
  EXPECT_NEAR(area_of(trimmed_surface(torus, rings, true)), all - along_u, 1e-9);
  // A third of it, across.
  const std::vector<CurvePtr> across{segment({1, 0}, {1, kTwoPi}),
                                     segment({1 + kTwoPi / 3, kTwoPi}, {1 + kTwoPi / 3, 0})};
  EXPECT_NEAR(area_of(trimmed_surface(torus, across)), all / 3, 1e-9);
  EXPECT_NEAR(area_of(trimmed_surface(torus, across, true)), 2 * all / 3, 1e-9);
}

TEST(TrimmedSurface, RingsThatBoundNothing) {
  const auto pipe = std::make_shared<CylinderSurface>(Frame{}, 1, 3);
  const auto torus = std::make_shared<TorusSurface>(Frame{}, 2, 0.7);
  const auto error_of = [](const SurfacePtr& surface, const std::vector<CurvePtr>& curves,
                           bool outside = false) -> std::string {
    try {
      trimmed_surface(surface, curves, outside);
    } catch (const TrimError& error) {
      return error.what();
    }
    return "";
  };
  const CurvePtr round = segment({0, 0.5}, {kTwoPi, 0.5});
  EXPECT_EQ(error_of(pipe, {round}),
            "the loop that begins with curve 0 goes all round the closed surface: alone it encloses nothing");
  EXPECT_EQ(error_of(pipe, {segment({0, 0}, {kTwoPi, 0})}, true),
            "the loop that begins with curve 0 goes all round the closed surface: alone it encloses nothing");
  EXPECT_EQ(error_of(pipe, {segment({0, 0}, {kTwoPi, 0}), segment({0, 1}, {kTwoPi, 1})}, true),
            "the loops leave nothing of the surface");
  EXPECT_EQ(error_of(torus, {round, segment({0.5, 0}, {0.5, kTwoPi})}),
            "the loops that begin with curve 0 and curve 1 go round the closed surface both ways");
  // Rings that cross, where they overlap in the parameter plane and where only copies of them do.
  for (const double begin : {0.0, 1.5, -1.5})
    EXPECT_NE(error_of(pipe, {round, formula("0.52 + 0.15*sin(t)", {begin, begin + kTwoPi})}).find("cross"),
              std::string::npos)
        << begin;
}

}  // namespace
}  // namespace lekalo::geometry::trimmed_surface_test
