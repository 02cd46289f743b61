#include "render/materials/optical_constants.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lekalo::render {

namespace {

constexpr char kMetalTable[] =
#include "render/materials/data/metals.inc"
    ;
constexpr char kDielectricTable[] =
#include "render/materials/data/dielectrics.inc"
    ;

struct Metal {
  std::string name;
  std::vector<double> micrometres, n, k;
};

// Dispersion formulas in the numbering of refractiveindex.info, L the wavelength in micrometres.
struct Dielectric {
  std::string name;
  int formula = 0;
  double shortest = 0, longest = 0;  // micrometres
  std::vector<double> c;
};

// Some table names say more than a scene needs; the ordinary ray stands for birefringent crystals.
std::string scene_name(const std::string& table_name) {
  if (table_name == "CuZn_brass_70_30") return "CuZn";
  if (table_name == "CuZn_tombac_90_10") return "CuZn_90_10";
  if (table_name == "water_20C") return "water";
  if (table_name.ends_with("_o")) return table_name.substr(0, table_name.size() - 2);
  return table_name;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

const std::vector<Metal>& metals() {
  static const std::vector<Metal> table = [] {
    std::vector<Metal> all;
    std::istringstream stream(kMetalTable);
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with("## ")) {
        all.push_back({scene_name(line.substr(3)), {}, {}, {}});
      } else if (!line.empty() && line[0] != '#') {
        const std::vector<std::string> cells = split(line);
        all.back().micrometres.push_back(std::stod(cells[0]));
        all.back().n.push_back(std::stod(cells[1]));
        all.back().k.push_back(std::stod(cells[2]));
      }
    }
    return all;
  }();
  return table;
}

const std::vector<Dielectric>& dielectrics() {
  static const std::vector<Dielectric> table = [] {
    std::vector<Dielectric> all;
    std::istringstream stream(kDielectricTable);
    for (std::string line; std::getline(stream, line);) {
      if (line.empty() || line[0] == '#') continue;
      const std::vector<std::string> cells = split(line);
      Dielectric substance{scene_name(cells[0]), std::stoi(cells[1]), std::stod(cells[2]), std::stod(cells[3]), {}};
      for (size_t i = 6; i < cells.size(); ++i) substance.c.push_back(std::stod(cells[i]));
      all.push_back(substance);
    }
    return all;
  }();
  return table;
}

template <class Entry>
const Entry& entry(const std::vector<Entry>& table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.name == name; });
  if (found == table.end()) throw std::invalid_argument("no optical constants of '" + std::string(name) + "'");
  return *found;
}

template <class Entry>
std::vector<std::string> names(const std::vector<Entry>& table) {
  std::vector<std::string> all;
  for (const Entry& e : table) all.push_back(e.name);
  std::sort(all.begin(), all.end());
  return all;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const size_t i = above - x.begin();
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

}  // namespace

const std::vector<std::string>& metal_names() {
  static const std::vector<std::string> all = names(metals());
  return all;
}

const std::vector<std::string>& dielectric_names() {
  static const std::vector<std::string> all = names(dielectrics());
  return all;
}

ComplexIndex metal_index(std::string_view name, const Wavelengths& wavelengths) {
  const Metal& metal = entry(metals(), name);
  ComplexIndex index;
  for (int i = 0; i < 4; ++i) {
    const double micrometres = wavelengths.nanometres[i] / 1000.0;
    index.n.set(i, static_cast<float>(interpolate(metal.micrometres, metal.n, micrometres)));
    index.k.set(i, static_cast<float>(interpolate(metal.micrometres, metal.k, micrometres)));
  }
  return index;
}

double dielectric_index(std::string_view name, double nanometres) {
  const Dielectric& substance = entry(dielectrics(), name);
  const double length = std::clamp(nanometres / 1000.0, substance.shortest, substance.longest);
  const double square = length * length;
  const std::vector<double>& c = substance.c;
  double sum = c[0];
  switch (substance.formula) {
    case 1:  // Sellmeier: n^2 - 1 = c0 + sum c_i L^2 / (L^2 - c_{i+1}^2)
      for (size_t i = 1; i + 1 < c.size(); i += 2) sum += c[i] * square / (square - c[i + 1] * c[i + 1]);
      return std::sqrt(1 + sum);
    case 2:  // Sellmeier: n^2 - 1 = c0 + sum c_i L^2 / (L^2 - c_{i+1})
      for (size_t i = 1; i + 1 < c.size(); i += 2) sum += c[i] * square / (square - c[i + 1]);
      return std::sqrt(1 + sum);
    case 4:  // n^2 = c0 + sum of c1 L^c2 / (L^2 - c3^c4) in groups of four
      for (size_t i = 1; i + 3 < c.size(); i += 4)
        sum += c[i] * std::pow(length, c[i + 1]) / (square - std::pow(c[i + 2], c[i + 3]));
      return std::sqrt(sum);
    default:
      throw std::logic_error("dispersion formula of '" + substance.name + "' is not known");
  }
}

double cauchy_index(double index_d, double abbe, double nanometres) {
  constexpr double kLineF = 486.1327, kLineC = 656.2725;  // hydrogen, blue and red
  const double b = (index_d - 1) / (abbe * (1 / (kLineF * kLineF) - 1 / (kLineC * kLineC)));
  return index_d + b * (1 / (nanometres * nanometres) - 1 / (static_cast<double>(kLineD) * kLineD));
}

}  // namespace lekalo::render
