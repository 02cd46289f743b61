// Source texts: line index and the way from byte offsets to lines and columns.
#include "render/scene/values/source.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/scene/values/characters.h"

namespace lekalo::render {

std::string where(const Place& place) { return fmt::format("{}:{}", place.file ? place.file->name : "", place.line); }

std::string_view SourceFile::line(int number) const {
  if (number < 1 || number > line_count()) return {};
  const std::size_t begin = line_starts[number - 1];
  std::size_t end = number < line_count() ? line_starts[number] : text.size();
  if (end > begin && text[end - 1] == '\n') --end;
  return std::string_view(text).substr(begin, end - begin);
}

namespace {

// CRLF and the lone CR of old files become LF; in place, since the text only shrinks.
void unify_line_breaks(std::string& text) {
  if (text.find('\r') == std::string::npos) return;
  std::size_t out = 0;
  for (std::size_t in = 0; in < text.size(); ++in) {
    char c = text[in];
    if (c == '\r') {
      if (in + 1 < text.size() && text[in + 1] == '\n') continue;
      c = '\n';
    }
    text[out++] = c;
  }
  text.resize(out);
}

}  // namespace

std::shared_ptr<const SourceFile> make_source(std::string name, std::string text, std::filesystem::path path,
                                              std::string scope, Place included_from) {
  // yaml-cpp leaves out one more than is there.
  while (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  unify_line_breaks(text);
  auto source = std::make_shared<SourceFile>();
  source->name = std::move(name);
  source->path = std::move(path);
  source->text = std::move(text);
  source->scope = std::move(scope);
  source->included_from = std::move(included_from);
  source->line_starts.push_back(0);
  for (std::size_t i = source->text.find('\n'); i != std::string::npos; i = source->text.find('\n', i + 1))
    if (i + 1 < source->text.size()) source->line_starts.push_back(static_cast<std::uint32_t>(i + 1));
  return source;
}

Place PlaceFinder::at(std::size_t offset, std::size_t length) {
  const std::string_view text = file_->text;
  const auto& starts = file_->line_starts;
  offset = std::min(offset, text.size());
  const auto next = std::upper_bound(starts.begin(), starts.end(), offset);
  const std::size_t line = static_cast<std::size_t>(next - starts.begin()) - 1;
  if (line != line_ || offset < offset_) {
    line_ = line;
    offset_ = starts[line];
    column_ = 1;
  }
  column_ += static_cast<int>(count_code_points(text.substr(offset_, offset - offset_)));
  offset_ = offset;
  std::string_view rest = text.substr(offset, length);
  rest = rest.substr(0, rest.find('\n'));
  return {file_, static_cast<int>(line) + 1, column_, std::max(1, static_cast<int>(count_code_points(rest)))};
}

}  // namespace lekalo::render
