// Lines of implicit surfaces against closed forms, against the silhouettes of the same torus as a parametric surface,
// and against an oracle that knows neither derivatives nor Newton's iteration: where random planes cross the lines is
// found by halving squares of the plane with the bounds of formulas that are written here.
#include "geometry/shapes/implicit/implicit_contours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/numerics/jet3.h"
#include "geometry/numerics/triple.h"
#include "geometry/quad.h"
#include "geometry/surfaces/analytic/torus.h"
#include "support/curve_places.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::implicit_contours_test {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  Vec3 unit() {
    for (;;) {
      const Vec3 v(number(-1, 1), number(-1, 1), number(-1, 1));
      if (glm::length(v) < 1 && glm::length(v) > 0.1) return glm::normalize(v);
    }
  }
  // Of a thing of that size about the origin.
  ViewOf view(double size, bool central) {
    return central ? ViewOf{true, number(1.5, 5) * size * unit()} : ViewOf{false, unit()};
  }

 private:
  std::mt19937 engine_;
};

Expression formula(const std::string& text) {
  auto parsed = Expression::parse(text);
  Expression& result = std::get<Expression>(parsed);
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  EXPECT_FALSE(result.bind(variables)) << text;
  return result;
}

ImplicitRegion cube(double half) { return {{Vec3(-half), Vec3(half)}}; }

Vec3 sight_at(const ViewOf& view, const Vec3& p) {
  return view.central ? p - view.direction_or_eye : view.direction_or_eye;
}

template <class Visit>
void each_place(const ImplicitContour& line, int places, const Visit& visit) {
  const Interval t = line.curve->domain();
  for (int k = 0; k <= places; ++k) visit(line.curve->point(t.lo + t.width() * k / places));
}

constexpr int kChords = 4000;  // of a line

TEST(ImplicitContours, OutlineOfASphere) {
  const ImplicitSurface sphere(formula("x^2 + y^2 + z^2"), 2.25, cube(2), false);
  Dice dice(3);
  for (int k = 0; k < 20; ++k) {
    const ViewOf view = dice.view(1.5, k % 2);
    const ImplicitContours found = silhouette(sphere, view);
    EXPECT_TRUE(found.complete);
    ASSERT_EQ(found.lines.size(), 1u);
    const ImplicitContour& line = found.lines.front();
    EXPECT_TRUE(line.closed);
    EXPECT_TRUE(line.turns.empty());
    const double d = view.central ? glm::length(view.direction_or_eye) : 0;
    // From an eye e the points of contact lie in the plane p . e = R^2.
    const double height = view.central ? 2.25 / d : 0, radius = std::sqrt(2.25 - height * height);
    const Vec3 axis = glm::normalize(view.direction_or_eye);
    each_place(line, 100, [&](const Vec3& p) {
      EXPECT_NEAR(glm::length(p), 1.5, 1e-12);
      EXPECT_NEAR(glm::dot(p, axis), height, 1e-12);
    });
    EXPECT_NEAR(lekalo::checks::chord_length(*line.curve, kChords), kTwoPi * radius, 1e-4);
    // Aside is away from the centre.
    ASSERT_TRUE(line.outward_offset);
    for (const double share : {0.1, 0.4, 0.9}) {
      const double t = share * line.curve->domain().hi;
      EXPECT_LT(glm::length(line.outward_offset->point(t) - line.curve->point(t) / 1.5), 1e-3);
    }
  }
}

// The loops of the outline, its cusps and its points, as those of the torus by its parameters.
TEST(ImplicitContours, OutlineOfATorusAsOfTheParametricOne) {
  const double R = 1, r = 0.4;
  const ImplicitSurface ring(formula("(x^2 + y^2 + z^2 + 0.84)^2 - 4*(x^2 + y^2)"), 0, cube(1.5), false);
  const SurfacePtr torus = std::make_shared<TorusSurface>(Frame(), R, r);
  Dice dice(5);
  int cusps = 0;
  const int count = tests::tier_count(1000, tests::min_of_slow(30));
  for (int k = 0; k < count; ++k) {
    const ViewOf view = dice.view(1.4, k % 2);
    const ImplicitContours found = silhouette(ring, view);
    const Contours truth = silhouette(torus, view);
    ASSERT_TRUE(found.complete && truth.complete) << k;
    ASSERT_EQ(found.lines.size(), truth.branches.size()) << k;
    std::vector<Vec3> found_cusps, true_cusps;
    double found_length = 0, true_length = 0;
    for (const ImplicitContour& line : found.lines) {
      EXPECT_TRUE(line.closed);
      found_length += lekalo::checks::chord_length(*line.curve, kChords);
      for (const double t : line.turns) found_cusps.push_back(line.curve->point(t));
      each_place(line, 100, [&](const Vec3& p) {
        const double rho = std::hypot(p.x, p.y);
        EXPECT_NEAR(std::hypot(rho - R, p.z), r, 1e-12);
        const Vec3 normal(p.x * (rho - R) / rho, p.y * (rho - R) / rho, p.z);
        EXPECT_NEAR(glm::dot(normal, glm::normalize(sight_at(view, p))), 0, 1e-11);
      });
    }
    for (const Contour& branch : truth.branches) {
      true_length += lekalo::checks::chord_length(*branch.curve, kChords);
      for (const double t : branch.cusps) true_cusps.push_back(branch.curve->point(t));
    }
    EXPECT_NEAR(found_length, true_length, 1e-4 * true_length) << k;
    ASSERT_EQ(found_cusps.size(), true_cusps.size()) << k;
    for (const Vec3& cusp : true_cusps)
      EXPECT_TRUE(std::any_of(found_cusps.begin(), found_cusps.end(), [&](const Vec3& p) {
        return glm::length(p - cusp) < 1e-9;
      })) << k;
    cusps += static_cast<int>(true_cusps.size());
  }
  EXPECT_GT(cusps, count);
  tests::report_figure("cusps", cusps);
}

TEST(ImplicitContours, CylinderInABox) {
  for (const bool closed : {false, true}) {
    const ImplicitSurface cylinder(formula("x^2 + y^2"), 1, {{Vec3(-1.5, -1.5, -2), Vec3(1.5, 1.5, 2)}}, closed);
    const ViewOf view{false, glm::normalize(Vec3(3, 4, 2))};
    const ImplicitContours outline = silhouette(cylinder, view), rim = border(cylinder, view);
    EXPECT_TRUE(outline.complete && rim.complete);
    ASSERT_EQ(outline.lines.size(), 2u);
    for (const ImplicitContour& line : outline.lines) {
      each_place(line, 20, [&](const Vec3& p) {
        EXPECT_NEAR(std::abs(p.x), 0.8, 1e-12);
        EXPECT_NEAR(p.x * 3 + p.y * 4, 0, 1e-12);
      });
      EXPECT_NEAR(lekalo::checks::chord_length(*line.curve, kChords), 4, 1e-11);
    }
    ASSERT_EQ(rim.lines.size(), 2u);
    for (const ImplicitContour& line : rim.lines) {
      EXPECT_TRUE(line.closed);
      each_place(line, 50, [](const Vec3& p) {
        EXPECT_NEAR(std::abs(p.z), 2, 1e-14);
        EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-12);
      });
      ASSERT_EQ(line.turns.size(), 2u);
      for (const double t : line.turns) EXPECT_NEAR(std::abs(line.curve->point(t).x), 0.8, 1e-9);
    }
    // Along its axis it is seen edge-on.
    const ImplicitContours along = silhouette(cylinder, {false, {0, 0, 1}});
    EXPECT_TRUE(along.complete);
    EXPECT_TRUE(along.lines.empty());
  }
}

// A ball that a box cuts off on all sides: arcs of circles, and parts of the box's edges between them.
TEST(ImplicitContours, EdgesOfABoxThatEndABall) {
  const ImplicitSurface ball(formula("x^2 + y^2 + z^2 - 1"), 0, cube(0.6), true);
  const ImplicitContours edges = border(ball, {true, {3, 4, 5}});
  EXPECT_TRUE(edges.complete);
  const double reach = std::sqrt(1 - 2 * 0.36);
  int arcs = 0, straight = 0;
  for (const ImplicitContour& line : edges.lines) {
    const Vec3 middle = line.curve->point(line.curve->domain().middle());
    if (glm::length(middle) > 1 - 1e-9) {
      ++arcs;
      each_place(line, 20, [](const Vec3& p) { EXPECT_NEAR(glm::length(p), 1, 1e-12); });
    } else {
      ++straight;
      EXPECT_NEAR(lekalo::checks::chord_length(*line.curve, kChords), 2 * reach, 1e-12);
    }
  }
  EXPECT_EQ(arcs, 24);
  EXPECT_EQ(straight, 12);
}

// Half of a ball: the plane is the formula, the ball its region.
TEST(ImplicitContours, BallThatEndsAHalfSpace) {
  const ImplicitSurface half(formula("z - 0.2"), 0, ImplicitRegion::ball({0, 0, 0}, 1), true);
  Dice dice(7);
  for (int k = 0; k < 20; ++k) {
    const ViewOf view = dice.view(1, k % 2);
    const ImplicitContours rim = border(half, view), outline = silhouette(half, view);
    EXPECT_TRUE(rim.complete && outline.complete);
    ASSERT_EQ(rim.lines.size(), 1u);
    EXPECT_TRUE(rim.lines.front().closed);
    each_place(rim.lines.front(), 50, [](const Vec3& p) {
      EXPECT_NEAR(p.z, 0.2, 1e-13);
      EXPECT_NEAR(glm::length(p), 1, 1e-12);
    });
    // The great circle that is seen, as far as it lies below the plane.
    const double height = view.central ? 1 / glm::length(view.direction_or_eye) : 0;
    const Vec3 axis = glm::normalize(view.direction_or_eye);
    double length = 0;
    for (const ImplicitContour& line : outline.lines) {
      length += lekalo::checks::chord_length(*line.curve, kChords);
      each_place(line, 50, [&](const Vec3& p) {
        EXPECT_LE(p.z, 0.2 + 1e-9);
        EXPECT_NEAR(glm::length(p), 1, 1e-12);
        EXPECT_NEAR(glm::dot(p, axis), height, 1e-12);
      });
    }
    // z = height axis.z + radius sin(axis, z) cos t.
    const double radius = std::sqrt(1 - height * height), steep = std::hypot(axis.x, axis.y);
    const double cosine = (0.2 - height * axis.z) / (radius * steep);
    const double truth = cosine >= 1 ? kTwoPi : cosine <= -1 ? 0 : kTwoPi - 2 * std::acos(cosine);
    EXPECT_NEAR(length, radius * truth, 1e-4);
  }
}

TEST(ImplicitContours, SectionsOfATorus) {
  const ImplicitSurface ring(formula("(x^2 + y^2 + z^2 + 0.84)^2 - 4*(x^2 + y^2)"), 0, cube(1.5), false);
  const ViewOf view{false, {0, 0, -1}};
  const ImplicitContours level = plane_section(ring, {0, 0, 0.1}, {0, 0, 2}, view);
  EXPECT_TRUE(level.complete);
  ASSERT_EQ(level.lines.size(), 2u);
  for (const ImplicitContour& line : level.lines)
    each_place(line, 50, [](const Vec3& p) {
      EXPECT_NEAR(std::abs(std::hypot(p.x, p.y) - 1), std::sqrt(0.16 - 0.01), 1e-12);
      EXPECT_NEAR(p.z, 0.1, 1e-13);
    });
  EXPECT_TRUE(plane_section(ring, {0, 0, 0.41}, {0, 0, 1}, view).lines.empty());
  EXPECT_TRUE(plane_section(ring, {0, 0, 4}, {0, 0, 1}, view).lines.empty());
  // Of a closed solid that its region cuts off, a ball in a box: circle and square.
  const ImplicitSurface ball(formula("x^2 + y^2 + z^2 - 1"), 0, cube(0.8), true);
  double straight = 0, round = 0;
  for (const ImplicitContour& line : plane_section(ball, {0, 0, 0}, {0, 0, 1}, view).lines) {
    const double length = lekalo::checks::chord_length(*line.curve, kChords);
    (glm::length(line.curve->point(line.curve->domain().middle())) > 1 - 1e-9 ? round : straight) += length;
  }
  EXPECT_NEAR(straight, 4 * 2 * 0.6, 1e-9);
  EXPECT_NEAR(round, kTwoPi - 4 * 2 * std::acos(0.8), 1e-5);
}

// Formulas once more, for numbers of any kind; `text` is what the product reads.
struct Clebsch {
  static constexpr const char* text =
      "81*(x^3 + y^3 + z^3) - 189*(x^2*(y + z) + y^2*(x + z) + z^2*(x + y)) + 54*x*y*z + 126*(x*y + y*z + z*x)"
      " - 9*(x^2 + y^2 + z^2) - 9*(x + y + z) + 1";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return T(81.0) * (x * x * x + y * y * y + z * z * z) -
           T(189.0) * (x * x * (y + z) + y * y * (x + z) + z * z * (x + y)) + T(54.0) * x * y * z +
           T(126.0) * (x * y + y * z + z * x) - T(9.0) * (x * x + y * y + z * z) - T(9.0) * (x + y + z) + T(1.0);
  }
  static ImplicitRegion region() { return ImplicitRegion::ball({0, 0, 0}, 2); }
};
struct Gyroid {
  static constexpr const char* text = "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    using std::cos, std::sin;
    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
  }
  static ImplicitRegion region() { return cube(3.3); }
};
struct TwoRings {
  static constexpr const char* text = "(x*(x - 1)^2*(x - 2) + y^2)^2 + z^2 - 0.01";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a = x * (x - T(1.0)) * (x - T(1.0)) * (x - T(2.0)) + y * y;
    return a * a + z * z - T(0.01);
  }
  static ImplicitRegion region() { return {{Vec3(-0.4, -1, -0.5), Vec3(2.4, 1, 0.5)}}; }
};
struct Barth {
  static constexpr const char* text =
      "4*(2.618033988749895*x^2 - y^2)*(2.618033988749895*y^2 - z^2)*(2.618033988749895*z^2 - x^2)"
      " - 4.23606797749979*(x^2 + y^2 + z^2 - 1)^2";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a(2.618033988749895), r = x * x + y * y + z * z - T(1.0);
    return T(4.0) * (a * x * x - y * y) * (a * y * y - z * z) * (a * z * z - x * x) - T(4.23606797749979) * r * r;
  }
  static ImplicitRegion region() { return ImplicitRegion::ball({0, 0, 0}, 2); }
};

// F and grad F . s by numbers of any kind; the derivatives by those of `Gradient`.
template <class F, class T>
std::pair<T, T> equations(const ViewOf& view, const T& x, const T& y, const T& z) {
  using G = Gradient<T>;
  const G f = F()(G::variable(x, 0), G::variable(y, 1), G::variable(z, 2));
  const Vec3& v = view.direction_or_eye;
  const Triple<T> place{x, y, z}, given{T(v.x), T(v.y), T(v.z)};
  const Triple<T> sight = view.central ? place - given : given;
  return {f.c[0], f.c[1] * sight.x + f.c[2] * sight.y + f.c[3] * sight.z};
}

// Whether both equations may hold in a part of a plane: by their ranges there, and by those of their derivatives from
// the middle on, which are narrower in small parts.
template <class F>
bool may_hold(const ViewOf& view, const Frame& plane, const Interval& u, const Interval& v) {
  const auto at = [&](const Interval& a, const Interval& b, int k) {
    return a * plane.x[k] + b * plane.y[k] + plane.origin[k];
  };
  const auto [f, g] = equations<F, Interval>(view, at(u, v, 0), at(u, v, 1), at(u, v, 2));
  if (!f.contains(0) || !g.contains(0)) return false;
  const Interval u0(u.middle()), v0(v.middle()), off[] = {u - u0, v - v0};
  const auto [f0, g0] = equations<F, Interval>(view, at(u0, v0, 0), at(u0, v0, 1), at(u0, v0, 2));
  using J = Jet3<Interval, 2>;
  const J all = F()(J::variable(at(u, v, 0), 0), J::variable(at(u, v, 1), 1), J::variable(at(u, v, 2), 2));
  const auto& c = all.c;
  const Interval second[3][3] = {{2 * c[4], c[5], c[6]}, {c[5], 2 * c[7], c[8]}, {c[6], c[8], 2 * c[9]}};
  Interval f_range = f0, g_range = g0;
  for (int side = 0; side < 2; ++side) {
    const Vec3& along = side == 0 ? plane.x : plane.y;
    Interval slope(0), turn(0);  // of F, and of grad F . s
    for (int k = 0; k < 3; ++k) {
      slope += along[k] * c[1 + k];
      const Interval sight = view.central ? at(u, v, k) - view.direction_or_eye[k] : Interval(view.direction_or_eye[k]);
      for (int m = 0; m < 3; ++m) turn += along[m] * second[k][m] * sight;
    }
    if (view.central) turn += slope;
    f_range += slope * off[side];
    g_range += turn * off[side];
  }
  return f_range.contains(0) && g_range.contains(0);
}

// How often a plane crosses the silhouette in a ball about the origin, by halving; -1: not clear.
template <class F>
int crossings_by_halving(const ViewOf& view, const Frame& plane, double reach, const ImplicitRegion& region) {
  constexpr int kDepth = 24;
  // In squares of the last size: of one crossing, and more is none; crossings that are told from what is left beside
  // one.
  constexpr long kApart = 3, kLargest = 40, kTold = 200;
  struct Square {
    long i, j;
  };
  std::vector<Square> level{{0, 0}};
  for (int depth = 0; depth <= kDepth; ++depth) {
    const double side = std::ldexp(2 * reach, -depth);
    std::vector<Square> left;
    for (const Square& square : level) {
      const Interval u{-reach + square.i * side, -reach + (square.i + 1) * side},
          v{-reach + square.j * side, -reach + (square.j + 1) * side};
      if (!may_hold<F>(view, plane, u, v)) continue;
      if (depth == kDepth)
        left.push_back(square);
      else
        for (const long a : {0, 1})
          for (const long b : {0, 1}) left.push_back({2 * square.i + a, 2 * square.j + b});
    }
    level.swap(left);
    if (level.size() > 200000) return -1;
  }
  int count = 0;
  std::vector<bool> taken(level.size(), false);
  std::vector<Square> corners;  // the lower ones of clusters
  for (size_t first = 0; first < level.size(); ++first) {
    if (taken[first]) continue;
    std::vector<size_t> cluster{first};
    taken[first] = true;
    long lo_i = level[first].i, hi_i = lo_i, lo_j = level[first].j, hi_j = lo_j;
    for (size_t k = 0; k < cluster.size(); ++k) {
      const Square one = level[cluster[k]];
      lo_i = std::min(lo_i, one.i), hi_i = std::max(hi_i, one.i);
      lo_j = std::min(lo_j, one.j), hi_j = std::max(hi_j, one.j);
      for (size_t other = 0; other < level.size(); ++other)
        if (!taken[other] && std::abs(level[other].i - one.i) <= kApart && std::abs(level[other].j - one.j) <= kApart)
          taken[other] = true, cluster.push_back(other);
    }
    if (hi_i - lo_i > kLargest || hi_j - lo_j > kLargest) return -1;
    for (const Square& other : corners)
      if (std::abs(other.i - lo_i) < kTold && std::abs(other.j - lo_j) < kTold) return -1;
    corners.push_back({lo_i, lo_j});
    const double side = std::ldexp(2 * reach, -kDepth);
    const Vec3 p = plane.point({-reach + 0.5 * (lo_i + hi_i + 1) * side, -reach + 0.5 * (lo_j + hi_j + 1) * side, 0});
    const double near = 50 * side;
    const Vec3 off = glm::abs(p - region.box.center()), half = 0.5 * region.box.size();
    const double beyond = region.is_ball ? glm::length(off) - region.radius()
                                         : std::max({off.x - half.x, off.y - half.y, off.z - half.z});
    if (std::abs(beyond) < near) return -1;
    if (beyond < 0) ++count;
  }
  return count;
}

// The same of the lines that were found; -1 where the plane nearly touches one.
int crossings_of(const ImplicitContours& found, const Frame& plane) {
  constexpr int kPlaces = 4000;
  int count = 0;
  for (const ImplicitContour& line : found.lines) {
    const Interval t = line.curve->domain();
    std::vector<double> height;
    for (int k = 0; k <= kPlaces; ++k)
      height.push_back(glm::dot(line.curve->point(t.lo + t.width() * k / kPlaces) - plane.origin, plane.z));
    for (int k = 0; k < kPlaces; ++k) {
      if ((height[k] < 0) != (height[k + 1] < 0)) ++count;
      const double step = std::abs(height[k + 1] - height[k]);
      if (k > 0 && (height[k] - height[k - 1]) * (height[k + 1] - height[k]) < 0 && std::abs(height[k]) < 3 * step)
        return -1;
    }
  }
  return count;
}

template <class F>
void expect_all_lines(const char* name, int views, int planes, unsigned seed, double allowed) {
  const ImplicitRegion region = F::region();
  const ImplicitSurface surface(formula(F::text), 0, region, false);
  const double size = region.box.diameter();
  Dice dice(seed);
  int asked = 0, unclear = 0, crossings = 0;
  double worst = 0;
  for (int k = 0; k < views; ++k) {
    const ViewOf view = dice.view(0.5 * size, k % 2);
    const ImplicitContours found = silhouette(surface, view);
    EXPECT_TRUE(found.complete) << name << ' ' << k;
    // In 113 bits; next to nodes, where grad F is small, places are as exact as the formula's rounding lets them be.
    for (const ImplicitContour& line : found.lines)
      each_place(line, 37, [&](const Vec3& p) {
        const auto [f, g] = equations<F, Quad>(view, Quad(p.x), Quad(p.y), Quad(p.z));
        const Vec3 slope = surface.gradient(p);
        const double steep = glm::length(slope);
        if (steep > 1e-2 * glm::length(surface.gradient(region.box.hi)))
          worst = tests::worse(worst, std::abs(static_cast<double>(f)) / steep);
      });
    for (int i = 0; i < planes; ++i) {
      const Frame plane = frame_about(region.box.center() + dice.number(-0.25, 0.25) * size * dice.unit(), dice.unit());
      const int truth = crossings_by_halving<F>(view, plane, size, region), ours = crossings_of(found, plane);
      ++asked;
      if (truth < 0 || ours < 0) {
        ++unclear;
        continue;
      }
      crossings += truth;
      EXPECT_EQ(ours, truth) << name << " view " << k << " plane " << i;
    }
  }
  EXPECT_LE(worst, 1e-12 * size) << name;
  EXPECT_LE(unclear, allowed * asked) << name;
  EXPECT_GT(crossings, asked) << name;
  tests::report_figure(std::string(name) + " planes", asked);
  tests::report_figure(std::string(name) + " unclear", unclear);
  tests::report_figure(std::string(name) + " crossings", crossings);
}

TEST(ImplicitContours, AllOutlinesOfACubic) {
  expect_all_lines<Clebsch>("cubic", tests::tier_count(100, 4), 6, 11, 0.1);
}
TEST(ImplicitContours, AllOutlinesOfAGyroid) {
  expect_all_lines<Gyroid>("gyroid", tests::tier_count(100, 4), 6, 13, 0.1);
}
TEST(ImplicitContours, AllOutlinesOfTwoRings) {
  expect_all_lines<TwoRings>("two_rings", tests::tier_count(100, 4), 6, 17, 0.1);
}
// The ends of lines at each node against the cone that F is there: two lines of it lie in the plane of the silhouette,
// or none.
template <class F>
void expect_ends_at_nodes(const char* name, const std::vector<Vec3>& nodes, int views, unsigned seed) {
  const ImplicitSurface surface(formula(F::text), 0, F::region(), false);
  Dice dice(seed);
  int asked = 0, passed = 0, unclear = 0;
  for (int k = 0; k < views; ++k) {
    const ViewOf view = dice.view(2.5, k % 2);
    const ImplicitContours found = silhouette(surface, view);
    EXPECT_TRUE(found.complete) << name << ' ' << k;
    for (const Vec3& node : nodes) {
      using J = Jet3<double, 2>;
      const J f = F()(J::variable(node.x, 0), J::variable(node.y, 1), J::variable(node.z, 2));
      const auto second = [&](const Vec3& v) {
        const auto& c = f.c;
        return Vec3(2 * c[4] * v.x + c[5] * v.y + c[6] * v.z, c[5] * v.x + 2 * c[7] * v.y + c[8] * v.z,
                    c[6] * v.x + c[8] * v.y + 2 * c[9] * v.z);
      };
      const Frame plane = frame_about(node, glm::normalize(second(sight_at(view, node))));
      const double xx = glm::dot(plane.x, second(plane.x)), xy = glm::dot(plane.x, second(plane.y)),
                   yy = glm::dot(plane.y, second(plane.y)), inside = xy * xy - xx * yy;
      if (std::abs(inside) < 1e-4 * (xy * xy + xx * xx + yy * yy)) {
        ++unclear;
        continue;
      }
      int ends = 0;
      for (const ImplicitContour& line : found.lines)
        for (const double t : {line.curve->domain().lo, line.curve->domain().hi})
          if (!line.closed && glm::length(line.curve->point(t) - node) < 1e-9) ++ends;
      EXPECT_EQ(ends, inside > 0 ? 4 : 0) << name << " view " << k << ' ' << node.x << ' ' << node.y << ' ' << node.z;
      ++asked;
      if (inside > 0) ++passed;
    }
  }
  EXPECT_GT(passed, asked / 4) << name;
  EXPECT_LE(unclear, 1 + asked / 50) << name;
  tests::report_figure(std::string(name) + " nodes", asked);
}

struct Cayley {
  static constexpr const char* text = "x^2 + y^2 + z^2 + 2*x*y*z - 1";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return x * x + y * y + z * z + T(2.0) * x * y * z - T(1.0);
  }
  static ImplicitRegion region() { return ImplicitRegion::ball({0, 0, 0}, 2.6); }
};

TEST(ImplicitContours, LinesLeadIntoNodesOfACubic) {
  expect_ends_at_nodes<Cayley>("cubic", {{1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {-1, -1, -1}},
                               tests::tier_count(500, tests::min_of_slow(20)), 23);
}

// The corners of a dodecahedron and of an icosidodecahedron: 50 of the 65 nodes, the others are at infinity.
TEST(ImplicitContours, LinesLeadIntoNodesOfASextic) {
  const double tau = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> nodes;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) {
        nodes.push_back({a, b, c});
        for (int k = 0; k < 3; ++k) {
          Vec3 p;
          p[k] = 0.5 * a * tau, p[(k + 1) % 3] = 0.5 * b / tau, p[(k + 2) % 3] = 0.5 * c;
          nodes.push_back(p);
        }
      }
      for (int k = 0; k < 3; ++k) {
        Vec3 p(0);
        p[(k + 1) % 3] = a / tau, p[(k + 2) % 3] = b * tau;
        nodes.push_back(p);
        if (b > 0) nodes.push_back(a * Vec3(k == 0, k == 1, k == 2));
      }
    }
  ASSERT_EQ(nodes.size(), 50u);
  expect_ends_at_nodes<Barth>("sextic", nodes, tests::tier_count(40, tests::min_of_slow(3)), 29);
}

// Creases are not found, and said to be missing.
TEST(ImplicitContours, KinksAreIncomplete) {
  const ImplicitSurface octahedron(formula("abs(x) + abs(y) + abs(z) - 1"), 0, cube(1.5), false);
  EXPECT_FALSE(silhouette(octahedron, {false, glm::normalize(Vec3(1, 2, 3))}).complete);
}

TEST(ImplicitContours, RefusesWhatIsNoViewOrPlane) {
  const ImplicitSurface sphere(formula("x^2 + y^2 + z^2 - 1"), 0, cube(2), false);
  const ViewOf none{false, Vec3(0)}, fine{false, {0, 0, -1}}, infinite{true, Vec3(kInfinity)};
  EXPECT_THROW(silhouette(sphere, none), std::invalid_argument);
  EXPECT_THROW(silhouette(sphere, infinite), std::invalid_argument);
  EXPECT_THROW(border(sphere, none), std::invalid_argument);
  EXPECT_THROW(plane_section(sphere, {0, 0, 0}, Vec3(0), fine), std::invalid_argument);
  EXPECT_THROW(plane_section(sphere, Vec3(NAN), {0, 0, 1}, fine), std::invalid_argument);
  EXPECT_THROW(plane_section(sphere, {0, 0, 0}, {0, 0, 1}, none), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::implicit_contours_test
