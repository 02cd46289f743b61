#include "render/scene/values/words.h"

#include <fmt/format.h>

#include "geometry/expression/nearest_name.h"

namespace lekalo::render {

std::string listed(const std::vector<std::string>& words, size_t most) {
  std::string text;
  for (size_t i = 0; i < words.size() && i < most; ++i) text += (i ? ", " : "") + words[i];
  if (words.size() > most) text += ", ...";
  return text;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  // A name of a catalogue without its prefix: the glass N-BK7 is called BK7.
  for (const std::string& candidate : known) {
    const size_t dash = candidate.rfind('-');
    if (dash != std::string::npos && geometry::edit_distance(std::string_view(candidate).substr(dash + 1), word) == 0)
      return fmt::format(" (did you mean '{}'?)", candidate);
  }
  const auto nearest = geometry::nearest_name(word, known);
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : std::string();
}

}  // namespace lekalo::render
