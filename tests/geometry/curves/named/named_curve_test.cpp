#include <gtest/gtest.h>

#include <set>

#include "geometry/describe.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::named_curve_test {
namespace {

const TypeDeclaration& named() {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "named_curve") return type;
  throw std::logic_error("no named_curve");
}

Fields fields_of(const std::string& preset, std::initializer_list<std::pair<std::string, double>> numbers = {}) {
  Fields fields;
  fields.set("preset", preset);
  for (const auto& [name, value] : numbers) fields.set(name, value);
  return fields;
}

CurvePtr built(const Fields& fields) { return std::any_cast<CurvePtr>(named().build(fields)); }

TEST(NamedCurve, every_preset_has_derivatives_and_enclosures) {
  const std::vector<std::string>& names = named().fields[0].type.choices;
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_GE(names.size(), 45u);
  // Roots at kinks: derivatives are no numbers there.
  const std::set<std::string> kinked{"lame_curve"};
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const CurvePtr curve = built(fields_of(name));
    EXPECT_NE(named().description.find(name), std::string::npos);
    const Interval domain = curve->domain();
    if (kinked.count(name)) continue;
    const double inset = name == "sinusoidal_spiral" ? 0.05 * domain.width() : 0;
    checks::check_differences(*curve, {domain.lo + inset, domain.hi - inset}, 3, 1e-6);
    checks::check_enclosures(*curve, {domain.lo + inset, domain.hi - inset});
  }
}

TEST(NamedCurve, wrong_parameters_are_told) {
  const auto message = [](const Fields& fields) -> std::string {
    try {
      built(fields);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what() + " / " + error.hint;
    }
    return "";
  };
  EXPECT_EQ(message(fields_of("cycloid", {{"h", 1}})), "h: 'cycloid' has no parameter 'h' / it has a = 1");
  EXPECT_EQ(message(fields_of("cycloid", {{"a", 0}})), "a: the size of the curve is zero / ");
  EXPECT_EQ(message(fields_of("spiric_of_perseus", {{"p", 2}})).substr(0, 8), "preset: ");
  EXPECT_EQ(message(fields_of("epicycloid", {{"b", std::sqrt(2.0)}})),
            "domain: the curve never closes: b/a is no fraction of small numbers / give a domain of t");
}

}  // namespace
}  // namespace lekalo::geometry::named_curve_test
