#include "geometry/curves/splines/rational_enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxSide = kMaxDegree + 1;

struct Box {
  Interval c[3];
  Box3 box() const { return {{c[0].lo, c[1].lo, c[2].lo}, {c[0].hi, c[1].hi, c[2].hi}}; }
};

// The Bezier points over a part of a span are sums of its control points with these weights, [Bezier][control]: de
// Boor's recursion backwards (geometry/curves/splines/blossom.h), with one argument at each level.
struct SpanMatrix {
  int side;
  double weights[kMaxSide][kMaxSide];

  SpanMatrix(int degree, std::span<const double> knots, int span, const Interval& t) : side(degree + 1) {
    struct Share {
      double from, to;
    };
    Share shares[kMaxSide][kMaxSide];  // [level][control]
    for (int r = 1; r <= degree; ++r)
      for (int j = r; j <= degree; ++j) {
        const double knot = knots[span - degree + j], inverse = 1 / (knots[span + j + 1 - r] - knot);
        shares[r][j] = {std::clamp((t.lo - knot) * inverse, 0.0, 1.0), std::clamp((t.hi - knot) * inverse, 0.0, 1.0)};
      }
    for (int m = 0; m <= degree; ++m) {
      double* w = weights[m];
      for (int j = 0; j < degree; ++j) w[j] = 0;
      w[degree] = 1;
      for (int r = degree; r >= 1; --r)
        for (int j = r; j <= degree; ++j) {
          const double share = r > degree - m ? shares[r][j].to : shares[r][j].from, value = w[j];
          w[j - 1] += (1 - share) * value;
          w[j] = share * value;
        }
    }
  }
};

// What sum of weights a row of the matrix and the sum over it may be wrong by: five roundings of each share, three at
// each level, and those of the products.
double matrix_slack(int side) { return (16 * side + 2) * kEpsilon; }

struct Size {
  int rows, columns;
  int count() const { return rows * columns; }
  // Of the net of a derivative: a side of degree 0 differentiates to zero.
  Size differentiated(int by_u, int by_v) const { return {std::max(rows - by_u, 1), std::max(columns - by_v, 1)}; }
};

// A net of points with what each is good to in each coordinate.
struct Net {
  Lanes slack;
  Lanes points[kMaxSide * kMaxSide];
};

inline void largest(const Net& net, Size size, Lanes& most) {
  most = Lanes{};
  Lanes of_point;
  for (int k = 0; k < size.count(); ++k) {
    absolute(net.points[k], of_point);
    most = of_point > most ? of_point : most;
  }
}

// Control points of the derivative.
inline void differentiate(const Net& net, Size size, bool by_u, std::span<const double> knots, int span, Net& result) {
  const Size less = size.differentiated(by_u, !by_u);
  const int degree = (by_u ? size.rows : size.columns) - 1;
  if (degree == 0) {
    result.slack = Lanes{};
    for (int k = 0; k < less.count(); ++k) result.points[k] = Lanes{};
    return;
  }
  const int step = by_u ? size.columns : 1;
  double factors[kMaxSide], most = 0;
  for (int k = 0; k < degree; ++k) {
    factors[k] = degree / (knots[span + 1 + k] - knots[span + 1 - degree + k]);
    most = std::max(most, factors[k]);
  }
  for (int i = 0; i < less.rows; ++i)
    for (int j = 0; j < less.columns; ++j) {
      const Lanes* at = net.points + i * size.columns + j;
      result.points[i * less.columns + j] = factors[by_u ? i : j] * (at[step] - at[0]);
    }
  Lanes largest_one;
  largest(result, less, largest_one);
  result.slack = 2 * most * net.slack + 2 * kEpsilon * largest_one;
}

// The Bezier points over a part of the spans.
inline void bezier_hull(const Net& net, Size size, const SpanMatrix& u, const SpanMatrix& v, Net& hull) {
  const auto [rows, columns] = size;
  Lanes half[kMaxSide * kMaxSide];
  for (int m = 0; m < rows; ++m)
    for (int j = 0; j < columns; ++j) {
      Lanes sum{};
      for (int i = 0; i < rows; ++i) sum += u.weights[m][i] * net.points[i * columns + j];
      half[m * columns + j] = sum;
    }
  for (int i = 0; i < rows; ++i)
    for (int m = 0; m < columns; ++m) {
      Lanes sum{};
      for (int j = 0; j < columns; ++j) sum += v.weights[m][j] * half[i * columns + j];
      hull.points[i * columns + m] = sum;
    }
  largest(net, size, hull.slack);
  hull.slack = net.slack + (matrix_slack(u.side) + matrix_slack(v.side)) * hull.slack;
}

// Ranges of all coordinates of A - c w; the last is that of w where c is zero.
inline void ranges(const Net& hull, Size size, const Vec3& c, Interval* result) {
  const Lanes center = {c.x, c.y, c.z, 0};
  Lanes least{}, most{}, terms{};
  for (int k = 0; k < size.count(); ++k) {
    const Lanes &p = hull.points[k], off = center * p[3];
    const Lanes moved = p - off;
    if (k == 0) least = most = moved;
    least = moved < least ? moved : least;
    most = moved > most ? moved : most;
    Lanes of_p, of_off;
    absolute(p, of_p), absolute(off, of_off);
    of_p += of_off;
    terms = of_p > terms ? of_p : terms;
  }
  Lanes slack;
  absolute(center, slack);
  slack = 1.0000001 * (hull.slack + slack * hull.slack[3] + 3 * kEpsilon * terms);
  for (int axis = 0; axis < 4; ++axis) result[axis] = {least[axis] - slack[axis], most[axis] + slack[axis]};
}

// The box of A/w: of the projected points where all weights are positive.
inline Box point_box(const Net& hull, Size size, bool rational) {
  Box box;
  Interval plain[4];
  ranges(hull, size, Vec3(0), plain);
  if (!rational || !(plain[3].lo > 0)) {
    for (int axis = 0; axis < 3; ++axis) box.c[axis] = rational ? plain[axis] / plain[3] : plain[axis];
    return box;
  }
  Lanes least{}, most{};
  for (int k = 0; k < size.count(); ++k) {
    const Lanes r = hull.points[k] / hull.points[k][3];
    if (k == 0) least = most = r;
    least = r < least ? r : least;
    most = r > most ? r : most;
  }
  // (A + a)/(w + b) - A/w = (a - b A/w)/(w + b)
  for (int axis = 0; axis < 3; ++axis) {
    const double farthest = std::max(std::abs(least[axis]), std::abs(most[axis]));
    const double slack =
        1.0000001 * ((hull.slack[axis] + hull.slack[3] * farthest) / plain[3].lo + 3 * kEpsilon * farthest);
    box.c[axis] = {least[axis] - slack, most[axis] + slack};
  }
  return box;
}

// The middle of a range, or 0 where it is unbounded.
double center(const Interval& range) {
  const double middle = range.middle();
  return std::isfinite(middle) ? middle : 0;
}

constexpr int count_to(int order) { return (order + 1) * (order + 2) / 2; }

constexpr double kChoose[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};

// The boxes of a net of this size, the first, and of its derivatives up to order <= kOrder, by SurfaceJet::index. All
// is compiled into the functions below, so that of a size that is known there loops have known lengths.
template <int kOrder>
inline void boxes_of(Net* nets, Size size, std::span<const double> ku, int span_u, std::span<const double> kv,
                     int span_v, bool rational, const Rectangle& box, int order, bool of_curve, Box* r) {
  const auto matrices = [](int degree, std::span<const double> knots, int span, const Interval& t) {
    const auto of = [&](int k) { return SpanMatrix(std::max(degree - k, 0), knots, span, t); };
    if constexpr (kOrder == 2)
      return std::array{of(0), of(1), of(2)};
    else
      return std::array{of(0), of(1), of(2), of(3), of(4)};
  };
  const auto u = matrices(size.rows - 1, ku, span_u, box.u), v = matrices(size.columns - 1, kv, span_v, box.v);
  Net hull;
  Interval of[count_to(kOrder)][4];
  Vec3 c(0);
  Interval offset[3];
  const auto take = [&](int by_u, int by_v) {
    const int k = SurfaceJet::index(by_u, by_v);
    const Size own = size.differentiated(by_u, by_v);
    if (by_v > 0)
      differentiate(nets[SurfaceJet::index(by_u, by_v - 1)], size.differentiated(by_u, by_v - 1), false, kv, span_v,
                    nets[k]);
    else if (by_u > 0)
      differentiate(nets[SurfaceJet::index(by_u - 1, 0)], size.differentiated(by_u - 1, 0), true, ku, span_u, nets[k]);
    bezier_hull(nets[k], own, u[by_u], v[by_v], hull);
    if (k == 0) {
      r[0] = point_box(hull, own, rational);
      if (!rational) return;
      for (int axis = 0; axis < 3; ++axis) {
        c[axis] = center(r[0].c[axis]);
        offset[axis] = r[0].c[axis] - Interval(c[axis]);
      }
      Interval plain[4];
      ranges(hull, own, Vec3(0), plain);
      of[0][3] = plain[3];
    } else if (rational) {
      ranges(hull, own, c, of[k]);
    } else {
      r[k] = point_box(hull, own, false);
    }
  };
  // Of one curve only the derivatives by u.
  take(0, 0);
  if (order >= 1) take(1, 0);
  if (order >= 1 && !of_curve) take(0, 1);
  if (order >= 2) take(2, 0);
  if (order >= 2 && !of_curve) take(1, 1), take(0, 2);
  for (int n = 3; n <= std::min(order, kOrder); ++n)
    for (int j = 0; j <= (of_curve ? 0 : n); ++j) take(n - j, j);
  if (!rational || order == 0) return;
  const auto w = [&](int k) -> const Interval& { return of[k][3]; };
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& off = offset[axis];
    Interval &ru = r[1].c[axis], &rv = r[2].c[axis];
    ru = (of[1][axis] - w(1) * off) / w(0);
    if (!of_curve) rv = (of[2][axis] - w(2) * off) / w(0);
    if (order < 2) continue;
    r[3].c[axis] = (of[3][axis] - 2 * w(1) * ru - w(3) * off) / w(0);
    if (of_curve) continue;
    r[4].c[axis] = (of[4][axis] - w(1) * rv - w(2) * ru - w(4) * off) / w(0);
    r[5].c[axis] = (of[5][axis] - 2 * w(2) * rv - w(5) * off) / w(0);
  }
  // Leibniz: A~_ij = sum over (a, b) of C(i, a) C(j, b) w_ab r_(i-a)(j-b), r_00 being the offset.
  for (int n = 3; n <= std::min(order, kOrder); ++n)
    for (int j = 0; j <= (of_curve ? 0 : n); ++j)
      for (int axis = 0; axis < 3; ++axis) {
        const int i = n - j, k = SurfaceJet::index(i, j);
        Interval rest = of[k][axis];
        for (int a = 0; a <= i; ++a)
          for (int b = 0; b <= j; ++b)
            if (a + b > 0)
              rest -= kChoose[i][a] * kChoose[j][b] * w(SurfaceJet::index(a, b)) *
                      (a + b == n ? offset[axis] : r[SurfaceJet::index(i - a, j - b)].c[axis]);
        r[k].c[axis] = rest / w(0);
      }
}

template <int kOrder>
inline void boxes_of(int degree, std::span<const double> knots, int span, std::span<const Vec4> points, bool rational,
                     const Interval& t, int order, Box* r) {
  Net nets[count_to(kOrder)];
  nets[0].slack = Lanes{};
  for (int i = 0; i <= degree; ++i) load(points[span - degree + i], nets[0].points[i]);
  const double unit[2] = {0, 1};
  boxes_of<kOrder>(nets, {degree + 1, 1}, knots, span, unit, 0, rational, {t, {0, 1}}, order, true, r);
}

LEKALO_WIDE void enclose_curve(int degree, std::span<const double> knots, int span, std::span<const Vec4> points,
                               bool rational, const Interval& t, int order, Box* r) {
  if (order <= 2)
    boxes_of<2>(degree, knots, span, points, rational, t, order, r);
  else
    boxes_of<4>(degree, knots, span, points, rational, t, order, r);
}

template <int kOrder>
inline void boxes_of(const NurbsSurfaceForm& form, int p, int q, int span_u, int span_v, bool rational,
                     const Rectangle& box, int order, Box* r) {
  Net nets[count_to(kOrder)];
  nets[0].slack = Lanes{};
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j)
      load(form.points[static_cast<size_t>(span_u - p + i) * form.count_v() + span_v - q + j],
           nets[0].points[i * (q + 1) + j]);
  boxes_of<kOrder>(nets, {p + 1, q + 1}, form.knots_u, span_u, form.knots_v, span_v, rational, box, order, false, r);
}

LEKALO_WIDE void enclose_surface(const NurbsSurfaceForm& form, int span_u, int span_v, bool rational,
                                 const Rectangle& box, int order, Box* r) {
  if (order > 2)
    boxes_of<4>(form, form.degree_u, form.degree_v, span_u, span_v, rational, box, order, r);
  else if (form.degree_u == 3 && form.degree_v == 3)  // as most models have them
    boxes_of<2>(form, 3, 3, span_u, span_v, rational, box, order, r);
  else
    boxes_of<2>(form, form.degree_u, form.degree_v, span_u, span_v, rational, box, order, r);
}

}  // namespace

void enclose_span(int degree, std::span<const double> knots, int span, std::span<const Vec4> points, bool rational,
                  const Interval& t, int order, CurveEnclosure& result) {
  Box r[count_to(kMaxSurfaceOrder)];
  enclose_curve(degree, knots, span, points, rational, t, order, r);
  // A curve is a net of one column: its derivatives are those by u.
  for (int k = 0; k <= order; ++k) result.d[k].include(r[SurfaceJet::index(k, 0)].box());
}

void enclose_spans(const NurbsSurfaceForm& form, int span_u, int span_v, bool rational, const Rectangle& box, int order,
                   SurfaceEnclosure& result) {
  Box r[count_to(kMaxSurfaceOrder)];
  enclose_surface(form, span_u, span_v, rational, box, order, r);
  for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k) result.values[k].include(r[k].box());
}

}  // namespace lekalo::geometry
