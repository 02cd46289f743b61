// Recursive descent over the grammar of expression.h; each level writes its operator behind its operands.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "geometry/expression/expression.h"
#include "geometry/expression/nearest_name.h"
#include "geometry/expression/operations.h"
#include "geometry/expression/tokens.h"

namespace lekalo::geometry {
namespace {

constexpr std::string_view kChoiceHint = "a choice is written: a if condition else b";

struct Abroad {
  std::string_view name, hint;
};
// Functions as other languages call them.
constexpr Abroad kAbroad[] = {
    {"ln", "the natural logarithm is log(x)"},
    {"arcsin", "write asin(x)"},
    {"arccos", "write acos(x)"},
    {"arctan", "write atan(x)"},
    {"arctan2", "write atan2(y, x)"},
    {"arctg", "write atan(x)"},
    {"tg", "write tan(x)"},
    {"ctg", "write 1/tan(x)"},
    {"cot", "write 1/tan(x)"},
    {"sec", "write 1/cos(x)"},
    {"csc", "write 1/sin(x)"},
    {"sh", "write sinh(x)"},
    {"ch", "write cosh(x)"},
    {"th", "write tanh(x)"},
    {"pow", "powers are written with '^': a^b"},
    {"sqr", "write x^2"},
    {"fabs", "write abs(x)"},
    {"sgn", "write sign(x)"},
    {"fmod", "write mod(a, b)"},
    {"lg", "write log10(x)"},
    {"log2", "write log(x)/log(2)"},
    {"int", "write floor(x) or round(x)"},
    {"trunc", "write sign(x)*floor(abs(x))"},
    {"degrees", "angles carry units: x/(1 deg) is x in degrees"},
    {"radians", "angles carry units: '(x) deg'"},
    {"norm", "write hypot(x, y, z)"},
};

constexpr std::array<std::string_view, 12> kOtherUnits{"mm", "cm", "m",    "km", "um",      "pt",
                                                       "px", "in", "inch", "ft", "degrees", "grad"};

template <class Words>
bool among(std::string_view word, const Words& words) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

bool is_keyword(std::string_view word) {
  return among(word, std::array<std::string_view, 5>{"if", "else", "and", "or", "not"});
}

std::string shown(const Token& token) {
  return token.kind == TokenKind::end ? "the end" : fmt::format("'{}'", token.text);
}

}  // namespace

class ExpressionParser {
 public:
  explicit ExpressionParser(std::string_view text) : whole_(text) {}

  std::optional<ExpressionError> start() {
    if (whole_.size() > Expression::kLongest) {
      return ExpressionError{Expression::kLongest,
                             fmt::format("the formula is longer than {} characters", Expression::kLongest),
                             "give parts of it names under 'parameters'"};
    }
    auto tokens = tokenize(whole_);
    if (auto* error = std::get_if<ExpressionError>(&tokens)) return *error;
    tokens_ = std::move(std::get<std::vector<Token>>(tokens));
    if (tokens_.front().kind == TokenKind::end)
      return ExpressionError{0, "the formula is empty", "write a number or a formula"};
    return {};
  }

  // One expression from the present token on. After an error the parser is of no more use.
  std::variant<Expression, ExpressionError> one() {
    result_ = Expression();
    const std::size_t begin = token().offset;
    if (!choice()) return error_;
    result_.text_ = std::string(whole_.substr(begin, last_end_ - begin));
    if (result_.names_.empty()) {
      if (auto error = result_.bind({})) return *error;
    }
    return std::move(result_);
  }

  bool accept(std::string_view text) {
    if (token().kind == TokenKind::end || token().kind == TokenKind::number || token().text != text) return false;
    advance();
    return true;
  }

  // What stands where the expression should have ended.
  ExpressionError unexpected() const {
    const Token& t = token();
    if (t.text == ",") {
      const bool decimal =
          at_ > 0 && tokens_[at_ - 1].kind == TokenKind::number && tokens_[at_ + 1].kind == TokenKind::number;
      return {t.offset, "unexpected ','",
              decimal
                  ? fmt::format("a decimal point is written '.': {}.{}", tokens_[at_ - 1].text, tokens_[at_ + 1].text)
                  : "commas separate the arguments of functions only"};
    }
    if (t.text == "..") return {t.offset, "a range 'a..b' is not allowed here", "write one number"};
    if (t.text == "else") return {t.offset, "'else' without 'if'", std::string(kChoiceHint)};
    return {t.offset, fmt::format("unexpected {}", shown(t)), ""};
  }
  bool at_end() const { return token().kind == TokenKind::end; }

 private:
  // Counts the nesting, so that no text can exhaust the stack.
  class Level {
   public:
    explicit Level(ExpressionParser& parser) : parser_(parser) { ++parser_.depth_; }
    ~Level() { --parser_.depth_; }
    bool too_deep() const {
      return parser_.depth_ > Expression::kDeepest &&
             !parser_.fail(parser_.token().offset,
                           fmt::format("the formula is nested more than {} deep", Expression::kDeepest),
                           "give parts of it names under 'parameters'");
    }

   private:
    ExpressionParser& parser_;
  };

  const Token& token() const { return tokens_[at_]; }
  void advance() {
    last_end_ = token().offset + token().text.size();
    ++at_;
  }
  bool fail(std::size_t offset, std::string message, std::string_view hint) {
    error_ = {offset, std::move(message), std::string(hint)};
    return false;
  }
  bool is_word(std::string_view word) const { return token().kind == TokenKind::name && token().text == word; }

  bool emit(Operation operation, std::size_t offset, int index = 0, double value = 0) {
    result_.parsed_.push_back({static_cast<std::uint8_t>(operation), static_cast<std::uint32_t>(offset), index, value});
    return true;
  }

  bool choice() {
    const Level level(*this);
    if (level.too_deep()) return false;
    if (is_word("if")) return fail(token().offset, "expected a value before 'if'", kChoiceHint);
    if (!disjunction()) return false;
    if (!is_word("if")) return true;
    const std::size_t offset = token().offset;
    advance();
    if (!disjunction()) return false;
    if (!is_word("else")) return fail(offset, "'if' without 'else'", kChoiceHint);
    advance();
    return choice() && emit(Operation::select, offset);
  }

  bool disjunction() {
    if (!conjunction()) return false;
    while (is_word("or")) {
      const std::size_t offset = token().offset;
      advance();
      if (!conjunction()) return false;
      emit(Operation::logical_or, offset);
    }
    return true;
  }

  bool conjunction() {
    if (!negation()) return false;
    while (is_word("and")) {
      const std::size_t offset = token().offset;
      advance();
      if (!negation()) return false;
      emit(Operation::logical_and, offset);
    }
    return true;
  }

  bool negation() {
    if (!is_word("not")) return comparison();
    const Level level(*this);
    if (level.too_deep()) return false;
    const std::size_t offset = token().offset;
    advance();
    return negation() && emit(Operation::logical_not, offset);
  }

  std::optional<Operation> comparison_operator() const {
    if (token().kind != TokenKind::symbol) return {};
    const std::string_view text = token().text;
    if (text == "==") return Operation::equal;
    if (text == "!=") return Operation::unequal;
    if (text == "<") return Operation::less;
    if (text == "<=") return Operation::less_equal;
    if (text == ">") return Operation::greater;
    if (text == ">=") return Operation::greater_equal;
    return {};
  }

  bool comparison() {
    if (!sum()) return false;
    const auto operation = comparison_operator();
    if (!operation) return true;
    const std::size_t offset = token().offset;
    advance();
    if (!sum()) return false;
    if (comparison_operator()) return fail(token().offset, "comparisons do not chain", "write: a < b and b < c");
    return emit(*operation, offset);
  }

  // Left to right: one of two operators between operands that `operand` reads.
  bool sequence(std::string_view first, Operation first_operation, std::string_view second, Operation second_operation,
                bool (ExpressionParser::*operand)()) {
    if (!(this->*operand)()) return false;
    while (token().kind == TokenKind::symbol && (token().text == first || token().text == second)) {
      const Operation operation = token().text == first ? first_operation : second_operation;
      const std::size_t offset = token().offset;
      advance();
      if (!(this->*operand)()) return false;
      emit(operation, offset);
    }
    return true;
  }
  bool sum() { return sequence("+", Operation::add, "-", Operation::subtract, &ExpressionParser::product); }
  bool product() { return sequence("*", Operation::multiply, "/", Operation::divide, &ExpressionParser::signed_power); }

  bool signed_power() {
    const bool minus = token().text == "-";
    if (!minus && token().text != "+") return power();
    const Level level(*this);
    if (level.too_deep()) return false;
    const std::size_t offset = token().offset;
    advance();
    if (!signed_power()) return false;
    return minus ? emit(Operation::negate, offset) : true;
  }

  bool power() {
    if (!with_unit()) return false;
    if (token().text != "^") return true;
    const Level level(*this);
    if (level.too_deep()) return false;
    const std::size_t offset = token().offset;
    advance();
    return signed_power() && emit(Operation::power, offset);
  }

  // A value, its unit, and then no other value: products are written out.
  bool with_unit() {
    const Token first = token();
    if (!primary()) return false;
    const bool is_plain_name = first.kind == TokenKind::name && first.text != "pi" && tokens_[at_ - 1].text != ")";
    if (token().kind == TokenKind::name && among(token().text, unit_names())) {
      if (is_plain_name) {
        return fail(token().offset, fmt::format("the unit '{}' may follow a number or parentheses only", token().text),
                    fmt::format("write '({}) {}'", first.text, token().text));
      }
      const Operation unit = token().text == "deg"   ? Operation::degrees
                             : token().text == "rad" ? Operation::radians
                                                     : Operation::turns;
      emit(unit, token().offset);
      advance();
    }
    const bool value_follows = token().kind == TokenKind::number || token().text == "(" ||
                               (token().kind == TokenKind::name && !is_keyword(token().text));
    if (!value_follows) return true;
    if (token().kind == TokenKind::name && among(token().text, kOtherUnits) && !is_plain_name) {
      return fail(token().offset, fmt::format("the unit '{}' is not allowed in a formula", token().text),
                  "model lengths carry no unit; angles have deg, rad or turn");
    }
    const std::string_view before = tokens_[at_ - 1].text;
    return fail(token().offset, fmt::format("missing operator between '{}' and '{}'", before, token().text),
                fmt::format("a product is written with '*': {}*{}", before, token().text));
  }

  bool primary() {
    const Token t = token();
    if (t.kind == TokenKind::number) {
      advance();
      return emit(Operation::literal, t.offset, 0, t.value);
    }
    if (t.text == "(") {
      advance();
      if (token().text == ")") return fail(t.offset, "empty parentheses", "");
      if (!choice()) return false;
      if (accept(")")) return true;
      error_ = unexpected();
      return false;
    }
    if (t.kind != TokenKind::name || is_keyword(t.text)) return expected_value();
    if (among(t.text, unit_names())) {
      return fail(t.offset, fmt::format("the unit '{}' must follow a number", t.text),
                  fmt::format("write '1 {}'", t.text));
    }
    advance();
    if (const Function* function = find_function(t.text)) return call(*function, t);
    if (t.text == "sum" || t.text == "integral") return block(t);
    const auto counter = std::find(counters_.rbegin(), counters_.rend(), t.text);
    if (counter != counters_.rend())
      return emit(Operation::local, t.offset, static_cast<int>(counters_.rend() - counter) - 1);
    if (token().text == "(") return unknown_function(t);
    if (t.text == "pi") return emit(Operation::pi, t.offset);
    const auto found = std::find(result_.names_.begin(), result_.names_.end(), t.text);
    const int index = static_cast<int>(found - result_.names_.begin());
    if (found == result_.names_.end()) result_.names_.emplace_back(t.text);
    return emit(Operation::name, t.offset, index);
  }

  bool expected_value() {
    const Token& t = token();
    if (t.text == "*" && at_ == 0) return fail(t.offset, "a formula may not begin with '*'", "");
    const std::string hint = t.text == "," || t.text == ".." ? unexpected().hint : "";
    if (at_ == 0) return fail(t.offset, fmt::format("expected a value before {}", shown(t)), hint);
    return fail(t.offset, fmt::format("expected a value between '{}' and {}", tokens_[at_ - 1].text, shown(t)), hint);
  }

  // Before its parenthesis.
  bool has_several_arguments() const {
    int depth = 0;
    for (size_t k = at_; k < tokens_.size(); ++k) {
      depth += tokens_[k].text == "(" ? 1 : tokens_[k].text == ")" ? -1 : 0;
      if (depth == 1 && tokens_[k].text == ",") return true;
      if (depth == 0) break;
    }
    return false;
  }

  bool unknown_function(const Token& name) {
    std::string hint = fmt::format("there are {}", fmt::join(function_names(), ", "));
    if (!has_several_arguments()) hint += fmt::format("; a product is written with '*': {}*(...)", name.text);
    const auto abroad =
        std::find_if(std::begin(kAbroad), std::end(kAbroad), [&](const Abroad& a) { return a.name == name.text; });
    if (abroad != std::end(kAbroad)) {
      hint = abroad->hint;
    } else if (const auto nearest = nearest_name(name.text, function_names())) {
      hint = fmt::format("did you mean '{}'?", *nearest);
    }
    return fail(name.offset, fmt::format("unknown function '{}'", name.text), hint);
  }

  // sum(i, a, b, body): the three formulas aside, as a block of the expression.
  bool block(const Token& name) {
    const std::string hint =
        fmt::format("write {}", name.text == "sum" ? "sum(i, 0, n, formula of i)" : "integral(x, a, b, formula of x)");
    Expression::Block result;
    result.is_sum = name.text == "sum";
    if (!accept("("))
      return fail(name.offset, fmt::format("the function '{}' needs its arguments in parentheses", name.text), hint);
    const Token counter = token();
    if (counter.kind != TokenKind::name || is_reserved_word(counter.text))
      return fail(counter.offset,
                  fmt::format("{} begins with the name of its {}", name.text, result.is_sum ? "counter" : "variable"),
                  hint);
    advance();
    result.counter = counter.text;
    std::vector<Expression::Instruction> outside;
    outside.swap(result_.parsed_);
    for (auto* part : {&result.from, &result.to, &result.body}) {
      if (!accept(",")) return fail(name.offset, fmt::format("{} takes 4 arguments", name.text), hint);
      if (part == &result.body) counters_.push_back(result.counter);
      if (!choice()) return false;
      part->swap(result_.parsed_);
      result_.parsed_.clear();
    }
    counters_.pop_back();
    result_.parsed_.swap(outside);
    if (token().text == ",") return fail(name.offset, fmt::format("{} takes 4 arguments", name.text), hint);
    if (!accept(")")) {
      error_ = unexpected();
      return false;
    }
    result_.blocks_.push_back(std::move(result));
    return emit(Operation::block, name.offset, static_cast<int>(result_.blocks_.size()) - 1);
  }

  bool call(const Function& function, const Token& name) {
    if (!accept("(")) {
      return fail(name.offset, fmt::format("the function '{}' needs its arguments in parentheses", name.text),
                  fmt::format("write {}(x)", name.text));
    }
    int count = 0;
    if (token().text != ")") {
      do {
        if (!choice()) return false;
        ++count;
        if (function.most > 3 && count > 1) emit(function.operation, name.offset);
      } while (accept(","));
    }
    if (!accept(")")) {
      error_ = unexpected();
      return false;
    }
    if (count < function.fewest || count > function.most) {
      const bool exact = function.fewest == function.most;
      return fail(
          name.offset,
          fmt::format("{} takes {}{} argument{}, not {}", name.text,
                      exact                     ? ""
                      : count < function.fewest ? "at least "
                                                : "at most ",
                      count < function.fewest ? function.fewest : function.most, function.most == 1 ? "" : "s", count),
          "");
    }
    if (function.most <= 3) emit(function.operation, name.offset);
    return true;
  }

  std::string_view whole_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0, last_end_ = 0;
  int depth_ = 0;
  std::vector<std::string> counters_;  // of the blocks around
  Expression result_;
  ExpressionError error_;
};

std::variant<Expression, ExpressionError> Expression::parse(std::string_view text) {
  ExpressionParser parser(text);
  if (auto error = parser.start()) return *error;
  auto result = parser.one();
  if (std::holds_alternative<Expression>(result) && !parser.at_end()) return parser.unexpected();
  return result;
}

}  // namespace lekalo::geometry
