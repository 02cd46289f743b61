#include "geometry/shapes/tube/cuspidal_edges.h"

#include <array>
#include <cmath>

#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/numerics/chebyshev.h"
#include "geometry/numerics/gradient.h"
#include "geometry/numerics/solution_curves.h"
#include "geometry/numerics/triple.h"

namespace lekalo::geometry {

namespace {

constexpr int kTerms = 20;
constexpr double kModelError = 1e-14;                                // of the size
constexpr double kAgree = 1e-13, kMinBox = 1e-6, kLargeOpen = 1e-3;  // likewise
constexpr double kBorder = 1e-12;                                    // of the domain's sides
constexpr int kMaxBoxes = 40000, kChecks = 53;

template <class S>
using Four = std::array<S, 4>;  // c and R^2

// The unknowns s and d are those of x in [-1, 1] over the range.
class Bend {
 public:
  using Place = ParameterPoint<3>;
  using Box = ParameterBox<3>;

  static std::optional<Bend> of(const BallSweep& sweep, const Interval& range) {
    Bend bend;
    bend.range_ = range;
    bend.size_ = sweep.size();
    bend.origin_ = sweep.ball(range.middle()).center[0];
    const auto at = [&](double x) {
      const BallJet ball = sweep.ball(range.middle() + 0.5 * range.width() * x);
      return Vec4(ball.center[0] - bend.origin_, ball.radius[0] * ball.radius[0]);
    };
    std::array<Vec4, kTerms> values;
    for (int j = 0; j < kTerms; ++j) values[j] = at(chebyshev_point(j, kTerms));
    bend.powers_ = powers_of_chebyshev(chebyshev_coefficients(values));
    for (int k = 0; k <= kChecks; ++k) {
      const double x = -1 + 2.0 * k / kChecks;
      const Vec4 model = bend.derivatives(x)[0], off = at(std::clamp(x, -1.0, 1 - 1e-15)) - model;
      bend.radius_ = std::max(bend.radius_, std::sqrt(std::max(model.w, 0.0)));
      if (!(glm::length(Vec3(off)) <= kModelError * bend.size_ &&
            std::abs(off.w) <= kModelError * bend.size_ * bend.size_))
        return std::nullopt;
    }
    for (int k = 0; k < kTerms; ++k) bend.speed_ += k * glm::length(Vec3(bend.powers_[k]));
    return bend;
  }

  Box domain() const { return {Interval(-1, 1), Interval(0, 1), Interval(-1.01 * radius_, 1.01 * radius_)}; }
  std::array<double, 2> rounding() const {
    const double each = 1e-14 * (size_ * size_ + speed_ * speed_);
    return {each, each};
  }

  SystemValue<Interval, 3, 2> enclose(const Box& box) const { return values(equations<Interval>(box)); }
  SystemValue<double, 3, 2> evaluate(const Place& at) const { return values(equations<double>(at)); }
  SystemValue<double, 3, 2> evaluate_middle(const Box& box) const {
    return evaluate({box[0].middle(), box[1].middle(), box[2].middle()});
  }
  std::array<double, 3> extents(const Box& box) const {
    return {speed_ * box[0].width(), speed_ * box[1].width(), box[2].width()};
  }
  Vec3 motion(const Place& at, const Place& by) const {
    const Triple<Gradient<double>> p = equations<double>(at).point;
    Vec3 sum(0);
    for (int i = 0; i < 3; ++i) sum += by[i] * Vec3(p.x.c[1 + i], p.y.c[1 + i], p.z.c[1 + i]);
    return sum;
  }
  Vec3 point(const Place& at) const {
    const Triple<Gradient<double>> p = equations<double>(at).point;
    return origin_ + Vec3(p.x.c[0], p.y.c[0], p.z.c[0]);
  }
  // The t of both balls.
  Vec2 balls(double s, double D) const {
    const double d = std::sqrt(std::max(D, 0.0));
    const auto t = [&](double x) { return range_.middle() + 0.5 * range_.width() * x; };
    return {t(s - d), t(s + d)};
  }
  double size() const { return size_; }

 private:
  // All derivatives at a place, and over a range of them by Taylor's polynomials about its middle.
  std::array<Vec4, kTerms> derivatives(double x) const {
    std::array<Vec4, kTerms> h = powers_;  // Horner's scheme, again and again
    double factorial = 1;
    for (int k = 0; k < kTerms; ++k) {
      for (int i = kTerms - 2; i >= k; --i) h[i] += x * h[i + 1];
      if (k > 0) factorial *= k;
    }
    factorial = 1;
    for (int k = 0; k < kTerms; ++k) {
      if (k > 0) factorial *= k;
      h[k] *= factorial;
    }
    return h;
  }
  std::array<Four<double>, kTerms> derivatives_over(double x) const {
    std::array<Four<double>, kTerms> result;
    const std::array<Vec4, kTerms> h = derivatives(x);
    for (int k = 0; k < kTerms; ++k) result[k] = {h[k].x, h[k].y, h[k].z, h[k].w};
    return result;
  }
  std::array<Four<Interval>, kTerms> derivatives_over(const Interval& range) const {
    const double middle = range.middle();
    const std::array<Vec4, kTerms> h = derivatives(middle);
    const Interval off = range - Interval(middle);
    std::array<Four<Interval>, kTerms> result;
    for (int k = 0; k < kTerms; ++k)
      for (int i = 0; i < 4; ++i) {
        Interval sum(0);
        for (int j = kTerms; j-- > k;) sum = Interval(h[j][i]) + sum * off * (1.0 / (j - k + 1));
        result[k][i] = sum;
      }
    return result;
  }

  // The coefficients of the series in D from derivative number `first` on: A0, A1 and their derivatives by D.
  template <class S>
  static S series(const std::array<Four<S>, kTerms>& h, int i, int first, bool odd, int by_D, const S& D) {
    S sum(0);
    for (int k = (kTerms - 1 - first - (odd ? 1 : 0)) / 2; k >= by_D; --k) {
      double factor = 1;
      for (int j = 0; j < by_D; ++j) factor *= k - j;
      for (int j = 2; j <= 2 * k + (odd ? 1 : 0); ++j) factor /= j;
      sum = sum * D + h[first + 2 * k + (odd ? 1 : 0)][i] * S(factor);
    }
    return sum;
  }
  template <class S>
  static Gradient<S> with_slopes(const std::array<Four<S>, kTerms>& h, int i, bool odd, int by_D, const S& D) {
    Gradient<S> value;
    value.c[0] = series(h, i, 0, odd, by_D, D);
    value.c[1] = series(h, i, 1, odd, by_D, D);
    value.c[2] = series(h, i, 0, odd, by_D + 1, D);
    value.c[3] = S(0);
    return value;
  }

  template <class S>
  struct Equations {
    std::array<Gradient<S>, 2> value;
    Triple<Gradient<S>> point;  // from the origin
  };
  template <class S>
  Equations<S> equations(const std::array<S, 3>& at) const {
    using G = Gradient<S>;
    const std::array<Four<S>, kTerms> h = derivatives_over(at[0]);
    const auto curve = [&](bool odd, int by_D) {
      return Triple<G>{with_slopes(h, 0, odd, by_D, at[1]), with_slopes(h, 1, odd, by_D, at[1]),
                       with_slopes(h, 2, odd, by_D, at[1])};
    };
    const auto square = [&](bool odd, int by_D) { return with_slopes(h, 3, odd, by_D, at[1]); };
    const G D = G::variable(at[1], 1), z = G::variable(at[2], 2);
    const Triple<G> a = curve(true, 0), b = curve(false, 1), c = curve(true, 1), m = cross(a, b);
    const G aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), area = dot(m, m);
    const G of_a = square(true, 0) * S(-0.5), of_b = aa * S(0.5) + D * dot(a, c) - square(false, 1) * S(0.5);
    const G x = (of_a * bb - of_b * ab) / area, y = (of_b * aa - of_a * ab) / area, w = z / sqrt(area);
    Equations<S> result;
    result.value[0] = of_a * x + of_b * y + sqr(z) + D * aa - square(false, 0);
    result.value[1] = x * dot(a, c) + y * dot(b, c) + w * dot(m, c) - ab + square(true, 1) * S(0.5);
    result.point = curve(false, 0) + x * a + y * b + w * m;
    return result;
  }
  template <class S>
  static SystemValue<S, 3, 2> values(const Equations<S>& equations) {
    SystemValue<S, 3, 2> result;
    for (int k = 0; k < 2; ++k) {
      result.value[k] = equations.value[k].c[0];
      for (int i = 0; i < 3; ++i) result.derivative[k][i] = equations.value[k].c[1 + i];
    }
    return result;
  }

  Interval range_;
  Vec3 origin_{0};
  double size_ = 0, radius_ = 0, speed_ = 0;
  std::array<Vec4, kTerms> powers_;
};

// The solution between two nodes, in the plane across the chord: by Newton's iteration.
ParameterPoint<3> between(const Bend& bend, const ParameterPoint<3>& from, const ParameterPoint<3>& to, double share) {
  constexpr int kSteps = 12;
  const ParameterBox<3> domain = bend.domain();
  Vec3 x, chord;
  Vec3 scale;
  for (int i = 0; i < 3; ++i) {
    scale[i] = domain[i].width();
    x[i] = from[i] + share * (to[i] - from[i]);
    chord[i] = (to[i] - from[i]) / (scale[i] * scale[i]);
  }
  const Vec3 start = x;
  for (int step = 0; step < kSteps; ++step) {
    const auto f = bend.evaluate({x.x, x.y, x.z});
    const Vec3 first(f.derivative[0][0], f.derivative[0][1], f.derivative[0][2]),
        second(f.derivative[1][0], f.derivative[1][1], f.derivative[1][2]);
    const Mat3 rows(first, second, chord);
    const Vec3 by = glm::inverse(glm::transpose(rows)) * Vec3(f.value[0], f.value[1], glm::dot(chord, x - start));
    x -= by;
    if (glm::length(by / scale) < 1e-15) break;
  }
  return {x.x, x.y, x.z};
}

}  // namespace

std::optional<BendEdges> bend_edges(const BallSweep& sweep, const Interval& range) {
  const std::optional<Bend> bend = Bend::of(sweep, range);
  if (!bend) return std::nullopt;
  SolutionCurveOptions<3> options;
  options.least = kMinBox * bend->size();
  options.max_boxes = kMaxBoxes;
  options.divides_hard_boxes = true;
  options.rounding = bend->rounding();
  for (int i = 0; i < 3; ++i) options.slack[i] = kBorder * bend->domain()[i].width();
  const SolutionCurves<3> found = search_solution_curves<3>(*bend, bend->domain(), options);
  BendEdges result;
  result.complete = found.complete;
  for (const ParameterBox<3>& open : found.open)
    for (const double extent : bend->extents(open))
      result.complete = result.complete && extent <= kLargeOpen * bend->size();
  for (const SolutionArc<3>& arc : found.arcs) {
    const auto last = static_cast<int>(arc.nodes.size()) - 1;
    std::vector<Interval> parts;
    for (int k = 0; k < last; ++k) parts.emplace_back(k, k + 1);
    const auto at = [&](double t) {
      const auto k = static_cast<size_t>(std::clamp(static_cast<int>(t), 0, last - 1));
      return between(*bend, arc.nodes[k], arc.nodes[k + 1], t - static_cast<double>(k));
    };
    const CurvePtr curve =
        polynomial_approximation([&](double t) { return bend->point(at(t)); }, parts, kAgree * bend->size());
    const CurvePtr places = polynomial_approximation(
        [&](double t) {
          const ParameterPoint<3> place = at(t);
          return Vec3(place[0], place[1], place[2]);
        },
        parts, kAgree * bend->size());
    if (curve && places)
      result.edges.push_back({curve, [bend = *bend, places](double t) {
                                const Vec3 place = places->point(t);
                                return bend.balls(place.x, place.y);
                              }});
    else
      result.complete = false;
  }
  return result;
}

}  // namespace lekalo::geometry
