// Characters of scene files: UTF-8, display width, and letters of other alphabets that look like Latin ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lekalo::render {

/// One decoded character: `length` bytes of the text; for bytes that are not UTF-8, code is U+FFFD, length 1, valid
/// false.
struct CodePoint {
  char32_t code = 0;
  int length = 1;
  bool valid = true;
};

/// Decodes the character at `text[at]`; `at` must be inside. Overlong forms, surrogates and codes above U+10FFFF are
/// not valid.
CodePoint decode_utf8(std::string_view text, std::size_t at);
std::string encode_utf8(char32_t code);

/// Number of characters; each byte that is not UTF-8 counts as one.
std::size_t count_code_points(std::string_view text);

/// Terminal columns of one character: 0 for combining marks and other invisible ones, 2 for wide East Asian ones and
/// pictographs, else 1.
int display_width(char32_t code);

/// The ASCII letter, digit or sign that `code` is easily mistaken for (Cyrillic, Greek, full-width forms, minus signs).
std::optional<char> latin_look_alike(char32_t code);

/// Spaces and invisible characters other than the ASCII ones (no-break space, zero-width space, ...).
bool is_unusual_space(char32_t code);

/// "the Cyrillic letter 'с' (U+0441)", "the character 'é' (U+00E9)", "the no-break space (U+00A0)".
std::string describe_character(char32_t code);

/// Characters that texts may not hold, since no XML may: control characters other than tab and line feed (those from
/// U+007F on for their own sake), U+FFFE and U+FFFF.
bool is_forbidden(char32_t code);

/// The text between the tags of XML or in an attribute's double quotes. What XML has no place for becomes U+FFFD.
std::string xml_text(std::string_view text);

struct CharacterFault {
  std::size_t offset = 0;  ///< byte offset
  std::size_t length = 1;
  std::string message, hint;
};

/// The first byte or character that no scene file may hold: bytes that are not UTF-8, forbidden characters; UTF-16 is
/// recognized as such.
std::optional<CharacterFault> find_bad_character(std::string_view text);

}  // namespace lekalo::render
