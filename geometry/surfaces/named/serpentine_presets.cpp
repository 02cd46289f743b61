// a is the size of the path, b the radius of the tube, h the rise of one turn, n turns, e and k the height and number
// of waves, p and q how often a knot goes round its axis and its centre circle.
#include "geometry/surfaces/named/serpentine_presets.h"

namespace lekalo::geometry {

namespace {

// A compression spring with closed ends: its first and last turn rise by the wire's diameter, the n turns between them
// by h, and over half a turn the rise goes from the one to the other. With the smooth step's integral
// S(x) = x^3 - x^4/2 in 0..1, 0 before and x - 1/2 behind,
//
//   z = 2 b w + (h - 2 b) (S(2 (w - 1)) - S(2 (w - n - 1)))/2,   w = t/(2 pi) in 0..n + 5/2 turns.
constexpr std::string_view kSpringRise =
    "2*b*t/(2*pi) + (h - 2*b)/2*("
    "clamp(t/pi - 2, 0, 1)^3 - clamp(t/pi - 2, 0, 1)^4/2 + max(t/pi - 3, 0)"
    " - clamp(t/pi - 2*n - 2, 0, 1)^3 + clamp(t/pi - 2*n - 2, 0, 1)^4/2 - max(t/pi - 2*n - 3, 0))";

std::vector<SerpentinePreset> made() {
  const std::string_view round_x = "b*cos(t)", round_y = "b*sin(t)", turn = "2*pi", turns = "2*pi*n";
  return {
      {"coil",
       "a*cos(t)",
       "a*sin(t)",
       "h*t/(2*pi)",
       turns,
       false,
       round_x,
       round_y,
       "1",
       "0",
       {{"a", 1}, {"b", 0.2}, {"h", 0.7}, {"n", 4}}},
      {"cone_coil",
       "a*(1 - e*t/(2*pi*n))*cos(t)",
       "a*(1 - e*t/(2*pi*n))*sin(t)",
       "h*t/(2*pi)",
       turns,
       false,
       round_x,
       round_y,
       "1",
       "0",
       {{"a", 1}, {"b", 0.12}, {"e", 0.7}, {"h", 0.4}, {"n", 5}}},
      {"spring",
       "a*cos(t)",
       "a*sin(t)",
       kSpringRise,
       "2*pi*(n + 2.5)",
       false,
       round_x,
       round_y,
       "1",
       "0",
       {{"a", 1}, {"b", 0.12}, {"h", 0.7}, {"n", 4}}},
      {"wave",
       "h*t/(2*pi)",
       "a*sin(t)",
       "0",
       turns,
       false,
       round_x,
       round_y,
       "1",
       "0",
       {{"a", 1}, {"b", 0.25}, {"h", 3.5}, {"n", 3}}},
      {"bellows",
       "0",
       "0",
       "a*t",
       "1",
       false,
       round_x,
       round_y,
       "1 + e*cos(2*pi*k*s)",
       "0",
       {{"a", 3}, {"b", 1}, {"e", 0.15}, {"k", 8}}},
      {"rope",
       "0",
       "0",
       "a*t",
       "1",
       false,
       "b*(1 + e*cos(k*t))*cos(t)",
       "b*(1 + e*cos(k*t))*sin(t)",
       "1",
       "2*pi*n*s",
       {{"a", 4}, {"b", 0.6}, {"e", 0.2}, {"k", 5}, {"n", 1}}},
      {"garland",
       "(a + h*cos(n*t))*cos(t)",
       "(a + h*cos(n*t))*sin(t)",
       "0",
       turn,
       true,
       round_x,
       round_y,
       "1 + e*cos(pi*k*s)^8",
       "0",
       {{"a", 2}, {"b", 0.12}, {"e", 2}, {"h", 0.3}, {"k", 18}, {"n", 6}}},
      {"knot",
       "(a + c*cos(q*t/p))*cos(t)",
       "(a + c*cos(q*t/p))*sin(t)",
       "c*sin(q*t/p)",
       "2*pi*p",
       true,
       round_x,
       round_y,
       "1",
       "0",
       {{"a", 2}, {"b", 0.3}, {"c", 0.8}, {"p", 2}, {"q", 3}}},
      // The length of a logarithmic spiral grows as its radius does.
      {"horn",
       "a*exp(k*t)*cos(t)",
       "a*exp(k*t)*sin(t)",
       "-c*exp(k*t)",
       turns,
       false,
       round_x,
       round_y,
       "1 + s*(exp(2*pi*n*k) - 1)",
       "0",
       {{"a", 0.1}, {"b", 0.06}, {"c", 0.15}, {"k", 0.15}, {"n", 3}}},
  };
}

}  // namespace

std::span<const SerpentinePreset> serpentine_presets() {
  static const std::vector<SerpentinePreset> presets = made();
  return presets;
}

}  // namespace lekalo::geometry
