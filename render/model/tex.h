// The part of TeX that labels are written in: text with $formulas$ in it.
//
//   text      \textbf{..} \textit{..} \emph{..} \textrm{..} \texttt{..} \textsf{..}; -- and --- dashes, `` '' quotes,
//             ~ a blank that holds, \, \; \: \! \quad \qquad and "\ " blanks, \% \$ \{ \} \_ \& \# \\ characters
//   formulas  x_{i+1}^{(k)}, primes, \frac{a}{b}, \tfrac, \dfrac, \sqrt{x}, \binom{n}{k}, \left( .. \right),
//             \mathbf \mathrm \mathit \mathsf \mathtt \mathbb \mathcal \mathfrak \boldsymbol \text{..}, \hat \check
//             \vec \bar \tilde \widetilde \breve \acute \grave \mathring \dot \ddot \overline \underline, Greek
//             letters, the signs of symbols(), names of functions (\sin, \lim, ...)
//
// Only what a label can do: no macros, no alignments. Names and meanings are those of LaTeX, so that LaTeX may set the
// same text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "render/model/text_template.h"

namespace lekalo::render {

// The sign for a prime, whose glyphs are raised and small as they are.
inline constexpr std::string_view kPrime = "′";

struct TexNode {
  enum class Kind {
    row,       // parts one after another
    symbol,    // `text`, of class `role`
    space,     // of `amount` em
    fraction,  // parts: above, below; amount 0: without a bar (binomials)
    root,      // parts: what stands under it
    scripts,   // parts: base, below, above; empty rows where there is none
    accent,    // `text` over parts[0]: hat vec bar tilde dot ddot overline underline
    fenced     // `text` opens, `closing` closes as tall as parts[0]
  };
  // How far apart neighbours stand (The TeXbook, chapter 18).
  enum class Role { ordinary, function, binary, relation, opening, closing, punctuation, big };
  enum class Family { roman, sans, mono };

  Kind kind = Kind::row;
  Role role = Role::ordinary;
  std::string text, closing;
  bool italic = false, bold = false;
  Family family = Family::roman;
  bool in_formula = false;
  double amount = 0;
  std::vector<TexNode> parts;
};

// What LaTeX writes in a formula for a character that is not ASCII ("≤": \le); empty if labels have no command for it.
std::string formula_command_of(std::string_view character);

// Whether the argument of this command (without its backslash) is text, also within a formula.
bool takes_text(std::string_view command);

// The text as a row, or what is wrong in it, where. `percent`: a percent sign begins a template (text_template.h) and
// stands for a number.
std::variant<TexNode, TextSlip> parse_tex(std::string_view text);

}  // namespace lekalo::render
