#include "geometry/queries/contours/contour_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

constexpr int kMaxSteps = 40;
// Of the parameters' ranges: a step that changes nothing any more.
constexpr double kRest = 1e-17;
constexpr int kContractions = 4;
// Of a box that is to hold the solution by Krawczyk's operator.
constexpr int kInflations = 6;
constexpr int kPowers = 8, kNarrowings = 50;

// The square system of a segment: the equations, and the plane across the chord.
template <int N>
struct ChordSystem {
  const ContourSegment<N>& segment;
  Vec3 along;  // of unit length

  explicit ChordSystem(const ContourSegment<N>& segment)
      : segment(segment), along(glm::normalize(segment.to - segment.from)) {}
  double height(double t) const { return glm::dot(along, segment.from) + (t - segment.t.lo); }

  // Derivatives of all, [equation][parameter].
  root_search::Matrix<N> matrix(const ContourPlace<N>& there) const {
    root_search::Matrix<N> a{};
    for (int k = 0; k < N - 1; ++k) a[k] = there.equations.derivative[k];
    for (int i = 0; i < N; ++i) a[N - 1][i] = glm::dot(along, there.motion[i]);
    return a;
  }
};

template <int N>
ParameterPoint<N> blend(const ContourSegment<N>& segment, double t) {
  const double share = segment.t.width() > 0 ? (t - segment.t.lo) / segment.t.width() : 0;
  ParameterPoint<N> x;
  for (int i = 0; i < N; ++i) x[i] = (1 - share) * segment.begin[i] + share * segment.end[i];
  return x;
}

std::vector<CurvePiece> pieces_of(const auto& segments) {
  std::vector<CurvePiece> result;
  for (const auto& segment : segments)
    result.push_back({segment.t, {ParameterMap::Kind::affine, segment.t.lo, segment.t.hi}, {}});
  return result;
}

Box3 box_of(const Triple<Jet<Interval, 2>>& r, int k, double factor) {
  const Interval x = r.x.c[k] * Interval(factor), y = r.y.c[k] * Interval(factor), z = r.z.c[k] * Interval(factor);
  return {{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
}

Vec3 vector_of(const Triple<Jet<double, kMaxContourOrder>>& r, int k) { return {r.x.c[k], r.y.c[k], r.z.c[k]}; }

double factorial(int k) {
  double product = 1;
  for (int i = 2; i <= k; ++i) product *= i;
  return product;
}

}  // namespace

template <int N>
ContourSolution<N>::ContourSolution(std::vector<ContourSegment<N>> segments, bool closed)
    : segments_(std::move(segments)), closed_(closed) {
  double t = 0;
  for (ContourSegment<N>& segment : segments_) {
    segment.t.lo = t;
    t += glm::length(segment.to - segment.from);
    segment.t.hi = t;
  }
}

template <int N>
double ContourSolution<N>::wrap(double t) const {
  const Interval all = domain();
  if (closed_ && !all.contains(t)) t -= all.width() * std::floor(t / all.width());
  return all.clamp(t);
}

template <int N>
const ContourSegment<N>& ContourSolution<N>::segment_at(double t) const {
  auto found = std::upper_bound(segments_.begin(), segments_.end(), t,
                                [](double at, const ContourSegment<N>& segment) { return at < segment.t.hi; });
  if (found == segments_.end()) --found;
  return *found;
}

template <int N>
ParameterPoint<N> ContourSolution<N>::solve(const ContourSegment<N>& segment, double t) const {
  const ChordSystem<N> system(segment);
  const double height = system.height(t);
  const ParameterPoint<N> start = blend(segment, t);
  ParameterPoint<N> x = start, width;
  for (int i = 0; i < N; ++i) width[i] = segment.equations->domain()[i].width();
  double before = kInfinity;
  for (int step = 0; step < kMaxSteps; ++step) {
    const ContourPlace<N> there = segment.equations->at(x);
    root_search::Matrix<N> inverse;
    if (!root_search::invert<N>(system.matrix(there), inverse)) return start;
    std::array<double, N> f;
    for (int k = 0; k < N - 1; ++k) f[k] = there.equations.value[k];
    f[N - 1] = glm::dot(system.along, there.point) - height;
    double length = 0;
    for (int i = 0; i < N; ++i) {
      double by = 0;
      for (int k = 0; k < N; ++k) by += inverse[i][k] * f[k];
      x[i] -= by;
      length = std::max(length, std::abs(by) / width[i]);
      // Next to a singular solution the iteration may run away: the chord is as good there.
      const double reach = std::max(std::abs(segment.end[i] - segment.begin[i]), 0.05 * width[i]);
      if (!segment.is_certified() && !(std::abs(x[i] - start[i]) <= reach)) return start;
    }
    if (!std::isfinite(length)) return start;
    if (length <= 4e-16 || (length < 1e-12 && length >= 0.5 * before)) break;
    // The next step by the convergence of this one, which is quadratic where there is one solution.
    if (segment.is_certified() && step > 0 && length < 1e-3 * before && length * sqr(length / before) <= kRest) break;
    before = length;
  }
  if (segment.is_certified())
    for (int i = 0; i < N; ++i) x[i] = segment.tube[i].clamp(x[i]);
  return x;
}

template <int N>
typename ContourSolution<N>::Series ContourSolution<N>::at(double t, int order) const {
  if (order > highest_order()) throw std::invalid_argument("derivatives beyond those of the contour's surface");
  t = wrap(t);
  const ContourSegment<N>& segment = segment_at(t);
  const ChordSystem<N> system(segment);
  const ParameterPoint<N> x = solve(segment, t);
  Series result;
  for (int i = 0; i < N; ++i) result.x[i].c[0] = x[i];
  if (order == 0) {
    const Vec3 p = segment.equations->point(x);
    result.point.x.c[0] = p.x, result.point.y.c[0] = p.y, result.point.z.c[0] = p.z;
  } else {
    root_search::Matrix<N> inverse;
    const bool regular =
        segment.is_certified() && root_search::invert<N>(system.matrix(segment.equations->at(x)), inverse);
    for (int m = 1; m <= order; ++m) {
      std::array<double, N> rest{};
      if (m == 1) {
        rest[N - 1] = 1;
      } else {
        // What the terms found so far leave in the coefficient of t^m.
        const auto series = segment.equations->series(result.x);
        for (int k = 0; k < N - 1; ++k) rest[k] = -series.equations[k].c[m];
        rest[N - 1] = -glm::dot(system.along, vector_of(series.point, m));
      }
      for (int i = 0; i < N; ++i) {
        result.x[i].c[m] = 0;
        if (regular)
          for (int k = 0; k < N; ++k) result.x[i].c[m] += inverse[i][k] * rest[k];
        else if (m == 1)
          result.x[i].c[1] = (segment.end[i] - segment.begin[i]) / segment.t.width();
      }
    }
    result.point = segment.equations->series(result.x).point;
    // Next to a singular solution it runs along its chord: the parameters' rates say little there.
    if (!segment.is_certified()) {
      const Vec3 chord = (segment.to - segment.from) / segment.t.width();
      for (int m = 1; m <= order; ++m) {
        const Vec3 d = m == 1 ? chord : Vec3(0);
        result.point.x.c[m] = d.x, result.point.y.c[m] = d.y, result.point.z.c[m] = d.z;
      }
    }
  }
  for (int i = 0; i < N; ++i) result.x[i].c[0] += segment.shift[i];
  return result;
}

// x(T) in x(m) + x'(T) (T - m), both narrowed in turn; x' and x'' solve the differentiated equations over the box.
template <int N>
typename ContourSolution<N>::Ranges ContourSolution<N>::over_segment(const ContourSegment<N>& segment,
                                                                     const Interval& t, int order) const {
  const ChordSystem<N> system(segment);
  const double middle = t.middle();
  const ParameterPoint<N> center = solve(segment, middle);
  const ParameterBox<N> all = segment.equations->domain();
  std::array<Jet<Interval, 2>, N> x;
  ParameterBox<N> box;
  for (int i = 0; i < N; ++i) {
    if (segment.is_certified()) {
      box[i] = segment.tube[i];
    } else {
      const double beside = 0.2 * std::abs(segment.end[i] - segment.begin[i]);
      box[i] = {std::min(segment.begin[i], segment.end[i]) - beside,
                std::max(segment.begin[i], segment.end[i]) + beside};
      box[i] = intersect(box[i], all[i]);
    }
  }
  root_search::Matrix<N> inverse;
  const bool regular = root_search::invert<N>(system.matrix(segment.equations->at(center)), inverse);
  bool solved = false;
  Triple<Jet<Interval, 2>> point;
  // |I - C A| for all matrices A of the system over the box.
  const auto error_over = [&] {
    const auto range = segment.equations->enclose(box);
    std::array<std::array<Interval, N>, N> a;
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < N - 1; ++k) a[k][i] = range.derivative[k][i];
      std::array<Jet<Interval, 2>, N> unit;
      for (int j = 0; j < N; ++j) unit[j] = Jet<Interval, 2>(box[j]);
      unit[i].c[1] = Interval(1);
      const auto moved = segment.equations->series(unit).point;
      a[N - 1][i] = Interval(system.along.x) * moved.x.c[1] + Interval(system.along.y) * moved.y.c[1] +
                    Interval(system.along.z) * moved.z.c[1];
    }
    root_search::Matrix<N> error{};
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        Interval e = i == j ? Interval(1) : Interval(0);
        for (int k = 0; k < N; ++k) e -= Interval(inverse[i][k]) * a[k][j];
        error[i][j] = magnitude(e);
      }
    return error;
  };
  // A tube may be much wider than the part of the curve: Krawczyk's operator, center + C e_N (t - middle) + (I - C A)
  // (box - center), proves that the solution does not leave a box about it for any t.
  const auto narrowed_tube = [&] {
    const ParameterBox<N> tube = box;
    std::array<double, N> least, reach;
    for (int i = 0; i < N; ++i) {
      least[i] = std::abs(inverse[i][N - 1]) * 0.5 * t.width() + 1e-14 * std::max(std::abs(center[i]), all[i].width());
      reach[i] = 1.5 * least[i];
    }
    for (int time = 0; time < kInflations; ++time) {
      for (int i = 0; i < N; ++i) box[i] = intersect(tube[i], {center[i] - reach[i], center[i] + reach[i]});
      const root_search::Matrix<N> error = error_over();
      bool holds = true;
      std::array<double, N> next = least;
      for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) next[i] += error[i][j] * reach[j];
        holds = holds && next[i] <= reach[i];
      }
      if (holds) return true;
      for (int i = 0; i < N; ++i) reach[i] = 1.25 * std::max(next[i], reach[i] / 1.25);
    }
    box = tube;
    return false;
  };
  // The solution of A y = b for all A of the system over the box: y in C b + [-1, 1] q / (1 - q) |C b|, q the norm of
  // I - C A.
  const auto derivative = [&](int m) {
    for (int i = 0; i < N; ++i) x[i].c[0] = box[i];
    std::array<Interval, N> b{};
    if (m == 1) {
      b[N - 1] = Interval(1);
    } else {
      for (int i = 0; i < N; ++i) x[i].c[2] = Interval(0);
      const auto series = segment.equations->series(x);
      for (int k = 0; k < N - 1; ++k) b[k] = -series.equations[k].c[m];
      b[N - 1] = -(Interval(system.along.x) * series.point.x.c[m] + Interval(system.along.y) * series.point.y.c[m] +
                   Interval(system.along.z) * series.point.z.c[m]);
    }
    const root_search::Matrix<N> error = error_over();
    std::array<Interval, N> y;
    for (int i = 0; i < N; ++i) {
      y[i] = Interval(0);
      for (int k = 0; k < N; ++k) y[i] += Interval(inverse[i][k]) * b[k];
    }
    // The norm with the best weights, those of the largest eigenvalue of the errors: powers of the matrix find them.
    std::array<double, N> scale;
    for (int i = 0; i < N; ++i) scale[i] = std::max(all[i].width(), 1e-300);
    for (int time = 0; time < kPowers; ++time) {
      std::array<double, N> next{};
      double largest = 0;
      for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) next[i] += error[i][j] * scale[j];
        largest = std::max(largest, next[i] / all[i].width());
      }
      if (!(largest > 0) || !std::isfinite(largest)) break;
      for (int i = 0; i < N; ++i) scale[i] = next[i] / largest + 1e-6 * all[i].width();
    }
    double q = 0, most = 0;
    for (int i = 0; i < N; ++i) {
      double row = 0;
      for (int j = 0; j < N; ++j) row += error[i][j] * scale[j] / scale[i];
      q = std::max(q, row * (1 + 1e-14));
      most = std::max(most, magnitude(y[i]) / scale[i]);
    }
    if (!(q < 0.95)) return false;
    std::array<double, N> reach;
    for (int i = 0; i < N; ++i) reach[i] = q / (1 - q) * most * (1 + 1e-14) * scale[i];
    // Where a weight is small that is far too much for the others: the solution stays within C b + (I - C A) times what
    // it is known to be.
    for (int time = 0; time < kNarrowings; ++time) {
      std::array<double, N> next{};
      for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) next[i] += error[i][j] * (magnitude(y[j]) + reach[j]);
        next[i] = std::min(reach[i], next[i] * (1 + 1e-14));
      }
      bool narrows = false;
      for (int i = 0; i < N; ++i) narrows = narrows || next[i] < 0.9 * reach[i];
      reach = next;
      if (!narrows) break;
    }
    for (int i = 0; i < N; ++i) x[i].c[m] = y[i] + Interval(-reach[i], reach[i]);
    return true;
  };
  bool narrowed = false;
  for (int time = 0; regular && time < kContractions; ++time) {
    if (!derivative(1)) {
      if (solved || narrowed || !segment.is_certified() || !narrowed_tube()) break;
      narrowed = true;
      continue;
    }
    solved = true;
    for (int i = 0; i < N; ++i) {
      const double slack = 1e-14 * std::max(std::abs(center[i]), all[i].width());
      const Interval closer =
          intersect(box[i], Interval(center[i] - slack, center[i] + slack) + x[i].c[1] * (t - Interval(middle)));
      if (!closer.empty()) box[i] = closer;
    }
    if (segment.is_certified() && time > 0 && t.width() > 0.5 * segment.t.width()) break;
  }
  if (solved) solved = derivative(1);
  if (solved && order >= 2) solved = derivative(2);
  Ranges result;
  if (!solved) {
    // As good as the chord: any direction within a right angle of it.
    for (int i = 0; i < N; ++i) {
      x[i].c[0] = box[i];
      const double rate = std::abs(segment.end[i] - segment.begin[i]) / std::max(segment.t.width(), 1e-300);
      x[i].c[1] = Interval(-2 * rate, 2 * rate);
      x[i].c[2] = Interval(0);
    }
  }
  for (int i = 0; i < N; ++i) x[i].c[0] = box[i];
  point = segment.equations->series(x).point;
  for (int i = 0; i < N; ++i)
    result.x[i] = {x[i].c[0] + Interval(segment.shift[i]), x[i].c[1], x[i].c[2] * Interval(2)};
  for (int k = 0; k <= 2; ++k) result.point[k] = box_of(point, k, factorial(k));
  return result;
}

template <int N>
const std::vector<typename ContourSolution<N>::Ranges>& ContourSolution<N>::over_whole_segments(int order) const {
  const size_t second = order >= 2 ? 1 : 0;
  std::call_once(asked_[second], [&] {
    for (const ContourSegment<N>& segment : segments_)
      over_whole_segments_[second].push_back(over_segment(segment, segment.t, order));
  });
  return over_whole_segments_[second];
}

template <int N>
typename ContourSolution<N>::Ranges ContourSolution<N>::over(const Interval& t, int order) const {
  Ranges all;
  bool first = true;
  for (const ContourSegment<N>& segment : segments_) {
    const Interval part = intersect(t, segment.t);
    // At a joint only one side counts: that which the interval reaches into, at a single place that to the right.
    if (part.empty() || (part.width() == 0 && t.width() > 0)) continue;
    if (t.width() == 0 && &segment != &segment_at(t.lo)) continue;
    const Ranges one = part == segment.t ? over_whole_segments(order)[static_cast<size_t>(&segment - segments_.data())]
                                         : over_segment(segment, part, order);
    if (first) {
      all = one, first = false;
      continue;
    }
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < 3; ++k) all.x[i][k] = hull(all.x[i][k], one.x[i][k]);
    for (int k = 0; k < 3; ++k) all.point[k].include(one.point[k]);
  }
  return all;
}

template class ContourSolution<2>;
template class ContourSolution<4>;

template <int N>
CurveJet ContourCurve<N>::evaluate(double t, int order) const {
  const Interval all = domain();
  const double beyond = solution_->is_closed() ? 0 : t - all.clamp(t);
  const auto series = solution_->at(t, std::max(order, beyond != 0 ? 1 : 0));
  CurveJet jet;
  jet.order = order;
  for (int k = 0; k <= order; ++k) jet.d[k] = factorial(k) * vector_of(series.point, k);
  if (beyond != 0) {
    jet.d[0] += beyond * vector_of(series.point, 1);
    for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  }
  return jet;
}

template <int N>
CurveEnclosure ContourCurve<N>::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  const auto ranges = solution_->over(t, order);
  for (int k = 0; k <= order; ++k) result.d[k] = ranges.point[k];
  return result;
}

template <int N>
std::vector<CurvePiece> ContourCurve<N>::pieces() const {
  return pieces_of(solution_->segments());
}

template <int N>
CurveJet ContourImage<N>::evaluate(double t, int order) const {
  const double beyond = t - domain().clamp(t);
  const auto series = solution_->at(domain().clamp(t), std::max(order, beyond != 0 ? 1 : 0));
  const auto part = [&](int k) { return factorial(k) * Vec3(series.x[first_].c[k], series.x[first_ + 1].c[k], 0); };
  CurveJet jet;
  jet.order = order;
  for (int k = 0; k <= order; ++k) jet.d[k] = part(k);
  if (beyond != 0) {
    jet.d[0] += beyond * part(1);
    for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  }
  return jet;
}

template <int N>
CurveEnclosure ContourImage<N>::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  const auto ranges = solution_->over(t, order);
  for (int k = 0; k <= order; ++k) {
    const Interval u = ranges.x[first_][k], v = ranges.x[first_ + 1][k];
    result.d[k] = {{u.lo, v.lo, 0}, {u.hi, v.hi, 0}};
  }
  return result;
}

template <int N>
std::vector<CurvePiece> ContourImage<N>::pieces() const {
  return pieces_of(solution_->segments());
}

template class ContourCurve<2>;
template class ContourCurve<4>;
template class ContourImage<2>;
template class ContourImage<4>;

}  // namespace lekalo::geometry
