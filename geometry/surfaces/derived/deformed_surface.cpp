// Deformed surfaces (Golovanov 2016, 3.16): small edits of a finished shape b by a B-spline field over its parameters,
//
//   r(u, v) = b(u, v) + h(u, v) m(u, v),  h = sum N_i(u) N_j(v) h_ij     heights along the unit normal m
//   r(u, v) = b(u, v) + sum N_i(u) N_j(v) s_ij                           vectors
//
// A vector is given in the axes b_u, b_v, m at its node, where the parameters are the Greville abscissae of N_i and
// N_j, or in those of space. A direction in which the surface is closed has periodic B-splines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/greville.h"
#include "geometry/describe.h"
#include "geometry/no_longer.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/deformed.h"
#include "geometry/surfaces/derived/normals.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

namespace {

struct AlongNormals {
  SurfacePtr of, field;  // the field's heights are its x
  double sign;           // of the normal

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    const Triple<T> n = cross(surface_at(*of, u, v, 1, 0), surface_at(*of, u, v, 0, 1));
    const T height = sign * surface_at(*field, u, v).x;
    return surface_at(*of, u, v) + no_longer((height / length(n)) * n, height);
  }
};

struct ByVectors {
  SurfacePtr of, field;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    return surface_at(*of, u, v) + surface_at(*field, u, v);
  }
};

// The knots stretched over the domain.
SplineAxis axis_over(const Interval& domain, double period, int degree, const Knots& knots, int count, char direction) {
  const bool closed = period > 0 && std::abs(domain.width() - period) <= 1e-12 * period;
  try {
    const SplineAxis plain = make_axis(degree, knots, closed, count, std::vector<double>(count, 1.0));
    const Interval own = plain.domain();
    std::vector<double> stretched;
    for (const double k : plain.knots())
      stretched.push_back(k == own.hi ? domain.hi : domain.lo + (k - own.lo) * (domain.width() / own.width()));
    return SplineAxis(degree, stretched, closed ? Extension::periodic : Extension::tangent);
  } catch (const FieldError& error) {
    throw FieldError(error.field == "points" ? "count" : error.field,
                     fmt::format("in direction {}: {}", direction, error.what()), error.hint);
  }
}

// The control values of the field, i outer.
struct Controls {
  SplineAxis u, v;
  bool are_vectors = false;
  std::vector<Vec3> values;

  Vec3& at(int i, int j) { return values[static_cast<size_t>(i) * v.distinct() + j]; }
};

void read_table(const Fields& f, Controls& controls) {
  const int rows = controls.u.distinct(), columns = controls.v.distinct();
  const auto check = [&](const char* field, int m, int n) {
    if (m != rows || n != columns)
      throw FieldError(field, fmt::format("{} by {} values are given, {} by {} are needed", m, n, rows, columns),
                       "one for each control value: i runs with u, j with v");
  };
  if (f.has("heights")) {
    const Grid<double>& heights = f.number_grid("heights");
    check("heights", heights.rows, heights.columns);
    for (size_t k = 0; k < controls.values.size(); ++k) controls.values[k].x = heights.values[k];
  }
  if (f.has("vectors")) {
    const Grid<Vec3>& vectors = f.net("vectors");
    check("vectors", vectors.rows, vectors.columns);
    controls.values = vectors.values;
    controls.are_vectors = true;
  }
}

void read_moves(const Fields& f, Controls& controls) {
  if (!f.has("moves")) return;
  int number = 0;
  for (const Fields& move : f.groups("moves")) {
    const std::vector<double>& at = move.numbers("at");
    const auto is_one_of = [](double x, int count) { return x == std::floor(x) && x >= 0 && x < count; };
    if (at.size() != 2 || !is_one_of(at[0], controls.u.distinct()) || !is_one_of(at[1], controls.v.distinct()))
      throw FieldError("moves",
                       fmt::format("move {} is at no control value: i runs in 0..{}, j in 0..{}", number,
                                   controls.u.distinct() - 1, controls.v.distinct() - 1),
                       "at: [i, j]");
    if (move.has("height") == move.has("vector"))
      throw FieldError("moves", fmt::format("move {} has a height, or a vector instead", number), "give one of them");
    if (number > 0 || f.has("heights") || f.has("vectors"))
      if (move.has("vector") != controls.are_vectors)
        throw FieldError("moves", fmt::format("move {}: heights and vectors do not mix", number), "give one kind");
    controls.are_vectors = move.has("vector");
    controls.at(static_cast<int>(at[0]), static_cast<int>(at[1])) =
        controls.are_vectors ? move.vec3("vector") : Vec3(move.number("height"), 0, 0);
    ++number;
  }
}

// From the axes at the nodes to those of space.
void to_space(const Surface& of, Controls& controls) {
  for (int i = 0; i < controls.u.distinct(); ++i)
    for (int j = 0; j < controls.v.distinct(); ++j) {
      Vec3& vector = controls.at(i, j);
      if (vector == Vec3(0)) continue;
      const double u = greville(controls.u.knots(), controls.u.degree(), i),
                   v = greville(controls.v.knots(), controls.v.degree(), j);
      const SurfaceJet jet = of.evaluate(u, v, 1);
      vector = vector.x * jet.du() + vector.y * jet.dv() + vector.z * of.normal(u, v);
    }
}

void add_lines(std::vector<double>& breaks, const SplineAxis& axis) {
  const Interval domain = axis.domain();
  for (const double knot : axis.knots())
    if (knot > domain.lo && knot < domain.hi) breaks.push_back(knot);
  std::sort(breaks.begin(), breaks.end());
  const auto same = [&](double a, double b) { return b - a <= 1e-12 * domain.width(); };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
}

// A plane's own B-spline with the same knots has its points at the Greville abscissae: the sum is one B-spline.
SurfacePtr deformed_plane(const Plane& plane, const Controls& controls) {
  std::vector<Vec3> points;
  for (int i = 0; i < controls.u.distinct(); ++i)
    for (int j = 0; j < controls.v.distinct(); ++j) {
      const double u = greville(controls.u.knots(), controls.u.degree(), i),
                   v = greville(controls.v.knots(), controls.v.degree(), j);
      const Vec3& by = controls.values[static_cast<size_t>(i) * controls.v.distinct() + j];
      points.push_back(plane.point(u, v) + (controls.are_vectors ? by : by.x * plane.normal(u, v)));
    }
  auto result = std::make_shared<NurbsSurface>(controls.u, controls.v, points, std::vector<double>());
  result->set_reversed(plane.reversed());
  return result;
}

}  // namespace

SurfacePtr deformed_by(const SurfacePtr& of, const Fields& f, bool plane_as_spline) {
  if (f.has("heights") && f.has("vectors"))
    throw FieldError("vectors", "heights and vectors do not mix", "give one of them");
  const Rectangle domain = of->domain();
  const Periods periods = of->periods();
  Controls controls{axis_over(domain.u, periods.u, f.u<int>("degree"), f.u<Knots>("knots"), f.u<int>("count"), 'u'),
                    axis_over(domain.v, periods.v, f.v<int>("degree"), f.v<Knots>("knots"), f.v<int>("count"), 'v'),
                    false,
                    {}};
  controls.values.assign(static_cast<size_t>(controls.u.distinct()) * controls.v.distinct(), Vec3(0));
  read_table(f, controls);
  read_moves(f, controls);
  if (controls.are_vectors && f.text("axes") == "local") to_space(*of, controls);
  if (const auto* plane = dynamic_cast<const Plane*>(of.get()); plane && plane_as_spline)
    return deformed_plane(*plane, controls);
  const auto field = std::make_shared<NurbsSurface>(controls.u, controls.v, controls.values, std::vector<double>());
  SurfaceProperties properties = properties_of(*of, controls.are_vectors ? 0 : 1);
  properties.enclosure_order = std::min(properties.enclosure_order, field->enclosure_order());
  add_lines(properties.breaks_u, controls.u), add_lines(properties.breaks_v, controls.v);
  std::shared_ptr<Surface> result;
  if (controls.are_vectors) {
    result = std::make_shared<ComposedSurface<ByVectors>>(ByVectors{of, field}, properties);
  } else {
    check_normals(*of, "of");
    result = std::make_shared<ComposedSurface<AlongNormals>>(AlongNormals{of, field, of->normal_sign()}, properties);
  }
  result->set_reversed(of->reversed());
  return result;
}

void declare_deformation(TypeDeclaration& type) {
  type.field("count", integer().at_least(2).for_each_direction(), "of control values along u and v")
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "of the B-splines", "3")
      .field("knots", knots().for_each_direction(),
             "a full knot vector, which is stretched over the domain, or a rule: clamped, uniform", "clamped")
      .optional("heights", number_grid(), "along the normals: heights[i][j], i runs with u, j with v")
      .optional("vectors", net(), "in place of heights: vectors[i][j]")
      .optional("moves",
                groups({{"at", numbers().count(2, 2), "the control value [i, j]", true, {}},
                        {"height", number(), "how far it is moved along the normal", false, {}},
                        {"vector", vector(), "by which vector, instead", false, {}}}),
                "single control values; all others are those of the table, or zero")
      .field("axes", choice({"local", "world"}),
             "of vectors: the derivatives by u and v and the normal at the value's node, or x, y, z", "local");
}

TypeDeclaration deformed_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "deformed_surface",
              "A surface with dents and bulges: moved along its normals by heights, or by vectors, that a B-spline "
              "over its parameters blends. Where a height is beyond a radius of curvature it folds over.")
          .example(
              "of: { type: cylinder_surface, radius: 1, height: 3 }, count: { u: 12, v: 8 }, moves: [{ at: [0, 4], "
              "height: "
              "0.3 }, { at: [9, 3], height: -0.3 }]")
          .field("of", reference({Category::surface}), "the surface; bounded");
  declare_deformation(type);
  type.built_by([](const Fields& f) {
    const SurfacePtr of = f.surface("of");
    if (!of->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
    return std::any(deformed_by(of, f, false));
  });
  return type;
}

}  // namespace lekalo::geometry
