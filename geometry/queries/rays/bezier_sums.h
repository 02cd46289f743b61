// The sums that evaluate a rational Bezier patch, for the functions that are compiled for several processors.
#pragma once

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/lanes.h"
#include "geometry/queries/rays/bezier_patch.h"

namespace lekalo::geometry {

// A number, or the same one for several places at once. (Not returned: Lanes are returned otherwise by other
// processors.)
template <class Number>
inline void set_all(Number& numbers, double x) {
  numbers = x - Number{};
}

// Bernstein functions of degree n and their derivatives at s, by the recurrence (Golovanov 2016, 2.4.4); written out up
// to degree 3. Number: double, or Lanes for four places at once.
template <class Number>
inline void bernstein(int n, const Number& s, Number* b, Number* d) {
  const Number r = 1 - s;
  switch (n) {
    case 1:
      b[0] = r, b[1] = s;
      set_all(d[0], -1), set_all(d[1], 1);
      return;
    case 2:
      b[0] = r * r, b[1] = 2 * r * s, b[2] = s * s;
      d[0] = -2 * r, d[1] = 2 * (r - s), d[2] = 2 * s;
      return;
    case 3: {
      const Number rr = r * r, rs = 2 * r * s, ss = s * s;
      b[0] = rr * r, b[1] = 3 * rr * s, b[2] = 3 * r * ss, b[3] = ss * s;
      d[0] = -3 * rr, d[1] = 3 * (rr - rs), d[2] = 3 * (rs - ss), d[3] = 3 * ss;
      return;
    }
    default:
      break;
  }
  set_all(b[0], 1);
  const auto raise_to = [&](int k) {
    Number carry{};
    for (int i = 0; i < k; ++i) {
      const Number value = b[i];
      b[i] = carry + r * value;
      carry = s * value;
    }
    b[k] = carry;
  };
  for (int k = 1; k < n; ++k) raise_to(k);
  // The derivatives are n times differences of the functions of degree n - 1.
  if (n == 0) {
    d[0] = Number{};
    return;
  }
  d[0] = -n * b[0];
  for (int i = 1; i < n; ++i) d[i] = n * (b[i - 1] - b[i]);
  d[n] = n * b[n - 1];
  raise_to(n);
}

// Adds a multiple of a control point to a sum.
inline void add_product(double f, const Vec4& p, Lanes& sum) {
  Lanes c;
  load(p, c);
  sum += f * c;
}

// A homogeneous point and its derivatives by s and t.
template <class Point>
struct PatchSums {
  Point point{}, ds{}, dt{};
};

// At one place of the patch, with Lanes for a homogeneous point, or at several. 0: the patch's own degree.
template <int kP, int kQ, class Number, class Point>
inline PatchSums<Point> sums(const PatchView& patch, const Number& s, const Number& t) {
  const int p = kP > 0 ? kP : patch.degree_u, q = kQ > 0 ? kQ : patch.degree_v;
  Number bu[kMaxDegree + 1], du[kMaxDegree + 1], bv[kMaxDegree + 1], dv[kMaxDegree + 1];
  bernstein(p, s, bu, du);
  bernstein(q, t, bv, dv);
  PatchSums<Point> result;
  const Vec4* point = patch.points;
  for (int i = 0; i <= p; ++i) {
    Point row{}, row_t{};
    for (int j = 0; j <= q; ++j, ++point) {
      add_product(bv[j], *point, row);
      add_product(dv[j], *point, row_t);
    }
    result.point += bu[i] * row;
    result.ds += du[i] * row;
    result.dt += bu[i] * row_t;
  }
  return result;
}

// Calls f<p, q>() for the patch's degrees where most models have them, so that its loops have known lengths, else f<0,
// 0>().
template <class F>
inline auto for_degrees(const PatchView& patch, const F& f) {
  if (patch.degree_u == patch.degree_v) switch (patch.degree_u) {
      case 2:
        return f.template operator()<2, 2>();
      case 3:
        return f.template operator()<3, 3>();
      case 5:
        return f.template operator()<5, 5>();
      case 7:  // what is fitted to other surfaces
        return f.template operator()<7, 7>();
      default:
        break;
    }
  return f.template operator()<0, 0>();
}

}  // namespace lekalo::geometry
