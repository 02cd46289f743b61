// Union, intersection and difference of random pairs of bodies, for tools/bench booleans: beside OCCT's, which reads
// the bodies from our STEP files. Only pairs whose surfaces stand there as they are. Processor time; one JSON object a
// line.
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "geometry/bodies/booleans/body_pairs.h"
#include "geometry/queries/measures/mass_properties.h"
#include "occt/occt_body.h"
#include "timed.h"

namespace lekalo::benchmarks {

namespace {

using geometry::Body;
using geometry::BodyPair;
using geometry::BooleanOperation;

constexpr double kSame = 1e-9;  // of the volume

// None where OCCT does not have the same body.
std::optional<TopoDS_Shape> same_in_occt(const Body& body) {
  const TopoDS_Shape shape = tests::occt_body(body);
  const double own = measure(body).volume.value;
  return std::abs(tests::occt_volume(shape) - own) <= kSame * own ? std::optional(shape) : std::nullopt;
}

template <class Work>
double min_seconds(int runs, const Work& work) {
  double least = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
    work();
    least = std::min(least, seconds(CLOCK_PROCESS_CPUTIME_ID) - begin);
  }
  return least;
}

void own_booleans(const BodyPair& pair) {
  using enum BooleanOperation;
  for (const BooleanOperation operation : {unite, intersect, subtract}) try {
      boolean(operation, pair.a, pair.b);
    } catch (const geometry::BooleanError&) {
      // Nothing is left, or refused.
    }
}

template <class Algorithm>
void occt_boolean(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  try {
    Algorithm algorithm(a, b);
  } catch (const Standard_Failure&) {
    // Its failures count as well as what it makes.
  }
}

template <class Make>
void print_row(const std::string& name, int pairs, int runs, const Make& make) {
  double ours = 0, theirs = 0, worst = 1e300;
  int compared = 0;
  for (int k = 0; k < pairs; ++k) {
    const BodyPair pair = make(static_cast<unsigned>(k));
    const auto a = same_in_occt(pair.a), b = same_in_occt(pair.b);
    if (!a || !b) continue;
    const double own = min_seconds(runs, [&] { own_booleans(pair); }), of_occt = min_seconds(runs, [&] {
                                                                         occt_boolean<BRepAlgoAPI_Fuse>(*a, *b);
                                                                         occt_boolean<BRepAlgoAPI_Common>(*a, *b);
                                                                         occt_boolean<BRepAlgoAPI_Cut>(*a, *b);
                                                                       });
    ++compared, ours += own, theirs += of_occt;
    worst = std::min(worst, of_occt / own);
  }
  fmt::print(
      "{{\"name\": \"{}\", \"pairs\": {}, \"of\": {}, \"seconds\": {:.4f}, \"occt_seconds\": {:.4f}, \"worst\": "
      "{:.4f}}}\n",
      name, compared, pairs, ours, theirs, worst);
}

}  // namespace

}  // namespace lekalo::benchmarks

int main(int argc, char** argv) {
  const int pairs = argc == 3 ? std::atoi(argv[1]) : 0, runs = argc == 3 ? std::atoi(argv[2]) : 0;
  if (pairs <= 0 || runs <= 0) {
    fmt::print(stderr, "usage: booleans_benchmark PAIRS RUNS\n");
    return 2;
  }
  using lekalo::geometry::BodyPairs;
  lekalo::benchmarks::print_row("elementary", pairs, runs, [](unsigned k) { return BodyPairs(1000 + k).elementary(); });
  lekalo::benchmarks::print_row("general", pairs, runs,
                                [](unsigned k) { return BodyPairs(20261127 + 7919 * k).general(); });
}
