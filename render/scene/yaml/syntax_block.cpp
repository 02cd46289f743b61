// Block structure: indentation, keys, dashes, block texts.
#include <fmt/format.h>

#include <algorithm>

#include "render/scene/values/characters.h"
#include "render/scene/yaml/syntax_checker.h"

namespace lekalo::render {

bool check_syntax(const std::shared_ptr<const SourceFile>& file, const ReadLimits& limits, Diagnostics& diagnostics) {
  return SyntaxChecker(file, limits, diagnostics).run();
}

std::string shorten(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (count_code_points(text) <= kLongest) return std::string(text);
  std::size_t end = 0;
  for (std::size_t i = 0; i < kLongest - 3; ++i) end += static_cast<std::size_t>(decode_utf8(text, end).length);
  return std::string(text.substr(0, end)) + "...";
}

bool SyntaxChecker::run() {
  try {
    if (text_.size() > limits_.bytes)
      fail({0, 1},
           fmt::format("this file has {:.1f} million bytes, scene files may have {:.1f}", text_.size() * 1e-6,
                       limits_.bytes * 1e-6),
           "put long lists of numbers into a table: { file: net.csv }");
    if (const auto bad = find_bad_character(text_))
      fail({bad->offset, bad->offset + bad->length}, bad->message, bad->hint);
    document();
    return true;
  } catch (const Stop&) {
    return false;
  }
}

void SyntaxChecker::document() {
  while (next_line()) {
    if (indent_ == 0 && document_marker_at(at_))
      document_marker();
    else
      line(indent_);
  }
  while (!levels_.empty()) close_level();
  if (nodes_ > 0) return;
  Place whole = place({});
  whole.line = 0;
  diagnostics_.error(whole, "this file is empty", "a scene file begins with 'lekalo: 1'");
  throw Stop{};
}

bool SyntaxChecker::next_line() {
  do {
    if (begun_) at_ = line_end(at_) + 1;
    begun_ = true;
    if (at_ >= text_.size()) return false;
    line_begin_ = at_;
    while (peek() == ' ') ++at_;
    indent_ = static_cast<int>(at_ - line_begin_);
    if (peek() == '\t')
      fail(here(), "a tab in the indentation", "indent with spaces; most editors can replace all tabs");
  } while (at_line_end());
  return true;
}

bool SyntaxChecker::document_marker_at(std::size_t at) const {
  const std::string_view three = text_.substr(std::min(at, text_.size()), 3);
  return (three == "---" || three == "...") && blank_at(at + 3);
}

// Linters of YAML ask for a '---' on top, so one is let through there.
void SyntaxChecker::document_marker() {
  const bool first = peek() == '-' && levels_.empty() && !root_done_ && !marker_seen_;
  if (!first)
    fail(here(3),
         fmt::format("'{}' begins or ends a second document, and a scene file is one document", text_.substr(at_, 3)),
         "remove this line; a second scene goes into a file of its own");
  marker_seen_ = true;
  at_ += 3;
  skip_blanks();
  if (!at_line_end()) fail(here(), "nothing may follow '---' on its line", "begin the scene on the next line");
}

void SyntaxChecker::line(int column) {
  if (levels_.empty()) {
    if (root_done_) fail(here(), "the file goes on after its outermost bracket or value is complete");
    node(column);
    root_done_ = levels_.empty();
    return;
  }
  Level& top = levels_.back();
  const bool list_below_key = column == top.column && !top.sequence && at_dash();
  if (top.awaiting && (column > top.column || list_below_key)) {
    top.awaiting = false;
    node(column);
    return;
  }
  if (column > top.column) continuation_error();
  const auto belongs_below = [&] {
    const Level& level = levels_.back();
    if (level.column != column) return level.column > column;
    return level.sequence && !at_dash() && levels_.size() > 1 && levels_[levels_.size() - 2].column == column;
  };
  if (std::none_of(levels_.begin(), levels_.end(), [&](const Level& level) { return level.column == column; }))
    indentation_error(column);
  while (belongs_below()) close_level();
  if (levels_.back().sequence) {
    if (!at_dash()) not_an_item();
    dash(column);
    return;
  }
  Span key;
  std::size_t colon = 0;
  if (at_dash() || !key_begins(key, colon)) not_a_key();
  keyed_value(key, colon);
}

void SyntaxChecker::close_level() {
  if (levels_.back().awaiting) value_missing(levels_.back());
  levels_.pop_back();
}

// A value whose first character stands at at_ (in this column): a list, a map, or anything that fits one line.
void SyntaxChecker::node(int column) {
  Span key;
  std::size_t colon = 0;
  if (at_dash()) {
    push_level(column, true);
    dash(column);
  } else if (key_begins(key, colon)) {
    push_level(column, false);
    keyed_value(key, colon);
  } else {
    if (looks_like_entry()) not_a_key();
    inline_value();
  }
}

// 'name:value' without the space, or 'name = value', where a value begins a line or an item.
bool SyntaxChecker::looks_like_entry() const {
  std::size_t i = at_;
  while (is_name_character(char_at(i))) ++i;
  if (i == at_) return false;
  if (char_at(i) == ':') return !blank_at(i + 1) && char_at(i + 1) != '/' && char_at(i + 1) != '\\';
  if (text_.substr(i).starts_with("：")) return true;
  while (char_at(i) == ' ') ++i;
  return char_at(i) == '=' && char_at(i + 1) != '=';
}

void SyntaxChecker::dash(int column) {
  if (levels_.back().awaiting) value_missing(levels_.back());
  levels_.back().entry = here();
  levels_.back().scalar = {};
  levels_.back().awaiting = false;
  ++at_;
  skip_block_blanks();
  if (at_line_end())
    levels_.back().awaiting = true;
  else
    node(column + static_cast<int>(at_ - levels_.back().entry.begin));
}

// Whether the rest of the line begins with 'key:' and a blank. Leaves at_ where it is.
bool SyntaxChecker::key_begins(Span& key, std::size_t& colon) {
  const char c = peek();
  if (c == '[' || c == '{' || c == '|' || c == '>') return false;
  const std::size_t begin = at_;
  if (c == '\'' || c == '"') {
    quoted();
    key = {begin, at_};
    skip_blanks();
    colon = at_;
    at_ = begin;
    return char_at(colon) == ':' && blank_at(colon + 1);
  }
  check_first_character(false);
  for (std::size_t i = begin; char_at(i) != '\n'; ++i) {
    if (text_[i] == '#' && i > begin && blank_at(i - 1)) return false;
    if (text_[i] != ':' || !blank_at(i + 1)) continue;
    colon = i;
    while (i > begin && blank_at(i - 1)) --i;
    key = {begin, i};
    return true;
  }
  return false;
}

void SyntaxChecker::keyed_value(Span key, std::size_t colon) {
  constexpr std::size_t kLongestKey = 512;  // YAML allows 1024 bytes up to the ':'
  if (colon - key.begin > kLongestKey)
    fail({key.begin, key.begin + 1}, "this key is too long", "text with ': ' in it needs quotes");
  check_null(key);
  Level& level = levels_.back();
  if (level.awaiting) value_missing(level);
  level.entry = key;
  level.scalar = {};
  level.awaiting = false;
  at_ = colon + 1;
  count_node();
  skip_block_blanks();
  if (at_line_end())
    level.awaiting = true;
  else if (at_dash())
    fail(here(), fmt::format("a list cannot begin on the line of its key '{}'", shorten(slice(key))),
         "begin the first '- ' on the next line, or write the list in brackets: [1, 2]");
  else
    inline_value();
}

void SyntaxChecker::inline_value() {
  count_node();
  switch (peek()) {
    case '[':
    case '{':
      flow();
      end_of_line("bracket");
      break;
    case '\'':
    case '"':
      quoted();
      end_of_line("quote");
      break;
    case '|':
    case '>':
      block_text();
      break;
    default:
      const Span scalar = plain(false);
      if (!levels_.empty()) levels_.back().scalar = scalar;
  }
}

// '|' keeps the line breaks of the indented lines below, '>' joins them; '-' and '+' rule the last line break.
void SyntaxChecker::block_text() {
  const Span sign = here();
  if (levels_.empty()) fail(sign, "a scene file is a map of sections, not a text");
  ++at_;
  if (peek() == '-' || peek() == '+') ++at_;
  if (!blank_at(at_))
    fail(sign, fmt::format("a value without quotes cannot begin with '{}'", slice(sign)),
         "put it in single quotes; '|' and '>' alone begin a text on the next lines");
  end_of_line("sign");
  const int parent = levels_.back().column;
  int text_indent = -1;
  std::size_t last = line_end(at_);
  for (std::size_t begin = last + 1; begin < text_.size(); begin = line_end(begin) + 1) {
    const std::size_t end = line_end(begin);
    const std::size_t first = std::min(text_.find_first_not_of(' ', begin), end);
    const int indent = static_cast<int>(first - begin);
    if (first == end) {
      if (text_indent < 0) fail(sign, "the first line of this text is empty", "begin the text on the next line");
      continue;
    }
    if (text_[first] == '\t') fail({first, first + 1}, "a tab in the indentation", "indent with spaces");
    if (indent <= parent) break;
    if (text_indent < 0) text_indent = indent;
    if (indent < text_indent)
      fail({first, first + 1}, "this line is indented less than the first line of its text",
           "indent all lines of a text alike, or more than the first");
    last = end;
  }
  if (text_indent < 0)
    fail(sign, fmt::format("'{}' announces a text on the next lines, but none follows", slice(sign)),
         "indent the text below, or write it in quotes on this line");
  at_ = last;
}

void SyntaxChecker::end_of_line(const char* after) {
  const std::size_t end = at_;
  skip_blanks();
  if (at_line_end() && (peek() != '#' || at_ > end)) return;
  if (peek() == ':' && end == at_ && (text_[end - 1] == ']' || text_[end - 1] == '}'))
    fail(here(), "a list or map cannot be a key", "keys are names");
  if (peek() == ':') fail(here(), "a second ':' in this line", "a value that contains ': ' needs quotes as a whole");
  std::string hint = "a value that goes on behind its quotes or brackets needs quotes as a whole";
  if (end > 0 && text_[end - 1] == '\'') hint = "an apostrophe inside single quotes is written twice: 'Casteljau''s'";
  fail(here(), fmt::format("unexpected text behind the closing {}", after), hint);
}

void SyntaxChecker::push_level(int column, bool sequence) {
  check_depth();
  count_node();
  levels_.push_back({column, sequence, here()});
}

}  // namespace lekalo::render
