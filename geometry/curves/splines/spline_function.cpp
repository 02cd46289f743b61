#include "geometry/curves/splines/spline_function.h"

#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Leaves out functions whose knots are all one: they are zero. A derivative has them where its function jumps.
void drop_empty(SplineFunction& f) {
  for (size_t i = 0; i < f.coefficients.size();) {
    if (f.knots[i] < f.knots[i + static_cast<size_t>(f.degree) + 1]) {
      ++i;
      continue;
    }
    f.coefficients.erase(f.coefficients.begin() + static_cast<std::ptrdiff_t>(i));
    f.knots.erase(f.knots.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// A function that is constant between its knots as one of degree 1 that jumps at them.
SplineFunction with_degree_one(const SplineFunction& steps) {
  SplineFunction f{1, {}, {}};
  for (size_t i = 0; i < steps.coefficients.size(); ++i) {
    f.knots.insert(f.knots.end(), 2, steps.knots[i]);
    f.coefficients.insert(f.coefficients.end(), 2, steps.coefficients[i]);
  }
  f.knots.insert(f.knots.end(), 2, steps.knots.back());
  return f;
}

}  // namespace

// c'_i = p (c_(i+1) - c_i)/(t_(i+p+1) - t_(i+1)) on the knots t_1 .. without the last.
SplineFunction derivative(const SplineFunction& f) {
  if (f.degree == 0) throw std::invalid_argument("a function of degree 0 has no derivative");
  const auto p = static_cast<size_t>(f.degree);
  SplineFunction result{f.degree - 1, {f.knots.begin() + 1, f.knots.end() - 1}, {}};
  for (size_t i = 0; i + 1 < f.coefficients.size(); ++i) {
    const double width = f.knots[i + p + 1] - f.knots[i + 1];
    result.coefficients.push_back(width > 0 ? f.degree * (f.coefficients[i + 1] - f.coefficients[i]) / width : 0);
  }
  drop_empty(result);
  return result;
}

// C_(i+1) = C_i + c_i (t_(i+p+1) - t_i)/(p + 1): the integral of N_i is (t_(i+p+1) - t_i)/(p + 1).
SplineFunction integral(const SplineFunction& f) {
  SplineFunction result{f.degree + 1, f.knots, {0}};
  result.knots.insert(result.knots.begin(), f.knots.front());
  result.knots.push_back(f.knots.back());
  for (size_t i = 0; i < f.coefficients.size(); ++i)
    result.coefficients.push_back(result.coefficients.back() +
                                  f.coefficients[i] * (f.knots[i + static_cast<size_t>(f.degree) + 1] - f.knots[i]) /
                                      (f.degree + 1));
  return result;
}

// In Bernstein's basis: a factor with the values a, b at the ends makes c'_i = (i/n) b c_(i-1) + (1 - i/n) a c_i of
// degree n.
SplineFunction product_of_roots(std::span<const double> roots, double scale, const Interval& domain) {
  std::vector<double> c{scale};
  for (const double root : roots) {
    const auto n = static_cast<double>(c.size());
    std::vector<double> next;
    for (size_t i = 0; i <= c.size(); ++i) {
      const double at_end = i > 0 ? static_cast<double>(i) / n * (domain.hi - root) * c[i - 1] : 0;
      const double at_start = i < c.size() ? (1 - static_cast<double>(i) / n) * (domain.lo - root) * c[i] : 0;
      next.push_back(at_start + at_end);
    }
    c = std::move(next);
  }
  std::vector<double> knots(c.size(), domain.lo);
  knots.insert(knots.end(), c.size(), domain.hi);
  return {static_cast<int>(c.size()) - 1, knots, c};
}

NurbsCurve graph(const SplineFunction& f) {
  if (f.degree == 0) return graph(with_degree_one(f));
  std::vector<Vec3> points;
  for (size_t j = 0; j < f.coefficients.size(); ++j) {
    double sum = 0;
    for (size_t k = 1; k <= static_cast<size_t>(f.degree); ++k) sum += f.knots[j + k];
    points.emplace_back(sum / f.degree, f.coefficients[j], 0.0);
  }
  return NurbsCurve(SplineAxis(f.degree, f.knots, Extension::tangent), points);
}

}  // namespace lekalo::geometry
