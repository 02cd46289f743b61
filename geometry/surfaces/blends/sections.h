// Surfaces whose sections are conic arcs or straight lines between two curves (Golovanov 2016, 4.9.1, 4.10.1):
//
//   q(t, z) = ((1 - z)^2 a(t) + 2 (1 - z) z w(t) c(t) + z^2 b(t))/((1 - z)^2 + 2 (1 - z) z w(t) + z^2)
//   q(t, z) = (1 - z) a(t) + z b(t)
//
// a, b, w c and w are piecewise polynomials, so that the surface is a rational patch between their joints.
#pragma once

#include <memory>

#include "geometry/composition.h"
#include "geometry/curves/splines/polynomial_curve.h"
#include "geometry/surfaces/blends/contacts.h"

namespace lekalo::geometry {

using PolynomialPtr = std::shared_ptr<const PolynomialCurve>;

// The curves of a blend, over its domain of t.
struct BlendCurves {
  PolynomialPtr first, second;              // contacts
  PolynomialPtr center;                     // of the ball, or where the tangent planes of a chamfer meet
  PolynomialPtr middle, weight;             // w c, and w as x; null of chamfers
  PolynomialPtr first_image, second_image;  // contacts in the parameters of the surfaces; the second null at an edge
};

struct ConicSections {
  BlendCurves curves;
  std::array<SurfacePtr, 2> of;
  // z runs evenly with the angle of circular sections (Golovanov 2016, 4.9.9): z = sin(a x)/(sin(a x) + sin(a - a x)),
  // a half of the arc's angle, w = cos a.
  bool is_even = false;

  template <class T>
  Triple<T> operator()(const T& t, const T& x) const;
  std::vector<SurfacePiece> rational_pieces(const std::vector<double>& breaks_t,
                                            const std::vector<double>& breaks_z) const;
};

struct StraightSections {
  BlendCurves curves;
  std::array<SurfacePtr, 2> of;

  template <class T>
  Triple<T> operator()(const T& t, const T& z) const {
    return (1.0 - z) * curve_at(*curves.first, t) + z * curve_at(*curves.second, t);
  }
  std::vector<SurfacePiece> rational_pieces(const std::vector<double>& breaks_t,
                                            const std::vector<double>& breaks_z) const;
};

// How sections are made of contacts: circles (those of ellipses where the radii differ), or a weight of their own.
struct SectionShape {
  double weight = 0;  // 0: as a circle has it
  bool is_even = false;
};

// The curves of the contacts, to 1e-13 of the size. Throws FieldError where they are not smooth enough.
BlendCurves blend_curves(const Contacts& contacts, const SectionShape& shape);
// One of them as a spline of Bezier pieces.
CurvePtr as_spline(const PolynomialCurve& curve);
// What the curves share: domain, joints, period.
SurfaceProperties blend_properties(const Contacts& contacts, const BlendCurves& curves);

template <class T>
Triple<T> ConicSections::operator()(const T& t, const T& x) const {
  using std::acos;
  using std::sin;
  const T w = curve_at(*curves.weight, t).x;
  T z = x, y = 1.0 - x;
  if (is_even) {
    const T half = acos(w);
    z = sin(half * x), y = sin(half * (1.0 - x));
  }
  const T crossed = 2.0 * (y * z);
  const Triple<T> sum = (y * y) * curve_at(*curves.first, t) + crossed * curve_at(*curves.middle, t) +
                        (z * z) * curve_at(*curves.second, t);
  return sum / (y * y + crossed * w + z * z);
}

}  // namespace lekalo::geometry
