// "Did you mean ...?": the known name that a misspelt one most resembles.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::geometry {

// The least number of insertions, deletions, replacements and swaps of neighbours that turn a into b (Damerau 1964,
// restricted). Replacing a letter by its other case counts as nothing. Bytes are compared, not characters.
int edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to the name, the first of equals; none if even that would change more than a third of the
// letters (at least one change is allowed, two in names of five letters or more). Candidates: any range of strings.
template <class Candidates>
std::optional<std::string> nearest_name(std::string_view name, const Candidates& candidates) {
  std::optional<std::string> best;
  int allowed = static_cast<int>(name.size() >= 6 ? name.size() / 3 : name.size() >= 5 ? 2 : 1);
  for (const auto& candidate : candidates) {
    const std::string_view other(candidate);
    const int longer = static_cast<int>(other.size()) - static_cast<int>(name.size());
    if (longer > allowed || -longer > allowed) continue;
    const int distance = edit_distance(name, other);
    // A name of one letter resembles nothing but its other case.
    if (distance > allowed || (distance > 0 && static_cast<std::size_t>(distance) >= name.size())) continue;
    best = std::string(other);
    allowed = distance - 1;
  }
  return best;
}

// At most so many of the candidates, the nearest first; all in their order if there are no more.
std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates, size_t most);

}  // namespace lekalo::geometry
