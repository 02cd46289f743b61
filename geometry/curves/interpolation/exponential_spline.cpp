// The spline in tension (Schweikert 1966; Zavyalov et al. 1985, I.6): r^(4) = (p/h)^2 r'' over each span. With
// u = (t - t_i) / h, M_i = r''(t_i) and phi(u) = (sinh(p u) / sinh(p) - u) / p^2, which for p -> 0 is (u^3 - u) / 6,
//
//   r = (1 - u) p_i + u p_{i+1} + h^2 (M_i phi(1 - u) + M_{i+1} phi(u)).
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/interpolation/tension_spline.h"

namespace lekalo::geometry {

namespace {

// Below, phi by the series of sinh, whose leading terms cancel.
constexpr double kSmall = 1;
constexpr size_t kTerms = 9;

double value_of(double x) { return x; }
double value_of(const Interval& x) { return x.middle(); }
template <class J>
double value_of(const J& x) {
  return value_of(x.value());
}

struct Span {
  double p = 0, h = 1;
  Vec3 from{0}, to{0}, moment_from{0}, moment_to{0};
  // phi = sum of terms[k] (u^(2k+3) - u), where p is small.
  std::array<double, kTerms> terms{};

  explicit Span(double tension) : p(tension) {
    // p^(2k+1) / ((2k+3)! sinh p)
    double term = p > 0 ? p / (6 * std::sinh(std::min(p, kSmall))) : 1.0 / 6;
    for (size_t k = 0; k < kTerms; ++k) {
      terms[k] = term;
      term *= p * p / static_cast<double>((2 * k + 4) * (2 * k + 5));
    }
  }

  template <class T>
  T phi(const T& u) const {
    using std::exp;
    if (p >= kSmall)
      return ((exp(-p * (1 - u)) - exp(-p * (1 + u))) * (1 / (1 - std::exp(-2 * p))) - u) * (1 / (p * p));
    T sum(0.0), power = u;
    for (const double term : terms) {
      power = power * u * u;
      sum = sum + term * (power - u);
    }
    return sum;
  }
  // phi'(1), -phi'(0).
  SpanFlexibility flexibility() const {
    if (p >= kSmall) {
      const double e = std::exp(-2 * p);
      return {(p * (1 + e) / (1 - e) - 1) / (p * p), (1 - 2 * p * std::exp(-p) / (1 - e)) / (p * p)};
    }
    SpanFlexibility result{0, 0};
    for (size_t k = 0; k < kTerms; ++k) {
      result.near += static_cast<double>(2 * k + 2) * terms[k];
      result.far += terms[k];
    }
    return result;
  }
};

struct ExponentialSpline {
  std::vector<double> knots;
  std::vector<Span> spans;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, value_of(t));
    const auto i = static_cast<size_t>(next - knots.begin()) - 1;
    const Span& s = spans[i];
    const T u = (t - knots[i]) * (1 / s.h), rest = 1 - u;
    const T a = s.h * s.h * s.phi(rest), b = s.h * s.h * s.phi(u);
    const auto along = [&](int k) -> T {
      return rest * s.from[k] + u * s.to[k] + a * s.moment_from[k] + b * s.moment_to[k];
    };
    return {along(0), along(1), along(2)};
  }
};

ComposedCurve<ExponentialSpline> build(const Fields& f) {
  const TensionData data = read_tension(f);
  const PointSequence points = data.sequence();
  ExponentialSpline spline;
  std::vector<SpanFlexibility> flexibilities;
  for (const double p : data.tensions) {
    spline.spans.emplace_back(p);
    flexibilities.push_back(spline.spans.back().flexibility());
  }
  const std::vector<Vec3> second = second_derivatives(points, flexibilities, data.ends);
  const int count = static_cast<int>(spline.spans.size());
  for (int i = 0; i <= count; ++i) spline.knots.push_back(points.parameter(i));
  for (int i = 0; i < count; ++i) {
    Span& span = spline.spans[static_cast<size_t>(i)];
    span.h = points.step(i), span.from = points.point(i), span.to = points.point(i + 1);
    span.moment_from = second[static_cast<size_t>(i)];
    span.moment_to = second[static_cast<size_t>((i + 1) % points.size())];
  }
  CurveProperties properties;
  properties.domain = {spline.knots.front(), spline.knots.back()};
  properties.period = data.closed ? properties.domain.width() : 0;
  properties.breaks = spline.knots;
  return {std::move(spline), std::move(properties)};
}

}  // namespace

TypeDeclaration exponential_spline_type() {
  TypeDeclaration type =
      declare(Category::curve, "exponential_spline",
              "Spline in tension through points, of class C2: between them hyperbolic sines of the tension, from a "
              "cubic spline at 0 towards their polygon.");
  type.example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]], tension: 6");
  declare_tension(type);
  return type.built_by(build);
}

}  // namespace lekalo::geometry
