#include "render/model/length_unit.h"

#include <map>

namespace lekalo::render {

std::optional<double> millimetres_of(const std::string& unit) {
  static const std::map<std::string, double> units = {{"um", 1e-3},   {"µm", 1e-3},  {"mm", 1},    {"cm", 10},
                                                      {"dm", 100},    {"m", 1000},   {"km", 1e6},  {"in", 25.4},
                                                      {"inch", 25.4}, {"ft", 304.8}, {"yd", 914.4}};
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace lekalo::render
