#include "render/scene/build/scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "geometry/expression/nearest_name.h"
#include "render/scene/values/scalars.h"
#include "render/scene/yaml/include.h"

namespace lekalo::render {

using geometry::ExpressionError;
using geometry::Measure;

namespace {

// Bytes of the word that begins there, 1 if it is none: a misspelt name is marked as a whole.
std::size_t word_length(std::string_view text, std::size_t offset) {
  std::size_t end = offset;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
  return std::max<std::size_t>(end - std::min(offset, end), 1);
}

}  // namespace

Counters Counters::with(std::string name, double value, Measure measure) const {
  Counters inner = *this;
  std::erase_if(inner.values, [&](const Expression::Constant& c) { return c.name == name; });
  inner.values.push_back({std::move(name), value, measure, false});
  return inner;
}

Parameters::Parameters(const Value* section, Diagnostics& diagnostics) : section_(section), diagnostics_(diagnostics) {
  if (!section_) return;
  for (const Entry& entry : section_->entries) parameters_[entry.key.name].entry = &entry;
}

void Parameters::define(const std::string& name, double value) {
  parameters_[name] = {nullptr, State::known, {name, value, Measure::plain, false}};
}

const Expression::Constant* Parameters::lookup(const std::string& name, std::string_view scope, const Value& asked) {
  if (const auto defined = parameters_.find(name); defined != parameters_.end() && !defined->second.entry)
    return &defined->second.constant;
  if (!section_) return nullptr;
  const Named named = find_named(*section_, name, scope);
  if (!named.entry || !named.member.empty()) return nullptr;
  Parameter& parameter = parameters_.find(named.entry->key.name)->second;
  if (parameter.state == State::in_work) {
    diagnostics_.error(asked.place, fmt::format("the parameter '{}' is defined by itself", name),
                       "parameters may use each other in any order, but not in a circle");
    parameter.state = State::wrong;
  }
  if (parameter.state == State::unknown) {
    parameter.state = State::in_work;
    parameter.constant = {name, std::numeric_limits<double>::quiet_NaN(), Measure::plain, false};
    if (auto constant = evaluated(name, parameter.entry->value)) {
      parameter.constant = *std::move(constant);
      if (parameter.state == State::in_work) parameter.state = State::known;
    }
    if (parameter.state == State::in_work) parameter.state = State::wrong;
  }
  parameter.constant.name = name;
  return &parameter.constant;
}

std::optional<Expression::Constant> Parameters::evaluated(const std::string& name, const Value& value) {
  if (value.is_map() && measuring_ && !value.invalid) {
    const std::optional<MeasuredQuantity> found = measuring_(value);
    return found ? std::optional(Expression::Constant{name, found->value, found->measure, false}) : std::nullopt;
  }
  const std::optional<Expression> expression = bind(value, {});
  const std::optional<double> result = expression ? finish(value, *expression, (*expression)()) : std::nullopt;
  if (!result) return std::nullopt;
  return Expression::Constant{name, *result, expression->measure(), expression->holds_pi()};
}

std::optional<Expression> Parameters::bind(const Value& value, const Counters& counters,
                                           std::span<const Expression::Variable> variables) {
  if (value.invalid) return std::nullopt;
  if (!value.is_scalar()) {
    diagnostics_.error(value.place, fmt::format("expected a number or a formula, found {}", kind_name(value)));
    return std::nullopt;
  }
  return bind(value, value.text, 0, counters, variables);
}

std::optional<Expression> Parameters::bind(const Value& value, std::string_view text, std::size_t start,
                                           const Counters& counters, std::span<const Expression::Variable> variables) {
  if (value.invalid) return std::nullopt;
  if (counters.abbreviations && !variables.empty())
    return bind_with_abbreviations(value, text, start, counters, variables);
  const auto report = [&](const ExpressionError& error) {
    diagnostics_.error(value.place_of(start + error.offset, word_length(text, error.offset)), error.message,
                       error.hint);
  };
  if (const std::optional<Slip> slip = number_slip(text)) {
    diagnostics_.error(value.place, slip->message, slip->hint);
    return std::nullopt;
  }
  auto parsed = Expression::parse(text);
  if (const auto* error = std::get_if<ExpressionError>(&parsed)) {
    report(*error);
    return std::nullopt;
  }
  Expression expression = std::move(std::get<Expression>(parsed));
  std::vector<Expression::Constant> constants = counters.values;
  const std::string_view scope = value.place.file ? std::string_view(value.place.file->scope) : std::string_view();
  for (const std::string& name : expression.names()) {
    bool known = false;
    for (const Expression::Variable& variable : variables) known = known || variable.name == name;
    for (const Expression::Constant& constant : counters.values) known = known || constant.name == name;
    if (known) continue;
    if (const Expression::Constant* parameter = lookup(name, scope, value)) {
      if (std::isnan(parameter->value)) return std::nullopt;  // its own error has been reported
      constants.push_back(*parameter);
    }
  }
  // The names not asked for stand behind, with no value, so that "did you mean" knows them.
  const bool unknown = [&] {
    for (const std::string& name : expression.names()) {
      bool known = false;
      for (const auto& variable : variables) known = known || variable.name == name;
      for (const auto& constant : constants) known = known || constant.name == name;
      if (!known) return true;
    }
    return false;
  }();
  if (unknown && section_)
    for (const Entry& entry : section_->entries) constants.push_back({entry.key.name, 0, Measure::plain, false});
  if (const std::optional<ExpressionError> error = expression.bind(variables, constants)) {
    report(*error);
    return std::nullopt;
  }
  return expression;
}

namespace {

std::set<std::string> names_in(std::string_view text) {
  const auto parsed = Expression::parse(text);
  const auto* expression = std::get_if<Expression>(&parsed);
  if (!expression) return {};
  return {expression->names().begin(), expression->names().end()};
}

// Those that a formula uses, and those that these use, in their order.
std::vector<const Entry*> used_abbreviations(const Value& let, std::string_view text) {
  std::set<std::string> used = names_in(text);
  std::vector<const Entry*> result;
  for (auto entry = let.entries.rbegin(); entry != let.entries.rend(); ++entry) {
    if (!used.contains(entry->key.name)) continue;
    result.insert(result.begin(), &*entry);
    if (entry->value.is_scalar()) used.merge(names_in(entry->value.text));
  }
  return result;
}

}  // namespace

// Each abbreviation is bound with the variables and the names before it, then these give way to what they stand for.
std::optional<Expression> Parameters::bind_with_abbreviations(const Value& value, std::string_view text,
                                                              std::size_t start, const Counters& counters,
                                                              std::span<const Expression::Variable> variables) {
  Counters outside = counters;
  outside.abbreviations = nullptr;
  std::vector<Expression::Variable> names(variables.begin(), variables.end());
  std::vector<Expression> meanings;
  for (const Expression::Variable& variable : variables) {
    Expression itself = std::get<Expression>(Expression::parse(variable.name));
    itself.bind(variables);
    meanings.push_back(std::move(itself));
  }
  const auto resolved = [&](const Value& from, const std::optional<Expression>& bound) -> std::optional<Expression> {
    if (!bound) return std::nullopt;
    try {
      return bound->of(meanings);
    } catch (const std::length_error& error) {
      diagnostics_.error(from.place, error.what(), "abbreviations are written out where they are used");
      return std::nullopt;
    }
  };
  for (const Entry* const used : used_abbreviations(*counters.abbreviations, text)) {
    const Entry& entry = *used;
    const std::string& name = entry.key.name;
    const bool taken = std::any_of(names.begin(), names.end(), [&](const auto& known) { return known.name == name; });
    if (taken || !may_be_called(name)) {
      diagnostics_.error(entry.key.place, fmt::format("an abbreviation may not be called '{}'", name),
                         "it is a variable, function or unit of formulas");
      return std::nullopt;
    }
    const auto meaning = resolved(entry.value, bind(entry.value, outside, names));
    if (!meaning) return std::nullopt;
    names.push_back({name, meaning->measure()});
    meanings.push_back(*meaning);
  }
  return resolved(value, bind(value, text, start, outside, names));
}

std::optional<double> Parameters::finish(const Value& value, const Expression& expression, double result) {
  if (expression.measure() == Measure::truth) {
    diagnostics_.error(value.place, "expected a number, found a condition", "write for example: 1 if n > 2 else 0");
    return std::nullopt;
  }
  if (!std::isfinite(result)) {
    diagnostics_.error(
        value.place,
        fmt::format("the formula has no finite value ({})", std::isnan(result) ? "not a number" : "infinite"),
        "division by zero, or the root or logarithm of a negative number");
    return std::nullopt;
  }
  return result;
}

std::optional<double> Parameters::number(const Value& value, const Counters& counters) {
  const std::optional<Expression> expression = bind(value, counters);
  if (!expression) return std::nullopt;
  return finish(value, *expression, (*expression)());
}

std::optional<double> Parameters::angle(const Value& value, const Counters& counters) {
  std::optional<Expression> expression = bind(value, counters);
  if (!expression) return std::nullopt;
  if (const std::optional<ExpressionError> error = expression->convert_to_angle()) {
    diagnostics_.error(value.place_of(error->offset, 1), error->message, error->hint);
    return std::nullopt;
  }
  return finish(value, *expression, (*expression)());
}

std::optional<int> Parameters::integer(const Value& value, const Counters& counters) {
  const std::optional<double> x = number(value, counters);
  if (!x) return std::nullopt;
  if (*x != std::nearbyint(*x) || std::abs(*x) > 2e9) {
    diagnostics_.error(value.place, fmt::format("expected a whole number, found {:.12g}", *x));
    return std::nullopt;
  }
  return static_cast<int>(*x);
}

bool Parameters::may_be_called(std::string_view name) {
  return !geometry::is_reserved_word(name) &&
         !(name.size() == 1 && std::string_view("tuvsxyz").find(name[0]) != std::string_view::npos);
}

std::map<std::string, double> Parameters::all() {
  std::map<std::string, double> values;
  for (auto& [name, parameter] : parameters_) {
    if (!parameter.entry) {
      values[name] = parameter.constant.value;
      continue;
    }
    if (!may_be_called(name)) {
      diagnostics_.error(parameter.entry->key.place, fmt::format("a parameter may not be called '{}'", name),
                         "it is a variable, function or unit of formulas");
      continue;
    }
    const std::string_view scope =
        parameter.entry->value.place.file ? std::string_view(parameter.entry->value.place.file->scope) : "";
    // A prefixed name is looked up in the scope that defines it.
    const std::string_view bare = !scope.empty() && name.starts_with(std::string(scope) + ".")
                                      ? std::string_view(name).substr(scope.size() + 1)
                                      : std::string_view(name);
    const Expression::Constant* constant = lookup(std::string(bare), scope, parameter.entry->value);
    if (constant && std::isfinite(constant->value)) values[name] = constant->value;
  }
  return values;
}

}  // namespace lekalo::render
