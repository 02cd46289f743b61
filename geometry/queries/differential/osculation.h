// What touches a curve closest at a point: osculating circle and sphere; the vector about which its frame turns.
//
//   omega = k b + chi t                        dt/ds = omega x t, and so n and b         (Darboux; Golovanov 2016, 2.1)
//   circle: centre r + n/k, radius 1/k         its centres are the curve's evolute
//   sphere: centre r + n/k + (d(1/k)/ds / chi) b                                         (do Carmo 1976, 1.7)
#pragma once

#include <optional>

#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

struct Osculation {
  struct Round {
    Vec3 center{0};
    double radius = 0;
  };
  std::optional<Vec3> darboux;  // 0 on a straight line; none where there is no frame
  std::optional<Round> circle;  // none where the curvature is 0
  std::optional<Round> sphere;  // none where the torsion is 0
};
// Of a jet of order >= 3 and the frame there.
Osculation osculation(const CurveJet& jet, const CurveCurvature& frame);

}  // namespace lekalo::geometry
