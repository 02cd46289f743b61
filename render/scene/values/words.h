// Words in messages: lists, and what was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lekalo::render {

// "a, b, c"; of more than `most` the first ones and "...".
std::string listed(const std::vector<std::string>& words, size_t most = 1000);

// " (did you mean 'x'?)" for the known word nearest to `word`, or nothing.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace lekalo::render
