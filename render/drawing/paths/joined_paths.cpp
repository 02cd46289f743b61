#include "render/drawing/paths/joined_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lekalo::render {

namespace {

constexpr double kSamePlace = 1e-3;  // in the units of the paths, millimetres
constexpr double kSmooth = 1e-2;     // radians: what goes on so straight is one line

// One end of one path.
struct End {
  int path;
  bool last;  // where it ends, not where it begins
  Vec2 place;
  Vec3 point;
  Vec2 way;   // unit, out of the path; zero where there is none
  int other;  // number of the end that it is joined to; -1: of none
};

// The direction in which a path arrives at its end.
Vec2 way_out(const Path& path) {
  const PathStep& step = path.steps.back();
  const Vec2 begin = path.steps.size() > 1 ? path.steps[path.steps.size() - 2].to : path.from;
  for (const double back : {1e-3, 0.1, 1.0}) {
    const Vec2 way = step.to - point_on(begin, step, 1 - back);
    if (const double length = glm::length(way); length > 1e-9) return way / length;
  }
  return {};
}

class Joining {
 public:
  Joining(const std::vector<PathInSpace>& paths, double same) : paths_(paths), same_(same) {
    of_path_.assign(paths.size(), {-1, -1});
    for (size_t k = 0; k < paths.size(); ++k) {
      if (paths[k].path.steps.empty()) continue;
      if (paths[k].begin)
        add({static_cast<int>(k), false, paths[k].path.from, *paths[k].begin, way_out(reversed(paths[k].path)), -1});
      if (paths[k].end)
        add({static_cast<int>(k), true, paths[k].path.end(), *paths[k].end, way_out(paths[k].path), -1});
    }
  }

  std::vector<PathInSpace> run() {
    visit_nodes([&](std::vector<int>& node) { join(node); });
    std::vector<PathInSpace> result;
    std::vector<bool> used(paths_.size(), false);
    for (size_t k = 0; k < paths_.size(); ++k) {
      if (used[k] || paths_[k].path.steps.empty()) continue;
      // Back to where the chain begins, or once around.
      int first = static_cast<int>(k);
      bool backwards = false, loop = false;
      for (int end = of_path_[k][0]; end >= 0 && ends_[end].other >= 0;) {
        const End& before = ends_[ends_[end].other];
        if (before.path == static_cast<int>(k)) {
          loop = true;
          break;
        }
        first = before.path, backwards = !before.last;
        end = of_path_[first][backwards ? 1 : 0];
      }
      if (loop) first = static_cast<int>(k), backwards = false;
      PathInSpace whole;
      Path& chain = whole.path;
      for (int path = first; path >= 0 && !used[path];) {
        used[path] = true;
        const Path part = backwards ? reversed(paths_[path].path) : paths_[path].path;
        const PathInSpace& given = paths_[path];
        if (chain.steps.empty()) chain.from = part.from, whole.begin = backwards ? given.end : given.begin;
        whole.end = backwards ? given.begin : given.end;
        chain.steps.insert(chain.steps.end(), part.steps.begin(), part.steps.end());
        chain.closed = part.closed && chain.steps.size() == part.steps.size();
        const int end = of_path_[path][backwards ? 0 : 1];
        if (end < 0 || ends_[end].other < 0) break;
        const End& next = ends_[ends_[end].other];
        path = next.path, backwards = next.last;
      }
      if (loop) chain.closed = true, chain.steps.back().to = chain.from, whole.begin.reset(), whole.end.reset();
      result.push_back(std::move(whole));
    }
    return result;
  }

  std::vector<bool> at_corners() const {
    std::vector<bool> result(paths_.size(), false);
    visit_nodes([&](const std::vector<int>& node) {
      if (node.size() < 2) return;
      for (const int end : node) result[ends_[end].path] = true;
    });
    return result;
  }

 private:
  void add(const End& end) {
    of_path_[end.path][end.last ? 1 : 0] = static_cast<int>(ends_.size());
    ends_.push_back(end);
  }

  // The ends that are one point.
  template <typename Visitor>
  void visit_nodes(const Visitor& visit) const {
    std::vector<int> order(ends_.size());
    for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return ends_[a].place.x != ends_[b].place.x ? ends_[a].place.x < ends_[b].place.x : a < b;
    });
    std::vector<bool> done(ends_.size(), false);
    for (size_t k = 0; k < order.size(); ++k) {
      if (done[order[k]]) continue;
      const End& one = ends_[order[k]];
      std::vector<int> node;
      for (size_t j = k; j < order.size() && ends_[order[j]].place.x <= one.place.x + kSamePlace; ++j) {
        const End& other = ends_[order[j]];
        if (done[order[j]] || glm::length(other.place - one.place) > kSamePlace ||
            glm::length(other.point - one.point) > same_)
          continue;
        node.push_back(order[j]);
        done[order[j]] = true;
      }
      visit(node);
    }
  }

  void join(std::vector<int>& node) {
    std::sort(node.begin(), node.end());
    struct Pair {
      double turn;
      int a, b;
    };
    std::vector<Pair> smooth;
    for (size_t i = 0; i < node.size(); ++i)
      for (size_t j = i + 1; j < node.size(); ++j)
        if (const double turn = glm::length(ends_[node[i]].way + ends_[node[j]].way); turn < kSmooth)
          smooth.push_back({turn, node[i], node[j]});
    std::stable_sort(smooth.begin(), smooth.end(), [](const Pair& a, const Pair& b) { return a.turn < b.turn; });
    for (const Pair& pair : smooth)
      if (ends_[pair.a].other < 0 && ends_[pair.b].other < 0) connect(pair.a, pair.b);
    std::erase_if(node, [&](int end) { return ends_[end].other >= 0; });
    if (node.size() == 2) connect(node[0], node[1]);
  }
  void connect(int a, int b) { ends_[a].other = b, ends_[b].other = a; }

  const std::vector<PathInSpace>& paths_;
  double same_;
  std::vector<End> ends_;
  std::vector<std::array<int, 2>> of_path_;  // numbers of the ends where it begins and ends; -1: cut
};

}  // namespace

std::vector<PathInSpace> joined(const std::vector<PathInSpace>& paths, double same) {
  return Joining(paths, same).run();
}

std::vector<bool> ends_at_corners(const std::vector<PathInSpace>& paths, double same) {
  return Joining(paths, same).at_corners();
}

}  // namespace lekalo::render
