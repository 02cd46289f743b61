// Surfaces by formulas: their derivatives and enclosures, and lines against them, compared with closed forms (torus)
// and, where the formulas are polynomials, with the halving oracle on the Bezier patch that they are.
#include "geometry/surfaces/analytic/formula_surface.h"

#include <algorithm>
#include <random>

#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/line_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::formula_surface_test {
namespace {

FormulaSurface surface(const std::array<std::string, 3>& point, const Rectangle& domain,
                       FormulaSurface::Closed closed = {}, Coordinates coordinates = Coordinates::cartesian) {
  return FormulaSurface(point_formulas(point, {"u", "v"}, coordinates), domain, closed);
}

FormulaSurface klein_bottle() {
  const std::string radius = "(2 + cos(u/2)*sin(v) - sin(u/2)*sin(2*v))";
  return surface({radius + "*cos(u)", radius + "*sin(u)", "sin(u/2)*sin(v) + cos(u/2)*sin(2*v)"},
                 {{0, kTwoPi}, {0, kTwoPi}}, {false, true});
}

const std::array<std::string, 3> kEnneper{"u - u^3/3 + u*v^2", "v - v^3/3 + v*u^2", "u^2 - v^2"};

TEST(FormulaSurface, MeetsTheGeneralChecks) {
  for (const FormulaSurface& one : {klein_bottle(), surface(kEnneper, {{-1.8, 1.8}, {-1.8, 1.8}}),
                                    surface({"u", "v", "sin(u)*exp(-v^2)/(2 + u*v)"}, {{-1, 1}, {-1, 1}})}) {
    checks::check_differences(one, one.domain());
    checks::check_normals(one, one.domain());
    checks::check_degenerate_edges(one);
    checks::check_enclosures(one, one.domain());
    checks::check_pieces(one);
    checks::check_periods(one, one.domain());
  }
}

TEST(FormulaSurface, KnowsPolesAndOtherCoordinates) {
  const FormulaSurface ball =
      surface({"2", "u", "v"}, {{0, kTwoPi}, {-0.5 * kPi, 0.5 * kPi}}, {true, false}, Coordinates::spherical);
  EXPECT_TRUE(ball.degenerate_edges().v_min && ball.degenerate_edges().v_max);
  EXPECT_LE(glm::length(ball.normal(1, 0.5 * kPi) - Vec3(0, 0, 1)), 1e-9);
  EXPECT_LE(glm::length(ball.point(0.5, 0.3) -
                        2.0 * Vec3(std::cos(0.3) * std::cos(0.5), std::cos(0.3) * std::sin(0.5), std::sin(0.3))),
            1e-15);
}

TEST(FormulaSurface, RefusesWhatIsNoSurface) {
  EXPECT_THROW(surface({"u", "v", "log(u)"}, {{0, 1}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(surface({"u", "v", "0"}, {{0, 0}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(surface({"cos(u)", "sin(u)", "v"}, {{0, 6}, {0, 1}}, {true, false}), std::invalid_argument);
  EXPECT_THROW(surface({"u", "v", "0"}, {{0, 1}, {0, 1}}, {false, true}), std::invalid_argument);
}

// Counts of hits at the line and at lines moved by 1e-9 of the size: where they differ the line is a tangent.
template <class Count>
bool is_tangent(const Line& line, double size, const Count& count) {
  const int here = count(line);
  for (const Vec3& shift : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    for (const double by : {-1e-9, 1e-9})
      if (count(Line{line.origin + by * size * shift, line.direction}) != here) return true;
  return false;
}

template <class Truth>
void compare(const Surface& given, const SurfacePtr& target, int lines, const Truth& truth) {
  const LineIntersector intersector(target);
  const Box3 box = bounds(given);
  const double size = box.diameter();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int hits = 0, tangents = 0;
  for (int i = 0; i < lines; ++i) {
    const Vec3 d = checks::random_direction(random);
    const Vec3 aim = box.lo + Vec3(unit(random), unit(random), unit(random)) * box.size();
    const Line line{aim - 2 * size * d, d};
    const std::vector<double> expected = truth(line);
    const std::vector<SurfaceHit> found = intersector.all_hits(line);
    hits += static_cast<int>(found.size());
    bool same = found.size() == expected.size();
    for (size_t k = 0; same && k < found.size(); ++k) same = std::abs(found[k].t - expected[k]) <= 1e-9 * size;
    if (same) continue;
    ASSERT_TRUE(is_tangent(line, size, [&](const Line& moved) { return static_cast<int>(truth(moved).size()); }))
        << "line " << i << ": " << found.size() << " hits, expected " << expected.size();
    ++tangents;
  }
  EXPECT_GT(hits, lines / 4);
  EXPECT_LE(tangents, lines / 100 + 1);
}

TEST(FormulaSurface, LinesMeetATorusWhereItsClosedFormSays) {
  const auto formulas = std::make_shared<FormulaSurface>(surface(
      {"(2 + 0.7*cos(v))*cos(u)", "(2 + 0.7*cos(v))*sin(u)", "0.7*sin(v)"}, {{0, kTwoPi}, {-kPi, kPi}}, {true, true}));
  const TorusSurface torus(Frame(), 2, 0.7);
  compare(torus, formulas, tests::tier_count(30000), [&](const Line& line) {
    LineHits hits;
    torus.line_hits(line, Interval::entire(), hits);
    std::vector<double> t;
    for (int i = 0; i < hits.size(); ++i) t.push_back(hits[i].t);
    std::sort(t.begin(), t.end());
    return t;
  });
}

// Bernstein coefficient k of degree 3 of the power x^i over the range: its blossom, a mean of products.
double coefficient(int i, int k, const Interval& range) {
  std::array<double, 3> x;
  for (int m = 0; m < 3; ++m) x[m] = m < k ? range.hi : range.lo;
  switch (i) {
    case 0:
      return 1;
    case 1:
      return (x[0] + x[1] + x[2]) / 3;
    case 2:
      return (x[0] * x[1] + x[1] * x[2] + x[2] * x[0]) / 3;
    default:
      return x[0] * x[1] * x[2];
  }
}

TEST(FormulaSurface, LinesMeetEnneperWhereTheOracleSays) {
  const Interval side(-1.8, 1.8);
  std::vector<Vec4> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto power = [&](int a, int b) { return coefficient(a, i, side) * coefficient(b, j, side); };
      points.push_back({power(1, 0) - power(3, 0) / 3 + power(1, 2), power(0, 1) - power(0, 3) / 3 + power(2, 1),
                        power(2, 0) - power(0, 2), 1});
    }
  const oracle::PatchOracle oracle(points, 3, 3);
  const auto enneper = std::make_shared<FormulaSurface>(surface(kEnneper, {side, side}));
  compare(*enneper, enneper, tests::tier_count(20000), [&](const Line& line) {
    std::vector<double> t;
    for (const oracle::Root& root : oracle.roots(line)) t.push_back(root.t);
    return t;
  });
}

using Polynomial = std::vector<long double>;  // by powers of t

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial result(a.size() + b.size() - 1);
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  return result;
}
Polynomial sum(const Polynomial& a, const Polynomial& b, long double factor) {
  Polynomial result(std::max(a.size(), b.size()));
  for (size_t i = 0; i < a.size(); ++i) result[i] += a[i];
  for (size_t i = 0; i < b.size(); ++i) result[i] += factor * b[i];
  return result;
}

// The changes of sign between lo and hi: between two neighbouring zeros of the derivative there is at most one.
std::vector<long double> zeros(const Polynomial& p, long double lo, long double hi) {
  if (p.size() < 2) return {};
  const auto value = [&](long double t) {
    long double result = 0;
    for (size_t i = p.size(); i > 0; --i) result = result * t + p[i - 1];
    return result;
  };
  Polynomial slope;
  for (size_t i = 1; i < p.size(); ++i) slope.push_back(static_cast<long double>(i) * p[i]);
  std::vector<long double> ends = zeros(slope, lo, hi), result;
  ends.insert(ends.begin(), lo);
  ends.push_back(hi);
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    long double a = ends[i], b = ends[i + 1];
    const bool rising = value(a) < 0;
    if (rising == (value(b) < 0)) continue;
    for (int step = 0; step < 80; ++step) {
      const long double middle = (a + b) / 2;
      ((value(middle) < 0) == rising ? a : b) = middle;
    }
    result.push_back((a + b) / 2);
  }
  return result;
}

std::array<Polynomial, 3> coordinates(const Line& line) {
  std::array<Polynomial, 3> result;
  for (int k = 0; k < 3; ++k) result[k] = {line.origin[k], line.direction[k]};
  return result;
}

TEST(FormulaSurface, LinesMeetWhitneysUmbrellaWhereItsEquationSays) {
  const auto umbrella = std::make_shared<FormulaSurface>(surface({"u*v", "u", "v^2"}, {{-1.2, 1.2}, {-1.2, 1.2}}));
  compare(*umbrella, umbrella, tests::tier_count(20000), [](const Line& line) {
    const auto [x, y, z] = coordinates(line);
    std::vector<double> result;
    for (const long double t : zeros(sum(product(x, x), product(product(y, y), z), -1), -100, 100)) {
      const Vec3 p = line.at(static_cast<double>(t));
      if (std::abs(p.y) <= 1.2 && std::abs(p.x) <= 1.2 * std::abs(p.y)) result.push_back(static_cast<double>(t));
    }
    return result;
  });
}

// z = h(x, y) with h convex, over the square: along a line h - z is convex, so that its least place lies between its
// zeros, of which there are at most two.
template <class Height>
std::vector<double> convex_zeros(const Line& line, const Height& h) {
  using Long = long double;
  const auto excess = [&](Long t) {
    const Long x = line.origin.x + t * line.direction.x, y = line.origin.y + t * line.direction.y;
    return h(x, y) - (line.origin.z + t * line.direction.z);
  };
  Long lo = -100, hi = 100;
  for (int k = 0; k < 2; ++k) {
    if (line.direction[k] == 0) {
      if (std::abs(line.origin[k]) > 1) return {};
      continue;
    }
    const Long a = (-1 - (Long)line.origin[k]) / line.direction[k], b = (1 - (Long)line.origin[k]) / line.direction[k];
    lo = std::max(lo, std::min(a, b)), hi = std::min(hi, std::max(a, b));
  }
  if (lo > hi) return {};
  Long a = lo, b = hi;
  while (b - a > 1e-17L * (1 + std::abs(a))) {
    const Long third = (b - a) / 3, p = a + third, q = b - third;
    if (!(a < p && p < q && q < b)) break;
    (excess(p) < excess(q) ? b : a) = excess(p) < excess(q) ? q : p;
  }
  const Long least = excess(a) < excess(b) ? a : b;
  if (excess(least) > 0) return {};
  std::vector<double> result;
  for (Long outer : {lo, hi}) {
    if (excess(outer) < 0) continue;
    Long inner = least;
    for (int step = 0; step < 200; ++step) {
      const Long middle = 0.5L * (inner + outer);
      (excess(middle) > 0 ? outer : inner) = middle;
    }
    result.push_back(static_cast<double>(inner));
  }
  return result;
}

// Surfaces whose formulas have roots and powers that come to zero inside of the domain: a cone's tip, points where the
// derivatives end after the second or fourth, a line of such. Random lines, and lines that pass the singular place at
// distances down to nothing.
TEST(FormulaSurface, LinesMeetRootsOfZeroWhereConvexFunctionsSay) {
  const auto check = [](const std::string& z, auto height) {
    SCOPED_TRACE(z);
    const auto target = std::make_shared<FormulaSurface>(surface({"u", "v", z}, {{-1, 1}, {-1, 1}}));
    const auto truth = [&](const Line& line) { return convex_zeros(line, height); };
    compare(*target, target, tests::tier_count(20000), truth);
    const LineIntersector intersector(target);
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < tests::tier_count(20000); ++i) {
      // Steeper than the surface near the origin.
      const double turn = kTwoPi * unit(random), lean = 0.4 * unit(random);
      const double off = i % 8 == 0 ? 0 : std::pow(10.0, -12 * unit(random)), beside = kTwoPi * unit(random);
      const Vec3 d =
          i % 16 == 0 ? Vec3(0, 0, -1) : glm::normalize(Vec3(lean * std::cos(turn), lean * std::sin(turn), -1));
      const Line line{off * Vec3(std::cos(beside), std::sin(beside), 0) - 2.0 * d, d};
      const std::vector<SurfaceHit> found = intersector.all_hits(line);
      const std::vector<double> expected = truth(line);
      ASSERT_EQ(found.size(), expected.size()) << i << " off " << off;
      for (size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k].t, expected[k], 1e-9) << i << " off " << off;
        EXPECT_LE(glm::length(target->point(found[k].u, found[k].v) - line.at(found[k].t)), 1e-9) << i;
      }
    }
  };
  const auto r = [](long double x, long double y) { return std::sqrt(x * x + y * y); };
  check("sqrt(u^2 + v^2)", r);
  check("(u^2 + v^2)^1.5", [&](long double x, long double y) { return std::pow(r(x, y), 3); });
  check("(u^2 + v^2)^2.5", [&](long double x, long double y) { return std::pow(r(x, y), 5); });
  check("abs(u)^1.5", [](long double x, long double) { return std::pow(std::abs(x), 1.5L); });
}

// Lines that lie in a surface along its singular points, or touch it there: two hits or none.
TEST(FormulaSurface, LinesAlongSingularPointsAreTangents) {
  const auto hits = [](const std::array<std::string, 3>& point, const Line& line) {
    return LineIntersector(std::make_shared<FormulaSurface>(surface(point, {{-1, 1}, {-1, 1}}))).all_hits(line).size();
  };
  EXPECT_LE(hits({"u", "v", "abs(u)^1.5"}, {{0, -5, 0}, {0, 1, 0}}), 2u);
  EXPECT_LE(hits({"u^2", "u^3", "v"}, {{0, 0, -5}, {0, 0, 1}}), 2u);
  EXPECT_LE(hits({"u*v", "u", "v^2"}, {{0, 0, -5}, {0, 0, 1}}), 2u);
  EXPECT_LE(hits({"u", "v", "cbrt(u)"}, {{0, -5, 0}, {0, 1, 0}}), 2u);
}

// Lines in a plane u = c meet (u v, u, v^2 + u) where they meet the parabola there. A cell that is clipped to the plane
// alone is soon thinner than the rounding of the surface's points.
TEST(FormulaSurface, LinesAcrossOneParameterMeetItsParabola) {
  const LineIntersector intersector(
      std::make_shared<FormulaSurface>(surface({"u*v", "u", "v^2 + u"}, {{0.2, 1}, {-1, 1}})));
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < tests::tier_count(100000); ++i) {
    const double u = 0.21 + 0.78 * unit(random), first = -0.99 + 1.98 * unit(random),
                 second = -0.99 + 1.98 * unit(random);
    if (std::abs(first - second) < 1e-3) continue;
    const Vec3 a(u * first, u, first * first + u), b(u * second, u, second * second + u);
    const Vec3 d = (b - a) / glm::length(b - a);  // d.y is 0
    const std::vector<SurfaceHit> found = intersector.all_hits({a - 2.0 * d, d});
    ASSERT_EQ(found.size(), 2u) << i << " " << u << " " << first << " " << second;
    EXPECT_NEAR(found[0].t, 2, 1e-9) << i;
    EXPECT_NEAR(found[1].t, 2 + glm::length(b - a), 1e-9) << i;
  }
}

// Lines that lie in the surface, through its double line, its pinch point and cells that are all singular: nothing is
// asked but that they end soon.
TEST(FormulaSurface, LinesInARuledSurfaceEnd) {
  const LineIntersector umbrella(
      std::make_shared<FormulaSurface>(surface({"u*v", "u", "v^2"}, {{-1.2, 1.2}, {-1.2, 1.2}})));
  for (const double v : {0.0, 0.3, 0.7345, 1.2})
    for (const double off : {0.0, 1e-15, 1e-12}) {
      const Vec3 d = glm::normalize(Vec3(v, 1, 0));
      const Vec3 p = Vec3(0, 0, v * v) + off * Vec3(0.3, -0.5, 0.8);
      EXPECT_LE(umbrella.all_hits({p - 2.0 * d, d}).size(), 4u) << v << " " << off;
    }
}

TEST(FormulaSurface, LinesMeetSteinersRomanSurfaceWhereItsEquationSays) {
  const auto roman = std::make_shared<FormulaSurface>(surface(
      {"cos(u)*cos(v)*sin(v)", "sin(u)*cos(v)*sin(v)", "cos(u)*sin(u)*cos(v)^2"}, {{0, kPi}, {-0.5 * kPi, 0.5 * kPi}}));
  compare(*roman, roman, tests::tier_count(20000), [](const Line& line) {
    const auto [x, y, z] = coordinates(line);
    const Polynomial xx = product(x, x), yy = product(y, y), zz = product(z, z);
    const Polynomial squares = sum(sum(product(xx, yy), product(yy, zz), 1), product(zz, xx), 1);
    std::vector<double> result;
    for (const long double t : zeros(sum(squares, product(product(x, y), z), -1), -100, 100))
      result.push_back(static_cast<double>(t));
    return result;
  });
}

// A closed surface is met an even number of times, on one side or on two.
TEST(FormulaSurface, LinesMeetClosedSurfacesAnEvenNumberOfTimes) {
  const std::string below = "/(2 - sqrt(2)*sin(3*u)*sin(2*v))";
  const std::vector<FormulaSurface> all{
      klein_bottle(), surface({"(sqrt(2)*cos(v)^2*cos(2*u) + cos(u)*sin(2*v))" + below,
                               "(sqrt(2)*cos(v)^2*sin(2*u) - sin(u)*sin(2*v))" + below, "3*cos(v)^2" + below},
                              {{-0.5 * kPi, 0.5 * kPi}, {0, kPi}}, {false, true})};
  for (const FormulaSurface& one : all) {
    const auto target = std::make_shared<FormulaSurface>(one);
    const LineIntersector intersector(target);
    const double size = bounds(one).diameter();
    std::mt19937_64 random(11);
    int hits = 0, odd = 0;
    const int lines = tests::tier_count(40000);
    for (int i = 0; i < lines; ++i) {
      const Vec3 d = checks::random_direction(random);
      const Vec2 place = checks::random_place(one.domain(), random);
      const Vec3 aim = one.point(place.x, place.y) + 0.1 * checks::random_direction(random);
      const int found = static_cast<int>(intersector.all_hits({aim - 2 * size * d, d}).size());
      hits += found;
      odd += found % 2;
    }
    EXPECT_GT(hits, lines);
    EXPECT_EQ(odd, 0);
  }
}

}  // namespace
}  // namespace lekalo::geometry::formula_surface_test
