// Families of curves that a surface is built on: one parameter range for all (Golovanov 2016, 3.4), and values of the
// other parameter at the curves.
#pragma once

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// The curves of the field, over one domain: their own if all have the same, else 0..1. A field `match` says by which
// parameter points belong together. Throws FieldError for fewer than two, and unbounded ones.
std::vector<CurvePtr> read_family(const Fields& fields, const char* field);

// Curves over one domain, as above.
std::vector<CurvePtr> one_domain(std::vector<CurvePtr> curves, const Fields& fields);

// The period that all have; 0 where they do not have the same.
double common_period(const std::vector<CurvePtr>& curves);

// The mean distance of each curve from the next, over 17 samples; the closing one included when closed.
std::vector<double> steps_between(const std::vector<CurvePtr>& curves, bool closed);

// The values of the field, increasing, one for each curve (and one at which the first comes again when closed); where
// it is left out as far apart as the curves, over 0..1. Throws FieldError.
std::vector<double> read_nodes(const Fields& fields, const char* field, const std::vector<CurvePtr>& curves,
                               bool closed);

}  // namespace lekalo::geometry
