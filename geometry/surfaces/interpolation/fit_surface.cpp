// sum_k w_k |r(u_k, v_k) - p_k|^2 + stiffness * integral of r_uu^2 + 2 r_uv^2 + r_vv^2 is a sum of squares that are
// linear in the control points: the integral by Gauss's rule on each cell, which is exact. QR decomposition does not
// square the condition.
#include "geometry/surfaces/interpolation/fit_surface.h"

#include <fmt/format.h>

#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/curves/interpolation/collocation.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

namespace {

// Parameters stop moving when the sum of squares falls by less than this part.
constexpr double kSettled = 1e-9;
constexpr int kMaxControlPoints = 40000;

using Sparse = Eigen::SparseMatrix<double>;

struct Axes {
  SplineAxis u, v;
  int count() const { return u.distinct() * v.distinct(); }
};

Axes axes_of(const Rectangle& domain, const SurfaceFitOptions& options) {
  return {clamped_axis(options.degree_u, domain.u.lo, domain.u.hi, options.knots_u),
          clamped_axis(options.degree_v, domain.v.lo, domain.v.hi, options.knots_v)};
}

struct Basis {
  int first;
  std::vector<double> values;
};

Basis basis_at(const SplineAxis& axis, double t, int order) {
  const int p = axis.degree();
  const SplineAxis::Place place = axis.place(t);
  Basis basis{place.span - p, std::vector<double>(p + 1)};
  basis_derivative(p, axis.knots(), place.span, place.t, order, basis.values);
  return basis;
}

struct Rows {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vec3> right;

  // The derivative i times by u and j times by v at a place, times the scale, shall be the value times the scale.
  void add(const Axes& axes, const Vec2& at, int i, int j, double scale, const Vec3& value) {
    const Basis u = basis_at(axes.u, at.x, i), v = basis_at(axes.v, at.y, j);
    const int row = static_cast<int>(right.size());
    for (size_t k = 0; k < u.values.size(); ++k)
      for (size_t l = 0; l < v.values.size(); ++l)
        entries.emplace_back(row, (u.first + static_cast<int>(k)) * axes.v.distinct() + v.first + static_cast<int>(l),
                             scale * u.values[k] * v.values[l]);
    right.push_back(scale * value);
  }
};

// Gauss's places of all spans and their weights.
std::vector<std::pair<double, double>> gauss_places(const SplineAxis& axis) {
  const auto rule = gauss_legendre(axis.degree() + 1);
  std::vector<std::pair<double, double>> places;
  const auto& knots = axis.knots();
  for (int span = axis.degree(); span < axis.count(); ++span) {
    const double h = knots[span + 1] - knots[span];
    for (size_t k = 0; h > 0 && k < rule.nodes.size(); ++k)
      places.emplace_back(knots[span] + 0.5 * h * (1 + rule.nodes[k]), 0.5 * h * rule.weights[k]);
  }
  return places;
}

void add_stiffness(const Axes& axes, double stiffness, Rows& rows) {
  const auto in_v = gauss_places(axes.v);
  for (const auto& [u, weight_u] : gauss_places(axes.u))
    for (const auto& [v, weight_v] : in_v) {
      const double scale = std::sqrt(stiffness * weight_u * weight_v);
      if (axes.u.degree() > 1) rows.add(axes, {u, v}, 2, 0, scale, Vec3(0));
      rows.add(axes, {u, v}, 1, 1, std::sqrt(2.0) * scale, Vec3(0));
      if (axes.v.degree() > 1) rows.add(axes, {u, v}, 0, 2, scale, Vec3(0));
    }
}

NurbsSurface fitted(const SurfaceData& data, const Rectangle& domain, const SurfaceFitOptions& options) {
  const Axes axes = axes_of(domain, options);
  if (axes.count() > kMaxControlPoints)
    throw FieldError("spans", fmt::format("{} control points are more than {}", axes.count(), kMaxControlPoints));
  Rows rows;
  const Vec3 origin = data.points[0];
  for (size_t k = 0; k < data.points.size(); ++k)
    rows.add(axes, data.at[k], 0, 0, data.weights.empty() ? 1 : std::sqrt(data.weights[k]), data.points[k] - origin);
  if (options.stiffness > 0) add_stiffness(axes, options.stiffness, rows);
  const int count = axes.count(), height = static_cast<int>(rows.right.size());
  Sparse matrix(height, count);
  matrix.setFromTriplets(rows.entries.begin(), rows.entries.end());
  Eigen::MatrixX3d right(height, 3);
  for (int i = 0; i < height; ++i) right.row(i) << rows.right[i].x, rows.right[i].y, rows.right[i].z;
  const auto undetermined = [&] {
    return FieldError(
        "points",
        fmt::format("{} points do not determine a surface of degrees {} and {} with {} x {} control points",
                    data.points.size(), options.degree_u, options.degree_v, axes.u.distinct(), axes.v.distinct()),
        "fewer spans, points in all cells, or a stiffness");
  };
  if (height < count) throw undetermined();
  const Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> factors(matrix);
  if (factors.rank() < count) throw undetermined();
  const Eigen::MatrixX3d solution = factors.solve(right);
  std::vector<Vec3> control;
  for (int i = 0; i < count; ++i) control.push_back(origin + Vec3(solution(i, 0), solution(i, 1), solution(i, 2)));
  return NurbsSurface(axes.u, axes.v, control);
}

double sum_of_squares(const Surface& surface, const SurfaceData& data) {
  double sum = 0;
  for (size_t k = 0; k < data.points.size(); ++k) {
    const Vec3 off = surface.point(data.at[k].x, data.at[k].y) - data.points[k];
    sum += glm::dot(off, off);
  }
  return sum;
}

// One Newton step towards the foot of the point, inside the domain, taken where it brings the surface nearer.
Vec2 nearer_place(const Surface& surface, const Vec3& p, const Vec2& at) {
  const SurfaceJet jet = surface.evaluate(at.x, at.y, 2);
  const Vec3 off = jet.point() - p;
  const double a = glm::dot(jet.du(), jet.du()) + glm::dot(off, jet.duu()),
               b = glm::dot(jet.du(), jet.dv()) + glm::dot(off, jet.duv()),
               c = glm::dot(jet.dv(), jet.dv()) + glm::dot(off, jet.dvv()), determinant = a * c - b * b;
  if (!(determinant > 0 && a > 0)) return at;
  const double gu = glm::dot(off, jet.du()), gv = glm::dot(off, jet.dv());
  const Rectangle domain = surface.domain();
  const Vec2 moved(domain.u.clamp(at.x - (c * gu - b * gv) / determinant),
                   domain.v.clamp(at.y - (a * gv - b * gu) / determinant));
  return glm::length(surface.point(moved.x, moved.y) - p) < glm::length(off) ? moved : at;
}

// The knots with more in the middle of these spans.
std::vector<double> halved(const std::vector<double>& inner, const Interval& range, const std::vector<bool>& wrong) {
  std::vector<double> ends{range.lo};
  ends.insert(ends.end(), inner.begin(), inner.end());
  ends.push_back(range.hi);
  std::vector<double> result;
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    if (k > 0) result.push_back(ends[k]);
    if (wrong[k]) result.push_back(0.5 * (ends[k] + ends[k + 1]));
  }
  return result;
}

size_t span_of(const std::vector<double>& inner, double t) {
  return static_cast<size_t>(std::upper_bound(inner.begin(), inner.end(), t) - inner.begin());
}

}  // namespace

NurbsSurface fit_surface(SurfaceData& data, const Rectangle& domain, const SurfaceFitOptions& options) {
  NurbsSurface result = fitted(data, domain, options);
  double sum = sum_of_squares(result, data);
  for (int pass = 0; pass < options.passes; ++pass) {
    SurfaceData moved = data;
    for (size_t k = 0; k < data.points.size(); ++k) moved.at[k] = nearer_place(result, data.points[k], data.at[k]);
    const NurbsSurface next = fitted(moved, domain, options);
    const double smaller = sum_of_squares(next, moved);
    if (!(smaller < sum)) break;
    const bool settled = sum - smaller <= kSettled * sum;
    sum = smaller;
    result = next;
    data = std::move(moved);
    if (settled) break;
  }
  return result;
}

namespace {

struct Attempt {
  SurfaceData data;
  SurfaceFitOptions options;
  std::optional<NurbsSurface> surface;
  double largest = kInfinity;  // distance of a point

  // Spans in which a point is farther away than the tolerance.
  std::vector<bool> wrong_spans(bool along_u, double tolerance) const {
    const std::vector<double>& knots = along_u ? options.knots_u : options.knots_v;
    std::vector<bool> wrong(knots.size() + 1);
    for (size_t k = 0; k < data.points.size(); ++k) {
      const Vec2& at = data.at[k];
      if (glm::length(surface->point(at.x, at.y) - data.points[k]) > tolerance)
        wrong[span_of(knots, along_u ? at.x : at.y)] = true;
    }
    return wrong;
  }
};

// Without a surface where the points do not determine it.
Attempt attempt(const SurfaceData& data, const Rectangle& domain, SurfaceFitOptions options) {
  Attempt result{data, std::move(options), {}, kInfinity};
  try {
    result.surface = fit_surface(result.data, domain, result.options);
  } catch (const FieldError&) {
    return result;
  }
  result.largest = 0;
  for (size_t k = 0; k < result.data.points.size(); ++k) {
    const Vec2& at = result.data.at[k];
    result.largest = std::max(result.largest, glm::length(result.surface->point(at.x, at.y) - result.data.points[k]));
  }
  return result;
}

}  // namespace

NurbsSurface fit_surface_within(SurfaceData& data, const Rectangle& domain, const SurfaceFitOptions& options,
                                double tolerance) {
  Attempt found = attempt(data, domain, options);
  if (!found.surface) return fit_surface(data, domain, options);  // says what is wrong with the points
  while (found.largest > tolerance) {
    SurfaceFitOptions in_u = found.options, in_v = found.options;
    in_u.knots_u = halved(in_u.knots_u, domain.u, found.wrong_spans(true, tolerance));
    in_v.knots_v = halved(in_v.knots_v, domain.v, found.wrong_spans(false, tolerance));
    Attempt by_u = attempt(data, domain, std::move(in_u)), by_v = attempt(data, domain, std::move(in_v));
    Attempt& better = by_u.largest <= by_v.largest ? by_u : by_v;
    if (!better.surface)
      throw FieldError("tolerance",
                       fmt::format("not reached: with {} x {} spans a point is still {:.3g} away",
                                   found.options.knots_u.size() + 1, found.options.knots_v.size() + 1, found.largest),
                       "a stiffness, or a spline_surface, which goes through all points of a grid");
    found = std::move(better);
  }
  data = std::move(found.data);
  return *found.surface;
}

FootSearch::FootSearch(const Surface& surface) : surface_(surface) {
  constexpr int kTried = 32;
  const Rectangle domain = surface.domain();
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const Vec2 at(domain.u.clamp(domain.u.lo + domain.u.width() * i / kTried),
                    domain.v.clamp(domain.v.lo + domain.v.width() * j / kTried));
      grid_.push_back({at, surface.point(at.x, at.y)});
    }
}

Vec2 FootSearch::at(const Vec3& p) const {
  constexpr int kSteps = 60;
  const auto distance = [&](const Start& start) { return glm::dot(start.point - p, start.point - p); };
  Vec2 best = std::min_element(grid_.begin(), grid_.end(), [&](const Start& a, const Start& b) {
                return distance(a) < distance(b);
              })->uv;
  for (int step = 0; step < kSteps; ++step) {
    const Vec2 next = nearer_place(surface_, p, best);
    if (next == best) break;
    best = next;
  }
  return best;
}

}  // namespace lekalo::geometry
