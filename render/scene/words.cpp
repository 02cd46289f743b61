#include "render/scene/words.h"

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
  const auto nearest = geometry::nearest_name(word, known);
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : std::string();
}

}  // namespace lekalo::render
