#include "frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "command.h"
#include "geometry/expression/expression.h"

namespace lekalo::command {

namespace {

constexpr int kMaxFrames = 1000000;

void check_formula(const std::string& text, const std::string& written) {
  auto parsed = geometry::Expression::parse(text);
  if (const auto* error = std::get_if<geometry::ExpressionError>(&parsed))
    throw UsageError(fmt::format("{}: '{}': {}", written, text, error->message));
}

}  // namespace

std::vector<Frame> parse_frames(const std::string& text, const std::string& option) {
  if (text.empty()) return {{}};
  const std::string written = option + " " + text;
  const size_t equals = text.find('='), dots = text.find("..", equals == std::string::npos ? 0 : equals),
               colon = text.rfind(':');
  if (equals == std::string::npos || equals == 0 || dots == std::string::npos || colon == std::string::npos ||
      colon < dots + 3 || dots == equals + 1)
    throw UsageError(fmt::format("{} takes NAME=A..B:N, for example tube=0.1..0.5:12, found '{}'", option, text));
  const std::string name = text.substr(0, equals), first = text.substr(equals + 1, dots - equals - 1),
                    last = text.substr(dots + 2, colon - dots - 2);
  int count = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, count);
  if (error != std::errc() || rest != end || count < 1 || count > kMaxFrames)
    throw UsageError(fmt::format("{}: the number of frames, '{}', is no whole number between 1 and {}", written,
                                 text.substr(colon + 1), kMaxFrames));
  check_formula(first, written);
  check_formula(last, written);
  const int digits = std::max(4, static_cast<int>(std::to_string(count).size()));
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    std::string value = i == 0           ? first
                        : i == count - 1 ? last
                                         : fmt::format("({0}) + (({1}) - ({0}))*{2}/{3}", first, last, i, count - 1);
    frames.push_back(
        {render::ParameterSetting{name, std::move(value), written}, fmt::format("_{:0{}}", i + 1, digits)});
  }
  return frames;
}

std::vector<Frame> chosen_frames(const std::vector<Frame>& frames, const std::string& numbers) {
  if (numbers.empty()) return frames;
  const int count = static_cast<int>(frames.size());
  if (frames.front().suffix.empty()) throw UsageError("--only chooses among --frames");
  std::vector<char> chosen(frames.size(), 0);
  const auto number = [&](std::string_view text) {
    int value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size() || value < 1 || value > count)
      throw UsageError(fmt::format("--only {}: '{}' is no number of a frame, from 1 to {}; write for example 9-16,20",
                                   numbers, text, count));
    return value;
  };
  for (size_t begin = 0; begin <= numbers.size();) {
    const size_t end = std::min(numbers.find(',', begin), numbers.size());
    const std::string_view part = std::string_view(numbers).substr(begin, end - begin);
    const size_t dash = part.find('-');
    const int first = number(part.substr(0, dash));
    const int last = dash == std::string_view::npos ? first : number(part.substr(dash + 1));
    if (last < first) throw UsageError(fmt::format("--only {}: '{}' runs backwards", numbers, part));
    std::fill(chosen.begin() + first - 1, chosen.begin() + last, 1);
    begin = end + 1;
  }
  std::vector<Frame> result;
  for (size_t i = 0; i < frames.size(); ++i)
    if (chosen[i]) result.push_back(frames[i]);
  return result;
}

std::string numbered(const std::string& path, const Frame& frame) {
  if (frame.suffix.empty()) return path;
  const std::filesystem::path file(path);
  return (file.parent_path() / (file.stem().string() + frame.suffix + file.extension().string())).string();
}

}  // namespace lekalo::command
