// Surfaces evaluated from outside: known ones behind the interface, so that everything can be compared with what they
// are, at places that the fit has not seen.
#include "geometry/external/external_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/describe.h"
#include "geometry/external/external_curve.h"
#include "geometry/external_stub.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::external_surface_test {
namespace {

const Rectangle kTurns{{0, kTwoPi}, {0, kTwoPi}};

SurfacePtr formulas(const std::array<std::string, 3>& point, const Rectangle& domain,
                    Coordinates coordinates = Coordinates::cartesian) {
  return std::make_shared<FormulaSurface>(point_formulas(point, {"u", "v"}, coordinates), domain,
                                          FormulaSurface::Closed{});
}

SurfacePtr torus() { return formulas({"(2 + 0.7*cos(v))*cos(u)", "(2 + 0.7*cos(v))*sin(u)", "0.7*sin(v)"}, kTurns); }

ExternalSurface external(const SurfacePtr& surface, ExternalSurface::Closed closed = {}, int order = 2,
                         double tolerance = 1e-9) {
  return ExternalSurface(std::make_shared<SurfaceStub>(surface), surface->domain(), closed, order, tolerance);
}

// Which field a constructor complains about, and the words.
template <class Make>
std::pair<std::string, std::string> complaint(Make make) {
  try {
    make();
  } catch (const FieldError& error) {
    return {error.field, error.what()};
  }
  return {};
}

TEST(ExternalSurface, SplineIsAsNearAsItSays) {
  const std::array<SurfacePtr, 5> surfaces = {
      torus(), formulas({"u", "v", "0.3*sin(5*u)*exp(-v^2)"}, {{-1, 1}, {-1, 2}}),
      formulas({"3", "u", "v"}, {{0, kTwoPi}, {-0.5 * kPi, 0.5 * kPi}}, Coordinates::spherical),
      formulas({"u", "v", "1/(0.1 + u^2)"}, {{-1, 1}, {0, 1}}), formulas({"1000 + u", "v", "u*v"}, {{0, 1}, {0, 1}})};
  std::mt19937_64 random(7);
  double worst = 0;
  for (const SurfacePtr& surface : surfaces)
    for (const double tolerance : {1e-6, 1e-9, 1e-11}) {
      const ExternalSurface one = external(surface, {}, 2, tolerance);
      EXPECT_LE(one.report().distance(), tolerance * one.report().size);
      EXPECT_TRUE(one.report().doubts.empty()) << one.report().doubts.front();
      const NurbsSurface spline(*one.as_nurbs());
      std::uniform_real_distribution<double> u(surface->domain().u.lo, surface->domain().u.hi),
          v(surface->domain().v.lo, surface->domain().v.hi);
      for (int i = 0; i < lekalo::tests::tier_count(100000); ++i) {
        const double a = u(random), b = v(random);
        const double off = glm::length(spline.point(a, b) - surface->point(a, b)) / one.report().size;
        worst = tests::worse(worst, off / tolerance);
      }
    }
  lekalo::tests::report_figure("largest_distance_over_tolerance", worst);
  EXPECT_LE(worst, 1.2);
}

TEST(ExternalSurface, AsksTheFunctionForWhatItKnows) {
  const SurfacePtr truth = torus();
  for (const int order : {0, 1, 2, 4}) {
    const ExternalSurface one = external(truth, {true, true}, order);
    const SurfaceJet jet = one.evaluate(1.1, 2.3, 4), expected = truth->evaluate(1.1, 2.3, 4);
    for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k) EXPECT_EQ(jet.values[k], expected.values[k]);
    for (int k = 0; k < 6; ++k) EXPECT_LE(glm::length(jet.values[k] - expected.values[k]), 1e-5);
    // It wraps.
    EXPECT_LE(glm::length(one.point(1.1 + kTwoPi, 2.3 - kTwoPi) - expected.point()), 1e-14);
  }
  // Outside, the spline goes on along its tangents; the function, of a sphere here, would come back.
  const ExternalSurface part = external(formulas({"3", "u", "v"}, {{0, 1}, {0, 1}}, Coordinates::spherical));
  const SurfaceJet edge = part.evaluate(1, 0.5, 1);
  EXPECT_LE(glm::length(part.point(1.5, 0.5) - (edge.point() + 0.5 * edge.du())), 1e-7);
}

TEST(ExternalSurface, ManyPlacesAreOneCall) {
  const auto function = std::make_shared<SurfaceStub>(torus());
  const ExternalSurface one(function, kTurns, {true, true}, 2, 1e-9);
  EXPECT_LE(function->calls, 40);
  const int before = function->calls;
  const std::vector<Vec2> uv(1000, Vec2(1, 2));
  std::vector<SurfaceJet> jets(uv.size());
  one.evaluate_many(uv, 2, jets);
  EXPECT_EQ(function->calls, before + 1);
}

TEST(ExternalSurface, EnclosesFunctionAndSpline) {
  const SurfacePtr truth = torus();
  const ExternalSurface one = external(truth);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double u = 6 * unit(random), v = 6 * unit(random), width = 0.2 * unit(random);
    const SurfaceEnclosure boxes = one.enclose({{u, u + width}, {v, v + width}}, 2);
    const SurfaceJet jet = truth->evaluate(u + width * unit(random), v + width * unit(random), 2);
    for (int k = 0; k < 6; ++k) EXPECT_TRUE(boxes.values[k].inflated(1e-14).contains(jet.values[k]));
  }
}

TEST(ExternalSurface, LinesMeetItAsTheSurface) {
  const auto truth = std::make_shared<TorusSurface>(Frame(), 2, 0.7);
  const auto one = std::make_shared<ExternalSurface>(external(truth, {true, true}));
  const LineIntersector ours(one), theirs(truth);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> side(-1, 1);
  int hits = 0, different = 0;
  double worst = 0;
  const int lines = lekalo::tests::tier_count(200000);
  for (int i = 0; i < lines; ++i) {
    const Line line{{3 * side(random), 3 * side(random), 3 * side(random)},
                    glm::normalize(Vec3(side(random), side(random), side(random)))};
    const auto a = ours.all_hits(line, {-10, 10}), b = theirs.all_hits(line, {-10, 10});
    if (a.size() != b.size()) {
      ++different;
      continue;
    }
    for (size_t k = 0; k < a.size(); ++k) {
      const double sine = std::abs(glm::dot(truth->normal(b[k].u, b[k].v), line.direction));
      worst = tests::worse(worst, std::abs(a[k].t - b[k].t) * sine);
      ++hits;
    }
  }
  lekalo::tests::report_figure("hits", hits);
  lekalo::tests::report_figure("tangent_lines_that_differ", different);
  lekalo::tests::report_figure("largest_distance_across_the_surface", worst);
  EXPECT_GT(hits, lines / 2);
  EXPECT_LE(different, 1 + lines / 2000);
  EXPECT_LE(worst, 2e-8);
}

TEST(ExternalSurface, IsClosedToTheLastBitAndKnowsPoles) {
  const ExternalSurface ring = external(torus(), {true, true});
  const NurbsSurfaceForm form = *ring.as_nurbs();
  const int rows = form.count_u(), columns = form.count_v();
  for (int j = 0; j < columns; ++j) EXPECT_EQ(form.points[j], form.points[(rows - 1) * columns + j]);
  for (int i = 0; i < rows; ++i) EXPECT_EQ(form.points[i * columns], form.points[i * columns + columns - 1]);
  const ExternalSurface ball = external(
      formulas({"3", "u", "v"}, {{0, kTwoPi}, {-0.5 * kPi, 0.5 * kPi}}, Coordinates::spherical), {true, false});
  EXPECT_TRUE(ball.degenerate_edges().v_min && ball.degenerate_edges().v_max);
  EXPECT_FALSE(ball.degenerate_edges().u_min || ball.degenerate_edges().u_max);
}

TEST(ExternalSurface, WrongDerivativesAreDoubted) {
  const SurfacePtr truth = formulas({"u", "v", "sin(2*u*v)"}, {{0, 1}, {0, 1}});
  struct Fault {
    const char* quantity;
    int i, j;
    double by;
  };
  for (const Fault& fault :
       {Fault{"du", 1, 0, 1e-4}, {"dv", 0, 1, 1e-4}, {"duu", 2, 0, 1e-2}, {"duv", 1, 1, 1e-2}, {"dvv", 0, 2, 1e-2}}) {
    const auto function = std::make_shared<SurfaceStub>(truth, [&](double u, double, SurfaceJet& jet) {
      if (fault.i + fault.j <= jet.order) jet.d(fault.i, fault.j).z += fault.by * u;
    });
    const ExternalSurface one(function, truth->domain(), {}, 2, 1e-9);
    ASSERT_EQ(one.report().doubts.size(), 1u) << fault.quantity;
    EXPECT_EQ(one.report().doubts.front().find(fault.quantity), 0u) << one.report().doubts.front();
    EXPECT_NE(one.report().doubts.front().find(" at u = 1,"), std::string::npos) << one.report().doubts.front();
  }
}

TEST(ExternalSurface, RefusesWhatNoSplineComesNear) {
  const SurfacePtr smooth = formulas({"u", "v", "u*v"}, {{0, 1}, {0, 1}});
  std::mt19937_64 random(1);
  const auto noisy = [&](double, double, SurfaceJet& jet) {
    jet.values[0].z += 1e-7 * (static_cast<double>(random()) / 1.8446744073709552e19);
  };
  const auto kinked = [](double u, double, SurfaceJet& jet) { jet.values[0].z += std::abs(u - 0.4); };
  const auto made = [&](SurfaceStub::Change change, double tolerance) {
    return complaint(
        [&] { ExternalSurface(std::make_shared<SurfaceStub>(smooth, change), smooth->domain(), {}, 0, tolerance); });
  };
  EXPECT_EQ(made(noisy, 1e-9).first, "tolerance");
  EXPECT_EQ(made(noisy, 1e-6).first, "");
  const auto kink = made(kinked, 1e-9);
  EXPECT_EQ(kink.first, "tolerance");
  EXPECT_NE(kink.second.find("at u = 0.4"), std::string::npos) << kink.second;
}

TEST(ExternalSurface, RefusesWhatIsNoSurface) {
  const SurfacePtr bent = formulas({"cos(u)", "sin(u)", "v"}, {{0, 6}, {0, 1}});
  EXPECT_EQ(complaint([&] { external(bent, {true, false}); }).first, "closed");
  EXPECT_EQ(complaint([&] { external(bent, {false, true}); }).first, "closed");
  const auto function = std::make_shared<SurfaceStub>(bent);
  EXPECT_EQ(complaint([&] { ExternalSurface(function, {{0, 0}, {0, 1}}, {}, 2, 1e-9); }).first, "domain");
  EXPECT_EQ(complaint([&] { ExternalSurface(function, {{0, 1}, {0, kInfinity}}, {}, 2, 1e-9); }).first, "domain");
  const SurfacePtr point = formulas({"1", "2", "3"}, {{0, 1}, {0, 1}});
  EXPECT_EQ(complaint([&] { external(point); }).first, "domain");
  const auto broken = std::make_shared<SurfaceStub>(bent, [](double u, double, SurfaceJet& jet) {
    if (u > 5) jet.values[0].y = std::nan("");
  });
  EXPECT_THROW(ExternalSurface(broken, bent->domain(), {}, 2, 1e-9), ExternalError);
}

// Derivatives of a fit give the area of the fit: the stated error tells by how much that is wrong, and not a thousand
// times more. With derivatives of its own the area is exact.
TEST(ExternalSurface, MeasuresTellWhatTheFitErrs) {
  const auto expect_within = [](const SurfaceMeasures& found, double area, const Vec3& centroid, double size) {
    EXPECT_LE(std::abs(found.area.value - area), found.area.error);
    EXPECT_LE(glm::length(found.centroid - centroid), found.centroid_error);
    EXPECT_LE(found.area.error, 1e3 * size * area);
    EXPECT_LE(found.centroid_error, 1e3 * size);
  };
  const double area = 4 * kPi * kPi * 2 * 0.7;
  for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-11}) {
    const auto wall = std::make_shared<ExternalSurface>(external(torus(), {true, true}, 0, tolerance));
    EXPECT_GT(wall->fit_distance(), 0);
    expect_within(measure(*wall), area, Vec3(0), tolerance);
    const Affine twice{Mat3(2.0), {1, 2, 3}};
    expect_within(measure(*transformed(wall, twice)), 4 * area, {1, 2, 3}, tolerance);

    const CurvePtr helix =
        std::make_shared<FormulaCurve>(point_formulas({"cos(t)", "sin(t)", "0.2*t"}, {"t"}), Interval{0, 6});
    const auto known =
        std::make_shared<ExternalCurve>(std::make_shared<CurveStub>(helix), helix->domain(), false, 0, tolerance);
    const CurveMeasures wire = measure(*known);
    EXPECT_LE(std::abs(wire.length.value - 6 * std::sqrt(1.04)), wire.length.error);
    EXPECT_LE(wire.length.error, 1e3 * tolerance);
    const Vec3 middle(std::sin(6) / 6, (1 - std::cos(6)) / 6, 0.6);
    EXPECT_LE(glm::length(wire.centroid - middle), wire.centroid_error);
    EXPECT_LE(std::abs(arc_length(*known, 1, 2).value - std::sqrt(1.04)), arc_length(*known, 1, 2).error);
    expect_within(measure(ExtrusionSurface(known, {0, 0, 0.1})), 0.6, middle + Vec3(0, 0, 0.05), tolerance);
  }
  const ExternalSurface exact = external(torus(), {true, true}, 1, 1e-6);
  EXPECT_EQ(exact.fit_distance(), 0);
  EXPECT_NEAR(measure(exact).area.value, area, 1e-10);
  EXPECT_LE(measure(exact).area.error, 1e-9);
}

}  // namespace
}  // namespace lekalo::geometry::external_surface_test
