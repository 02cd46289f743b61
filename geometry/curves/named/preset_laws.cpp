// Rational presets (Grezdov, Filippenko 2010, where they are marked so; the others by their sums of cosines).
//
// Of a rose r = cos(p s), s = t/q, x and y have the frequencies p + q and p - q of s: where both are even half of them
// of 2 s. A sinusoidal spiral r = cos(t/k)^k has x + i y = ((1 + e^{i s})/2)^k with s = 2 t/k.
#include "geometry/curves/named/preset_laws.h"

#include <cmath>

#include "geometry/curves/named/preset_fields.h"

namespace lekalo::geometry {

namespace {

// Formulas of the parameters, weights of t too. `condition` of the parameters; empty: always.
struct PresetLaw {
  std::string_view name;
  std::string_view weight, degree, speed;
  std::string_view condition = {};
};

constexpr PresetLaw kLaws[] = {
    {"witch_of_agnesi", "1 + t^2", "3", "0"},
    {"folium_of_descartes", "sin(t)^3 + cos(t)^3", "3", "1"},
    {"cissoid_of_diocles", "1 + t^2", "3", "0"},
    {"cubic_parabola", "1", "3", "0"},
    {"trisectrix_of_maclaurin", "1 + t^2", "3", "0"},
    {"ophiuride", "1 + t^2", "3", "0"},
    {"semicubical_parabola", "1", "3", "0"},
    {"strophoid", "1 + t^2", "3", "0"},
    {"trident", "t", "3", "0"},
    {"lemniscate_of_bernoulli", "1 + sin(t)^2", "2", "1"},
    {"cassini_oval", "1 + sin(t)^2", "2", "1", "c == a"},
    {"kappa", "sin(t)", "2", "1"},
    {"cardioid", "1", "2", "1"},
    {"conchoid_of_nicomedes", "sin(t)", "2", "1"},
    {"limacon_of_pascal", "1", "2", "1"},
    {"deltoid", "1", "2", "1"},
    {"lissajous", "1", "max(abs(p), abs(q))", "1"},
    {"sinusoidal_spiral", "1", "round(1/m)", "2/round(1/m)", "m > 0 and m <= 1 and abs(1/m - round(1/m)) < 1e-12"},
    {"epicycloid", "1", "turns*(1 + b/a)", "1/turns"},
    {"epitrochoid", "1", "turns*(1 + b/a)", "1/turns"},
    {"hypocycloid", "1", "turns*max(b/a, abs(1 - b/a))", "1/turns"},
    {"hypotrochoid", "1", "turns*max(b/a, abs(1 - b/a))", "1/turns"},
    {"astroid", "1", "3", "1"},
    {"nephroid", "1", "3", "1"},
    {"rose", "1", "(p + q)/(1 + mod(p*q, 2))", "(1 + mod(p*q, 2))/q"},
};

}  // namespace

std::optional<RationalLaw> rational_law(std::string_view preset, std::span<const Expression::Constant> constants) {
  for (const PresetLaw& law : kLaws) {
    if (law.name != preset || (!law.condition.empty() && preset_value(law.condition, constants) == 0)) continue;
    return RationalLaw{formula_of(std::string(law.weight), {"t"}, constants),
                       static_cast<int>(std::lround(preset_value(law.degree, constants))),
                       preset_value(law.speed, constants)};
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
