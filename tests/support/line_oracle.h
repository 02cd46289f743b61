// The ray oracle: all meetings of a line with a rational Bezier patch, found by halving alone.
//
// It shares nothing with the product's solver. The two plane equations of the line are put in Bernstein form over the
// patch; a rectangle is discarded only if all coefficients of one of them have one strict sign; rectangles narrower
// than 1e-11 that remain are gathered into clusters, and each cluster is a root. No Newton iteration, no derivative.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::oracle {

using geometry::Line;
using geometry::Vec3;
using geometry::Vec4;

struct Root {
  double t, s_u, s_v;  // along the line; parameters of the patch in [0, 1]
};

class PatchOracle {
 public:
  // Control point (i, j) at points[i * (degree_v + 1) + j].
  PatchOracle(std::vector<Vec4> points, int degree_u, int degree_v)
      : points_(std::move(points)), p_(degree_u), q_(degree_v) {}

  std::vector<Root> roots(const Line& line) const {
    Vec3 across = std::abs(line.direction.x) < 0.6 * glm::length(line.direction) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 n1 = glm::normalize(glm::cross(line.direction, across));
    const Vec3 n2 = glm::normalize(glm::cross(line.direction, n1));
    Net net;
    net.f.resize(points_.size());
    net.g.resize(points_.size());
    for (size_t k = 0; k < points_.size(); ++k) {
      const Vec3 r = Vec3(points_[k]) - points_[k].w * line.origin;
      net.f[k] = glm::dot(n1, r);
      net.g[k] = glm::dot(n2, r);
    }
    std::vector<std::array<double, 4>> cells;  // u, v of the middle, half widths
    halve(net, 0.5, 0.5, 0.5, 0.5, cells);
    return cluster(cells, line);
  }

  // Point of the patch by de Casteljau's algorithm.
  Vec3 point(double u, double v) const {
    std::vector<Vec4> row(p_ + 1);
    for (int i = 0; i <= p_; ++i)
      row[i] = casteljau({points_.begin() + i * (q_ + 1), points_.begin() + (i + 1) * (q_ + 1)}, v);
    const Vec4 h = casteljau(row, u);
    return Vec3(h) / h.w;
  }

 private:
  struct Net {
    std::vector<double> f, g;
  };

  static bool one_sign(const std::vector<double>& c) {
    double lo = c[0], hi = c[0];
    for (double x : c) lo = std::min(lo, x), hi = std::max(hi, x);
    return lo > 0 || hi < 0;
  }

  // Largest step of the two coefficients between neighbours in one direction, times the number of steps.
  double extent(const Net& net, bool along_u) const {
    double largest = 0;
    for (int i = 0; i <= p_; ++i)
      for (int j = 0; j <= q_; ++j) {
        if (along_u ? i == p_ : j == q_) continue;
        const int k = i * (q_ + 1) + j, next = along_u ? k + q_ + 1 : k + 1;
        largest = std::max({largest, std::abs(net.f[next] - net.f[k]), std::abs(net.g[next] - net.g[k])});
      }
    return largest * (along_u ? p_ : q_);
  }

  void split(const std::vector<double>& c, bool along_u, std::vector<double>& a, std::vector<double>& b) const {
    a.resize(c.size());
    b.resize(c.size());
    const int n = along_u ? p_ : q_, rows = along_u ? q_ + 1 : p_ + 1, stride = along_u ? q_ + 1 : 1;
    for (int r = 0; r < rows; ++r) {
      const int base = along_u ? r : r * (q_ + 1);
      double work[32];
      for (int i = 0; i <= n; ++i) work[i] = c[base + i * stride];
      for (int k = 0; k <= n; ++k) {
        a[base + k * stride] = work[0];
        b[base + (n - k) * stride] = work[n - k];
        for (int i = 0; i < n - k; ++i) work[i] = (work[i] + work[i + 1]) / 2;
      }
    }
  }

  void halve(const Net& net, double u, double v, double hu, double hv, std::vector<std::array<double, 4>>& out) const {
    if (one_sign(net.f) || one_sign(net.g)) return;
    if (hu < 5e-12 && hv < 5e-12) {
      if (out.size() < 4096) out.push_back({u, v, hu, hv});
      return;
    }
    // Across the longer side in space: near a collapsed edge one direction is far shorter than the other.
    const bool along_u = hv < 5e-12 || (hu >= 5e-12 && extent(net, true) >= extent(net, false));
    Net a, b;
    split(net.f, along_u, a.f, b.f);
    split(net.g, along_u, a.g, b.g);
    const double du = along_u ? hu / 2 : 0, dv = along_u ? 0 : hv / 2;
    halve(a, u - du, v - dv, along_u ? hu / 2 : hu, along_u ? hv : hv / 2, out);
    halve(b, u + du, v + dv, along_u ? hu / 2 : hu, along_u ? hv : hv / 2, out);
  }

  std::vector<Root> cluster(const std::vector<std::array<double, 4>>& cells, const Line& line) const {
    std::vector<int> group(cells.size());
    for (size_t i = 0; i < cells.size(); ++i) group[i] = static_cast<int>(i);
    const auto find = [&](int i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    for (size_t i = 0; i < cells.size(); ++i)
      for (size_t j = i + 1; j < cells.size(); ++j)
        if (std::abs(cells[i][0] - cells[j][0]) < 1e-9 && std::abs(cells[i][1] - cells[j][1]) < 1e-9)
          group[find(static_cast<int>(i))] = find(static_cast<int>(j));
    std::vector<Root> roots;
    for (size_t i = 0; i < cells.size(); ++i) {
      if (find(static_cast<int>(i)) != static_cast<int>(i)) continue;
      double u = 0, v = 0, n = 0;
      for (size_t j = 0; j < cells.size(); ++j)
        if (find(static_cast<int>(j)) == static_cast<int>(i)) u += cells[j][0], v += cells[j][1], n += 1;
      u /= n;
      v /= n;
      const Vec3 x = point(u, v);
      roots.push_back({glm::dot(x - line.origin, line.direction) / glm::dot(line.direction, line.direction), u, v});
    }
    std::sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) { return a.t < b.t; });
    return roots;
  }

  static Vec4 casteljau(std::vector<Vec4> c, double t) {
    for (size_t k = c.size() - 1; k > 0; --k)
      for (size_t i = 0; i < k; ++i) c[i] = (1 - t) * c[i] + t * c[i + 1];
    return c[0];
  }

  std::vector<Vec4> points_;
  int p_, q_;
};

}  // namespace lekalo::oracle
