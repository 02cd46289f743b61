#include "render/model/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lekalo::render {

namespace {

// Between these the numbers of a scale are written in full.
constexpr double kLarge = 1e6, kSmall = 1e-4;
constexpr int kMaxDigits = 15;    // of a double
constexpr double kTrue = 0.01;    // of the step: so near to its number a text has to be
constexpr double kEqual = 1e-12;  // of the largest: numbers that are one
constexpr int kFewDigits = 6;     // a large number of more digits is written in full all the same
constexpr int kMaxDecimals = 300;

int power_of(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)); }

std::string in_full(double value, int digits) {
  if (value == 0) return "0";
  std::string text = fmt::format("{:.{}f}", value, std::clamp(digits - 1 - power_of(value), 0, kMaxDecimals));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace

std::string times_power_of_ten(const std::string& digits, int power) {
  const std::string all = digits == "1" ? "" : digits == "-1" ? "-" : digits + "\\cdot ";
  return fmt::format("{}10^{{{}}}", all, power);
}

std::vector<std::string> numbers_of_scale(const std::vector<double>& values, int digits) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  double step = largest;
  for (size_t k = 1; k < sorted.size(); ++k)
    if (const double apart = sorted[k] - sorted[k - 1]; apart > kEqual * largest) step = std::min(step, apart);
  // A small number is to be told from 0 too.
  for (const double value : values)
    if (std::abs(value) > kEqual * largest) step = std::min(step, std::abs(value));
  int power = 0;
  if (largest > 0 && (largest < kSmall || (largest >= kLarge && power_of(largest) - power_of(step) < kFewDigits)))
    power = power_of(largest);
  const double unit = std::pow(10, power);
  const auto is_true = [&](double value) {
    return std::abs(std::stod(in_full(value / unit, digits)) - value / unit) <= kTrue * step / unit;
  };
  while (digits < kMaxDigits && !std::all_of(values.begin(), values.end(), is_true)) ++digits;
  std::vector<std::string> texts;
  for (const double value : values) {
    // What is left of a difference is no number.
    std::string text = std::abs(value) <= kEqual * largest ? "0" : in_full(value / unit, digits);
    if (power != 0 && text != "0")
      text = fmt::format("${}$", times_power_of_ten(text, power));
    else if (text.front() == '-')
      text.replace(0, 1, "−");
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace lekalo::render
