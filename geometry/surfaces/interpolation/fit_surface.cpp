// sum_k w_k |r(u_k, v_k) - p_k|^2 + stiffness * integral of r_uu^2 + 2 r_uv^2 + r_vv^2 is a sum of squares that are
// linear in the control points: the integral by Gauss's rule on each cell, which is exact. QR decomposition does not
// square the condition.
#include "geometry/surfaces/interpolation/fit_surface.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>

#include "geometry/curves/interpolation/collocation.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/surfaces/interpolation/point_grid.h"

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

// Whether each span between the breaks is to be halved.
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

NurbsSurface fit_surface_within(SurfaceData& data, const Rectangle& domain, SurfaceFitOptions options,
                                double tolerance) {
  while (true) {
    SurfaceData moved = data;
    const NurbsSurface found = fit_surface(moved, domain, options);
    std::vector<bool> wrong_u(options.knots_u.size() + 1), wrong_v(options.knots_v.size() + 1);
    double largest = 0;
    for (size_t k = 0; k < moved.points.size(); ++k) {
      const Vec2& at = moved.at[k];
      const double off = glm::length(found.point(at.x, at.y) - moved.points[k]);
      largest = std::max(largest, off);
      if (off > tolerance) wrong_u[span_of(options.knots_u, at.x)] = wrong_v[span_of(options.knots_v, at.y)] = true;
    }
    if (largest <= tolerance) {
      data = std::move(moved);
      return found;
    }
    options.knots_u = halved(options.knots_u, domain.u, wrong_u);
    options.knots_v = halved(options.knots_v, domain.v, wrong_v);
    const size_t count =
        (options.knots_u.size() + options.degree_u + 1) * (options.knots_v.size() + options.degree_v + 1);
    if (count > kMaxControlPoints || (count > data.points.size() && options.stiffness == 0))
      throw FieldError("tolerance",
                       fmt::format("not reached: with {} x {} spans a point is still {:.3g} away", wrong_u.size(),
                                   wrong_v.size(), largest),
                       "a spline_surface goes through all points of a grid");
  }
}

Vec2 foot_parameters(const Surface& surface, const Vec3& p) {
  constexpr int kTried = 32, kSteps = 60;
  const Rectangle domain = surface.domain();
  Vec2 best(domain.u.lo, domain.v.lo);
  double least = kInfinity;
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const Vec2 at(domain.u.clamp(domain.u.lo + domain.u.width() * i / kTried),
                    domain.v.clamp(domain.v.lo + domain.v.width() * j / kTried));
      const double far = glm::length(surface.point(at.x, at.y) - p);
      if (far < least) least = far, best = at;
    }
  for (int step = 0; step < kSteps; ++step) {
    const Vec2 next = nearer_place(surface, p, best);
    if (next == best) break;
    best = next;
  }
  return best;
}

namespace {

// Coordinates in the plane of least squared distances, along its two main directions.
std::vector<Vec2> places_in_plane(const std::vector<Vec3>& points) {
  Vec3 middle(0);
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) {
    const Eigen::Vector3d off(p.x - middle.x, p.y - middle.y, p.z - middle.z);
    moments += off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);  // increasing
  const auto axis = [&](int k) {
    const Eigen::Vector3d e = solver.eigenvectors().col(k);
    const Vec3 along(e.x(), e.y(), e.z());
    // Their signs mean nothing: the largest coordinate is positive.
    const double most = std::abs(along.x) >= std::abs(along.y) && std::abs(along.x) >= std::abs(along.z) ? along.x
                        : std::abs(along.y) >= std::abs(along.z)                                         ? along.y
                                                                                                         : along.z;
    return most < 0 ? -along : along;
  };
  const Vec3 x = axis(2), y = axis(1);
  std::vector<Vec2> at;
  for (const Vec3& p : points) at.emplace_back(glm::dot(p - middle, x), glm::dot(p - middle, y));
  return at;
}

Rectangle bounds_of(const std::vector<Vec2>& at) {
  Rectangle box{{at[0].x, at[0].x}, {at[0].y, at[0].y}};
  for (const Vec2& p : at) box.u = hull(box.u, Interval(p.x)), box.v = hull(box.v, Interval(p.y));
  if (!(box.u.width() > 0 && box.v.width() > 0))
    throw FieldError("points", "the points' parameters lie on one line", "give other ones by 'at' or 'on'");
  return box;
}

SurfaceData read_cloud(const Fields& f, Rectangle& domain) {
  SurfaceData data{f.points("points"), {}, {}};
  if (f.has("at") && f.has("on")) throw FieldError("on", "the points have parameters already", "give 'at' or 'on'");
  if (f.has("on")) {
    const Surface& on = *f.surface("on");
    if (!on.bounded()) throw FieldError("on", "the surface is unbounded", "give it a domain");
    for (const Vec3& p : data.points) data.at.push_back(foot_parameters(on, p));
    domain = on.domain();
    return data;
  }
  if (f.has("at")) {
    for (const Vec3& place : f.points("at")) data.at.emplace_back(place);
    if (data.at.size() != data.points.size())
      throw FieldError("at",
                       fmt::format("{} points need as many parameters, not {}", data.points.size(), data.at.size()));
  } else {
    data.at = places_in_plane(data.points);
  }
  domain = bounds_of(data.at);
  return data;
}

SurfaceData read_data(const Fields& f, Rectangle& domain) {
  if (f.has("grid") == f.has("points"))
    throw FieldError(f.has("grid") ? "grid" : "points", "the points are given either in a grid or without order",
                     "give 'points' or 'grid'");
  SurfaceData data;
  if (f.has("grid")) {
    for (const char* other : {"at", "on"})
      if (f.has(other)) throw FieldError(other, "points of a grid have their parameters by 'knots'");
    const PointGrid grid = read_open_grid(f, "grid");
    data.points = grid.points.values;
    for (const double u : grid.at_u)
      for (const double v : grid.at_v) data.at.emplace_back(u, v);
    domain = {{grid.at_u.front(), grid.at_u.back()}, {grid.at_v.front(), grid.at_v.back()}};
  } else {
    data = read_cloud(f, domain);
  }
  if (f.has("weights")) data.weights = f.numbers("weights");
  if (!data.weights.empty() && data.weights.size() != data.points.size())
    throw FieldError("weights",
                     fmt::format("{} weights do not fit {} points", data.weights.size(), data.points.size()));
  for (size_t k = 0; k < data.weights.size(); ++k)
    if (!(data.weights[k] > 0))
      throw FieldError("weights", fmt::format("weight {} is {}, not positive", k, data.weights[k]));
  if (f.has("domain")) {
    const Rectangle own = f.rectangle("domain");
    for (const Vec2& at : data.at)
      if (!own.contains(at.x, at.y))
        throw FieldError("domain", fmt::format("a point has the parameters {:.6g}, {:.6g} outside", at.x, at.y));
    domain = own;
  }
  return data;
}

std::vector<double> even_inner(const Interval& range, int spans) {
  std::vector<double> knots;
  for (int k = 1; k < spans; ++k) knots.push_back(range.lo + range.width() * k / spans);
  return knots;
}

NurbsSurface build(const Fields& f) {
  Rectangle domain;
  SurfaceData data = read_data(f, domain);
  if (!f.has("spans.u") && !f.has("tolerance"))
    throw FieldError("points", "how many pieces the surface has is not said", "give 'spans' or 'tolerance'");
  const int spans_u = f.has("spans.u") ? f.u<int>("spans") : 1, spans_v = f.has("spans.v") ? f.v<int>("spans") : 1;
  const SurfaceFitOptions options{
      f.u<int>("degree"),    f.v<int>("degree"), even_inner(domain.u, spans_u), even_inner(domain.v, spans_v),
      f.number("stiffness"), f.integer("passes")};
  return f.has("tolerance") ? fit_surface_within(data, domain, options, f.number("tolerance"))
                            : fit_surface(data, domain, options);
}

}  // namespace

TypeDeclaration fit_surface_type() {
  return declare(
             Category::surface, "fit_surface",
             "Surface near points by least squares: points of a grid, or a measured cloud in any order. One span is "
             "a polynomial.")
      .example(
          "spans: 1, degree: 1, points: [[0, 0, 0], [1, 0, 1], [0, 1, 1], [1, 1, 0], [0.5, 0.5, 0.6], [0.2, 0.7, 0.5]]")
      .optional("points", points().count(4), "the points, in any order")
      .optional("grid", net(), "or the points in rows along v, rows following one another along u")
      .optional("at", parameter_points(), "the parameters (u, v) of `points`")
      .optional("on", reference({Category::surface}),
                "a surface near `points`: their parameters are those of its nearest points. Without it and `at`: "
                "coordinates in the plane of least squared distances, along its main directions")
      .field("knots", knots().for_each_direction(),
             "of `grid` values of u at the rows and of v at the columns, or a rule: uniform, chord_length, centripetal",
             "chord_length")
      .optional("domain", rectangle(), "of the surface; else that of the parameters, or of `on`")
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "degrees of the polynomial pieces", "3")
      .optional("spans", integer().between(1, 200).for_each_direction(), "number of equal pieces")
      .optional("tolerance", length().positive(),
                "largest distance of a point from the surface at its parameters: spans are halved until it holds")
      .optional("weights", numbers(), "weight of each squared distance; all 1 when left out")
      .field("stiffness", number().non_negative(),
             "weight of the integral of r_uu^2 + 2 r_uv^2 + r_vv^2 beside the sum of squared distances", "0")
      .field("passes", integer().between(0, 1000),
             "how often parameters of points move to where the surface is nearest", "0")
      .shows({"control_net", "knots"})
      .built_by(build);
}

}  // namespace lekalo::geometry
