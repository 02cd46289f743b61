// Lines on tubes against closed forms, against distances from the curve by dense search, and counted where random
// planes cross them.
#include "geometry/shapes/tube/tube_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "support/curve_places.h"
#include "support/tier.h"

namespace lekalo::geometry::tube_lines_test {
namespace {

const ViewOf kView{false, {0.3, 0.5, -1}};

CurvePtr formula_curve(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}), domain, closed);
}
CurvePtr trefoil() {
  return formula_curve({"sin(t) + 2*sin(2*t)", "cos(t) - 2*cos(2*t)", "-sin(3*t)"}, {0, kTwoPi}, true);
}

double length_of(const ShapeOutlines& found) {
  EXPECT_TRUE(found.complete);
  double length = 0;
  for (const ShapeOutline& line : found.lines) {
    EXPECT_TRUE(line.edge);
    const Interval t = line.curve->domain();
    length += arc_length(*line.curve, t.lo, t.hi).value;
  }
  return length;
}

// The least distances of a point from a curve, each the least about it, in order: by places and thirds.
std::vector<double> distances(const Curve& curve, const Vec3& p) {
  constexpr int kPlaces = 2000, kSteps = 90;
  const Interval domain = curve.domain();
  const auto distance = [&](double t) {
    if (curve.is_closed()) t -= domain.width() * std::floor((t - domain.lo) / domain.width());
    return glm::length(p - curve.point(std::clamp(t, domain.lo, next_down(domain.hi))));
  };
  const double step = domain.width() / kPlaces;
  std::vector<double> found;
  for (int k = 0; k < kPlaces + (curve.is_closed() ? 0 : 1); ++k) {
    const double t = domain.lo + step * k, here = distance(t);
    const bool first = !curve.is_closed() && k == 0, last = !curve.is_closed() && k == kPlaces;
    if ((!first && distance(t - step) < here) || (!last && distance(t + step) <= here)) continue;
    double lo = first ? t : t - step, hi = last ? t : t + step;
    for (int i = 0; i < kSteps; ++i) {
      const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
      (distance(a) < distance(b) ? hi : lo) = distance(a) < distance(b) ? b : a;
    }
    found.push_back(distance(0.5 * (lo + hi)));
  }
  std::sort(found.begin(), found.end());
  return found;
}

template <class Visit>
void each_point(const ShapeOutlines& found, int places, const Visit& visit) {
  for (const ShapeOutline& line : found.lines) {
    const Interval t = line.curve->domain();
    for (int k = 0; k <= places; ++k)
      visit(line.curve->point(t.lo + t.width() * k / places), line, t.lo + t.width() * k / places);
  }
}

ShapeOutlines intersection_of(const Tube& tube, const SurfacePtr& surface) {
  return TubeBoundary(tube).intersection(surface, kView);
}

TEST(TubeLines, ClosedForms) {
  const Tube ring(formula_curve({"3*cos(t)", "3*sin(t)", "0"}, {0, kTwoPi}, true), RadiusLaw(1), Caps::round);
  const TubeBoundary of_ring(ring);
  Frame frame;
  // Cylinders and balls about the axis of a ring: circles.
  for (const double r : {2.5, 3.0, 3.7})
    EXPECT_NEAR(length_of(of_ring.intersection(
                    std::make_shared<CylinderSurface>(frame_from({0, 0, -2}, {0, 0, 1}, {1, 0, 0}), r, 4), kView)),
                2 * kTwoPi * r, 1e-9);
  // p^2 = 9 + 1 + 6 cos a for the angle a about the ring.
  const double cosine = (3.3 * 3.3 - 10) / 6;
  EXPECT_NEAR(length_of(of_ring.intersection(std::make_shared<SphereSurface>(frame, 3.3), kView)),
              2 * kTwoPi * (3 + cosine), 1e-9);
  EXPECT_TRUE(of_ring.edges(kView).lines.lines.empty());
  // A rod and a ball on its axis, a thicker rod with flat ends.
  const CurvePtr axis = std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, -2}, {0, 0, 2}}));
  const SurfacePtr ball = std::make_shared<SphereSurface>(frame, 1);
  EXPECT_NEAR(length_of(intersection_of(Tube(axis, RadiusLaw(0.6), Caps::round), ball)), 2 * kTwoPi * 0.6, 1e-10);
  const CurvePtr half = std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, -2}, {0, 0, 0.28}}));
  EXPECT_NEAR(length_of(intersection_of(Tube(half, RadiusLaw(1.5), Caps::flat), ball)), kTwoPi * 0.96, 1e-10);
  EXPECT_NEAR(length_of(intersection_of(Tube(half, RadiusLaw(1.5), Caps::none), ball)), 0, 0);
}

// All points are as far from the curve as the radius says, and on the other surface.
TEST(TubeLines, PointsAreOnBoth) {
  const CurvePtr helix = formula_curve({"cos(t)", "sin(t)", "0.08*t"}, {0, 12.5}), knot = trefoil();
  const Vec3 center(0.9, 0.2, 0.5);
  Frame frame;
  frame.origin = center;
  for (const auto& [curve, R] : {std::pair(helix, 0.3), std::pair(knot, 0.7)}) {
    const Tube tube(curve, RadiusLaw(R), Caps::round);
    const TubeBoundary boundary(tube);
    const double same = 1e-9 * tube.bounds().diameter();
    const SurfacePtr sphere = std::make_shared<SphereSurface>(frame, 1.1);
    const ShapeOutlines on_sphere = boundary.intersection(sphere, kView);
    EXPECT_TRUE(on_sphere.complete);
    EXPECT_GE(on_sphere.lines.size(), 2u);
    each_point(on_sphere, 7, [&](const Vec3& p, const ShapeOutline& line, double t) {
      EXPECT_NEAR(distances(*curve, p)[0], R, same);
      EXPECT_NEAR(glm::length(p - center), 1.1, same);
      const Vec3 uv = line.image->point(t);
      EXPECT_NEAR(glm::length(sphere->point(uv.x, uv.y) - p), 0, same);
    });
    const Affine map =
        Affine::translation({0.6, 0.3, 0.2}) * Affine::rotation(0.4, {1, 0, 0}) * Affine::scaling({1.1, 1, 0.9});
    const ShapeOutlines on_both = boundary.intersection(boundary, map, kView);
    EXPECT_TRUE(on_both.complete);
    EXPECT_GE(on_both.lines.size(), 2u);
    each_point(on_both, 4, [&](const Vec3& p, const ShapeOutline&, double) {
      EXPECT_NEAR(distances(*curve, p)[0], R, same);
      EXPECT_NEAR(distances(*curve, map.inverse().point(p))[0], R, same);
    });
  }
  for (const auto& [curve, R] : {std::pair(helix, 0.3), std::pair(knot, 0.9)}) {
    const Tube tube(curve, RadiusLaw(R), Caps::round);
    const ShapeOutlines edges = TubeBoundary(tube).edges(kView).lines;
    EXPECT_TRUE(edges.complete);
    EXPECT_GE(edges.lines.size(), 3u);
    each_point(edges, 5, [&](const Vec3& p, const ShapeOutline&, double) {
      const std::vector<double> from = distances(*curve, p);
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(from[k], R, 1e-9 * tube.bounds().diameter());
    });
  }
}

// A bar that ends flat in a bar across it, both of radius 1/2: two sides of a rectangle on the end, and of the walls
// two arcs of the ellipses x = +-y.
TEST(TubeLines, EndsInItself) {
  const CurvePtr curve = std::make_shared<NurbsCurve>(
      polyline(std::vector<Vec3>{{-2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0.3, 0}}));
  const Tube tube(curve, RadiusLaw(0.5), Caps::flat);
  double arcs = 0;
  constexpr int kPlaces = 100000;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = std::asin(0.8) * (2 * (k + 0.5) / kPlaces - 1);
    arcs += 2 * std::asin(0.8) / kPlaces * std::sqrt(1 + sqr(std::sin(angle)));
  }
  EXPECT_NEAR(length_of(TubeBoundary(tube).edges(kView).lines), 2 * 0.6 + arcs, 1e-8);
  // What is left of the edge of the end, beside the edge of the other one and the creases of three corners.
  double rims = 0;
  for (const ShapeOutline& line : outlines(tube, kView).lines)
    if (const auto* circle = dynamic_cast<const Circle*>(line.curve.get()); circle && line.edge)
      rims += circle->domain().width() * 0.5;
  EXPECT_NEAR(rims, kTwoPi * 0.5 + 2 * (kPi - 2 * std::asin(0.8)) * 0.5, 1e-5);
}

// About a parabola y = x^2 with R > 1/2 the edge of the bend is y = R^2 + 1/4 - z^2 in the plane x = 0 between the
// places where R^2 = 1/4 + z^2.
TEST(TubeLines, EdgesOfBends) {
  for (const double R : {0.55, 0.7, 0.9}) {
    const Tube tube(formula_curve({"t", "t^2", "0"}, {-1.5, 1.5}), RadiusLaw(R), Caps::round);
    const TubeBoundary::Edges found = TubeBoundary(tube).edges(kView);
    EXPECT_TRUE(found.all_known);
    const double a = 2 * std::sqrt(R * R - 0.25);
    EXPECT_NEAR(length_of(found.lines), 0.5 * (a * std::sqrt(1 + a * a) + std::asinh(a)), 1e-9);
    each_point(found.lines, 20, [&](const Vec3& p, const ShapeOutline&, double) {
      EXPECT_NEAR(p.x, 0, 1e-9);
      EXPECT_NEAR(p.y, R * R + 0.25 - p.z * p.z, 1e-9);
    });
  }
  // Two bends of a closed curve, one of them over its ends; across it each edge goes on as that of two walls.
  const CurvePtr ring = formula_curve({"2*cos(t)", "sin(t)", "0.1*sin(3*t)"}, {0, kTwoPi}, true);
  const Tube tube(ring, RadiusLaw(0.7), Caps::round);
  const TubeBoundary::Edges found = TubeBoundary(tube).edges(kView);
  EXPECT_TRUE(found.all_known && found.lines.complete);
  for (const ShapeOutline& line : found.lines.lines) {
    const Interval t = line.curve->domain();
    for (const double share : {0.15, 0.5, 0.85}) {
      const std::vector<double> from = distances(*ring, line.curve->point(t.lo + share * t.width()));
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(from[k], 0.7, 1e-9);
    }
  }
}

double number(std::mt19937_64& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
Vec3 direction(std::mt19937_64& random) {
  Vec3 d;
  do d = {number(random, -1, 1), number(random, -1, 1), number(random, -1, 1)};
  while (glm::length(d) > 1 || glm::length(d) < 0.1);
  return glm::normalize(d);
}

CurvePtr random_curve(std::mt19937_64& random, int kind) {
  const std::string pitch = std::to_string(number(random, 0.05, 0.3));
  if (kind % 3 == 0) return formula_curve({"cos(t)", "sin(t)", pitch + "*t"}, {0, 9});
  if (kind % 3 == 1) return formula_curve({"sin(2*t)", "cos(t)", pitch + "*sin(3*t)"}, {0, kTwoPi}, true);
  return std::make_shared<NurbsCurve>(polyline(
      std::vector<Vec3>{2.0 * direction(random), direction(random), direction(random), 2.0 * direction(random)}));
}

// How often a plane crosses the lines.
int crossings(const ShapeOutlines& found, const Vec3& origin, const Vec3& normal) {
  constexpr int kPlaces = 3000;
  int count = 0;
  for (const ShapeOutline& line : found.lines) {
    const Interval t = line.curve->domain();
    bool above = false;
    for (int k = 0; k <= kPlaces; ++k) {
      const bool here = glm::dot(line.curve->point(t.lo + t.width() * k / kPlaces) - origin, normal) > 0;
      count += k > 0 && here != above;
      above = here;
    }
  }
  return count;
}

bool bends_more_than(const Curve& curve, double R) {
  constexpr int kPlaces = 2000;
  const Interval domain = curve.domain();
  for (int k = 0; k < kPlaces; ++k) {
    const CurveJet at = curve.evaluate(domain.lo + domain.width() * k / kPlaces, 2);
    const double speed = glm::length(at.d[1]);
    if (R * glm::length(glm::cross(at.d[1], at.d[2])) > 0.99 * speed * speed * speed) return true;
  }
  return false;
}

// The lines in which random tubes meet a ball cross random planes as often as circles on the ball enter and leave the
// balls along the curve.
TEST(TubeLines, NoneIsMissingOnBalls) {
  std::mt19937_64 random(83);
  int wrong = 0, circles = 0, met = 0, incomplete = 0, incomplete_at_bends = 0;
  for (int k = 0; k < tests::tier_count(400, 12); ++k) {
    const CurvePtr curve = random_curve(random, k);
    const double R = number(random, 0.1, 0.4);
    const Tube tube(curve, RadiusLaw(R), Caps::round);
    Frame frame;
    frame.origin = tube.bounds().center() + 0.5 * direction(random);
    const double radius = number(random, 0.3, 1.2);
    const ShapeOutlines found = TubeBoundary(tube).intersection(std::make_shared<SphereSurface>(frame, radius), kView);
    // Where a curve bends more than the radius the search for contours does not always end.
    if (!found.complete) {
      ++(bends_more_than(*curve, R) ? incomplete_at_bends : incomplete);
      continue;
    }
    std::vector<Vec3> centers;
    constexpr int kCenters = 4000;
    const Interval domain = curve->domain();
    for (int i = 0; i <= kCenters; ++i)
      centers.push_back(curve->point(std::min(domain.lo + domain.width() * i / kCenters, next_down(domain.hi))));
    for (int i = 0; i < 6; ++i) {
      const double height = number(random, -0.9, 0.9) * radius, around = std::sqrt(radius * radius - height * height);
      const Frame plane = frame_about(frame.origin, direction(random));
      const Vec3 middle = plane.origin + height * plane.z;
      constexpr int kAngles = 1500;
      std::vector<double> outside;
      for (int a = 0; a < kAngles; ++a) {
        const double angle = kTwoPi * a / kAngles;
        const Vec3 p = middle + around * (std::cos(angle) * plane.x + std::sin(angle) * plane.y);
        double square = kInfinity;
        for (const Vec3& c : centers) square = std::min(square, glm::dot(p - c, p - c));
        outside.push_back(std::sqrt(square) - R);
      }
      int expected = 0;
      bool touches = false;  // between two places it may come and go
      for (int a = 0; a < kAngles; ++a) {
        const double before = outside[(a + kAngles - 1) % kAngles], here = outside[a],
                     next = outside[(a + 1) % kAngles];
        expected += (here > 0) != (before > 0);
        touches = touches || ((here - before) * (next - here) <= 0 && std::abs(here) < 1e-4);
      }
      if (touches) continue;
      ++circles;
      met += expected > 0;
      wrong += crossings(found, middle, plane.z) != expected;
    }
  }
  EXPECT_EQ(wrong, 0) << circles << " circles";
  EXPECT_EQ(incomplete, 0);
  EXPECT_LE(incomplete_at_bends, std::max(1, tests::tier_count(400, 12) / 10));  // 31 of 400
  EXPECT_GT(met, circles / 4);
}

// Where a random plane crosses an edge the plane's section of the tube has a corner.
TEST(TubeLines, EdgesAreCornersOfSections) {
  std::mt19937_64 random(84);
  int wrong = 0, planes = 0, corners = 0, incomplete = 0;
  for (int k = 0; k < tests::tier_count(60, 3); ++k) {
    const bool bends = k % 3 == 2;
    const CurvePtr curve =
        bends ? formula_curve({"2*cos(t)", "sin(t)", std::to_string(number(random, 0, 0.2)) + "*sin(3*t)"}, {0, kTwoPi},
                              true)
              : trefoil();
    const Tube tube(curve, RadiusLaw(bends ? number(random, 0.55, 0.8) : number(random, 0.75, 0.97)), Caps::round);
    const ShapeOutlines found = TubeBoundary(tube).edges(kView).lines;
    if (!found.complete) {
      ++incomplete;
      continue;
    }
    for (int i = 0; i < 20; ++i) {
      const Vec3 normal = direction(random), origin = 1.5 * direction(random);
      const ShapeOutlines section = plane_section(tube, origin, normal, kView);
      if (!section.complete) continue;
      // Ends of the section's lines at which another begins in a different direction.
      struct End {
        Vec3 point, tangent;
      };
      std::vector<End> ends;
      for (const ShapeOutline& line : section.lines)
        for (const double t : {line.curve->domain().lo, line.curve->domain().hi}) {
          const CurveJet at = line.curve->evaluate(t == line.curve->domain().lo ? t : next_down(t), 1);
          ends.push_back({at.d[0], glm::normalize(at.d[1])});
        }
      int expected = 0, joints = 0;
      for (size_t a = 0; a < ends.size(); ++a)
        for (size_t b = a + 1; b < ends.size(); ++b) {
          if (!(glm::length(ends[a].point - ends[b].point) < 1e-4)) continue;
          ++joints;
          expected += glm::length(glm::cross(ends[a].tangent, ends[b].tangent)) > 1e-3;
        }
      // A section with a gap is no witness.
      if (2 * joints != static_cast<int>(ends.size())) continue;
      ++planes;
      corners += expected;
      wrong += crossings(found, origin, normal) != expected;
    }
  }
  EXPECT_EQ(wrong, 0) << planes << " planes";
  EXPECT_EQ(incomplete, 0);
  EXPECT_GT(corners, planes / 2);
}

double distance_of(const ShapeOutlines& found, const Vec3& p) {
  double least = kInfinity;
  for (const ShapeOutline& line : found.lines) least = std::min(least, lekalo::checks::distance_to(*line.curve, p));
  return least;
}

// v of the direction across the curve where it begins.
double angle_at_begin(const Tube& tube, const Vec3& direction) {
  const BallJet ball = tube.sweep().ball(tube.sweep().curve().domain().lo);
  return tube.point({0, tube.sweep().curve().domain().lo, 0, 0, 0}, ball.center[0] + ball.radius[0] * direction).v;
}

TEST(TubeParameterLines, ClosedForms) {
  // Of a ring the lengths of n lines along it, at even angles, have the mean of the curve's.
  const Tube ring(formula_curve({"3*cos(t)", "3*sin(t)", "0"}, {0, kTwoPi}, true), RadiusLaw(1), Caps::round);
  const TubeBoundary of_ring(ring);
  EXPECT_NEAR(length_of(of_ring.parameter_lines({{5, {}}, {}}, kView)), 5 * kTwoPi, 1e-10);
  EXPECT_NEAR(length_of(of_ring.parameter_lines({{}, {4, {}}}, kView)), 4 * kTwoPi * 3, 1e-10);
  // The outer and the inner equator, at listed angles, which may be given anywhere.
  const double outside = angle_at_begin(ring, {1, 0, 0});
  EXPECT_NEAR(length_of(of_ring.parameter_lines({{}, {0, {outside}}}, kView)), kTwoPi * 4, 1e-10);
  EXPECT_NEAR(length_of(of_ring.parameter_lines({{}, {0, {outside - 3 * kPi}}}, kView)), kTwoPi * 2, 1e-10);
  // With flat ends the outermost circles are their edges. A cone's lines are its sides.
  const CurvePtr axis = std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, -2}, {0, 0, 2}}));
  for (const Caps caps : {Caps::flat, Caps::none, Caps::round}) {
    const Tube rod(axis, RadiusLaw(0.6), caps);
    EXPECT_NEAR(length_of(TubeBoundary(rod).parameter_lines({{3, {}}, {7, {}}}, kView)), 3 * kTwoPi * 0.6 + 7 * 4,
                1e-10);
  }
  // Beyond the domain there is nothing, and one line of a direction is in its middle.
  const Tube rod(axis, RadiusLaw(0.6), Caps::round);
  const ShapeOutlines middle = TubeBoundary(rod).parameter_lines({{1, {}}, {0, {}}}, kView);
  ASSERT_EQ(middle.lines.size(), 1u);
  EXPECT_NEAR(middle.lines[0].curve->point(1).z, 0, 1e-12);
  EXPECT_TRUE(TubeBoundary(rod).parameter_lines({{0, {7.5}}, {0, {}}}, kView).lines.empty());
}

// Lines along a bar that turns a corner: at the angle a from the inside of the turn they meet in the mirror between
// both parts, where cos a > 0, or go over the ball of the corner on an arc.
TEST(TubeParameterLines, GoOverCorners) {
  const double R = 0.4;
  for (const double turn : {0.3, 0.5 * kPi, 2.0}) {
    const Vec3 corner(2, 0, 0), in(1, 0, 0), out(std::cos(turn), std::sin(turn), 0);
    const CurvePtr curve =
        std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, 0}, corner, corner + 3.0 * out}));
    const Tube tube(curve, RadiusLaw(R), Caps::flat);
    const double inside = angle_at_begin(tube, {0, 1, 0});
    for (const double a : {0.0, 0.7, 1.5, 1.8, 2.5, kPi, -2.0, -1.2}) {
      const double cosine = std::cos(a);
      const double whole = 5 + (cosine > 0 ? -2 * R * cosine * std::tan(0.5 * turn) : -R * cosine * turn);
      const ShapeOutlines found = TubeBoundary(tube).parameter_lines({{}, {0, {inside + a}}}, kView);
      EXPECT_NEAR(length_of(found), whole, 1e-8) << turn << " " << a;
      EXPECT_EQ(found.lines.size(), cosine > 0 ? 2u : 3u);
      // One line, from one end to the other.
      for (size_t k = 0; k + 1 < found.lines.size(); ++k) {
        const Curve &one = *found.lines[k].curve, &next = *found.lines[k + 1].curve;
        EXPECT_NEAR(glm::length(one.point(one.domain().hi) - next.point(next.domain().lo)), 0, 1e-8);
      }
    }
    // At the corner half a circle each of two.
    EXPECT_NEAR(length_of(TubeBoundary(tube).parameter_lines({{0, {curve->pieces()[1].domain.lo}}, {}}, kView)),
                kTwoPi * R, 1e-8);
  }
}

// A place of a line is on the tube where no point of the curve is nearer than its own: there are lines at all such
// places, and at none else. Circles about points of curves; along a helix the direction that turns no more than it must
// turns against the normal by the torsion.
TEST(TubeParameterLines, AreAllThatIsBare) {
  std::mt19937_64 random(20);
  const double h = 0.1, speed = std::sqrt(1 + h * h), torsion = h / (speed * speed);
  const CurvePtr helix = formula_curve({"cos(t)", "sin(t)", "0.1*t"}, {0, 12.5}), knot = trefoil(),
                 bend = formula_curve({"t", "t^2", "0"}, {-1.5, 1.5});
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  int bare = 0, covered = 0;
  // The line by its parameter over a range.
  const auto judge = [&](const Curve& curve, double R, const ShapeOutlines& found,
                         const std::function<Vec3(double)>& line, const Interval& range) {
    const double x = number(range.lo, range.hi), near = distance_of(found, line(x));
    const auto depth = [&](double at) { return R - distances(curve, line(at))[0]; };
    const double here = depth(x);
    // Not where a line that touches it hardly covers it.
    if (here > 1e-3 * R) {
      EXPECT_GT(near, 1e-6);
      ++covered;
    } else if (here < 1e-9) {
      ++bare;
      if (near < 1e-8) return;
      // Shorter stretches may be missed.
      constexpr int kPlaces = 16;
      const double step = range.width() / 256 / kPlaces;
      int length = 1;
      for (const double way : {-step, step})
        for (double at = x + way; depth(at) < 1e-9 && length <= kPlaces; at += way) ++length;
      EXPECT_LE(length, kPlaces) << R << " at " << x;
    }
  };
  for (const auto& [curve, R] : {std::pair(helix, 0.4), std::pair(knot, 0.9), std::pair(bend, 0.8)}) {
    const Tube tube(curve, RadiusLaw(R), Caps::round);
    const Interval domain = curve->domain();
    const double at = number(domain.lo, domain.hi), other = number(domain.lo, domain.hi);
    const ShapeOutlines circles = TubeBoundary(tube).parameter_lines({{0, {at, other}}, {}}, kView);
    EXPECT_TRUE(circles.complete);
    each_point(circles, 9, [&](const Vec3& p, const ShapeOutline&, double) {
      EXPECT_NEAR(distances(*curve, p)[0], R, 1e-9 * tube.bounds().diameter());
    });
    for (int k = 0; k < tests::tier_count(2000, 50); ++k) {
      const CurveJet jet = curve->evaluate(k % 2 ? at : other, 1);
      const Frame across = frame_about(jet.d[0], glm::normalize(jet.d[1]));
      judge(*curve, R, circles,
            [&](double angle) {
              return across.point({R * std::cos(angle), R * std::sin(angle), 0});
            },
            {0, kTwoPi});
    }
  }
  const double R = 0.4;
  const Tube tube(helix, RadiusLaw(R), Caps::round);
  const double normal = angle_at_begin(tube, {-1, 0, 0});
  for (const double angle : {0.0, 1.2, 2.9, 4.4}) {
    const ShapeOutlines along = TubeBoundary(tube).parameter_lines({{}, {0, {normal + angle}}}, kView);
    EXPECT_TRUE(along.complete);
    const auto line = [&](double t) {
      const double turned = angle - torsion * speed * t;
      const Vec3 n(-std::cos(t), -std::sin(t), 0), b = Vec3(h * std::sin(t), -h * std::cos(t), 1) / speed;
      return Vec3(std::cos(t), std::sin(t), h * t) + R * (std::cos(turned) * n + std::sin(turned) * b);
    };
    for (int k = 0; k < tests::tier_count(2000, 30); ++k) judge(*helix, R, along, line, helix->domain());
  }
  EXPECT_GT(bare, 60);
  EXPECT_GT(covered, 30);
}

}  // namespace
}  // namespace lekalo::geometry::tube_lines_test
