// What is wrong inside brackets: entries without ':', values that end too early, brackets that are not closed.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "render/scene/yaml/syntax_checker.h"

namespace lekalo::render {

namespace {

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

}  // namespace

// Reports at the bracket instead if a line inside it looks as if the bracket had been meant to end before.
void SyntaxChecker::flow_error(Span at, const std::string& message, const std::string& hint) {
  const auto unclosed =
      std::find_if(brackets_.rbegin(), brackets_.rend(), [&](const Bracket& b) { return b.open < suspect_; });
  if (suspect_ == 0 || unclosed == brackets_.rend()) fail(at, message, hint);
  const std::size_t open = unclosed->open;
  const Diagnostic next = Diagnostics::note(place({suspect_, suspect_ + 1}), "this line looks like the next entry");
  fail({open, open + 1}, fmt::format("'{}' is not closed", text_[open]),
       fmt::format("a '{}' is missing", unclosed->map ? '}' : ']'), {next});
}

// Behind a key of { }, something else than ':' stands at at_.
void SyntaxChecker::key_without_value() {
  const Bracket& bracket = brackets_.back();
  const Span key = bracket.key;
  const std::string_view text = slice(key);
  const std::string name = shorten(text);
  const char c = peek();
  if (c == '\n' || c == '#')
    flow_error(key, fmt::format("'{}' has no ':' on its line", name), "inside { } every entry is 'key: value'");
  if ((c == '{' || c == '[') && !blank_at(at_ - 1))
    flow_error(here(), fmt::format("'{}' is followed by '{}'", name, c),
               "inside brackets a text that contains [ ] { } or ',' needs single quotes: '$\\mathbf{p}$'");
  const std::size_t colon = text.find(':');
  if (text.front() != '\'' && text.front() != '"' && colon != std::string_view::npos && colon > 0)
    flow_error(key, fmt::format("a space is missing behind the ':' of '{}'", name),
               fmt::format("write '{}: {}'", shorten(text.substr(0, colon)), shorten(text.substr(colon + 1))));
  const Span before = bracket.scalar;
  const bool adjacent = !before.empty() && char_at(before.end) == ',' && key.begin == before.end + 1;
  const std::size_t digits = slice(before).find_last_not_of("0123456789") + 1;
  if (adjacent && is_digits(text.substr(0, 1)) && is_digits(slice(before).substr(digits)))
    flow_error({before.begin, key.end},
               fmt::format("'{},{}' is two entries: the comma ends the first", slice(before), name),
               fmt::format("decimal numbers have a point: {}.{}", slice(before), name));
  flow_error(key, fmt::format("'{}' has no value", name),
             "inside { } every entry is 'key: value'; a value that contains ',' needs quotes");
}

// Behind a complete entry, something else than ',' or the closing bracket stands at at_.
void SyntaxChecker::missing_separator() {
  const Bracket& bracket = brackets_.back();
  const char c = peek(), closing = bracket.map ? '}' : ']';
  const std::string value = shorten(slice(bracket.scalar));
  const bool touching = !blank_at(at_ - 1);
  if (c == ':' && !bracket.map)
    flow_error(here(), "a ':' inside [ ]", "a list holds values; write [{ key: value }] for maps in a list");
  if (c == ':')
    flow_error(here(), fmt::format("a second ':' behind '{}'", shorten(slice(bracket.key))),
               "a value that contains ': ' needs quotes; otherwise a ',' is missing before");
  if ((c == '{' || c == '[') && touching && !bracket.scalar.empty())
    flow_error(here(), fmt::format("'{}' is followed by '{}'", value, c),
               "inside brackets a text that contains [ ] { } or ',' needs single quotes: '$\\mathbf{p}$'");
  if (touching && text_[at_ - 1] == '\'')
    flow_error(here(), "unexpected text behind the closing quote",
               "an apostrophe inside single quotes is written twice: 'Casteljau''s'");
  if (at_ > line_begin_ &&
      text_.substr(line_begin_, at_ - line_begin_).find_first_not_of(" \t") != std::string_view::npos)
    flow_error(here(), fmt::format("expected ',' or '{}'", closing), "a ',' separates the entries inside brackets");
  const std::string hint = "a ',' is missing at the end of the line above";
  flow_error(here(), fmt::format("expected ',' or '{}' before this line", closing),
             bracket.scalar.empty() ? hint : hint + "; a value without quotes cannot continue on a further line");
}

}  // namespace lekalo::render
