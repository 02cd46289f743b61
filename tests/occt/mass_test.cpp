// Lengths, areas, volumes, centroids and inertia against OCCT's GProp: 1e-7 of the value (of the size, of the largest
// moment).
//
// Bodies are lists of outward faces, whose integrals add up: the headers of OCCT's primitives need one that Debian's
// packages do not have (NCollection_AliasedArray.hxx).
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopoDS_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "occt/occt_shapes.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::mass_test {
namespace {

constexpr double kIntegrals = 1e-7;
constexpr double kAsked = 1e-9;  // of OCCT's adaptive quadrature

using Faces = std::vector<TopoDS_Face>;

TopoDS_Face face_of(const Handle(Geom_Surface) & surface, const Rectangle& part) {
  return BRepBuilderAPI_MakeFace(surface, part.u.lo, part.u.hi, part.v.lo, part.v.hi, 1e-7);
}

// Corners counterclockwise seen from outside.
TopoDS_Face polygon(const std::vector<Vec3>& corners) {
  BRepBuilderAPI_MakePolygon wire;
  Vec3 normal(0);
  for (size_t i = 0; i < corners.size(); ++i) {
    wire.Add(occt_point(corners[i]));
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  wire.Close();
  return BRepBuilderAPI_MakeFace(gp_Pln(occt_point(corners[0]), occt_direction(normal)), wire.Wire());
}

// A disc at a height of the frame, looking up or down.
TopoDS_Face disc(const Frame& frame, double height, double radius, bool up) {
  const Vec3 center = frame.point({0, 0, height});
  const gp_Dir normal = occt_direction(up ? frame.z : -frame.z);
  const TopoDS_Wire circle =
      BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(occt_point(center), normal), radius)));
  return BRepBuilderAPI_MakeFace(gp_Pln(occt_point(center), normal), circle);
}

// Between two polygons with corners in pairs, counterclockwise in the frame's plane.
Faces prismatoid(const Frame& frame, const std::vector<Vec2>& base, const std::vector<Vec2>& top, double height) {
  std::vector<Vec3> lower, upper;
  for (const Vec2& p : base) lower.push_back(frame.point({p.x, p.y, 0}));
  for (const Vec2& p : top) upper.push_back(frame.point({p.x, p.y, height}));
  Faces faces{polygon({lower.rbegin(), lower.rend()}), polygon(upper)};
  for (size_t i = 0, n = base.size(); i < n; ++i)
    faces.push_back(polygon({lower[i], lower[(i + 1) % n], upper[(i + 1) % n], upper[i]}));
  return faces;
}

// The ends of equal parts of every span of the axis.
std::vector<double> lines(const SplineAxis& axis, int parts) {
  std::vector<double> result;
  for (const int span : axis.spans_over(axis.domain()))
    for (int k = 0; k < parts; ++k)
      result.push_back(axis.knots()[span] + k * (axis.knots()[span + 1] - axis.knots()[span]) / parts);
  result.push_back(axis.domain().hi);
  return result;
}

class OcctMass : public testing::Test {
 protected:
  double worst_ = 0;
  void TearDown() override { tests::report_figure("largest_relative_difference", worst_); }

  void expect_near(double own, double theirs, const char* what) {
    worst_ = tests::worse(worst_, std::abs(own - theirs) / std::abs(theirs));
    EXPECT_NEAR(own, theirs, kIntegrals * std::abs(theirs)) << what;
  }

  void expect_same(const Body& own, const Faces& theirs) {
    TopoDS_Compound all;
    const TopoDS_Builder builder;
    builder.MakeCompound(all);
    for (const TopoDS_Face& face : theirs) builder.Add(all, face);
    GProp_GProps area, volume;
    BRepGProp::SurfaceProperties(all, area, kAsked);
    BRepGProp::VolumeProperties(all, volume, kAsked);
    const MassProperties found = measure(own);
    expect_near(found.area.value, area.Mass(), "area");
    expect_near(found.volume.value, volume.Mass(), "volume");
    const double size = bounds(own).diameter();
    EXPECT_LE(glm::length(found.centroid - from_occt(volume.CentreOfMass().XYZ())), kIntegrals * size);
    // About the centre of mass, along the world's axes.
    const gp_Mat inertia = volume.MatrixOfInertia();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(found.inertia[i][j], inertia.Value(i + 1, j + 1), kIntegrals * found.principal_moments[2])
            << "moment " << i << ", " << j;
  }

  // OCCT's rule does not split at knots and stops too early: it gets the cells between the lines one by one.
  void expect_same_area(const Surface& own, const Handle(Geom_Surface) & theirs, const std::vector<double>& u,
                        const std::vector<double>& v) {
    GProp_GProps area;
    for (size_t i = 0; i + 1 < u.size(); ++i)
      for (size_t j = 0; j + 1 < v.size(); ++j) {
        GProp_GProps cell;
        BRepGProp::SurfaceProperties(face_of(theirs, {{u[i], u[i + 1]}, {v[j], v[j + 1]}}), cell, kAsked);
        area.Add(cell);
      }
    const SurfaceMeasures found = measure(own);
    expect_near(found.area.value, area.Mass(), "area");
    EXPECT_LE(glm::length(found.centroid - from_occt(area.CentreOfMass().XYZ())), kIntegrals * bounds(own).diameter());
  }

  void expect_same_length(const Curve& own, const Handle(Geom_Curve) & theirs) {
    const GeomAdaptor_Curve curve(theirs, own.domain().lo, own.domain().hi);
    expect_near(measure(own).length.value, GCPnts_AbscissaPoint::Length(curve, kAsked), "length");
  }
};

TEST_F(OcctMass, RoundBodies) {
  const Frame frame = tilted_frame();
  const gp_Ax3 axes = occt_frame(frame);
  expect_same(ball(frame, 1.5), {face_of(new Geom_SphericalSurface(axes, 1.5), SphereSurface::kFull)});
  expect_same(torus_body(frame, 3, 1), {face_of(new Geom_ToroidalSurface(axes, 3, 1), {{0, kTwoPi}, {0, kTwoPi}})});
  expect_same(cylinder_body(frame, 0.8, 2), {disc(frame, 0, 0.8, false), disc(frame, 2, 0.8, true),
                                             face_of(new Geom_CylindricalSurface(axes, 0.8), {{0, kTwoPi}, {0, 2}})});
  for (const double top : {1.0, 0.0}) {
    // OCCT counts v along the generator.
    const Handle(Geom_Surface) side = new Geom_ConicalSurface(axes, std::atan2(top - 2, 3), 2);
    Faces faces{disc(frame, 0, 2, false), face_of(side, {{0, kTwoPi}, {0, std::hypot(2 - top, 3)}})};
    if (top > 0) faces.push_back(disc(frame, 3, top, true));
    expect_same(frustum(frame, 2, top, 3), faces);
  }
}

TEST_F(OcctMass, Polyhedra) {
  const Frame frame = tilted_frame();
  const std::vector<Vec2> rectangle{{0, 0}, {3, 0}, {3, 2}, {0, 2}};
  expect_same(box(frame, {3, 2, 1.5}), prismatoid(frame, rectangle, rectangle, 1.5));
  expect_same(wedge(frame, {3, 2, 1.5}, 1), prismatoid(frame, rectangle, {{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1.5));
  const std::vector<Vec2> base{{0, 0}, {2, 0}, {2.5, 1}, {1, 2}, {0.8, 1.1}, {-0.5, 1}};
  expect_same(prism(frame, base, 1.7), prismatoid(frame, base, base, 1.7));
  // The part of a pyramid below three quarters of its height.
  const Vec3 apex(0.5, 0.7, 4);
  std::vector<Vec2> top;
  for (const Vec2& p : base) top.push_back(0.25 * p + 0.75 * Vec2(apex));
  expect_same(pyramid(frame, base, apex, 0.25), prismatoid(frame, base, top, 3));
}

TEST_F(OcctMass, FreeFormSurfaces) {
  for (int degree = 2; degree <= (tests::is_full_tier() ? 5 : 2); ++degree) {
    SCOPED_TRACE(degree);
    const SplineAxis clamped = clamped_axis(degree, degree + 3), ring = periodic_axis(degree, degree + 5);
    const NurbsSurface sheet = random_sheet(700 + degree, clamped, clamped);
    expect_same_area(sheet, occt_spline(sheet), lines(clamped, 6), lines(clamped, 6));
    const NurbsSurface tube = random_tube(710 + degree, ring, clamped);
    expect_same_area(tube, occt_spline(tube), lines(ring, 6), lines(clamped, 6));
  }
}

TEST_F(OcctMass, SweptSurfaces) {
  RandomNet net(720);
  const auto profile = std::make_shared<NurbsCurve>(clamped_axis(3, 7), net.points(7), net.weights(7));
  const Vec3 along(0.3, -0.2, 1.7), through(-2, 0.5, 0), turn = glm::normalize(Vec3(0.1, 0.2, 1));
  const std::vector<double> u = lines(profile->axis(), 32);
  const double length = glm::length(along);
  expect_same_area(ExtrusionSurface(profile, along),
                   new Geom_SurfaceOfLinearExtrusion(occt_spline(*profile), occt_direction(along)), u,
                   {0, 0.5 * length, length});
  expect_same_area(
      RevolutionSurface(profile, {through, turn}, 2),
      new Geom_SurfaceOfRevolution(occt_spline(*profile), gp_Ax1(occt_point(through), occt_direction(turn))),
      {0, 0.5, 1, 1.5, 2}, u);
}

TEST_F(OcctMass, Curves) {
  expect_same_length(Ellipse(tilted_frame(), 3, 1.25), new Geom_Ellipse(occt_axes(tilted_frame()), 3, 1.25));
  for (int degree = 2; degree <= 5; ++degree) {
    SCOPED_TRACE(degree);
    RandomNet net(730 + degree);
    for (const SplineAxis& axis : {clamped_axis(degree, degree + 4), periodic_axis(degree, degree + 4)}) {
      const NurbsCurve curve(axis, net.points(degree + 4), net.weights(degree + 4));
      expect_same_length(curve, occt_spline(curve));
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::mass_test
