#include "geometry/curves/splines/weights.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/describe.h"

namespace lekalo::geometry {

std::vector<Vec4> homogeneous(std::span<const Vec3> points, std::span<const double> weights) {
  if (!weights.empty() && weights.size() != points.size())
    throw FieldError("weights", fmt::format("{} weights do not fit {} points", weights.size(), points.size()),
                     "give one weight for each point, or leave weights out for all ones");
  std::vector<Vec4> result;
  result.reserve(points.size());
  const bool equal = std::adjacent_find(weights.begin(), weights.end(), std::not_equal_to<>()) == weights.end();
  if (weights.empty() || (equal && weights[0] != 0)) {
    for (const Vec3& p : points) result.emplace_back(p, 1.0);
    return result;
  }
  const auto first = std::find_if(weights.begin(), weights.end(), [](double w) { return w != 0; });
  if (first == weights.end())
    throw FieldError("weights", "all weights are zero", "give at least one point another weight");
  const double sign = *first < 0 ? -1 : 1;
  for (size_t i = 0; i < points.size(); ++i) {
    const double w = sign * weights[i];
    result.emplace_back(w * points[i], w);
  }
  return result;
}

bool has_weights(std::span<const Vec4> points) {
  return std::any_of(points.begin(), points.end(), [](const Vec4& p) { return p.w != 1; });
}

bool all_weights_positive(std::span<const Vec4> points) {
  return std::all_of(points.begin(), points.end(), [](const Vec4& p) { return p.w > 0; });
}

namespace {

// de Casteljau at 1/2 along `count` rows of degree + 1 numbers with the given strides: b keeps the left half, the right
// half goes to right.
void halve(int degree, int stride, int count, int row_stride, std::vector<double>& b, std::vector<double>& right) {
  for (int row = 0; row < count; ++row) {
    double* x = b.data() + row * row_stride;
    double* y = right.data() + row * row_stride;
    // After level k, x[i] holds the point b_i^(k) for i >= k and the left half's points before it.
    std::vector<double> level(degree + 1);
    for (int i = 0; i <= degree; ++i) level[i] = x[i * stride];
    for (int k = 0; k <= degree; ++k) {
      x[k * stride] = level[0];
      y[(degree - k) * stride] = level[degree - k];
      for (int i = 0; i + k < degree; ++i) level[i] = 0.5 * (level[i] + level[i + 1]);
    }
  }
}

bool positive(int p, int q, std::vector<double> b, int depth) {
  if (std::all_of(b.begin(), b.end(), [](double x) { return x > 0; })) return true;
  const size_t last = b.size() - 1;
  for (const size_t corner : {size_t(0), size_t(q), last - q, last})
    if (!(b[corner] > 0)) return false;
  if (depth == 0) return false;
  std::vector<double> right(b.size());
  if (q == 0 || (p > 0 && depth % 2 == 0))
    halve(p, q + 1, q + 1, 1, b, right);
  else
    halve(q, 1, p + 1, q + 1, b, right);
  return positive(p, q, std::move(b), depth - 1) && positive(p, q, std::move(right), depth - 1);
}

}  // namespace

bool denominator_positive(int degree_u, int degree_v, std::span<const Vec4> points) {
  constexpr int kDepth = 24;
  std::vector<double> weights;
  for (const Vec4& p : points) weights.push_back(p.w);
  return positive(degree_u, degree_v, std::move(weights), kDepth);
}

}  // namespace lekalo::geometry
