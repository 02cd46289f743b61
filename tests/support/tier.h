// Two tiers of one test: the small tier of tools/test runs 1/100 of the counts that the full tier of tools/verify runs
// (environment LEKALO_TIER=full). Figures that a test reports end in docs/internals/verification.md.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace lekalo::tests {

inline bool is_full_tier() {
  const char* tier = std::getenv("LEKALO_TIER");
  return tier != nullptr && std::string_view(tier) == "full";
}

// Number of cases to run where the full tier runs `full`: all of them there, a hundredth (but at least `least`, and
// never more than `full`) in the small tier.
inline int tier_count(int full, int least = 1) {
  return is_full_tier() ? full : std::min(full, std::max(least, full / 100));
}

// Sanitizers look for faults of memory, which need no statistics: of slow tests a few cases are enough for them.
inline int min_of_slow(int least) {
#ifdef __SANITIZE_ADDRESS__
  return std::min(4, std::max(1, least / 5));
#else
  return least;
#endif
}

// Reports a figure of the running test to the verification report. `key` names quantity and unit in words without
// spaces
// ("missing_hits", "largest_error_ulp") and is unique within the test. Figures must not depend on time or machine.
inline void report_figure(std::string_view key, double value) {
  std::printf("VERIFY %.*s %.10g\n", static_cast<int>(key.size()), key.data(), value);
}

}  // namespace lekalo::tests
