// S-surfaces (Golovanov 2016, 3.14): control points blended by cubic simplex splines on regular hexagons about the
// places of a triangular lattice,
//
//   r(p) = sum M_i(p) w_i r_i/sum M_i(p) w_i
//
// of class C^2. On the cells of all lines between knots it is rational of degree 3, and exact patches.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/triangulations/spline_graph.h"
#include "geometry/describe.h"
#include "geometry/surfaces/triangles/simplex_spline.h"

namespace lekalo::geometry {

namespace {

struct Lattice {
  Vec2 origin{0};
  double spacing = 1, radius = 1.5, turn = 0;  // of the hexagon's first corner from the first direction

  Vec2 center(int i, int j) const { return origin + spacing * Vec2(i + 0.5 * j, std::sqrt(0.75) * j); }
  std::vector<Vec2> hexagon(const Vec2& center) const {
    std::vector<Vec2> corners;
    for (int k = 0; k < 6; ++k) {
      const double angle = turn + k * kPi / 3;
      corners.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return corners;
  }
};

Lattice lattice_of(const Fields& f) {
  const bool towards = f.text("corners") == "towards";
  Lattice lattice{Vec2(f.vec3("origin")), f.number("spacing"), f.number("radius"), towards ? 0 : kPi / 6};
  // Else there are places that no support has inside.
  const double least = lattice.spacing / (towards ? 1.5 : std::sqrt(3.0));
  if (!(lattice.radius > least))
    throw FieldError("radius", fmt::format("with the radius {:.6g} the hexagons leave gaps", lattice.radius),
                     fmt::format("more than {:.6g} for this spacing", least));
  return lattice;
}

std::vector<Vec2> domain_of(const Fields& f, const std::vector<Vec2>& centers) {
  if (!f.has("domain")) return convex_hull(centers);
  const std::vector<Vec2> given = plane_points(f.points("domain"));
  const std::vector<Vec2> hull = convex_hull(given);
  if (hull.size() != given.size())
    throw FieldError("domain", "it is no convex polygon", "corners of a convex polygon, in order");
  return hull;
}

struct Member {
  SimplexSpline spline;
  Vec2 center;
  Vec4 point;  // homogeneous
};

std::vector<Member> members_of(const Fields& f, const Lattice& lattice) {
  const Grid<Vec3>& points = f.net("points");
  if (f.has("weights") &&
      (f.number_grid("weights").rows != points.rows || f.number_grid("weights").columns != points.columns))
    throw FieldError("weights", fmt::format("{} x {} points need as many weights", points.rows, points.columns));
  std::vector<Member> members;
  for (int i = 0; i < points.rows; ++i)
    for (int j = 0; j < points.columns; ++j) {
      const double w = f.has("weights") ? f.number_grid("weights").at(i, j) : 1;
      if (!(w > 0)) throw FieldError("weights", fmt::format("weight {}, {} is not positive", i, j));
      const Vec2 center = lattice.center(i, j);
      members.push_back({SimplexSpline(lattice.hexagon(center)), center, Vec4(w * points.at(i, j), w)});
    }
  return members;
}

TriangularNet net_on(const std::array<Vec2, 3>& cell, const std::vector<Member>& members, double radius) {
  TriangularNet net{3, std::vector<Vec4>(10, Vec4(0))};
  const Vec2 middle = (cell[0] + cell[1] + cell[2]) / 3.0;
  for (const Member& member : members) {
    if (glm::length(member.center - middle) >= radius) continue;
    const TriangularNetOf<double> m = member.spline.net(cell);
    for (size_t k = 0; k < m.points.size(); ++k) net.points[k] += m.points[k] * member.point;
  }
  return net;
}

Body s_surface(const Fields& f) {
  const Lattice lattice = lattice_of(f);
  const std::vector<Member> members = members_of(f, lattice);
  std::vector<Vec2> centers;
  std::vector<PlanarSegment> segments;
  for (const Member& member : members) {
    centers.push_back(member.center);
    for (const PlanarSegment& segment : all_segments(member.spline.knots())) segments.push_back(segment);
  }
  const std::vector<Vec2> domain = domain_of(f, centers);
  if (domain.size() < 3) throw FieldError("points", "the lattice has no area", "two rows and two columns at least");
  const PlanarCells cells = planar_cells(domain, segments);
  std::vector<TriangularNet> nets;
  for (size_t t = 0; t < cells.triangles.size(); ++t) {
    nets.push_back(net_on(cells.corners(t), members, lattice.radius));
    for (const size_t corner : {0, 6, 9})
      if (!(nets.back().points[corner].w > 0)) {
        const Vec2 at = cells.corners(t)[corner == 0 ? 0 : corner == 6 ? 1 : 2];
        throw FieldError("domain", fmt::format("no spline reaches ({:.6g}, {:.6g})", at.x, at.y),
                         "a smaller domain, or a larger radius");
      }
  }
  return surface_on(cells, nets);
}

}  // namespace

TypeDeclaration s_surface_type() {
  return declare(Category::body, "s_surface",
                 "S-surface: control points blended by cubic simplex splines on regular hexagons about the places of a "
                 "triangular lattice in the plane of parameters (Golovanov 2016, 3.14). Its faces are the rational "
                 "patches that it consists of; 'lekalo evaluate --uv' tells its points.")
      .field("points", net(),
             "control points: points[i][j] has its place at origin + i spacing (1, 0) + j spacing (1/2, sqrt(3)/2)")
      .optional("weights", number_grid(), "one for each point, in the same rows; all 1 when left out")
      .field("origin", point(), "place of the first point, in the plane of parameters", "[0, 0]")
      .field("spacing", length().positive(), "between neighbours of the lattice", "1")
      .field("radius", length().positive(), "of the hexagons' corners", "1.5")
      .field("corners", choice({"towards", "between"}), "of the hexagons: towards the neighbours, or between them",
             "towards")
      .optional("domain", parameter_points().count(3), "a convex polygon of parameters; all centers' when left out")
      .example(
          "points: [[[0, 0], [0.5, 1, 1], [1, 2]], [[1, 0, 1], [1.5, 1], [2, 2, 1]], [[2, 0], [2.5, 1, 1], [3, "
          "2]]]")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(s_surface(f)); });
}

}  // namespace lekalo::geometry
