// Perfect matchings: all vertices of an even number in pairs (Zavyalov et al. 1985, V.2).
#pragma once

#include <utility>
#include <vector>

#include "geometry/describe.h"

namespace lekalo::geometry {

using Pairs = std::vector<std::pair<int, int>>;

// 1 3 5 ... (n - 1), the number of perfect matchings of n vertices (Z 186).
double matching_count(int vertices);

// The largest number of vertices of minimum_matching().
inline constexpr int kMaxExactMatching = 20;
// With more vertices exchanges take too long: they look at all triples of pairs.
inline constexpr int kMaxExchangeMatching = 300;

// The pairs with the least sum of distances, by dynamic programming over sets of vertices (2^n n steps). `distances`
// is symmetrical. Throws std::invalid_argument for an odd number, or more than kMaxExactMatching.
Pairs minimum_matching(const Grid<double>& distances);

// A matching that is the best for the six vertices of any three of its pairs: pairs by increasing distance, then any
// three replaced by the best of the 15 matchings of their vertices until none changes. It may be longer than the least.
Pairs matching_by_exchange(const Grid<double>& distances);

double weight(const Pairs& pairs, const Grid<double>& distances);

}  // namespace lekalo::geometry
