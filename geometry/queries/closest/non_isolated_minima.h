// Minima that are not isolated: many places that are as near become one minimum with ranges.
#pragma once

#include "geometry/queries/closest/distance_search.h"

namespace lekalo::geometry {

// `flats`: pairs of parallel elements that are straight or plane, which are not searched: what is nearest on them
// reaches to their borders. The places found there become one minimum of the pair.
void merge_minima_of_parallels(std::vector<ElementPair> flats, double size, std::vector<FoundMinimum>& found);

// Of a curve all of which lies on the curved patches of the other operand: that it does so, for each of its surfaces.
// None of other operands.
std::vector<FoundMinimum> minima_of_curve_on_patches(const DistanceElements& a, const DistanceElements& b, double size);

// Parts of one such minimum on neighbouring elements become one; a border of it is not another.
void join_non_isolated_minima(double size, std::vector<FoundMinimum>& found);

}  // namespace lekalo::geometry
