// Brackets: { key: value, ... } and [item, ...], over any number of lines. JSON is this.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "render/scene/yaml/syntax_checker.h"

namespace lekalo::render {

void SyntaxChecker::flow() {
  flow_indent_ = indent_;
  suspect_ = 0;
  open_bracket();
  while (!brackets_.empty()) {
    skip_to_flow_token();
    const Bracket& bracket = brackets_.back();
    if (at_ >= text_.size()) {
      const std::size_t open = bracket.open;
      flow_error({open, open + 1}, fmt::format("'{}' is never closed", text_[open]),
                 fmt::format("a '{}' is missing", bracket.map ? '}' : ']'));
    }
    const char c = peek();
    if (c == ']' || c == '}')
      close_bracket();
    else if (bracket.expect == Bracket::Expect::separator)
      separator();
    else if (c == ',' && bracket.expect != Bracket::Expect::value)
      flow_error(here(), "nothing stands before this ','", "remove the ',', or write what is missing");
    else if (bracket.map && bracket.expect != Bracket::Expect::value)
      flow_key();
    else
      flow_value();
  }
}

void SyntaxChecker::open_bracket() {
  check_depth();
  brackets_.push_back({at_, peek() == '{'});
  ++at_;
}

void SyntaxChecker::close_bracket() {
  Bracket& bracket = brackets_.back();
  const bool map = peek() == '}';
  if (map != bracket.map) {
    const Diagnostic opened = Diagnostics::note(place({bracket.open, bracket.open + 1}), "it is opened here");
    fail(here(), fmt::format("'{}' cannot close '{}'", peek(), text_[bracket.open]),
         fmt::format("a '{}' is missing before it, or it should be one", bracket.map ? '}' : ']'), {opened});
  }
  if (bracket.expect == Bracket::Expect::value) flow_value();  // reports that it is missing
  ++at_;
  brackets_.pop_back();
}

void SyntaxChecker::flow_key() {
  Bracket& bracket = brackets_.back();
  const std::size_t begin = at_;
  const char c = peek();
  if (c == '[' || c == '{') fail(here(), "a list or map cannot be a key", "keys are names: { name: value }");
  const bool in_quotes = c == '\'' || c == '"';
  if (in_quotes)
    quoted();
  else
    plain(true);
  bracket.key = {begin, at_};
  count_node();
  skip_blanks();
  if (peek() != ':') key_without_value();
  if (at_ - begin > 512) fail({begin, begin + 1}, "this key is too long", "text with ': ' in it needs quotes");
  ++at_;
  if (!in_quotes && (peek() == '[' || peek() == '{' || peek() == '\'' || peek() == '"'))
    fail({begin, at_}, fmt::format("a space is missing behind '{}:'", shorten(slice(bracket.key))),
         fmt::format("write '{}: {}...'", shorten(slice(bracket.key)), peek()));
  bracket.expect = Bracket::Expect::value;
}

// An item of a list or the value of a key. Nothing but ',' or a bracket there: the value is missing.
void SyntaxChecker::flow_value() {
  Bracket& bracket = brackets_.back();
  bracket.expect = Bracket::Expect::separator;
  bracket.scalar = {};
  count_node();
  switch (peek()) {
    case ',':
    case '}':
    case ']':
      report(bracket.key, fmt::format("'{}' has no value", shorten(slice(bracket.key))),
             "give it a value, or remove it");
      break;
    case '[':
    case '{':
      open_bracket();
      break;
    case '\'':
    case '"':
      quoted();
      break;
    default:
      bracket.scalar = plain(true);
  }
}

void SyntaxChecker::separator() {
  if (peek() != ',') missing_separator();
  brackets_.back().expect = Bracket::Expect::entry;
  ++at_;
}

// Spaces, tabs, line breaks and comments between the tokens.
void SyntaxChecker::skip_to_flow_token() {
  for (;;) {
    skip_blanks();
    if (at_ >= text_.size()) return;
    if (peek() == '#') {
      if (const std::size_t color = color_comment(true))
        fail(here(color), fmt::format("'{}' without quotes is a comment", text_.substr(at_, color)),
             fmt::format("write '{}' in quotes", text_.substr(at_, color)));
      at_ = line_end(at_);
    }
    if (peek() != '\n') return;
    if (at_ >= text_.size()) return;
    ++at_;
    flow_line();
  }
}

// At the beginning of a further line inside brackets.
void SyntaxChecker::flow_line() {
  line_begin_ = at_;
  if (document_marker_at(at_))
    flow_error(here(3), fmt::format("'{}' inside brackets", text_.substr(at_, 3)), "remove this line");
  const Bracket& bracket = brackets_.back();
  const bool behind_plain = bracket.expect == Bracket::Expect::separator && !bracket.scalar.empty();
  // yaml-cpp 0.7 takes a comment in column 1 for a further line of a plain scalar.
  if (behind_plain && peek() == '#')
    fail(here(), "a comment in column 1 behind a value that no ',' has ended yet", "indent the comment");
  if (suspect_ > 0) return;
  std::size_t i = at_;
  while (char_at(i) == ' ') ++i;
  if (static_cast<int>(i - at_) > flow_indent_) return;
  const std::size_t name = i;
  while (is_name_character(char_at(i))) ++i;
  if (i > name && char_at(i) == ':' && blank_at(i + 1)) suspect_ = name;
}

// `alone`: only where nothing but a ',' or bracket follows, so that a comment like '#add more' stays one.
std::size_t SyntaxChecker::color_comment(bool alone) const {
  if (peek() != '#') return 0;
  std::size_t i = at_ + 1;
  while (std::isxdigit(static_cast<unsigned char>(char_at(i)))) ++i;
  const std::size_t digits = i - at_ - 1;
  if (digits != 3 && digits != 4 && digits != 6 && digits != 8) return 0;
  if (is_name_character(char_at(i))) return 0;
  if (alone) {
    const std::size_t before = text_.substr(0, at_).find_last_not_of(" \t");
    if (before == std::string_view::npos || std::string_view("[{,:").find(text_[before]) == std::string_view::npos)
      return 0;
    std::size_t next = i;
    while (char_at(next) == ' ' || char_at(next) == '\t') ++next;
    if (std::string_view(",]}\n").find(char_at(next)) == std::string_view::npos) return 0;
  }
  return digits + 1;
}

}  // namespace lekalo::render
