// Rational formulas as NURBS curves (Golovanov 2016, 2.5, 2.6).
#pragma once

#include <optional>

#include "geometry/curve.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

// weight(t) and weight(t) times each coordinate of the point are polynomials of `degree`: of t where `speed` is 0, else
// of the cosine and sine of speed * t.
struct RationalLaw {
  Expression weight;  // of one variable, t
  int degree = 0;
  double speed = 0;
};

// An exact form in the parameter s = speed * t: its knots and maps are those of s.
struct RationalForm {
  NurbsCurveForm form;
  double speed = 1;
};

// Over a bounded domain of t. Nothing where the weight is not known to keep its sign, or the form's degree (that of the
// law, twice as much in cosines) is above kMaxDegree, or it turns more than a thousand times. That the law holds is not
// checked.
std::optional<RationalForm> rational_form(const PointFormulas& point, const RationalLaw& law, const Interval& domain);

}  // namespace lekalo::geometry
