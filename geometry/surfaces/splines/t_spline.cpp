// Each function is a sum of the B-splines on all knots, with discrete B-splines for coefficients (Cohen, Lyche,
// Riesenfeld 1980): on knots t that contain its own, s,
//
//   a_i^0(j) = 1 where s_i <= t_j < s_{i+1}, else 0
//   a_i^d(j) = (t_{j+d} - s_i)/(s_{i+d} - s_i) a_i^{d-1}(j)
//              + (s_{i+d+1} - t_{j+d})/(s_{i+d+1} - s_{i+1}) a_{i+1}^{d-1}(j)
//
// The sum of their products with w_i p_i and w_i is the control net of the surface as a NURBS surface.
#include "geometry/surfaces/splines/t_spline.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geometry/curves/splines/greville.h"
#include "geometry/surfaces/splines/t_refinement.h"
#include "geometry/tolerances.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

static int degree_of(const std::vector<LocalKnots>& functions) {
  return static_cast<int>(functions.front().u.size()) - 2;
}

std::vector<double> all_knots(const std::vector<LocalKnots>& functions, bool along_u, const Interval& domain) {
  std::map<double, int> inner;
  for (const LocalKnots& function : functions) {
    std::map<double, int> own;
    for (const double knot : along_u ? function.u : function.v)
      if (knot > domain.lo && knot < domain.hi) ++own[knot];
    for (const auto& [knot, times] : own) inner[knot] = std::max(inner[knot], times);
  }
  const int ends = degree_of(functions) + 1;
  std::vector<double> knots(ends, domain.lo);
  for (const auto& [knot, times] : inner) knots.insert(knots.end(), times, knot);
  knots.insert(knots.end(), ends, domain.hi);
  return knots;
}

namespace {

// Of a closed direction: the knots of one period, and `degree` more on both sides.
std::vector<double> closed_knots(const std::vector<LocalKnots>& functions, bool along_u, const Interval& domain) {
  const int degree = degree_of(functions);
  std::ptrdiff_t at_seam = 0;
  for (const LocalKnots& function : functions) {
    const std::vector<double>& own = along_u ? function.u : function.v;
    at_seam = std::max(at_seam, std::count(own.begin(), own.end(), domain.lo));
  }
  if (at_seam == 0) throw FieldError("domain", "it does not begin at a knot of the functions", "begin at one");
  const std::vector<double> clamped = all_knots(functions, along_u, domain);
  std::vector<double> period(static_cast<size_t>(at_seam), domain.lo);
  period.insert(period.end(), clamped.begin() + degree + 1, clamped.end() - degree - 1);
  const int n = static_cast<int>(period.size());
  std::vector<double> knots;
  for (int i = -degree; i <= n + degree; ++i) {
    const double round = std::floor(static_cast<double>(i) / n);
    knots.push_back(period[static_cast<size_t>(i - static_cast<int>(round) * n)] + round * domain.width());
  }
  return knots;
}

// Sums of functions are 1 to this, where they are 1.
constexpr double kSumIsOne = 1e-14;
constexpr double kMaxNet = 4e6;  // control points

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

struct Refined {
  int first = 0;  // index of the first coefficient
  std::vector<double> coefficients;
};

Refined refined(const std::vector<double>& s, const std::vector<double>& t) {
  const int degree = static_cast<int>(s.size()) - 2, count = static_cast<int>(t.size()) - degree - 1;
  Refined result;
  std::vector<double> a(degree + 1);
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i <= degree; ++i) a[i] = s[i] <= t[j] && t[j] < s[i + 1] ? 1 : 0;
    for (int d = 1; d <= degree; ++d)
      for (int i = 0; i <= degree - d; ++i)
        a[i] = share(t[j + d] - s[i], s[i + d] - s[i]) * a[i] +
               share(s[i + d + 1] - t[j + d], s[i + d + 1] - s[i + 1]) * a[i + 1];
    const double value = std::max(a[0], 0.0);
    if (value == 0 && result.coefficients.empty()) continue;
    if (result.coefficients.empty()) result.first = j;
    result.coefficients.push_back(value);
  }
  return result;
}

// The sums of the functions times these values, as a NURBS surface on all knots, closed ones in closed directions.
NurbsSurfaceForm sum_of(const std::vector<LocalKnots>& functions, const std::vector<Vec4>& values,
                        const Rectangle& domain, const Periods& periods = {}) {
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = degree_of(functions);
  form.knots_u = (periods.u > 0 ? closed_knots : all_knots)(functions, true, domain.u);
  form.knots_v = (periods.v > 0 ? closed_knots : all_knots)(functions, false, domain.v);
  const int columns = form.count_v();
  if (static_cast<double>(form.count_u()) * columns > kMaxNet)
    throw FieldError("points", fmt::format("all knots make a net of {} x {} points", form.count_u(), columns),
                     "fewer lines");
  form.points.assign(static_cast<size_t>(form.count_u()) * columns, Vec4(0));
  for (size_t i = 0; i < functions.size(); ++i) {
    const Refined a = refined(functions[i].u, form.knots_u), b = refined(functions[i].v, form.knots_v);
    for (size_t k = 0; k < a.coefficients.size(); ++k)
      for (size_t l = 0; l < b.coefficients.size(); ++l)
        form.points[(a.first + k) * columns + b.first + l] += a.coefficients[k] * b.coefficients[l] * values[i];
  }
  return form;
}

// A form with the knots of closed axes as the surface on them.
NurbsSurface closed_surface(const NurbsSurfaceForm& form, const Periods& periods) {
  const SplineAxis u(form.degree_u, form.knots_u, periods.u > 0 ? Extension::periodic : Extension::tangent),
      v(form.degree_v, form.knots_v, periods.v > 0 ? Extension::periodic : Extension::tangent);
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (int i = 0; i < u.distinct(); ++i)
    for (int j = 0; j < v.distinct(); ++j) {
      const Vec4& p = form.points[static_cast<size_t>(i) * form.count_v() + j];
      points.push_back(Vec3(p) / p.w);
      weights.push_back(p.w);
    }
  return NurbsSurface(u, v, points, weights);
}

NurbsSurface rational_sum(const std::vector<LocalKnots>& functions, const std::vector<Vec3>& points,
                          const std::vector<double>& weights, const Rectangle& domain, const Periods& periods) {
  if (points.size() != functions.size())
    throw FieldError("points", fmt::format("{} vertices need as many points, not {}", functions.size(), points.size()));
  if (!weights.empty() && weights.size() != points.size())
    throw FieldError("weights", fmt::format("{} weights do not fit {} points", weights.size(), points.size()));
  std::vector<Vec4> values;
  for (size_t i = 0; i < points.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    if (!(w > 0)) throw FieldError("weights", fmt::format("weight {} is {}, not positive", i, w));
    values.emplace_back(w * points[i], w);
  }
  const RepeatedFunctions all = repeated(functions, domain, periods);
  std::vector<Vec4> all_values;
  for (const int i : all.of) all_values.push_back(values[static_cast<size_t>(i)]);
  NurbsSurfaceForm form = sum_of(all.functions, all_values, domain, periods);
  for (Vec4& p : form.points) {
    if (!(p.w > 0))
      throw FieldError("domain", "somewhere in the domain all functions vanish", "a smaller domain, or more functions");
    if (std::abs(p.w - 1) <= kSumIsOne) p = Vec4(Vec3(p) / p.w, 1);
  }
  return periods.u > 0 || periods.v > 0 ? closed_surface(form, periods) : NurbsSurface(form);
}

}  // namespace

TSpline::TSpline(std::vector<LocalKnots> functions, std::vector<Vec3> points, std::vector<double> weights,
                 const Rectangle& domain, std::vector<std::array<int, 2>> edges, const Periods& periods)
    : functions_(std::move(functions)),
      points_(std::move(points)),
      edges_(std::move(edges)),
      surface_(rational_sum(functions_, points_, weights, domain, periods)) {}

Vec2 TSpline::end_of(const std::array<int, 2>& edge) const {
  const Vec2 from = place(edge[0]);
  Vec2 to = place(edge[1]);
  if (periods().u > 0 && from.y == to.y && to.x <= from.x) to.x += periods().u;
  if (periods().v > 0 && from.x == to.x && to.y <= from.y) to.y += periods().v;
  return to;
}

Vec2 TSpline::place(int i) const {
  const size_t middle = functions_[i].u.size() / 2;
  return {functions_[i].u[middle], functions_[i].v[middle]};
}

Rectangle valid_domain(const TMesh& mesh, const std::vector<LocalKnots>& functions) {
  Vec2 lo(kInfinity), hi(-kInfinity);
  for (size_t i = 0; i < functions.size(); ++i)
    lo = glm::min(lo, mesh.vertices[i]), hi = glm::max(hi, mesh.vertices[i]);
  const int degree = degree_of(functions);
  const bool closed_u = mesh.periods.u > 0, closed_v = mesh.periods.v > 0;
  Rectangle domain{{lo.x, closed_u ? lo.x + mesh.periods.u : hi.x}, {lo.y, closed_v ? lo.y + mesh.periods.v : hi.y}};
  for (size_t i = 0; i < functions.size(); ++i) {
    const Vec2& p = mesh.vertices[i];
    if (p.x == lo.x && !closed_u) domain.u.lo = std::max(domain.u.lo, functions[i].u[degree]);
    if (p.x == hi.x && !closed_u) domain.u.hi = std::min(domain.u.hi, functions[i].u[1]);
    if (p.y == lo.y && !closed_v) domain.v.lo = std::max(domain.v.lo, functions[i].v[degree]);
    if (p.y == hi.y && !closed_v) domain.v.hi = std::min(domain.v.hi, functions[i].v[1]);
  }
  if (!(domain.u.lo < domain.u.hi && domain.v.lo < domain.v.hi))
    throw FieldError(
        "lines",
        fmt::format("no cell is {} cells away from the whole border, as degree {} needs", (degree - 1) / 2, degree),
        "more lines, or a lower degree");
  return domain;
}

namespace {

struct GivenFunctions {
  std::vector<LocalKnots> functions;
  std::vector<std::array<int, 2>> edges;
  Rectangle domain;
  Periods periods;
};

Periods periods_of(const Fields& f) { return {f.u<double>("period"), f.v<double>("period")}; }

// Along a closed direction the domain is one period.
void check_domain(const GivenFunctions& given, const Interval& min_u, const Interval& min_v) {
  const auto check = [](const Interval& domain, double period, double begin) {
    if (period > 0 && !(std::abs(domain.width() - period) <= kSameKnot * period && domain.lo == begin))
      throw FieldError(
          "domain",
          fmt::format("it is {:.6g}..{:.6g} along a direction with the period {:.6g} that begins at {:.6g}", domain.lo,
                      domain.hi, period, begin),
          "one period, from its beginning");
  };
  check(given.domain.u, given.periods.u, min_u.lo);
  check(given.domain.v, given.periods.v, min_v.lo);
}

void check_own_knots(const Grid<double>& knots, const char* field) {
  for (int i = 0; i < knots.rows; ++i) {
    for (int k = 1; k < knots.columns; ++k)
      if (!(knots.at(i, k) >= knots.at(i, k - 1)))
        throw FieldError(field, fmt::format("the knots of function {} decrease: {} follows {}", i, knots.at(i, k),
                                            knots.at(i, k - 1)));
    if (!(knots.at(i, 0) < knots.at(i, knots.columns - 1)))
      throw FieldError(field, fmt::format("the knots of function {} are all the same", i));
  }
}

GivenFunctions own_knots(const Fields& f, int degree) {
  GivenFunctions given;
  if (!f.has("knots_u") || !f.has("knots_v"))
    throw FieldError(f.has("knots_u") ? "knots_v" : "knots_u", "knots of the functions are needed in both directions");
  const Grid<double>&u = f.number_grid("knots_u"), &v = f.number_grid("knots_v");
  if (u.rows != v.rows)
    throw FieldError("knots_v", fmt::format("{} rows of knots do not fit the {} of knots_u", v.rows, u.rows));
  for (const auto& [grid, field] : {std::pair(&u, "knots_u"), std::pair(&v, "knots_v")}) {
    if (grid->columns != degree + 2)
      throw FieldError(field,
                       fmt::format("a function of degree {} has {} knots, not {}", degree, degree + 2, grid->columns));
    check_own_knots(*grid, field);
  }
  for (int i = 0; i < u.rows; ++i) {
    const auto row = [i](const Grid<double>& grid) {
      const auto begin = grid.values.begin() + static_cast<std::ptrdiff_t>(i) * grid.columns;
      return std::vector<double>(begin, begin + grid.columns);
    };
    given.functions.push_back({row(u), row(v)});
  }
  if (!f.has("domain")) throw FieldError("domain", "functions with knots of their own need a domain");
  given.domain = f.rectangle("domain");
  given.periods = periods_of(f);
  check_domain(given, given.domain.u, given.domain.v);
  return given;
}

GivenFunctions read_functions(const Fields& f) {
  const int degree = f.integer("degree");
  if (degree % 2 == 0) throw FieldError("degree", fmt::format("{} is even", degree), "1, 3, 5 or 7");
  const bool of_mesh = f.has("at") || f.has("lines");
  if (of_mesh == (f.has("knots_u") || f.has("knots_v")))
    throw FieldError(of_mesh ? "knots_u" : "at", "the functions come either from a mesh or from knots of their own",
                     "give 'at' and 'lines', or 'knots_u', 'knots_v' and 'domain'");
  if (!of_mesh) return own_knots(f, degree);
  if (!f.has("at") || !f.has("lines"))
    throw FieldError(f.has("at") ? "lines" : "at", "a mesh has vertices and lines", "give 'at' and 'lines'");
  const TMesh mesh = t_mesh(f.points("at"), f.indices("lines"), periods_of(f));
  GivenFunctions given{inferred_knots(mesh, degree), mesh.own_edges(), {}, mesh.periods};
  // One that is given may lie where a mesh has none by itself; it is a period where the mesh is closed.
  const bool closed = mesh.periods.u > 0 || mesh.periods.v > 0;
  const Rectangle valid = f.has("domain") && !closed ? f.rectangle("domain") : valid_domain(mesh, given.functions);
  given.domain = f.has("domain") ? f.rectangle("domain") : valid;
  check_domain(given, valid.u, valid.v);
  return given;
}

TSpline build_within(const Fields& f) {
  for (const char* other : {"at", "lines", "knots_u", "knots_v", "points", "weights", "domain"})
    if (f.has(other))
      throw FieldError(other, "with a tolerance the mesh and its points are made of the surface",
                       "leave one of them out");
  if (periods_of(f).u > 0 || periods_of(f).v > 0)
    throw FieldError("period", "meshes that are made for a tolerance are open", "leave 'tolerance' or 'period' out");
  if (!f.has("of")) throw FieldError("tolerance", "there is nothing to be near", "give 'of', a surface");
  const int degree = f.integer("degree");
  if (degree % 2 == 0) throw FieldError("degree", fmt::format("{} is even", degree), "1, 3, 5 or 7");
  return t_spline_within(*f.surface("of"), degree, f.u<int>("cells"), f.v<int>("cells"), f.number("tolerance"));
}

TSpline build(const Fields& f) {
  if (f.has("tolerance")) return build_within(f);
  GivenFunctions given = read_functions(f);
  const std::vector<double> weights = f.has("weights") ? f.numbers("weights") : std::vector<double>();
  if (f.has("points") && f.has("of"))
    throw FieldError("of", "the points are either given or fitted to a surface", "give 'points' or 'of'");
  if (!weights.empty() && weights.size() != given.functions.size())
    throw FieldError("weights", fmt::format("{} weights do not fit {} points", weights.size(), given.functions.size()));
  std::vector<Vec3> points;
  if (f.has("of"))
    points = fitted_points(given.functions, weights, given.domain, *f.surface("of"), given.periods);
  else if (f.has("points") || f.has("at"))
    points = f.points(f.has("points") ? "points" : "at");
  return TSpline(std::move(given.functions), std::move(points), weights, given.domain, std::move(given.edges),
                 given.periods);
}

// (u, v, sum of some functions) over a rectangle.
NurbsSurface graph_of_sum(const TSpline& of, const std::vector<double>& which, const std::optional<Rectangle>& part) {
  const std::vector<LocalKnots>& functions = of.functions();
  const RepeatedFunctions all = repeated(functions, of.domain(), of.periods());
  Rectangle domain{{functions[0].u.front(), functions[0].u.back()}, {functions[0].v.front(), functions[0].v.back()}};
  for (const LocalKnots& function : functions) {
    domain.u = hull(domain.u, {function.u.front(), function.u.back()});
    domain.v = hull(domain.v, {function.v.front(), function.v.back()});
  }
  std::vector<Vec4> values(functions.size(), which.empty() ? Vec4(0, 0, 1, 0) : Vec4(0));
  for (const double i : which) {
    if (!(i >= 0 && i < static_cast<double>(functions.size()) && i == std::floor(i)))
      throw FieldError("vertices", fmt::format("{} is not the number of a vertex, 0 to {}", i, functions.size() - 1));
    values[static_cast<size_t>(i)].z = 1;
  }
  if (of.periods().u > 0) domain.u = of.domain().u;
  if (of.periods().v > 0) domain.v = of.domain().v;
  std::vector<Vec4> all_values;
  for (const int i : all.of) all_values.push_back(values[static_cast<size_t>(i)]);
  NurbsSurfaceForm form = sum_of(all.functions, all_values, part.value_or(domain));
  for (int i = 0; i < form.count_u(); ++i)
    for (int j = 0; j < form.count_v(); ++j) {
      Vec4& p = form.points[static_cast<size_t>(i) * form.count_v() + j];
      p = Vec4(greville(form.knots_u, form.degree_u, i), greville(form.knots_v, form.degree_v, j), p.z, 1);
    }
  return NurbsSurface(form);
}

}  // namespace

TypeDeclaration t_spline_type() {
  return declare(Category::surface, "t_spline",
                 "T-spline surface: control points at the vertices of a mesh of rectangles whose lines need not go all "
                 "the way through. The functions of a mesh sum to 1 from (degree - 1)/2 cells inside its border on, "
                 "where the surface is defined; where lines end near one another the sum is another one, by which the "
                 "points' sum is divided.")
      .example(
          "degree: 1, at: [[0, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]], lines: [[0, 1], [2, 4], "
          "[5, 7], [0, 5], [3, 6], [1, 7]], points: [[0, 0], [2, 0], [0, 1], [1, 1, 1], [2, 1], [0, 2], [1, 2], "
          "[2, 2]]")
      .field("degree", integer().between(1, 7), "of the functions in both directions; odd", "3")
      .optional("at", parameter_points(), "places (u, v) of the vertices")
      .optional("lines", indices(), "lines of the mesh, each by the numbers of vertices on it, ends at least")
      .optional("knots_u", number_grid(), "without a mesh: the degree + 2 knots of each point's function of u")
      .optional("knots_v", number_grid(), "and of its function of v")
      .optional("points", points(),
                "control points, in the order of the vertices; else the vertices themselves, in the plane z = 0")
      .optional("of", reference({Category::surface}),
                "a surface instead, over the same parameters: the points of least squared distance from it")
      .optional(
          "tolerance", length().positive(),
          "of `of`, without a mesh: one is made that is fine where it has to be, until at places of its cells the "
          "two are nowhere farther apart")
      .field(
          "period", number().non_negative().for_each_direction(),
          "above 0 the mesh is closed: after so much of u or v the vertices, which are not repeated, come again, and "
          "the lines, which run towards higher parameters, go on from the last vertex over the seam to the first",
          "0")
      .field("cells", integer().between(1, 100).for_each_direction(), "of the mesh that is made: how many at first",
             "4")
      .optional("weights", numbers(), "one for each point; all 1 when left out")
      .optional("domain", rectangle(), "where the surface is wanted; else where the functions of the mesh sum to 1")
      .shows({"control_net", "t_mesh"})
      .built_by(build);
}

TypeDeclaration t_spline_functions_type() {
  return declare(Category::surface, "t_spline_functions",
                 "Graph over the parameter plane of the functions of a T-spline: z is the sum of some of them, or of "
                 "all.")
      .example(
          "of: { type: t_spline, degree: 1, at: [[0, 0], [2, 0], [1, 0], [0, 2], [1, 2], [2, 2]], lines: [[0, 1], "
          "[3, 5], [0, 3], [1, 5], [2, 4]] }, vertices: [2]")
      .field("of", reference({Category::surface}), "the T-spline")
      .optional("vertices", numbers(), "whose functions are added; all without it")
      .optional("domain", rectangle(), "part of the plane; else where the functions are not zero")
      .built_by([](const Fields& f) {
        const SurfacePtr of = f.surface("of");
        const TSpline* const spline = placed<TSpline>(*of).surface;  // its functions do not move with it
        if (!spline) throw FieldError("of", "the surface is not a t_spline");
        return graph_of_sum(*spline, f.has("vertices") ? f.numbers("vertices") : std::vector<double>(),
                            f.has("domain") ? std::optional(f.rectangle("domain")) : std::nullopt);
      });
}

}  // namespace lekalo::geometry
