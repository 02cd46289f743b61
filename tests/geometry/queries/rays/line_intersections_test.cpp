// Lines against whole surfaces and bodies: completeness against the halving oracle, parity of closed bodies, far
// origins. Counts follow the tier.
#include "geometry/queries/rays/line_intersections.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/splines/patches.h"
#include "geometry/surfaces/swept/revolution.h"
#include "support/line_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::line_intersections_test {
namespace {

struct RandomLines {
  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit{0, 1};
  Box3 box;
  double distance;  // of the origin from the target, in diameters

  RandomLines(unsigned seed, const Box3& b, double d) : random(seed), box(b), distance(d) {}
  Line next() {
    const Vec3 target = box.lo + Vec3(unit(random), unit(random), unit(random)) * box.size();
    const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    return {target - distance * box.diameter() * unit(random) * d, d};
  }
};

// Compares all hits with the oracle's, patch by patch; lines in the tangency band or on a border shared by two patches
// are told by shifts of 1e-9 of the size.
struct Report {
  int lines = 0, hits = 0, missing_or_extra = 0, band = 0;
  double largest_error = 0;
};

Report compare(const Surface& surface, const SurfacePtr& owner, int count, unsigned seed, double distance) {
  std::vector<oracle::PatchOracle> patches;
  std::vector<Box3> boxes;
  for (const SurfacePiece& piece : surface.pieces()) {
    patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);
    boxes.push_back(bounds(surface, piece));
  }
  const Box3 box = bounds(surface);
  const double size = box.diameter();
  const auto roots_of = [&](const Line& line) {
    std::vector<double> t;
    for (const oracle::PatchOracle& patch : patches)
      for (const oracle::Root& root : patch.roots(line)) t.push_back(root.t);
    std::sort(t.begin(), t.end());
    // A root on the border of two patches is found by both.
    t.erase(std::unique(t.begin(), t.end(), [&](double a, double b) { return std::abs(a - b) <= 1e-9 * size; }),
            t.end());
    return t;
  };
  const LineIntersector intersector(owner);
  RandomLines lines(seed, box, distance);
  Report report;
  for (int k = 0; k < count; ++k) {
    const Line line = lines.next();
    const std::vector<SurfaceHit> hits = intersector.all_hits(line);
    // The oracle's own arithmetic starts near the surface.
    const double foot_point = glm::dot(box.center() - line.origin, line.direction);
    const Line near{line.at(foot_point), line.direction};
    const std::vector<double> truth = roots_of(near);
    ++report.lines;
    report.hits += static_cast<int>(truth.size());
    bool same = truth.size() == hits.size();
    for (size_t i = 0; same && i < truth.size(); ++i) {
      const double error = std::abs(hits[i].t - (foot_point + truth[i])) / size;
      same = error <= 1e-9;
      report.largest_error = tests::worse(report.largest_error, error);
    }
    if (same) continue;
    bool band = false;
    for (int copy = 0; copy < 8 && !band; ++copy) {
      Line shifted = near;
      shifted.origin += 1e-9 * size * Vec3(copy & 1 ? 1 : -1, copy & 2 ? 1 : -1, copy & 4 ? 1 : -1);
      band = roots_of(shifted).size() != truth.size();
    }
    (band ? report.band : report.missing_or_extra) += 1;
  }
  return report;
}

void expect_complete(const SurfacePtr& surface, const char* name, int full_count, double distance) {
  const Report r = compare(*surface, surface, tests::tier_count(full_count), 7, distance);
  EXPECT_EQ(r.missing_or_extra, 0) << name << ": " << r.lines << " lines, " << r.hits << " hits, band " << r.band
                                   << ", largest error " << r.largest_error;
  EXPECT_LE(r.band, 1 + r.lines / 1000) << name;
  EXPECT_GT(r.hits, r.lines / 4) << name;
  tests::report_figure(std::string(name) + "_wrong", r.missing_or_extra);
  tests::report_figure(std::string(name) + "_in_band", r.band);
}

SurfacePtr as_spline(const Surface& surface) { return std::make_shared<NurbsSurface>(*surface.as_nurbs()); }

TEST(LineIntersections, NurbsSphere) {
  const auto sphere = as_spline(SphereSurface(Frame(), 1.0, SphereSurface::kFull));
  expect_complete(sphere, "nurbs_sphere", 20000, 2);
  expect_complete(sphere, "nurbs_sphere_from_1000_radii", 5000, 500);
}

TEST(LineIntersections, NurbsTorus) {
  const TorusSurface ring(Frame(), 3, 1, {{0, kTwoPi}, {-kPi, kPi}});
  expect_complete(as_spline(ring), "nurbs_torus", 20000, 2);
}

TEST(LineIntersections, RandomRationalBiquintic) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 5;
  form.knots_u = form.knots_v = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double w = std::exp(3 * (unit(random) - 0.5));
      form.points.push_back(Vec4(w * Vec3(i / 5.0, j / 5.0, unit(random)), w));
    }
  form.maps_u = form.maps_v = {ParameterMap{}};
  expect_complete(std::make_shared<NurbsSurface>(form), "rational_biquintic", 20000, 2);
}

// 240 degrees by 240 of a torus as one biquadratic patch: the middle weight of such an arc is cos 120 = -1/2, and the
// arc runs outside of the hull of its control points. Against the torus's quartic; lines near its borders or tangents,
// where a shift of 1e-9 changes their number, are left out.
TEST(LineIntersections, WeightsThatAreNegative) {
  const double half = kTwoPi / 3, c = std::cos(half), s = std::sin(half);
  const Vec2 arc[3] = {{c, -s}, {1 / c, 0}, {c, s}};
  const double weights[3] = {1, c, 1};
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 2;
  form.knots_u = form.knots_v = {0, 0, 0, 1, 1, 1};
  form.maps_u = form.maps_v = {ParameterMap{}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double radius = 3 + arc[j].x;
      form.points.push_back(Vec4(radius * arc[i].x, radius * arc[i].y, arc[j].y, 1) * (weights[i] * weights[j]));
    }
  const auto patch = std::make_shared<NurbsSurface>(form);
  const auto torus = std::make_shared<TorusSurface>(Frame(), 3, 1, Rectangle{{-half, half}, {-half, half}});
  EXPECT_TRUE(bounds(*patch).bounded());

  const LineIntersector of_patch(patch), of_torus(torus);
  RandomLines lines(9, bounds(*torus), 2);
  int hits = 0, wrong = 0, left_out = 0;
  const int count = tests::tier_count(1000000);
  for (int k = 0; k < count; ++k) {
    const Line line = lines.next();
    const std::vector<SurfaceHit> found = of_patch.all_hits(line), truth = of_torus.all_hits(line);
    hits += static_cast<int>(truth.size());
    bool same = found.size() == truth.size();
    for (size_t i = 0; same && i < truth.size(); ++i) same = std::abs(found[i].t - truth[i].t) <= 1e-7;
    if (same) continue;
    bool at_border = false;
    for (int copy = 0; copy < 8 && !at_border; ++copy) {
      const Vec3 shift(copy & 1 ? 1 : -1, copy & 2 ? 1 : -1, copy & 4 ? 1 : -1);
      at_border = of_torus.all_hits({line.origin + 1e-8 * shift, line.direction}).size() != truth.size();
    }
    ++(at_border ? left_out : wrong);
  }
  EXPECT_EQ(wrong, 0) << count << " lines, " << hits << " hits";
  EXPECT_LE(left_out, 1 + count / 10000);
  EXPECT_GT(hits, count / 4);
  tests::report_figure("negative_weights_wrong", wrong);
}

// An octant of the unit sphere as a biquadratic patch, its parameters moved by u -> c u / (1 + (c - 1) u) until the
// weights' ratio is 1e12. Lines aimed at points of the octant hit there, and all hits lie on the line and the sphere.
// Those that graze the sphere are left out: a few of them are lost.
TEST(LineIntersections, WeightsOfLargeRatio) {
  const double c = 1000, root = std::sqrt(0.5);
  const Vec3 points[3][3] = {
      {{1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{1, 1, 0}, {1, 1, 1}, {0, 0, 1}}, {{0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
  const double weights[3] = {1, root * c, c * c};
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 2;
  form.knots_u = form.knots_v = {0, 0, 0, 1, 1, 1};
  form.maps_u = form.maps_v = {ParameterMap{}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) form.points.push_back(Vec4(points[i][j], 1) * (weights[i] * weights[j]));
  const auto octant = std::make_shared<NurbsSurface>(form);
  const LineIntersector intersector(octant);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < tests::tier_count(1000000); ++i) {
    const Vec3 aim = glm::normalize(Vec3(unit(random), unit(random), unit(random)) + 1e-3);
    const Vec3 d = glm::normalize(Vec3(unit(random), unit(random), unit(random)) - 0.5);
    if (std::abs(glm::dot(d, aim)) < 0.01) continue;
    const Line line{aim - 2.0 * d, d};
    bool is_found = false;
    for (const SurfaceHit& hit : intersector.all_hits(line)) {
      EXPECT_LE(glm::length(octant->point(hit.u, hit.v) - line.at(hit.t)), 1e-9) << i;
      EXPECT_NEAR(glm::length(line.at(hit.t)), 1, 1e-9) << i;
      is_found = is_found || std::abs(hit.t - 2) <= 1e-7;
    }
    EXPECT_TRUE(is_found) << i;
  }
}

TEST(LineIntersections, TeapotPatches) {
  std::ifstream file(LEKALO_SOURCE_DIR "/scenes/data/newell_teapot.txt");
  std::stringstream text;
  text << file.rdbuf();
  const std::vector<SurfacePtr> patches = parse_patches(text.str());
  Report all;
  for (const SurfacePtr& patch : patches) {
    const Report r = compare(*patch, patch, tests::tier_count(3000), 11, 2);
    all.lines += r.lines;
    all.hits += r.hits;
    all.missing_or_extra += r.missing_or_extra;
    all.band += r.band;
  }
  EXPECT_EQ(all.missing_or_extra, 0) << all.lines << " lines, band " << all.band;
  tests::report_figure("teapot_patches_wrong", all.missing_or_extra);
}

// Every line meets a closed body an even number of times, alternately entering and leaving.
void expect_even(const Body& body, const char* name, const Vec3& moved_by = Vec3(0)) {
  const Body placed = transformed(body, Affine::translation(moved_by));
  const LineIntersector intersector(placed);
  RandomLines lines(3, bounds(placed), 2);
  int odd = 0, disordered = 0, hits = 0;
  const int count = tests::tier_count(200000);
  for (int k = 0; k < count; ++k) {
    const Line line = lines.next();
    const std::vector<SurfaceHit> found = intersector.all_hits(line);
    hits += static_cast<int>(found.size());
    odd += found.size() % 2;
    double sign = -1;  // outward normals look against a line that enters
    for (const SurfaceHit& hit : found) {
      disordered += glm::dot(placed.normal(hit.face, hit.u, hit.v), line.direction) * sign < 0;
      sign = -sign;
    }
  }
  EXPECT_EQ(odd, 0) << name << " of " << count;
  EXPECT_EQ(disordered, 0) << name;
  EXPECT_GT(hits, count / 2) << name;
  tests::report_figure(std::string(name) + "_odd", odd);
}

TEST(LineIntersections, BodiesAreMetAnEvenNumberOfTimes) {
  expect_even(box(Frame(), {1, 2, 3}), "box");
  expect_even(ball(Frame(), 1.5), "ball");
  expect_even(cylinder_body(Frame(), 1, 2), "cylinder");
  expect_even(frustum(Frame(), 2, 0, 3), "cone");
  expect_even(frustum(Frame(), 2, 1, 3), "frustum");
  expect_even(torus_body(Frame(), 3, 1), "torus");
  expect_even(arrow_body(Frame(), 3, 0.4, 1.5, 1), "arrow");
  expect_even(prism(Frame(), {{0, 0}, {2, 0}, {2.5, 1}, {1, 2}, {-0.5, 1}}, 2), "prism");
  expect_even(pyramid(Frame(), {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0, 2}), "pyramid");
}

TEST(LineIntersections, FarFromTheOriginToo) {
  expect_even(box(Frame(), {1, 2, 3}), "box_moved", {1000, -700, 300});
  expect_even(frustum(Frame(), 2, 0, 3), "cone_moved", {1000, -700, 300});
  expect_even(torus_body(Frame(), 3, 1), "torus_moved", {1000, -700, 300});
}

// Lines aimed exactly at vertices, edges and the apex: one crossing for each of the two sides, or a graze of both.
TEST(LineIntersections, LinesThroughEdgesAndVerticesStayEven) {
  const Frame skew = frame_from({0.3, -1.2, 2.5}, {1, 2, 2}, {1, 0.2, -0.4});
  Frame moved = skew;
  moved.origin = {600, -700, 387};
  const std::pair<const char*, Body> bodies[] = {
      {"box", box(Frame(), {1, 1, 1})},
      {"moved_box", box(moved, {1, 2, 3})},
      {"prism", prism(skew, {{0, 0}, {2, 0}, {2.5, 1}, {1, 2}, {-0.5, 1}}, 2)},
      {"pyramid", pyramid(skew, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0, 2})},
      {"wedge", wedge(skew, {3, 2, 1.5}, 1)},
      {"cylinder", cylinder_body(skew, 1, 2)},
      {"frustum", frustum(skew, 2, 1, 3)},
      {"cone", frustum(skew, 2, 0, 3)},
      {"arrow", arrow_body(skew, 3, 0.4, 1.5, 1)},
      {"torus", torus_body(skew, 3, 1)}};
  for (const auto& [name, body] : bodies) {
    const LineIntersector intersector(body);
    const double away = 1.5 * bounds(body).diameter();
    std::mt19937_64 random(9);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    int odd = 0;
    const int count = tests::tier_count(100000);
    for (int k = 0; k < count; ++k) {
      const Edge& edge = body.edges[k % body.edges.size()];
      const Interval range = edge.curve->domain();
      const double t = k % 7 == 0 ? range.lo : range.lo + unit(random) * range.width();
      const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
      odd += intersector.all_hits({edge.curve->point(t) - away * d, d}).size() % 2;
    }
    EXPECT_EQ(odd, 0) << name << " of " << count;
    tests::report_figure(std::string(name) + "_edge_aimed_odd", odd);
  }
}

// Lines in, or nearly in, the plane of a face and just past its border: the face must not take them for lines through
// the edge that its neighbours miss.
TEST(LineIntersections, LinesPastAnEdgeFromFarAwayStayEven) {
  const Frame frame = frame_from({0.1, 0.2, -0.3}, {0.2, -0.3, 0.9}, {1, 0.1, 0});
  const LineIntersector block(box(Frame{{-0.4, 0.1, 0.2}}, {1, 2, 3})),
      five(prism(Frame(), {{0, 0}, {2, 0}, {2.5, 1}, {1, 2}, {-0.5, 1}}, 2)), wedged(wedge(frame, {3, 2, 1.5}, 1)),
      pointed(pyramid(frame, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0, 2}));
  const std::pair<const LineIntersector*, Line> cases[] = {
      {&block,
       {{0x1.3333337b875b7p-1, 0x1.12d6374efe767p+18, -0x1.c7738d2f7a97cp+21},
        {0x0p+0, -0x1.3415bc3dd7b0dp-4, 0x1.fe8cb510a0d52p-1}}},
      {&block,
       {{-0x1.4519b96e4b745p+18, 0x1.9999988552d92p-4, -0x1.c6eefc016ed2cp+21},
        {0x1.6c6e1d1c63a74p-4, -0x0p+0, 0x1.fdf82ecd60af8p-1}}},
      {&five,
       {{0x1.138709238e5aep+20, 0x1.1386e9238e58ep+21, 0x1.8e071510a4731p+21},
        {-0x1.1848e3aaeb6a2p-2, -0x1.1848e3aaeb6a2p-1, -0x1.94e6957e4b05dp-1}}},
      {&five,
       {{0x1.01677d2a25273p+21, 0x1.5734bc38318d5p+20, -0x1.8d01fab07530fp+21},
        {-0x1.05d96011b663fp-1, -0x1.5d21d56cf32fep-2, 0x1.93dd0dd573eabp-1}}},
      {&wedged,
       {{0x1.ce73513fe872ap+19, -0x1.1cbff4d305f4ep+22, 0x1.21c5a1e1dc9c5p+20},
        {-0x1.8b58669fb7d0fp-3, 0x1.e6dc68a5795bbp-1, -0x1.ef729a1b5b54fp-3}}},
      {&wedged,
       {{0x1.cd3a1b72e4d54p+20, -0x1.ec83e90f4117fp+21, -0x1.f5bbf95e31619p+20},
        {-0x1.8a4c94240c4f8p-2, 0x1.a50c2b54a5f3ap-1, 0x1.acedd279d289ap-2}}},
      {&pointed,
       {{0x1.db6c0c92958ccp+20, -0x1.7d8a0023f4e94p+21, 0x1.19960ed22e021p+20},
        {-0x1.025e51a5579cap-1, 0x1.9eb1fcf3393c6p-1, -0x1.320e5eb262953p-2}}},
      {&pointed,
       {{0x1.cf47530e1c728p+19, 0x1.44cc24ccb7fa5p+21, 0x1.40ed275f9d295p+21},
        {-0x1.f789c744847abp-3, -0x1.6105d20b6428ap-1, -0x1.5cd0af765629p-1}}},
  };
  for (const auto& [body, line] : cases) EXPECT_EQ(body->all_hits(line).size() % 2, 0u);
}

// A line through a pole meets cells on several sides of it; far off the origin they see it at different places.
TEST(LineIntersections, APoleFarOffTheOriginIsOneCrossing) {
  const Vec3 center(2345.6, -2736.5, 1563.7);
  std::vector<Vec3> points{{0, 0, -1}, {0.9, 0, -1}, {0.1, 0, 0.1}, {1.2, 0, 0.6}, {0, 0, 1}};
  for (Vec3& p : points) p += center;
  const LineIntersector spindle(
      std::make_shared<RevolutionSurface>(std::make_shared<NurbsCurve>(bezier_curve(points)), Axis{center, {0, 0, 1}}));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < tests::tier_count(100000); ++k) {
    const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    const double off = std::pow(10, -15 + 6 * unit(random));
    const Vec3 through = points[0] + off * Vec3(normal(random), normal(random), 0);
    const std::vector<SurfaceHit> hits = spindle.all_hits({through - 2 * unit(random) * d, d});
    EXPECT_EQ(hits.size() % 2, 0u) << k;
    for (size_t i = 1; i < hits.size(); ++i) EXPECT_GT(hits[i].t - hits[i - 1].t, 1e-9) << k;
  }
}

// The two sides of a torus by formulas do not quite close where v = pi, which no double is: between them lies a strip
// of 2e-16. Lines in its plane meet the circle there twice, however near to a tangent, or pass it.
TEST(LineIntersections, LinesInThePlaneOfASeamStayEven) {
  const LineIntersector torus(std::make_shared<FormulaSurface>(
      point_formulas({"(2 + 0.7*cos(v))*cos(u)", "(2 + 0.7*cos(v))*sin(u)", "0.7*sin(v)"}, {"u", "v"}),
      Rectangle{{0, kTwoPi}, {-kPi, kPi}}, FormulaSurface::Closed{true, true}));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < tests::tier_count(100000); ++k) {
    const double a = kTwoPi * unit(random), off = std::pow(10, -1 - 8 * unit(random));
    const bool inside = unit(random) < 0.5;
    const Vec3 across(std::cos(a), std::sin(a), 0), d(-std::sin(a), std::cos(a), 0);
    const Vec3 through = (1.3 + (inside ? -off : off)) * across;
    EXPECT_EQ(torus.all_hits({through - 5.0 * d, d}).size(), inside ? 4u : 2u) << k << " " << off;
  }
}

// Boxes are kept in steps of their piece: they hold their part of the surface, and hardly more.
// A band of half turns in its own plane: at v = pi all its width is one point, about which parts of cells are never
// small beside their points. A point at the angle v lies on it where |u| = |r - 1|/|cos v/2| is within its width.
TEST(LineIntersections, AFlatBandThatShrinksToAPoint) {
  const LineIntersector band(std::make_shared<FormulaSurface>(
      point_formulas({"(1+u*cos(v/2))*cos(v)", "(1+u*cos(v/2))*sin(v)", "0"}, {"u", "v"}, Coordinates::cartesian),
      Rectangle{{-0.35, 0.35}, {0, kTwoPi}}, FormulaSurface::Closed{}));
  for (int k = 1; k < 40; ++k) {
    const double v = kTwoPi * k / 40 + 0.01;
    for (const double share : {-1.1, -0.9, -0.3, 0.4, 0.95, 1.05}) {
      const double r = 1 + 0.35 * share * std::cos(v / 2);
      const auto hits = band.all_hits({{r * std::cos(v), r * std::sin(v), 1}, {0, 0, -1}});
      EXPECT_EQ(hits.size(), std::abs(share) < 1 ? 1u : 0u) << v << " " << share;
    }
  }
}

// A disc, also through the pole in its middle: no place of it is a hit of its own.
TEST(LineIntersections, NoneInThePlaneOfAFlatPatch) {
  const auto radius = std::make_shared<NurbsCurve>(bezier_curve(std::array{Vec3(0), Vec3(1, 0, 0)}));
  const LineIntersector disc(std::make_shared<RevolutionSurface>(radius, Axis{Vec3(0), Vec3(0, 0, 1)}));
  for (const double x : {0.0, 0.3, -0.7}) EXPECT_TRUE(disc.all_hits({{x, -10, 0}, {0, 1, 0}}).empty()) << x;
  EXPECT_EQ(disc.all_hits({{0.3, -10, 1e-3}, {0, 1, -1e-4}}).size(), 1u);
}

// The sectors at a pole are never flat: cells must not be spent there.
TEST(LineIntersections, CellsAtAPoleAreFew) {
  const FormulaSurface cap(point_formulas({"u*cos(v)", "u*sin(v)", "0.3*cos(2*u)"}, {"u", "v"}, Coordinates::cartesian),
                           {{0, 1}, {0, 1.5}}, {});
  ASSERT_TRUE(cap.degenerate_edges().u_min);
  EXPECT_LT(make_line_target(std::make_shared<FormulaSurface>(cap))->piece_count(), 1000);
}

TEST(LineIntersections, BoxesHoldTheirPieces) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double away : {0.0, 1e3}) {
    const Frame frame = frame_from(Vec3(away, 0.2, -away), {0.2, -0.3, 0.9}, {1, 0.1, 0});
    const auto torus = std::make_shared<NurbsSurface>(*TorusSurface(frame, 3, 1).as_nurbs());
    const auto target = make_line_target(torus);
    Box3 all;
    for (int i = 0; i < target->piece_count(); ++i) all.include(target->piece_bounds(i));
    const Box3 box = bounds(*torus);
    const double size = box.diameter();
    EXPECT_LT(glm::length(glm::max(Vec3(0), glm::max(box.lo - all.lo, all.hi - box.hi))), 1e-4 * size);
    for (int k = 0; k < tests::tier_count(10000); ++k) {
      const Rectangle domain = torus->domain();
      const Vec3 p =
          torus->point(domain.u.lo + unit(random) * domain.u.width(), domain.v.lo + unit(random) * domain.v.width());
      bool held = false;
      for (int i = 0; i < target->piece_count() && !held; ++i) {
        const Box3 piece = target->piece_bounds(i).inflated(1e-14 * (size + away));
        held = glm::all(glm::lessThanEqual(piece.lo, p)) && glm::all(glm::lessThanEqual(p, piece.hi));
      }
      EXPECT_TRUE(held) << k;
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::line_intersections_test
