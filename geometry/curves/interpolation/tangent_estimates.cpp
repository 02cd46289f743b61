#include "geometry/curves/interpolation/tangent_estimates.h"

#include <Eigen/SparseLU>
#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

std::pair<int, int> PointSequence::turn(int i) const {
  if (!closed) return {0, i};
  const int turns = i >= 0 ? i / size() : -((size() - 1 - i) / size());
  return {turns, i - turns * size()};
}

double PointSequence::parameter(int i) const {
  const auto [turns, number] = turn(i);
  return closed ? parameters[number] + turns * (parameters.back() - parameters.front()) : parameters[number];
}

namespace {

Vec3 unit(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : Vec3(0);
}

// Derivative at node m of the polynomial through nodes first .. first + count - 1 (Lagrange's form, differentiated).
Vec3 polynomial_tangent(const PointSequence& data, int m, int first, int count) {
  Vec3 sum(0);
  for (int j = first; j < first + count; ++j) {
    if (j == m) continue;
    double weight = 1 / (data.parameter(j) - data.parameter(m));
    for (int l = first; l < first + count; ++l)
      if (l != j && l != m) weight *= (data.parameter(m) - data.parameter(l)) / (data.parameter(j) - data.parameter(l));
    sum += weight * (data.point(j) - data.point(m));
  }
  return sum;
}

std::vector<Vec3> polynomial_tangents(const PointSequence& data, int count) {
  count = std::min(count, data.size());
  std::vector<Vec3> tangents;
  for (int i = 0; i < data.size(); ++i) {
    int first = i - (count - 1) / 2;
    if (!data.closed) first = std::clamp(first, 0, data.size() - count);
    tangents.push_back(polynomial_tangent(data, i, first, count));
  }
  return tangents;
}

// r'' = 0 at the ends: q_0 = (3 d_0 - q_1) / 2 with the slope d_0.
std::vector<Vec3> bessel_tangents(const PointSequence& data) {
  std::vector<Vec3> tangents = polynomial_tangents(data, 3);
  const int last = data.size() - 1;
  if (data.closed || last < 2) return tangents;
  tangents[0] = 0.5 * (3.0 * data.slope(0) - tangents[1]);
  tangents[last] = 0.5 * (3.0 * data.slope(last - 1) - tangents[last - 1]);
  return tangents;
}

std::vector<Vec3> secant_tangents(const PointSequence& data) {
  std::vector<Vec3> tangents;
  for (int i = 0; i < data.size(); ++i) {
    const int before = data.closed ? i - 1 : std::max(i - 1, 0);
    const int after = data.closed ? i + 1 : std::min(i + 1, data.size() - 1);
    tangents.push_back((data.point(after) - data.point(before)) / (data.parameter(after) - data.parameter(before)));
  }
  return tangents;
}

// Slopes of the spans -2 .. n: beyond the ends of an open curve they go on linearly.
std::vector<Vec3> extended_slopes(const PointSequence& data) {
  const int last = data.size() - 2;  // span
  std::vector<Vec3> slopes;
  if (data.closed || last == 0) {
    for (int i = -2; i <= data.size(); ++i) slopes.push_back(data.slope(data.closed ? i : 0));
    return slopes;
  }
  const auto beyond = [&](int end, int towards, int by) {
    return data.slope(end) + double(by) * (data.slope(end) - data.slope(towards));
  };
  for (int i = -2; i < 0; ++i) slopes.push_back(beyond(0, 1, -i));
  for (int i = 0; i <= last; ++i) slopes.push_back(data.slope(i));
  for (int i = 1; i <= 2; ++i) slopes.push_back(beyond(last, last - 1, i));
  return slopes;
}

std::vector<Vec3> akima_tangents(const PointSequence& data) {
  const std::vector<Vec3> slopes = extended_slopes(data);
  std::vector<Vec3> tangents;
  for (int i = 0; i < data.size(); ++i) {
    Vec3 tangent(0);
    for (int k = 0; k < 3; ++k) {
      const double before = slopes[i + 1][k], after = slopes[i + 2][k];
      const double turn_after = std::abs(slopes[i + 3][k] - after), turn_before = std::abs(before - slopes[i][k]);
      const double sum = turn_before + turn_after;
      // Where both sides are straight to rounding, their mean.
      const double size = std::abs(before) + std::abs(after);
      tangent[k] = sum > 1e-14 * size ? (turn_after * before + turn_before * after) / sum : 0.5 * (before + after);
    }
    tangents.push_back(tangent);
  }
  return tangents;
}

// The harmonic mean of Fritsch and Butland (1984), and 0 at a turn of the data.
double monotone_slope(double before, double after, double step_before, double step_after) {
  if (!(before * after > 0)) return 0;
  const double a = 2 * step_after + step_before, b = step_after + 2 * step_before;
  return (a + b) / (a / before + b / after);
}

// At an end: the parabola's, unless it would leave the data.
double monotone_end(double slope, double next, double step, double next_step) {
  const double d = ((2 * step + next_step) * slope - step * next) / (step + next_step);
  if (!(d * slope > 0)) return 0;
  if (!(slope * next > 0) && std::abs(d) > 3 * std::abs(slope)) return 3 * slope;
  return d;
}

std::vector<Vec3> monotone_tangents(const PointSequence& data) {
  const int last = data.size() - 1;
  std::vector<Vec3> tangents(data.size(), data.slope(0));
  if (last == 1) return tangents;
  for (int i = 0; i <= last; ++i)
    for (int k = 0; k < 3; ++k) {
      double& d = tangents[i][k];
      if (data.closed || (i > 0 && i < last))
        d = monotone_slope(data.slope(i - 1)[k], data.slope(i)[k], data.step(i - 1), data.step(i));
      else if (i == 0)
        d = monotone_end(data.slope(0)[k], data.slope(1)[k], data.step(0), data.step(1));
      else
        d = monotone_end(data.slope(i - 1)[k], data.slope(i - 2)[k], data.step(i - 1), data.step(i - 2));
    }
  return tangents;
}

Vec3 circle_direction(const PointSequence& data, int i) {
  const int last = data.size() - 1;
  if (data.closed || (i > 0 && i < last)) {
    const Vec3 a = data.chord(i - 1), b = data.chord(i);
    return unit(glm::dot(b, b) * a + glm::dot(a, a) * b);
  }
  if (last == 1) return unit(data.chord(0));
  const Vec3 near = data.chord(i == 0 ? 0 : i - 1), far = data.chord(i == 0 ? 1 : i - 2), all = near + far;
  return unit((glm::dot(all, all) - glm::dot(near, near)) * near - glm::dot(near, near) * far);
}

// Curvature of the circle through the points i - 1, i, i + 1; at the ends of an open curve of the next one.
double circle_curvature(const PointSequence& data, int i) {
  if (!data.closed) i = std::clamp(i, 1, data.size() - 2);
  const Vec3 a = data.chord(i - 1), b = data.chord(i);
  return 2 * glm::length(glm::cross(unit(a), unit(b))) / glm::length(a + b);
}

// Each of the chords beside weighs by the curvature on the other side of it.
Vec3 five_point_direction(const PointSequence& data, int i) {
  const int last = data.size() - 1;
  if (!data.closed && (i == 0 || i == last)) return circle_direction(data, i);
  const Vec3 a = data.chord(i - 1), b = data.chord(i);
  const double before = circle_curvature(data, i - 1), after = circle_curvature(data, i + 1);
  const Vec3 sum = glm::dot(b, b) * after * a + glm::dot(a, a) * before * b;
  return sum == Vec3(0) ? circle_direction(data, i) : unit(sum);
}

std::vector<Vec3> circle_tangents(const PointSequence& data, bool five_points) {
  const std::vector<double> speeds = local_speeds(data);
  std::vector<Vec3> tangents;
  for (int i = 0; i < data.size(); ++i)
    tangents.push_back(speeds[i] * (five_points ? five_point_direction(data, i) : circle_direction(data, i)));
  return tangents;
}

}  // namespace

std::vector<std::string> tangent_estimates() {
  return {"bessel", "two_point", "three_point", "four_point", "five_point",
          "secant", "akima",     "monotone",    "circle",     "five_point_circle"};
}

std::vector<Vec3> estimated_tangents(const std::string& estimate, const PointSequence& data) {
  if (estimate == "bessel") return bessel_tangents(data);
  if (estimate == "two_point") return polynomial_tangents(data, 2);
  if (estimate == "three_point") return polynomial_tangents(data, 3);
  if (estimate == "four_point") return polynomial_tangents(data, 4);
  if (estimate == "five_point") return polynomial_tangents(data, 5);
  if (estimate == "secant") return secant_tangents(data);
  if (estimate == "akima") return akima_tangents(data);
  if (estimate == "monotone") return monotone_tangents(data);
  if (estimate == "circle") return circle_tangents(data, false);
  if (estimate == "five_point_circle") return circle_tangents(data, data.size() > 3 || data.closed);
  throw std::logic_error("no estimate of tangents is called '" + estimate + "'");
}

std::vector<double> local_speeds(const PointSequence& data) {
  const int last = data.size() - 1;
  const auto slope = [&](int i) { return glm::length(data.chord(i)) / data.step(i); };
  std::vector<double> speeds;
  for (int i = 0; i <= last; ++i) {
    const int a = data.closed ? i - 1 : std::clamp(i - 1, 0, std::max(0, last - 2)), b = a + 1;
    if (!data.closed && last == 1) {
      speeds.push_back(slope(0));
      continue;
    }
    const double whole = data.step(a) + data.step(b);
    const double mu = data.step(a) / whole, lambda = data.step(b) / whole;
    if (data.closed || (i > 0 && i < last))
      speeds.push_back(lambda * slope(a) + mu * slope(b));
    else if (i == 0)
      speeds.push_back((1 + mu) * slope(a) - mu * slope(b));
    else
      speeds.push_back(-lambda * slope(a) + (1 + lambda) * slope(b));
  }
  return speeds;
}

// Each span adds 4/h (g0^2 + g0 g1 T0.T1 + g1^2) - 12/h^2 (g0 c.T0 + g1 c.T1) with its chord c and step h.
std::vector<double> min_energy_speeds(const PointSequence& data, std::span<const Vec3> directions) {
  const int count = data.size(), spans = data.closed ? count : count - 1;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (int i = 0; i < spans; ++i) {
    const int next = (i + 1) % count;
    const double h = data.step(i), both = glm::dot(directions[i], directions[next]) / h;
    for (const int end : {i, next}) {
      entries.emplace_back(end, end, 2 / h);
      right[end] += 3 / (h * h) * glm::dot(data.chord(i), directions[end]);
    }
    entries.emplace_back(i, next, both);
    entries.emplace_back(next, i, both);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::VectorXd speeds = factors.solve(right);
  return {speeds.begin(), speeds.end()};
}

}  // namespace lekalo::geometry
