#include "geometry/tessellation/cloud_normals.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <queue>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Below this part of the largest one the second variance is nothing: the points lie on one line.
constexpr double kOneLine = 1e-10;

Vec3 normal_of_plane(std::span<const Vec3> points, int at, const std::vector<int>& neighbours) {
  Vec3 middle = points[at];
  for (const int i : neighbours) middle += points[i];
  middle /= static_cast<double>(neighbours.size() + 1);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const auto add = [&](const Vec3& p) {
    const Eigen::Vector3d d(p.x - middle.x, p.y - middle.y, p.z - middle.z);
    spread += d * d.transpose();
  };
  add(points[at]);
  for (const int i : neighbours) add(points[i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  if (!(axes.eigenvalues()[1] > kOneLine * axes.eigenvalues()[2]))
    throw std::invalid_argument(fmt::format("the neighbours of point {} at ({:.6g}, {:.6g}, {:.6g}) lie on one line",
                                            at, points[at].x, points[at].y, points[at].z));
  const Eigen::Vector3d n = axes.eigenvectors().col(0);
  return glm::normalize(Vec3(n.x(), n.y(), n.z()));
}

// Turns the normals of all points that a chain of neighbours reaches, along the pairs whose planes differ least.
void turn_alike(int from, const std::vector<std::vector<int>>& beside, std::vector<Vec3>& normals,
                std::vector<bool>& turned) {
  using Pair = std::pair<double, std::pair<int, int>>;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> waiting;
  const auto take = [&](int i) {
    turned[i] = true;
    for (const int j : beside[i])
      if (!turned[j]) waiting.push({1 - std::abs(glm::dot(normals[i], normals[j])), {i, j}});
  };
  take(from);
  while (!waiting.empty()) {
    const auto [i, j] = waiting.top().second;
    waiting.pop();
    if (turned[j]) continue;
    if (glm::dot(normals[i], normals[j]) < 0) normals[j] = -normals[j];
    take(j);
  }
}

}  // namespace

std::vector<std::vector<int>> nearest_neighbours(std::span<const Vec3> points, int k) {
  const int count = static_cast<int>(points.size()), most = std::min(k, count - 1);
  std::vector<std::vector<int>> result;
  std::vector<std::pair<double, int>> others;
  for (int i = 0; i < count; ++i) {
    others.clear();
    for (int j = 0; j < count; ++j) {
      const Vec3 d = points[j] - points[i];
      if (j != i) others.push_back({glm::dot(d, d), j});
    }
    std::partial_sort(others.begin(), others.begin() + most, others.end());
    result.emplace_back();
    for (int m = 0; m < most; ++m) result.back().push_back(others[m].second);
  }
  return result;
}

std::vector<Vec3> estimated_normals(std::span<const Vec3> points, const std::vector<std::vector<int>>& neighbours) {
  const int count = static_cast<int>(points.size());
  std::vector<Vec3> normals;
  std::vector<std::vector<int>> beside(points.size());
  std::vector<int> by_height;
  for (int i = 0; i < count; ++i) {
    normals.push_back(normal_of_plane(points, i, neighbours[i]));
    by_height.push_back(i);
    for (const int j : neighbours[i]) beside[i].push_back(j), beside[j].push_back(i);
  }
  std::stable_sort(by_height.begin(), by_height.end(), [&](int a, int b) { return points[a].z > points[b].z; });
  std::vector<bool> turned(points.size());
  for (const int top : by_height) {
    if (turned[top]) continue;
    if (normals[top].z < 0) normals[top] = -normals[top];
    turn_alike(top, beside, normals, turned);
  }
  return normals;
}

}  // namespace lekalo::geometry
