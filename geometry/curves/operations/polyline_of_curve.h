// Polylines within a tolerance of a curve (Zavyalov et al. 1985, I.4).
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

struct PolylineOptions {
  bool balanced = false;  // vertices beside the curve, which then lies on both sides
  bool even = false;      // equal steps of the parameter between corners
};

// A polyline with the curve's parameter at its vertices, nowhere farther from the curve than the tolerance (at the same
// parameters where it is balanced); corners of the curve are vertices of one that is not. Throws FieldError (field of)
// for an infinite domain, (field tolerance) for too many sides.
NurbsCurve polyline_of_curve(const Curve& curve, double tolerance, const PolylineOptions& options = {});

}  // namespace lekalo::geometry
