// Texts with templates: `fillet_%02k` under `repeat: { k: 2..7 }` is fillet_02 to fillet_07.
//
//   %k          the value of a counter: the longest counter's name that follows
//   %(2*k + 1)  the value of a formula
//   %03k        with at least three digits, zeros in front
//   %.2k        with two decimals
//   %%          a percent sign
#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"

namespace lekalo::render {

namespace {

constexpr int kMaxDigits = 30;  // of a width or of decimals

// Whole numbers as such, others with the decimals asked for, or as many as give the same number back.
std::string formatted(double x, int width, int decimals) {
  if (decimals >= 0) return fmt::format("{:0{}.{}f}", x, width, decimals);
  if (x == std::nearbyint(x) && std::abs(x) < 1e15) return fmt::format("{:0{}.0f}", x, width);
  return fmt::format("{:0{}}", x, width);
}

// A decimal number at `i`, which moves behind it; -1 if it is longer than anybody means.
int digits_at(const std::string& text, size_t& i) {
  int value = 0;
  for (; i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); ++i)
    value = value < 0 || value > kMaxDigits ? -1 : 10 * value + (text[i] - '0');
  return value > kMaxDigits ? -1 : value;
}

// The end of the formula whose opening parenthesis stands at `open`; npos if it does not end.
size_t closing(const std::string& text, size_t open) {
  int depth = 0;
  for (size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string::npos;
}

size_t longest_counter(const std::string& text, size_t i, const Counters& counters) {
  size_t longest = 0;
  for (const Expression::Constant& counter : counters.values)
    if (counter.name.size() > longest && text.compare(i, counter.name.size(), counter.name) == 0)
      longest = counter.name.size();
  return longest;
}

size_t end_of_word(const std::string& text, size_t i) {
  while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_')) ++i;
  return i;
}

}  // namespace

std::optional<Value> Builder::fill_templates(const Value& value, const Counters& counters) {
  Value filled = value;
  bool good = true;
  for (Value& item : filled.items) {
    auto one = fill_templates(item, counters);
    good = good && one;
    if (one) item = *std::move(one);
  }
  for (Entry& entry : filled.entries) {
    if (entry.key.name == "repeat") continue;
    auto one = fill_templates(entry.value, counters);
    good = good && one;
    if (one) entry.value = *std::move(one);
  }
  if (!good) return std::nullopt;
  if (!value.is_scalar() || value.invalid) return filled;

  const auto fail = [&](size_t from, size_t to, const std::string& message) {
    diagnostics_.error(value.place_of(from, std::max<size_t>(to - from, 1)), message,
                       "%k is the counter k, %02k with two digits, %(k+1) a formula, %% a percent sign");
    return std::nullopt;
  };
  const std::string& text = value.text;
  filled.text.clear();
  for (size_t i = 0; i < text.size();) {
    if (text[i] != '%') {
      filled.text += text[i++];
      continue;
    }
    const size_t begin = i++;
    if (i < text.size() && text[i] == '%') {
      filled.text += text[i++];
      continue;
    }
    int width = 0, decimals = -1;
    if (i < text.size() && text[i] == '0') width = digits_at(text, ++i);
    if (i < text.size() && text[i] == '.') decimals = digits_at(text, ++i);
    if (width < 0 || decimals > kMaxDigits) return fail(begin, i, "this many digits are not meant");
    std::string formula;
    size_t start = i;
    if (i < text.size() && text[i] == '(') {
      const size_t end = closing(text, i);
      if (end == std::string::npos) return fail(begin, text.size(), "the formula of this template does not end");
      start = i + 1;
      formula = text.substr(start, end - start);
      i = end + 1;
    } else {
      const size_t length = longest_counter(text, i, counters);
      if (length == 0) {
        const size_t end = end_of_word(text, i);
        return fail(begin, end,
                    end > i ? fmt::format("there is no counter '{}' here", text.substr(i, end - i))
                            : std::string("a percent sign begins a template"));
      }
      formula = text.substr(i, length);
      i += length;
    }
    const auto expression = parameters_.bind(value, formula, start, counters);
    if (!expression) return std::nullopt;
    filled.text += formatted((*expression)(), width, decimals);
  }
  return filled;
}

std::optional<std::string> Builder::setting(const Value& value, const Counters& counters) {
  const auto expression = parameters_.bind(value, counters);
  if (!expression) return std::nullopt;
  bool counts = false;
  auto parsed = Expression::parse(value.text);
  for (const std::string& name : std::get<Expression>(parsed).names())
    for (const Expression::Constant& counter : counters.values) counts = counts || counter.name == name;
  if (!counts) return value.text;
  const char* unit = expression->measure() == geometry::Measure::angle ? " rad" : "";
  return fmt::format("{:.17g}{}", (*expression)(), unit);
}

}  // namespace lekalo::render
