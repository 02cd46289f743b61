// Projections and intersections beside OCCT's: the same inputs, one thread each, processor time.
//
//   queries_benchmark projections|intersections|sizes RUNS     prints a JSON object for each row
#include "queries/rows.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
  using namespace lekalo::benchmarks;
  const std::string_view part = argc == 3 ? argv[1] : "";
  const int runs = argc == 3 ? std::atoi(argv[2]) : 0;
  if (runs > 0 && part == "projections") return print_projections(runs), 0;
  if (runs > 0 && part == "intersections") return print_intersections(runs), 0;
  if (runs > 0 && part == "sizes") return print_sizes(runs), 0;
  fmt::print(stderr, "usage: queries_benchmark projections|intersections|sizes RUNS\n");
  return 2;
}
