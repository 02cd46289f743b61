// Surfaces on families of curves, for whoever makes other things of them (Golovanov 2016, 3.3.1, 3.4).
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/describe.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// (1 - v) first(u) + v second(u): curves over one domain.
SurfacePtr ruled_surface(const CurvePtr& first, const CurvePtr& second);

// c(u) + g(v) - g(v_min); both bounded.
SurfacePtr translation_surface(const CurvePtr& c, const CurvePtr& g);

// Declares how the curves of a loft are joined (method, at_v, closed, match, degree, knots, weights).
void declare_loft(TypeDeclaration& type);

// The loft that these fields say on curves over one domain (curve_family.h). Throws FieldError.
SurfacePtr loft_surface(const Fields& fields, const std::vector<CurvePtr>& curves);

}  // namespace lekalo::geometry
