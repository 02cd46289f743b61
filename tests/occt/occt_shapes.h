// Our shapes as OCCT's, made from the same numbers.
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax3.hxx>
#include <random>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

inline gp_Pnt occt_point(const Vec3& p) { return {p.x, p.y, p.z}; }
inline gp_Dir occt_direction(const Vec3& d) { return {d.x, d.y, d.z}; }
inline Vec3 from_occt(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
inline gp_Ax3 occt_frame(const Frame& f) { return {occt_point(f.origin), occt_direction(f.z), occt_direction(f.x)}; }
inline gp_Ax2 occt_axes(const Frame& f) { return {occt_point(f.origin), occt_direction(f.z), occt_direction(f.x)}; }

// A frame in general position.
inline Frame tilted_frame() { return frame_from({0.3, -1.2, 2.1}, {0.3, 0.5, 0.8}, {0.7, -0.6, 0.2}); }

// Distinct knots with their multiplicities. Of a periodic axis: one period.
struct OcctKnots {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
};

inline OcctKnots occt_knots(const SplineAxis& axis) {
  std::vector<double> distinct;
  std::vector<int> times;
  for (const double knot : axis.knots()) {
    if (axis.periodic() && (knot < axis.domain().lo || knot > axis.domain().hi)) continue;
    if (distinct.empty() || knot != distinct.back()) {
      distinct.push_back(knot);
      times.push_back(0);
    }
    ++times.back();
  }
  const int n = static_cast<int>(distinct.size());
  OcctKnots result{TColStd_Array1OfReal(1, n), TColStd_Array1OfInteger(1, n)};
  for (int i = 0; i < n; ++i) {
    result.knots(i + 1) = distinct[i];
    result.multiplicities(i + 1) = times[i];
  }
  return result;
}

inline Handle(Geom_BSplineCurve) occt_spline(const NurbsCurve& curve) {
  const int n = curve.axis().distinct();
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    const Vec4& h = curve.points()[i];
    poles(i + 1) = occt_point(Vec3(h) / h.w);
    weights(i + 1) = h.w;
  }
  const OcctKnots knots = occt_knots(curve.axis());
  return new Geom_BSplineCurve(poles, weights, knots.knots, knots.multiplicities, curve.degree(),
                               curve.axis().periodic());
}

inline Handle(Geom_BSplineSurface) occt_spline(const NurbsSurface& surface) {
  const int m = surface.axis_u().distinct(), n = surface.axis_v().distinct(), stride = surface.axis_v().count();
  TColgp_Array2OfPnt poles(1, m, 1, n);
  TColStd_Array2OfReal weights(1, m, 1, n);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec4& h = surface.form().points[static_cast<size_t>(i) * stride + j];
      poles(i + 1, j + 1) = occt_point(Vec3(h) / h.w);
      weights(i + 1, j + 1) = h.w;
    }
  const OcctKnots u = occt_knots(surface.axis_u()), v = occt_knots(surface.axis_v());
  return new Geom_BSplineSurface(poles, weights, u.knots, v.knots, u.multiplicities, v.multiplicities,
                                 surface.axis_u().degree(), surface.axis_v().degree(), surface.axis_u().periodic(),
                                 surface.axis_v().periodic());
}

// Points in a unit cube, weights in [1/2, 2].
struct RandomNet {
  std::mt19937_64 random;
  std::uniform_real_distribution<double> unit{0, 1};

  explicit RandomNet(unsigned seed) : random(seed) {}
  std::vector<Vec3> points(int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
      const double x = unit(random), y = unit(random);
      result.push_back({x, y, unit(random)});
    }
    return result;
  }
  std::vector<double> weights(int count) {
    std::vector<double> result;
    for (int i = 0; i < count; ++i) result.push_back(std::exp2(2 * unit(random) - 1));
    return result;
  }
};

// A rough height field over the unit square, m x n points, rational.
inline NurbsSurface random_sheet(unsigned seed, const SplineAxis& u, const SplineAxis& v) {
  RandomNet net(seed);
  const int m = u.distinct(), n = v.distinct();
  std::vector<Vec3> points;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.4 * net.unit(net.random)) / m, y = (j + 0.4 * net.unit(net.random)) / n;
      points.push_back({x, y, net.unit(net.random)});
    }
  return NurbsSurface(u, v, points, net.weights(m * n));
}

// A rough closed tube: `u` periodic.
inline NurbsSurface random_tube(unsigned seed, const SplineAxis& u, const SplineAxis& v) {
  RandomNet net(seed);
  const int m = u.distinct(), n = v.distinct();
  std::vector<Vec3> points;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double radius = 1 + 0.4 * net.unit(net.random), angle = kTwoPi * i / m;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle), 2.0 * j / n});
    }
  return NurbsSurface(u, v, points, net.weights(m * n));
}

inline SplineAxis clamped_axis(int degree, int points) {
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < points - degree; ++i) knots.push_back(i + 0.2 * (i % 3));
  knots.insert(knots.end(), degree + 1, points - degree + 0.0);
  return SplineAxis(degree, knots, Extension::tangent);
}

inline SplineAxis uniform_axis(int degree, int points) {
  std::vector<double> knots;
  for (int i = 0; i < points + degree + 1; ++i) knots.push_back(i);
  return SplineAxis(degree, knots, Extension::tangent);
}

inline SplineAxis periodic_axis(int degree, int points) {
  std::vector<double> knots;
  for (int i = -degree; i <= points + degree; ++i) knots.push_back(i);
  return SplineAxis(degree, knots, Extension::periodic);
}

// Bezier: one span from 0 to 1.
inline SplineAxis bezier_axis(int degree) {
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), degree + 1, 1.0);
  return SplineAxis(degree, knots, Extension::analytic);
}

}  // namespace lekalo::geometry
