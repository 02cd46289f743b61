// Surfaces on a net of curves (Golovanov 2016, 3.5) as Boolean sums of two families:
//
//   bilinear  on four points; Coons  on four curves, with functions of end_functions(n): n = 0 linear, n = 1 with the
//             derivatives across the edges (bicubic), and so on (Forrest)
//   Gordon    on a net, functions of Lagrange, C2 splines or Hermite's cubics; with the latter and the twists of the
//             three-point rule it is the piecewise Coons-Hermite surface (3.5.7)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/nets/boolean_sum.h"
#include "geometry/surfaces/nets/curve_family.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

namespace {

// Curves of a net meet to this part of its size.
constexpr double kMeeting = 1e-7;
// The highest order of derivatives across edges; those along them are needed to the same order.
constexpr size_t kMaxAcross = 4;

CurvePtr as_unit(const CurvePtr& curve, const char* field) {
  if (!(curve->domain().width() < kInfinity)) throw FieldError(field, "a curve is unbounded", "give it a domain");
  return curve->domain() == Interval(0, 1) ? curve : with_domain(curve, {0, 1});
}

std::vector<CurvePtr> read_curves(const Fields& f, const char* field, size_t count) {
  std::vector<CurvePtr> curves;
  for (const std::any& one : f.references(field)) curves.push_back(as_unit(std::any_cast<CurvePtr>(one), field));
  if (curves.size() != count)
    throw FieldError(field, fmt::format("{} curves are needed, not {}", count, curves.size()));
  return curves;
}

double size_of(const std::vector<CurvePtr>& curves) {
  Box3 box;
  for (const CurvePtr& curve : curves) box.include(bounds(*curve));
  return box.diameter();
}

// The corner points, after curves that run the other way are turned: c_0(0) = b_0(0), c_1(0) = b_0(1), and so on.
void orient(std::vector<CurvePtr>& c, std::vector<CurvePtr>& b, double size) {
  const auto meets = [&](const Vec3& p, const Vec3& q) { return glm::length(p - q) <= kMeeting * size; };
  const auto corner = [&](int i, int j, double u, double v) { return meets(c[i]->point(u), b[j]->point(v)); };
  for (int i = 0; i < 2; ++i)
    if (!corner(i, 0, 0, i) && !corner(i, 0, 0, 1 - i) && (corner(i, 0, 1, i) || corner(i, 0, 1, 1 - i)))
      c[i] = reversed_curve(c[i]);
  for (int j = 0; j < 2; ++j)
    if (!corner(0, j, j, 0) && corner(0, j, j, 1)) b[j] = reversed_curve(b[j]);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (!corner(i, j, j, i))
        throw FieldError(i == 0 ? "u_lines" : "v_lines",
                         fmt::format("u_lines[{}] and v_lines[{}] do not meet at u = {}, v = {}: they are {:.6g} apart",
                                     i, j, j, i, glm::length(c[i]->point(j) - b[j]->point(i))),
                         "the four curves form a closed border: v_lines[0] goes from u_lines[0] to u_lines[1]");
}

Vec3 derivative(const Curve& curve, double t, int k) { return curve.evaluate(t, k).d[k]; }

// The derivatives of orders 1 to n across two opposite edges: those of order l at 2 (l - 1) and 2 (l - 1) + 1.
std::vector<CurvePtr> read_across(const Fields& f, const char* field) {
  if (!f.has(field)) return {};
  const size_t count = f.references(field).size();
  if (count == 0 || count % 2 == 1 || count > 2 * kMaxAcross)
    throw FieldError(field, fmt::format("two curves for each order from 1 to {} at most are needed, not {} in all",
                                        kMaxAcross, count));
  return read_curves(f, field, count);
}

// With functions of end_functions(n) along u and (m) along v.
std::any coons(const Fields& f) {
  std::vector<CurvePtr> c = read_curves(f, "u_lines", 2), b = read_curves(f, "v_lines", 2);
  std::vector<CurvePtr> all = c;
  all.insert(all.end(), b.begin(), b.end());
  orient(c, b, size_of(all));
  const std::vector<CurvePtr> s_v = read_across(f, "across_u_lines"), s_u = read_across(f, "across_v_lines");
  if (s_v.empty() != s_u.empty())
    throw FieldError(s_u.empty() ? "across_v_lines" : "across_u_lines", "derivatives are needed across all four edges",
                     "give both, or none");
  const size_t n = s_u.size() / 2, m = s_v.size() / 2;
  BooleanSum sum;
  sum.along_u = {c, end_functions(static_cast<int>(m), {0, 1})};
  sum.along_v = {b, end_functions(static_cast<int>(n), {0, 1})};
  sum.along_u.curves.insert(sum.along_u.curves.end(), s_v.begin(), s_v.end());
  sum.along_v.curves.insert(sum.along_v.curves.end(), s_u.begin(), s_u.end());
  // The derivative k times by u, l times by v in the corner u = j, v = i; mixed ones the mean of what both families
  // say.
  sum.points.assign(2 * (n + 1), std::vector<Vec3>(2 * (m + 1)));
  for (size_t k = 0; k <= n; ++k)
    for (size_t l = 0; l <= m; ++l)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          const Vec3 by_u = derivative(*sum.along_u.curves[2 * l + i], j, static_cast<int>(k)),
                     by_v = derivative(*sum.along_v.curves[2 * k + j], i, static_cast<int>(l));
          sum.points[2 * k + j][2 * l + i] = k == 0 ? by_u : l == 0 ? by_v : 0.5 * (by_u + by_v);
        }
  return std::any(SurfacePtr(std::make_shared<BlendedSurface>(blended_surface(std::move(sum), {{0, 1}, {0, 1}}))));
}

// Families of one net, u_lines at the values of v and the other way round: they meet at the nodes.
struct Net {
  std::vector<CurvePtr> c, b;
  std::vector<double> at_u, at_v;

  std::vector<std::vector<Vec3>> nodes() const {
    std::vector<std::vector<Vec3>> points(b.size());
    for (size_t j = 0; j < b.size(); ++j)
      for (size_t i = 0; i < c.size(); ++i) points[j].push_back(0.5 * (c[i]->point(at_u[j]) + b[j]->point(at_v[i])));
    return points;
  }
  void check() const {
    std::vector<CurvePtr> all = c;
    all.insert(all.end(), b.begin(), b.end());
    const double near = kMeeting * size_of(all);
    for (size_t i = 0; i < c.size(); ++i)
      for (size_t j = 0; j < b.size(); ++j) {
        const double apart = glm::length(c[i]->point(at_u[j]) - b[j]->point(at_v[i]));
        if (!(apart <= near))
          throw FieldError("u_lines",
                           fmt::format("u_lines[{}] at u = {:.6g} and v_lines[{}] at v = {:.6g} are {:.6g} apart", i,
                                       at_u[j], j, at_v[i], apart),
                           "every curve meets each of the other family at the values of at_u and at_v");
      }
  }
};

Net read_net(const Fields& f) {
  Net net;
  for (const std::any& one : f.references("u_lines")) net.c.push_back(std::any_cast<CurvePtr>(one));
  for (const std::any& one : f.references("v_lines")) net.b.push_back(std::any_cast<CurvePtr>(one));
  for (const auto& [curves, field] : {std::pair(&net.c, "u_lines"), std::pair(&net.b, "v_lines")}) {
    if (curves->size() < 2) throw FieldError(field, "a net has two curves at least in each direction");
    for (const CurvePtr& curve : *curves)
      if (!(curve->domain().width() < kInfinity)) throw FieldError(field, "a curve is unbounded", "give it a domain");
  }
  const auto even = [](const Interval& range, size_t count) {
    std::vector<double> values;
    for (size_t k = 0; k < count; ++k) values.push_back(range.lo + range.width() * k / (count - 1));
    return values;
  };
  // The families' own parameters where they hold the values; else both run in 0..1.
  net.at_v = f.has("at_v") ? read_nodes(f, "at_v", net.c, false) : even(net.b.front()->domain(), net.c.size());
  net.at_u = f.has("at_u") ? read_nodes(f, "at_u", net.b, false) : even(net.c.front()->domain(), net.b.size());
  const auto fit = [](std::vector<CurvePtr>& curves, const std::vector<double>& at) {
    const Interval range(at.front(), at.back());
    for (CurvePtr& curve : curves)
      if (curve->domain() != range) curve = with_domain(curve, range);
  };
  fit(net.c, net.at_u);
  fit(net.b, net.at_v);
  net.check();
  return net;
}

std::any gordon(const Fields& f) {
  const Net net = read_net(f);
  const std::string& method = f.text("method");
  const auto functions = [&](const std::vector<double>& nodes) {
    return method == "lagrange" ? lagrange_functions(nodes)
           : method == "spline" ? spline_functions(nodes, false)
                                : hermite_functions(nodes, false);
  };
  BooleanSum sum;
  sum.along_u = {net.c, functions(net.at_v)};
  sum.along_v = {net.b, functions(net.at_u)};
  sum.points = net.nodes();
  if (method == "hermite") mean_twists(sum, net.at_u, net.at_v);
  const Rectangle domain{{net.at_u.front(), net.at_u.back()}, {net.at_v.front(), net.at_v.back()}};
  return std::any(SurfacePtr(std::make_shared<BlendedSurface>(blended_surface(std::move(sum), domain))));
}

}  // namespace

TypeDeclaration bilinear_surface_type() {
  return declare(Category::surface, "bilinear_surface",
                 "Surface of straight lines in both directions on four points; u and v run in 0..1.")
      .example("points: [[[0, 0, 0], [0, 2, 1]], [[2, 0, 1], [2, 2, 0]]]")
      .field("points", net(), "points[i][j]: i runs with u, j with v; two by two")
      .built_by([](const Fields& f) {
        const Grid<Vec3>& net = f.net("points");
        if (net.rows != 2 || net.columns != 2)
          throw FieldError("points", fmt::format("two by two points are needed, not {} by {}", net.rows, net.columns));
        NurbsSurfaceForm form;
        form.knots_u = form.knots_v = {0, 0, 1, 1};
        for (const Vec3& p : net.values) form.points.emplace_back(p, 1);
        return NurbsSurface(form);
      });
}

TypeDeclaration coons_surface_type() {
  return declare(
             Category::surface, "coons_surface",
             "Surface on four border curves: linear, or with derivatives across the edges, of the first order or up to "
             "the fourth. u and v run in 0..1; curves that run the other way are turned.")
      .example(
          "u_lines: [{ type: segment, from: [0, 0], to: [2, 0] }, { type: bezier_curve, points: [[0, 2, 1], [1, 2, 2], "
          "[2, 2]] }], v_lines: [{ type: segment, from: [0, 0], to: [0, 2, 1] }, { type: segment, from: [2, 0], to: "
          "[2, 2] }]")
      .field("u_lines", references({Category::curve}), "the two curves along u, at v = 0 and v = 1")
      .field("v_lines", references({Category::curve}), "the two curves along v, at u = 0 and u = 1")
      .optional("across_u_lines", references({Category::curve}),
                "derivatives by v along the u_lines, as curves of u, then those of the second order, ..: with "
                "across_v_lines a "
                "bicubic Coons patch, a biquintic one, ..; twists are means of those that both give")
      .optional("across_v_lines", references({Category::curve}),
                "derivatives by u along the v_lines, as curves of v, in the same order")
      .built_by(coons);
}

TypeDeclaration gordon_type() {
  return declare(
             Category::surface, "gordon",
             "Surface through all curves of a net. Curves of one family meet all of the other: u_lines[i] lies at v = "
             "at_v[i], v_lines[j] at u = at_u[j].")
      .field("u_lines", references({Category::curve}), "curves along u, in the order of v")
      .field("v_lines", references({Category::curve}), "curves along v, in the order of u")
      .optional("at_v", numbers(), "values of v at the u_lines; else evenly over the v_lines' parameter")
      .optional("at_u", numbers(), "values of u at the v_lines; else evenly over the u_lines' parameter")
      .field("method", choice({"lagrange", "spline", "hermite"}),
             "functions that blend the curves: polynomials of Lagrange (Gordon), natural cubic splines, or cubics of "
             "Hermite "
             "from cell to cell (Coons and Hermite); the latter two suit more than four or five curves",
             "lagrange")
      .example(
          "u_lines: [{ type: segment, from: [0, 0], to: [2, 0] }, { type: segment, from: [0, 1, 1], to: [2, 1] }], "
          "v_lines: [{ type: segment, from: [0, 0], to: [0, 1, 1] }, { type: segment, from: [2, 0], to: [2, 1] }]")
      .built_by(gordon);
}

}  // namespace lekalo::geometry
