// Implicit surfaces against closed forms (sphere, torus), and against an oracle that shares nothing with the product:
// halving of the line with enclosures of a formula written here, and signs in 113 bits.
#include "geometry/shapes/implicit/implicit_surface.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/sign_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::implicit_surface_test {
namespace {

using checks::random_direction;

Expression formula(const std::string& text) {
  auto parsed = Expression::parse(text);
  Expression& result = std::get<Expression>(parsed);
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  const auto error = result.bind(variables);
  if (error) throw std::invalid_argument(error->message);
  return result;
}

ImplicitSurface surface(const std::string& text, const ImplicitRegion& region, bool closed = false, double level = 0) {
  return ImplicitSurface(formula(text), level, region, closed);
}

ImplicitRegion cube(double half, const Vec3& center = Vec3(0)) { return {{center - Vec3(half), center + Vec3(half)}}; }

std::vector<double> places(const ImplicitSurface& shape, const Line& line, const Interval& t = Interval::entire()) {
  std::vector<SurfaceHit> hits;
  shape.all_hits(line, t, hits);
  std::vector<double> result;
  for (const SurfaceHit& hit : hits) result.push_back(hit.t);
  return result;
}

// A line through a random place of the box, from `distance` away.
Line random_line(std::mt19937_64& random, const Box3& box, double distance) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 d = random_direction(random);
  const double x = unit(random), y = unit(random);
  return {box.lo + Vec3(x, y, unit(random)) * box.size() - distance * d, d};
}

// The two ways of the product: polynomials, and cells. The second formulas are the same functions.
constexpr const char* kNoPolynomial = " + 0*sin(x)";

const std::string kBarth =
    "4*(2.618033988749895*x^2 - y^2)*(2.618033988749895*y^2 - z^2)*(2.618033988749895*z^2 - x^2)"
    " - 4.23606797749979*(x^2 + y^2 + z^2 - 1)^2";
const std::string kGyroid = "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)";

struct Barth {
  static constexpr double kScale = 60;  // of its terms in the region
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a(2.618033988749895), b(4.23606797749979), one(1.0);
    const T xx = x * x, yy = y * y, zz = z * z, r = xx + yy + zz - one;
    return T(4.0) * (a * xx - yy) * (a * yy - zz) * (a * zz - xx) - b * r * r;
  }
};
struct Gyroid {
  static constexpr double kScale = 3;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
  }
};

// What a line has inside a box.
Interval inside(const Line& line, const Box3& box) {
  Interval t{-kInfinity, kInfinity};
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - line.origin[k]) / line.direction[k],
                 b = (box.hi[k] - line.origin[k]) / line.direction[k];
    t = intersect(t, {std::min(a, b), std::max(a, b)});
  }
  return t;
}

template <class F, class Lines>
void compare(const ImplicitSurface& shape, const Box3& box, int count, const char* name, const Lines& next_line,
             double max_doubtful = 0.002) {
  oracle::SignOracle<F> oracle;
  const double size = box.diameter();
  int hits = 0, doubtful = 0;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const Line line = next_line();
    const Interval t = inside(line, box);
    if (!(t.width() > 1e-6 * size)) continue;
    const auto answer = oracle.ask(line, t.lo, t.hi);
    const std::vector<double> found = places(shape, line);
    if (answer.doubtful) {
      ++doubtful;
      continue;
    }
    ASSERT_EQ(found.size(), answer.t.size()) << name << ", line " << i;
    hits += static_cast<int>(found.size());
    for (size_t k = 0; k < found.size(); ++k) {
      const double slope = std::abs(oracle.slope(answer.t[k]));
      const double allowed = 1e-12 * size + 1e-14 * F::kScale / slope;
      worst = tests::worse(worst, std::abs(found[k] - answer.t[k]) / allowed);
      ASSERT_LE(std::abs(found[k] - answer.t[k]), allowed) << name << ", line " << i << ", hit " << k;
    }
  }
  EXPECT_GT(hits, count / 2) << name;
  EXPECT_LE(doubtful, max_doubtful * count + 1) << name;
  tests::report_figure(std::string(name) + "_worst_of_allowed", worst);
  tests::report_figure(std::string(name) + "_doubtful_lines", doubtful);
}

TEST(ImplicitSurface, LinesMeetASphereWhereItsClosedFormSays) {
  std::mt19937_64 random(1);
  for (const Vec3& center : {Vec3(0), Vec3(1000, -700, 300)})
    for (const double distance : {0.0, 5.0, 1000.0})
      for (const char* way : {"", kNoPolynomial}) {
        const ImplicitSurface shape =
            surface(fmt::format("(x - ({}))^2 + (y - ({}))^2 + (z - ({}))^2 - 1{}", center.x, center.y, center.z, way),
                    cube(1.25, center), true);
        EXPECT_EQ(shape.degree(), *way ? 0 : 2);
        const int count = tests::tier_count(*way ? 20000 : 100000);
        for (int i = 0; i < count; ++i) {
          const Line line = random_line(random, shape.bounds(), distance);
          // Far away the line itself is known to an ulp of its origin.
          const Vec3 o = line.origin - center;
          const double foot_point = -glm::dot(o, line.direction), across = glm::length(o + foot_point * line.direction);
          if (std::abs(across - 1) < 1e-6) continue;
          const std::vector<double> t = places(shape, line);
          ASSERT_EQ(t.size(), across < 1 ? 2U : 0U) << "line " << i;
          const double half = across < 1 ? std::sqrt((1 - across) * (1 + across)) : 0;
          const double allowed =
              2e-12 + (4e-16 * (glm::length(o) + glm::length(center)) + 1e-15) / std::max(half, 1e-3);
          for (size_t k = 0; k < t.size(); ++k)
            ASSERT_NEAR(t[k], foot_point + (k == 0 ? -half : half), allowed) << "line " << i << " at " << distance;
        }
      }
}

TEST(ImplicitSurface, LinesMeetATorusWhereItsClosedFormSays) {
  const TorusSurface torus(Frame(), 1, 0.35);
  std::mt19937_64 random(2);
  for (const char* way : {"", kNoPolynomial}) {
    const ImplicitSurface shape =
        surface(std::string("(x^2 + y^2 + z^2 + 0.8775)^2 - 4*(x^2 + y^2)") + way, cube(1.5), true);
    EXPECT_EQ(shape.degree(), *way ? 0 : 4);
    const int count = tests::tier_count(*way ? 20000 : 100000);
    int different = 0, hits = 0;
    for (int i = 0; i < count; ++i) {
      const Line line = random_line(random, shape.bounds(), 3);
      LineHits expected;
      torus.line_hits(line, Interval::entire(), expected);
      std::vector<double> truth;
      for (int k = 0; k < expected.size(); ++k) truth.push_back(expected[k].t);
      std::sort(truth.begin(), truth.end());
      const std::vector<double> t = places(shape, line);
      EXPECT_EQ(t.size() % 2, 0U);
      if (t.size() != truth.size()) {
        ++different;
        continue;
      }
      hits += static_cast<int>(t.size());
      for (size_t k = 0; k < t.size(); ++k) {
        const double slope = std::abs(glm::dot(shape.gradient(line.at(t[k])), line.direction));
        ASSERT_NEAR(t[k], truth[k], 2e-12 + 1e-13 / slope) << "line " << i;
      }
    }
    EXPECT_GT(hits, count / 2);
    EXPECT_LE(different, count / 10000);
  }
}

TEST(ImplicitSurface, LinesMeetTheBarthSexticWhereTheOracleSays) {
  std::mt19937_64 random(3);
  const ImplicitRegion region = cube(1.7);
  const auto line = [&] { return random_line(random, region.box, 4); };
  const ImplicitSurface shape = surface(kBarth, region);
  EXPECT_EQ(shape.degree(), 6);
  compare<Barth>(shape, region.box, tests::tier_count(10000), "polynomial", line);
  compare<Barth>(surface(kBarth + kNoPolynomial, region), region.box, tests::tier_count(10000), "cells", line);
}

TEST(ImplicitSurface, LinesMeetTheGyroidWhereTheOracleSays) {
  std::mt19937_64 random(4);
  const ImplicitRegion region = cube(5);
  const ImplicitSurface shape = surface(kGyroid, region);
  EXPECT_EQ(shape.degree(), 0);
  compare<Gyroid>(shape, region.box, tests::tier_count(10000), "gyroid",
                  [&] { return random_line(random, region.box, 12); });
}

// The 50 nodes of the Barth sextic that are not at infinity: corners of a dodecahedron, middles of its edges' pencils.
std::vector<Vec3> barth_nodes() {
  const double tau = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> nodes;
  const auto add = [&](const Vec3& p) {
    for (const Vec3& q : {p, Vec3(p.y, p.z, p.x), Vec3(p.z, p.x, p.y)})
      for (int s = 0; s < 8; ++s) {
        const Vec3 r = q * Vec3(s & 1 ? -1 : 1, s & 2 ? -1 : 1, s & 4 ? -1 : 1);
        if (std::none_of(nodes.begin(), nodes.end(), [&](const Vec3& n) { return glm::length(n - r) < 1e-9; }))
          nodes.push_back(r);
      }
  };
  add({1, 1, 1});
  add({1, 0, 0});
  for (const Vec3& p : {Vec3(0, tau, 1 / tau), Vec3(0, 1 / tau, tau)})
    if (std::abs(Barth()(p.x, p.y, p.z)) < 1e-12) add(p);
  for (const Vec3& p : {0.5 * Vec3(tau, 1, 1 / tau), 0.5 * Vec3(1, tau, 1 / tau)})
    if (std::abs(Barth()(p.x, p.y, p.z)) < 1e-12) add(p);
  return nodes;
}

TEST(ImplicitSurface, NodesHaveNoHoles) {
  const std::vector<Vec3> nodes = barth_nodes();
  ASSERT_EQ(nodes.size(), 50U);
  std::mt19937_64 random(5);
  const ImplicitRegion region = cube(2);
  const ImplicitSurface open = surface(kBarth, region), closed = surface(kBarth, region, true),
                        cells = surface(kBarth + kNoPolynomial, region, true);
  int aimed = 0, missed = 0;
  for (const Vec3& node : nodes) {
    EXPECT_LE(glm::length(open.gradient(node)), 1e-13);
    for (int i = 0; i < tests::tier_count(1000); ++i) {
      const Vec3 d = random_direction(random), off = random_direction(random);
      for (const double by : {0.0, 1e-12, 1e-9, 1e-6, 1e-4}) {
        const Line line{node + by * off - 3.0 * d, d};
        for (const ImplicitSurface* shape : {&closed, &cells}) {
          const std::vector<double> t = places(*shape, line);
          EXPECT_EQ(t.size() % 2, 0U);
          EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
        }
        if (by > 0) continue;
        // The line through the node touches the surface there, which shows but where it passes by an ulp.
        const std::vector<double> t = places(open, line);
        ++aimed;
        missed += std::none_of(t.begin(), t.end(), [](double at) { return std::abs(at - 3) < 1e-4; });
      }
    }
  }
  EXPECT_LE(missed, aimed / 50);
  // Near the nodes the oracle sees both sheets apart.
  const auto near_a_node = [&] {
    const Vec3 d = random_direction(random), off = random_direction(random);
    const size_t node = std::uniform_int_distribution<size_t>(0, nodes.size() - 1)(random);
    return Line{nodes[node] + 1e-3 * off - 4.0 * d, d};
  };
  compare<Barth>(open, region.box, tests::tier_count(3000), "near_nodes", near_a_node, 0.1);
}

TEST(ImplicitSurface, ClosedOnesAreCrossedInAndOutByTurns) {
  std::mt19937_64 random(6);
  for (const ImplicitSurface& shape :
       {surface(kBarth, ImplicitRegion::ball(Vec3(0), 1.6), true), surface(kBarth, cube(1.2), true),
        surface(kGyroid, cube(4), true), surface(kGyroid, ImplicitRegion::ball(Vec3(1, 2, 3), 3), true),
        surface("abs(x) + abs(y) + abs(z) - 1", cube(0.8), true), surface("x", cube(1), true)}) {
    const double size = shape.bounds().diameter();
    EXPECT_TRUE(shape.is_closed());
    for (int i = 0; i < tests::tier_count(100000); ++i) {
      const Line line = random_line(random, shape.bounds(), size);
      std::vector<SurfaceHit> hits;
      shape.all_hits(line, Interval::entire(), hits);
      ASSERT_EQ(hits.size() % 2, 0U);
      SurfaceHit first;
      ASSERT_EQ(shape.first_hit(line, Interval::entire(), first), !hits.empty());
      if (!hits.empty()) {
        ASSERT_EQ(first.t, hits[0].t);
      }
      for (size_t k = 0; k < hits.size(); ++k) {
        const ShapePoint at = shape.point(hits[k], line.at(hits[k].t));
        ASSERT_NEAR(glm::length(at.normal), 1, 1e-12);
        ASSERT_LE(glm::length(at.position - line.at(hits[k].t)), 1e-9 * size);
        const double slope = glm::dot(at.normal, line.direction);
        if (std::abs(slope) < 1e-6) continue;
        ASSERT_EQ(slope < 0, k % 2 == 0) << "line " << i << ", hit " << k;
      }
    }
  }
}

TEST(ImplicitSurface, PartsOfALineHaveTheirOwnHits) {
  std::mt19937_64 random(7);
  for (const ImplicitSurface& shape : {surface(kBarth, cube(1.2), true), surface(kGyroid, cube(4), true)})
    for (int i = 0; i < tests::tier_count(100000); ++i) {
      const Line line = random_line(random, shape.bounds(), shape.bounds().diameter());
      const std::vector<double> all = places(shape, line);
      if (all.size() < 2) continue;
      const double cut = 0.5 * (all[0] + all[1]);
      const auto before = places(shape, line, {0, cut}), after = places(shape, line, {cut, kInfinity});
      if (all[1] - all[0] < 1e-6) continue;
      ASSERT_EQ(before.size(), 1U);
      ASSERT_EQ(after.size(), all.size() - 1);
      EXPECT_NEAR(before[0], all[0], 1e-9);
      EXPECT_NEAR(after[0], all[1], 1e-9);
    }
}

// A ray that left a point starts outside, and does not meet the point again.
TEST(ImplicitSurface, RaysThatLeaveDoNotComeBack) {
  std::mt19937_64 random(8);
  for (const ImplicitSurface& shape :
       {surface("x^2 + y^2 + z^2 - 1", cube(1.25)), surface(kGyroid, cube(5)),
        surface("x^2 + y^2 + z^2 - 1 + 0*sin(x)", cube(1.25)), surface(kBarth, cube(1.7))})
    for (int i = 0; i < tests::tier_count(100000); ++i) {
      const Line line = random_line(random, shape.bounds(), shape.bounds().diameter());
      SurfaceHit hit;
      if (!shape.first_hit(line, Interval::entire(), hit)) continue;
      const ShapePoint at = shape.point(hit, line.at(hit.t));
      if (at.error > 1e-9) continue;  // beside a node
      const double error = at.error + 1e-15 * glm::length(at.position);
      const Vec3 d = random_direction(random), normal = glm::dot(d, at.normal) > 0 ? at.normal : -at.normal;
      const double slope = glm::dot(d, normal);
      if (slope < 0.01) continue;
      if (shape.first_hit({at.position + 4 * error * normal, d}, {0, kInfinity}, hit)) {
        ASSERT_GE(hit.t, 1e-6) << "line " << i;
      }
    }
}

TEST(ImplicitSurface, KinksJumpsAndPoles) {
  // |x| - 0.25 in a cube: two planes.
  EXPECT_EQ(places(surface("abs(x) - 0.25", cube(1)), {{-2, 0.1, 0.2}, {1, 0, 0}}).size(), 2U);
  // A jump is no zero, and neither is a pole, wherever it lies in the cells.
  for (const double at : {0.01, 0.0, 0.5}) {
    const Line line{{-2, 0.1, 0.2}, {1, 0, 0}};
    EXPECT_EQ(places(surface(fmt::format("floor(x - {}) + 0.5 + 0*y", at), cube(1)), line).size(), 0U) << at;
    EXPECT_EQ(places(surface(fmt::format("1/(x - {})", at), cube(1)), line).size(), 0U) << at;
    EXPECT_EQ(places(surface(fmt::format("1/(x - {})^2 - 100", at), cube(1)), line).size(), 2U) << at;
    // But the solid ends there.
    EXPECT_EQ(places(surface(fmt::format("floor(x - {}) + 0.5 + 0*y", at), cube(1), true), line).size(), 2U) << at;
  }
}

// A formula, and the same function in long double.
using Number = long double;
struct Function {
  std::string text;
  std::function<Number(Number, Number, Number)> of;
};

// Where a function changes its sign on a line, by samples and halving in 64 bits alone. Changes where it does not come
// down to zero are left out: jumps and poles.
std::vector<double> sampled_zeros(const Function& function, const Line& line, const Interval& t) {
  constexpr int kSamples = 500;
  const auto at = [&](Number s) {
    return function.of(line.origin.x + s * line.direction.x, line.origin.y + s * line.direction.y,
                       line.origin.z + s * line.direction.z);
  };
  const auto size = [&](Number s, Number by) { return std::abs(at(s - by)) + std::abs(at(s + by)); };
  std::vector<double> zeros;
  Number before = t.lo;
  for (int i = 1; i <= kSamples; ++i) {
    const Number next = t.lo + Number(t.hi - t.lo) * i / kSamples;
    Number lo = before, hi = next;
    before = next;
    const bool ends = at(hi) > 0;
    if ((at(lo) > 0) == ends) continue;
    for (int step = 0; step < 70; ++step) {
      const Number middle = (lo + hi) / 2;
      ((at(middle) > 0) == ends ? hi : lo) = middle;
    }
    // A zero that is nearly in a jump is left out as well.
    const Number at_zero = size(lo, 1e-15L), near = size(lo, 1e-12L), beside = size(lo, 1e-9L);
    if (at_zero < 0.9L * near && near < 0.9L * beside) zeros.push_back(static_cast<double>(lo));
  }
  return zeros;
}

// Slopes without bound at zeros and elsewhere, poles and jumps, where cells meet and between.
TEST(ImplicitSurface, ZerosAreWhereTheFormulaComesDownToZero) {
  const std::vector<Function> functions{
      {"cbrt(x) - z", [](Number x, Number, Number z) { return std::cbrt(x) - z; }},
      {"cbrt(x) + cbrt(y) + cbrt(z) - 0.5",
       [](Number x, Number y, Number z) { return std::cbrt(x) + std::cbrt(y) + std::cbrt(z) - 0.5L; }},
      {"abs(x)^0.5*sign(x) - z",
       [](Number x, Number, Number z) { return std::copysign(std::sqrt(std::abs(x)), x) - z; }},
      {"abs(x - y)^0.1*sign(x - y)",
       [](Number x, Number y, Number) { return std::copysign(std::pow(std::abs(x - y), 0.1L), x - y); }},
      {"((x + 2.5)^(1/3) - 1.5)*cbrt(y - 0.2)",
       [](Number x, Number y, Number) { return (std::pow(x + 2.5L, Number(1.0 / 3)) - 1.5L) * std::cbrt(y - 0.2L); }},
      {"z - tan(x)", [](Number x, Number, Number z) { return z - std::tan(x); }},
      {"x + atan(tan(x + y))/(1 rad) - z",
       [](Number x, Number y, Number z) { return x + std::atan(std::tan(x + y)) - z; }},
      {"1/x - z", [](Number x, Number, Number z) { return 1 / x - z; }},
      {"z - 1/(x^2 + y^2)", [](Number x, Number y, Number z) { return z - 1 / (x * x + y * y); }},
      {"log(abs(x + y)) - z", [](Number x, Number y, Number z) { return std::log(std::abs(x + y)) - z; }},
      {"floor(x) - z", [](Number x, Number, Number z) { return std::floor(x) - z; }},
      {"(x - 0.1)/abs(x - 0.1) + y", [](Number x, Number y, Number) { return (x < Number(0.1) ? -1 : 1) + y; }},
      {"mod(x + y, 1.25) - z - 0.5",
       [](Number x, Number y, Number z) { return x + y - 1.25L * std::floor((x + y) / 1.25L) - z - 0.5L; }},
      {"max(1/x, cbrt(y)) - z", [](Number x, Number y, Number z) { return std::max(1 / x, std::cbrt(y)) - z; }},
      // A model of the third order near such a pole would ask for a hundred thousand parts of a line.
      {"(1/(z - 1.2*y - 1.8)^4)^(1/3) - 1/(z - 0.5*x)^2 - 2", [](Number x, Number y, Number z) {
         return std::pow(std::abs(z - 1.2L * y - 1.8L), Number(-4.0 / 3)) - 1 / ((z - x / 2) * (z - x / 2)) - 2;
       }}};
  std::mt19937_64 random(9);
  std::uniform_int_distribution<int> quarter(-7, 7);
  for (const Function& function : functions)
    for (const double off : {0.0, 0.137}) {
      const ImplicitRegion region = cube(2, Vec3(off, 0, -off));
      const ImplicitSurface open = surface(function.text, region), closed = surface(function.text, region, true);
      int found = 0;
      const int count = tests::tier_count(2000);
      for (int i = 0; i < count; ++i) {
        Line line = random_line(random, region.box, 4);
        // Through places where formulas are singular, between lines that are parallel to an axis.
        if (i % 3 == 1)
          line.origin = 0.25 * Vec3(quarter(random), quarter(random), quarter(random)) - 4.0 * line.direction;
        if (i % 3 == 2) line = {line.at(4) - Vec3(4, 0, 0), {1, 0, 0}};
        const Interval t = inside(line, region.box);
        if (!(t.width() > 1e-3)) continue;
        const std::vector<double> expected = sampled_zeros(function, line, t), at = places(open, line);
        for (const double zero : expected) {
          if (std::min(zero - t.lo, t.hi - zero) < 1e-9) continue;
          ++found;
          ASSERT_TRUE(std::any_of(at.begin(), at.end(), [&](double hit) { return std::abs(hit - zero) < 1e-11; }))
              << function.text << ", line " << i << " at " << zero;
        }
        std::vector<SurfaceHit> hits;
        open.all_hits(line, Interval::entire(), hits);
        for (const SurfaceHit& hit : hits) {
          // Two zeros nearer than the samples are hits as well: the function is small beside.
          const auto near = [&](double by) {
            const Vec3 p = line.at(hit.t + by);
            return std::abs(function.of(p.x, p.y, p.z));
          };
          ASSERT_LT(near(-1e-12) + near(1e-12), 0.9L * (near(-1e-6) + near(1e-6)))
              << function.text << ", line " << i << " at " << hit.t;
          const ShapePoint point = open.point(hit, line.at(hit.t));
          ASSERT_LE(glm::length(point.position - line.at(hit.t)), 1e-9) << function.text << ", line " << i;
          ASSERT_NEAR(glm::length(point.normal), 1, 1e-12) << function.text << ", line " << i;
          ASSERT_LE(point.error, 1e-6);
        }
        ASSERT_EQ(places(closed, line).size() % 2, 0U) << function.text << ", line " << i;
      }
      EXPECT_GT(found, 0) << function.text;
    }
}

// z = cbrt(x) is x = z^3, whose normal is known everywhere.
TEST(ImplicitSurface, NormalsAndPlacesAreRightWhereTheGradientIsInfinite) {
  const ImplicitSurface shape = surface("cbrt(x) - z", cube(2));
  std::mt19937_64 random(10);
  const auto check = [&](const Line& line, double t) {
    std::vector<SurfaceHit> hits;
    shape.all_hits(line, Interval::entire(), hits);
    const auto hit =
        std::find_if(hits.begin(), hits.end(), [&](const SurfaceHit& h) { return std::abs(h.t - t) < 1e-11; });
    ASSERT_NE(hit, hits.end());
    const ShapePoint at = shape.point(*hit, line.at(hit->t));
    const double z = at.position.z;
    EXPECT_LE(std::abs(at.position.x - z * z * z), at.error + 4e-15);
    EXPECT_LE(at.error, 1e-12);
    EXPECT_LE(glm::length(at.normal - glm::normalize(Vec3(1, 0, -3 * z * z))), 1e-7);
  };
  for (const double z : {0.0, 1e-9, 1e-5, 1e-3, 0.1, 1.0}) {
    check({{-3, 0.1, z}, {1, 0, 0}}, 3 + z * z * z);
    for (int i = 0; i < tests::tier_count(10000); ++i) {
      const Vec3 d = random_direction(random);
      if (std::abs(d.x - 3 * z * z * d.z) < 0.2) continue;
      check({Vec3(z * z * z, 0.1, z) - 3.0 * d, d}, 3);
    }
  }
}

// sin(1/x): zeros at 1/(k pi), without end towards x = 0. Those that can be told apart are found on both sides.
TEST(ImplicitSurface, OscillationWithoutEndHidesNothingBehind) {
  for (const char* way : {"", " + 0*floor(y)"}) {
    const ImplicitSurface shape = surface(std::string("sin(1/x)") + way, cube(1, {0.06, 0, 0}));
    const std::vector<double> t = places(shape, {{-2, 0.1, 0.2}, {1, 0, 0}});
    for (int k = 1; k <= 20; ++k)
      for (const double x : {1 / (k * M_PI), -1 / (k * M_PI)})
        EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](double at) { return std::abs(at - 2 - x) < 1e-11; })) << x;
  }
}

TEST(ImplicitSurface, LinesThatAreNotFiniteMeetNothing) {
  const double none = std::nan("");
  for (const ImplicitSurface& shape : {surface(kGyroid, cube(5), true), surface("x", cube(1), true)})
    for (const double bad : {none, kInfinity, -kInfinity})
      for (int k = 0; k < 3; ++k) {
        Vec3 p(0.1, 0.2, 0.3), d(1, 0, 0);
        p[k] = bad;
        EXPECT_TRUE(places(shape, {p, {1, 0, 0}}).empty());
        d[k] = bad;
        EXPECT_TRUE(places(shape, {{0.1, 0.2, 0.3}, d}).empty());
      }
}

// Whitney's umbrella x^2 = y^2 z: for z > 0 two sheets cross in the axis, which must not be a gap; for z < 0 the axis
// alone is F = 0, its handle, which no line is to meet.
TEST(ImplicitSurface, SheetsThatCrossHaveNoGapAndHandlesDoNotShow) {
  for (const char* way : {"", kNoPolynomial})
    for (const bool negated : {false, true}) {
      const ImplicitSurface umbrella =
          surface(std::string(negated ? "y^2*z - x^2" : "x^2 - y^2*z") + way, ImplicitRegion::ball(Vec3(0), 1));
      for (int i = 0; i < 50; ++i) {
        const double angle = 0.1 + 0.12 * i;
        const Vec3 d(std::cos(angle), std::sin(angle), 0);
        for (const double z : {0.1, 0.5, 0.75}) {
          const std::vector<double> above = places(umbrella, {Vec3(0, 0, z) - 2.0 * d, d});
          ASSERT_EQ(above.size() % 2, 0U);
          ASSERT_TRUE(std::any_of(above.begin(), above.end(), [](double t) { return std::abs(t - 2) < 1e-6; }))
              << angle;
          // Cells may end in the axis itself, where zero counts as positive.
          const size_t at_handle = places(umbrella, {Vec3(0, 0, -z) - 2.0 * d, d}).size();
          ASSERT_TRUE(at_handle == 0 || (*way && negated && at_handle == 2)) << angle;
        }
      }
    }
}

TEST(ImplicitSurface, LevelMovesTheSurface) {
  const ImplicitSurface shape = surface("x^2 + y^2 + z^2", cube(3), false, 4);
  const std::vector<double> t = places(shape, {{-5, 0, 0}, {2, 0, 0}});
  ASSERT_EQ(t.size(), 2U);
  EXPECT_NEAR(t[0], 1.5, 1e-14);
  EXPECT_NEAR(t[1], 3.5, 1e-14);
  EXPECT_LE(shape.bounds().hi.x, 2.3);
}

TEST(ImplicitSurface, RefusesWhatIsNoSurface) {
  const auto message = [](const std::string& text, const ImplicitRegion& region) -> std::string {
    try {
      surface(text, region);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what();
    }
    return "";
  };
  EXPECT_EQ(message("log(x)", cube(1)), "formula: the formula has no value at x = -1, y = -1, z = -1");
  EXPECT_EQ(message("sin(2)", cube(1)), "formula: the formula is constant: it names none of x, y, z");
  EXPECT_EQ(message("x", cube(0)), "box: the region is empty");
  EXPECT_EQ(message("x^2 + 1", cube(1)),
            "box: the surface does not meet the region: the formula is larger than the level there");
  EXPECT_EQ(message("exp(x)", ImplicitRegion::ball(Vec3(0), 1)),
            "ball: the surface does not meet the region: the formula is larger than the level there");
}

}  // namespace
}  // namespace lekalo::geometry::implicit_surface_test
