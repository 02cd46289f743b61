// Showing diagnostics: header, source line with a caret below, hint, notes.
#include "render/scene/values/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "render/scene/values/characters.h"

namespace lekalo::render {

namespace {

// Findings beyond this are only counted: a broken file of millions of values must not fill the memory with messages.
constexpr std::size_t kStoredLimit = 2000;
constexpr int kShownColumns = 110;  // longer lines are shown through a window around the caret
constexpr int kColumnsBefore = 60;  // of which this much may stand before the caret
constexpr int kTabColumns = 4;

struct Cell {
  std::string text;
  int width;
};

Cell cell_of(CodePoint c) {
  if (c.code == '\t') return {std::string(kTabColumns, ' '), kTabColumns};
  if (!c.valid || c.code < 0x20 || (c.code >= 0x7F && c.code < 0xA0)) return {"\xEF\xBF\xBD", 1};
  return {encode_utf8(c.code), display_width(c.code)};
}

// The line and the caret line below it. Only a window of the line is decoded into cells, so that a line of any length
// costs no memory.
std::string show_line(const Place& place) {
  const std::string_view line = place.file->line(place.line);
  const int first = std::max(0, place.column - 1 - kColumnsBefore);
  std::string shown, caret;
  int column = 0, width = 0;
  bool cut_behind = false;
  for (std::size_t i = 0; i < line.size(); ++column) {
    const CodePoint c = decode_utf8(line, i);
    i += static_cast<std::size_t>(c.length);
    if (column < first) continue;
    const Cell cell = cell_of(c);
    if (width + cell.width > kShownColumns) {
      cut_behind = true;
      break;
    }
    shown += cell.text;
    width += cell.width;
    if (column < place.column - 1) {
      caret.append(static_cast<std::size_t>(cell.width), ' ');
    } else if (column < place.column - 1 + place.length) {
      if (column == place.column - 1 && cell.width > 0) {
        caret += '^';
        caret.append(static_cast<std::size_t>(cell.width) - 1, '~');
      } else {
        caret.append(static_cast<std::size_t>(cell.width), '~');
      }
    }
  }
  if (column <= place.column - 1) caret += '^';  // a place behind the last character
  if (caret.find_first_not_of(' ') == std::string::npos) caret += '^';
  const std::string before = first > 0 ? "..." : "";
  return fmt::format("    {}{}{}\n    {}{}\n", before, shown, cut_behind ? "..." : "", std::string(before.size(), ' '),
                     caret);
}

std::string position(const Place& place) {
  if (!place.file) return {};
  // The text of an option of the command is one line, which needs no number.
  if (place.line == 0 || place.file->name.starts_with("--")) return place.file->name + ": ";
  return fmt::format("{}:{}:{}: ", place.file->name, place.line, place.column);
}

void append(std::string& out, const Diagnostic& d) {
  const char* kind = d.severity == Severity::warning ? "warning: " : d.severity == Severity::note ? "note: " : "";
  out += position(d.place) + kind + d.message + "\n";
  if (d.place.file && d.place.line > 0) out += show_line(d.place);
  if (!d.hint.empty()) out += "hint: " + d.hint + "\n";
  for (const Diagnostic& note : d.notes) append(out, note);
}

void append_inclusion(std::string& out, const Place& place) {
  if (!place.file) return;
  for (Place from = place.file->included_from; from.file; from = from.file->included_from)
    out += position(from) + "note: included from here\n";
}

}  // namespace

void Diagnostics::add(Diagnostic diagnostic) {
  const bool is_error = diagnostic.severity == Severity::error;
  if (is_error) ++error_count_;
  if (found_.size() < kStoredLimit)
    found_.push_back(std::move(diagnostic));
  else
    ++dropped_;
}

void Diagnostics::error(const Place& place, std::string message, std::string hint, std::vector<Diagnostic> notes) {
  add({Severity::error, place, std::move(message), std::move(hint), std::move(notes)});
}

void Diagnostics::warning(const Place& place, std::string message, std::string hint, std::vector<Diagnostic> notes) {
  add({Severity::warning, place, std::move(message), std::move(hint), std::move(notes)});
}

void Diagnostics::unreadable(const Place& place, std::string message, std::string hint) {
  cannot_read_ = true;
  error(place, std::move(message), std::move(hint));
}

Diagnostic Diagnostics::note(const Place& place, std::string message) {
  return {Severity::note, place, std::move(message), {}, {}};
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::map<const SourceFile*, int> order;
  for (const Diagnostic& d : found_) order.emplace(d.place.file.get(), static_cast<int>(order.size()));
  const auto position_of = [&](const Diagnostic& d) {
    return std::tuple(order.at(d.place.file.get()), d.place.line, d.place.column);
  };
  std::vector<Diagnostic> result = found_;
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return position_of(a) < position_of(b); });
  const auto same = [&](const Diagnostic& a, const Diagnostic& b) {
    return position_of(a) == position_of(b) && a.message == b.message;
  };
  // Equal messages of one place need not be neighbours: others of the same place may stand between.
  std::vector<Diagnostic> unique;
  for (Diagnostic& d : result) {
    bool seen = false;
    for (auto u = unique.rbegin(); u != unique.rend() && position_of(*u) == position_of(d) && !seen; ++u)
      seen = same(*u, d);
    if (!seen) unique.push_back(std::move(d));
  }
  return unique;
}

std::string replacement_of(const Diagnostic& diagnostic) {
  constexpr std::string_view begin = "did you mean '", end = "'?";
  for (const std::string* text : {&diagnostic.message, &diagnostic.hint}) {
    const std::size_t found = text->rfind(begin);
    if (found == std::string::npos) continue;
    const std::string word = text->substr(found + begin.size());
    const std::size_t length = word.find('\'');
    if (length != std::string::npos && word.compare(length, end.size(), end) == 0) return word.substr(0, length);
  }
  return {};
}

std::string Diagnostics::text() const {
  const std::vector<Diagnostic> all = sorted();
  std::string out;
  for (std::size_t i = 0; i < std::min(all.size(), kShownLimit); ++i) {
    append(out, all[i]);
    append_inclusion(out, all[i].place);
  }
  const std::size_t more = dropped_ + (all.size() > kShownLimit ? all.size() - kShownLimit : 0);
  if (more > 0) out += fmt::format("and {} more\n", more);
  return out;
}

}  // namespace lekalo::render
