#include "geometry/constraints/decomposition.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lekalo::geometry {

namespace {

using Lists = std::vector<std::vector<int>>;

constexpr int kPlaces = 3;       // at which the Jacobian is looked at
constexpr double kAside = 0.03;  // of the size: where slopes that vanish at the start do so no more

double between_0_and_1(int i) {
  const double golden = 0.6180339887498949 * (i + 1);
  return golden - std::floor(golden);
}

struct Graph {
  std::vector<Equation> equations;
  Lists unknowns_of;   // of each equation
  Lists equations_of;  // of each unknown
};

Graph graph_of(const ConstraintSystem& system) {
  const int n = static_cast<int>(system.start.size());
  Graph graph;
  graph.equations_of.resize(system.start.size());
  for (size_t c = 0; c < system.constraints.size(); ++c) {
    const Constraint& one = system.constraints[c];
    if (one.is_inequality) continue;
    Eigen::MatrixXd used = Eigen::MatrixXd::Zero(one.count, n);
    for (int place = 0; place < kPlaces; ++place) {
      std::vector<double> p = system.start;
      for (size_t i = 0; i < p.size() && place > 0; ++i)
        p[i] += kAside * std::min(system.size, 1.0) * (between_0_and_1(static_cast<int>(i) + 97 * place) - 0.5);
      Eigen::VectorXd f = Eigen::VectorXd::Zero(one.count);
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(one.count, n);
      one.evaluate(p, f, jacobian);
      used += jacobian.cwiseAbs();
    }
    for (int row = 0; row < one.count; ++row) {
      const int number = static_cast<int>(graph.equations.size());
      graph.equations.push_back({static_cast<int>(c), row});
      graph.unknowns_of.emplace_back();
      for (const int i : one.unknowns) {
        if (used(row, i) == 0) continue;  // NaN, where there is no derivative, is a dependence
        graph.unknowns_of.back().push_back(i);
        graph.equations_of[static_cast<size_t>(i)].push_back(number);
      }
    }
  }
  return graph;
}

// A maximum matching by augmenting paths (Kuhn), without recursion: paths may be long.
class Matching {
 public:
  explicit Matching(const Graph& graph)
      : unknown_of(graph.unknowns_of.size(), -1), equation_of(graph.equations_of.size(), -1), graph_(graph) {
    for (size_t e = 0; e < unknown_of.size(); ++e) augment(static_cast<int>(e));
  }
  std::vector<int> unknown_of, equation_of;

 private:
  // Breadth first from an equation to an unknown that has none.
  void augment(int first) {
    std::vector<int> queue{first}, from(equation_of.size(), -1);
    for (size_t k = 0; k < queue.size(); ++k)
      for (const int x : graph_.unknowns_of[queue[k]]) {
        if (from[x] >= 0) continue;
        from[x] = queue[k];
        if (equation_of[x] < 0) return turn_path(x, from);
        queue.push_back(equation_of[x]);
      }
  }
  void turn_path(int x, const std::vector<int>& from) {
    while (x >= 0) {
      const int e = from[x], before = unknown_of[e];
      unknown_of[e] = x, equation_of[x] = e;
      x = before;
    }
  }
  const Graph& graph_;
};

// What can be reached from these: to all neighbours of one side, from there along the matching.
std::vector<char> reached(std::vector<int> from, const Lists& neighbours, const std::vector<int>& partner) {
  std::vector<char> seen(neighbours.size(), 0);
  for (const int k : from) seen[k] = 1;
  for (size_t k = 0; k < from.size(); ++k)
    for (const int other : neighbours[from[k]])
      if (const int next = partner[other]; next >= 0 && !seen[next]) seen[next] = 1, from.push_back(next);
  return seen;
}

std::vector<int> alone(const std::vector<int>& partner) {
  std::vector<int> result;
  for (size_t k = 0; k < partner.size(); ++k)
    if (partner[k] < 0) result.push_back(static_cast<int>(k));
  return result;
}

// Strongly connected components, each after those that it leads to (Tarjan 1972), with a stack of its own.
class Components {
 public:
  explicit Components(const Lists& next) : next_(next), index_(next.size(), -1), low_(next.size(), 0) {
    for (size_t k = 0; k < next.size(); ++k)
      if (index_[k] < 0) visit(static_cast<int>(k));
  }
  Lists found;

 private:
  void enter(int k) {
    index_[k] = low_[k] = count_++;
    open_.push_back(k), path_.push_back({k, 0});
  }
  void visit(int root) {
    enter(root);
    while (!path_.empty()) {
      auto& [k, position] = path_.back();
      if (position < next_[k].size()) {
        const int other = next_[k][position++];
        if (index_[other] < 0)
          enter(other);
        else if (low_[other] != kClosed)
          low_[k] = std::min(low_[k], index_[other]);
        continue;
      }
      leave();
    }
  }
  void leave() {
    const int k = path_.back().first, low = low_[k];
    path_.pop_back();
    if (low == index_[k]) {
      const auto begin = std::find(open_.begin(), open_.end(), k);
      found.emplace_back(begin, open_.end());
      for (auto one = begin; one != open_.end(); ++one) low_[*one] = kClosed;
      open_.erase(begin, open_.end());
    }
    if (!path_.empty()) low_[path_.back().first] = std::min(low_[path_.back().first], low);
  }

  static constexpr int kClosed = 1 << 30;
  const Lists& next_;
  std::vector<int> index_, low_, open_;
  std::vector<std::pair<int, size_t>> path_;
  int count_ = 0;
};

class Decomposing {
 public:
  explicit Decomposing(const ConstraintSystem& system) : graph_(graph_of(system)), matching_(graph_) {
    // The over-determined part is what equations without a partner lead to, the under-determined one what unknowns do.
    const std::vector<char> over = reached(alone(matching_.unknown_of), graph_.unknowns_of, matching_.equation_of);
    const std::vector<char> under = reached(alone(matching_.equation_of), graph_.equations_of, matching_.unknown_of);
    for (size_t e = 0; e < over.size(); ++e) {
      const int x = matching_.unknown_of[e];
      parts_of_equations_.push_back(over[e]              ? Determined::over
                                    : x >= 0 && under[x] ? Determined::under
                                                         : Determined::well);
    }
    for (size_t x = 0; x < under.size(); ++x) {
      const int e = matching_.equation_of[x];
      parts_of_unknowns_.push_back(under[x]            ? Determined::under
                                   : e >= 0 && over[e] ? Determined::over
                                                       : Determined::well);
    }
  }

  Decomposition result() {
    add_connected(Determined::over);
    add_well_determined();
    add_connected(Determined::under);
    result_.unmatched = alone(matching_.equation_of);
    result_.matched = static_cast<int>(graph_.equations_of.size() - result_.unmatched.size());
    return std::move(result_);
  }

 private:
  // What of the part hangs together.
  void add_connected(Determined part) {
    std::vector<char> seen(graph_.equations_of.size(), 0), taken(graph_.equations.size(), 0);
    for (size_t e = 0; e < taken.size(); ++e)
      if (parts_of_equations_[e] == part && graph_.unknowns_of[e].empty())
        result_.blocks.push_back({part, {}, {graph_.equations[e]}});
    for (size_t first = 0; first < seen.size(); ++first) {
      if (seen[first] || parts_of_unknowns_[first] != part) continue;
      std::vector<int> unknowns{static_cast<int>(first)}, equations;
      seen[first] = 1;
      for (size_t k = 0; k < unknowns.size(); ++k)
        for (const int e : graph_.equations_of[unknowns[k]]) {
          if (taken[e] || parts_of_equations_[e] != part) continue;
          taken[e] = 1, equations.push_back(e);
          for (const int x : graph_.unknowns_of[e])
            if (!seen[x] && parts_of_unknowns_[x] == part) seen[x] = 1, unknowns.push_back(x);
        }
      add(part, std::move(unknowns), std::move(equations));
    }
  }

  void add_well_determined() {
    Lists needed(graph_.equations_of.size());
    for (size_t x = 0; x < needed.size(); ++x)
      if (parts_of_unknowns_[x] == Determined::well)
        for (const int other : graph_.unknowns_of[matching_.equation_of[x]])
          if (parts_of_unknowns_[other] == Determined::well) needed[x].push_back(other);
    for (std::vector<int>& unknowns : Components(needed).found) {
      if (parts_of_unknowns_[unknowns.front()] != Determined::well) continue;
      std::vector<int> equations;
      for (const int x : unknowns) equations.push_back(matching_.equation_of[x]);
      add(Determined::well, std::move(unknowns), std::move(equations));
    }
  }

  void add(Determined part, std::vector<int> unknowns, std::vector<int> equations) {
    std::sort(unknowns.begin(), unknowns.end());
    std::sort(equations.begin(), equations.end());
    SystemBlock block{part, std::move(unknowns), {}};
    for (const int e : equations) block.equations.push_back(graph_.equations[e]);
    result_.blocks.push_back(std::move(block));
  }

  Graph graph_;
  Matching matching_;
  std::vector<Determined> parts_of_equations_, parts_of_unknowns_;
  Decomposition result_;
};

}  // namespace

std::string_view name_of(Determined part) {
  return part == Determined::over ? "over" : part == Determined::well ? "well" : "under";
}

size_t Decomposition::largest() const {
  size_t most = 0;
  for (const SystemBlock& block : blocks) most = std::max(most, block.unknowns.size());
  return most;
}

Decomposition decomposed(const ConstraintSystem& system) { return Decomposing(system).result(); }

}  // namespace lekalo::geometry
