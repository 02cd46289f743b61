// What names in formulas mean: counters of `repeat` around the place, then the scene's parameters.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/expression/expression.h"
#include "render/scene/types/quantity.h"
#include "render/scene/values/diagnostics.h"
#include "render/scene/values/value.h"

namespace lekalo::render {

using geometry::Expression;

// Values of the counters of the repeats around a place, the innermost last.
struct Counters {
  std::vector<Expression::Constant> values;
  // `let` of the map around the place: abbreviations, each of the formula's variables and those before it. May be null.
  const Value* abbreviations = nullptr;
  Counters with(std::string name, double value, geometry::Measure measure) const;
};

// The parameters of a scene, evaluated when first asked for: they may stand in any order and must not go in circles.
class Parameters {
 public:
  // `section` may be null. It must outlive this object.
  Parameters(const Value* section, Diagnostics& diagnostics);

  // Measures what a parameter asks of the geometry, { type: distance, ... }; nothing after an error, which it reports.
  using Measuring = std::function<std::optional<MeasuredQuantity>(const Value&)>;
  void measure_by(Measuring measuring) { measuring_ = std::move(measuring); }

  // The formula of a scalar with all names replaced: counters, then parameters. Reports errors at the value and gives
  // nothing then. `variables` stay free.
  std::optional<Expression> bind(const Value& value, const Counters& counters,
                                 std::span<const Expression::Variable> variables = {});
  std::optional<Expression> bind(const Value& value, std::string_view text, std::size_t offset,
                                 const Counters& counters, std::span<const Expression::Variable> variables = {});

  // A plain number (an angle counts as its radians), or an angle in radians by the rule of expression.h.
  std::optional<double> number(const Value& value, const Counters& counters);
  std::optional<double> angle(const Value& value, const Counters& counters);
  std::optional<int> integer(const Value& value, const Counters& counters);

  // Variables, functions and units of formulas are no names of parameters and counters.
  static bool may_be_called(std::string_view name);

  bool has(std::string_view name) const { return parameters_.find(name) != parameters_.end(); }
  // One more, with a value that is no formula.
  void define(const std::string& name, double value);

  // Evaluates all, so that errors in unused parameters are reported too.
  std::map<std::string, double> all();

 private:
  std::optional<Expression> bind_with_abbreviations(const Value& value, std::string_view text, std::size_t offset,
                                                    const Counters& counters,
                                                    std::span<const Expression::Variable> variables);
  enum class State { unknown, in_work, known, wrong };
  struct Parameter {
    const Entry* entry = nullptr;
    State state = State::unknown;
    Expression::Constant constant;
  };
  const Expression::Constant* lookup(const std::string& name, std::string_view scope, const Value& asked);
  std::optional<double> finish(const Value& value, const Expression& expression, double result);

  std::optional<Expression::Constant> evaluated(const std::string& name, const Value& value);

  const Value* section_;
  Diagnostics& diagnostics_;
  Measuring measuring_;
  std::map<std::string, Parameter, std::less<>> parameters_;
};

}  // namespace lekalo::render
