// Bezier triangles (Golovanov 2016, 3.11):
//
//   r(a, b, c) = sum n!/(i! j! k!) a^i b^j c^k w_ijk p_ijk / (the same with w_ijk alone),  a + b + c = 1
//
// over the square a = u, b = (1 - u) v, c = (1 - u)(1 - v) (3.10): with n!/(i! j! k!) = C(n, i) C(n - i, j)
//
//   sum_i B_i^n(u) sum_j B_j^(n-i)(v) P_ijk
//
// whose inner sums are raised to degree n. The price is the edge u = 1, which is the corner n00: derivatives by v
// vanish there, and the normal is the limit.
#include "geometry/surfaces/triangles/bezier_triangle.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/mesh.h"

namespace lekalo::geometry {

namespace {

std::vector<double> bezier_knots(int degree) {
  std::vector<double> knots(2 * (degree + 1), 0.0);
  std::fill(knots.begin() + degree + 1, knots.end(), 1.0);
  return knots;
}

// The degree of a net with so many points. Throws FieldError.
int degree_of(size_t count) {
  const int degree = static_cast<int>(std::lround((std::sqrt(8.0 * count + 1) - 3) / 2));
  if (degree < 1 || degree > kMaxDegree || TriangularNet::count(degree) != static_cast<int>(count))
    throw FieldError("points", fmt::format("{} points make no triangular net", count),
                     "degree 1 has 3 points, degree 2 has 6, degree 3 has 10, degree n has (n + 1)(n + 2)/2");
  return degree;
}

TriangularNet read_net(const Fields& f) {
  const std::vector<Vec3>& points = f.points("points");
  TriangularNet net{degree_of(points.size()), {}};
  std::vector<double> weights(points.size(), 1.0);
  if (f.has("weights")) weights = f.numbers("weights");
  if (weights.size() != points.size())
    throw FieldError("weights",
                     fmt::format("{} points need {} weights, not {}", points.size(), points.size(), weights.size()));
  for (size_t k = 0; k < points.size(); ++k) {
    if (!(weights[k] > 0)) throw FieldError("weights", fmt::format("weight {} is not positive", k));
    net.points.emplace_back(weights[k] * points[k], weights[k]);
  }
  for (int k = 0; k < f.integer("elevate"); ++k) net = elevated(net);
  return net;
}

// With the corners exchanged, and u for v, the pole is at the second corner; the normal stays.
SurfacePtr over_square(const TriangularNet& given, TrianglePole pole) {
  const TriangularNet net = pole == TrianglePole::first ? given : permuted(given, {1, 0, 2});
  const int n = net.degree;
  std::vector<Vec4> points;
  for (int i = 0; i <= n; ++i) {
    std::vector<Vec4> row;
    for (int j = 0; j <= n - i; ++j) row.push_back(net.at(i, j));
    row = i == n ? std::vector<Vec4>(static_cast<size_t>(n) + 1, row.front()) : elevated_bezier(std::move(row), n);
    points.insert(points.end(), row.begin(), row.end());
  }
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = n;
  form.knots_u = form.knots_v = bezier_knots(n);
  form.points = points;
  if (pole == TrianglePole::second)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        form.points[static_cast<size_t>(i * (n + 1) + j)] = points[static_cast<size_t>(j * (n + 1) + i)];
  return std::make_shared<NurbsSurface>(form);
}

// De Casteljau's algorithm over the parameters of the triangle, for any number type.
struct NetOverTriangle {
  const TriangularNet& net;
  ParameterTriangle triangle;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    const std::array<T, 3> t = barycentric(triangle, u, v);
    const auto coordinate = [&](int k) {
      std::vector<T> c;
      for (const Vec4& p : net.points) c.push_back(T(p[k]));
      for (int n = net.degree; n > 0; --n)
        each_index(n - 1, [&](int i, int j, int) {
          const auto above = [&](int p, int q) { return c[static_cast<size_t>(TriangularNet::index_in(n, p, q))]; };
          c[static_cast<size_t>(TriangularNet::index_in(n - 1, i, j))] =
              t[0] * above(i + 1, j) + t[1] * above(i, j + 1) + t[2] * above(i, j);
        });
      return c.front();
    };
    const Triple<T> r{coordinate(0), coordinate(1), coordinate(2)};
    const bool is_polynomial =
        std::all_of(net.points.begin(), net.points.end(), [](const Vec4& p) { return p.w == 1; });
    if (is_polynomial) return r;
    const T w = coordinate(3);
    return {r.x / w, r.y / w, r.z / w};
  }
};

// The triangles p_ijk, p_(i-1,j,k+1), p_(i-1,j+1,k), and those that they leave between them (Golovanov 2016, 3.11).
Mesh control_polyhedron(const TriangularNet& net, bool with_inverted) {
  Mesh mesh;
  for (const Vec4& p : net.points) {
    if (p.w == 0) throw FieldError("of", "a control point lies at infinity: the polyhedron has no corner there");
    mesh.points.push_back(Vec3(p) / p.w);
  }
  const auto add = [&](int a, int b, int c) { mesh.triangles.push_back({{a, b, c}}); };
  each_index(net.degree, [&](int i, int j, int) {
    if (i > 0) add(net.index(i, j), net.index(i - 1, j + 1), net.index(i - 1, j));
  });
  if (with_inverted && net.degree > 1)
    each_index(net.degree - 2,
               [&](int i, int j, int) { add(net.index(i + 1, j + 1), net.index(i, j + 1), net.index(i + 1, j)); });
  set_flat_normals(mesh);
  for (size_t k = 0; k < mesh.triangles.size(); ++k) mesh.triangles[k].face = static_cast<int32_t>(k);
  return mesh;
}

TriangularNet needed_net(const Fields& f) {
  const auto net = triangular_net(*f.surface("of"));
  if (!net) throw FieldError("of", "it is no Bezier triangle", "a bezier_triangle, or a triangle_surface");
  return *net;
}

// Three lists of three numbers with the sum 1.
std::array<Barycentric, 3> corners_of_part(const Fields& f) {
  std::array<Barycentric, 3> corners;
  const std::vector<Vec3>& given = f.points("vertices");
  for (size_t k = 0; k < 3; ++k) {
    corners[k] = given[k];
    if (std::abs(given[k].x + given[k].y + given[k].z - 1) > 1e-12)
      throw FieldError(
          "vertices",
          fmt::format("the coordinates of vertex {} have the sum {:.6g}", k, given[k].x + given[k].y + given[k].z),
          "barycentric coordinates a, b, c have the sum 1");
  }
  if (glm::determinant(glm::dmat3(corners[0], corners[1], corners[2])) == 0)
    throw FieldError("vertices", "the three lie on one line", "a part needs three that do not");
  return corners;
}

}  // namespace

BezierTriangle::BezierTriangle(TriangularNet net, const ParameterTriangle& triangle, TrianglePole pole)
    : TriangularSurface(over_square(net, pole), triangle, pole), net_(std::move(net)) {}

SurfaceJet BezierTriangle::evaluate_over_triangle(const Vec2& uv, int order) const {
  return evaluate_surface_formula(NetOverTriangle{net_, triangle()}, uv.x, uv.y, order);
}

std::optional<TriangularNet> triangular_net(const Surface& surface) {
  const PlacedTriangle placed = placed_triangle(surface);
  const auto* bezier = dynamic_cast<const BezierTriangle*>(placed.surface);
  if (!bezier) return std::nullopt;
  TriangularNet net = bezier->net();
  for (Vec4& p : net.points) p = Vec4(placed.map.linear * Vec3(p) + p.w * placed.map.offset, p.w);
  return net;
}

TriangularNet net_of_points(int degree, const std::vector<Vec3>& points) {
  TriangularNet net{degree, {}};
  for (const Vec3& p : points) net.points.emplace_back(p, 1);
  return net;
}

TypeDeclaration bezier_triangle_type() {
  TypeDeclaration type =
      declare(Category::surface, "bezier_triangle",
              "Bezier surface on a triangular net of any degree, polynomial or rational (Golovanov 2016, 3.11).");
  type.field("points", points().count(3),
             "p_ijk, i + j + k = n, in the order i = n .. 0 and in each j = n - i .. 0: the first is the corner n00, "
             "the last row goes from 0n0 to 00n")
      .optional("weights", numbers(), "one for each point, in the same order; all 1 when left out")
      .field("elevate", integer().between(0, kMaxDegree - 1), "raise the degree so often; the surface is the same",
             "0");
  declare_triangle(type);
  return type.shows({"control_net", "de_casteljau"})
      .example("points: [[0, 0], [0, 1], [1, 0, 1], [0, 2], [1, 1, 1], [2, 0]]")
      .built_by([](const Fields& f) {
        TriangularNet net = read_net(f);
        if (net.degree > kMaxDegree)
          throw FieldError("elevate", fmt::format("degree {} is above {}", net.degree, kMaxDegree));
        return BezierTriangle(std::move(net), triangle_of(f), pole_of(f));
      });
}

TypeDeclaration triangle_surface_type() {
  TypeDeclaration type = declare(Category::surface, "triangle_surface", "Flat triangle (Golovanov 2016, 3.10).");
  type.field("points", points().count(3, 3), "the corners");
  declare_triangle(type);
  return type.example("points: [[0, 0], [2, 0], [1, 2, 1]]").built_by([](const Fields& f) {
    const std::vector<Vec3>& p = f.points("points");
    const Vec3 sides = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double longest = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[0]), glm::length(p[2] - p[1])});
    if (!(glm::length(sides) > 1e-14 * longest * longest))
      throw FieldError("points", "the three points lie on one line", "a triangle needs three that do not");
    return BezierTriangle(net_of_points(1, p), triangle_of(f), pole_of(f));
  });
}

TypeDeclaration triangle_part_type() {
  return declare(Category::surface, "triangle_part",
                 "Part of a Bezier triangle over a smaller triangle, as a Bezier triangle of its own: subdivision by "
                 "de Casteljau's algorithm (Golovanov 2016, 3.11).")
      .field("of", reference({Category::surface}), "the Bezier triangle")
      .field("vertices", points().count(3, 3), "barycentric coordinates [a, b, c] of the part's corners")
      .shows({"control_net", "de_casteljau"})
      .example(
          "of: { type: bezier_triangle, points: [[0, 0], [0, 1], [1, 0, 1], [0, 2], [1, 1, 1], [2, 0]] }, vertices: "
          "[[1, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5]]")
      .built_by([](const Fields& f) {
        const TriangularNet net = needed_net(f);
        const std::array<Barycentric, 3> corners = corners_of_part(f);
        ParameterTriangle triangle;
        const ParameterTriangle& whole = placed_triangle(*f.surface("of")).surface->triangle();
        for (size_t k = 0; k < 3; ++k) triangle.corners[k] = whole.point(corners[k]);
        return BezierTriangle(part_of(net, corners), triangle);
      });
}

TypeDeclaration bernstein_triangle_type() {
  TypeDeclaration type = declare(Category::surface, "bernstein_triangle",
                                 "Graph of a Bernstein function of three barycentric coordinates, n!/(i! j! k!) a^i "
                                 "b^j c^k, over a triangle of the plane x, y (Golovanov 2016, 3.11.3).");
  type.field("degree", integer().between(1, kMaxDegree), "n")
      .field("index", numbers().count(3, 3), "[i, j, k], with the sum n");
  declare_triangle(type);
  return type.shows({"control_net", "de_casteljau"})
      .example("degree: 3, index: [1, 1, 1]")
      .built_by([](const Fields& f) {
        const int n = f.integer("degree");
        const std::vector<double>& index = f.numbers("index");
        const bool is_index =
            std::all_of(index.begin(), index.end(), [](double i) { return i >= 0 && i == std::floor(i); });
        if (!is_index || index[0] + index[1] + index[2] != n)
          throw FieldError("index",
                           fmt::format("[{}, {}, {}] is no index of degree {}", index[0], index[1], index[2], n),
                           "three whole numbers, not negative, whose sum is the degree");
        const ParameterTriangle triangle = triangle_of(f);
        TriangularNet net{n, {}};
        each_index(n, [&](int i, int j, int k) {
          const Vec2 at = triangle.point(Vec3(i, j, k) / static_cast<double>(n));
          net.points.emplace_back(at.x, at.y, i == index[0] && j == index[1] ? 1 : 0, 1);
        });
        return BezierTriangle(std::move(net), triangle, pole_of(f));
      });
}

TypeDeclaration control_triangles_type() {
  return declare(Category::mesh, "control_triangles",
                 "The control points of a Bezier triangle joined to triangles (Golovanov 2016, 3.11). Its smooth and "
                 "sharp lines are the edges.")
      .field("of", reference({Category::surface}), "the Bezier triangle")
      .field("facets", choice({"all", "upright"}), "upright: without those that stand upside down between the others",
             "all")
      .example("of: { type: bezier_triangle, points: [[0, 0], [0, 1], [1, 0, 1], [0, 2], [1, 1, 1], [2, 0]] }")
      .built_by([](const Fields& f) -> std::any {
        return MeshPtr(std::make_shared<Mesh>(control_polyhedron(needed_net(f), f.text("facets") == "all")));
      });
}

}  // namespace lekalo::geometry
