// A part of a surface cut out by closed loops in its parameter plane (Golovanov 2016, 3.18).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// Why curves make no trim: which of them (by number, from 0), where, and what would help.
class TrimError : public std::invalid_argument {
 public:
  TrimError(const std::string& message, std::string hint) : std::invalid_argument(message), hint(std::move(hint)) {}
  std::string hint;
};

// An open body: one face for each loop that bounds a part from outside, with the loops that lie directly in it as
// holes; loops inside holes bound parts again. `curves` (of the parameter plane, z = 0) make the loops in order: a
// closed curve is one by itself, others go on where the one before ends, whichever way they run. Loops may run either
// way. With `outside` what lies outside of the outermost loops is kept, up to the border of the surface's domain.
//
// Loops lie within the domain; in a periodic direction they may stand anywhere, not wider than the period. Curves that
// go once round a closed surface are rings: in their order across it, the first and the second bound a band, the third
// and the fourth, and so on; with `outside` the first ends what begins at the border of the domain. A seam joins two,
// where no other loop is. Throws TrimError for loops that are open, leave the domain, or cross themselves or each
// other, and for a ring that is alone.
Body trimmed_surface(const SurfacePtr& surface, const std::vector<Curve2Ptr>& curves, bool outside = false);

}  // namespace lekalo::geometry
