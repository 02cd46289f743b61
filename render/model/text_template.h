// Texts of drawings: TeX with places for numbers.
//
//   '$\mathbf{p}_%i$'            %i      a counter of the place: of the point, of a `repeat` around it
//   '$w_{22} = %(w)$'            %(...)  a formula of parameters and counters
//   'fillet_%02k'                %02k    at least two digits, filled with zeros; %3k: with blanks
//   '%.2(w)'                     %.2     with two decimals
//   '$12\,\%%$'                  %%      a percent sign
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/expression/expression.h"

namespace lekalo::render {

struct TextTemplate {
  struct Part {
    std::string text;                           // as it stands; empty where there is a value
    std::optional<geometry::Expression> value;  // a formula of `counters`
    int width = 0;                              // least number of characters
    bool zeros = false;                         // fill up with zeros instead of blanks
    int decimals = -1;                          // so many; negative: as the number has them
  };
  std::vector<Part> parts;
  std::vector<std::string> counters;  // free in the values, in the order that text() takes them

  // The text for these values of the counters (missing ones are 0). Whole numbers without a point, others with six
  // digits; very large and small ones with a power of ten, in $ signs where the text is no formula.
  std::string text(std::span<const double> values = {}) const;
};

// One place or stretch of text of a template as written, before its formula is understood.
struct TemplatePart {
  std::string text;  // literal text, or the formula
  bool is_value = false;
  bool is_name = false;    // of a value: a bare name without parentheses
  std::size_t offset = 0;  // of the formula in the template, bytes
  int width = 0;
  bool zeros = false;
  int decimals = -1;
};

// What is wrong in a text: where, in bytes, and what to write instead.
struct TextSlip {
  std::size_t offset = 0;
  std::string message;
  std::string hint;
};

// Splits at the percent signs. Of a bare name that runs into further letters (%index of a counter i) the longest
// beginning that is one of `names` counts.
std::optional<TextSlip> split_template(std::string_view text, std::span<const std::string> names,
                                       std::vector<TemplatePart>& parts);

// Unbalanced braces or dollar signs of TeX (`\{`, `\}`, `\$` and `\\` are characters), and what tex.h does not know.
std::optional<TextSlip> check_tex(std::string_view text);

}  // namespace lekalo::render
