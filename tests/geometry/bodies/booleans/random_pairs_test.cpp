// Booleans of random pairs: in general position, and with every kind of coincidence. No result may be wrong; few may be
// refused by name.
#include <gtest/gtest.h>

#include <iostream>

#include "geometry/bodies/booleans/body_pairs.h"
#include "geometry/bodies/booleans/boolean_checks.h"
#include "support/tier.h"

namespace lekalo::geometry::random_pairs_test {
namespace {

constexpr unsigned kSeed = 20261127, kStep = 7919;  // those of pair k: kSeed + k kStep

template <class Make>
int refused_of(int pairs, bool areas, Make&& make) {
  BooleanChecks checks;
  checks.rays = tests::tier_count(checks.rays, 1000);
  checks.points = tests::tier_count(checks.points, 40);
  checks.areas = areas;
  int refused = 0;
  LineParity parity;
  for (int k = 0; k < pairs; ++k) {
    BodyPairs random(kSeed + kStep * static_cast<unsigned>(k));
    const BodyPair pair = make(random, k);
    const BooleanReport report = check_booleans(pair.a, pair.b, static_cast<unsigned>(k), checks);
    for (const std::string& what : report.wrong) ADD_FAILURE() << k << ", " << pair.kind << ": " << what;
    for (const std::string& what : report.refused) std::cerr << k << ", " << pair.kind << ", refused: " << what << "\n";
    refused += report.refused.empty() ? 0 : 1;
    parity += report.parity;
  }
  tests::report_figure("refused", refused);
  tests::report_figure("lines", parity.lines);
  tests::report_figure("lines_in_band", parity.in_band);
  tests::report_figure("aimed_lines_in_band", parity.aimed_in_band);
  EXPECT_LE(parity.in_band, 1 + parity.lines / 100000);
  return refused;
}

TEST(BooleanPairs, GeneralPosition) {
  const int pairs = tests::tier_count(1000, tests::min_of_slow(30));
  const int refused = refused_of(pairs, true, [](BodyPairs& random, int) { return random.general(); });
  EXPECT_LE(refused, pairs / 200);
}

TEST(BooleanPairs, EveryKindOfCoincidence) {
  const int pairs = tests::tier_count(300, tests::min_of_slow(BodyPairs::kKinds));
  const int refused = refused_of(pairs, false, [](BodyPairs& random, int k) { return random.degenerate(k); });
  EXPECT_LE(refused, pairs / 20);
}

}  // namespace
}  // namespace lekalo::geometry::random_pairs_test
