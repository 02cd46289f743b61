// The pebble game (Jacobs and Hendrickson 1997): each point has two pebbles, its degrees of freedom. A bar is laid
// where four pebbles can be gathered at its ends, and takes one; where they cannot it says nothing new. After that the
// two ends of a bar keep three pebbles at most between them: all points from which no further one can be fetched are
// rigid with it.
#include <algorithm>
#include <array>
#include <optional>

#include "geometry/constraints/decomposition.h"

namespace lekalo::geometry {

namespace {

class PebbleGame {
 public:
  explicit PebbleGame(int points) : covered_(static_cast<size_t>(points), {-1, -1}) {}

  // True if the bar is independent of those before.
  bool lay(int a, int b) {
    if (a == b) return false;
    if (!gather(a, b, 4)) return false;
    cover(a, b);
    return true;
  }

  // The points that are rigid with both ends of a bar.
  std::vector<int> rigid_with(int a, int b) {
    gather(a, b, 3);
    const int n = static_cast<int>(covered_.size());
    std::vector<int> result;
    for (int k = 0; k < n; ++k)
      if (k == a || k == b || !path_to_free(k, {a, b})) result.push_back(k);
    return result;
  }

 private:
  int free_pebbles(int k) const { return (covered_[k][0] < 0) + (covered_[k][1] < 0); }
  void cover(int from, int to) { *std::find(covered_[from].begin(), covered_[from].end(), -1) = to; }

  bool gather(int a, int b, int count) {
    while (free_pebbles(a) + free_pebbles(b) < count)
      if (!(free_pebbles(a) < 2 && fetch(a, b)) && !(free_pebbles(b) < 2 && fetch(b, a))) return false;
    return true;
  }
  // Brings a pebble to `to` along the bars, without those of `kept`.
  bool fetch(int to, int kept) {
    const auto path = path_to_free(to, {to, kept});
    if (!path) return false;
    // Each bar of the path is covered from its other end.
    for (size_t k = path->size() - 1; k > 0; --k) {
      const int from = (*path)[k - 1], end = (*path)[k];
      cover(end, from);
      *std::find(covered_[from].begin(), covered_[from].end(), end) = -1;
    }
    return true;
  }
  // From a point along covered bars to another one with a free pebble that is none of these.
  std::optional<std::vector<int>> path_to_free(int first, std::array<int, 2> kept) const {
    std::vector<int> before(covered_.size(), -1), queue{first};
    const auto is_kept = [&](int k) { return k == kept[0] || k == kept[1]; };
    for (size_t k = 0; k < queue.size(); ++k) {
      const int at = queue[k];
      if (!is_kept(at) && free_pebbles(at) > 0) {
        std::vector<int> path;
        for (int step = at; step != first; step = before[step]) path.push_back(step);
        path.push_back(first);
        std::reverse(path.begin(), path.end());
        return path;
      }
      if (is_kept(at) && at != first) continue;
      for (const int next : covered_[at])
        if (next >= 0 && next != first && before[next] < 0) before[next] = at, queue.push_back(next);
    }
    return std::nullopt;
  }

  std::vector<std::array<int, 2>> covered_;  // by each point's pebbles: the bar to that point; -1 free
};

}  // namespace

std::vector<std::vector<int>> rigid_parts(int points, std::span<const std::pair<int, int>> bars) {
  PebbleGame game(points);
  std::vector<std::pair<int, int>> independent;
  for (const auto& [a, b] : bars)
    if (game.lay(a, b)) independent.emplace_back(a, b);
  std::vector<std::vector<int>> result;
  const auto lies_in_one = [&](const std::pair<int, int>& bar) {
    return std::any_of(result.begin(), result.end(), [&](const std::vector<int>& part) {
      return std::binary_search(part.begin(), part.end(), bar.first) &&
             std::binary_search(part.begin(), part.end(), bar.second);
    });
  };
  for (const auto& bar : independent)
    if (!lies_in_one(bar)) result.push_back(game.rigid_with(bar.first, bar.second));
  return result;
}

}  // namespace lekalo::geometry
