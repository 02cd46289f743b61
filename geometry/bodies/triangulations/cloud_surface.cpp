// NURBS surfaces near measured sheets: the points are joined as they lie in space, the sheet is laid over the unit
// square (Floater 2003), and a spline is fitted to the points at these parameters (Golovanov 2016, 3.17).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/bodies/triangulations/flattening.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/fit_surface.h"
#include "geometry/tessellation/cloud_triangulation.h"

namespace lekalo::geometry {

namespace {

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// The places of the four border points at which the sheet has the smallest angles, from the lowest point number on.
std::array<size_t, 4> sharpest(const std::vector<Vec3>& points, const std::vector<IndexTriangle>& triangles,
                               const std::vector<int>& border) {
  std::vector<double> angles(points.size(), 0.0);
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k)
      angles[t[k]] += angle_between(points[t[(k + 1) % 3]] - points[t[k]], points[t[(k + 2) % 3]] - points[t[k]]);
  std::vector<size_t> order(border.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return angles[border[a]] < angles[border[b]]; });
  std::array<size_t, 4> corners{order[0], order[1], order[2], order[3]};
  std::sort(corners.begin(), corners.end());
  const auto lowest =
      std::min_element(corners.begin(), corners.end(), [&](size_t a, size_t b) { return border[a] < border[b]; });
  std::rotate(corners.begin(), lowest, corners.end());
  return corners;
}

std::array<size_t, 4> given_corners(const Fields& f, const std::vector<int>& border) {
  const std::vector<double>& numbers = f.numbers("corners");
  std::array<size_t, 4> corners;
  for (size_t k = 0; k < 4; ++k) {
    const auto found = std::find(border.begin(), border.end(), numbers[k]);
    if (found == border.end())
      throw FieldError("corners", fmt::format("point {:g} is not on the border of the sheet", numbers[k]),
                       "the numbers of four points of the border, one after the other as it runs");
    corners[k] = static_cast<size_t>(found - border.begin());
  }
  for (size_t k = 0, n = border.size(), round = 0; k < 4; ++k) {
    round += (corners[(k + 1) % 4] + n - corners[k]) % n;
    if (corners[k] == corners[(k + 1) % 4] || round > n)
      throw FieldError("corners", "they do not follow one another as the border runs, counterclockwise",
                       "name them the other way round");
  }
  return corners;
}

SurfaceData laid_over_square(const Fields& f) {
  SurfaceData data{f.points("points"), {}, {}};
  CloudOptions options;
  if (f.has("longest")) options.longest = f.number("longest");
  options.largest_hole = f.integer("largest_hole");
  try {
    const std::vector<IndexTriangle> triangles = triangulation_of_cloud(data.points, options);
    const std::vector<int> border = border_of_sheet(data.points, triangles);
    if (border.size() < 4) throw std::invalid_argument("the border has three points: a surface has four corners");
    data.at =
        flattened_to_square(data.points, triangles, border,
                            f.has("corners") ? given_corners(f, border) : sharpest(data.points, triangles, border));
  } catch (const FieldError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FieldError("points", error.what(), "more points; closed shapes are for triangulated_surface");
  }
  return data;
}

std::vector<double> even_inner(int spans) {
  std::vector<double> knots;
  for (int k = 1; k < spans; ++k) knots.push_back(static_cast<double>(k) / spans);
  return knots;
}

NurbsSurface build(const Fields& f) {
  SurfaceData data = laid_over_square(f);
  const SurfaceFitOptions options{
      f.u<int>("degree"),    f.v<int>("degree"), even_inner(f.u<int>("spans")), even_inner(f.v<int>("spans")),
      f.number("stiffness"), f.integer("passes")};
  const Rectangle square{{0, 1}, {0, 1}};
  return f.has("tolerance") ? fit_surface_within(data, square, options, f.number("tolerance"))
                            : fit_surface(data, square, options);
}

}  // namespace

TypeDeclaration cloud_surface_type() {
  return declare(Category::surface, "cloud_surface",
                 "Spline surface near measured points of a sheet that need not lie over a plane: joined as they lie in "
                 "space, laid over the unit square by mean value coordinates, and fitted by least squares.")
      .field("points", points().count(9), "the points, in any order")
      .optional("corners", numbers().count(4, 4),
                "the numbers of four points of the border that become the corners (0, 0), (1, 0), (1, 1), (0, 1), "
                "counterclockwise seen from where the highest point looks up; else the four sharpest of the border")
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "degrees of the polynomial pieces", "3")
      .field("spans", integer().between(1, 200).for_each_direction(), "number of equal pieces", "1")
      .optional("tolerance", length().positive(),
                "largest distance of a point from the surface at its parameters: spans are halved until it holds")
      .field("stiffness", number().non_negative(),
             "weight of the integral of r_uu^2 + 2 r_uv^2 + r_vv^2 beside the sum of squared distances", "0")
      .field("passes", integer().between(0, 1000),
             "how often parameters of points move to where the surface is nearest", "0")
      .optional("longest", length().positive(), "side of a triangle between points")
      .field("largest_hole", integer().between(3, 100), "openings between points with so many sides are closed", "8")
      .example(
          "points: [[0, 0], [1, 0, 0.3], [2, 0], [0, 1, 0.3], [1, 1, 0.6], [2, 1, 0.3], [0, 2], [1, 2, 0.3], [2, 2]], "
          "degree: 2")
      .shows({"control_net", "knots"})
      .built_by(build);
}

}  // namespace lekalo::geometry
