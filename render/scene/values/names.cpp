// Names: identifiers, members, keys; letters of other alphabets are named.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "render/scene/values/characters.h"
#include "render/scene/values/scalars.h"

namespace lekalo::render {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t end = 0;
  while (end < text.size() && end < kLongest) end += static_cast<std::size_t>(decode_utf8(text, end).length);
  return fmt::format("'{}{}'", text.substr(0, end), end < text.size() ? "..." : "");
}

// What the text would be with Latin letters in place of their doubles.
std::string latinized(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint c = decode_utf8(text, i);
    const auto double_of = c.code > 0x7F ? latin_look_alike(c.code) : std::nullopt;
    if (double_of)
      result += *double_of;
    else
      result += text.substr(i, static_cast<std::size_t>(c.length));
    i += static_cast<std::size_t>(c.length);
  }
  return result;
}

std::optional<Slip> letter_slip(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint c = decode_utf8(text, i);
    i += static_cast<std::size_t>(c.length);
    if (c.code < 0x80) continue;
    if (const auto latin = latin_look_alike(c.code))
      return Slip{fmt::format("{} contains {}, which looks like '{}'", quote(text), describe_character(c.code), *latin),
                  fmt::format("write {} with ASCII letters", quote(latinized(text)))};
    return Slip{fmt::format("{} contains {}", quote(text), describe_character(c.code)),
                "names consist of the letters a-z and A-Z, digits and _"};
  }
  return std::nullopt;
}

// A name in ASCII letters; `members` lets dots and, behind them, numbers through.
std::optional<Slip> name_slip(std::string_view text, bool members, const char* what) {
  if (text.empty()) return Slip{fmt::format("{} is empty", what), "names consist of letters, digits and _"};
  if (const auto slip = letter_slip(text)) return slip;
  constexpr const char* kRule = "names consist of letters, digits and _, and begin with a letter or _";
  std::string cure(text);
  std::replace_if(
      cure.begin(), cure.end(), [](char c) { return c == '-' || c == ' '; }, '_');
  const bool cured = cure != text && !name_slip(cure, members, what);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = members ? std::min(text.find('.', begin), text.size()) : text.size();
    const std::string_view part = text.substr(begin, end - begin);
    if (part.empty())
      return Slip{fmt::format("{} has a dot with nothing {} it", quote(text), begin == 0 ? "before" : "behind"),
                  "members are written NAME.MEMBER: hole.3"};
    const auto wrong = std::find_if(part.begin(), part.end(), [](char c) { return !is_letter(c) && !is_digit(c); });
    if (wrong != part.end())
      return Slip{fmt::format("'{}' cannot be part of {}: {}", *wrong, what, quote(text)),
                  cured ? fmt::format("write {}", quote(cure)) : kRule};
    const bool number = std::all_of(part.begin(), part.end(), is_digit);
    if (is_digit(part.front()) && (begin == 0 || !number))
      return Slip{fmt::format("{} begins with a digit", quote(begin == 0 ? text : part)), kRule};
    begin = end + 1;
  }
  return std::nullopt;
}

Reading<std::string> name_reading(const Value& value, bool members) {
  if (!value.is_scalar()) return Slip{fmt::format("expected a name, found {}", kind_name(value)), ""};
  if (auto slip = name_slip(value.text, members, "a name")) return std::move(*slip);
  return value.text;
}

}  // namespace

Reading<std::string> read_name(const Value& value) { return name_reading(value, false); }

Reading<std::string> read_reference(const Value& value) { return name_reading(value, true); }

std::optional<Slip> key_slip(const Value& key) {
  if (!key.is_scalar()) return Slip{fmt::format("a key is a name, not {}", kind_name(key)), ""};
  if (key.text == "<<")
    return Slip{"scene files have no merge key '<<'", "'like: NAME' copies the fields of another entity"};
  return name_slip(key.text, true, "a key");
}

}  // namespace lekalo::render
