// DMS surfaces (Dahmen, Micchelli, Seidel 1992; named in Golovanov 2016, 3.14): each vertex i of a triangulation has
// the knots t_i0 (itself), t_i1, .. t_in. For a triangle I = (i_0, i_1, i_2) and b_0 + b_1 + b_2 = n
//
//   N_b = |d(t_(i_0, b_0), t_(i_1, b_1), t_(i_2, b_2))| M^V,   V = { t_(i_q, r), r <= b_q }
//   r = sum_I sum_b N_b c_b
//
// The N_b have the sum 1 where no triangle is missing that would reach there. With c_b = sum_q sum_(r < b_q) t_(i_q,
// r)/n the surface is the plane; with all knots in the vertices it consists of Bezier triangles.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "geometry/bodies/triangulations/spline_graph.h"
#include "geometry/describe.h"
#include "geometry/surfaces/triangles/simplex_spline.h"

namespace lekalo::geometry {

namespace {

struct Dms {
  int degree = 2;
  std::vector<std::vector<Vec2>> knots;  // of the vertices, n + 1 each
  std::vector<std::array<int, 3>> triangles;
};

struct BasisFunction {
  SimplexSpline spline;
  double factor = 1;
  Vec3 point{0};  // its control point
};

Dms read_dms(const Fields& f) {
  Dms dms{f.integer("degree"), {}, {}};
  const std::vector<Vec3>& vertices = f.points("vertices");
  for (const Vec3& p : vertices) dms.knots.emplace_back(static_cast<size_t>(dms.degree) + 1, Vec2(p));
  if (f.has("clouds")) {
    const Grid<Vec3>& clouds = f.net("clouds");
    if (clouds.rows != static_cast<int>(vertices.size()) || clouds.columns != dms.degree)
      throw FieldError("clouds", fmt::format("{} vertices of degree {} need {} rows of {} points", vertices.size(),
                                             dms.degree, vertices.size(), dms.degree));
    for (int i = 0; i < clouds.rows; ++i)
      for (int r = 0; r < clouds.columns; ++r)
        dms.knots[static_cast<size_t>(i)][static_cast<size_t>(r) + 1] = Vec2(clouds.at(i, r));
  }
  for (const std::vector<int>& row : f.indices("triangles")) {
    if (row.size() != 3) throw FieldError("triangles", fmt::format("a triangle has {} corners", row.size()));
    for (const int corner : row)
      if (corner < 0 || corner >= static_cast<int>(vertices.size()))
        throw FieldError("triangles", fmt::format("there is no vertex {}", corner),
                         fmt::format("there are 0 to {}", vertices.size() - 1));
    dms.triangles.push_back({row[0], row[1], row[2]});
  }
  return dms;
}

// The functions of a triangle; of linear precision with the control points that they get.
std::vector<BasisFunction> functions_of(const Dms& dms, size_t triangle) {
  std::vector<BasisFunction> result;
  std::array<const std::vector<Vec2>*, 3> t{};
  for (size_t q = 0; q < 3; ++q) t[q] = &dms.knots[static_cast<size_t>(dms.triangles[triangle][q])];
  const double turn = homogeneous_determinant((*t[0])[0], (*t[1])[0], (*t[2])[0]);
  each_index(dms.degree, [&](int i, int j, int k) {
    const int b[] = {i, j, k};
    std::vector<Vec2> knots;
    std::array<Vec2, 3> last;
    Vec2 point(0);
    for (size_t q = 0; q < 3; ++q) {
      for (int r = 0; r <= b[q]; ++r) knots.push_back((*t[q])[static_cast<size_t>(r)]);
      for (int r = 0; r < b[q]; ++r) point += (*t[q])[static_cast<size_t>(r)] / static_cast<double>(dms.degree);
      last[q] = (*t[q])[static_cast<size_t>(b[q])];
    }
    const double factor = homogeneous_determinant(last[0], last[1], last[2]);
    if (!(factor * turn > 0))
      throw FieldError(turn == 0 ? "triangles" : "clouds",
                       turn == 0 ? fmt::format("triangle {} has no area", triangle)
                                 : fmt::format("the knots of triangle {} turn over", triangle),
                       turn == 0 ? "" : "knots nearer to their vertices");
    result.push_back({SimplexSpline(std::move(knots)), std::abs(factor), Vec3(point, 0)});
  });
  return result;
}

std::vector<BasisFunction> all_functions(const Fields& f, const Dms& dms) {
  const bool of_heights = f.has("heights");
  if (of_heights == f.has("points"))
    throw FieldError(of_heights ? "heights" : "points", "a surface has 'points', or a graph 'heights'", "give one");
  const int count = TriangularNet::count(dms.degree), rows = static_cast<int>(dms.triangles.size());
  const int given_rows = of_heights ? f.number_grid("heights").rows : f.net("points").rows,
            given = of_heights ? f.number_grid("heights").columns : f.net("points").columns;
  if (given_rows != rows || given != count)
    throw FieldError(of_heights ? "heights" : "points",
                     fmt::format("{} triangles of degree {} need {} rows of {}", rows, dms.degree, rows, count));
  std::vector<BasisFunction> all;
  for (int t = 0; t < rows; ++t) {
    std::vector<BasisFunction> own = functions_of(dms, static_cast<size_t>(t));
    for (int k = 0; k < count; ++k) {
      BasisFunction& function = own[static_cast<size_t>(k)];
      if (of_heights)
        function.point.z = f.number_grid("heights").at(t, k);
      else
        function.point = f.net("points").at(t, k);
      all.push_back(std::move(function));
    }
  }
  return all;
}

// Of the convex hull of the vertices the cells in triangles.
PlanarCells cells_of(const Dms& dms, const std::vector<BasisFunction>& functions) {
  std::vector<Vec2> vertices;
  for (const std::vector<Vec2>& knots : dms.knots) vertices.push_back(knots[0]);
  std::vector<PlanarSegment> segments;
  std::vector<ParameterTriangle> triangles;
  for (const std::array<int, 3>& t : dms.triangles) {
    ParameterTriangle triangle;
    for (size_t q = 0; q < 3; ++q) triangle.corners[q] = vertices[static_cast<size_t>(t[q])];
    for (const PlanarSegment& side : all_segments(triangle.corners)) segments.push_back(side);
    triangles.push_back(triangle);
  }
  for (const BasisFunction& function : functions)
    for (const PlanarSegment& segment : all_segments(function.spline.knots())) segments.push_back(segment);
  PlanarCells cells = planar_cells(convex_hull(vertices), segments);
  std::vector<std::array<int, 3>> kept;
  for (size_t k = 0; k < cells.triangles.size(); ++k) {
    const std::array<Vec2, 3> c = cells.corners(k);
    const Vec2 middle = (c[0] + c[1] + c[2]) / 3.0;
    for (const ParameterTriangle& triangle : triangles)
      if (triangle.contains(middle)) {
        kept.push_back(cells.triangles[k]);
        break;
      }
  }
  cells.triangles = std::move(kept);
  return cells;
}

Body dms_surface(const Fields& f) {
  const Dms dms = read_dms(f);
  const std::vector<BasisFunction> functions = all_functions(f, dms);
  const PlanarCells cells = cells_of(dms, functions);
  std::vector<TriangularNet> nets;
  for (size_t t = 0; t < cells.triangles.size(); ++t) {
    TriangularNet net{dms.degree,
                      std::vector<Vec4>(static_cast<size_t>(TriangularNet::count(dms.degree)), Vec4(0, 0, 0, 1))};
    for (const BasisFunction& function : functions) {
      const TriangularNetOf<double> n = function.factor * function.spline.net(cells.corners(t));
      for (size_t k = 0; k < n.points.size(); ++k) net.points[k] += Vec4(n.points[k] * function.point, 0);
    }
    nets.push_back(std::move(net));
  }
  return surface_on(cells, nets);
}

}  // namespace

TypeDeclaration dms_surface_type() {
  return declare(Category::body, "dms_surface",
                 "Spline surface on a triangulation of the plane of parameters, by simplex splines (Dahmen, Micchelli, "
                 "Seidel 1992): smooth to the order degree - 1 with knots in general position. Its faces are the "
                 "polynomials; 'lekalo evaluate --uv' tells its points.")
      .field("degree", integer().between(1, 5), "of the polynomials", "2")
      .field("vertices", parameter_points().count(3), "of the triangulation, in the plane of parameters")
      .field("triangles", indices(), "numbers of the vertices of each")
      .optional("clouds", net(),
                "for each vertex a row of as many further knots as the degree, near to it and at the border outside; "
                "all in the vertex when left out: Bezier triangles")
      .optional("points", net(),
                "control points, a row for each triangle: c_ijk with the sum of the indices the degree, in the order i "
                "= n .. 0 and in each j = n - i .. 0, i that of its first vertex")
      .optional("heights", number_grid(), "in place of points: z of a graph over the plane, in the same rows")
      .example(
          "degree: 1, vertices: [[0, 0], [2, 0], [2, 2], [0, 2]], triangles: [[0, 1, 2], [0, 2, 3]], clouds: [[[-0.2, "
          "-0.1]], [[2.2, -0.1]], [[2.1, 2.2]], [[-0.1, 2.2]]], heights: [[0, 1, 0], [0, 0, 1]]")
      .built_by([](const Fields& f) -> BodyPtr {
        try {
          return std::make_shared<Body>(dms_surface(f));
        } catch (const FieldError&) {
          throw;
        } catch (const std::invalid_argument& error) {
          throw FieldError("clouds", error.what());
        }
      });
}

}  // namespace lekalo::geometry
