// Steps of a parameter over which a curve's tangent or a surface's normal turns by an angle, to the first order
// (Golovanov 2016, 4.12): by them trial points are as dense as the bends ask, at any scale of the model.
//
//   curve     |r'|^2 a/|r' x r''|
//   surface   a/|m_u|, a/|m_v|,  |m_u|^2 = 2 H L - K E: how the normal turns, twist included
#pragma once

#include "geometry/queries/differential/fundamental_forms.h"

namespace lekalo::geometry {

// The angle in radians; the jet of order >= 2. Infinite where nothing turns; 0 at a singular point.
double turning_step(const CurveJet& jet, double angle);
// Along u and along v.
Vec2 turning_steps(const FundamentalForms& forms, double angle);

}  // namespace lekalo::geometry
