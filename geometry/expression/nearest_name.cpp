#include "geometry/expression/nearest_name.h"

#include <algorithm>
#include <utility>

namespace lekalo::geometry {
namespace {

// Of ASCII letters only: names are ASCII.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Names are short; an absurd one is compared by its beginning, which bounds the work.
  constexpr std::size_t kLongest = 256;
  a = a.substr(0, kLongest), b = b.substr(0, kLongest);
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), previous(n + 1), current(n + 1);
  for (std::size_t j = 0; j <= n; ++j) current[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(previous);
    previous.swap(current);
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
    }
  }
  return current[n];
}

std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates, size_t most) {
  if (candidates.size() <= most) return candidates;
  std::vector<std::pair<int, std::string>> ranked;
  for (std::string& candidate : candidates) ranked.emplace_back(edit_distance(name, candidate), std::move(candidate));
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> nearest;
  for (size_t k = 0; k < most; ++k) nearest.push_back(std::move(ranked[k].second));
  return nearest;
}

}  // namespace lekalo::geometry
