// Scalars: in quotes and plain; and the small parts that all of the recognizer uses.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "render/scene/values/characters.h"
#include "render/scene/yaml/syntax_checker.h"

namespace lekalo::render {

namespace {

// TeX commands that begin with an escape of double quotes (\b \f \n \r \t).
constexpr std::array<std::string_view, 74> kTexCommands = {
    "bar",    "begin",    "beta",       "bf",           "big",           "bigcap",      "bigcup",
    "Big",    "bigg",     "binom",      "bmod",         "boldmath",      "bold",        "bot",
    "breve",  "bullet",   "boldsymbol", "fbox",         "flat",          "forall",      "frac",
    "nabla",  "ne",       "nearrow",    "neg",          "neq",           "newline",     "ni",
    "nmid",   "nonumber", "normalfont", "not",          "notin",         "nu",          "nwarrow",
    "rangle", "rbrace",   "rceil",      "rfloor",       "rho",           "right",       "rightarrow",
    "rm",     "rVert",    "rvert",      "Rightarrow",   "tan",           "tanh",        "tau",
    "text",   "textbf",   "textit",     "textrm",       "textsf",        "texttt",      "textstyle",
    "tfrac",  "theta",    "therefore",  "thinspace",    "tilde",         "times",       "tiny",
    "to",     "top",      "triangle",   "triangleleft", "triangleright", "thickapprox", "tbinom",
    "rbrack", "ref",      "natural",    "footnotesize"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

const char* meaning_of_escape(char c) {
  switch (c) {
    case 't':
      return "a tab";
    case 'n':
      return "a line break";
    case 'r':
      return "a carriage return";
    case 'b':
      return "a backspace";
    default:
      return "a form feed";
  }
}

}  // namespace

void SyntaxChecker::quoted() {
  const std::size_t begin = at_;
  const char quote = peek();
  bool dollar = false;
  if (quote == '"')
    for (std::size_t i = begin + 1; char_at(i) != '"' && char_at(i) != '\n' && !dollar; ++i) {
      dollar = text_[i] == '$';
      if (text_[i] == '\\') ++i;
    }
  for (++at_;;) {
    const char c = peek();
    if (c == '\n') {
      const std::string hint = quote == '\'' ? "close it; an apostrophe inside single quotes is written twice; "
                                               "long texts go behind '>-' on indented lines"
                                             : "close it; long texts go behind '>-' on indented lines";
      flow_error({begin, begin + 1},
                 fmt::format("this {} quote is not closed on its line", quote == '"' ? "double" : "single"), hint);
    }
    if (c == '\\' && quote == '"') {
      escape(dollar);
      continue;
    }
    ++at_;
    if (c != quote) continue;
    if (quote == '"' || peek() != '\'') return;
    ++at_;  // '' stands for '
  }
}

// JSON's escapes without \b \f \r, which would put control characters into texts.
void SyntaxChecker::escape(bool dollar) {
  const std::size_t at = at_;
  const char c = char_at(at + 1);
  at_ += 2;
  if (c == '"' || c == '\\' || c == '/') return;
  std::size_t end = at + 1;
  while (is_letter(char_at(end))) ++end;
  const std::string command(text_.substr(at + 1, end - at - 1));
  const bool tex = dollar || std::find(kTexCommands.begin(), kTexCommands.end(), command) != kTexCommands.end();
  const Span whole{at, std::max(end, at + 2)};
  if ((c == 'n' || c == 't') && !tex) return;
  const std::string_view digits = text_.substr(std::min(at + 2, text_.size()), 4);
  const bool hex =
      digits.size() == 4 && std::all_of(digits.begin(), digits.end(), [](unsigned char d) { return std::isxdigit(d); });
  if (c == 'u' && !hex && command.size() == 1)
    fail(whole, "'\\u' needs four hexadecimal digits", "write '\\u00e9', or the character itself");
  if (c == 'u' && hex) {
    const unsigned long code = std::stoul(std::string(digits), nullptr, 16);
    const Span number{at, at + 6};
    if (code >= 0xD800 && code < 0xE000)
      fail(number, "half of a surrogate pair", "write the character itself instead of two '\\u' escapes");
    if (is_forbidden(static_cast<char32_t>(code)))
      fail(number, describe_character(static_cast<char32_t>(code)) + " is not allowed in texts", "remove it");
    at_ += 4;
    return;
  }
  if (command.empty() && char_at(at + 1) == '\n')
    fail({at, at + 1}, "this double quote is not closed on its line", "long texts go behind '>-' on indented lines");
  const std::string hint = "write texts with backslashes in single quotes: '$\\theta$'";
  if (c == 'n' || c == 't' || c == 'r' || c == 'b' || c == 'f')
    fail(whole,
         fmt::format("in double quotes '\\{}' is not TeX: '\\{}' stands for {}", command, c, meaning_of_escape(c)),
         hint);
  const CodePoint what = decode_utf8(text_, std::min(at + 1, text_.size() - 1));
  fail(whole, fmt::format("in double quotes '\\{}' means nothing", command.empty() ? encode_utf8(what.code) : command),
       hint);
}

SyntaxChecker::Span SyntaxChecker::plain(bool in_flow) {
  check_first_character(in_flow);
  const std::size_t begin = at_;
  for (; peek() != '\n'; ++at_) {
    const char c = text_[at_];
    if (c == '#' && blank_at(at_ - 1)) break;
    if (in_flow) {
      if (std::string_view(",[]{}").find(c) != std::string_view::npos) break;
      if (c == ':' && (blank_at(at_ + 1) || std::string_view(",[]{}").find(char_at(at_ + 1)) != std::string_view::npos))
        break;
      if (c == '?') fail(here(), "a '?' inside brackets needs quotes", "put the whole value in single quotes");
    } else if (c == ':' && blank_at(at_ + 1)) {
      fail(here(), "a ':' inside a value without quotes",
           "put the whole value in single quotes; or, if it is a key, begin it on the next line, indented");
    }
  }
  Span scalar{begin, at_};
  while (scalar.end > begin && blank_at(scalar.end - 1)) --scalar.end;
  check_plain(scalar, in_flow);
  at_ = scalar.end;
  return scalar;
}

// The signs that YAML gives a meaning at the beginning of a value.
void SyntaxChecker::check_first_character(bool in_flow) {
  const char c = peek();
  const bool ends =
      blank_at(at_ + 1) || (in_flow && std::string_view(",[]{}").find(char_at(at_ + 1)) != std::string_view::npos);
  const char* quotes = "put the value in single quotes if it is text";
  switch (c) {
    case '*':
      fail(here(), "a value cannot begin with '*': to YAML that is an alias, and scene files have none",
           "write a product with its factors on both sides ('2*a'); repeat an entity by its name");
    case '&':
      fail(here(), "a value cannot begin with '&': to YAML that is an anchor, and scene files have none",
           "name the thing in its section and refer to it by the name; 'like: NAME' copies fields");
    case '!':
      fail(here(), "a value cannot begin with '!': to YAML that is a tag, and scene files have none", quotes);
    case '%':
      if (!in_flow && at_ == line_begin_ && std::isupper(static_cast<unsigned char>(char_at(at_ + 1))))
        fail(here(), "a line that begins with '%' is a directive to YAML, and scene files have none",
             "remove this line");
      [[fallthrough]];
    case '@':
    case '`':
      fail(here(), fmt::format("a value without quotes cannot begin with '{}'", c), "put it in single quotes");
    case '|':
    case '>':
      if (in_flow)
        fail(here(), fmt::format("a value without quotes cannot begin with '{}'", c), "put it in single quotes");
      return;
    case '?':
      if (ends || in_flow) fail(here(), "a '?' at the beginning of an entry", "a key is a plain name: 'name: value'");
      return;
    case '-':
      if (in_flow && ends)
        fail(here(), "a '-' with nothing attached to it inside brackets",
             "items in brackets have no dashes; a minus sign stands directly before its number");
      return;
    case ':':
      fail(here(), "there is no key before this ':'", "an entry is 'key: value'");
    case ',':
      fail(here(), "a value cannot begin with ','", quotes);
    case ']':
    case '}':
      fail(here(), fmt::format("'{}' closes a bracket that was never opened", c), "remove it");
    default:
      break;
  }
  const char32_t code = decode_utf8(text_, at_).code;
  if (code == U'“' || code == U'”' || code == U'„' || code == U'«' || code == U'‘' || code == U'’' || code == U'‚')
    fail(here(encode_utf8(code).size()), fmt::format("'{}' is a typographic quote", encode_utf8(code)),
         "write straight quotes: '...'");
}

// YAML's words for nothing.
void SyntaxChecker::check_null(Span scalar) {
  const std::string_view text = slice(scalar);
  if (text == "null" || text == "Null" || text == "NULL" || text == "~")
    report(scalar, fmt::format("'{}' means nothing in scene files", text),
           "leave the entry out to have its default; put the word in quotes if it is text");
}

void SyntaxChecker::check_plain(Span scalar, bool in_flow) {
  const std::string_view text = slice(scalar);
  check_null(scalar);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (static_cast<unsigned char>(text[i]) < 0x80) continue;
    const CodePoint c = decode_utf8(text, i);
    if (is_unusual_space(c.code))
      fail({scalar.begin + i, scalar.begin + i + static_cast<std::size_t>(c.length)},
           describe_character(c.code) + " in a value without quotes", "replace it by an ordinary space, or remove it");
    i += static_cast<std::size_t>(c.length) - 1;
  }
  const auto opened = std::count(text.begin(), text.end(), '('), closed = std::count(text.begin(), text.end(), ')');
  if (!in_flow || opened <= closed || peek() != ',') return;
  // A function with commas: show it with the quotes that it needs.
  std::size_t end = at_;
  for (auto depth = opened - closed; depth > 0 && char_at(end) != '\n'; ++end) {
    if (text_[end] == '(') ++depth;
    if (text_[end] == ')') --depth;
  }
  const std::string_view whole = text_.substr(scalar.begin, end - scalar.begin);
  fail(scalar, fmt::format("'{}' has a '(' without ')'", shorten(text)),
       fmt::format("inside brackets a ',' ends the value; put a function with commas in quotes: '{}'", shorten(whole)));
}

void SyntaxChecker::skip_blanks() {
  while (peek() == ' ' || peek() == '\t') ++at_;
}

void SyntaxChecker::skip_block_blanks() {
  const std::size_t begin = at_;
  skip_blanks();
  const std::size_t tab = text_.substr(begin, at_ - begin).find('\t');
  if (tab != std::string_view::npos && !at_line_end())
    fail({begin + tab, begin + tab + 1}, "a tab before a value", "use spaces; most editors can replace all tabs");
}

void SyntaxChecker::count_node() {
  if (++nodes_ > limits_.nodes)
    fail(here(), fmt::format("this file has more than {} values", limits_.nodes),
         "put long lists of numbers into a table: { file: net.csv }");
}

void SyntaxChecker::check_depth() {
  if (levels_.size() + brackets_.size() >= static_cast<std::size_t>(limits_.depth))
    fail(here(), fmt::format("maps and lists are nested more than {} deep", limits_.depth),
         "give inner things names and refer to them");
}

void SyntaxChecker::report(Span at, const std::string& message, const std::string& hint) {
  diagnostics_.error(place(at), message, hint);
}

void SyntaxChecker::fail(Span at, const std::string& message, const std::string& hint, std::vector<Diagnostic> notes) {
  diagnostics_.error(place(at), message, hint, std::move(notes));
  throw Stop{};
}

}  // namespace lekalo::render
