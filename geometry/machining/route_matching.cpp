#include "geometry/machining/route_matching.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

void check_even(const Grid<double>& distances) {
  if (distances.rows % 2 != 0) throw std::invalid_argument("an odd number of vertices has no perfect matching");
}

// Pairs by increasing distance of vertices that are still free.
Pairs greedy_matching(const Grid<double>& distances) {
  std::vector<std::pair<double, std::pair<int, int>>> all;
  for (int i = 0; i < distances.rows; ++i)
    for (int j = i + 1; j < distances.rows; ++j) all.push_back({distances.at(i, j), {i, j}});
  std::sort(all.begin(), all.end());
  std::vector<bool> taken(static_cast<size_t>(distances.rows), false);
  Pairs pairs;
  for (const auto& [distance, pair] : all) {
    if (taken[static_cast<size_t>(pair.first)] || taken[static_cast<size_t>(pair.second)]) continue;
    taken[static_cast<size_t>(pair.first)] = taken[static_cast<size_t>(pair.second)] = true;
    pairs.push_back(pair);
  }
  return pairs;
}

// Whether some pairs could be replaced by shorter ones of the same vertices.
bool exchange(Pairs& pairs, const std::vector<size_t>& chosen, const Grid<double>& distances) {
  std::vector<int> vertices;
  double before = 0;
  for (const size_t k : chosen) {
    vertices.push_back(pairs[k].first);
    vertices.push_back(pairs[k].second);
    before += distances.at(pairs[k].first, pairs[k].second);
  }
  const int n = static_cast<int>(vertices.size());
  Grid<double> among{n, n, std::vector<double>(static_cast<size_t>(n * n))};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      among.at(i, j) = distances.at(vertices[static_cast<size_t>(i)], vertices[static_cast<size_t>(j)]);
  const Pairs best = minimum_matching(among);
  if (!(weight(best, among) < before * (1 - 1e-12))) return false;
  for (size_t k = 0; k < chosen.size(); ++k)
    pairs[chosen[k]] =
        std::minmax(vertices[static_cast<size_t>(best[k].first)], vertices[static_cast<size_t>(best[k].second)]);
  return true;
}

}  // namespace

double matching_count(int vertices) {
  double count = 1;
  for (int k = vertices - 1; k > 1; k -= 2) count *= k;
  return count;
}

double weight(const Pairs& pairs, const Grid<double>& distances) {
  double sum = 0;
  for (const auto& [a, b] : pairs) sum += distances.at(a, b);
  return sum;
}

// least[set]: of all matchings of the set. Its first vertex is paired with each of the others.
Pairs minimum_matching(const Grid<double>& distances) {
  check_even(distances);
  const int n = distances.rows;
  if (n > kMaxExactMatching) throw std::invalid_argument("too many vertices for all sets of them");
  const size_t all = (size_t{1} << n) - 1;
  std::vector<double> least(all + 1, std::numeric_limits<double>::infinity());
  std::vector<signed char> partner(all + 1, -1);
  least[0] = 0;
  const auto first_of = [](size_t set) {
    int first = 0;
    while (!(set >> first & 1)) ++first;
    return first;
  };
  for (size_t set = 1; set <= all; ++set) {
    const int first = first_of(set);
    for (int other = first + 1; other < n; ++other) {
      if (!(set >> other & 1)) continue;
      const double sum = least[set & ~(size_t{1} << first) & ~(size_t{1} << other)] + distances.at(first, other);
      if (!(sum < least[set])) continue;
      least[set] = sum;
      partner[set] = static_cast<signed char>(other);
    }
  }
  Pairs pairs;
  for (size_t set = all; set != 0;) {
    const int first = first_of(set), other = partner[set];
    if (other < 0) throw std::invalid_argument("two vertices have no distance");
    pairs.push_back({first, other});
    set &= ~(size_t{1} << first) & ~(size_t{1} << other);
  }
  return pairs;
}

Pairs matching_by_exchange(const Grid<double>& distances) {
  check_even(distances);
  Pairs pairs = greedy_matching(distances);
  if (pairs.size() < 2) return pairs;
  if (pairs.size() == 2) {
    exchange(pairs, {0, 1}, distances);
    return pairs;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i < pairs.size(); ++i)
      for (size_t j = i + 1; j < pairs.size(); ++j)
        for (size_t k = j + 1; k < pairs.size(); ++k) changed |= exchange(pairs, {i, j, k}, distances);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace lekalo::geometry
