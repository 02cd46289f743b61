#include "geometry/expression/tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace lekalo::geometry {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

struct Slip {
  std::string_view written, message, hint;
};

// What people write out of habit from other languages; longer ones first.
constexpr Slip kSlips[] = {
    {"**", "'**' is not an operator", "powers are written with '^': a^b"},
    {"&&", "'&&' is not an operator", "write 'and'"},
    {"||", "'||' is not an operator", "write 'or'"},
    {"&", "'&' is not an operator", "write 'and'"},
    {"|", "'|' is not an operator", "write 'or', or abs(x) for |x|"},
    {"!", "'!' is not an operator", "write 'not'"},
    {"=", "'=' is not an operator", "comparison is written '=='"},
    {"%", "'%' is not an operator", "the remainder is mod(a, b)"},
    {"?", "'?' is not an operator", "a choice is written: a if condition else b"},
    {":", "':' is not an operator", "a choice is written: a if condition else b; a range: a..b"},
    {";", "unexpected ';'", "a formula is one expression"},
    {"[", "a formula has no brackets '['", "use parentheses ( )"},
    {"]", "a formula has no brackets ']'", "use parentheses ( )"},
    {"{", "a formula has no braces '{'", "use parentheses ( ); formulas are not written in TeX"},
    {"}", "a formula has no braces '}'", "use parentheses ( ); formulas are not written in TeX"},
    {"\\", "a formula has no backslash", "formulas are not written in TeX: sqrt(x), sin(x), pi"},
    {"$", "unexpected '$'", "names of parameters stand as they are: a, not $a"},
    {"'", "unexpected quote", "a formula has no text in it"},
    {"\"", "unexpected quote", "a formula has no text in it"},
    {"−", "'−' (U+2212) is not the minus sign of formulas", "write '-'"},
    {"–", "'–' (U+2013) is a dash", "write '-' for minus"},
    {"—", "'—' (U+2014) is a dash", "write '-' for minus"},
    {"×", "'×' (U+00D7) is not an operator", "write '*'"},
    {"·", "'·' (U+00B7) is not an operator", "write '*'"},
    {"÷", "'÷' (U+00F7) is not an operator", "write '/'"},
    {"π", "'π' (U+03C0) is not a name", "write 'pi'"},
    {"°", "'°' (U+00B0) is not a unit", "write 'deg'"},
    {"√", "'√' (U+221A) is not a function", "write sqrt(x)"},
    {"²", "'²' (U+00B2) is not an operator", "write '^2'"},
    {"³", "'³' (U+00B3) is not an operator", "write '^3'"},
    {"≤", "'≤' (U+2264) is not an operator", "write '<='"},
    {"≥", "'≥' (U+2265) is not an operator", "write '>='"},
    {"≠", "'≠' (U+2260) is not an operator", "write '!='"},
    {"∞", "'∞' (U+221E) is not a number", "there are no infinite numbers in formulas"},
    {"\u00A0", "a no-break space (U+00A0) is not a space", "write an ordinary space"},
};

// The UTF-8 character at the start of the text: its bytes and its number; an invalid byte stands for itself.
struct Character {
  std::string_view bytes;
  unsigned number;
};
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xF0 && first < 0xF8 ? 4
                             : first >= 0xE0                 ? 3
                             : first >= 0xC0                 ? 2
                                                             : 0;
  if (length == 0 || length > text.size()) return {text.substr(0, 1), first};
  unsigned number = length == 1 ? first : first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {text.substr(0, 1), first};
    number = number << 6 | (byte(i) & 0x3Fu);
  }
  return {text.substr(0, length), number};
}

class Tokenizer {
 public:
  explicit Tokenizer(std::string_view text) : text_(text) {}

  std::variant<std::vector<Token>, ExpressionError> run() {
    while (true) {
      while (at_ < text_.size() && is_space(text_[at_])) ++at_;
      if (at_ == text_.size()) break;
      const char c = text_[at_];
      std::optional<ExpressionError> error;
      if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
        error = number();
      } else if (is_letter(c)) {
        error = name();
      } else {
        error = symbol();
      }
      if (error) return *error;
    }
    add(TokenKind::end, 0);
    if (const auto error = unbalanced()) return *error;
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void add(TokenKind kind, std::size_t length, double value = 0) {
    tokens_.push_back({kind, at_, text_.substr(at_, length), value});
    at_ += length;
  }
  ExpressionError error(std::string message, std::string hint) const {
    return {at_, std::move(message), std::move(hint)};
  }

  std::optional<ExpressionError> number() {
    std::size_t n = 0;
    const auto digits = [&] {
      const std::size_t before = n;
      while (is_digit(peek(n))) ++n;
      return n - before;
    };
    const std::size_t whole = digits();
    if (peek(0) == '0' && n == 1 && (peek(1) == 'x' || peek(1) == 'X')) {
      return error("hexadecimal numbers are not allowed", "write the number in decimal");
    }
    if (whole > 1 && peek(0) == '0') {
      const std::size_t zeros = std::min(text_.find_first_not_of('0', at_) - at_, whole - 1);
      return error("a number may not begin with a zero",
                   fmt::format("write '{}'", text_.substr(at_ + zeros, whole - zeros)));
    }
    // A point that is followed by another one begins the ".." of a range.
    if (peek(n) == '.' && peek(n + 1) != '.') {
      ++n;
      digits();
      if (peek(n) == '.' && peek(n + 1) != '.') return error("a number has one decimal point", "");
    }
    if (peek(n) == '_') return error("a number has no '_' in it", "write the digits without spaces between them");
    if (peek(n) == 'e' || peek(n) == 'E') {
      const std::size_t sign = peek(n + 1) == '+' || peek(n + 1) == '-' ? 1 : 0;
      if (!is_digit(peek(n + 1 + sign))) {
        return error("an exponent needs digits", "write 2e3 for 2000; there is no constant e, write exp(1)");
      }
      n += 1 + sign;
      digits();
    }
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto parsed = std::from_chars(begin, begin + n, value);
    if (parsed.ec == std::errc::result_out_of_range) {
      // Too small is as good as zero only if it is zero.
      return error(fmt::format("the number {} is outside the range of double precision", text_.substr(at_, n)),
                   "numbers lie between 1e-307 and 1.7e308");
    }
    add(TokenKind::number, n, value);
    return {};
  }

  std::optional<ExpressionError> name() {
    std::size_t n = 0;
    while (is_letter(peek(n)) || is_digit(peek(n))) ++n;
    if (peek(n) == '.' && (is_letter(peek(n + 1)) || is_digit(peek(n + 1)))) {
      std::size_t end = n + 1;
      while (is_letter(peek(end)) || is_digit(peek(end)) || (peek(end) == '.' && peek(end + 1) != '.')) ++end;
      return error(fmt::format("'{}' is not a number: dots join the names of geometry", text_.substr(at_, end)),
                   "formulas know parameters, counters and variables");
    }
    add(TokenKind::name, n);
    return {};
  }

  std::optional<ExpressionError> symbol() {
    const std::string_view rest = text_.substr(at_);
    for (const std::string_view pair : {"<=", ">=", "==", "!=", ".."}) {
      if (rest.starts_with(pair)) {
        add(TokenKind::symbol, pair.size());
        return {};
      }
    }
    for (const Slip& slip : kSlips) {
      if (rest.starts_with(slip.written)) return error(std::string(slip.message), std::string(slip.hint));
    }
    if (std::string_view("+-*/^(),<>").find(rest[0]) != std::string_view::npos) {
      add(TokenKind::symbol, 1);
      return {};
    }
    const Character c = first_character(rest);
    if (c.bytes.size() > 1) {
      return error(fmt::format("unexpected character '{}' (U+{:04X})", c.bytes, c.number),
                   "formulas are written in ASCII letters; some letters of other alphabets look the same");
    }
    if (c.number > ' ' && c.number < 0x7F) return error(fmt::format("unexpected character '{}'", c.bytes), "");
    return error(fmt::format("unexpected byte 0x{:02X}", c.number), "formulas are written in ASCII letters");
  }

  std::optional<ExpressionError> unbalanced() const {
    std::vector<std::size_t> open;
    for (const Token& token : tokens_) {
      if (token.text == "(") open.push_back(token.offset);
      if (token.text != ")") continue;
      if (open.empty()) return ExpressionError{token.offset, "unbalanced parentheses: this ')' closes nothing", ""};
      open.pop_back();
    }
    if (open.empty()) return {};
    return ExpressionError{open.back(), "unbalanced parentheses: this '(' is not closed",
                           "inside [ ] or { } a formula with commas is written in quotes: \"atan2(y, x)\""};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Token> tokens_;
};

}  // namespace

std::variant<std::vector<Token>, ExpressionError> tokenize(std::string_view text) { return Tokenizer(text).run(); }

}  // namespace lekalo::geometry
