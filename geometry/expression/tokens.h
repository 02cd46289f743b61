// The words of an expression. Internal to geometry/expression.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "geometry/expression/expression.h"

namespace lekalo::geometry {

enum class TokenKind { number, name, symbol, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::size_t offset = 0;
  std::string_view text;  // a part of the expression's text
  double value = 0;       // of a number
};

// The words of the text and a closing `end`. Errors: characters that no expression has, malformed numbers, unbalanced
// parentheses.
std::variant<std::vector<Token>, ExpressionError> tokenize(std::string_view text);

}  // namespace lekalo::geometry
