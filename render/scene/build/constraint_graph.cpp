#include "render/scene/build/constraint_graph.h"

#include <algorithm>
#include <set>

#include "geometry/constraints/decomposition.h"

namespace lekalo::render {

using namespace geometry;

namespace {

using Parts = std::vector<std::vector<std::string>>;

constexpr double kStill = 1e-7;  // of velocities, whose columns have length 1

bool lies_in_plane(const UnknownPoint& p) { return p.coordinates[0] >= 0 && p.coordinates[2] < 0; }

// Points that are one, by the lowest of them.
class Joined {
 public:
  explicit Joined(size_t count) : first_(count) {
    for (size_t k = 0; k < count; ++k) first_[k] = static_cast<int>(k);
  }
  int first(int k) const { return first_[k] == k ? k : first(first_[k]); }
  void join(int a, int b) { first_[std::max(first(a), first(b))] = std::min(first(a), first(b)); }

 private:
  std::vector<int> first_;
};

Parts parts_by_count(const std::vector<std::string>& names, const PlaneFramework& framework) {
  const auto number = [&](const std::string& name) {
    const auto found = std::lower_bound(names.begin(), names.end(), name);
    return found != names.end() && *found == name ? static_cast<int>(found - names.begin()) : -1;
  };
  Joined joined(names.size());
  for (const auto& [a, b] : framework.joined)
    if (number(a) >= 0 && number(b) >= 0) joined.join(number(a), number(b));
  std::vector<std::pair<int, int>> bars;
  // Points that stay keep their distances: each from two others is enough.
  std::vector<int> fixed;
  for (const std::string& name : framework.fixed)
    if (const int k = number(name); k >= 0) fixed.push_back(joined.first(k));
  for (size_t k = 1; k < fixed.size(); ++k)
    for (size_t j = 0; j < std::min<size_t>(k, 2); ++j) bars.emplace_back(fixed[j], fixed[k]);
  for (const auto& [a, b] : framework.bars)
    if (number(a) >= 0 && number(b) >= 0) bars.emplace_back(joined.first(number(a)), joined.first(number(b)));
  Parts parts;
  for (const std::vector<int>& part : rigid_parts(static_cast<int>(names.size()), bars)) {
    parts.emplace_back();
    for (size_t k = 0; k < names.size(); ++k)
      if (std::binary_search(part.begin(), part.end(), joined.first(static_cast<int>(k))))
        parts.back().push_back(names[k]);
  }
  return parts;
}

// Two points that keep their distance tell a motion of the plane for each allowed velocity; with them goes what has it.
class PartsByRank {
 public:
  PartsByRank(const std::vector<UnknownPoint>& points, const std::vector<double>& unknowns,
              const Eigen::MatrixXd& velocities)
      : points_(points), velocities_(velocities) {
    for (const UnknownPoint& p : points) places_.push_back(place_of(p, unknowns));
  }

  std::vector<std::vector<int>> found() const {
    const int n = static_cast<int>(points_.size());
    std::vector<std::vector<int>> parts;
    std::set<std::pair<int, int>> known;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        if (known.count({i, j}) > 0 || !keep_their_distance(i, j)) continue;
        std::vector<int> part;
        for (int k = 0; k < n; ++k)
          if (k == i || k == j || moves_with(i, j, k)) part.push_back(k);
        for (size_t a = 0; a < part.size(); ++a)
          for (size_t b = a + 1; b < part.size(); ++b) known.insert({part[a], part[b]});
        parts.push_back(std::move(part));
      }
    return parts;
  }

 private:
  Eigen::RowVectorXd velocity(int point, int axis) const { return velocities_.row(points_[point].coordinates[axis]); }
  bool keep_their_distance(int i, int j) const {
    const Vec3 d = places_[j] - places_[i];
    const double length = glm::length(d);
    if (!(length > 0)) return false;
    return (d.x * (velocity(j, 0) - velocity(i, 0)) + d.y * (velocity(j, 1) - velocity(i, 1))).norm() <=
           kStill * length;
  }
  bool moves_with(int i, int j, int k) const {
    const Vec3 d = places_[j] - places_[i], e = places_[k] - places_[i];
    const double square = d.x * d.x + d.y * d.y;
    const Eigen::RowVectorXd turn =
        (d.x * (velocity(j, 1) - velocity(i, 1)) - d.y * (velocity(j, 0) - velocity(i, 0))) / square;
    const Eigen::RowVectorXd x = velocity(k, 0) - velocity(i, 0) + e.y * turn;
    const Eigen::RowVectorXd y = velocity(k, 1) - velocity(i, 1) - e.x * turn;
    return std::max(x.norm(), y.norm()) <= kStill * (1 + glm::length(e) / std::sqrt(square));
  }

  const std::vector<UnknownPoint>& points_;
  const Eigen::MatrixXd& velocities_;
  std::vector<Vec3> places_;
};

}  // namespace

ConstraintGraph constraint_graph(const ConstraintSystem& system, const ConstraintSolution& solution,
                                 const std::vector<std::string>& unknowns,
                                 const std::map<std::string, UnknownPoint>& points, const PlaneFramework& framework,
                                 const Eigen::MatrixXd& velocities) {
  const Decomposition parts = decomposed(system);
  ConstraintGraph graph;
  graph.largest = parts.largest();
  graph.is_solved_by_blocks = solution.by_blocks;
  for (const int x : parts.unmatched) graph.unmatched.push_back(unknowns[static_cast<size_t>(x)]);
  for (const SystemBlock& block : parts.blocks) {
    ConstraintGraph::Block& named = graph.blocks.emplace_back();
    named.part = name_of(block.part);
    for (const int x : block.unknowns) named.unknowns.push_back(unknowns[static_cast<size_t>(x)]);
    for (const Equation& e : block.equations)
      if (const std::string& name = system.constraints[static_cast<size_t>(e.constraint)].name;
          named.conditions.empty() || named.conditions.back() != name)
        named.conditions.push_back(name);
  }
  std::vector<std::string> names;
  std::vector<UnknownPoint> in_plane;
  for (const auto& [name, point] : points)
    if (lies_in_plane(point)) names.push_back(name), in_plane.push_back(point);
  if (names.empty()) return graph;
  graph.rigid_by_count = parts_by_count(names, framework);
  for (const std::vector<int>& part : PartsByRank(in_plane, solution.unknowns, velocities).found()) {
    graph.rigid_by_rank.emplace_back();
    for (const int k : part) graph.rigid_by_rank.back().push_back(names[static_cast<size_t>(k)]);
  }
  return graph;
}

}  // namespace lekalo::render
