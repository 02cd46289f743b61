// Parameters of inner points (Floater 2003): sum_j w_ij (q_j - q_i) = 0 over the neighbours j of i,
//
//   w_ij = (tan(a/2) + tan(b/2)) / |p_j - p_i|
//
// with the angles a, b at p_i beside the side to p_j.
#include "geometry/bodies/triangulations/flattening.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

double half_tangent(const Vec3& a, const Vec3& b) {
  const double sine = glm::length(glm::cross(a, b)), length = glm::length(a) * glm::length(b);
  return sine > 0 ? (length - glm::dot(a, b)) / sine : 0;
}

// Shares of the way round, of points of the border from one to another (the last point excluded).
std::vector<double> shares(std::span<const Vec3> points, const std::vector<int>& border, size_t from, size_t to) {
  std::vector<double> at{0};
  const size_t n = border.size();
  for (size_t k = from; k != to || at.size() == 1; k = (k + 1) % n)
    at.push_back(at.back() + glm::length(points[border[(k + 1) % n]] - points[border[k]]));
  const double all = at.back();
  at.pop_back();
  for (double& s : at) s /= all;
  return at;
}

}  // namespace

std::vector<int> border_of_sheet(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles) {
  std::set<std::pair<int, int>> sides;
  std::set<int> used;
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) sides.insert({t[k], t[(k + 1) % 3]}), used.insert(t[k]);
  if (used.size() != points.size()) throw std::invalid_argument("some points belong to no triangle");
  std::map<int, int> next;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) next[a] = b;
  if (next.empty()) throw std::invalid_argument("the surface is closed: it has no border to lay round a circle");
  std::vector<int> border{next.begin()->first};
  for (int at = next.at(border[0]); at != border[0]; at = next.at(at)) border.push_back(at);
  const auto edges = static_cast<std::ptrdiff_t>((sides.size() + next.size()) / 2);
  const auto euler = static_cast<std::ptrdiff_t>(points.size() + triangles.size()) - edges;
  if (border.size() != next.size() || euler != 1)
    throw std::invalid_argument("the surface is no sheet with one border and no holes");
  return border;
}

std::vector<Vec2> flattened(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles,
                            const std::vector<int>& border, const std::vector<Vec2>& border_uv) {
  std::vector<Vec2> uv(points.size(), Vec2(0));
  std::vector<int> rows(points.size(), 0);
  for (size_t k = 0; k < border.size(); ++k) uv[border[k]] = border_uv[k], rows[border[k]] = -1;
  int count = 0;
  for (int& row : rows)
    if (row == 0) row = count++;
  if (count == 0) return uv;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
  for (const IndexTriangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      const int i = t[k], row = rows[i];
      if (row < 0) continue;
      const Vec3 a = points[t[(k + 1) % 3]] - points[i], b = points[t[(k + 2) % 3]] - points[i];
      const double tangent = half_tangent(a, b);
      for (const auto& [j, length] :
           {std::pair(t[(k + 1) % 3], glm::length(a)), std::pair(t[(k + 2) % 3], glm::length(b))}) {
        const double weight = tangent / length;
        entries.emplace_back(row, row, weight);
        if (rows[j] >= 0)
          entries.emplace_back(row, rows[j], -weight);
        else
          right.row(row) += weight * Eigen::RowVector2d(uv[j].x, uv[j].y);
      }
    }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) throw std::invalid_argument("some triangles have no area");
  const Eigen::MatrixX2d solution = factors.solve(right);
  for (size_t i = 0; i < points.size(); ++i)
    if (rows[i] >= 0) uv[i] = {solution(rows[i], 0), solution(rows[i], 1)};
  return uv;
}

std::vector<Vec2> flattened_to_circle(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles) {
  const std::vector<int> border = border_of_sheet(points, triangles);
  std::vector<Vec2> uv;
  for (const double s : shares(points, border, 0, 0)) uv.emplace_back(std::cos(2 * kPi * s), std::sin(2 * kPi * s));
  return flattened(points, triangles, border, uv);
}

std::vector<Vec2> flattened_to_square(std::span<const Vec3> points, const std::vector<IndexTriangle>& triangles,
                                      const std::vector<int>& border, const std::array<size_t, 4>& corners) {
  constexpr double kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Vec2> uv(border.size());
  for (size_t k = 0; k < 4; ++k) {
    const Vec2 from(kCorner[k][0], kCorner[k][1]), to(kCorner[(k + 1) % 4][0], kCorner[(k + 1) % 4][1]);
    size_t at = corners[k];
    for (const double s : shares(points, border, corners[k], corners[(k + 1) % 4])) {
      uv[at] = (1 - s) * from + s * to;
      at = (at + 1) % border.size();
    }
  }
  return flattened(points, triangles, border, uv);
}

}  // namespace lekalo::geometry
