// Hits of random lines with surfaces against OCCT's GeomAPI_IntCS: the same points within 1e-6 of the size.
//
// Where the two disagree (a hit of one without a partner within 1e-6) the halving oracle decides; OCCT's misses and
// inventions are counted and reported, ours are failures.
#include <gtest/gtest.h>

#include <GeomAPI_IntCS.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>

#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "occt/occt_shapes.h"
#include "support/line_oracle.h"
#include "support/tier.h"

namespace lekalo::geometry::intersections_test {
namespace {

constexpr double kSame = 1e-6;  // of the size

class OcctIntersections : public testing::Test {
 protected:
  // `v_rate`: OCCT's v by ours, for surfaces that are unbounded in v there; 0: all of OCCT's surface counts.
  void expect_same(const SurfacePtr& own, const Handle(Geom_Surface) & theirs, const char* name, double v_rate = 0) {
    const Box3 box = bounds(*own);
    const double size = box.diameter();
    const LineIntersector intersector(own);
    std::vector<oracle::PatchOracle> patches;
    for (const SurfacePiece& piece : own->pieces()) patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);

    std::mt19937_64 random(41);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    int hits = 0, occt_missed = 0, occt_invented = 0, wrong = 0;
    const int count = tests::tier_count(20000);
    for (int k = 0; k < count; ++k) {
      const double x = unit(random), y = unit(random), a = normal(random), b = normal(random);
      const Line line{box.lo + Vec3(x, y, unit(random)) * box.size(), glm::normalize(Vec3(a, b, normal(random)))};
      std::vector<double> ours, other;
      for (const SurfaceHit& hit : intersector.all_hits(line)) ours.push_back(hit.t);
      GeomAPI_IntCS occt(new Geom_Line(occt_point(line.origin), occt_direction(line.direction)), theirs);
      for (int i = 1; occt.IsDone() && i <= occt.NbPoints(); ++i) {
        double u, v, t;
        occt.Parameters(i, u, v, t);
        if (v_rate == 0 || own->domain().v.contains(v / v_rate)) other.push_back(t);
      }
      hits += static_cast<int>(ours.size());
      for (const double t : ours)
        if (!has(other, t, size)) (is_root(patches, line, t, size) ? occt_missed : wrong) += 1;
      for (const double t : other)
        if (!has(ours, t, size)) (is_root(patches, line, t, size) ? wrong : occt_invented) += 1;
    }
    EXPECT_EQ(wrong, 0) << name << ": " << hits << " hits of " << count << " lines";
    EXPECT_GT(hits, count / 4) << name;
    // An oracle that is wrong more often than this says nothing.
    EXPECT_LE(occt_missed + occt_invented, hits / 50) << name;
    tests::report_figure(std::string(name) + "_hits", hits);
    tests::report_figure(std::string(name) + "_wrong", wrong);
    tests::report_figure(std::string(name) + "_missed_by_occt", occt_missed);
    tests::report_figure(std::string(name) + "_invented_by_occt", occt_invented);
  }

 private:
  static bool has(const std::vector<double>& all, double t, double size) {
    return std::any_of(all.begin(), all.end(), [&](double other) { return std::abs(other - t) <= kSame * size; });
  }
  static bool is_root(const std::vector<oracle::PatchOracle>& patches, const Line& line, double t, double size) {
    std::vector<double> roots;
    for (const oracle::PatchOracle& patch : patches)
      for (const oracle::Root& root : patch.roots(line)) roots.push_back(root.t);
    return has(roots, t, size);
  }
};

TEST_F(OcctIntersections, Quadrics) {
  const Frame frame = tilted_frame();
  const gp_Ax3 axes = occt_frame(frame);
  expect_same(std::make_shared<SphereSurface>(frame, 1.75), new Geom_SphericalSurface(axes, 1.75), "sphere");
  expect_same(std::make_shared<CylinderSurface>(frame, 0.8, 2.5), new Geom_CylindricalSurface(axes, 0.8), "cylinder",
              2.5);
  expect_same(std::make_shared<ConeSurface>(frame, 2, 0, 1.5), new Geom_ConicalSurface(axes, std::atan2(-2, 1.5), 2),
              "cone", 2.5);
}

TEST_F(OcctIntersections, Torus) {
  const Frame frame = tilted_frame();
  expect_same(std::make_shared<TorusSurface>(frame, 3, 1.25), new Geom_ToroidalSurface(occt_frame(frame), 3, 1.25),
              "torus");
}

TEST_F(OcctIntersections, Nurbs) {
  const auto bezier = std::make_shared<NurbsSurface>(random_sheet(800, bezier_axis(3), bezier_axis(4)));
  expect_same(bezier, occt_spline(*bezier), "bezier");
  const auto sheet = std::make_shared<NurbsSurface>(random_sheet(801, clamped_axis(3, 6), uniform_axis(2, 6)));
  expect_same(sheet, occt_spline(*sheet), "nurbs");
  const auto tube = std::make_shared<NurbsSurface>(random_tube(802, periodic_axis(3, 8), clamped_axis(2, 4)));
  expect_same(tube, occt_spline(*tube), "periodic_nurbs");
}

TEST_F(OcctIntersections, SweptSurfaces) {
  RandomNet net(810);
  const auto profile = std::make_shared<NurbsCurve>(clamped_axis(3, 6), net.points(6), net.weights(6));
  const Vec3 along(0.3, -0.2, 1.7), through(-2, 0.5, 0), turn = glm::normalize(Vec3(0.1, 0.2, 1));
  expect_same(std::make_shared<ExtrusionSurface>(profile, along),
              new Geom_SurfaceOfLinearExtrusion(occt_spline(*profile), occt_direction(along)), "extrusion",
              glm::length(along));
  expect_same(std::make_shared<RevolutionSurface>(profile, Axis{through, turn}),
              new Geom_SurfaceOfRevolution(occt_spline(*profile), gp_Ax1(occt_point(through), occt_direction(turn))),
              "revolution");
}

}  // namespace
}  // namespace lekalo::geometry::intersections_test
