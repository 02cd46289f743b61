// Distances of bodies against OCCT's BRepExtrema_DistShapeShape. Its numerical search may stop at a larger distance:
// ours must not be larger, both must agree for nearly all pairs, and our two points must lie on both bodies.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopoDS_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/closest/distance.h"
#include "occt/occt_shapes.h"
#include "support/tier.h"

namespace lekalo::geometry::distance_test {
namespace {

// Of the distance: what OCCT's search asks for.
constexpr double kAgrees = 1e-6;

struct Pair {
  Body own;
  TopoDS_Compound theirs;
};

TopoDS_Compound compound(const std::vector<TopoDS_Face>& faces) {
  TopoDS_Compound all;
  const TopoDS_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Face& face : faces) builder.Add(all, face);
  return all;
}

TopoDS_Face disc(const Frame& frame, double height, double radius) {
  const gp_Ax2 axes(occt_point(frame.point({0, 0, height})), occt_direction(frame.z));
  const TopoDS_Wire circle = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, radius)));
  return BRepBuilderAPI_MakeFace(gp_Pln(axes.Location(), axes.Direction()), circle);
}

Pair make(int kind, const Frame& frame, double size) {
  const gp_Ax3 axes = occt_frame(frame);
  if (kind == 0) {
    const Vec3 sides(size, 1.5 * size, 0.7 * size);
    std::vector<TopoDS_Face> faces;
    for (int axis = 0; axis < 3; ++axis)
      for (const double end : {0.0, 1.0}) {
        BRepBuilderAPI_MakePolygon wire;
        for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
          Vec3 corner;
          corner[axis] = end, corner[(axis + 1) % 3] = a, corner[(axis + 2) % 3] = b;
          wire.Add(occt_point(frame.point(corner * sides)));
        }
        wire.Close();
        Vec3 normal(0), through(0);
        normal[axis] = 1, through[axis] = end;
        faces.push_back(BRepBuilderAPI_MakeFace(
            gp_Pln(occt_point(frame.point(through * sides)), occt_direction(frame.direction(normal))), wire.Wire()));
      }
    return {box(frame, sides), compound(faces)};
  }
  if (kind == 1) {
    const Handle(Geom_Surface) side = new Geom_CylindricalSurface(axes, 0.5 * size);
    return {cylinder_body(frame, 0.5 * size, size),
            compound({BRepBuilderAPI_MakeFace(side, 0, kTwoPi, 0, size, 1e-9), disc(frame, 0, 0.5 * size),
                      disc(frame, size, 0.5 * size)})};
  }
  if (kind == 2) {
    const Handle(Geom_Surface) all = new Geom_SphericalSurface(axes, 0.6 * size);
    return {ball(frame, 0.6 * size), compound({BRepBuilderAPI_MakeFace(all, 0, kTwoPi, -kPi / 2, kPi / 2, 1e-9)})};
  }
  const Handle(Geom_Surface) all = new Geom_ToroidalSurface(axes, 0.7 * size, 0.25 * size);
  return {torus_body(frame, 0.7 * size, 0.25 * size),
          compound({BRepBuilderAPI_MakeFace(all, 0, kTwoPi, 0, kTwoPi, 1e-9)})};
}

TEST(OcctDistance, OfBodiesIsNoLarger) {
  std::mt19937_64 random(31);
  const auto number = [&](double half) { return std::uniform_real_distribution<double>(-half, half)(random); };
  const auto frame = [&](double half) {
    return frame_about({number(half), number(half), number(half)},
                       glm::normalize(Vec3(number(1), number(1), number(1) + 1.5)));
  };
  int compared = 0, agree = 0, intersection = 0;
  const int pairs = tests::tier_count(500, 20);
  for (int trial = 0; trial < pairs; ++trial) {
    const Pair a = make(trial % 4, frame(1), 1), b = make(trial / 4 % 4, frame(3), 1.3);
    const Distance own = distance(&a.own, &b.own, DistanceMinima::nearest);
    BRepExtrema_DistShapeShape theirs(a.theirs, b.theirs);
    ASSERT_TRUE(theirs.IsDone());
    ++compared;
    intersection += own.meet;
    EXPECT_LE(own.distance, theirs.Value() * (1 + kAgrees) + 1e-7) << "trial " << trial;
    agree += std::abs(own.distance - theirs.Value()) <= kAgrees * std::max(1.0, theirs.Value());
    // Points of ours are points of theirs.
    for (const auto& [place, body] : {std::pair(own.minima[0].a, &a.theirs), std::pair(own.minima[0].b, &b.theirs)}) {
      const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(occt_point(place.point));
      EXPECT_LE(BRepExtrema_DistShapeShape(vertex, *body).Value(), 1e-7) << "trial " << trial;
    }
    EXPECT_LE(own.distance - own.bound, 1e-12) << "trial " << trial;
  }
  EXPECT_GE(agree, compared * 9 / 10);
  tests::report_figure("pairs", compared);
  tests::report_figure("agree", agree);
  tests::report_figure("meeting", intersection);
}

}  // namespace
}  // namespace lekalo::geometry::distance_test
