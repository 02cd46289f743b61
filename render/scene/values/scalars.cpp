// Booleans, numbers, texts, page lengths and ranges.
#include "render/scene/values/scalars.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "render/scene/values/characters.h"

namespace lekalo::render {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool all_digits(std::string_view text) { return !text.empty() && std::all_of(text.begin(), text.end(), is_digit); }

std::string_view without_sign(std::string_view text) {
  return text.starts_with('-') || text.starts_with('+') ? text.substr(1) : text;
}

std::string_view sign_of(std::string_view text) { return text.substr(0, text.size() - without_sign(text).size()); }

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return fmt::format("'{}'", text);
  std::size_t end = 0;
  while (end < kLongest - 8) end += static_cast<std::size_t>(decode_utf8(text, end).length);
  return fmt::format("'{}...'", text.substr(0, end));
}

// digits [. digits] [e [sign] digits], at least one digit before the exponent.
bool is_decimal(std::string_view text) {
  text = without_sign(text);
  std::size_t i = 0, digits = 0;
  for (; i < text.size() && is_digit(text[i]); ++i) ++digits;
  if (i < text.size() && text[i] == '.')
    for (++i; i < text.size() && is_digit(text[i]); ++i) ++digits;
  if (digits == 0) return false;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
    if (!all_digits(text.substr(i))) return false;
    i = text.size();
  }
  return i == text.size();
}

Slip not_scalar(const Value& value, const char* expected) {
  return {fmt::format("expected {}, found {}", expected, kind_name(value)), ""};
}

// Digits in groups: 1_000, 1'000; decimal comma; a number and a percent sign. `text` has no sign.
std::optional<Slip> grouping_slip(std::string_view sign, std::string_view text) {
  const auto without = [&](std::string_view marks) {
    std::string plain(sign);
    for (char c : text)
      if (marks.find(c) == std::string_view::npos) plain += c;
    return plain;
  };
  if (!is_digit(text.front())) return std::nullopt;
  if (text.find_first_of("_'") != std::string_view::npos && is_decimal(without("_'")))
    return Slip{fmt::format("'{}{}' has separators between its digits", sign, text),
                fmt::format("write {}", without("_'"))};
  const std::size_t comma = text.find(',');
  if (comma != std::string_view::npos && text.find(',', comma + 1) == std::string_view::npos) {
    std::string point(text);
    point[comma] = '.';
    if (is_decimal(point) && is_digit(text[text.size() - 1]))
      return Slip{fmt::format("'{}{}' has a decimal comma", sign, text), fmt::format("write {}{}", sign, point)};
  }
  if (text.back() == '%' && is_decimal(text.substr(0, text.size() - 1)))
    return Slip{fmt::format("'{}{}' is a percentage", sign, text),
                fmt::format("write {}{}/100", sign, text.substr(0, text.size() - 1))};
  return std::nullopt;
}

// Bases other than ten: 0x1F, 0o17, 0b11, 017, 1:30. `text` has no sign.
std::optional<Slip> base_slip(std::string_view sign, std::string_view text) {
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X' || text[1] == 'o' || text[1] == 'b')) {
    const int base = text[1] == 'o' ? 8 : text[1] == 'b' ? 2 : 16;
    unsigned long long number = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data() + 2, end, number, base);
    if (stopped == end && error == std::errc{})
      return Slip{fmt::format("'{}{}' is not a decimal number", sign, text), fmt::format("write {}{}", sign, number)};
  }
  if (text.size() > 1 && text[0] == '0' && is_digit(text[1]) && is_decimal(text)) {
    const std::size_t significant = std::min(text.find_first_not_of('0'), text.size());
    const bool before_point = significant < text.size() && is_digit(text[significant]);
    return Slip{fmt::format("'{}{}' begins with a zero", sign, text),
                fmt::format("write {}{}{}", sign, before_point ? "" : "0", text.substr(significant))};
  }
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos && all_digits(text.substr(0, colon)) && is_decimal(text.substr(colon + 1)))
    return Slip{fmt::format("'{}{}' is not a number", sign, text),
                fmt::format("a ratio is written {}{}/{}", sign, text.substr(0, colon), text.substr(colon + 1))};
  return std::nullopt;
}

}  // namespace

void report(Diagnostics& diagnostics, const Value& value, const Slip& slip) {
  if (!value.invalid) diagnostics.error(value.place, slip.message, slip.hint);
}

Reading<bool> read_boolean(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "true or false");
  const std::string& text = value.text;
  if (value.quoted && (text == "true" || text == "false"))
    return Slip{fmt::format("'{}' in quotes is a text", text), fmt::format("write {} without quotes", text)};
  if (text == "true") return true;
  if (text == "false") return false;
  const std::string word = lower(text);
  constexpr std::array<std::string_view, 5> kTrue{"true", "yes", "on", "y", "1"};
  constexpr std::array<std::string_view, 5> kFalse{"false", "no", "off", "n", "0"};
  if (std::find(kTrue.begin(), kTrue.end(), word) != kTrue.end())
    return Slip{fmt::format("expected true or false, found {}", quote(text)), "write true"};
  if (std::find(kFalse.begin(), kFalse.end(), word) != kFalse.end())
    return Slip{fmt::format("expected true or false, found {}", quote(text)), "write false"};
  return Slip{fmt::format("expected true or false, found {}", quote(text)), ""};
}

std::optional<Slip> number_slip(std::string_view text) {
  text = trim(text);
  if (text.empty()) return std::nullopt;
  if (const CodePoint first = decode_utf8(text, 0); first.code > 0x7F && latin_look_alike(first.code) == '-') {
    const std::string_view rest = trim(text.substr(static_cast<std::size_t>(first.length)));
    if (is_decimal(rest))
      return Slip{fmt::format("{} is not a minus sign", describe_character(first.code)),
                  fmt::format("write -{}", rest)};
  }
  const std::string_view sign = sign_of(text), number = without_sign(text);
  const std::string word = lower(number);
  if (word == ".inf" || word == "inf" || word == "infinity")
    return Slip{fmt::format("'{}' is not a number here", text), "leave the field out, or give a large number"};
  if (word == ".nan" || word == "nan") return Slip{fmt::format("'{}' is not a number here", text), "give a number"};
  if (number.empty()) return std::nullopt;
  if (auto slip = grouping_slip(sign, number)) return slip;
  return base_slip(sign, number);
}

Reading<double> read_number(std::string_view text) {
  if (const auto slip = number_slip(text)) return *slip;
  if (!is_decimal(text)) return Slip{fmt::format("expected a number, found {}", quote(text)), ""};
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range)
    return Slip{fmt::format("{} is beyond the range of numbers", quote(text)), "numbers reach from 1e-307 to 1e307"};
  if (error != std::errc{} || end != text.data() + text.size())
    return Slip{fmt::format("expected a number, found {}", quote(text)), ""};
  return number;
}

Reading<double> read_number(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "a number");
  return read_number(value.text);
}

Reading<int> read_integer(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "an integer");
  const Reading<double> number = read_number(value.text);
  if (!number) return number.slip();
  if (std::trunc(*number) != *number) return Slip{fmt::format("expected an integer, found {}", quote(value.text)), ""};
  if (std::abs(*number) > std::numeric_limits<int>::max())
    return Slip{fmt::format("{} is too large", quote(value.text)), ""};
  return static_cast<int>(*number);
}

Reading<std::string> read_text(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "a text");
  return value.text;
}

Reading<std::string> read_quoted_text(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "a text");
  if (!value.quoted && is_decimal(value.text))
    return Slip{fmt::format("'{0}' without quotes is a number, and {0} could not be told from other ways to write it",
                            value.text),
                fmt::format("write '{}' in quotes", value.text)};
  return value.text;
}

double PageLength::millimetres(double dots_per_inch) const {
  constexpr double kInch = 25.4;  // mm
  switch (unit) {
    case PageUnit::mm:
      return value;
    case PageUnit::pt:
      return value * kInch / 72;
    case PageUnit::px:
      return value * kInch / dots_per_inch;
  }
  return value;
}

Reading<PageLength> read_page_length(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "a length on the page");
  const std::string_view text = trim(value.text);
  std::size_t split = text.size();
  while (split > 0 && std::isalpha(static_cast<unsigned char>(text[split - 1]))) --split;
  const std::string_view unit = text.substr(split), number = trim(text.substr(0, split));
  if (number.empty())
    return Slip{fmt::format("expected a length on the page, found {}", quote(text)),
                "a number with mm, pt or px: 0.5 pt"};
  const Reading<double> amount = read_number(number);
  if (!amount) return amount.slip();
  if (unit == "mm") return PageLength{*amount, PageUnit::mm};
  if (unit == "pt") return PageLength{*amount, PageUnit::pt};
  if (unit == "px") return PageLength{*amount, PageUnit::px};
  if (unit.empty())
    return Slip{fmt::format("the length {} on the page has no unit", quote(text)),
                fmt::format("write {0} mm, {0} pt or {0} px", number)};
  constexpr std::array<std::pair<std::string_view, double>, 5> kMillimetres{
      {{"cm", 10}, {"m", 1000}, {"in", 25.4}, {"inch", 25.4}, {"pc", 25.4 / 6}}};
  for (const auto& [name, factor] : kMillimetres)
    if (unit == name)
      return Slip{fmt::format("'{}' is not a unit of page lengths", unit),
                  fmt::format("write {:.6g} mm", *amount * factor)};
  for (const char* known : {"mm", "pt", "px"})
    if (lower(unit) == known)
      return Slip{fmt::format("'{}' is not a unit of page lengths", unit), fmt::format("write {} {}", number, known)};
  return Slip{fmt::format("'{}' is not a unit of page lengths", unit), "the units are mm, pt and px"};
}

bool is_range(const Value& value) {
  return value.is_scalar() && !value.quoted && value.text.find("..") != std::string::npos;
}

Reading<IntegerRange> read_range(const Value& value) {
  if (!value.is_scalar()) return not_scalar(value, "a range like 0..n-1");
  const std::string_view text = value.text;
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos)
    return Slip{fmt::format("expected a range, found {}", quote(text)), "write it with two dots: 0..n-1"};
  if (text.find("..", dots + 1) != std::string_view::npos)
    return Slip{fmt::format("the range {} has more than two dots", quote(text)),
                "a range is FIRST..LAST, both inclusive: 0..n-1"};
  const auto side = [&](std::size_t begin, std::size_t end, std::string& part, Place& place) {
    const std::string_view raw = text.substr(begin, end - begin);
    const std::size_t skipped = std::min(raw.find_first_not_of(" \t"), raw.size());
    part = trim(raw);
    place = value.place_of(begin + skipped, part.size());
  };
  IntegerRange range;
  side(0, dots, range.first, range.first_place);
  side(dots + 2, text.size(), range.last, range.last_place);
  if (range.first.empty() || range.last.empty())
    return Slip{fmt::format("the range {} has no {}", quote(text), range.first.empty() ? "beginning" : "end"),
                "a range is FIRST..LAST, both inclusive: 0..n-1"};
  return range;
}

}  // namespace lekalo::render
