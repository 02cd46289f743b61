// What is wrong with a line whose indentation or form does not fit the lines above it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "render/scene/values/characters.h"
#include "render/scene/yaml/syntax_checker.h"

namespace lekalo::render {

void SyntaxChecker::indentation_error(int column) {
  std::set<int> columns;
  for (const Level& level : levels_) columns.insert(level.column);
  fail(here(),
       fmt::format("this line is indented by {}, the entries above it by {}", column, fmt::join(columns, " or ")),
       "lines that belong together begin in the same column");
}

// The line is indented deeper than the entry above it, which has its value already.
void SyntaxChecker::continuation_error() {
  const Level level = levels_.back();
  const std::size_t line_begin = at_;
  Span key;
  std::size_t colon = 0;
  const bool keyed = !at_dash() && key_begins(key, colon);
  const Span entry = level.entry;
  const std::string name = level.sequence ? "this list item" : fmt::format("'{}'", shorten(slice(entry)));
  at_ = line_begin;
  if (level.scalar.empty())
    fail(here(), fmt::format("this line is indented under {}, which is complete", name),
         fmt::format("to stand beside it, begin in column {}", level.column + 1));
  const std::string value = shorten(slice(level.scalar));
  if (keyed || at_dash())
    fail(here(), fmt::format("nothing can be indented under {}, which has the value '{}'", name, value),
         fmt::format("to stand beside it, begin in column {}; to belong to it, '{}' needs a key of its own",
                     level.column + 1, value),
         {Diagnostics::note(place(level.scalar), "the value is here")});
  fail(here(), fmt::format("the value '{}' cannot continue on a further line", value),
       "write it on one line; long texts go behind '>-' on indented lines",
       {Diagnostics::note(place(level.scalar), "the value begins here")});
}

// A line among the keys of a map that is not 'key: value'.
void SyntaxChecker::not_a_key() {
  if (at_dash())
    fail(here(), "a list item among the keys of a map",
         "indent it more than the key it belongs to, and leave that key without a value");
  std::string_view line = text_.substr(at_, line_end(at_) - at_);
  line = line.substr(0, line.find(" #"));
  line = line.substr(0, line.find_last_not_of(" \t") + 1);
  const Span whole = here(line.size());
  std::size_t name_end = 0;
  while (name_end < line.size() && is_name_character(line[name_end])) ++name_end;
  const std::string name(line.substr(0, name_end));
  const std::string_view rest = line.substr(name_end);
  const std::size_t sign = std::min(rest.find_first_not_of(" \t"), rest.size());
  const auto value_behind = [&](std::size_t length) {
    const std::string_view value = rest.substr(std::min(sign + length, rest.size()));
    return shorten(value.substr(std::min(value.find_first_not_of(" \t"), value.size())));
  };
  if (const CodePoint next = rest.size() > 1 ? decode_utf8(rest, 1) : CodePoint{}; is_unusual_space(next.code))
    fail({at_ + name_end + 1, at_ + name_end + 1 + next.length},
         fmt::format("{} behind '{}:'", describe_character(next.code), name), "replace it by an ordinary space");
  if (!name.empty() && rest.starts_with(':'))
    fail(here(name_end + 1), fmt::format("a space is missing behind '{}:'", name),
         fmt::format("write '{}: {}'", name, value_behind(1)));
  if (!name.empty() && sign < rest.size() && rest[sign] == '=')
    fail({at_ + name_end + sign, at_ + name_end + sign + 1}, fmt::format("'{}' is followed by '='", name),
         fmt::format("write '{}: {}'", name, value_behind(1)));
  if (!name.empty() && rest.substr(sign).starts_with("："))
    fail({at_ + name_end + sign, at_ + name_end + sign + 3}, "this is a full-width colon",
         fmt::format("write '{}: {}'", name, value_behind(3)));
  if (name == line)
    fail(whole, fmt::format("a ':' is missing behind '{}'", name), fmt::format("write '{}: ...'", name));
  fail(whole, "expected 'key: value'", "every line of a map is 'key: value', or 'key:' with indented lines below");
}

void SyntaxChecker::not_an_item() {
  fail(here(), "expected '- ': the lines above in this column are the items of a list",
       "begin with '- ', or indent this line if it belongs to the item above");
}

// The latest entry of a level has nothing behind it and nothing indented below it.
void SyntaxChecker::value_missing(const Level& level) {
  if (level.sequence) {
    report(level.entry, "this list item is empty", "remove the '-', or write the item behind it");
    return;
  }
  const std::size_t resume = at_;
  at_ = level.entry.end;
  skip_blanks();
  ++at_;  // the colon
  skip_blanks();
  const std::string name(slice(level.entry));
  const std::size_t color = color_comment(false);
  const std::string text(text_.substr(std::min(at_, text_.size()), color));
  const Span span = here(color);
  at_ = resume;
  if (color > 0)
    report(span, fmt::format("'{}' without quotes is a comment, so '{}' has no value", text, shorten(name)),
           fmt::format("write {}: '{}'", shorten(name), text));
  else
    report(level.entry, fmt::format("'{}' has no value", shorten(name)),
           "give it a value, indent below it what belongs to it, or remove the line");
}

}  // namespace lekalo::render
