// Tubes: lines against closed forms (capsule, cylinder, torus) and against an oracle that walks along the line by the
// distance to the curve (tests/support/sweep_oracle.h); points, normals and derivatives; what is refused.
#include "geometry/shapes/tube.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "geometry/curves/bezier_curve.h"
#include "geometry/curves/circle.h"
#include "geometry/curves/formula_curve.h"
#include "geometry/curves/polyline.h"
#include "geometry/describe.h"
#include "geometry/surfaces/surface_checks.h"
#include "geometry/surfaces/torus.h"
#include "support/sweep_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry {
namespace {

Expression law(const std::string& text) {
  Expression result = std::get<Expression>(Expression::parse(text));
  const Expression::Variable s{"s"};
  EXPECT_FALSE(result.bind(std::span(&s, 1)));
  return result;
}

CurvePtr formula(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}), domain, closed);
}

CurvePtr segment(const Vec3& a, const Vec3& b) { return std::make_shared<NurbsCurve>(polyline(std::vector{a, b})); }

using Truth = std::function<std::vector<double>(const Line&)>;

struct Case {
  std::string name;
  ShapePtr tube;
  Truth truth;  // crossings of a line of unit direction whose origin is near
  double radius = 0;
};

// Lines through the shape's box: from 2 sizes away, from inside, and from 1000 radii.
Line random_line(const Box3& box, double radius, int kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 d = checks::random_direction(random);
  const Vec3 aim = box.lo + Vec3(unit(random), unit(random), unit(random)) * box.size();
  const double away = kind == 0 ? 2 * box.diameter() : kind == 1 ? 0 : 1000 * radius;
  return {aim - away * d, d};
}

// The line with its origin where it passes the point, and how far that is, in long double: what is far away loses no
// digits here.
Line moved_near(const Line& line, const Vec3& point, double& by) {
  long double along = 0, square = 0;
  for (int k = 0; k < 3; ++k) {
    along += (static_cast<long double>(point[k]) - line.origin[k]) * line.direction[k];
    square += static_cast<long double>(line.direction[k]) * line.direction[k];
  }
  by = static_cast<double>(along / square);
  Line result = line;
  for (int k = 0; k < 3; ++k)
    result.origin[k] = static_cast<double>(line.origin[k] +
                                           static_cast<long double>(by) * static_cast<long double>(line.direction[k]));
  return result;
}

// The truth about lines that begin near the shape serves all.
Truth from_near(const Vec3& center, const Truth& truth) {
  return [=](const Line& line) {
    double by = 0;
    std::vector<double> result = truth(moved_near(line, center, by));
    for (double& t : result) t += by;
    return result;
  };
}

struct Figures {
  int lines = 0, hits = 0, tangents = 0;
  double largest = 0;  // difference of t, of the size, where the line meets the wall at more than 6 degrees
};

// Compares counts and places; a line that differs must be a tangent: one of its neighbours 1e-9 of the size away has
// another count.
Figures compare(const Case& one, int lines, const Vec3& offset = Vec3(0), double tolerance = 1e-12) {
  const Shape& tube = *one.tube;
  const Box3 box = tube.bounds();
  const double size = box.diameter();
  std::mt19937_64 random(7);
  Figures result;
  for (int i = 0; i < lines; ++i) {
    const int kind = i % 3;
    const Line line = random_line(box, one.radius, kind, random);
    const Interval range = kind == 1 ? Interval(0, kInfinity) : Interval::entire();
    const auto count_from = [&](std::vector<double> t) {
      t.erase(std::remove_if(t.begin(), t.end(), [&](double x) { return !range.contains(x); }), t.end());
      return t;
    };
    const Truth near = from_near(box.center() - offset, one.truth);
    const auto truth = [&](const Line& at) { return count_from(near({at.origin - offset, at.direction})); };
    const std::vector<double> expected = truth(line);
    std::vector<SurfaceHit> found;
    tube.all_hits(line, range, found);
    ++result.lines;
    result.hits += static_cast<int>(found.size());
    bool same = found.size() == expected.size();
    for (size_t k = 0; same && k < found.size(); ++k) {
      const ShapePoint at = tube.point(found[k], line.at(found[k].t));
      const double slope = std::abs(glm::dot(at.normal, line.direction));
      const double error = std::abs(found[k].t - expected[k]) / size;
      // The rounding of the line's own coordinates counts too, and everything is seen under the angle.
      const double room = tolerance + 4e-16 * (glm::length(line.origin) + std::abs(expected[k])) / size;
      same = error * std::max(slope, 1e-4) <= room;
      if (slope > 0.1) result.largest = std::max(result.largest, error);
    }
    if (same) continue;
    bool tangent = false;
    for (int k = 0; !tangent && k < 6; ++k) {
      Vec3 shift(0);
      shift[k / 2] = (k % 2 ? 1e-9 : -1e-9) * size;
      tangent = truth({line.origin + shift, line.direction}).size() != expected.size();
    }
    if (!tangent) {
      std::string places;
      for (const double t : expected) places += fmt::format(" {}", t);
      places += " found";
      for (const SurfaceHit& hit : found) places += fmt::format(" {}", hit.t);
      ADD_FAILURE() << one.name << " line " << i << ": expected" << places;
    }
    ++result.tangents;
  }
  EXPECT_GT(result.hits, lines / 20) << one.name;
  EXPECT_LE(result.tangents, lines / 500 + 1) << one.name;
  tests::report_figure(one.name + "_largest_error_of_size", result.largest);
  return result;
}

std::vector<double> ends_of(std::vector<Interval> parts) {
  std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
  std::vector<double> result;
  for (const Interval& part : parts) {
    if (!(part.lo < part.hi)) continue;
    if (!result.empty() && part.lo <= result.back())
      result.back() = std::max(result.back(), part.hi);
    else
      result.insert(result.end(), {part.lo, part.hi});
  }
  return result;
}

std::optional<Interval> ball_part(const Line& line, const Vec3& center, double radius) {
  const Vec3 e = center - line.origin;
  const double a = glm::dot(e, line.direction);
  const Vec3 across = e - a * line.direction;
  const double g = radius * radius - glm::dot(across, across);
  if (!(g > 0)) return std::nullopt;
  return Interval(a - std::sqrt(g), a + std::sqrt(g));
}

// The part inside the cylinder from a to b with flat ends.
std::optional<Interval> cylinder_part(const Line& line, const Vec3& a, const Vec3& b, double radius) {
  const Vec3 axis = glm::normalize(b - a), e = line.origin - a;
  const double z = glm::dot(e, axis), dz = glm::dot(line.direction, axis);
  const Vec3 f = e - z * axis, df = line.direction - dz * axis;
  const double A = glm::dot(df, df), B = glm::dot(f, df), C = glm::dot(f, f) - radius * radius;
  const double root = B * B - A * C;
  if (!(root > 0)) return std::nullopt;
  const Interval across((-B - std::sqrt(root)) / A, (-B + std::sqrt(root)) / A);
  double lo = -z / dz, hi = (glm::length(b - a) - z) / dz;
  if (lo > hi) std::swap(lo, hi);
  const Interval part = intersect(across, Interval(lo, hi));
  if (part.empty()) return std::nullopt;
  return part;
}

const Vec3 kA(0.3, -0.2, 0.1), kB(1.4, 0.9, -0.7);

TEST(Tube, ASegmentMakesACapsule) {
  const double radius = 0.25;
  const Case one{"capsule", std::make_shared<Tube>(segment(kA, kB), RadiusLaw(radius), Caps::round),
                 [=](const Line& line) {
                   std::vector<Interval> parts;
                   for (const auto& part :
                        {cylinder_part(line, kA, kB, radius), ball_part(line, kA, radius), ball_part(line, kB, radius)})
                     if (part) parts.push_back(*part);
                   return ends_of(parts);
                 },
                 radius};
  EXPECT_TRUE(one.tube->is_closed());
  compare(one, tests::tier_count(1000000));
}

TEST(Tube, FlatEndsMakeACylinder) {
  const double radius = 0.4;
  const auto cylinder = [=](const Line& line) {
    const auto part = cylinder_part(line, kA, kB, radius);
    return part ? ends_of({*part}) : std::vector<double>();
  };
  const Case one{"cylinder", std::make_shared<Tube>(segment(kA, kB), RadiusLaw(radius), Caps::flat), cylinder, radius};
  EXPECT_TRUE(one.tube->is_closed());
  compare(one, tests::tier_count(1000000));
  const Vec3 axis = glm::normalize(kB - kA);
  const Case open{"open_cylinder", std::make_shared<Tube>(segment(kA, kB), RadiusLaw(radius), Caps::none),
                  [=](const Line& line) {
                    std::vector<double> walls;
                    for (const double t : cylinder(line)) {
                      const double z = glm::dot(line.at(t) - kA, axis), length = glm::length(kB - kA);
                      if (z > 1e-9 && z < length - 1e-9) walls.push_back(t);
                    }
                    return walls;
                  },
                  radius};
  EXPECT_FALSE(open.tube->is_closed());
  compare(open, tests::tier_count(1000000));
}

TEST(Tube, ACircleMakesATorus) {
  const Frame frame = frame_about({0.2, -0.4, 0.3}, glm::normalize(Vec3(0.3, -0.5, 1)));
  for (const Vec3& offset : {Vec3(0), Vec3(1000, -1000, 500)}) {
    for (const double radius : {0.05, 0.6}) {
      Frame moved = frame;
      moved.origin += offset;
      const TorusSurface torus(frame, 1.3, radius);
      const Case one{fmt::format("torus_{}{}", radius, offset.x > 0 ? "_far_off" : ""),
                     std::make_shared<Tube>(std::make_shared<Circle>(moved, 1.3), RadiusLaw(radius), Caps::round),
                     [=](const Line& line) {
                       LineHits hits;
                       torus.line_hits(line, Interval::entire(), hits);
                       std::vector<double> t;
                       for (int i = 0; i < hits.size(); ++i) t.push_back(hits[i].t);
                       std::sort(t.begin(), t.end());
                       return t;
                     },
                     radius};
      compare(one, tests::tier_count(300000), offset);
    }
  }
}

using oracle::SweepOracle;
using oracle::SweptBall;

Truth truth_of(const std::function<SweptBall(long double)>& ball, const std::vector<double>& breaks, const Box3& box,
               int samples = 600) {
  const auto sweep = std::make_shared<SweepOracle>(ball, breaks, samples);
  return [=](const Line& line) {
    const double size = box.diameter();
    if (glm::length(line.origin - box.center()) > size) return std::vector<double>();
    return sweep->crossings(line, -size, size, size);
  };
}

Case swept(const std::string& name, const CurvePtr& curve, const RadiusLaw& radius, double least,
           const std::function<SweptBall(long double)>& ball, const std::vector<double>& breaks, int samples = 600) {
  Case one{name, std::make_shared<Tube>(curve, radius, Caps::round), {}, least};
  one.truth = truth_of(ball, breaks, one.tube->bounds(), samples);
  return one;
}

std::function<SweptBall(long double)> polynomial_ball(const std::vector<Vec3>& points, long double radius) {
  return [=](long double t) {
    std::vector<std::array<long double, 3>> p;
    for (const Vec3& q : points) p.push_back({q.x, q.y, q.z});
    for (size_t n = p.size() - 1; n > 0; --n)
      for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) p[i][k] += t * (p[i + 1][k] - p[i][k]);
    return SweptBall{p[0][0], p[0][1], p[0][2], radius};
  };
}

TEST(Tube, HelicesMeetLinesWhereTheOracleSays) {
  const auto helix = formula({"cos(t)", "sin(t)", "0.12*t"}, {0, 12});
  compare(swept("helix", helix, RadiusLaw(0.2), 0.2,
                [](long double t) {
                  return SweptBall{std::cos(t), std::sin(t), 0.12L * t, 0.2L};
                },
                {0, 12}),
          tests::tier_count(20000));
  // s = t/12 on a helix.
  compare(swept("helix_of_varying_radius", helix, RadiusLaw(law("0.08 + 0.2*s + 0.03*sin(40*s)"), *helix), 0.08,
                [](long double t) {
                  const long double s = t / 12;
                  return SweptBall{std::cos(t), std::sin(t), 0.12L * t, 0.08L + 0.2L * s + 0.03L * std::sin(40 * s)};
                },
                {0, 12}),
          tests::tier_count(20000));
  // Fatter than its own bends: only the outside of what meets itself is seen.
  compare(swept("fat_helix", helix, RadiusLaw(1.2), 1.2,
                [](long double t) {
                  return SweptBall{std::cos(t), std::sin(t), 0.12L * t, 1.2L};
                },
                {0, 12}),
          tests::tier_count(5000));
}

TEST(Tube, CuspsKinksAndTightBendsMeetLinesWhereTheOracleSays) {
  compare(swept("cusp", formula({"t^2", "t^3", "0"}, {-1, 1}), RadiusLaw(0.15), 0.15,
                [](long double t) {
                  return SweptBall{t * t, t * t * t, 0, 0.15L};
                },
                {-1, 0, 1}),
          tests::tier_count(20000));
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0.1, 0}, {0.1, 0.2, 0.1}, {0.5, 1, 0.9}, {0.5, 0.9, -0.4}};
  compare(swept(
              "polyline", std::make_shared<NurbsCurve>(polyline(corners)), RadiusLaw(0.07), 0.07,
              [=](long double t) {
                const int i = std::min(3, static_cast<int>(t));
                const long double w = t - i;
                const Vec3 a = corners[i], b = corners[i + 1];
                return SweptBall{a.x + w * (static_cast<long double>(b.x) - a.x),
                                 a.y + w * (static_cast<long double>(b.y) - a.y),
                                 a.z + w * (static_cast<long double>(b.z) - a.z), 0.07L};
              },
              {0, 1, 2, 3, 4}, 200),
          tests::tier_count(20000));
  const std::vector<Vec3> tight{{0, 0, 0}, {2, 0.2, 0.3}, {-1, 0.4, 0.1}, {1, 0.7, 0}};
  for (const double radius : {0.04, 0.3})
    compare(swept(fmt::format("tight_bezier_{}", radius), std::make_shared<NurbsCurve>(bezier_curve(tight)),
                  RadiusLaw(radius), radius, polynomial_ball(tight, radius), {0, 1}),
            tests::tier_count(20000));
}

TEST(Tube, ALawWithAKinkAndAJump) {
  const CurvePtr line = segment({0, 0, 0}, {2, 0, 0});
  compare(swept("kinked_law", line, RadiusLaw(law("0.2 + 0.4*abs(s - 0.4)"), *line), 0.2,
                [](long double t) {
                  return SweptBall{2 * t, 0, 0, 0.2L + 0.4L * std::abs(t - 0.4L)};
                },
                {0, 0.4, 1}),
          tests::tier_count(20000));
  compare(swept("jumping_law", line, RadiusLaw(law("0.2 if s < 0.7 else 0.3"), *line), 0.2,
                [](long double t) {
                  return SweptBall{2 * t, 0, 0, t < 0.7L ? 0.2L : 0.3L};
                },
                {0, 0.7, 1}),
          tests::tier_count(20000), Vec3(0), 1e-11);
}

// The points and derivatives at hits of random lines.
template <class Check>
void check_points(const Tube& tube, const Check& check) {
  std::mt19937_64 random(11);
  int points = 0;
  for (int i = 0; i < 400; ++i) {
    const Line line = random_line(tube.bounds(), 1, 0, random);
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    for (size_t k = 0; k < hits.size(); ++k) {
      const Vec3 near = line.at(hits[k].t);
      const ShapePoint at = tube.point(hits[k], near);
      EXPECT_LE(glm::length(at.position - near), 1e-10);
      EXPECT_NEAR(glm::length(at.normal), 1, 1e-15);
      // In and out by turns.
      EXPECT_EQ(glm::dot(at.normal, line.direction) < 0, k % 2 == 0);
      EXPECT_LE(std::abs(glm::dot(at.du, at.normal)), 1e-9 * (1 + glm::length(at.du)));
      EXPECT_LE(std::abs(glm::dot(at.dv, at.normal)), 1e-12);
      check(at);
      ++points;
    }
  }
  EXPECT_GT(points, 100);
}

TEST(Tube, PointsOfARingAreThoseOfATorus) {
  // About a plane curve the reference direction keeps its angle with the plane, so that v is that of the torus and a
  // constant.
  const Tube ring(std::make_shared<Circle>(Frame(), 2.0), RadiusLaw(0.5), Caps::round);
  const TorusSurface torus(Frame(), 2, 0.5);
  double shift = kInfinity;
  check_points(ring, [&](const ShapePoint& at) {
    const double v = std::atan2(at.position.z, std::hypot(at.position.x, at.position.y) - 2);
    const SurfaceJet jet = torus.evaluate(at.u, v, 1);
    EXPECT_LE(glm::length(at.position - jet.point()), 1e-13);
    EXPECT_LE(glm::length(at.normal - torus.normal(at.u, v)), 1e-12);
    EXPECT_LE(glm::length(at.du - jet.du()), 1e-12);
    EXPECT_LE(std::abs(std::abs(glm::dot(at.dv, jet.dv())) - 0.25), 1e-12);
    const double turn = std::remainder(at.v * (glm::dot(at.dv, jet.dv()) < 0 ? -1 : 1) - v, kTwoPi);
    if (shift == kInfinity) shift = turn;
    EXPECT_LE(std::abs(std::remainder(turn - shift, kTwoPi)), 1e-7);
  });
}

TEST(Tube, DerivativesOfAConeAreThoseOfItsFormula) {
  // R = 0.3 + 0.2 t about the axis z: the cone r = 0.3 + 0.2 t + ... touches the balls where n . z = -0.2.
  const CurvePtr axis = segment({0, 0, 0}, {0, 0, 2});
  const Tube cone(axis, RadiusLaw(law("0.3 + 0.4*s"), *axis), Caps::round);
  int walls = 0;
  const double k = 0.2, c = std::sqrt(1 - k * k);
  check_points(cone, [&](const ShapePoint& at) {
    if (glm::length(at.du) == 0) return;
    const double z = 2 * at.u, radius = 0.3 + 0.2 * z;
    EXPECT_NEAR(at.normal.z, -k, 1e-9);
    EXPECT_NEAR(at.position.z, z - k * radius, 1e-9);
    const Vec3 m = glm::normalize(Vec3(at.normal.x, at.normal.y, 0));
    EXPECT_LE(glm::length(at.du - 2.0 * (Vec3(0, 0, 1 - k * k) + k * c * m)), 1e-8);
    ++walls;
  });
  EXPECT_GT(walls, 50);
}

TEST(Tube, AnyHelixHasItsNormalsAcross) {
  const auto helix = formula({"cos(t)", "sin(t)", "0.12*t"}, {0, 12});
  check_points(Tube(helix, RadiusLaw(law("0.08 + 0.2*s + 0.03*sin(40*s)"), *helix), Caps::round),
               [](const ShapePoint&) {});
  check_points(Tube(helix, RadiusLaw(0.2), Caps::flat), [](const ShapePoint&) {});
}

TEST(Tube, FlatEndsOfABentTubeLieAcrossTheCurve) {
  const auto arc = formula({"2*cos(t)", "2*sin(t)", "0"}, {0, 1.5});
  const Tube tube(arc, RadiusLaw(0.5), Caps::flat);
  const TorusSurface torus(Frame(), 2, 0.5, {{0, 1.5}, {-kPi, kPi}});
  std::mt19937_64 random(2);
  int caps = 0;
  for (int i = 0; i < tests::tier_count(100000); ++i) {
    const Line line = random_line(tube.bounds(), 0.5, 0, random);
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    ASSERT_EQ(hits.size() % 2, 0u);
    std::vector<double> walls, expected;
    for (const SurfaceHit& hit : hits) {
      const Vec3 p = line.at(hit.t);
      if (hit.face == 0) {
        walls.push_back(hit.t);
        continue;
      }
      ++caps;
      const double angle = hit.face == 1 ? 0 : 1.5;
      const Vec3 center = 2.0 * Vec3(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
      EXPECT_LE(glm::length(p - center), 0.5 + 1e-12);
      EXPECT_LE(std::abs(glm::dot(p - center, across)), 1e-13);
      EXPECT_LE(glm::length(tube.point(hit, p).normal - (hit.face == 1 ? -across : across)), 1e-14);
    }
    LineHits on_torus;
    torus.line_hits(line, Interval::entire(), on_torus);
    for (int k = 0; k < on_torus.size(); ++k) expected.push_back(on_torus[k].t);
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(walls.size(), expected.size()) << "line " << i;
    for (size_t k = 0; k < walls.size(); ++k) EXPECT_LE(std::abs(walls[k] - expected[k]), 1e-9) << "line " << i;
  }
  EXPECT_GT(caps, 20);
}

TEST(Tube, LinesAlongItAndThroughWhatIsDegenerate) {
  const auto count = [](const Tube& tube, const Line& line) {
    std::vector<SurfaceHit> hits;
    tube.all_hits(line, Interval::entire(), hits);
    return hits;
  };
  // Along a straight tube, inside and outside.
  const Tube rod(segment({0, 0, 0}, {0, 0, 2}), RadiusLaw(0.5), Caps::round);
  const auto along = count(rod, {{0.3, 0, -7}, {0, 0, 2}});
  ASSERT_EQ(along.size(), 2u);
  EXPECT_NEAR(along[0].t, (7 - 0.4) / 2, 1e-15);
  EXPECT_NEAR(along[1].t, (9 + 0.4) / 2, 1e-15);
  EXPECT_TRUE(count(rod, {{0.6, 0, -7}, {0, 0, 1}}).empty());
  // Along the axis of a ring without a hole every ball counts the same.
  const Tube ring(std::make_shared<Circle>(Frame(), 1.0), RadiusLaw(1.3), Caps::round);
  const auto through = count(ring, {{0, 0, -7}, {0, 0, 1}});
  ASSERT_EQ(through.size(), 2u);
  EXPECT_NEAR(through[0].t, 7 - std::sqrt(0.69), 1e-12);
  EXPECT_NEAR(through[1].t, 7 + std::sqrt(0.69), 1e-12);
  // Through the cusp itself.
  const Tube cusp(formula({"t^2", "t^3", "0"}, {-1, 1}), RadiusLaw(0.15), Caps::round);
  const auto tip = count(cusp, {{-3, 0, 0}, {1, 0, 0}});
  ASSERT_GE(tip.size(), 2u);
  EXPECT_NEAR(tip[0].t, 2.85, 1e-13);
}

TEST(Tube, RefusesWhatIsNone) {
  const auto helix = formula({"cos(t)", "sin(t)", "0.12*t"}, {0, 12});
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      Tube(helix, RadiusLaw(law(text), *helix), Caps::round);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(refused("0"), "radius: the radius must be greater than 0, found 0");
  EXPECT_EQ(refused("-0.1"), "radius: the radius must be greater than 0, found -0.1");
  EXPECT_EQ(refused("0.5 - s"), "radius: the radius must be greater than 0, and at s = 0.5 it is 0");
  EXPECT_EQ(refused("log(s - 0.5)"), "radius: the formula has no value at s = 0");
  // Below zero between any places where it could be tried.
  EXPECT_NE(refused("(s - 1/3)^2 - 1e-9"), "nothing");
  EXPECT_EQ(refused("0.1 + s"), "nothing");
}

}  // namespace
}  // namespace lekalo::geometry
