// The curves f = 0 of a polynomial over the unit square, counted on a grid: squares are dropped where all Bernstein
// coefficients have one sign; the others must be monotone in one parameter, so that what the corners' signs say of them
// is the truth. And the common zeros of several polynomials, by halving. No Newton, no interval arithmetic, no code of
// the library's queries.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace lekalo::tests {

// Degrees n by m; coefficient (i, j) at c[i * (m + 1) + j].
struct BernsteinSquare {
  int n = 0, m = 0;
  std::vector<long double> c;

  long double& at(int i, int j) { return c[i * (m + 1) + j]; }
  long double at(int i, int j) const { return c[i * (m + 1) + j]; }
  static long double binomial(int n, int k) {
    long double result = 1;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
  }
  friend BernsteinSquare operator*(const BernsteinSquare& a, const BernsteinSquare& b) {
    BernsteinSquare r{a.n + b.n, a.m + b.m, {}};
    r.c.assign((r.n + 1) * (r.m + 1), 0);
    for (int i = 0; i <= a.n; ++i)
      for (int j = 0; j <= a.m; ++j)
        for (int k = 0; k <= b.n; ++k)
          for (int l = 0; l <= b.m; ++l)
            r.at(i + k, j + l) += a.at(i, j) * b.at(k, l) * binomial(a.n, i) * binomial(b.n, k) * binomial(a.m, j) *
                                  binomial(b.m, l) / (binomial(r.n, i + k) * binomial(r.m, j + l));
    return r;
  }
  friend BernsteinSquare operator*(long double s, BernsteinSquare a) {
    for (long double& x : a.c) x *= s;
    return a;
  }
  // Of equal degrees.
  friend BernsteinSquare operator+(BernsteinSquare a, const BernsteinSquare& b) {
    for (size_t k = 0; k < a.c.size(); ++k) a.c[k] += b.c[k];
    return a;
  }
  friend BernsteinSquare operator-(const BernsteinSquare& a, const BernsteinSquare& b) { return a + -1.0 * b; }

  BernsteinSquare by_u() const {
    BernsteinSquare r{n - 1, m, {}};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= m; ++j) r.c.push_back(n * (at(i + 1, j) - at(i, j)));
    return r;
  }
  BernsteinSquare by_v() const {
    BernsteinSquare r{n, m - 1, {}};
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < m; ++j) r.c.push_back(m * (at(i, j + 1) - at(i, j)));
    return r;
  }
  BernsteinSquare half(bool of_u, bool upper) const {
    BernsteinSquare r = *this;
    const int degree = of_u ? n : m, lines = of_u ? m : n;
    for (int line = 0; line <= lines; ++line) {
      const auto x = [&](int k) -> long double& { return of_u ? r.at(k, line) : r.at(line, k); };
      for (int level = 1; level <= degree; ++level)
        if (upper)
          for (int k = 0; k <= degree - level; ++k) x(k) = 0.5L * (x(k) + x(k + 1));
        else
          for (int k = degree; k >= level; --k) x(k) = 0.5L * (x(k - 1) + x(k));
    }
    return r;
  }
  bool has_one_sign() const {
    bool positive = true, negative = true;
    for (const long double x : c) positive = positive && x > 0, negative = negative && x < 0;
    return positive || negative;
  }
};

struct LevelCurves {
  int loops = 0, open = 0;
  bool unclear = false;  // a square that tells nothing: a singular point, or curves too near to each other
};

class LevelGrid {
 public:
  // 2^depth squares in each direction.
  static LevelCurves count(const BernsteinSquare& f, int depth) {
    LevelGrid grid(depth);
    grid.visit(f, 0, 0, depth);
    return grid.result();
  }

 private:
  explicit LevelGrid(int depth) : side_(1 << depth) {}

  void visit(const BernsteinSquare& f, int i, int j, int depth) {
    if (f.has_one_sign()) return;
    if (depth == 0) return leaf(f, i, j);
    for (const bool right : {false, true}) {
      const BernsteinSquare part = f.half(true, right);
      for (const bool above : {false, true}) visit(part.half(false, above), 2 * i + right, 2 * j + above, depth - 1);
    }
  }

  void leaf(const BernsteinSquare& f, int i, int j) {
    const long double a = f.at(0, 0), b = f.at(f.n, 0), c = f.at(0, f.m), d = f.at(f.n, f.m);
    std::vector<int> crossed;
    if ((a > 0) != (b > 0)) crossed.push_back(edge(true, i, j));
    if ((c > 0) != (d > 0)) crossed.push_back(edge(true, i, j + 1));
    if ((a > 0) != (c > 0)) crossed.push_back(edge(false, i, j));
    if ((b > 0) != (d > 0)) crossed.push_back(edge(false, i + 1, j));
    if (!f.by_u().has_one_sign() && !f.by_v().has_one_sign()) unclear_ = true;
    if (crossed.size() == 4) unclear_ = true;
    if (crossed.size() != 2) return;
    // A border that is touched or crossed twice within one square.
    parent_[root(crossed[0])] = root(crossed[1]);
  }

  int edge(bool along_u, int i, int j) {
    const int key = 2 * (i * (side_ + 1) + j) + (along_u ? 1 : 0);
    if (!parent_.count(key)) {
      parent_[key] = key;
      if (along_u ? j == 0 || j == side_ : i == 0 || i == side_) border_.push_back(key);
    }
    return key;
  }
  int root(int key) {
    while (parent_[key] != key) key = parent_[key] = parent_[parent_[key]];
    return key;
  }

  LevelCurves result() {
    std::map<int, int> ends;
    for (const auto& [key, ignored] : parent_) ends[root(key)] += 0;
    for (const int key : border_) ++ends[root(key)];
    LevelCurves found;
    found.unclear = unclear_;
    for (const auto& [key, count] : ends) {
      if (count == 0) ++found.loops;
      found.open += count / 2;
      if (count % 2) found.unclear = true;
    }
    return found;
  }

  int side_;
  bool unclear_ = false;
  std::map<int, int> parent_;
  std::vector<int> border_;
};

// Where all polynomials are zero: middles of what halving leaves of the square, 2^-depth wide, one for all that are no
// farther than `apart` from each other (where the curves hardly cross, what is left is long, and torn up by rounding).
inline std::vector<std::array<double, 2>> common_zeros(const std::vector<BernsteinSquare>& f, int depth, double apart) {
  const auto gap = std::lround(std::ldexp(apart, depth));
  struct Square {
    std::vector<BernsteinSquare> f;
    long i, j;
  };
  const auto may_vanish = [](const std::vector<BernsteinSquare>& all) {
    return std::none_of(all.begin(), all.end(), [](const BernsteinSquare& one) { return one.has_one_sign(); });
  };
  std::vector<Square> level{{f, 0, 0}};
  for (int k = 0; k < depth; ++k) {
    std::vector<Square> next;
    for (const Square& square : level)
      for (const bool right : {false, true})
        for (const bool above : {false, true}) {
          Square part{{}, 2 * square.i + right, 2 * square.j + above};
          for (const BernsteinSquare& one : square.f) part.f.push_back(one.half(true, right).half(false, above));
          if (may_vanish(part.f)) next.push_back(std::move(part));
        }
    level.swap(next);
  }
  std::vector<std::array<double, 2>> zeros;
  std::vector<bool> taken(level.size(), false);
  for (size_t first = 0; first < level.size(); ++first) {
    if (taken[first]) continue;
    std::vector<size_t> cluster{first};
    taken[first] = true;
    double u = 0, v = 0;
    for (size_t k = 0; k < cluster.size(); ++k) {
      const Square& one = level[cluster[k]];
      u += one.i + 0.5, v += one.j + 0.5;
      for (size_t other = 0; other < level.size(); ++other)
        if (!taken[other] && std::abs(level[other].i - one.i) <= gap && std::abs(level[other].j - one.j) <= gap)
          taken[other] = true, cluster.push_back(other);
    }
    const double scale = std::ldexp(1.0, -depth) / static_cast<double>(cluster.size());
    zeros.push_back({scale * u, scale * v});
  }
  return zeros;
}

}  // namespace lekalo::tests
