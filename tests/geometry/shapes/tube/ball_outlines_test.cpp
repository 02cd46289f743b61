// Sections of balls and tubes against closed forms, and of random tubes against lines in the plane.
#include "geometry/shapes/tube/ball_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shapes/tube/ball_parameter_lines.h"
#include "geometry/shapes/tube/tube_lines.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::ball_outlines_test {
namespace {

double length_of(const ShapeOutlines& found, const Vec3& origin, const Vec3& normal) {
  double length = 0;
  for (const ShapeOutline& line : found.lines) {
    EXPECT_TRUE(line.edge);
    const Interval t = line.curve->domain();
    const CurveJet middle = line.curve->evaluate(t.middle(), 1);
    EXPECT_NEAR(glm::dot(middle.d[0] - origin, glm::normalize(normal)), 0, 1e-15);
    length += t.width() * glm::length(middle.d[1]);  // circles
  }
  return length;
}

TEST(BallOutlines, SectionsByPlanes) {
  const ViewOf view{false, {0, 0, -1}};
  const Balls balls(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, std::vector<double>{1, 1, 0.5});
  // Through both middles of two balls that meet: each loses a third of its circle.
  const Vec3 normal(0, 0.6, 0.8);
  EXPECT_NEAR(length_of(plane_section(balls, {0, 0, 0}, 2.0 * normal, view), {0, 0, 0}, normal),
              2 * kTwoPi * 2 / 3 + kTwoPi * 0.5, 1e-13);
  // Beyond the first ball's part that is inside of the other.
  EXPECT_NEAR(length_of(plane_section(balls, {-0.6, 0, 0}, {1, 0, 0}, view), {-0.6, 0, 0}, {1, 0, 0}), kTwoPi * 0.8,
              1e-13);
  EXPECT_TRUE(plane_section(balls, {4, 0, 0}, {1, 0, 0}, view).lines.empty());
  // Interaction from above a circle in a plane that holds the line of sight turns away at its top and bottom.
  const auto upright =
      plane_section(Balls(std::vector<Vec3>{{0, 0, 0}}, std::vector<double>{2}), {0, 0, 0}, {0, 1, 0}, view);
  ASSERT_EQ(upright.lines.size(), 1u);
  for (const double turn : upright.lines[0].turns) EXPECT_NEAR(upright.lines[0].curve->point(turn).z, 0, 1e-12);
  EXPECT_GE(upright.lines[0].turns.size(), 2u);
}

// An eye near a ring sees the two branches of its outline join where a tangent of the middle circle passes the eye at
// less than the radius; just within it they part for a short stretch, just without they nearly join.
TEST(TubeOutlines, ShortGaps) {
  const double radius = 0.3, away = 3, end = 1.7;
  const Tube ring(std::make_shared<Circle>(Frame(), 1, Interval{-end, end}), RadiusLaw(radius), Caps::round);
  for (const double within : {0.1, 1e-2, 1e-3, 1e-4, 1e-5, -1e-2, -1e-3, -1e-4, -1e-5}) {
    const Vec3 eye(away, 0, std::sqrt(radius * radius - within * std::abs(within)));
    const ShapeOutlines found = outlines(ring, {true, eye});
    EXPECT_TRUE(found.complete) << within;
    double nearest[4] = {1, 1, 1, 1};  // to the middle of the gaps, on either side of each
    double across = 0, along = 0;      // how far points are off the ring and its outline
    for (const ShapeOutline& line : found.lines) {
      const Interval t = line.curve->domain();
      for (int k = 0; k <= 2000; ++k) {
        const Vec3 p = line.curve->point(t.lo + t.width() * k / 2000);
        const double turn = std::clamp(std::atan2(p.y, p.x), -end, end);
        const Vec3 n = (p - Vec3(std::cos(turn), std::sin(turn), 0)) / radius;
        across = std::max(across, std::abs(glm::length(n) - 1));
        along = std::max(along, std::abs(glm::dot(n, p - eye)));
        const double off = away * std::cos(turn) - 1;
        double& least = nearest[2 * (turn < 0) + (off < 0)];
        least = std::min(least, std::abs(off));
      }
    }
    EXPECT_LT(across, 2e-12) << within;
    EXPECT_LT(along, 2e-12) << within;
    for (const double off : nearest) {
      EXPECT_GT(off, within * (1 - 1e-3)) << within;
      EXPECT_LT(off, std::max(within, 0.0) + 1e-2) << within;
    }
  }
}

// A plane curve with its first handle retracted, seen from above: both lines beside it at the radius. Walls of less
// bend than the radius allows (0.92 of it at the handle of 5e-3) have no edges.
TEST(TubeOutlines, OfARetractedHandle) {
  const double radius = 0.1;
  const ViewOf view{false, {0, 0, -1}};
  for (const double handle : {0.0, 1e-4, 1e-3, 5e-3, 1e-2}) {
    const auto curve = std::make_shared<NurbsCurve>(
        bezier_curve(std::vector<Vec3>{{0, 0, 0}, {handle, handle, 0}, {1, 1, 0}, {2, 0, 0}}));
    const Tube tube(curve, RadiusLaw(radius), Caps::flat);
    const ShapeOutlines found = outlines(tube, view);
    EXPECT_TRUE(found.complete) << handle;
    int beside[2] = {0, 0};  // points on either side
    for (const ShapeOutline& line : found.lines) {
      if (line.edge) continue;
      const Interval t = line.curve->domain();
      for (int k = 0; k <= 100; ++k) {
        const Vec3 p = line.curve->point(t.lo + t.width() * k / 100);
        const CurveFootPoint foot_point = project(p, *curve).foot_points.at(0);
        // Where it bends more it goes through itself, and lines end to 1e-6 of the size.
        EXPECT_NEAR(foot_point.distance, radius, handle < 4e-3 && foot_point.t < 0.0061 ? 2e-6 : 1e-9)
            << handle << " t " << foot_point.t;
        if (foot_point.t > 0) ++beside[glm::cross(curve->evaluate(foot_point.t, 1).d[1], p - foot_point.point).z > 0];
      }
    }
    EXPECT_GT(beside[0], 90) << handle;
    EXPECT_GT(beside[1], 90) << handle;
    const TubeBoundary::Edges edges = TubeBoundary(tube).edges(view);
    EXPECT_TRUE(edges.lines.complete) << handle;
    if (handle > 4.9e-3) {
      EXPECT_TRUE(edges.all_known && edges.lines.lines.empty()) << handle;
    }
  }
}

// Parallels and meridians of two unit balls 1 apart along z, cut at the circle z = 1/2; and of one alone.
TEST(BallOutlines, ParameterLines) {
  const ViewOf view{false, {0, 0, 1}};
  const Balls balls(std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {9, 0, 0}}, std::vector<double>{1, 1, 0.5});
  double meridians = 0;
  for (const ShapeOutline& line : parameter_lines(balls, {{4, {}}, {}}, view).lines) {
    const Interval t = line.curve->domain();
    meridians += t.width() * glm::length(line.curve->evaluate(t.middle(), 1).d[1]);
    ASSERT_EQ(line.turns.size(), 1u);  // at the equator, seen from below
    EXPECT_NEAR(std::remainder(line.curve->point(line.turns[0]).z, 1), 0, 1e-12);
  }
  const double seam = kPi / 6;
  EXPECT_NEAR(meridians, 4 * (2 * (0.5 * kPi + seam) + 0.5 * kPi), 1e-13);
  const auto parallels = [&](double v) {
    double sum = 0;
    for (const ShapeOutline& line : parameter_lines(balls, {{}, {0, {v}}}, view).lines) {
      const Interval t = line.curve->domain();
      sum += t.width() * glm::length(line.curve->evaluate(t.middle(), 1).d[1]);
    }
    return sum;
  };
  EXPECT_NEAR(parallels(0.3), kTwoPi * 2.5 * std::cos(0.3), 1e-13);
  EXPECT_NEAR(parallels(0.6), kTwoPi * 1.5 * std::cos(0.6), 1e-13);
  EXPECT_EQ(parallels(0.5 * kPi), 0);
}

Expression law(const char* text) {
  auto formula = std::get<Expression>(Expression::parse(text));
  const std::vector<Expression::Variable> variables{{"s"}};
  EXPECT_FALSE(formula.bind(variables));
  return formula;
}

// The length of a section, all of whose points are in the plane.
double section_length(const Tube& tube, const Vec3& origin, const Vec3& normal) {
  const ShapeOutlines found = plane_section(tube, origin, normal, {false, {0, 0, -1}});
  EXPECT_TRUE(found.complete);
  const Vec3 n = glm::normalize(normal);
  double length = 0;
  for (const ShapeOutline& line : found.lines) {
    EXPECT_TRUE(line.edge);
    const Interval t = line.curve->domain();
    for (int k = 0; k <= 20; ++k)
      EXPECT_NEAR(glm::dot(line.curve->point(t.lo + t.width() * k / 20) - origin, n), 0, 2e-12);
    length += arc_length(*line.curve, t.lo, t.hi).value;
  }
  return length;
}

TEST(TubeSections, ClosedForms) {
  const auto rod = std::make_shared<Segment>(Vec3(0, 0, -2), Vec3(0, 0, 2));
  for (const Caps caps : {Caps::flat, Caps::round, Caps::none}) {
    const Tube tube(rod, RadiusLaw(0.5), caps);
    EXPECT_NEAR(section_length(tube, {0.3, 0, 0.25}, {0, 0, 3}), kPi, 1e-11);
    EXPECT_NEAR(section_length(tube, {0, 0, 0.25}, {1e-9, 0, 3}), kPi, 1e-11);
    // An ellipse of half axes 1/2 and 1/2 / cos 45 degrees.
    EXPECT_NEAR(section_length(tube, {0, 0, 0}, {1, 0, 1}), 4 * std::sqrt(0.5) * std::comp_ellint_2(std::sqrt(0.5)),
                1e-11);
    // Along the rod, 0.3 from its middle.
    const double ends = caps == Caps::flat ? 2 * 0.8 : caps == Caps::round ? kTwoPi * 0.4 : 0;
    EXPECT_NEAR(section_length(tube, {0.3, 0, 0}, {1, 0, 0}), 2 * 4 + ends, 1e-11);
    EXPECT_EQ(section_length(tube, {0.6, 0, 0}, {1, 0, 0}), 0);
    EXPECT_EQ(section_length(tube, {0, 0, 2.6}, {0, 0, 1}), 0);
  }
  const auto circle =
      std::make_shared<FormulaCurve>(point_formulas({"3*cos(t)", "3*sin(t)", "0"}, {"t"}), Interval{0, kTwoPi}, true);
  const Tube ring(circle, RadiusLaw(1), Caps::round);
  EXPECT_NEAR(section_length(ring, {0, 0, 0}, {0, 0, 1}), kTwoPi * (2 + 4), 1e-10);
  EXPECT_NEAR(section_length(ring, {0, 0, 0.6}, {0, 0, 1}), kTwoPi * (2.2 + 3.8), 1e-10);
  EXPECT_NEAR(section_length(ring, {0, 0, 0}, {1, 2, 0}), 2 * kTwoPi, 1e-10);
  // The circles of Villarceau have the radius of the ring; where they cross rounding leaves half the digits of where
  // along them a point is.
  EXPECT_NEAR(section_length(ring, {0, 0, 0}, {1.0 / 3, 0, std::sqrt(8.0) / 3}), 2 * kTwoPi * 3, 1e-9);
  // A cone: R' = -1/8 along the rod, so that its angle has the sine 1/8.
  const Tube cone(rod, RadiusLaw(law("1 - 0.5*s"), *rod), Caps::round);
  EXPECT_NEAR(section_length(cone, {0, 0, 0}, {0, 0, 1}), kTwoPi * 0.75 / std::sqrt(1 - 1.0 / 64), 1e-10);
}

TEST(TubeSections, RandomPlanesMeetAllThatLinesInThemMeet) {
  std::mt19937_64 random(71);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  const auto direction = [&] {
    Vec3 d;
    do d = {number(-1, 1), number(-1, 1), number(-1, 1)};
    while (glm::length(d) > 1 || glm::length(d) < 0.1);
    return glm::normalize(d);
  };
  int lines = 0, wrong = 0, incomplete = 0, sections = 0;
  double off = 0;
  for (int k = 0; k < tests::tier_count(2000, 40); ++k) {
    const std::string pitch = std::to_string(number(0.05, 0.3));
    const CurvePtr curve =
        k % 3 == 0
            ? std::make_shared<FormulaCurve>(point_formulas({"cos(t)", "sin(t)", pitch + "*t"}, {"t"}), Interval{0, 9})
        : k % 3 == 1
            ? CurvePtr(std::make_shared<FormulaCurve>(
                  point_formulas({"sin(2*t)", "cos(t)", pitch + "*sin(3*t)"}, {"t"}), Interval{0, kTwoPi}, true))
            : CurvePtr(std::make_shared<NurbsCurve>(
                  polyline(std::vector<Vec3>{2.0 * direction(), direction(), direction(), 2.0 * direction()})));
    const Caps caps = k % 2 ? Caps::flat : Caps::round;
    const RadiusLaw radius =
        k % 5 == 0 ? RadiusLaw(law("0.2 + 0.1*cos(6.283185307179586*s)"), *curve) : RadiusLaw(number(0.1, 0.4));
    const Tube tube(curve, radius, caps);
    const Vec3 n = direction(), origin = tube.bounds().center() + 0.3 * direction();
    const ShapeOutlines found = plane_section(tube, origin, n, {false, {0, 0, -1}});
    ++sections;
    if (!found.complete) {
      ++incomplete;
      continue;
    }
    const Frame plane = frame_about(origin, n);
    std::vector<std::vector<Vec3>> chains;
    for (const ShapeOutline& line : found.lines) {
      const Interval t = line.curve->domain();
      std::vector<Vec3> chain;
      constexpr int kPlaces = 2000;
      for (int i = 0; i <= kPlaces; ++i) {
        chain.push_back(line.curve->point(t.lo + t.width() * i / kPlaces));
        off = tests::worse(off, std::abs(glm::dot(chain.back() - origin, n)));
      }
      chains.push_back(std::move(chain));
    }
    for (int i = 0; i < 20; ++i) {
      const double angle = number(0, kTwoPi);
      const Vec3 along = std::cos(angle) * plane.x + std::sin(angle) * plane.y, across = glm::cross(n, along);
      const Vec3 from = origin + number(-1, 1) * across;
      std::vector<SurfaceHit> hits;
      tube.all_hits({from - 20.0 * along, along}, {0, 40}, hits);
      size_t crossings = 0;
      for (const auto& chain : chains)
        for (size_t j = 0; j + 1 < chain.size(); ++j)
          crossings += (glm::dot(chain[j] - from, across) < 0) != (glm::dot(chain[j + 1] - from, across) < 0);
      ++lines;
      // Chords tell lines that nearly touch otherwise; such ones differ by two.
      bool near = hits.empty();
      for (size_t j = 0; j + 1 < hits.size(); ++j) near = near || std::abs(hits[j].t - hits[j + 1].t) < 0.02;
      if (crossings != hits.size() && !near) ++wrong;
    }
  }
  tests::report_figure("sections", sections);
  tests::report_figure("lines", lines);
  tests::report_figure("wrong", wrong);
  tests::report_figure("incomplete", incomplete);
  EXPECT_EQ(wrong, 0) << "of " << lines;
  EXPECT_LT(off, 1e-11);
  EXPECT_LE(incomplete, sections / 50);
}

}  // namespace
}  // namespace lekalo::geometry::ball_outlines_test
