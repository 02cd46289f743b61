#include "render/model/text_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "render/model/numbers.h"
#include "render/model/tex.h"

namespace lekalo::render {

namespace {

constexpr int kWidest = 20;  // %20k, %.20k

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string number_text(double value, int decimals, bool in_formula) {
  if (decimals >= 0) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_of("123456789") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
  }
  if (value == std::nearbyint(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value + 0.0);
  const std::string text = fmt::format("{:.6g}", value);
  const std::size_t power = text.find('e');
  if (power == std::string::npos) return text;
  const std::string tex = times_power_of_ten(text.substr(0, power), std::stoi(text.substr(power + 1)));
  return in_formula ? tex : fmt::format("${}$", tex);
}

// Whether a text that goes on behind this one is in a formula.
bool ends_in_formula(std::string_view text) {
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\\')
      ++i;
    else if (text[i] == '$')
      inside = !inside;
  return inside;
}

// The end of the formula whose parenthesis opens at `open`, or npos.
std::size_t closing(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string_view::npos;
}

}  // namespace

std::string TextTemplate::text(std::span<const double> values) const {
  std::vector<double> arguments(values.begin(), values.end());
  arguments.resize(counters.size(), 0.0);
  std::string result;
  for (const Part& part : parts) {
    if (!part.value) {
      result += part.text;
      continue;
    }
    const std::string number =
        number_text(part.value->evaluate<double>(arguments), part.decimals, ends_in_formula(result));
    const auto missing = part.width - static_cast<int>(number.size());
    const bool negative = part.zeros && number.front() == '-';
    // A script is one thing in TeX: t_12 is t_{1}2.
    const bool script = !result.empty() && (result.back() == '_' || result.back() == '^') && number.size() > 1;
    if (script) result += '{';
    if (negative) result += '-';
    if (missing > 0) result.append(static_cast<std::size_t>(missing), part.zeros ? '0' : ' ');
    result += negative ? number.substr(1) : number;
    if (script) result += '}';
  }
  return result;
}

std::optional<TextSlip> split_template(std::string_view text, std::span<const std::string> names,
                                       std::vector<TemplatePart>& parts) {
  std::string literal;
  const auto flush = [&] {
    if (!literal.empty()) parts.push_back({literal});
    literal.clear();
  };
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '%') {
      literal += text[i++];
      continue;
    }
    const std::size_t percent = i++;
    if (i < text.size() && text[i] == '%') {
      literal += '%';
      ++i;
      continue;
    }
    TemplatePart part;
    part.is_value = true;
    part.zeros = i < text.size() && text[i] == '0';
    while (i < text.size() && is_digit(text[i]) && part.width < 1000) part.width = 10 * part.width + (text[i++] - '0');
    if (part.width > kWidest)
      return TextSlip{percent, fmt::format("a number of more than {} digits", kWidest), "the width stands behind %"};
    if (i < text.size() && text[i] == '.') {
      part.decimals = 0;
      for (++i; i < text.size() && is_digit(text[i]) && part.decimals < 1000; ++i)
        part.decimals = 10 * part.decimals + (text[i] - '0');
    }
    if (part.decimals > kWidest)
      return TextSlip{percent, fmt::format("a number of more than {} decimals", kWidest), "they stand behind %."};
    part.offset = i;
    if (i < text.size() && text[i] == '(') {
      const std::size_t end = closing(text, i);
      if (end == std::string_view::npos)
        return TextSlip{i, "this parenthesis is not closed", "a formula in a text is written %(n + 1)"};
      part.offset = i + 1;
      part.text = text.substr(i + 1, end - i - 1);
      if (part.text.find_first_not_of(' ') == std::string::npos)
        return TextSlip{i, "there is no formula between the parentheses", "write for example %(n + 1)"};
      i = end + 1;
    } else if (i < text.size() && begins_name(text[i])) {
      std::size_t end = i;
      while (end < text.size() && (begins_name(text[end]) || is_digit(text[end]))) ++end;
      const std::string_view whole = text.substr(i, end - i);
      std::size_t length = 0;
      for (const std::string& name : names)
        if (whole.starts_with(name)) length = std::max(length, name.size());
      if (length == 0) length = whole.size();
      part.is_name = true;
      part.text = whole.substr(0, length);
      i += length;
    } else {
      return TextSlip{percent, "a percent sign stands for a number here",
                      "%i is a counter, %(n + 1) a formula, %.2(n) with two decimals, %% a percent sign"};
    }
    flush();
    parts.push_back(std::move(part));
  }
  flush();
  return std::nullopt;
}

std::optional<TextSlip> check_tex(std::string_view text) {
  std::vector<std::size_t> open;  // braces
  std::optional<std::size_t> dollar;
  std::size_t braces_at_dollar = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      if (i + 1 == text.size()) return TextSlip{i, "a backslash with nothing behind it", ""};
      ++i;
    } else if (c == '{') {
      open.push_back(i);
    } else if (c == '}') {
      if (open.empty()) return TextSlip{i, "this brace closes nothing", "a brace as a character is written \\}"};
      open.pop_back();
      if (dollar && open.size() < braces_at_dollar)
        return TextSlip{*dollar, "a formula begins inside braces and does not end there", "put a $ before the brace"};
    } else if (c == '$') {
      if (!dollar) {
        dollar = i;
        braces_at_dollar = open.size();
      } else {
        if (open.size() > braces_at_dollar)
          return TextSlip{open.back(), "this brace is not closed", "inside $ ... $ braces come in pairs"};
        dollar.reset();
      }
    }
  }
  if (dollar && open.size() <= braces_at_dollar)
    return TextSlip{*dollar, "this $ has no partner", "formulas stand between two $; as a character it is written \\$"};
  if (!open.empty()) return TextSlip{open.back(), "this brace is not closed", "a brace as a character is written \\{"};
  const auto parsed = parse_tex(text);
  const auto* slip = std::get_if<TextSlip>(&parsed);
  return slip ? std::optional(*slip) : std::nullopt;
}

}  // namespace lekalo::render
