// Where a curve goes into or out of something that only straight lines are known to meet: by the chords of ever shorter
// parts.
#pragma once

#include <functional>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// Adds where the chord meets it, 0 to 1.
using ChordHits = std::function<void(const Line& chord, std::vector<double>& hits)>;

// Adds the places on the curve, by t. `box` is around what is met, `size` that of the scene: a part as near to its
// chord as 1e-11 of it is one. What a curve only dips into, less deep than 1e-5 of the size, may be missed.
void add_entries(const Curve& curve, const Box3& box, double size, const ChordHits& add_hits,
                 std::vector<double>& places);

}  // namespace lekalo::geometry
