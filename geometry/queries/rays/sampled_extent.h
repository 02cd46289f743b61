// How large parts of a surface are where its enclosures tell too little: about places where a formula is 0/0 or has a
// pole, and beside them.
#pragma once

#include "geometry/queries/rays/cell_model.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class SampledExtent {
 public:
  explicit SampledExtent(const Surface& surface);

  // The larger of its shares of the domain's width and height.
  double share(const Rectangle& cell) const;
  // Half of the diameter of a cell, by its model if that may be true, else by its points. Where derivatives have no
  // bounds (a root of zero, a step, a pole, 0/0) not much more than the cell's share of the domain is of the surface:
  // all cells would be spent there.
  double size(const Rectangle& cell, const CellModel& model) const;
  // A box that holds the cell: of the hulls of so many of its parts that it is not much larger than the cell, if that
  // can be had. What is left unbounded of a part smaller than kSmallestCell of the domain counts by its points, as
  // lines meet it only there; but at a pole the box has no bounds.
  Box3 hull(const Rectangle& cell, const CellModel& model) const;

 private:
  // Whether a cell with this model may be as large as its bounds say.
  static bool is_plausible(double by_bounds, const CellModel& model);
  Box3 points(const Rectangle& cell) const;  // of those that are finite

  const Surface& surface_;
  Rectangle domain_;
  double typical_ = 0;
};

}  // namespace lekalo::geometry
