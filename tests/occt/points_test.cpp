// Foot points of points on curves and surfaces, and intersections of curves with curves and surfaces, against OCCT: its
// GeomAPI_ProjectPointOnCurve and -OnSurf, GeomAPI_ExtremaCurveCurve and GeomAPI_IntCS, on random rational B-splines.
//
// OCCT samples before it iterates and may lose solutions that lie near to each other: those are counted. What only OCCT
// has is our failure, what only we have must hold by the values of OCCT's own evaluation.
#include <gtest/gtest.h>

#include <GeomAPI_ExtremaCurveCurve.hxx>
#include <GeomAPI_IntCS.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <gp_Vec.hxx>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "occt/occt_shapes.h"
#include "support/tier.h"

namespace lekalo::geometry::points_test {
namespace {

constexpr double kSame = 1e-6;      // of parameters and lengths: all shapes are about as large as the unit cube
constexpr double kUpright = 1e-7;   // cosine: OCCT lists places where its iteration stopped short of one, too
constexpr double kAtBorder = 1e-6;  // OCCT lists places on borders too

struct Counts {
  int ours = 0, missed_by_occt = 0, wrong = 0;

  void report(int least) const {
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(ours, least);
    // An oracle that is wrong more often than this says nothing.
    EXPECT_LE(missed_by_occt, ours / 4);
    tests::report_figure("ours", ours);
    tests::report_figure("missed_by_occt", missed_by_occt);
    tests::report_figure("wrong", wrong);
  }
};

bool has(const std::vector<Vec3>& all, const Vec3& p) {
  return std::any_of(all.begin(), all.end(), [&](const Vec3& q) { return glm::length(p - q) <= kSame; });
}

std::vector<Vec3> points_about(RandomNet& net, int count) {
  std::vector<Vec3> points = net.points(count);
  for (Vec3& p : points) p = 1.6 * p - 0.3;
  return points;
}

std::shared_ptr<NurbsCurve> random_curve(RandomNet& net, int degree, bool plane = false) {
  std::vector<Vec3> points = net.points(degree + 4);
  for (Vec3& p : points)
    if (plane) p.z = 0;
  return std::make_shared<NurbsCurve>(clamped_axis(degree, degree + 4), points, net.weights(degree + 4));
}

TEST(OcctFootPoints, OnCurves) {
  Counts counts;
  for (int k = 0; k < tests::tier_count(2000); ++k) {
    RandomNet net(4000 + k);
    const auto curve = random_curve(net, 2 + k % 4);
    const Handle(Geom_BSplineCurve) spline = occt_spline(*curve);
    const CurveProjector projector(curve);
    for (const Vec3& p : points_about(net, 10)) {
      GeomAPI_ProjectPointOnCurve occt(occt_point(p), spline);
      std::vector<Vec3> own, other;
      for (int i = 1; i <= occt.NbPoints(); ++i) other.push_back(from_occt(occt.Point(i).XYZ()));
      for (const CurveFootPoint& foot_point : projector.foot_points(p).foot_points) {
        own.push_back(foot_point.point);
        if (foot_point.kind == FootPointKind::border) continue;
        ++counts.ours;
        gp_Pnt point;
        gp_Vec tangent;
        spline->D1(foot_point.t, point, tangent);
        const Vec3 way = p - from_occt(point.XYZ()), along = from_occt(tangent.XYZ());
        EXPECT_LT(std::abs(glm::dot(way, along)), 1e-12 * (1 + glm::length(along)));
        counts.missed_by_occt += !has(other, foot_point.point);
      }
      for (const Vec3& foot_point : other) counts.wrong += !has(own, foot_point);
    }
  }
  counts.report(100);
}

TEST(OcctFootPoints, OnSurfaces) {
  Counts counts;
  int invented = 0;
  for (int k = 0; k < tests::tier_count(500); ++k) {
    RandomNet net(5000 + k);
    const SplineAxis axis = k % 2 ? bezier_axis(3) : clamped_axis(2 + k % 3, 6);
    const auto sheet = std::make_shared<NurbsSurface>(random_sheet(6000 + k, axis, axis));
    const Handle(Geom_BSplineSurface) spline = occt_spline(*sheet);
    const SurfaceProjector projector(sheet);
    const Rectangle domain = sheet->domain();
    for (const Vec3& p : points_about(net, 10)) {
      GeomAPI_ProjectPointOnSurf occt(occt_point(p), spline);
      std::vector<Vec3> own, other;
      for (int i = 1; i <= occt.NbPoints(); ++i) other.push_back(from_occt(occt.Point(i).XYZ()));
      for (const SurfaceFootPoint& foot_point : projector.foot_points(p).foot_points) {
        own.push_back(foot_point.point);
        if (foot_point.kind == FootPointKind::border) continue;
        ++counts.ours;
        gp_Pnt point;
        gp_Vec du, dv;
        spline->D1(foot_point.u, foot_point.v, point, du, dv);
        const Vec3 way = p - from_occt(point.XYZ());
        for (const gp_Vec& along : {du, dv})
          EXPECT_LT(std::abs(glm::dot(way, from_occt(along.XYZ()))), 1e-12 * (1 + along.Magnitude()));
        counts.missed_by_occt += !has(other, foot_point.point);
      }
      for (int i = 1; i <= occt.NbPoints(); ++i) {
        double u, v;
        occt.Parameters(i, u, v);
        gp_Pnt point;
        gp_Vec du, dv;
        spline->D1(u, v, point, du, dv);
        const gp_Vec way(point, occt_point(p));
        const auto at_border = [](double x, const Interval& range) {
          return std::min(x - range.lo, range.hi - x) <= kAtBorder * range.width();
        };
        const auto slants = [&](const gp_Vec& along) {
          return std::abs(way.Dot(along)) > kUpright * way.Magnitude() * along.Magnitude();
        };
        if (at_border(u, domain.u) || at_border(v, domain.v)) continue;
        if (slants(du) || slants(dv))
          ++invented;
        else
          counts.wrong += !has(own, other[i - 1]);
      }
    }
  }
  counts.report(10);
  tests::report_figure("no_feet_of_occt", invented);
}

// In the plane, where curves cross; OCCT by the least distances.
TEST(OcctCurveIntersections, OfCurves) {
  Counts counts;
  for (int k = 0; k < tests::tier_count(2000); ++k) {
    RandomNet net(7000 + k);
    const auto a = random_curve(net, 2 + k % 3, true), b = random_curve(net, 2 + k / 3 % 3, true);
    const Handle(Geom_BSplineCurve) spline_a = occt_spline(*a), spline_b = occt_spline(*b);
    GeomAPI_ExtremaCurveCurve occt(spline_a, spline_b);
    std::vector<Vec3> own, other;
    for (int i = 1; i <= occt.NbExtrema(); ++i) {
      gp_Pnt p, q;
      occt.Points(i, p, q);
      if (occt.Distance(i) < 1e-9) other.push_back(from_occt(p.XYZ()));
    }
    for (const CurveIntersection& one : intersect(*a, *b).points) {
      own.push_back(one.point);
      ++counts.ours;
      EXPECT_LT(spline_a->Value(one.s).Distance(spline_b->Value(one.t)), 1e-12);
      counts.missed_by_occt += !has(other, one.point);
    }
    for (const Vec3& p : other) counts.wrong += !has(own, p);
  }
  counts.report(20);
}

TEST(OcctCurveIntersections, OfCurvesAndSurfaces) {
  Counts counts;
  for (int k = 0; k < tests::tier_count(2000); ++k) {
    RandomNet net(9000 + k);
    const auto curve = random_curve(net, 2 + k % 4);
    const SplineAxis axis = k % 2 ? bezier_axis(3) : clamped_axis(2, 5);
    const auto sheet = std::make_shared<NurbsSurface>(random_sheet(10000 + k, axis, axis));
    const Handle(Geom_BSplineCurve) spline = occt_spline(*curve);
    const Handle(Geom_BSplineSurface) surface = occt_spline(*sheet);
    GeomAPI_IntCS occt(spline, surface);
    std::vector<Vec3> own, other;
    for (int i = 1; occt.IsDone() && i <= occt.NbPoints(); ++i) other.push_back(from_occt(occt.Point(i).XYZ()));
    for (const SurfaceIntersection& one : intersect(*curve, *sheet).points) {
      own.push_back(one.point);
      ++counts.ours;
      EXPECT_LT(spline->Value(one.t).Distance(surface->Value(one.u, one.v)), 1e-12);
      counts.missed_by_occt += !has(other, one.point);
    }
    for (const Vec3& p : other) counts.wrong += !has(own, p);
  }
  counts.report(10);
}

}  // namespace
}  // namespace lekalo::geometry::points_test
