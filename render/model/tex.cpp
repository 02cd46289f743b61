#include "render/model/tex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "render/scene/values/characters.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

namespace {

using Kind = TexNode::Kind;
using Role = TexNode::Role;

struct Symbol {
  std::string_view name, text;
  Role role = Role::ordinary;
};

constexpr Symbol kSymbols[] = {
    // Greek: small letters are slanted in formulas, capitals upright.
    {"alpha", "α"},
    {"beta", "β"},
    {"gamma", "γ"},
    {"delta", "δ"},
    {"epsilon", "ε"},
    {"varepsilon", "ε"},
    {"zeta", "ζ"},
    {"eta", "η"},
    {"theta", "θ"},
    {"vartheta", "ϑ"},
    {"iota", "ι"},
    {"kappa", "κ"},
    {"lambda", "λ"},
    {"mu", "μ"},
    {"nu", "ν"},
    {"xi", "ξ"},
    {"pi", "π"},
    {"rho", "ρ"},
    {"varrho", "ϱ"},
    {"sigma", "σ"},
    {"varsigma", "ς"},
    {"tau", "τ"},
    {"upsilon", "υ"},
    {"phi", "φ"},
    {"varphi", "φ"},
    {"chi", "χ"},
    {"psi", "ψ"},
    {"omega", "ω"},
    {"Gamma", "Γ"},
    {"Delta", "Δ"},
    {"Theta", "Θ"},
    {"Lambda", "Λ"},
    {"Xi", "Ξ"},
    {"Pi", "Π"},
    {"Sigma", "Σ"},
    {"Upsilon", "Υ"},
    {"Phi", "Φ"},
    {"Psi", "Ψ"},
    {"Omega", "Ω"},
    {"partial", "∂"},
    {"nabla", "∇"},
    {"infty", "∞"},
    {"ell", "ℓ"},
    {"prime", "′"},
    {"emptyset", "∅"},
    {"angle", "∠"},
    {"degree", "°"},
    {"circ", "∘", Role::binary},
    {"forall", "∀"},
    {"exists", "∃"},
    {"ldots", "…"},
    {"dots", "…"},
    {"cdots", "⋯"},
    {"vdots", "⋮"},
    {"hbar", "ħ"},
    {"Re", "ℜ"},
    {"Im", "ℑ"},
    {"cdot", "·", Role::binary},
    {"times", "×", Role::binary},
    {"pm", "±", Role::binary},
    {"mp", "∓", Role::binary},
    {"ast", "∗", Role::binary},
    {"star", "⋆", Role::binary},
    {"cup", "∪", Role::binary},
    {"cap", "∩", Role::binary},
    {"setminus", "∖", Role::binary},
    {"oplus", "⊕", Role::binary},
    {"otimes", "⊗", Role::binary},
    {"wedge", "∧", Role::binary},
    {"vee", "∨", Role::binary},
    {"bullet", "•", Role::binary},
    {"le", "≤", Role::relation},
    {"leq", "≤", Role::relation},
    {"ge", "≥", Role::relation},
    {"geq", "≥", Role::relation},
    {"ne", "≠", Role::relation},
    {"neq", "≠", Role::relation},
    {"ll", "≪", Role::relation},
    {"gg", "≫", Role::relation},
    {"approx", "≈", Role::relation},
    {"equiv", "≡", Role::relation},
    {"sim", "∼", Role::relation},
    {"simeq", "≃", Role::relation},
    {"cong", "≅", Role::relation},
    {"propto", "∝", Role::relation},
    {"in", "∈", Role::relation},
    {"notin", "∉", Role::relation},
    {"subset", "⊂", Role::relation},
    {"subseteq", "⊆", Role::relation},
    {"parallel", "∥", Role::relation},
    {"perp", "⊥", Role::relation},
    {"mid", "∣", Role::relation},
    {"to", "→", Role::relation},
    {"rightarrow", "→", Role::relation},
    {"leftarrow", "←", Role::relation},
    {"leftrightarrow", "↔", Role::relation},
    {"Rightarrow", "⇒", Role::relation},
    {"Leftarrow", "⇐", Role::relation},
    {"Leftrightarrow", "⇔", Role::relation},
    {"mapsto", "↦", Role::relation},
    {"uparrow", "↑", Role::relation},
    {"downarrow", "↓", Role::relation},
    {"sum", "∑", Role::big},
    {"prod", "∏", Role::big},
    {"int", "∫", Role::big},
    {"oint", "∮", Role::big},
    {"langle", "⟨", Role::opening},
    {"rangle", "⟩", Role::closing},
    {"lfloor", "⌊", Role::opening},
    {"rfloor", "⌋", Role::closing},
    {"lceil", "⌈", Role::opening},
    {"rceil", "⌉", Role::closing},
    {"|", "‖"},
    {"colon", ":", Role::punctuation},
    // Behind the names that are written for a character that has several.
    {"varnothing", "∅"},
    {"aleph", "ℵ"},
    {"wp", "℘"},
    {"complement", "∁"},
    {"top", "⊤"},
    {"bot", "⊥"},
    {"neg", "¬"},
    {"lnot", "¬"},
    {"nexists", "∄"},
    {"triangle", "△"},
    {"square", "□"},
    {"blacksquare", "■"},
    {"lozenge", "◊"},
    {"measuredangle", "∡"},
    {"therefore", "∴", Role::relation},
    {"because", "∵", Role::relation},
    {"dagger", "†", Role::binary},
    {"ddagger", "‡", Role::binary},
    {"land", "∧", Role::binary},
    {"lor", "∨", Role::binary},
    {"odot", "⊙", Role::binary},
    {"ominus", "⊖", Role::binary},
    {"oslash", "⊘", Role::binary},
    {"sqcup", "⊔", Role::binary},
    {"sqcap", "⊓", Role::binary},
    {"uplus", "⊎", Role::binary},
    {"diamond", "⋄", Role::binary},
    {"supset", "⊃", Role::relation},
    {"supseteq", "⊇", Role::relation},
    {"ni", "∋", Role::relation},
    {"prec", "≺", Role::relation},
    {"succ", "≻", Role::relation},
    {"asymp", "≍", Role::relation},
    {"doteq", "≐", Role::relation},
    {"triangleq", "≜", Role::relation},
    {"lesssim", "≲", Role::relation},
    {"gtrsim", "≳", Role::relation},
    {"models", "⊨", Role::relation},
    {"vdash", "⊢", Role::relation},
    {"gets", "←", Role::relation},
    {"longrightarrow", "⟶", Role::relation},
    {"longleftarrow", "⟵", Role::relation},
    {"longmapsto", "⟼", Role::relation},
    {"hookrightarrow", "↪", Role::relation},
    {"implies", "⟹", Role::relation},
    {"impliedby", "⟸", Role::relation},
    {"iff", "⟺", Role::relation},
    {"updownarrow", "↕", Role::relation},
    {"Uparrow", "⇑", Role::relation},
    {"Downarrow", "⇓", Role::relation},
    {"nearrow", "↗", Role::relation},
    {"searrow", "↘", Role::relation},
    {"swarrow", "↙", Role::relation},
    {"nwarrow", "↖", Role::relation},
    {"iint", "∬", Role::big},
    {"iiint", "∭", Role::big},
    {"coprod", "∐", Role::big},
    {"bigcup", "⋃", Role::big},
    {"bigcap", "⋂", Role::big},
    {"bigoplus", "⨁", Role::big},
    {"bigotimes", "⨂", Role::big},
    {"vert", "|"},
    {"Vert", "‖"},
    {"lvert", "|", Role::opening},
    {"rvert", "|", Role::closing},
    {"lVert", "‖", Role::opening},
    {"rVert", "‖", Role::closing},
    {"lbrace", "{", Role::opening},
    {"rbrace", "}", Role::closing},
    {"lbrack", "[", Role::opening},
    {"rbrack", "]", Role::closing}};

constexpr std::string_view kFunctions[] = {"sin",  "cos", "tan",  "cot", "arcsin", "arccos", "arctan", "sinh", "cosh",
                                           "tanh", "exp", "ln",   "log", "lim",    "min",    "max",    "sup",  "inf",
                                           "det",  "dim", "arg",  "deg", "sgn",    "rot",    "div",    "grad", "const",
                                           "sec",  "csc", "coth", "ker", "gcd",    "hom",    "Pr",     "lg"};
constexpr std::string_view kAccents[] = {"hat",     "vec",      "bar",       "tilde",          "dot",   "ddot",
                                         "widehat", "overline", "underline", "overrightarrow", "check", "breve",
                                         "acute",   "grave",    "mathring",  "widetilde"};
// Commands that change the letters of their argument.
constexpr std::string_view kFormulaFonts[] = {"mathbf",     "mathrm", "mathit",       "mathsf",  "mathtt",  "mathbb",
                                              "boldsymbol", "bm",     "operatorname", "mathcal", "mathfrak"};
constexpr std::string_view kTextFonts[] = {"textbf", "textit", "emph", "textrm", "textsf", "texttt", "text", "mbox"};
constexpr std::string_view kStructures[] = {"frac", "tfrac", "dfrac", "sqrt", "binom", "left", "right"};
struct Space {
  std::string_view name;
  double em;
};
constexpr Space kSpaces[] = {{",", 1.0 / 6}, {":", 2.0 / 9}, {";", 5.0 / 18}, {"!", -1.0 / 6},
                             {" ", 1.0 / 3}, {"quad", 1},    {"qquad", 2}};
constexpr std::string_view kEscaped = "%${}_&#";

// Alphabets of letters that have places of their own in Unicode: from `capitals` on, and from `small` on (0: capitals
// alone), but for some that were there before.
struct Alphabet {
  std::string_view name;
  char32_t capitals, small;
  std::string_view exceptions;
  std::u32string_view places;  // of these
};
constexpr Alphabet kAlphabets[] = {{"mathbb", 0x1D538, 0, "CHNPQRZ", U"ℂℍℕℙℚℝℤ"},
                                   {"mathcal", 0x1D49C, 0, "BEFHILMR", U"ℬℰℱℋℐℒℳℛ"},
                                   {"mathfrak", 0x1D504, 0x1D51E, "CHIRZ", U"ℭℌℑℜℨ"}};

const Alphabet* alphabet_of(std::string_view command) {
  const auto* const found = std::find_if(std::begin(kAlphabets), std::end(kAlphabets),
                                         [&](const Alphabet& one) { return one.name == command; });
  return found == std::end(kAlphabets) ? nullptr : found;
}

// The letter of an alphabet for a Latin one; empty: it has none.
std::string letter_of(const Alphabet& alphabet, char letter) {
  if (const size_t k = alphabet.exceptions.find(letter); k != std::string_view::npos)
    return encode_utf8(alphabet.places[k]);
  if (letter >= 'A' && letter <= 'Z') return encode_utf8(alphabet.capitals + static_cast<char32_t>(letter - 'A'));
  if (letter >= 'a' && letter <= 'z' && alphabet.small)
    return encode_utf8(alphabet.small + static_cast<char32_t>(letter - 'a'));
  return {};
}

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

// Letters and how they look, as commands around them say.
struct Face {
  bool formula = false;
  bool bold = false;
  enum class Slant { usual, italic, upright } slant = Slant::usual;
  TexNode::Family family = TexNode::Family::roman;
  const Alphabet* alphabet = nullptr;  // null: plain letters
};

class Slip {
 public:
  TextSlip slip;
};

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  TexNode run() {
    TexNode row = text_row(Face(), false);
    if (i_ < text_.size()) fail(i_, "this brace closes nothing", "a brace as a character is \\}");
    return row;
  }

 private:
  [[noreturn]] static void fail(std::size_t at, std::string message, std::string hint) {
    throw Slip{{at, std::move(message), std::move(hint)}};
  }

  bool at_end() const { return i_ >= text_.size(); }
  char here() const { return text_[i_]; }

  // One character, which may be several bytes.
  std::string character() {
    std::size_t end = i_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    std::string result(text_.substr(i_, end - i_));
    i_ = end;
    return result;
  }

  // Behind the backslash.
  std::string command() {
    if (at_end()) fail(i_ - 1, "a backslash at the end", "a command of TeX follows it, like \\alpha");
    if (!std::isalpha(static_cast<unsigned char>(here()))) return character();
    const std::size_t begin = i_;
    while (!at_end() && std::isalpha(static_cast<unsigned char>(here()))) ++i_;
    return std::string(text_.substr(begin, i_ - begin));
  }

  static TexNode symbol(std::string text, Role role, const Face& face) {
    TexNode node;
    node.kind = Kind::symbol;
    node.text = std::move(text);
    node.role = role;
    node.bold = face.bold;
    node.italic = face.slant == Face::Slant::italic;
    node.family = face.family;
    node.in_formula = face.formula;
    return node;
  }
  static TexNode space(double em, const Face& face) {
    TexNode node;
    node.kind = Kind::space;
    node.amount = em;
    node.in_formula = face.formula;
    return node;
  }

  // Characters of a run of text go together, so that pairs of letters are kerned.
  static void add_text(TexNode& row, const std::string& text, const Face& face) {
    if (!row.parts.empty()) {
      TexNode& last = row.parts.back();
      if (last.kind == Kind::symbol && !last.in_formula && last.bold == face.bold && last.family == face.family &&
          last.italic == (face.slant == Face::Slant::italic)) {
        last.text += text;
        return;
      }
    }
    row.parts.push_back(symbol(text, Role::ordinary, face));
  }

  // ---------------------------------------------------------------- text

  TexNode text_row(const Face& face, bool in_braces) {
    TexNode row;
    const std::size_t open = i_;
    while (!at_end()) {
      const char c = here();
      if (c == '}') {
        if (!in_braces) return row;
        ++i_;
        return row;
      }
      if (c == '{') {
        ++i_;
        row.parts.push_back(text_row(face, true));
      } else if (c == '$') {
        const std::size_t begin = i_++;
        Face formula = face;
        formula.formula = true;
        formula.slant = Face::Slant::usual;
        row.parts.push_back(formula_row(formula, '$', begin));
      } else if (c == '\\') {
        ++i_;
        text_command(row, face, i_ - 1);
      } else if (c == '~') {
        ++i_;
        add_text(row, "\u00A0", face);
      } else if (text_.substr(i_, 3) == "---") {
        i_ += 3;
        add_text(row, "—", face);
      } else if (text_.substr(i_, 2) == "--") {
        i_ += 2;
        add_text(row, "–", face);
      } else if (text_.substr(i_, 2) == "``") {
        i_ += 2;
        add_text(row, "“", face);
      } else if (text_.substr(i_, 2) == "''") {
        i_ += 2;
        add_text(row, "”", face);
      } else {
        add_text(row, character(), face);
      }
    }
    if (in_braces) fail(open - 1, "this brace is not closed", "");
    return row;
  }

  void text_command(TexNode& row, const Face& face, std::size_t at) {
    const std::string name = command();
    if (name.size() == 1 && kEscaped.find(name[0]) != std::string_view::npos) return add_text(row, name, face);
    if (name == "\\") fail(at, "a label is one line", "give two labels, or leave out \\\\");
    for (const Space& one : kSpaces)
      if (one.name == name) return row.parts.push_back(space(one.em, face)), void();
    if (contains(kTextFonts, name)) return row.parts.push_back(text_argument(with_font(face, name), at)), void();
    for (const Symbol& one : kSymbols)
      if (one.name == name)
        fail(at, fmt::format("'\\{}' stands in formulas only", name), "put it between dollar signs");
    unknown(name, at, false);
  }

  static Face with_font(Face face, std::string_view name) {
    if (name == "textbf" || name == "mathbf") face.bold = true;
    if (name == "boldsymbol" || name == "bm") face.bold = true;
    if (name == "textit" || name == "mathit") face.slant = Face::Slant::italic;
    if (name == "emph") face.slant = face.slant == Face::Slant::italic ? Face::Slant::upright : Face::Slant::italic;
    if (name == "textrm" || name == "mathrm" || name == "mathbf" || name == "operatorname")
      face.slant = Face::Slant::upright;
    if (name == "textrm" || name == "mathrm") face.family = TexNode::Family::roman, face.bold = false;
    if (name == "textsf" || name == "mathsf") face.family = TexNode::Family::sans, face.slant = Face::Slant::upright;
    if (name == "texttt" || name == "mathtt") face.family = TexNode::Family::mono, face.slant = Face::Slant::upright;
    if (const Alphabet* alphabet = alphabet_of(name)) face.alphabet = alphabet, face.slant = Face::Slant::upright;
    return face;
  }

  TexNode text_argument(Face face, std::size_t at) {
    face.formula = false;
    if (at_end() || here() != '{') fail(at, "braces belong behind this command", "like \\textbf{word}");
    ++i_;
    return text_row(face, true);
  }

  [[noreturn]] static void unknown(const std::string& name, std::size_t at, bool formula) {
    std::vector<std::string> known;
    const auto add = [&](const auto& list) {
      for (const std::string_view one : list) known.emplace_back(one);
    };
    add(kTextFonts);
    if (formula) {
      for (const Symbol& one : kSymbols) known.emplace_back(one.name);
      add(kFunctions), add(kAccents), add(kFormulaFonts), add(kStructures);
    }
    fail(at, fmt::format("labels do not know '\\{}'{}", name, suggestion(name, known)),
         "docs/guide.md lists the part of TeX that labels are written in");
  }

  // ---------------------------------------------------------------- formulas

  // Up to the closing dollar sign, brace, or \right.
  TexNode formula_row(const Face& face, char end, std::size_t begin) {
    TexNode row;
    row.in_formula = true;
    for (;;) {
      if (at_end())
        fail(begin, end == '$' ? "this dollar sign is not closed" : "this is not closed",
             end == '$' ? "a dollar sign as a character is \\$" : "");
      const char c = here();
      if (c == end) {
        ++i_;
        return row;
      }
      if (c == '}') fail(i_, "this brace closes nothing", "a brace as a character is \\}");
      if (c == '$' && end == 'R') fail(begin, "\\left without \\right", "\\right. closes with nothing");
      if (c == '$') fail(i_, "a dollar sign within braces of a formula", "text in a formula is \\text{..}");
      if (end == 'R' && text_.substr(i_, 6) == "\\right") {
        i_ += 6;
        return row;
      }
      if (is_script(c)) {
        if (row.parts.empty()) row.parts.emplace_back();
        add_script(row.parts.back(), face);
        continue;
      }
      if (std::isspace(static_cast<unsigned char>(c))) {
        ++i_;
        continue;
      }
      TexNode next = item(face);
      // A number is one run of digits.
      if (!row.parts.empty() && is_number(next) && is_number(row.parts.back()) && next.bold == row.parts.back().bold &&
          next.family == row.parts.back().family)
        row.parts.back().text += next.text;
      else
        row.parts.push_back(std::move(next));
    }
  }

  static bool is_script(char c) { return c == '_' || c == '^' || c == '\''; }

  static bool is_number(const TexNode& node) {
    return node.kind == Kind::symbol && !node.text.empty() &&
           std::all_of(node.text.begin(), node.text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  }

  static bool is_primes(const TexNode& node) {
    return node.kind == Kind::row && !node.parts.empty() &&
           std::all_of(node.parts.begin(), node.parts.end(), [](const TexNode& one) { return one.text == kPrime; });
  }

  void add_script(TexNode& base, const Face& face) {
    if (base.kind != Kind::scripts) {
      TexNode scripts;
      scripts.kind = Kind::scripts;
      scripts.role = base.role;
      scripts.in_formula = true;
      scripts.parts = {std::move(base), TexNode(), TexNode()};
      base = std::move(scripts);
    }
    const std::size_t at = i_;
    const char c = here();
    ++i_;
    if (c == '\'') {
      TexNode& above = base.parts[2];
      if (!above.parts.empty() && !is_primes(above))
        fail(at, "a prime behind a superscript", "primes come first: x'^2, or x^{2\\prime}");
      above.parts.push_back(symbol(std::string(kPrime), Role::ordinary, face));
      return;
    }
    TexNode& place = base.parts[c == '_' ? 1 : 2];
    if (!place.parts.empty() && !(c == '^' && is_primes(place)))
      fail(at, c == '_' ? "two subscripts at one place" : "two superscripts at one place", "put them into one: x_{ij}");
    place.parts.push_back(argument(face, at));
  }

  // What a script or a command stands for: {..} or one item.
  TexNode argument(const Face& face, std::size_t at) {
    while (!at_end() && std::isspace(static_cast<unsigned char>(here()))) ++i_;
    // LaTeX takes no bare script here, and ^^ for the code of a character.
    if (at_end() || here() == '$' || here() == '}' || is_script(here()))
      fail(at, "something is missing behind this", "like x_{i+1}");
    if (here() == '{') {
      const std::size_t begin = i_++;
      return formula_row(face, '}', begin);
    }
    // %i, %(k+1) of a template is one thing.
    if (here() == '%') {
      const std::size_t begin = i_++;
      while (!at_end() && std::isdigit(static_cast<unsigned char>(here()))) ++i_;
      if (!at_end() && here() == '(') {
        int depth = 0;
        do {
          if (here() == '(') ++depth;
          if (here() == ')') --depth;
          ++i_;
        } while (!at_end() && depth > 0);
      } else {
        while (!at_end() && (std::isalnum(static_cast<unsigned char>(here())))) ++i_;
      }
      return symbol(std::string(text_.substr(begin, i_ - begin)), Role::ordinary, face);
    }
    return item(face);
  }

  TexNode item(const Face& face) {
    const char c = here();
    if (c == '{') {
      const std::size_t begin = i_++;
      return formula_row(face, '}', begin);
    }
    if (c == '\\') {
      ++i_;
      return formula_command(face, i_ - 1);
    }
    if (c == '~') {
      ++i_;
      return space(1.0 / 3, face);
    }
    if (face.alphabet && std::isalpha(static_cast<unsigned char>(c)) && letter_of(*face.alphabet, c).empty())
      fail(i_, fmt::format("\\{} has capital letters alone", face.alphabet->name),
           fmt::format("like \\{}{{{}}}", face.alphabet->name, static_cast<char>(c - 'a' + 'A')));
    return letter(character(), face);
  }

  static TexNode letter(std::string text, const Face& face) {
    Role role = Role::ordinary;
    if (text == "-") text = "−";
    if (text == "*") text = "∗";
    if (text == "+" || text == "−" || text == "∗" || text == "×" || text == "·" || text == "±") role = Role::binary;
    if (text == "=" || text == "<" || text == ">" || text == ":" || text == "≤" || text == "≥" || text == "≠" ||
        text == "≈" || text == "→" || text == "∈")
      role = Role::relation;
    if (text == "(" || text == "[") role = Role::opening;
    if (text == ")" || text == "]") role = Role::closing;
    if (text == "," || text == ";") role = Role::punctuation;
    return styled(std::move(text), role, face);
  }

  // Letters of formulas are slanted: Latin ones and small Greek ones.
  static TexNode styled(std::string text, Role role, const Face& face) {
    const auto first = static_cast<unsigned char>(text[0]);
    const bool latin = text.size() == 1 && std::isalpha(first);
    const bool small_greek =
        text.size() == 2 && ((first == 0xCE && static_cast<unsigned char>(text[1]) >= 0xB1) || first == 0xCF);
    TexNode node = symbol(text, role, face);
    node.italic = face.slant == Face::Slant::italic || (face.slant == Face::Slant::usual && latin) ||
                  (face.slant != Face::Slant::upright && small_greek) ||
                  (small_greek && face.slant == Face::Slant::upright && face.bold);
    if (face.alphabet && latin) node.text = letter_of(*face.alphabet, text[0]);
    return node;
  }

  TexNode formula_command(const Face& face, std::size_t at) {
    const std::string name = command();
    if (name.size() == 1 && kEscaped.find(name[0]) != std::string_view::npos)
      return symbol(name, name == "{" ? Role::opening : name == "}" ? Role::closing : Role::ordinary, face);
    for (const Space& one : kSpaces)
      if (one.name == name) return space(one.em, face);
    for (const Symbol& one : kSymbols)
      if (one.name == name) return styled(std::string(one.text), one.role, face);
    if (contains(kFunctions, name)) {
      Face upright = face;
      upright.slant = Face::Slant::upright;
      return symbol(name, Role::function, upright);
    }
    if (contains(kTextFonts, name)) {
      TexNode row = text_argument(with_font(Face{false, face.bold}, name), at);
      row.in_formula = true;
      return row;
    }
    if (name == "operatorname") {
      TexNode row = argument(with_font(face, name), at);
      row.role = Role::function;
      return row;
    }
    if (contains(kFormulaFonts, name)) return argument(with_font(face, name), at);
    if (contains(kAccents, name)) {
      TexNode node;
      node.kind = Kind::accent;
      node.in_formula = true;
      node.text = name == "widehat" ? "hat" : name == "overrightarrow" ? "vec" : name;
      node.bold = face.bold;
      node.parts = {argument(face, at)};
      return node;
    }
    if (name == "frac" || name == "tfrac" || name == "dfrac" || name == "binom") {
      TexNode node;
      node.kind = Kind::fraction;
      node.in_formula = true;
      node.amount = name == "binom" ? 0 : 1;
      node.text = name == "dfrac" ? "large" : "";
      node.parts.push_back(argument(face, at));
      node.parts.push_back(argument(face, at));
      if (name != "binom") return node;
      TexNode fenced;
      fenced.kind = Kind::fenced;
      fenced.in_formula = true;
      fenced.text = "(", fenced.closing = ")";
      fenced.parts = {std::move(node)};
      return fenced;
    }
    if (name == "sqrt") {
      TexNode node;
      if (!at_end() && here() == '[') fail(at, "labels know square roots only", "write a power: x^{1/3}");
      node.kind = Kind::root;
      node.in_formula = true;
      node.parts = {argument(face, at)};
      return node;
    }
    if (name == "left") {
      TexNode node;
      node.kind = Kind::fenced;
      node.in_formula = true;
      node.text = fence(at);
      node.parts = {formula_row(face, 'R', at)};
      node.closing = fence(at);
      return node;
    }
    if (name == "right") fail(at, "\\right without \\left", "");
    unknown(name, at, true);
  }

  std::string fence(std::size_t at) {
    while (!at_end() && here() == ' ') ++i_;
    std::string text = at_end() ? "" : character();
    if (text == "\\") {
      const std::string name = command();
      if (name == "{" || name == "}") return name;
      for (const Symbol& one : kSymbols)
        if (one.name == name && (one.role == Role::opening || one.role == Role::closing || name == "|"))
          return std::string(one.text);
    }
    if (text == ".") return {};
    if (text.size() == 1 && std::string_view("()[]|/<>").find(text[0]) != std::string_view::npos) return text;
    fail(at, "a bracket belongs behind \\left and \\right", "\\left( .. \\right)");
  }

  std::string_view text_;
  std::size_t i_ = 0;
};

}  // namespace

std::string formula_command_of(std::string_view character) {
  // LaTeX has no \degree of its own.
  if (character == "°") return "^\\circ";
  for (const Symbol& one : kSymbols)
    if (one.text == character) return fmt::format("\\{}", one.name);
  for (const Alphabet& alphabet : kAlphabets)
    for (const char first : {'A', 'a'})
      for (char letter = first; letter < first + 26; ++letter)
        if (letter_of(alphabet, letter) == character) return fmt::format("\\{}{{{}}}", alphabet.name, letter);
  return {};
}

bool takes_text(std::string_view command) { return contains(kTextFonts, command); }

std::variant<TexNode, TextSlip> parse_tex(std::string_view text) {
  try {
    return Parser(text).run();
  } catch (const Slip& slip) {
    return slip.slip;
  }
}

}  // namespace lekalo::render
