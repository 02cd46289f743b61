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

void check_formula(const std::string& text, const std::string& option) {
  auto parsed = geometry::Expression::parse(text);
  if (const auto* error = std::get_if<geometry::ExpressionError>(&parsed))
    throw UsageError(fmt::format("--frames {}: '{}': {}", option, text, error->message));
}

}  // namespace

std::vector<Frame> parse_frames(const std::string& text) {
  if (text.empty()) return {{}};
  const size_t equals = text.find('='), dots = text.find("..", equals == std::string::npos ? 0 : equals),
               colon = text.rfind(':');
  if (equals == std::string::npos || equals == 0 || dots == std::string::npos || colon == std::string::npos ||
      colon < dots + 3 || dots == equals + 1)
    throw UsageError(fmt::format("--frames takes NAME=A..B:N, for example tube=0.1..0.5:12, found '{}'", text));
  const std::string name = text.substr(0, equals), first = text.substr(equals + 1, dots - equals - 1),
                    last = text.substr(dots + 2, colon - dots - 2);
  int count = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, count);
  if (error != std::errc() || rest != end || count < 1 || count > kMaxFrames)
    throw UsageError(fmt::format("--frames {}: the number of frames, '{}', is no whole number between 1 and {}", text,
                                 text.substr(colon + 1), kMaxFrames));
  check_formula(first, text);
  check_formula(last, text);
  const int digits = std::max(4, static_cast<int>(std::to_string(count).size()));
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    std::string value = i == 0           ? first
                        : i == count - 1 ? last
                                         : fmt::format("({0}) + (({1}) - ({0}))*{2}/{3}", first, last, i, count - 1);
    frames.push_back(
        {render::ParameterSetting{name, std::move(value), "--frames " + text}, fmt::format("_{:0{}}", i + 1, digits)});
  }
  return frames;
}

std::string numbered(const std::string& path, const Frame& frame) {
  if (frame.suffix.empty()) return path;
  const std::filesystem::path file(path);
  return (file.parent_path() / (file.stem().string() + frame.suffix + file.extension().string())).string();
}

}  // namespace lekalo::command
