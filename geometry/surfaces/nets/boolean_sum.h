// Surfaces that blend curves: the Boolean sum of two families (Gordon 1969; Golovanov 2016, 3.4, 3.5),
//
//   r(u, v) = sum a_i(v) c_i(u) + sum b_j(u) g_j(v) - sum b_j(u) a_i(v) p_ji
//
// c_i and g_j are curves, or derivatives of a surface across its edge; a_i and b_j are functions of one number. Ruled,
// lofted, translational, Coons, Gordon surfaces and those on points are all of this kind and differ in their functions.
// Where all operands are polynomials the surface is a polynomial patch on each cell between their knots, and traced as
// such; so is one rational family whose members have the same denominator.
#pragma once

#include "geometry/composition.h"

namespace lekalo::geometry {

// Curves, and for each the function that it is multiplied by: the first coordinate of a curve, a spline for the most
// part.
struct Family {
  std::vector<CurvePtr> curves;
  std::vector<CurvePtr> functions;
};

struct BooleanSum {
  Family along_u, along_v;                // c_i with a_i(v); g_j with b_j(u)
  std::vector<std::vector<Vec3>> points;  // [j][i]

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const;

  // The patches of cells between the breaks, u outer; none where they are not rational.
  std::vector<SurfacePiece> rational_pieces(const std::vector<double>& breaks_u,
                                            const std::vector<double>& breaks_v) const;
};

using BlendedSurface = ComposedSurface<BooleanSum>;

// The surface over the rectangle. The curves of `along_u` and the functions of `along_v` are defined over its u, the
// others over its v; either family may be empty.
BlendedSurface blended_surface(BooleanSum sum, const Rectangle& domain, const Periods& periods = {});

// Functions over the span of `nodes` (increasing): each is 1 at its node and 0 at the others.
std::vector<CurvePtr> lagrange_functions(const std::vector<double>& nodes);
// Cubic Hermite splines whose derivatives at the nodes are those of the parabola through three neighbours, at the ends
// as of a cubic without second derivative there (Golovanov 2016, 3.4); two nodes: linear. `closed`: the last node is
// the first again, and has no function of its own.
std::vector<CurvePtr> hermite_functions(const std::vector<double>& nodes, bool closed);
// At the nodes of a net with the functions of Hermite both ways the mixed derivative of the sum becomes the mean of
// those that the two families have there (Golovanov 2016, 3.5.7).
void mean_twists(BooleanSum& sum, const std::vector<double>& at_u, const std::vector<double>& at_v);
// C2 cubic splines, natural or periodic.
std::vector<CurvePtr> spline_functions(const std::vector<double>& nodes, bool closed);
// The B-splines of a knot vector, rational with weights (none: all 1).
std::vector<CurvePtr> b_spline_functions(int degree, const std::vector<double>& knots,
                                         const std::vector<double>& weights, int count);

// 0, 1 and their derivatives up to order n: function 2 k + i has the k-th derivative 1 at i, and all others up to n are
// 0 at both ends (Forrest; Golovanov 2016, 3.5, generalised Coons patch), over an interval.
std::vector<CurvePtr> end_functions(int n, const Interval& range);

// The function that is 1.
CurvePtr one_function(const Interval& range);

template <class T>
Triple<T> BooleanSum::operator()(const T& u, const T& v) const {
  Triple<T> sum{T(0), T(0), T(0)};
  std::vector<T> a, b;
  for (const CurvePtr& function : along_u.functions) a.push_back(curve_at(*function, v).x);
  for (const CurvePtr& function : along_v.functions) b.push_back(curve_at(*function, u).x);
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * curve_at(*along_u.curves[i], u);
  for (size_t j = 0; j < b.size(); ++j) sum += b[j] * curve_at(*along_v.curves[j], v);
  for (size_t j = 0; j < points.size(); ++j)
    for (size_t i = 0; i < points[j].size(); ++i) sum -= (b[j] * a[i]) * triple(points[j][i]);
  return sum;
}

}  // namespace lekalo::geometry
