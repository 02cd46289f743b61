// Surfaces of sections that an axis system M carries along a path while they change,
//
//   r(w, t) = g(t) + M(t) sum a_i(t) c_i(w)
//
// as a family of curves g and a_i m_k, m_k the columns of M, with functions of w, 1 and the coordinates of c_i: sums of
// products, whose derivatives and enclosures need series of one variable only (boolean_sum.h).
#pragma once

#include <array>

#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

// path: g. axes: m_k, to which the coordinates x, y, z of a section go. sections: c_i with the functions a_i; one
// section alone has a_0 = 1.
Family moved_sections(const CurvePtr& path, const std::array<CurvePtr, 3>& axes, const Family& sections);

}  // namespace lekalo::geometry
