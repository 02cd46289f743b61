// Surfaces made of curves and of other surfaces against those that OCCT makes of the same: Coons patches, lofts of two
// curves, pipes and offsets. Pipes are approximations in OCCT, and compared by the closest distance.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomAbs_Shape.hxx>
#include <GeomFill.hxx>
#include <GeomFill_BezierCurves.hxx>
#include <GeomFill_Pipe.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_OffsetSurface.hxx>

#include <random>

#include "geometry/curves/splines/nurbs_curve.h"
#include "occt/occt_shapes.h"
#include "occt/occt_surfaces.h"
#include "render/every_surface/examples.h"
#include "support/tier.h"

namespace lekalo::render::made_surfaces_test {
namespace {

using namespace geometry;
using every_surface::surface_of;

using Poles = std::vector<Vec3>;

std::string in_scene(const Poles& poles) {
  std::string text;
  for (const Vec3& p : poles)
    text += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}]", text.empty() ? "" : ", ", p.x, p.y, p.z);
  return "{ type: bezier_curve, points: [" + text + "] }";
}

Handle(Geom_BezierCurve) in_occt(const Poles& poles) {
  TColgp_Array1OfPnt theirs(1, static_cast<int>(poles.size()));
  for (size_t i = 0; i < poles.size(); ++i)
    theirs(static_cast<int>(i) + 1) = gp_Pnt(poles[i].x, poles[i].y, poles[i].z);
  return new Geom_BezierCurve(theirs);
}

class MadeSurfaces : public testing::Test {
 protected:
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Poles between(const Vec3& a, const Vec3& b, int degree) {
    Poles poles{a};
    for (int i = 1; i < degree; ++i)
      poles.push_back(a + (b - a) * (i / double(degree)) +
                      Vec3(number(-0.4, 0.4), number(-0.4, 0.4), number(-0.4, 0.4)));
    poles.push_back(b);
    return poles;
  }
  Vec3 near(double x, double y) { return {x + number(-0.3, 0.3), y + number(-0.3, 0.3), number(-0.5, 0.5)}; }

 private:
  std::mt19937_64 random_{61};
};

constexpr double kSame = 1e-12;  // exact on both sides

// OCCT calls the bilinearly blended patch a stretched one.
TEST_F(MadeSurfaces, CoonsPatches) {
  for (int k = 0; k < tests::tier_count(400, 10); ++k) {
    const Vec3 a = near(0, 0), b = near(3, 0), c = near(3, 3), d = near(0, 3);
    const Poles lower = between(a, b, 3), upper = between(d, c, 3), left = between(a, d, 4), right = between(b, c, 4);
    const SurfacePtr own = surface_of(fmt::format("{{ type: coons_surface, u_lines: [{}, {}], v_lines: [{}, {}] }}",
                                                  in_scene(lower), in_scene(upper), in_scene(left), in_scene(right)));
    const Handle(Geom_BezierSurface) theirs =
        GeomFill_BezierCurves(in_occt(lower), in_occt(right), in_occt(upper), in_occt(left), GeomFill_StretchStyle)
            .Surface();
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j)
        ASSERT_LE(glm::length(from_occt(theirs->Value(0.1 * i, 0.1 * j).XYZ()) - own->point(0.1 * i, 0.1 * j)), kSame)
            << k << ": " << i << ", " << j;
  }
}

TEST_F(MadeSurfaces, RuledSurfaces) {
  for (int k = 0; k < tests::tier_count(400, 10); ++k) {
    const Poles first = between(near(0, 0), near(3, 0), 4), second = between(near(0, 3), near(3, 3), 2);
    const Handle(Geom_Surface) theirs = GeomFill::Surface(in_occt(first), in_occt(second));
    for (const char* type : {"ruled_surface", "loft_surface"}) {
      const SurfacePtr own =
          surface_of(fmt::format("{{ type: {}, of: [{}, {}] }}", type, in_scene(first), in_scene(second)));
      for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j)
          ASSERT_LE(glm::length(from_occt(theirs->Value(0.1 * i, 0.1 * j).XYZ()) - own->point(0.1 * i, 0.1 * j)), kSame)
              << type;
    }
  }
}

// The largest distance of places of ours from theirs.
double largest_distance(const Surface& own, const Handle(Geom_Surface) & theirs) {
  const Rectangle domain = own.domain();
  double largest = 0;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) {
      const Vec3 p = own.point(domain.u.lo + domain.u.width() * i / 8, domain.v.lo + domain.v.width() * j / 8);
      const GeomAPI_ProjectPointOnSurf foot(gp_Pnt(p.x, p.y, p.z), theirs);
      largest = std::max(largest, foot.NbPoints() > 0 ? foot.LowerDistance() : kInfinity);
    }
  return largest;
}

constexpr double kSameOfPipes = 1e-6;

TEST_F(MadeSurfaces, RoundPipes) {
  for (int k = 0; k < tests::tier_count(100, 2); ++k) {
    const Poles path = between(near(0, 0), near(6, 0), 4);
    GeomFill_Pipe pipe(in_occt(path), 0.3);
    pipe.Perform(1e-7, false, GeomAbs_C1, 11, 200);
    const SurfacePtr own = surface_of(
        fmt::format("{{ type: sweep_surface, path: {}, section: {{ type: circle, radius: 0.3 }} }}", in_scene(path)));
    EXPECT_LE(largest_distance(*own, pipe.Surface()), kSameOfPipes) << k;
  }
}

// In a plane, where all frames are one.
TEST_F(MadeSurfaces, PipesWithSections) {
  for (int k = 0; k < tests::tier_count(100, 4); ++k) {
    Poles path = between(near(0, 0), near(6, 0), 4), section = between(Vec3(0), Vec3(0.5, 0.4, 0), 3);
    for (Vec3& p : path) p.z = 0;
    const Vec3 begin = path[0], t = glm::normalize(path[1] - path[0]), b = glm::cross(t, Vec3(0, 0, 1));
    Poles placed;
    for (const Vec3& p : section) placed.push_back(begin + p.x * Vec3(0, 0, 1) + p.y * b);
    for (Vec3& p : section) p.z = 0;
    GeomFill_Pipe pipe(in_occt(path), in_occt(placed), GeomFill_IsCorrectedFrenet);
    pipe.Perform(1e-7, false, GeomAbs_C1, 11, 200);
    const SurfacePtr own = surface_of(fmt::format(
        "{{ type: sweep_surface, path: {}, section: {}, frame: {{ fixed: z }} }}", in_scene(path), in_scene(section)));
    EXPECT_LE(largest_distance(*own, pipe.Surface()), kSameOfPipes) << k;
  }
}

TEST_F(MadeSurfaces, Offsets) {
  for (int k = 0; k < tests::tier_count(400, 10); ++k) {
    const Poles first = between(near(0, 0), near(3, 0), 4), second = between(near(0, 3), near(3, 3), 4);
    const double distance = number(0.1, 0.5);
    const Handle(Geom_OffsetSurface) theirs =
        new Geom_OffsetSurface(GeomFill::Surface(in_occt(first), in_occt(second)), distance);
    const SurfacePtr own = surface_of(
        fmt::format("{{ type: offset_surface, distance: {:.17g}, of: {{ type: ruled_surface, of: [{}, {}] }} }}",
                    distance, in_scene(first), in_scene(second)));
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        gp_Pnt p;
        gp_Vec u, v;
        theirs->D1(0.1 * i, 0.1 * j, p, u, v);
        const SurfaceJet jet = own->evaluate(0.1 * i, 0.1 * j, 1);
        EXPECT_LE(glm::length(from_occt(p.XYZ()) - jet.point()), kSame);
        EXPECT_LE(glm::length(from_occt(u.XYZ()) - jet.du()), 1e-10 * (1 + glm::length(jet.du())));
        EXPECT_LE(glm::length(from_occt(v.XYZ()) - jet.dv()), 1e-10 * (1 + glm::length(jet.dv())));
      }
  }
}

}  // namespace
}  // namespace lekalo::render::made_surfaces_test
