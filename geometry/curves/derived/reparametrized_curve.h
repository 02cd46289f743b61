// The points of a curve with another parameter (Golovanov 2016, 2.15.3, 2.15.4).
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// r(lo + hi - t) over the same domain.
CurvePtr reversed_curve(const CurvePtr& of);

// Points from t = from to t = to, forward, or backward; the parameter begins at 0. Of a closed curve the part goes over
// the seam where it must, and from = to is all of it with another seam. Throws FieldError (fields from, to) for
// parameters outside of an open curve's domain, or a part without length.
CurvePtr trimmed_curve(const CurvePtr& of, double from, double to, bool backward);

// The same over another domain, t = affine(w).
CurvePtr with_domain(const CurvePtr& of, const Interval& domain);

// With the arc length for parameter, from 0. Agrees with it to 1e-12 of the length. Throws FieldError (field of) for a
// curve that is unbounded or without length.
CurvePtr by_arc_length(const CurvePtr& of);

// The same with the fraction of the length, 0..1.
CurvePtr by_length_fraction(const CurvePtr& of);

}  // namespace lekalo::geometry
