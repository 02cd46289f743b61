// UTF-8 after The Unicode Standard, table 3-7 (well-formed byte sequences); widths after Unicode Standard Annex 11,
// reduced to the ranges that text in figures meets.
#include "render/scene/values/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace lekalo::render {

CodePoint decode_utf8(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const CodePoint wrong{0xFFFD, 1, false};
  const unsigned lead = byte(0);
  if (lead < 0x80) return {static_cast<char32_t>(lead), 1, true};
  int length = 0;
  char32_t code = 0, least = 0;
  if (lead >= 0xC2 && lead <= 0xDF) length = 2, code = lead & 0x1F, least = 0x80;
  if (lead >= 0xE0 && lead <= 0xEF) length = 3, code = lead & 0x0F, least = 0x800;
  if (lead >= 0xF0 && lead <= 0xF4) length = 4, code = lead & 0x07, least = 0x10000;
  if (length == 0) return wrong;
  for (int i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return wrong;
    code = code << 6 | (byte(i) & 0x3F);
  }
  if (code < least || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return wrong;
  return {code, length, true};
}

std::string encode_utf8(char32_t code) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0 | code >> 6), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xE0 | code >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

std::size_t count_code_points(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count)
    i += static_cast<unsigned char>(text[i]) < 0x80 ? 1 : decode_utf8(text, i).length;
  return count;
}

namespace {

struct CodeRange {
  char32_t first, last;
};

template <std::size_t n>
bool contains(const std::array<CodeRange, n>& ranges, char32_t code) {
  return std::any_of(ranges.begin(), ranges.end(), [&](CodeRange r) { return r.first <= code && code <= r.last; });
}

constexpr std::array<CodeRange, 8> kInvisible{{{0x300, 0x36F},
                                               {0x483, 0x489},
                                               {0x200B, 0x200F},
                                               {0x202A, 0x202E},
                                               {0x2060, 0x206F},
                                               {0x20D0, 0x20F0},
                                               {0xFE00, 0xFE0F},
                                               {0xFEFF, 0xFEFF}}};
constexpr std::array<CodeRange, 8> kWide{{{0x1100, 0x115F},
                                          {0x2E80, 0xA4CF},
                                          {0xAC00, 0xD7A3},
                                          {0xF900, 0xFAFF},
                                          {0xFE30, 0xFE6F},
                                          {0xFF00, 0xFF60},
                                          {0x1F300, 0x1FAFF},
                                          {0x20000, 0x3FFFD}}};

// Pairs (look-alike, Latin) in Unicode order.
constexpr std::array<std::pair<char32_t, char>, 63> kLookAlikes{{
    {U'Α', 'A'}, {U'Β', 'B'}, {U'Ε', 'E'}, {U'Ζ', 'Z'}, {U'Η', 'H'}, {U'Ι', 'I'}, {U'Κ', 'K'}, {U'Μ', 'M'}, {U'Ν', 'N'},
    {U'Ο', 'O'}, {U'Ρ', 'P'}, {U'Τ', 'T'}, {U'Υ', 'Y'}, {U'Χ', 'X'}, {U'α', 'a'}, {U'ι', 'i'}, {U'κ', 'k'}, {U'ν', 'v'},
    {U'ο', 'o'}, {U'ρ', 'p'}, {U'υ', 'u'}, {U'χ', 'x'}, {U'Ѕ', 'S'}, {U'І', 'I'}, {U'Ј', 'J'}, {U'А', 'A'}, {U'В', 'B'},
    {U'Е', 'E'}, {U'З', '3'}, {U'К', 'K'}, {U'М', 'M'}, {U'Н', 'H'}, {U'О', 'O'}, {U'Р', 'P'}, {U'С', 'C'}, {U'Т', 'T'},
    {U'У', 'Y'}, {U'Х', 'X'}, {U'а', 'a'}, {U'г', 'r'}, {U'е', 'e'}, {U'к', 'k'}, {U'м', 'm'}, {U'н', 'h'}, {U'о', 'o'},
    {U'п', 'n'}, {U'р', 'p'}, {U'с', 'c'}, {U'т', 't'}, {U'у', 'y'}, {U'х', 'x'}, {U'ѕ', 's'}, {U'і', 'i'}, {U'ј', 'j'},
    {U'ԁ', 'd'}, {U'ԛ', 'q'}, {U'ԝ', 'w'}, {U'‐', '-'}, {U'‑', '-'}, {U'–', '-'}, {U'—', '-'}, {U'−', '-'}, {U'∗', '*'},
}};

}  // namespace

int display_width(char32_t code) {
  if (code < 0x300) return 1;
  if (contains(kInvisible, code)) return 0;
  return contains(kWide, code) ? 2 : 1;
}

std::optional<char> latin_look_alike(char32_t code) {
  if (code >= 0xFF01 && code <= 0xFF5E) return static_cast<char>(code - 0xFF01 + '!');  // full-width forms
  const auto found =
      std::find_if(kLookAlikes.begin(), kLookAlikes.end(), [&](auto pair) { return pair.first == code; });
  return found == kLookAlikes.end() ? std::nullopt : std::optional<char>(found->second);
}

bool is_unusual_space(char32_t code) {
  return code == 0x85 || code == 0xA0 || code == 0xAD || code == 0x1680 || (code >= 0x2000 && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202F) || (code >= 0x205F && code <= 0x206F) || code == 0x3000 || code == 0xFEFF;
}

std::string describe_character(char32_t code) {
  const std::string number = fmt::format("U+{:04X}", static_cast<std::uint32_t>(code));
  if (code == 0xA0) return "the no-break space (" + number + ")";
  if (is_unusual_space(code)) return "the invisible character " + number;
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return "the control character " + number;
  if (is_forbidden(code)) return "the character " + number;
  const char* kind = "character";
  if (code >= 0x370 && code <= 0x3FF) kind = "Greek letter";
  if (code >= 0x400 && code <= 0x52F) kind = "Cyrillic letter";
  if (code >= 0xFF01 && code <= 0xFF5E) kind = "full-width character";
  return fmt::format("the {} '{}' ({})", kind, encode_utf8(code), number);
}

bool is_forbidden(char32_t code) {
  return (code < 0x20 && code != '\t' && code != '\n') || (code >= 0x7F && code < 0xA0) || code == 0xFFFE ||
         code == 0xFFFF;
}

std::string xml_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint c = decode_utf8(text, i);
    if (c.code == '&')
      result += "&amp;";
    else if (c.code == '<')
      result += "&lt;";
    else if (c.code == '>')
      result += "&gt;";
    else if (c.code == '"')
      result += "&quot;";
    else if (c.code == '\n')
      result += "&#10;";
    else if (c.code == '\t')
      result += "&#9;";
    else if (!c.valid || is_forbidden(c.code))
      result += encode_utf8(0xFFFD);
    else
      result += text.substr(i, static_cast<std::size_t>(c.length));
    i += static_cast<std::size_t>(c.length);
  }
  return result;
}

std::optional<CharacterFault> find_bad_character(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return CharacterFault{0, 1, "this file is UTF-16, not UTF-8", "save it as UTF-8"};
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x20 && byte < 0x7F) {
      ++i;
      continue;
    }
    const CodePoint c = decode_utf8(text, i);
    const auto length = static_cast<std::size_t>(c.length);
    if (!c.valid)
      return CharacterFault{i, 1, fmt::format("byte 0x{:02X} is not UTF-8", byte), "save the file as UTF-8"};
    if (c.code == 0)
      return CharacterFault{i, 1, "this file holds a zero byte: it is not a text file",
                            "scene files are plain UTF-8 text"};
    if (is_forbidden(c.code))
      return CharacterFault{i, length, describe_character(c.code) + " is not allowed in a scene file", "remove it"};
    i += length;
  }
  return std::nullopt;
}

}  // namespace lekalo::render
