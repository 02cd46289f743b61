// Graphs of basis functions: B-splines against their own recursion (Golovanov 2016, 2.8), the other families against
// their formulas; derivatives and integrals.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry::basis_function_test {
namespace {

CurvePtr built(Fields fields) {
  const auto by_default = [&](const char* field, std::any value) {
    if (!fields.has(field)) fields.set(field, std::move(value));
  };
  by_default("family", std::string("b_spline")), by_default("numbering", std::string("first"));
  by_default("derivative", 0), by_default("index", 0);
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "basis_function") return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

CurvePtr function(int degree, const std::vector<double>& knots, int index, int derivative = 0) {
  Fields fields;
  fields.set("degree", degree), fields.set("knots", knots), fields.set("index", index);
  fields.set("derivative", derivative);
  return built(fields);
}

// Of another family; no degree or no knots: left out.
CurvePtr member(const std::string& family, int degree, const std::vector<double>& knots, int index, int derivative = 0,
                const Interval& domain = {0, 0}) {
  Fields fields;
  fields.set("family", family), fields.set("index", index), fields.set("derivative", derivative);
  if (degree >= 0) fields.set("degree", degree);
  if (!knots.empty()) fields.set("knots", knots);
  if (domain.width() > 0) fields.set("domain", domain);
  return built(fields);
}

void expect_graph(const CurvePtr& graph, const std::function<double(double)>& f, double within = 1e-13) {
  const Interval domain = graph->domain();
  for (int k = 0; k <= 20; ++k) {
    const double t = domain.lo + domain.width() * (k + 0.31) / 21;
    const Vec3 p = graph->point(t);
    EXPECT_NEAR(p.x, t, 1e-14 * (1 + std::abs(t)));
    EXPECT_NEAR(p.y, f(t), within * (1 + std::abs(f(t)))) << t;
  }
}

double recursion(int degree, const std::vector<double>& t, int i, double x) {
  if (degree == 0) return t[i] <= x && x < t[i + 1] ? 1 : 0;
  double sum = 0;
  if (t[i + degree] > t[i]) sum += (x - t[i]) / (t[i + degree] - t[i]) * recursion(degree - 1, t, i, x);
  if (t[i + degree + 1] > t[i + 1])
    sum += (t[i + degree + 1] - x) / (t[i + degree + 1] - t[i + 1]) * recursion(degree - 1, t, i + 1, x);
  return sum;
}

TEST(BasisFunction, IsTheGraphOfItsRecursion) {
  const std::vector<std::pair<int, std::vector<double>>> cases = {{3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6}},
                                                                  {2, {0, 1, 2, 3, 4, 5, 6}},
                                                                  {1, {0, 0.5, 2, 2, 3}},
                                                                  {2, {0, 0, 1, 1, 2, 5}}};
  for (const auto& [degree, knots] : cases)
    for (int i = 0; i + degree + 1 < static_cast<int>(knots.size()); ++i) {
      const CurvePtr graph = function(degree, knots, i);
      EXPECT_EQ(graph->domain().lo, knots.front());
      EXPECT_EQ(graph->domain().hi, knots.back());
      for (double x = knots.front() + 0.013; x < knots.back(); x += 0.171) {
        const Vec3 p = graph->point(x);
        EXPECT_NEAR(p.x, x, 1e-14 * (1 + x));
        EXPECT_NEAR(p.y, recursion(degree, knots, i, x), 1e-14) << degree << " " << i << " " << x;
        EXPECT_EQ(p.z, 0);
      }
    }
  EXPECT_NEAR(function(3, cases[0].second, 4)->point(3).y, 2.0 / 3, 1e-15);
}

TEST(BasisFunction, DerivativesAreThoseOfTheGraph) {
  const std::vector<double> knots = {0, 0, 0, 0, 1, 2, 2, 3.5, 4, 4, 4, 4};
  for (int index = 0; index < 8; ++index) {
    const CurvePtr whole = function(3, knots, index);
    for (int order = 1; order <= 3; ++order)
      expect_graph(
          function(3, knots, index, order), [&](double t) { return whole->evaluate(t, order).d[order].y; }, 1e-12);
  }
}

// The integral of N_i over all knots is (t_(i+p+1) - t_i)/(p + 1) (Golovanov 2016, 2.8.16), and its derivative is N_i.
TEST(BasisFunction, Integrals) {
  const std::vector<double> knots = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6};
  for (int index = 0; index < 9; ++index) {
    const CurvePtr whole = function(3, knots, index), sum = function(3, knots, index, -1);
    EXPECT_NEAR(sum->point(6).y, (knots[index + 4] - knots[index]) / 4, 1e-14);
    expect_graph(whole, [&](double t) { return sum->evaluate(t, 1).d[1].y; });
  }
  EXPECT_NEAR(member("bernstein", 4, {}, 2, -1)->point(1).y, 0.2, 1e-15);
}

TEST(BasisFunction, StepsOfDegreeZero) {
  const CurvePtr box = function(0, {0, 1, 2, 4}, 1);
  for (const double t : {0.0, 0.99, 2.0, 3.5}) EXPECT_EQ(box->point(t).y, 0) << t;
  for (const double t : {1.0, 1.5, 1.99}) EXPECT_EQ(box->point(t).y, 1) << t;
  const CurvePtr slope = function(1, {0, 1, 3}, 0, 1);
  EXPECT_EQ(slope->point(0.5).y, 1);
  EXPECT_EQ(slope->point(2).y, -0.5);
}

TEST(BasisFunction, Families) {
  expect_graph(member("bernstein", 3, {}, 1), [](double u) { return 3 * u * (1 - u) * (1 - u); });
  expect_graph(member("bernstein", 2, {2, 4}, 2), [](double t) { return (t - 2) * (t - 2) / 4; });
  const std::vector<double> nodes = {0, 2.236, 1.5, 7};
  for (int i = 0; i < 4; ++i)
    expect_graph(member("lagrange", -1, nodes, i), [&](double t) {
      double product = 1;
      for (int j = 0; j < 4; ++j)
        if (j != i) product *= (t - nodes[j]) / (nodes[i] - nodes[j]);
      return product;
    });
  expect_graph(member("newton", -1, nodes, 3), [](double t) { return t * (t - 2.236) * (t - 1.5); });
  expect_graph(member("newton", -1, nodes, 0), [](double) { return 1.0; });
  expect_graph(member("truncated_power", 2, {1}, 0, 0, {-1, 3}),
               [](double t) { return t < 1 ? 0 : (t - 1) * (t - 1); });
  expect_graph(member("truncated_power", 3, {1}, 0, 3, {-1, 3}), [](double t) { return t < 1 ? 0 : 6; });
}

// alpha_0, alpha_1, beta_0, beta_1 (Golovanov 2016, 2.3.11); and of every degree the derivatives at the nodes.
TEST(BasisFunction, Hermite) {
  expect_graph(member("hermite", 3, {}, 0), [](double w) { return 1 - 3 * w * w + 2 * w * w * w; });
  expect_graph(member("hermite", 3, {}, 1), [](double w) { return 3 * w * w - 2 * w * w * w; });
  expect_graph(member("hermite", 3, {}, 2), [](double w) { return w - 2 * w * w + w * w * w; });
  expect_graph(member("hermite", 3, {}, 3), [](double w) { return -w * w + w * w * w; });
  for (const int degree : {1, 3, 5, 7})
    for (int index = 0; index <= degree; ++index) {
      const CurvePtr graph = member("hermite", degree, {1, 3.5}, index);
      for (int other = 0; other <= degree; ++other)
        EXPECT_NEAR(graph->evaluate(other % 2 ? 3.5 : 1, 3).d[other / 2].y, other == index, 1e-12) << degree << index;
    }
}

TEST(BasisFunction, NumberedByTheLastKnot) {
  const std::vector<double> knots = {0, 1, 2, 4, 5, 7};
  Fields fields;
  fields.set("degree", 2), fields.set("knots", knots), fields.set("index", 4),
      fields.set("numbering", std::string("last"));
  const CurvePtr last = built(fields), first = function(2, knots, 1);
  expect_graph(last, [&](double t) { return first->point(t).y; });
  fields.set("index", 2);
  EXPECT_THROW(built(fields), FieldError);
}

TEST(BasisFunction, ErrorsOfFamilies) {
  EXPECT_THROW(member("bernstein", -1, {}, 0), FieldError);
  EXPECT_THROW(member("bernstein", 3, {}, 4), FieldError);
  EXPECT_THROW(member("bernstein", 3, {1, 0}, 0), FieldError);
  EXPECT_THROW(member("bernstein", 2, {}, 0, 3), FieldError);
  EXPECT_THROW(member("lagrange", -1, {1, 2, 1}, 0), FieldError);
  EXPECT_THROW(member("lagrange", 3, {1, 2, 4}, 0), FieldError);
  EXPECT_THROW(member("lagrange", -1, {}, 0), FieldError);
  EXPECT_THROW(member("newton", -1, {1, 1}, 1), FieldError);
  EXPECT_THROW(member("hermite", 2, {}, 0), FieldError);
  EXPECT_THROW(member("truncated_power", 2, {1, 2}, 0), FieldError);
  EXPECT_THROW(member("truncated_power", 2, {1}, 0, 0, {2, 3}), FieldError);
}

TEST(BasisFunction, Errors) {
  EXPECT_THROW(function(3, {0, 1, 2, 3}, 0), FieldError);
  EXPECT_THROW(function(2, {0, 0, 0, 1, 1, 1}, 3), FieldError);
  EXPECT_THROW(function(1, {0, 1, 0.5, 2}, 0), FieldError);
  EXPECT_THROW(function(1, {0, 0, 0, 1}, 0), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::basis_function_test
