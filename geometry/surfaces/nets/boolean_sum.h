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

  // Its points (u_i, v_j) at i * v.size() + j: every operand is evaluated once for each u, or v.
  std::vector<Vec3> points_over_grid(const std::vector<double>& u, const std::vector<double>& v) const;

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
// Cubics between neighbouring nodes whose derivatives vanish at all of them.
std::vector<CurvePtr> step_functions(const std::vector<double>& nodes);
// The B-splines of a knot vector, rational with weights (none: all 1).
std::vector<CurvePtr> b_spline_functions(int degree, const std::vector<double>& knots,
                                         const std::vector<double>& weights, int count);

// 0, 1 and their derivatives up to order n: function 2 k + i has the k-th derivative 1 at i, and all others up to n are
// 0 at both ends (Forrest; Golovanov 2016, 3.5, generalised Coons patch), over an interval.
std::vector<CurvePtr> end_functions(int n, const Interval& range);

// The function that is 1.
CurvePtr one_function(const Interval& range);

namespace detail {

template <class S, int N>
void add_product(const Triple<Jet<S, N>>& of_u, const Jet<S, N>& of_v, bool swapped, Triple<Jet2<S, N>>& sum) {
  for (int n = 0; n <= N; ++n)
    for (int j = 0; j <= n; ++j) {
      const int k = Jet2<S, N>::index(n - j, j), own = swapped ? j : n - j, other = swapped ? n - j : j;
      sum.x.c[k] += of_u.x.c[own] * of_v.c[other];
      sum.y.c[k] += of_u.y.c[own] * of_v.c[other];
      sum.z.c[k] += of_u.z.c[own] * of_v.c[other];
    }
}

// At u and v themselves every term is a product of a function of u and one of v.
template <class S, int N>
Triple<Jet2<S, N>> sum_of_products(const BooleanSum& of, const S& u, const S& v) {
  const auto at_u = Jet<S, N>::variable(u), at_v = Jet<S, N>::variable(v);
  Triple<Jet2<S, N>> sum;
  std::vector<Jet<S, N>> a, b;
  for (size_t i = 0; i < of.along_u.curves.size(); ++i) {
    a.push_back(curve_at(*of.along_u.functions[i], at_v).x);
    add_product(curve_at(*of.along_u.curves[i], at_u), a.back(), false, sum);
  }
  for (size_t j = 0; j < of.along_v.curves.size(); ++j) {
    b.push_back(curve_at(*of.along_v.functions[j], at_u).x);
    add_product(curve_at(*of.along_v.curves[j], at_v), b.back(), true, sum);
  }
  for (size_t j = 0; j < of.points.size(); ++j) {
    Triple<Jet<S, N>> row;
    for (size_t i = 0; i < of.points[j].size(); ++i) row -= a[i] * triple(of.points[j][i]);
    add_product(row, b[j], true, sum);
  }
  return sum;
}

}  // namespace detail

template <class T>
Triple<T> BooleanSum::operator()(const T& u, const T& v) const {
  if constexpr (requires { T::v_variable(u.value()); })
    if (detail::are_variables(u, v))
      return detail::sum_of_products<typename T::Scalar, T::kOrder>(*this, u.value(), v.value());
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
