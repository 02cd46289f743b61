// `repeat`: a map as the template of several.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

namespace {

constexpr size_t kMaxRepeats = 1000000;  // of one repeat

}  // namespace

// The numbers of a range a..b.
std::optional<std::vector<double>> Builder::read_whole_numbers(const Value& value, const Counters& counters) {
  const auto range = read_range(value);
  if (!range) {
    report(diagnostics_, value, range.slip());
    return std::nullopt;
  }
  const auto first = parameters_.bind(value, range->first, 0, counters);
  const auto last = parameters_.bind(value, range->last, value.text.find("..") + 2, counters);
  if (!first || !last) return std::nullopt;
  const double a = (*first)(), b = (*last)();
  constexpr double kWhole = 1LL << 53;  // beyond it numbers have gaps
  if (!(a == std::nearbyint(a) && b == std::nearbyint(b) && std::abs(a) < kWhole && std::abs(b) < kWhole)) {
    diagnostics_.error(value.place, fmt::format("a range of whole numbers, found {:.9g}..{:.9g}", a, b));
    return std::nullopt;
  }
  if (b - a >= static_cast<double>(kMaxRepeats)) {
    diagnostics_.error(value.place, fmt::format("more than {} repetitions", kMaxRepeats));
    return std::nullopt;
  }
  std::vector<double> all;
  for (double x = a; x <= b; ++x) all.push_back(x);
  return all;
}

bool Builder::repeat(const Value& map, const Counters& counters,
                     const std::function<void(const Counters&, const std::string&)>& visit) {
  const Value* loops = map.find("repeat");
  if (!loops->is_map() || loops->entries.empty()) {
    diagnostics_.error(loops->place, "'repeat' names a counter and its values",
                       "write { repeat: { i: 0..5 }, ... } or { repeat: { q: [0, 0.5, 1] }, ... }");
    return false;
  }
  size_t total = 0;
  const auto run = [&](auto&& self, size_t level, const Counters& outer, const std::string& name) -> bool {
    if (level == loops->entries.size()) {
      if (++total > kMaxRepeats) {
        diagnostics_.error(loops->place, fmt::format("more than {} repetitions", kMaxRepeats));
        return false;
      }
      visit(outer, name);
      return true;
    }
    const Entry& counter = loops->entries[level];
    if (!Parameters::may_be_called(counter.key.name)) {
      diagnostics_.error(counter.key.place, fmt::format("a counter may not be called '{}'", counter.key.name),
                         "it is a variable, function or unit of formulas");
      return false;
    }
    const std::string scope = counter.key.place.file ? counter.key.place.file->scope : "";
    if (const Value* parameters = section("parameters");
        parameters && find_named(*parameters, counter.key.name, scope).entry) {
      diagnostics_.error(counter.key.place, fmt::format("the counter '{}' is also a parameter", counter.key.name),
                         "give one of them another name");
      return false;
    }
    struct Step {
      double value;
      geometry::Measure measure;
    };
    std::vector<Step> steps;
    if (is_range(counter.value)) {
      const auto values = read_whole_numbers(counter.value, outer);
      if (!values) return false;
      for (const double x : *values) steps.push_back({x, geometry::Measure::plain});
    } else if (counter.value.is_sequence()) {
      for (const Value& item : counter.value.items) {
        const auto expression = parameters_.bind(item, outer);
        if (!expression) return false;
        if (!std::isfinite((*expression)())) {
          diagnostics_.error(item.place, "this value of the counter is not finite");
          return false;
        }
        steps.push_back({(*expression)(), expression->measure()});
      }
    } else {
      diagnostics_.error(counter.value.place, "a counter runs over a range a..b or a list of values");
      return false;
    }
    for (size_t k = 0; k < steps.size(); ++k) {
      const std::string member = name.empty() ? std::to_string(k) : name + "." + std::to_string(k);
      if (!self(self, level + 1, outer.with(counter.key.name, steps[k].value, steps[k].measure), member)) return false;
    }
    return true;
  };
  return run(run, 0, counters, "");
}

}  // namespace lekalo::render
