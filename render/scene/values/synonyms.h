// What others call the types and fields of scene files: words that are near in meaning, not in letters.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::render {

// The types that a word of other modellers, books and renderers stands for; none known: empty.
std::span<const std::string_view> types_called(std::string_view word);

// The field among those known that is called so elsewhere; empty if none is.
std::string_view field_called(std::string_view word, const std::vector<std::string>& known);

}  // namespace lekalo::render
