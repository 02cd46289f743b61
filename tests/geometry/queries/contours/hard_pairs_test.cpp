// Pairs of surfaces that are hard to intersect, with what is known of them: small loops, contacts, gaps of rounding's
// size, crossings, seams, poles, uneven weights, surfaces that touch along a curve or coincide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "support/tier.h"

namespace lekalo::geometry::hard_pairs_test {
namespace {

constexpr double kUnknown = -1;

// What is true of a pair.
struct Truth {
  int loops = 0, open = 0;   // branches
  int contacts = 0;          // isolated
  int crossings = 0;         // points where branches cross
  double length = kUnknown;  // of all branches
  ContourKind kind = ContourKind::crossing;
  bool coincident = false;
  double precision = 1e-9;  // of the length
  // Asked too much of the search: it must say that something is left out. Closed forms may know.
  bool search_gives_up = false;
  bool takes_seconds = false;  // the search
};

struct HardPair {
  const char* name;
  std::function<SurfacePtr()> a, b;
  Truth truth;
};

Frame at(const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  return frame;
}
using Made = std::function<SurfacePtr()>;
Made sphere(const Vec3& center, double radius) {
  return [=] { return std::make_shared<SphereSurface>(at(center), radius); };
}
Made sphere_about(const Frame& frame, double radius) {
  return [=] { return std::make_shared<SphereSurface>(frame, radius); };
}
Made cylinder(const Frame& frame, double radius, double height) {
  return [=] { return std::make_shared<CylinderSurface>(frame, radius, height); };
}
Made cone(const Frame& frame, double radius, double top, double height) {
  return [=] { return std::make_shared<ConeSurface>(frame, radius, top, height); };
}
Made torus(const Frame& frame, double major, double minor) {
  return [=] { return std::make_shared<TorusSurface>(frame, major, minor); };
}
Made torus(double major, double minor) { return torus(Frame(), major, minor); }
// The rectangle [-w, w] x [-h, h] about a point.
Made plate(const Vec3& origin, const Vec3& normal, double w, double h) {
  return [=] {
    const Vec3 n = glm::normalize(normal);
    return std::make_shared<Plane>(frame_about(origin, n), Rectangle{{-w, w}, {-h, h}});
  };
}
// z = f(x, y) over [-1, 1]^2 as a Bezier patch: f of degree 3 in each, from its values at 4 x 4 places by x and y.
Made graph(const std::function<double(double, double)>& f) {
  return [=] {
    // Bernstein coefficients of a cubic from its values at 0, 1/3, 2/3, 1.
    const double inverse[4][4] = {
        {1, 0, 0, 0}, {-5.0 / 6, 3, -1.5, 1.0 / 3}, {1.0 / 3, -1.5, 3, -5.0 / 6}, {0, 0, 0, 1}};
    NurbsSurfaceForm form;
    form.degree_u = form.degree_v = 3;
    form.knots_u = form.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        double z = 0;
        for (int k = 0; k < 4; ++k)
          for (int l = 0; l < 4; ++l) z += inverse[i][k] * inverse[j][l] * f(2 * k / 3.0 - 1, 2 * l / 3.0 - 1);
        form.points.push_back(Vec4(2 * i / 3.0 - 1, 2 * j / 3.0 - 1, z, 1));
      }
    return std::make_shared<NurbsSurface>(form);
  };
}
// The same points with other parameters: rational of degree 1 in them, weights from 1 to `most` along u and v.
Made uneven(const Made& of, double most) {
  return [=]() -> SurfacePtr {
    NurbsSurfaceForm form = *of()->as_nurbs();
    const int rows = form.degree_u + 1, columns = form.degree_v + 1;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j)
        form.points[i * columns + j] *=
            std::pow(most, static_cast<double>(i) / form.degree_u - static_cast<double>(j) / form.degree_v);
    return std::make_shared<NurbsSurface>(form);
  };
}
SurfacePtr as_spline(const SurfacePtr& surface) {
  const auto form = surface->as_nurbs();
  return form ? std::make_shared<NurbsSurface>(*form) : surface;
}
// Turned and moved, so that no coordinate of a special place is a round number.
SurfacePtr turned(const SurfacePtr& surface) {
  const Frame to = frame_from({0.31, -0.74, 1.3}, glm::normalize(Vec3(0.3, 0.5, 0.7)), {0.9, -0.2, 0.1});
  NurbsSurfaceForm form = surface->as_nurbs().value();
  for (Vec4& p : form.points) {
    const Vec3 moved = p.x * to.x + p.y * to.y + p.z * to.z + p.w * to.origin;
    p = Vec4(moved.x, moved.y, moved.z, p.w);
  }
  return std::make_shared<NurbsSurface>(form);
}
Frame along_x(const Vec3& origin = {-3, 0, 0}) { return frame_from(origin, {1, 0, 0}, {0, 1, 0}); }
// The radius of the circle in which two unit spheres meet that overlap by d.
double lens(double d) { return std::sqrt(d - d * d / 4); }

const Vec3 kSlant(0.6, 0.48, 0.64);  // a unit vector
constexpr ContourKind kTouching = ContourKind::touching, kBorder = ContourKind::border;

std::vector<HardPair> pairs() {
  const double s = 1e-3;
  const auto bump = [](double x, double y) { return 0.5 - 0.3 * x * x - 0.2 * y * y; };
  return {
      // Loops of a thousandth of the size and smaller.
      {"lens_1e-3", sphere({0, 0, 0}, 1), sphere((2 - 1e-6) * kSlant, 1), {.loops = 1, .length = kTwoPi * lens(1e-6)}},
      {"lens_1e-4", sphere({0, 0, 0}, 1), sphere((2 - 1e-8) * kSlant, 1), {.loops = 1, .length = kTwoPi * lens(1e-8)}},
      {"lens_at_poles", sphere({0, 0, 0}, 1), sphere({0, 0, 2 - 1e-6}, 1), {.loops = 1, .length = kTwoPi * lens(1e-6)}},
      {"lens_at_seams", sphere({0, 0, 0}, 1), sphere({2 - 1e-6, 0, 0}, 1), {.loops = 1, .length = kTwoPi * lens(1e-6)}},
      {"two_circles_on_a_torus",
       torus(3, 1),
       plate({0, 0, 1 - 5e-7}, {0, 0, 1}, 5, 5),
       {.loops = 2, .length = 12 * kPi, .search_gives_up = true, .takes_seconds = true}},
      {"cap_of_a_torus", torus(3, 1), plate({4 - 1e-6, 0, 0}, {1, 0, 0}, 3, 3), {.loops = 1}},
      {"bead_on_a_cylinder", cylinder(Frame(), 1, 2), sphere({0.6, 0.8, 1.1}, s), {.loops = 1}},
      {"bead_on_a_seam", cylinder(Frame(), 1, 2), sphere({1, 0, 1.1}, s), {.loops = 1}},
      {"bead_on_both_seams", torus(3, 1), sphere({4, 0, 0}, 10 * s), {.loops = 1}},
      {"bead_on_a_pole",
       sphere({0, 0, 0}, 1),
       sphere({0, 0, 1}, s),
       {.loops = 1, .length = kTwoPi * s * std::sqrt(1 - 0.25e-6)}},
      {"bead_on_a_tip",
       cone(Frame(), 1, 0, 1),
       sphere({0, 0, 1}, s),
       {.loops = 1, .length = kTwoPi * s * std::sqrt(0.5)}},
      {"small_ring_through_a_plate",
       torus(s, 0.3 * s),
       plate({0, 0, 0}, {1, 2, 0}, 1, 1),
       {.loops = 2, .length = 4 * kPi * 0.3 * s}},
      {"bump_through_a_plate", graph(bump), plate({0, 0, 0.5 - 3e-7}, {0, 0, 1}, 2, 2), {.loops = 1}},
      // Isolated contacts.
      {"spheres", sphere({0, 0, 0}, 1), sphere(2.0 * kSlant, 1), {.contacts = 1}},
      {"spheres_at_poles", sphere({0, 0, 0}, 1), sphere({0, 0, 2}, 1), {.contacts = 1}},
      {"spheres_at_seams", sphere({0, 0, 0}, 1), sphere({2, 0, 0}, 1), {.contacts = 1}},
      {"sphere_in_sphere", sphere({0, 0, 0}, 1), sphere(0.5 * kSlant, 0.5), {.contacts = 1}},
      {"sphere_on_a_plate", sphere(kSlant, 1), plate({0, 0, 0}, kSlant, 2, 2), {.contacts = 1}},
      {"sphere_beside_a_cylinder", cylinder(Frame(), 1, 2), sphere({0.9, 1.2, 0.7}, 0.5), {.contacts = 1}},
      {"crossed_cylinders", cylinder(at({0, 0, -3}), 1, 6), cylinder(along_x({-3, 1.5, 0}), 0.5, 6), {.contacts = 1}},
      {"sphere_beside_a_torus", torus(3, 1), sphere({2.7, 3.6, 0}, 0.5), {.contacts = 1}},
      {"sphere_inside_a_torus", torus(3, 1), sphere({3.5, 0, 0}, 0.5), {.contacts = 1}},
      {"sphere_on_a_cone", cone(Frame(), 1, 0, 1), sphere({0.9, 0, 0.7}, 0.3 * std::sqrt(2)), {.contacts = 1}},
      {"plate_on_a_torus", torus(3, 1), plate({4, 0, 0}, {1, 0, 0}, 3, 3), {.contacts = 1}},
      {"plate_on_a_bump", graph(bump), plate({0, 0, 0.5}, {0, 0, 1}, 2, 2), {.contacts = 1}},
      // Nearly in contact, on either side.
      {"gap_1e-6", sphere({0, 0, 0}, 1), sphere((2 + 1e-6) * kSlant, 1), {}},
      {"gap_1e-8", sphere({0, 0, 0}, 1), sphere((2 + 4e-8) * kSlant, 1), {}},
      {"cylinders_apart_1e-6", cylinder(at({0, 0, -3}), 1, 6), cylinder(along_x({-3, 1.5 + 1e-6, 0}), 0.5, 6), {}},
      {"cylinders_in_1e-6",
       cylinder(at({0, 0, -3}), 1, 6),
       cylinder(along_x({-3, 1.5 - 1e-6, 0}), 0.5, 6),
       {.loops = 1}},
      {"plate_off_a_torus_1e-6", torus(3, 1), plate({4 + 1e-6, 0, 0}, {1, 0, 0}, 3, 3), {}},
      {"plate_off_a_saddle_1e-6", torus(3, 1), plate({2 + 1e-6, 0, 0}, {1, 0, 0}, 5, 3), {.loops = 1}},
      {"plate_beyond_a_saddle_1e-6", torus(3, 1), plate({2 - 1e-6, 0, 0}, {1, 0, 0}, 5, 3), {.loops = 2}},
      {"cylinder_in_cylinder", cylinder(at({0, 0, -3}), 1 - 1e-6, 6), cylinder(along_x(), 1, 6), {.loops = 2}},
      // Branches that cross.
      {"viviani",
       sphere({0, 0, 0}, 2),
       cylinder(at({1, 0, -3}), 1, 6),
       {.loops = 1, .crossings = 1, .length = 2 * 7.64039557805542404}},
      {"equal_cylinders",
       cylinder(at({0, 0, -3}), 1, 6),
       cylinder(along_x(), 1, 6),
       {.loops = 2, .crossings = 2, .length = 2 * 7.640395578055424}},
      {"plate_on_a_saddle", torus(3, 1), plate({2, 0, 0}, {1, 0, 0}, 5, 3), {.loops = 1, .crossings = 1}},
      {"villarceau",
       torus(3, 1),
       plate({0, 0, 0}, {0, -1.0 / 3, std::sqrt(8.0) / 3}, 5, 5),
       {.loops = 2, .crossings = 2, .length = 12 * kPi}},
      {"cone_through_its_tip",
       cone(at({0, 0, -1}), 1, -1, 2),
       plate({0, 0, 0}, {1, 0.3, 0}, 2, 2),
       {.open = 2, .crossings = 1, .length = 4 * std::sqrt(2)}},
      {"saddle",
       graph([](double x, double y) { return x * y; }),
       plate({0, 0, 0}, {0, 0, 1}, 2, 2),
       {.open = 2, .crossings = 1, .length = 4}},
      {"monkey_saddle",
       graph([](double x, double y) { return x * x * x - 3 * x * y * y; }),
       plate({0, 0, 0}, {0, 0, 1}, 2, 2),
       {.open = 3, .crossings = 1, .length = 2 + 4 * std::sqrt(4.0 / 3), .precision = 1e-6}},
      {"ball_in_two_saddles", torus(3, 1), sphere({3.5, 0, 0}, 1.5), {.loops = 1, .crossings = 1}},
      // Seams, poles and tips.
      {"circle_through_poles", sphere({0, 0, 0}, 1), sphere({0, 1, 0}, std::sqrt(2)), {.loops = 1, .length = kTwoPi}},
      {"circle_along_a_seam", sphere({0, 0, 0}, 1), plate({0, 0, 0}, {0, 1, 0}, 2, 2), {.loops = 1, .length = kTwoPi}},
      {"plate_through_poles",
       sphere({0, 0, 0}, 1),
       plate({0, 0, 0}, {1, 0.7, 0}, 2, 2),
       {.loops = 1, .length = kTwoPi}},
      {"sphere_about_a_tip",
       cone(Frame(), 1, 0, 1),
       sphere({0, 0, 1}, 0.5),
       {.loops = 1, .length = kPi * std::sqrt(0.5)}},
      {"pole_in_a_cylinder", cylinder(at({0, 0, -2}), 0.5, 4), sphere({0, 0, 0}, 1), {.loops = 2, .length = 2 * kPi}},
      {"pole_on_a_cylinder",
       cylinder(at({0.5, 0, -2}), 0.5, 4),
       sphere_about(frame_from({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1),
       {.loops = 1, .crossings = 1, .length = 7.64039557805542404}},
      {"equator_on_a_seam", torus(3, 1), plate({0, 0, 0}, {0, 0, 1}, 5, 5), {.loops = 2, .length = 12 * kPi}},
      {"torus_through_its_axis", torus(3, 1), plate({0, 0, 0}, {0, 1, 0}, 5, 5), {.loops = 2, .length = 4 * kPi}},
      // Uneven weights: the same sets of points.
      {"uneven_1e3", uneven(graph(bump), 1e3), plate({0, 0, 0.4}, {0, 0, 1}, 2, 2), {.loops = 1}},
      {"uneven_1e-3", uneven(graph(bump), 1e-3), sphere({0, 0, 0.5}, 0.3), {.loops = 1}},
      {"uneven_small_loop", uneven(graph(bump), 1e3), plate({0, 0, 0.5 - 1e-6}, {0, 0, 1}, 2, 2), {.loops = 1}},
      {"uneven_saddle",
       uneven(graph([](double x, double y) { return x * y; }), 1e3),
       plate({0, 0, 0}, {0, 0, 1}, 2, 2),
       {.open = 2, .crossings = 1, .length = 4}},
      // Nearly coincident.
      {"plates_1e-6", plate({0, 0, 0}, {0, 0, 1}, 1, 1), plate({0, 0, 1e-6}, {0, 0, 1}, 1, 1), {}},
      {"plates_at_an_angle_1e-6",
       plate({0, 0, 0}, {0, 0, 1}, 1, 1),
       plate({0, 0, 0}, {1e-6, 0, 1}, 1, 1),
       {.open = 1, .length = 2}},
      {"spheres_moved_1e-6",
       sphere({0, 0, 0}, 1),
       sphere(1e-6 * kSlant, 1),
       {.loops = 1, .length = kTwoPi, .search_gives_up = true, .takes_seconds = true}},
      {"cylinder_around_1e-6", cylinder(Frame(), 1, 2), cylinder(Frame(), 1 + 1e-6, 2), {.search_gives_up = true}},
      // Touching along curves.
      {"ball_in_a_tube",
       cylinder(at({0, 0, -2}), 1, 4),
       sphere({0, 0, 0.1234}, 1),
       {.loops = 1, .length = kTwoPi, .kind = kTouching}},
      {"ball_in_a_cone",
       cone(Frame(), 2, 0, 2),
       sphere({0, 0, 0}, std::sqrt(2)),
       {.loops = 1, .length = kTwoPi, .kind = kTouching}},
      {"plate_on_a_ring",
       torus(3, 1),
       plate({0, 0, 1}, {0, 0, 1}, 5, 4),
       {.loops = 1, .length = 6 * kPi, .kind = kTouching}},
      {"ball_about_a_ring",
       torus(2, 1.5),
       sphere({0, 0, 0}, 3.5),
       {.loops = 1, .length = 7 * kPi, .kind = kTouching, .takes_seconds = true}},
      {"ball_in_a_hole",
       torus(3, 1),
       sphere({0, 0, 0}, 2),
       {.loops = 1, .length = 4 * kPi, .kind = kTouching, .takes_seconds = true}},
      {"ball_fills_a_ring",
       torus(3, 1),
       sphere({3, 0, 0}, 1),
       {.loops = 1, .length = kTwoPi, .kind = kTouching, .takes_seconds = true}},
      {"parallel_cylinders",
       cylinder(Frame(), 1, 4),
       cylinder(at({3, 0, 0.5}), 2, 3),
       {.open = 1, .length = 3, .kind = kTouching}},
      {"plate_on_a_cylinder",
       cylinder(at({0, 0, -1}), 1, 2),
       plate({0, 1, 0}, {0, 1, 0}, 3, 3),
       {.open = 1, .length = 2, .kind = kTouching}},
      {"plates_with_a_common_edge",
       plate({0, 0, 0}, {0, 0, 1}, 1, 1),
       plate({0, 2, 0}, {0, 0, 1}, 1, 1),
       {.open = 1, .length = 2, .kind = kTouching}},
      // Coincident.
      {"plates",
       plate({0, 0, 0}, {0, 0, 1}, 1, 1),
       plate({0, 0.5, 0}, {0, 0, 1}, 3, 1),
       {.loops = 1, .length = 7, .kind = kBorder, .coincident = true}},
      {"sleeves",
       cylinder(Frame(), 1, 4),
       cylinder(at({0, 0, 2}), 1, 3),
       {.loops = 2, .length = 4 * kPi, .kind = kBorder, .coincident = true}},
      {"equal_spheres", sphere({0, 0, 0}, 1), sphere({0, 0, 0}, 1), {.coincident = true, .takes_seconds = true}},
  };
}

void check(const HardPair& pair, const SurfacePtr& a, const SurfacePtr& b) {
  const Contours found = intersect(a, b);
  const Truth& truth = pair.truth;
  if (truth.search_gives_up && !found.closed_form) {
    EXPECT_FALSE(found.complete);
    return;
  }
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.coincident, truth.coincident);
  int loops = 0, contacts = 0, crossings = 0, others = 0;
  double length = 0;
  Box3 all = bounds(*a);
  all.include(bounds(*b));
  const double size = all.diameter();
  for (const Contour& one : found.branches) {
    loops += one.closed;
    length += contour_length(one).value;
    EXPECT_EQ(one.kind, truth.kind);
    const Interval t = one.curve->domain();
    for (int k = 0; k < 30; ++k) {
      const double place = t.lo + t.width() * (k + 0.4) / 30;
      const Vec3 p = one.curve->point(place), on_a = one.images[0]->point(place), on_b = one.images[1]->point(place);
      EXPECT_LT(glm::length(a->point(on_a.x, on_a.y) - p), 1e-13 * size);
      EXPECT_LT(glm::length(b->point(on_b.x, on_b.y) - p), 1e-13 * size);
    }
  }
  for (const ContourPoint& point : found.points)
    ++(point.kind == ContourPointKind::contact    ? contacts
       : point.kind == ContourPointKind::crossing ? crossings
                                                  : others);
  EXPECT_EQ(loops, truth.loops);
  EXPECT_EQ(static_cast<int>(found.branches.size()) - loops, truth.open);
  EXPECT_EQ(contacts, truth.contacts);
  EXPECT_EQ(crossings, truth.crossings);
  EXPECT_EQ(others, 0);
  if (truth.length != kUnknown) {
    // Rounding of the places of surfaces that barely meet moves a small loop's size.
    EXPECT_NEAR(length, truth.length, truth.precision * truth.length + 2e-11);
  }
}

enum class Way { as_given, swapped, as_splines };

// Of `all` the small tier takes one in so many, and none that takes seconds.
void check_all(Way way, size_t one_in) {
  const std::vector<HardPair> all = pairs();
  int checked = 0;
  for (size_t k = 0; k < all.size(); ++k) {
    const HardPair& pair = all[k];
    if (!tests::is_full_tier() && (pair.truth.takes_seconds || k % one_in != 0)) continue;
    SCOPED_TRACE(pair.name);
    ++checked;
    if (way == Way::as_given) check(pair, pair.a(), pair.b());
    if (way == Way::swapped) check(pair, pair.b(), pair.a());
    if (way == Way::as_splines) check(pair, as_spline(pair.a()), as_spline(pair.b()));
  }
  tests::report_figure("pairs", checked);
}

TEST(HardPairs, AreIntersected) { check_all(Way::as_given, 1); }
TEST(HardPairs, TheOtherWayRound) { check_all(Way::swapped, 5); }
TEST(HardPairs, AsRationalSplines) { check_all(Way::as_splines, 5); }

// Rounding breaks up what is special about a pair: the answer is right all the same, or says that it is incomplete. The
// small tier takes those whose branches cross.
TEST(HardPairs, TurnedAreRightOrIncomplete) {
  int checked = 0, incomplete = 0;
  for (const HardPair& pair : pairs()) {
    const Truth& truth = pair.truth;
    if (!tests::is_full_tier() && (truth.takes_seconds || truth.crossings == 0)) continue;
    SCOPED_TRACE(pair.name);
    const Contours found = intersect(turned(pair.a()), turned(pair.b()));
    ++checked;
    incomplete += !found.complete;
    if (!found.complete) continue;
    const auto loops =
        std::count_if(found.branches.begin(), found.branches.end(), [](const auto& c) { return c.closed; });
    const auto points = [&](ContourPointKind kind) {
      return std::count_if(found.points.begin(), found.points.end(), [&](const auto& p) { return p.kind == kind; });
    };
    EXPECT_EQ(loops, truth.loops);
    EXPECT_EQ(static_cast<int>(found.branches.size()) - loops, truth.open);
    EXPECT_EQ(points(ContourPointKind::contact), truth.contacts);
    EXPECT_EQ(points(ContourPointKind::crossing), truth.crossings);
    EXPECT_EQ(points(ContourPointKind::end), 0);
    EXPECT_EQ(found.coincident, truth.coincident);
  }
  tests::report_figure("pairs", checked);
  tests::report_figure("incomplete", incomplete);
}

}  // namespace
}  // namespace lekalo::geometry::hard_pairs_test
