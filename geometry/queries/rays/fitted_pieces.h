// Polynomial patches that agree with a surface but for a stated distance. A surface that is made of the evaluations of
// others costs much to evaluate and far more to enclose; lines meet its patches as they meet Bezier pieces.
#pragma once

#include <memory>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Share of the surface's size by which patches may differ from it; mostly it is a tenth of that.
inline constexpr double kFitDistance = 1e-12;

struct FittedPieces {
  std::vector<SurfacePiece> patches;
  std::vector<double> distances;  // of each that were seen, or what rounding makes of them
  // Where no patch comes near enough, as beside a place at which derivatives have no bounds.
  std::vector<Rectangle> rest;
};

// Over the rectangles, in each of which the surface is smooth: interpolation of degree 7 in each parameter in Chebyshev
// points, on parts as small as it takes. The distance is looked at where the error of interpolation is largest, not
// proven.
FittedPieces fitted_pieces(const Surface& surface, const std::vector<Rectangle>& boxes);

// The same over all pieces of the surface, none of them rational.
std::shared_ptr<const FittedPieces> fitted_pieces(const SurfacePtr& surface);

// While one lives, what fitted_pieces finds of a whole surface is kept for those that ask again: of a drawing both its
// rays and its lines do.
class KeptFits {
 public:
  KeptFits();
  ~KeptFits();
  KeptFits(const KeptFits&) = delete;
  KeptFits& operator=(const KeptFits&) = delete;
};

}  // namespace lekalo::geometry
