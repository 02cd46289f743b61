// The scene type of surfaces by least squares: where points of a cloud have their parameters from.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/surfaces/interpolation/fit_surface.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

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
    throw FieldError("points", "the points' parameters lie on one line", "give other ones by 'at' or 'near'");
  return box;
}

SurfaceData read_cloud(const Fields& f, Rectangle& domain) {
  SurfaceData data{f.points("points"), {}, {}};
  if (f.has("at") && f.has("near"))
    throw FieldError("near", "the points have parameters already", "give 'at' or 'near'");
  if (f.has("near")) {
    const Surface& near = *f.surface("near");
    if (!near.bounded()) throw FieldError("near", "the surface is unbounded", "give it a domain");
    const FootSearch feet(near);
    for (const Vec3& p : data.points) data.at.push_back(feet.at(p));
    domain = near.domain();
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
    for (const char* other : {"at", "near"})
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
      .optional("near", reference({Category::surface}),
                "a surface near `points`: their parameters are those of its nearest points. Without it and `at`: "
                "coordinates in the plane of least squared distances, along its main directions")
      .field("knots", knots().for_each_direction(),
             "of `grid` values of u at the rows and of v at the columns, or a rule: uniform, chord_length, centripetal",
             "chord_length")
      .optional("domain", rectangle(), "of the surface; else that of the parameters, or of `near`")
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
