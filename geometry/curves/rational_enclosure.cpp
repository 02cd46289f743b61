#include "geometry/curves/rational_enclosure.h"

#include <cmath>
#include <vector>

#include "geometry/curves/blossom.h"

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Bezier points of a homogeneous polynomial over a parameter box, each good to `slack` in each coordinate.
struct Hull {
  std::vector<Vec4> points;
  Vec4 slack{0};
};

Vec4 largest(std::span<const Vec4> points) {
  Vec4 result(0);
  for (const Vec4& p : points) result = glm::max(result, glm::abs(p));
  return result;
}

Interval coordinate(const Hull& hull, int axis) {
  Interval range{kInfinity, -kInfinity};
  for (const Vec4& p : hull.points) range = geometry::hull(range, Interval(p[axis]));
  return range + Interval(-hull.slack[axis], hull.slack[axis]);
}

// The hull of A - c w.
Interval moved(const Hull& hull, int axis, double c) {
  Interval range{kInfinity, -kInfinity};
  double magnitude = 0;
  for (const Vec4& p : hull.points) {
    range = geometry::hull(range, Interval(p[axis] - c * p.w));
    magnitude = std::max(magnitude, std::abs(p[axis]) + std::abs(c * p.w));
  }
  const double slack = hull.slack[axis] + std::abs(c) * hull.slack.w + 2 * kEpsilon * magnitude;
  return range + Interval(-slack, slack);
}

struct Box {
  Interval c[3];
  Box3 box() const { return {{c[0].lo, c[1].lo, c[2].lo}, {c[0].hi, c[1].hi, c[2].hi}}; }
};

Box point_box(const Hull& hull, bool rational) {
  Box box;
  const Interval w = coordinate(hull, 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (!rational) {
      box.c[axis] = coordinate(hull, axis);
    } else if (w.lo > 0) {
      Interval range{kInfinity, -kInfinity};
      const Interval slack(-hull.slack[axis], hull.slack[axis]), slack_w(-hull.slack.w, hull.slack.w);
      for (const Vec4& p : hull.points)
        range = geometry::hull(range, (Interval(p[axis]) + slack) / (Interval(p.w) + slack_w));
      box.c[axis] = range;
    } else {
      box.c[axis] = coordinate(hull, axis) / w;
    }
  }
  return box;
}

// The middle of a range, or 0 where it is unbounded.
double center(const Interval& range) {
  const double middle = range.middle();
  return std::isfinite(middle) ? middle : 0;
}

// Control points of the derivative of local control points 0..degree, read and written with a stride; knots are those
// of the whole curve. Returns the largest factor.
double differentiate(int degree, std::span<const double> knots, int span, const Vec4* points, int stride,
                     Vec4* result) {
  double largest_factor = 0;
  for (int j = 0; j < degree; ++j) {
    const double factor = degree / (knots[span + 1 + j] - knots[span + 1 - degree + j]);
    result[j * stride] = factor * (points[(j + 1) * stride] - points[j * stride]);
    largest_factor = std::max(largest_factor, factor);
  }
  return largest_factor;
}

double level_slack(int degree) { return 3 * (degree + 1) * kEpsilon; }

// A local tensor net: (degree_u + 1) x (degree_v + 1) points, with the error they carry so far.
struct Net {
  int degree_u, degree_v;
  std::vector<Vec4> points;
  Vec4 error{0};
};

// A side of degree 0 differentiates to zero.
Net differentiate_u(const Net& net, std::span<const double> knots, int span) {
  if (net.degree_u == 0) return {0, net.degree_v, std::vector<Vec4>(net.degree_v + 1, Vec4(0)), Vec4(0)};
  const int columns = net.degree_v + 1;
  Net result{net.degree_u - 1, net.degree_v, std::vector<Vec4>(net.degree_u * columns), Vec4(0)};
  double factor = 0;
  for (int j = 0; j < columns; ++j)
    factor = differentiate(net.degree_u, knots, span, net.points.data() + j, columns, result.points.data() + j);
  result.error = 2 * factor * net.error + 2 * kEpsilon * largest(result.points);
  return result;
}

Net differentiate_v(const Net& net, std::span<const double> knots, int span) {
  if (net.degree_v == 0) return {net.degree_u, 0, std::vector<Vec4>(net.degree_u + 1, Vec4(0)), Vec4(0)};
  const int columns = net.degree_v + 1;
  Net result{net.degree_u, net.degree_v - 1, std::vector<Vec4>((net.degree_u + 1) * net.degree_v), Vec4(0)};
  double factor = 0;
  for (int i = 0; i <= net.degree_u; ++i)
    for (int j = 0; j < net.degree_v; ++j) {
      const double f = net.degree_v / (knots[span + 1 + j] - knots[span + 1 - net.degree_v + j]);
      result.points[i * net.degree_v + j] = f * (net.points[i * columns + j + 1] - net.points[i * columns + j]);
      factor = std::max(factor, f);
    }
  result.error = 2 * factor * net.error + 2 * kEpsilon * largest(result.points);
  return result;
}

// Local control points of degree d stand at the knots around the span just as those of the full degree do.
void local_bezier(int degree, std::span<const double> knots, int span, const Vec4* points, int stride,
                  const Interval& t, Vec4* result) {
  bezier_points(degree, knots.subspan(span - degree), degree, points, stride, t.lo, t.hi, result, stride);
}

Hull bezier_hull(const Net& net, std::span<const double> knots_u, int span_u, std::span<const double> knots_v,
                 int span_v, const Rectangle& box) {
  const int columns = net.degree_v + 1;
  std::vector<Vec4> half(net.points.size());
  for (int j = 0; j < columns; ++j)
    local_bezier(net.degree_u, knots_u, span_u, net.points.data() + j, columns, box.u, half.data() + j);
  Hull hull;
  hull.points.resize(net.points.size());
  for (int i = 0; i <= net.degree_u; ++i)
    local_bezier(net.degree_v, knots_v, span_v, half.data() + i * columns, 1, box.v, hull.points.data() + i * columns);
  hull.slack = net.error + (level_slack(net.degree_u) + level_slack(net.degree_v)) * largest(net.points);
  return hull;
}

}  // namespace

void enclose_span(int degree, std::span<const double> knots, int span, std::span<const Vec4> points, bool rational,
                  const Interval& t, int order, CurveEnclosure& result) {
  // A curve is a net of one column.
  Net net{degree, 0, {points.begin() + (span - degree), points.begin() + (span + 1)}, Vec4(0)};
  const Rectangle box{t, {0, 1}};
  const double unit[2] = {0, 1};
  Hull hulls[3];
  for (int k = 0; k <= order; ++k) {
    if (k > 0) net = differentiate_u(net, knots, span);
    hulls[k] = bezier_hull(net, knots, span, unit, 0, box);
  }
  Box r[3];
  r[0] = point_box(hulls[0], rational);
  if (!rational) {
    for (int k = 1; k <= order; ++k) r[k] = point_box(hulls[k], false);
  } else if (order >= 1) {
    Interval w[3];
    for (int k = 0; k <= order; ++k) w[k] = coordinate(hulls[k], 3);
    for (int axis = 0; axis < 3; ++axis) {
      const double c = center(r[0].c[axis]);
      const Interval offset = r[0].c[axis] - Interval(c);
      r[1].c[axis] = (moved(hulls[1], axis, c) - w[1] * offset) / w[0];
      if (order >= 2) r[2].c[axis] = (moved(hulls[2], axis, c) - 2 * w[1] * r[1].c[axis] - w[2] * offset) / w[0];
    }
  }
  for (int k = 0; k <= order; ++k) result.d[k].include(r[k].box());
}

void enclose_spans(const NurbsSurfaceForm& form, int span_u, int span_v, bool rational, const Rectangle& box, int order,
                   SurfaceEnclosure& result) {
  const std::span<const double> ku = form.knots_u, kv = form.knots_v;
  const int p = form.degree_u, q = form.degree_v, count_v = form.count_v();
  Net nets[6];  // by SurfaceJet::index
  nets[0] = {p, q, {}, Vec4(0)};
  for (int i = span_u - p; i <= span_u; ++i)
    for (int j = span_v - q; j <= span_v; ++j)
      nets[0].points.push_back(form.points[static_cast<size_t>(i) * count_v + j]);
  if (order >= 1) {
    nets[1] = differentiate_u(nets[0], ku, span_u);
    nets[2] = differentiate_v(nets[0], kv, span_v);
  }
  if (order >= 2) {
    nets[3] = differentiate_u(nets[1], ku, span_u);
    nets[4] = differentiate_v(nets[1], kv, span_v);
    nets[5] = differentiate_v(nets[2], kv, span_v);
  }
  const int count = (order + 1) * (order + 2) / 2;
  Hull hulls[6];
  for (int k = 0; k < count; ++k) hulls[k] = bezier_hull(nets[k], ku, span_u, kv, span_v, box);

  Box r[6];
  r[0] = point_box(hulls[0], rational);
  if (!rational) {
    for (int k = 1; k < count; ++k) r[k] = point_box(hulls[k], false);
  } else if (order >= 1) {
    Interval w[6];
    for (int k = 0; k < count; ++k) w[k] = coordinate(hulls[k], 3);
    for (int axis = 0; axis < 3; ++axis) {
      const double c = center(r[0].c[axis]);
      const Interval offset = r[0].c[axis] - Interval(c);
      auto& ru = r[1].c[axis];
      auto& rv = r[2].c[axis];
      ru = (moved(hulls[1], axis, c) - w[1] * offset) / w[0];
      rv = (moved(hulls[2], axis, c) - w[2] * offset) / w[0];
      if (order < 2) continue;
      r[3].c[axis] = (moved(hulls[3], axis, c) - 2 * w[1] * ru - w[3] * offset) / w[0];
      r[4].c[axis] = (moved(hulls[4], axis, c) - w[1] * rv - w[2] * ru - w[4] * offset) / w[0];
      r[5].c[axis] = (moved(hulls[5], axis, c) - 2 * w[2] * rv - w[5] * offset) / w[0];
    }
  }
  for (int k = 0; k < count; ++k) result.values[k].include(r[k].box());
}

}  // namespace lekalo::geometry
