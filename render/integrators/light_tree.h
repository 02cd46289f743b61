// Choice among many lamps: a binary tree whose nodes know a box, a cone of directions and the strength of the lamps
// below them, so that one is chosen in a time that grows with the logarithm of their number, about as the light that it
// may bring to a place (Conty Estevez, Kulla, "Importance sampling of many lights with adaptive tree splitting", 2018).
//
// Nodes that are large as seen from the place are split, so that near lamps are asked one by one; the nodes that are
// left and the near lamps are weighed together, and below a chosen node one way down is drawn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/trace/world.h"

namespace lekalo::render {

// With more lamps and glowing things than these the tree pays: measured in seconds for a picture, from between 16 and
// 64 balls on, and from between 64 and 200 points on.
inline constexpr size_t kManyLamps = 32;

inline constexpr double kBelowOne = 1 - 0x1p-53;

class LightTree {
 public:
  // Of the lamps of a world, and behind them what glows: numbers count them in this order.
  explicit LightTree(const World& world);

  struct Choice {
    size_t number;
    double probability;
  };
  // By a random number that is uniform in [0, 1); nothing where surely no lamp brings light.
  std::optional<Choice> choose(const Vec3& point, double random) const;
  // With which choose() returns the number.
  double probability(const Vec3& point, size_t number) const;

 private:
  // Irradiance at right angles by lamps: of those whose light does not fall off, and at distance 1 of the others. All
  // of it leaves within `spread` of a direction that is within `opening` of the axis.
  struct Node {
    geometry::Box3 box;
    Vec3 axis{0, 0, 1};
    double opening = geometry::kPi, spread = geometry::kPi;
    double even = 0, falling = 0;
    int parent = -1, left = -1, right = -1;  // nodes; of leaves -1
    size_t first = 0, count = 1;             // of a leaf's lamps, in numbers_
  };

  static Node merged(const Node& a, const Node& b);
  static double cost(const Node& node);
  static std::optional<Node> placed(const Light& lamp);
  int build(std::vector<Node>& leaves, size_t begin, size_t end);
  size_t best_split(std::vector<Node>& leaves, size_t begin, size_t end) const;
  double importance(const Node& node, const Vec3& point) const;
  double left_share(const Node& node, const Vec3& point) const;
  double brings(size_t number, const Vec3& point) const;
  // A node, or the lamp of a number (node -1), and with which probability it is chosen.
  struct Candidate {
    int node;
    size_t number;
    double probability;
  };
  std::vector<Candidate> candidates(const Vec3& point) const;
  std::vector<Candidate> lamps_of(const Node& leaf, const Vec3& point) const;
  void add_lamps(const Node& leaf, const Vec3& point, std::vector<Candidate>& list) const;

  const World& world_;
  double min_square_;            // of distances
  std::vector<Node> nodes_;      // the root is the first
  std::vector<int> leaf_of_;     // by number; -1: in no tree
  std::vector<size_t> numbers_;  // of lamps in the tree, those of a leaf together
  std::vector<size_t> apart_;    // lamps in no tree: the sky, and what is not known to lie somewhere
};

// Probabilities of what is listed, made of weights in the field `probability`.
template <class Candidate>
void share_out(std::vector<Candidate>& list) {
  constexpr double kBlindChoice = 0.1;  // share of the choice that does not look at the weights
  double sum = 0;
  for (const Candidate& one : list) sum += one.probability;
  const double n = static_cast<double>(list.size());
  for (Candidate& one : list)
    one.probability = sum > 0 ? (1 - kBlindChoice) * one.probability / sum + kBlindChoice / n : 1 / n;
}

// Which of them a random number in [0, 1) falls in; what is left of it, in [0, 1) anew.
template <class Candidate>
const Candidate& chosen_of(const std::vector<Candidate>& list, double& random) {
  size_t i = 0;
  while (i + 1 < list.size() && random >= list[i].probability) random -= list[i++].probability;
  random = std::min(random / list[i].probability, kBelowOne);
  return list[i];
}

// Null for a world of few lamps.
std::shared_ptr<const LightTree> make_light_tree(const World& world);

}  // namespace lekalo::render
