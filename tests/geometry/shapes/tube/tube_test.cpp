// Tubes: lines against closed forms (capsule, cylinder, torus) and against an oracle that walks along the line by the
// distance to the curve (tests/support/sweep_oracle.h).
#include "geometry/shapes/tube/tube.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/shapes/tube/tube_cases.h"
#include "geometry/surfaces/analytic/torus.h"
#include "support/sweep_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::tube_test {
namespace {

using Truth = std::function<std::vector<double>(const Line&)>;

struct Case {
  std::string name;
  ShapePtr tube;
  Truth truth;  // crossings of a line of unit direction whose origin is near
  double radius = 0;
};

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
      if (slope > 0.1) result.largest = tests::worse(result.largest, error);
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

// A line that nearly runs along a thin tube meets it far from where it passes the curve: the distance from the curve is
// the truth.
TEST(Tube, ThinRingsMeetLinesThatNearlyRunAlongThem) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double radius : {1e-2, 1e-4, 1e-6}) {
    const Tube tube(std::make_shared<Circle>(Frame{}, 1), RadiusLaw(radius), Caps::round);
    int missed = 0;
    double worst = 0;
    for (int k = 0; k < tests::tier_count(1000000); ++k) {
      const double angle = kTwoPi * unit(random), away = std::pow(10, -2 * unit(random));
      const Vec3 out(std::cos(angle), std::sin(angle), 0), along(-out.y, out.x, 0);
      const Vec3 direction = glm::normalize(along + away * checks::random_direction(random));
      const Line line{out + 0.9 * radius * checks::random_direction(random), direction};
      std::vector<SurfaceHit> hits;
      tube.all_hits(line, Interval::entire(), hits);
      missed += hits.size() < 2 || hits.size() % 2 != 0;
      for (const SurfaceHit& hit : hits) {
        const Vec3 p = line.at(hit.t);
        worst = tests::worse(worst, std::abs(std::hypot(std::hypot(p.x, p.y) - 1, p.z) - radius));
      }
    }
    EXPECT_EQ(missed, 0) << radius;
    EXPECT_LT(worst, 1e-14) << radius;
  }
}

// Beside the squares of distances along a thin tube the square of its radius is nothing but rounding: whether a line
// meets it is decided by the distance between two straight lines.
TEST(Tube, ThinRodsAreNotMissed) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Vec3 axis = Vec3(1, 2, 2) / 3.0;
  for (const double radius : {1e-5, 1e-7, 1e-8}) {
    const Tube rod(segment(Vec3(0), Vec3(1, 2, 2)), RadiusLaw(radius), Caps::round);
    int wrong = 0, met = 0;
    for (int k = 0; k < tests::tier_count(1000000); ++k) {
      const Vec3 near = (1.5 + unit(random)) * axis + 1.5 * radius * unit(random) * checks::random_direction(random);
      const Line line{near, checks::random_direction(random)};
      const Vec3 across = glm::normalize(glm::cross(line.direction, axis));
      const double distance = std::abs(glm::dot(line.origin, across)) / radius;
      if (std::abs(distance - 1) < 1e-3) continue;
      std::vector<SurfaceHit> hits;
      rod.all_hits(line, Interval::entire(), hits);
      wrong += hits.size() != (distance < 1 ? 2 : 0);
      met += distance < 1;
    }
    EXPECT_EQ(wrong, 0) << radius;
    EXPECT_GT(met, 1000) << radius;
  }
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

// Random rational curves with weights over two decades, resting at an end, and laws of any slope: what single balls
// fill of a line lies inside the tube's spans, and is nearly all of them.
TEST(Tube, HoldsTheBallsOfAnyCurveAndNoMore) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int hits = 0;
  for (int c = 0; c < tests::tier_count(2000); ++c) {
    const int degree = 2 + c % 5;
    std::vector<Vec3> points;
    std::vector<double> weights;
    for (int i = 0; i <= degree; ++i) {
      points.push_back({unit(random), unit(random), c % 4 == 0 ? 0 : unit(random)});
      weights.push_back(std::pow(10.0, 2 * unit(random) - 1));
    }
    if (c % 3 == 0 && degree > 2) points[1] = points[0];
    const CurvePtr curve = std::make_shared<NurbsCurve>(bezier_curve(points, weights));
    const double least = std::pow(10.0, -1.5 + unit(random));
    const RadiusLaw radius =
        c % 2 ? RadiusLaw(law(fmt::format("{}*(2 + sin({}*s))", least, 20 * unit(random))), *curve) : RadiusLaw(least);
    const Tube tube(curve, radius, Caps::round);
    std::vector<std::pair<Vec3, double>> balls;
    constexpr int kBalls = 4000;
    for (int i = 0; i <= kBalls; ++i) {
      const CurveJet jet = curve->evaluate(i / double(kBalls), 2);
      balls.emplace_back(jet.d[0], radius.at(i / double(kBalls), jet)[0]);
    }
    double step = 0;  // a ball between two others lies inside one of them that is larger by so much
    for (int i = 0; i < kBalls; ++i)
      step = std::max(
          step, glm::length(balls[i].first - balls[i + 1].first) + std::abs(balls[i].second - balls[i + 1].second));
    for (int i = 0; i < 30; ++i) {
      Vec3 d = checks::random_direction(random);
      const double t = unit(random);
      if (i % 3 == 0) d = glm::normalize(glm::normalize(curve->evaluate(t, 1).d[1]) + 1e-3 * d);  // nearly along it
      const Vec3 aim = curve->point(t) + least * checks::random_direction(random);
      const Line line{aim - 5.0 * d, d};
      std::vector<SurfaceHit> found;
      tube.all_hits(line, Interval::entire(), found);
      ASSERT_EQ(found.size() % 2, 0u);
      hits += static_cast<int>(found.size());
      std::vector<Interval> larger;
      for (const auto& [center, r] : balls) {
        if (const auto part = ball_part(line, center, r + step)) larger.push_back(*part);
        const auto part = ball_part(line, center, r);
        if (!part || part->width() < 1e-5) continue;
        bool held = false;
        for (size_t k = 0; k < found.size(); k += 2)
          held = held || (found[k].t <= part->lo + 1e-12 && found[k + 1].t >= part->hi - 1e-12);
        ASSERT_TRUE(held) << "curve " << c << " line " << i;
      }
      const std::vector<double> ends = ends_of(larger);
      for (size_t k = 0; k < found.size(); k += 2) {
        bool held = false;
        for (size_t m = 0; m < ends.size(); m += 2)
          held = held || (ends[m] <= found[k].t + 1e-12 && ends[m + 1] >= found[k + 1].t - 1e-12);
        ASSERT_TRUE(held) << "curve " << c << " line " << i;
      }
    }
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace lekalo::geometry::tube_test
