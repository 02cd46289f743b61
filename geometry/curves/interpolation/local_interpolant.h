// Local interpolation of evenly spaced nodes, four of them at a time, with one shape parameter (Grezdov, Filippenko
// 2010, formula 3): between f_0 and f_1, x in [0, 1],
//
//   f(x) = sum_{k=-1..2} f_k sigma_k(beta, x),   sigma = core + beta shell,
//
// each kernel a cubic Hermite segment with end derivatives m_0, m_1; D = f_1 - f_0, d_k = f_{k-1} - 2 f_k + f_{k+1}:
//
//   cardinal     m_0 = beta/2 (f_1 - f_-1),       m_1 = beta/2 (f_2 - f_0)         smooth for every beta
//   linear_core  m_0 = D - beta/2 d_0,            m_1 = D + beta/2 d_1             linear in x at beta = 0, smooth at 1
//   quadratic    m_0 = D - beta/4 (d_0 + d_1),    m_1 = D + beta/4 (d_0 + d_1)     of the second degree, continuous
//
// All reproduce straight chords at beta = 0 and quadratic polynomials at beta = 1 (cardinal and linear_core are there
// the spline of Catmull and Rom). They go through every node for any beta.
#pragma once

#include <span>
#include <string>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

enum class LocalKernel { cardinal, linear_core, quadratic };
LocalKernel local_kernel(const std::string& word);

// The nodes beyond the ends of an open row.
enum class GhostNodes {
  quadratic,  // 3 f_0 - 3 f_1 + f_2
  linear      // 2 f_0 - f_1
};

// The cells between neighbouring nodes as the exact cubic NURBS curve over `domain`, cut evenly. Open: at least 2 nodes
// (quadratic ends of 2 are linear); closed: at least 3, unrepeated.
NurbsCurve local_interpolant(std::span<const Vec3> nodes, bool closed, LocalKernel kernel, double beta,
                             GhostNodes ghosts, const Interval& domain);

// The beta for which the middles of cells of a circle cut into `cells` >= 3 lie on the circle, 2/(c (1 + c)) with
// c = cos(pi/cells), and the one for which they lie at its center, -2/sin^2(pi/cells): a rose.
double circle_beta(int cells);
double rose_beta(int cells);

}  // namespace lekalo::geometry
