// Roots by subdivision alone: boxes of parameters are halved and dropped where the convex hull of Bezier points, or
// Bernstein coefficients of one sign, exclude a root; no Newton, no interval arithmetic, no code of the library's
// queries.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::tests {

using geometry::Vec3;
using geometry::Vec4;

// A polynomial in Bernstein form over up to three parameters, each [0, 1], of D coordinates.
template <int D>
struct Bernstein {
  std::array<int, 3> degree{};  // 0 for parameters that it does not depend on
  std::vector<std::array<double, D>> c;

  size_t index(int i, int j, int k) const { return (size_t(i) * (degree[1] + 1) + j) * (degree[2] + 1) + k; }
  // The lower or upper half in one parameter (de Casteljau).
  Bernstein half(int axis, bool upper) const {
    Bernstein r = *this;
    const int n = degree[axis];
    const size_t stride = axis == 0 ? size_t(degree[1] + 1) * (degree[2] + 1) : axis == 1 ? degree[2] + 1 : 1;
    const size_t outer = c.size() / (stride * (n + 1));
    for (size_t o = 0; o < outer; ++o)
      for (size_t s = 0; s < stride; ++s) {
        const auto at = [&](int i) -> std::array<double, D>& { return r.c[o * stride * (n + 1) + i * stride + s]; };
        for (int level = 1; level <= n; ++level) {
          if (upper)
            for (int i = 0; i <= n - level; ++i)
              for (int d = 0; d < D; ++d) at(i)[d] = 0.5 * (at(i)[d] + at(i + 1)[d]);
          else
            for (int i = n; i >= level; --i)
              for (int d = 0; d < D; ++d) at(i)[d] = 0.5 * (at(i)[d] + at(i - 1)[d]);
        }
      }
    return r;
  }
};

inline double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

// The scalar product of two polynomials.
inline Bernstein<1> dot(const Bernstein<3>& a, const Bernstein<3>& b) {
  Bernstein<1> r;
  size_t count = 1;
  for (int k = 0; k < 3; ++k) r.degree[k] = a.degree[k] + b.degree[k], count *= r.degree[k] + 1;
  r.c.assign(count, {0});
  const auto each = [](const std::array<int, 3>& degree, auto&& visit) {
    for (int i = 0; i <= degree[0]; ++i)
      for (int j = 0; j <= degree[1]; ++j)
        for (int k = 0; k <= degree[2]; ++k) visit(std::array{i, j, k});
  };
  each(a.degree, [&](const std::array<int, 3>& i) {
    each(b.degree, [&](const std::array<int, 3>& j) {
      const auto &x = a.c[a.index(i[0], i[1], i[2])], &y = b.c[b.index(j[0], j[1], j[2])];
      double factor = 1;
      for (int k = 0; k < 3; ++k)
        factor *= binomial(a.degree[k], i[k]) * binomial(b.degree[k], j[k]) / binomial(r.degree[k], i[k] + j[k]);
      r.c[r.index(i[0] + j[0], i[1] + j[1], i[2] + j[2])][0] += factor * (x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
    });
  });
  return r;
}

inline Bernstein<3> derivative(const Bernstein<3>& a, int axis) {
  Bernstein<3> r;
  r.degree = a.degree;
  --r.degree[axis];
  r.c.resize(size_t(r.degree[0] + 1) * (r.degree[1] + 1) * (r.degree[2] + 1));
  for (int i = 0; i <= r.degree[0]; ++i)
    for (int j = 0; j <= r.degree[1]; ++j)
      for (int k = 0; k <= r.degree[2]; ++k)
        for (int d = 0; d < 3; ++d)
          r.c[r.index(i, j, k)][d] =
              a.degree[axis] *
              (a.c[a.index(i + (axis == 0), j + (axis == 1), k + (axis == 2))][d] - a.c[a.index(i, j, k)][d]);
  return r;
}

// Whether the polynomial may vanish, for all that its coefficients say.
inline bool changes_sign(const Bernstein<1>& f) {
  bool plus = false, minus = false;
  for (const auto& c : f.c) plus = plus || c[0] > -1e-14, minus = minus || c[0] < 1e-14;
  return plus && minus;
}

// Places of [0, 1]^N where `may_vanish` cannot be denied down to `smallest`, those nearer than 1000 of it as one.
// `unclear`: so many or so near to each other that their number tells nothing.
template <int N, class State>
std::vector<std::array<double, N>> roots_by_halving(const State& all, double smallest,
                                                    const std::function<bool(const State&)>& may_vanish,
                                                    const std::function<State(const State&, int, bool)>& half,
                                                    bool& unclear) {
  struct Box {
    State state;
    std::array<double, N> lo{}, width;
  };
  Box first{all};
  first.width.fill(1);
  std::vector<Box> stack{first};
  struct Cluster {
    std::array<double, N> lo, hi;
  };
  std::vector<Cluster> clusters;
  int leaves = 0;
  while (!stack.empty()) {
    const Box box = std::move(stack.back());
    stack.pop_back();
    if (!may_vanish(box.state)) continue;
    int axis = 0;
    for (int i = 1; i < N; ++i)
      if (box.width[i] > box.width[axis]) axis = i;
    if (box.width[axis] > smallest) {
      for (const bool upper : {false, true}) {
        Box part{half(box.state, axis, upper), box.lo, box.width};
        part.width[axis] *= 0.5;
        if (upper) part.lo[axis] += part.width[axis];
        stack.push_back(std::move(part));
      }
      continue;
    }
    if (++leaves > 20000) {
      unclear = true;
      return {};
    }
    Cluster one{box.lo, box.lo};
    for (int i = 0; i < N; ++i) one.hi[i] += box.width[i];
    for (size_t k = 0; k < clusters.size();) {
      bool near = true;
      for (int i = 0; i < N; ++i)
        near = near && clusters[k].lo[i] <= one.hi[i] + 1000 * smallest &&
               one.lo[i] <= clusters[k].hi[i] + 1000 * smallest;
      if (!near) {
        ++k;
        continue;
      }
      for (int i = 0; i < N; ++i) {
        one.lo[i] = std::min(one.lo[i], clusters[k].lo[i]);
        one.hi[i] = std::max(one.hi[i], clusters[k].hi[i]);
      }
      clusters[k] = clusters.back();
      clusters.pop_back();
      k = 0;
    }
    clusters.push_back(one);
  }
  std::vector<std::array<double, N>> result;
  for (const Cluster& one : clusters) {
    std::array<double, N> middle;
    for (int i = 0; i < N; ++i) {
      middle[i] = 0.5 * (one.lo[i] + one.hi[i]);
      // A tangency smears out; a border may hide the other half.
      if (one.hi[i] - one.lo[i] > 1000 * smallest || one.lo[i] < smallest || one.hi[i] > 1 - smallest) unclear = true;
    }
    result.push_back(middle);
  }
  return result;
}

}  // namespace lekalo::tests
