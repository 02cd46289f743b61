// The accompanying trihedron of a curve on one surface, or on two that meet in it (Grezdov, Filippenko 2010, formulas 7
// to 11): t the unit tangent, b = t x n,
//
//   n = n_F                                               the curve belongs to F
//   n = (w n_F + (1 - w) n_W) / |w n_F + (1 - w) n_W|     both count; w = 1/2 halves the angle of the normals
//
// The normals are those of the surfaces' points nearest to the curve's; what is left in them along t is taken away.
#pragma once

#include <vector>

#include "geometry/queries/closest/closest_point.h"

namespace lekalo::geometry {

class SurfaceTrihedron {
 public:
  // One surface, or two; `share` in [0, 1] is the w of the first. Throws std::invalid_argument for unbounded surfaces
  // that are no planes.
  explicit SurfaceTrihedron(const std::vector<SurfacePtr>& surfaces, double share = 0.5);

  // z is the tangent, x = n, y = z x n = b. The jet is of order >= 1. Throws std::invalid_argument at a singular point,
  // and where n vanishes: normals opposite to each other, or along the curve.
  Frame at(const CurveJet& jet) const;

 private:
  struct Side {
    SurfacePtr surface;
    SurfaceProjector projector;
    double weight;
  };
  std::vector<Side> sides_;
};

}  // namespace lekalo::geometry
