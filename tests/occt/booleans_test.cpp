// Booleans beside OCCT's: bodies of planes, cylinders, cones, balls and tori in general position, which it reads from
// our STEP files. Where volumes differ or it gives none, identities and rays through the CSG say which of both is
// wrong.
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>

#include <ctime>
#include <iostream>
#include <map>

#include "geometry/bodies/booleans/body_pairs.h"
#include "geometry/bodies/booleans/boolean_checks.h"
#include "occt/occt_body.h"
#include "support/tier.h"

namespace lekalo::render::booleans_test {
namespace {

using geometry::Body;
using geometry::BooleanOperation;

constexpr double kVolume = 1e-6;  // of both operands'

struct Answer {
  double volume = 0;
  std::string fault;
};

template <class Algorithm>
Answer volume_of(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  try {
    Algorithm algorithm(a, b);
    if (algorithm.HasErrors()) return {0, "an error"};
    if (!BRepCheck_Analyzer(algorithm.Shape()).IsValid()) return {0, "not valid"};
    return {tests::occt_volume(algorithm.Shape()), ""};
  } catch (const Standard_Failure& failure) {
    return {0, fmt::format("thrown: {}", failure.DynamicType()->Name())};
  }
}

Answer own_volume(BooleanOperation operation, const Body& a, const Body& b) {
  try {
    return {measure(boolean(operation, a, b)).volume.value, ""};
  } catch (const geometry::BooleanError& error) {
    return {0, error.empty ? "" : error.what()};
  }
}

// "ball_and_torus" of "torus and ball".
std::string kinds_of(const std::string& pair) {
  const std::string between = " and ";
  const size_t at = pair.find(between);
  const std::string a = pair.substr(0, at), b = pair.substr(at + between.size());
  return std::min(a, b) + "_and_" + std::max(a, b);
}

TEST(BooleansBesideOcct, Volumes) {
  const int pairs = tests::tier_count(100, 6);
  int refused = 0, compared = 0;
  std::map<std::string, int> failures_of_occt;  // by the operands' kinds
  double seconds = 0, seconds_of_occt = 0;
  const auto timed = [](double& sum, const auto& work) {
    const std::clock_t start = std::clock();
    const Answer answer = work();
    sum += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return answer;
  };
  for (int k = 0; k < pairs; ++k) {
    const geometry::BodyPair pair = geometry::BodyPairs(1000u + static_cast<unsigned>(k)).elementary();
    const TopoDS_Shape a = tests::occt_body(pair.a), b = tests::occt_body(pair.b);
    const double volume_a = measure(pair.a).volume.value, volume_b = measure(pair.b).volume.value,
                 scale = volume_a + volume_b;
    // It has the same operands.
    EXPECT_NEAR(tests::occt_volume(a), volume_a, kVolume * scale) << k << ", " << pair.kind;
    EXPECT_NEAR(tests::occt_volume(b), volume_b, kVolume * scale) << k << ", " << pair.kind;
    const auto compare = [&](const char* name, const Answer& own, const Answer& of_occt) {
      if (!own.fault.empty()) {
        ++refused;
        std::cerr << k << ", " << pair.kind << ", " << name << ", refused: " << own.fault << "\n";
      }
      ++compared;
      const double apart = std::abs(own.volume - of_occt.volume) / scale;
      if (of_occt.fault.empty() && (apart <= kVolume || !own.fault.empty())) return;
      ++failures_of_occt[kinds_of(pair.kind)];
      std::cerr << k << ", " << pair.kind << ", " << name << ", OCCT: " << of_occt.fault
                << fmt::format(" volume {:.9g} beside {:.9g}\n", of_occt.volume, own.volume);
      // Ours must be right then.
      const geometry::BooleanReport report = check_booleans(pair.a, pair.b, static_cast<unsigned>(k));
      for (const std::string& what : report.wrong) ADD_FAILURE() << k << ", " << pair.kind << ": " << what;
    };
    using enum BooleanOperation;
    compare("or", timed(seconds, [&] { return own_volume(unite, pair.a, pair.b); }),
            timed(seconds_of_occt, [&] { return volume_of<BRepAlgoAPI_Fuse>(a, b); }));
    compare("and", timed(seconds, [&] { return own_volume(intersect, pair.a, pair.b); }),
            timed(seconds_of_occt, [&] { return volume_of<BRepAlgoAPI_Common>(a, b); }));
    compare("minus", timed(seconds, [&] { return own_volume(subtract, pair.a, pair.b); }),
            timed(seconds_of_occt, [&] { return volume_of<BRepAlgoAPI_Cut>(a, b); }));
  }
  tests::report_figure("refused", refused);
  tests::report_figure("compared", compared);
  for (const auto& [kinds, count] : failures_of_occt) tests::report_figure("wrong_in_OCCT,_" + kinds, count);
  std::cerr << fmt::format("{} pairs: {:.2f} s of processor time, OCCT {:.2f} s\n", pairs, seconds, seconds_of_occt);
  EXPECT_LE(refused, 3 * pairs / 200);
}

}  // namespace
}  // namespace lekalo::render::booleans_test
