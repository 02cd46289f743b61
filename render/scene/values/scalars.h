// What the text of a scalar means, by the rules of scene files and never by YAML's: the field decides what is asked.
//
// Each reader gives a value or a slip: what is wrong in one sentence, and the cure. Formulas are not read here; but
// number_slip() explains the ways of writing a number that YAML or other programs know and scene files do not.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "render/scene/values/diagnostics.h"
#include "render/scene/values/value.h"

namespace lekalo::render {

/// Why a scalar is not what was asked for. Complete sentence parts for Diagnostics::error.
struct Slip {
  std::string message;
  std::string hint;
};

/// A value of type T, or the slip.
template <class T>
class Reading {
 public:
  Reading(T value) : result_(std::move(value)) {}
  Reading(Slip slip) : result_(std::move(slip)) {}
  explicit operator bool() const { return std::holds_alternative<T>(result_); }
  const T& operator*() const { return std::get<T>(result_); }
  const T* operator->() const { return &std::get<T>(result_); }
  const Slip& slip() const { return std::get<Slip>(result_); }

 private:
  std::variant<T, Slip> result_;
};

/// Reports a slip at the value, unless an error about the value has been reported already.
void report(Diagnostics& diagnostics, const Value& value, const Slip& slip);

/// `true` or `false`, without quotes.
Reading<bool> read_boolean(const Value& value);

/// A decimal number: `2`, `-2`, `+2`, `.5`, `2.`, `1e-3`. Finite.
Reading<double> read_number(const Value& value);
Reading<double> read_number(std::string_view text);

/// A decimal integer within int.
Reading<int> read_integer(const Value& value);

/// The known slips in writing a number: decimal comma, leading zeros, hexadecimal, octal, 1_000, 60-based, .inf, .nan,
/// percent, typographic minus. Empty if the text is none of them (it may be a formula).
std::optional<Slip> number_slip(std::string_view text);

/// An identifier `[A-Za-z_][A-Za-z0-9_]*`, as new names must be.
Reading<std::string> read_name(const Value& value);
/// The name of an entity or a member of one: identifiers and member numbers with dots between (`hole.3.side`).
Reading<std::string> read_reference(const Value& value);
/// The same for keys: names, which may have members. Empty if `key` is right.
std::optional<Slip> key_slip(const Value& key);

/// Any scalar as text, quotes or not.
Reading<std::string> read_text(const Value& value);
/// Text that must have quotes if it looks like a number: a figure '2.10' is not 2.1.
Reading<std::string> read_quoted_text(const Value& value);

enum class PageUnit { mm, pt, px };

/// A length on paper or screen: `84 mm`, `0.8 pt` (1/72 inch), `12 px`.
struct PageLength {
  double value = 0;
  PageUnit unit = PageUnit::mm;
  /// In millimetres, pixels taken at `dots_per_inch`.
  double millimetres(double dots_per_inch) const;
};
Reading<PageLength> read_page_length(const Value& value);

/// An inclusive range `0..n-1`: the formulas on both sides of `..`, with their places.
struct IntegerRange {
  std::string first, last;
  Place first_place, last_place;
};
/// Whether the scalar is meant as a range, that is, contains `..` and is not in quotes.
bool is_range(const Value& value);
Reading<IntegerRange> read_range(const Value& value);

}  // namespace lekalo::render
