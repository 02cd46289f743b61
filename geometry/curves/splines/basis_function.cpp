// Graphs of the functions that curves and splines are put together of: the plane curves (t, f(t)).
//
//   b_spline         N_i^p on a knot vector                                              (Golovanov 2016, 2.8)
//   bernstein        B_i^n = C(n, i) u^i (1 - u)^(n-i), u in 0..1 over the domain        (2.4.2)
//   lagrange         L_i = prod_(j != i) (t - t_j)/(t_i - t_j)                           (2.3.3)
//   newton           (t - t_0) (t - t_1) .. (t - t_(i-1))                                (2.3.5)
//   hermite          of degree 2 m - 1 on two nodes: the k-th derivative at one of them is 1, k < m, all others are 0;
//                    i = 2 k at the first node, 2 k + 1 at the second                    (2.3.11 for degree 3)
//   truncated_power  max(0, t - t_0)^n                                                   (2.7.8)
//
// Each is a spline (splines/spline_function.h), so derivatives, the integral and the graph are exact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/spline_function.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

void check_index(int index, int count, const std::string& of_what) {
  if (index >= count)
    throw FieldError("index", fmt::format("{} {} functions{}", of_what, count, count > 0 ? "" : ": there is none"),
                     fmt::format("the last is {}", count - 1));
}

const std::vector<double>& needed_knots(const Fields& f, const char* what) {
  if (!f.has("knots")) throw FieldError("family", fmt::format("functions '{}' need 'knots'", f.text("family")), what);
  return f.numbers("knots");
}

int needed_degree(const Fields& f) {
  if (!f.has("degree"))
    throw FieldError("family", fmt::format("functions '{}' need a 'degree'", f.text("family")),
                     "for example degree: 3");
  return f.integer("degree");
}

Interval domain_of(const Fields& f, const Interval& otherwise) {
  const Interval domain = f.has("domain") ? f.range("domain") : otherwise;
  if (!(domain.lo < domain.hi))
    throw FieldError("knots", "all of them are one: the graph needs two", "or give a domain");
  return domain;
}

Interval range_of(const std::vector<double>& nodes) {
  const auto [lo, hi] = std::minmax_element(nodes.begin(), nodes.end());
  return {*lo, *hi};
}

// All knots are the domain: further copies of the end knots are put in, which leaves the function as it is.
SplineFunction b_spline(const Fields& f) {
  const int degree = needed_degree(f);
  std::vector<double> knots = needed_knots(f, "the full knot vector of all the functions");
  const int functions = static_cast<int>(knots.size()) - degree - 1;
  if (functions < 1)
    throw FieldError("knots",
                     fmt::format("a function of degree {} has {} knots: there are too few", degree, degree + 2));
  const bool last = f.text("numbering") == "last";
  const int index = f.integer("index") - (last ? degree + 1 : 0);
  if (index < 0)
    throw FieldError("index", fmt::format("the last knot of the first function has the number {}", degree + 1),
                     "numbering: first takes the number of a function's first knot");
  if (index >= functions)
    throw FieldError("index", fmt::format("these knots have {} functions of degree {}", functions, degree),
                     fmt::format("the last is {}", f.integer("index") - index + functions - 1));
  if (const auto lower = std::is_sorted_until(knots.begin(), knots.end()); lower != knots.end()) {
    const auto i = lower - knots.begin();
    throw FieldError(
        "knots",
        fmt::format("knots do not decrease, but knot {} is {:g} and knot {} is {:g}", i - 1, lower[-1], i, *lower),
        "write them in ascending order");
  }
  for (size_t j = 0; j + static_cast<size_t>(degree) + 1 < knots.size(); ++j)
    if (knots[j] == knots[j + static_cast<size_t>(degree) + 1])
      throw FieldError(
          "knots", fmt::format("the knot {:g} stands more than {} times, which is degree + 1", knots[j], degree + 1),
          "leave one of them out, or raise the degree");
  const auto copies = [&](double knot) { return static_cast<int>(std::count(knots.begin(), knots.end(), knot)); };
  const int before = degree + 1 - copies(knots.front()), behind = degree + 1 - copies(knots.back());
  knots.insert(knots.begin(), static_cast<size_t>(before), knots.front());
  knots.insert(knots.end(), static_cast<size_t>(behind), knots.back());
  std::vector<double> coefficients(knots.size() - static_cast<size_t>(degree) - 1, 0.0);
  coefficients[static_cast<size_t>(index + before)] = 1;
  return {degree, std::move(knots), std::move(coefficients)};
}

// The polynomial of a degree with these coefficients in Bernstein's basis.
SplineFunction in_bernstein_form(const Interval& domain, std::vector<double> coefficients) {
  std::vector<double> knots(coefficients.size(), domain.lo);
  knots.insert(knots.end(), coefficients.size(), domain.hi);
  return {static_cast<int>(coefficients.size()) - 1, std::move(knots), std::move(coefficients)};
}

Interval ends_of(const Fields& f) {
  if (!f.has("knots")) return domain_of(f, {0, 1});
  const std::vector<double>& knots = f.numbers("knots");
  if (knots.size() != 2 || !(knots[0] < knots[1]) || f.has("domain"))
    throw FieldError("knots", "these functions have two: the ends of the domain", "knots: [0, 1], or a domain alone");
  return {knots[0], knots[1]};
}

SplineFunction bernstein(const Fields& f) {
  const int degree = needed_degree(f), index = f.integer("index");
  check_index(index, degree + 1, fmt::format("degree {} has", degree));
  std::vector<double> coefficients(static_cast<size_t>(degree) + 1, 0.0);
  coefficients[static_cast<size_t>(index)] = 1;
  return in_bernstein_form(ends_of(f), std::move(coefficients));
}

// c_j = C(j, k) h^k (n - k)!/n! for k <= j < m: the first m coefficients make the first m derivatives at the beginning.
SplineFunction hermite(const Fields& f) {
  const int degree = needed_degree(f), index = f.integer("index"), m = (degree + 1) / 2;
  if (degree % 2 == 0) throw FieldError("degree", "these functions have an odd degree", "3: points and tangents");
  check_index(index, degree + 1, fmt::format("degree {} has", degree));
  const Interval domain = ends_of(f);
  const int k = index / 2;
  const bool at_end = index % 2 == 1;
  double c = std::pow(at_end ? -domain.width() : domain.width(), k);
  for (int i = 0; i < k; ++i) c /= degree - i;
  std::vector<double> coefficients(static_cast<size_t>(degree) + 1, 0.0);
  for (int j = k; j < m; ++j) {
    coefficients[static_cast<size_t>(at_end ? degree - j : j)] = c;
    c *= static_cast<double>(j + 1) / (j + 1 - k);
  }
  return in_bernstein_form(domain, std::move(coefficients));
}

void check_degree_of_nodes(const Fields& f, int degree) {
  if (degree > kMaxDegree)
    throw FieldError("knots", fmt::format("at most {} nodes, not {}", kMaxDegree + 1, degree + 1));
  if (f.has("degree") && f.integer("degree") != degree)
    throw FieldError("degree", fmt::format("the nodes say it: {}", degree), "leave it out");
}

SplineFunction lagrange(const Fields& f) {
  std::vector<double> nodes = needed_knots(f, "the nodes");
  const int index = f.integer("index"), count = static_cast<int>(nodes.size());
  check_index(index, count, "these nodes have");
  check_degree_of_nodes(f, count - 1);
  const Interval domain = domain_of(f, range_of(nodes));
  const double own = nodes[static_cast<size_t>(index)];
  nodes.erase(nodes.begin() + index);
  double scale = 1;
  for (const double node : nodes) {
    if (node == own) throw FieldError("knots", fmt::format("the node {} stands twice", own), "nodes differ");
    scale /= own - node;
  }
  return product_of_roots(nodes, scale, domain);
}

SplineFunction newton(const Fields& f) {
  const std::vector<double>& nodes = needed_knots(f, "the nodes");
  const int index = f.integer("index");
  check_index(index, static_cast<int>(nodes.size()) + 1, "these nodes have");
  check_degree_of_nodes(f, index);
  return product_of_roots({nodes.data(), static_cast<size_t>(index)}, 1, domain_of(f, range_of(nodes)));
}

SplineFunction truncated_power(const Fields& f) {
  const std::vector<double>& knots = needed_knots(f, "the place where the function begins: knots: [0]");
  const int degree = needed_degree(f);
  if (knots.size() != 1) throw FieldError("knots", "a truncated power has one knot, where it begins", "knots: [0]");
  check_index(f.integer("index"), 1, "one knot has");
  const Interval domain = domain_of(f, {knots[0] - 1, knots[0] + 1});
  if (!(domain.lo < knots[0] && knots[0] < domain.hi))
    throw FieldError("domain", fmt::format("the knot {} lies outside of it", knots[0]), "a wider domain");
  SplineFunction result{degree, {}, std::vector<double>(static_cast<size_t>(degree) + 2, 0.0)};
  result.knots.assign(static_cast<size_t>(degree) + 1, domain.lo);
  result.knots.push_back(knots[0]);
  result.knots.insert(result.knots.end(), static_cast<size_t>(degree) + 1, domain.hi);
  result.coefficients.back() = std::pow(domain.hi - knots[0], degree);
  return result;
}

SplineFunction function_of(const Fields& f) {
  const std::string& family = f.text("family");
  if (family != "b_spline" && f.given("numbering"))
    throw FieldError("numbering", "only B-splines are numbered by their knots", "leave it out");
  if (family == "bernstein") return bernstein(f);
  if (family == "lagrange") return lagrange(f);
  if (family == "newton") return newton(f);
  if (family == "hermite") return hermite(f);
  if (family == "truncated_power") return truncated_power(f);
  return b_spline(f);
}

}  // namespace

TypeDeclaration basis_function_type() {
  return declare(Category::curve, "basis_function",
                 "Graph of a basis function of curves and splines: the plane curve (t, f(t)).")
      .example("degree: 2, knots: [0, 0, 0, 1, 1, 1], index: 1")
      .field("family", choice({"b_spline", "bernstein", "lagrange", "newton", "hermite", "truncated_power"}),
             "b_spline N_i; bernstein B_i over the domain; lagrange L_i, 1 at node i and 0 at the others; newton "
             "(t - t_0) .. (t - t_(i-1)); hermite: one derivative at one of two nodes is 1, the others are 0; "
             "truncated_power max(0, t - t_0)^degree",
             "b_spline")
      .optional("degree", integer().between(0, kMaxDegree),
                "degree of the function; that of lagrange and newton follows from the nodes")
      .optional("knots", numbers().count(1),
                "b_spline: the full knot vector of all the functions; lagrange, newton: the nodes; truncated_power: "
                "where it begins; bernstein, hermite: the ends, 0 and 1 when left out")
      .field("index", integer().at_least(0),
             "which of them, from 0; hermite: 2 k for derivative k at the first node, 2 k + 1 at the second", "0")
      .field("numbering", choice({"first", "last"}),
             "a B-spline's index is that of its first knot, or, as some books and files have it, of its last", "first")
      .field("derivative", integer().between(-1, kMaxDegree),
             "show this derivative instead; -1: the integral from the beginning", "0")
      .optional("domain", range(), "part of the graph; of polynomials any range")
      .shows({"knots", "control_polygon"})
      .built_by([](const Fields& f) {
        SplineFunction function = function_of(f);
        const int order = f.integer("derivative");
        if (order > function.degree)
          throw FieldError("derivative", fmt::format("a function of degree {} has {} derivatives that are not 0",
                                                     function.degree, function.degree));
        if (order < 0 && function.degree == kMaxDegree)
          throw FieldError("derivative", fmt::format("the integral's degree would exceed {}", kMaxDegree));
        if (order < 0) function = integral(function);
        for (int k = 0; k < order; ++k) function = derivative(function);
        const NurbsCurve whole = graph(function);
        if (f.text("family") != "b_spline" || !f.has("domain")) return whole;
        SplineAxis axis = whole.axis();
        axis.restrict_to(f.range("domain"));
        std::vector<Vec3> points;
        for (const Vec4& point : whole.points()) points.emplace_back(point);
        return NurbsCurve(std::move(axis), points);
      });
}

}  // namespace lekalo::geometry
