// The equations of foot points on rational Bezier pieces as polynomials in Bernstein form.
//
// With r = A/w, D = |A - q w|^2 and q the point, (p - r) . r' has the sign of
//
//   2 D w' - D' w = G0 - 2 q . G,   G0 = 2 (A.A) w' - (A.A)' w,   G = 2 (A w) w' - (A w)' w
//
// (the part of |q|^2 vanishes), of a degree below 3n; of surfaces likewise by each parameter. G0 and G do not depend on
// the point: they are made once. What is zero where is told by the signs of the coefficients (Descartes's rule; Lane,
// Riesenfeld 1981) and of surfaces by Krawczyk's operator with derivatives bounded by differences of coefficients, for
// all polynomials whose coefficients lie within the rounding error of those computed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Parts of the unit interval or square.
template <class Box, class Place>
struct FootPointZeros {
  struct Single {
    Box within;  // holds exactly one zero, a simple one
    Place near;  // to it
  };
  std::vector<Single> single;
  std::vector<Box> undecided;  // zeros that are multiple, near to each other, or on borders of these parts
};
using CurveFootPointZeros = FootPointZeros<Interval, double>;
using SurfaceFootPointZeros = FootPointZeros<Rectangle, std::array<double, 2>>;

// Of a curve piece.
class FootPointPolynomial {
 public:
  static constexpr int kMaxDegree = 8;  // of the piece
  // `origin`: any point near the piece; coordinates are seen from there.
  FootPointPolynomial(std::span<const Vec4> points, const Vec3& origin);

  // All zeros for the point p; false if the polynomial vanishes but for rounding.
  bool isolate(const Vec3& p, CurveFootPointZeros& found) const;

 private:
  std::vector<Vec4> coefficients_;  // G, G0
  Vec3 origin_;
  double reach_, min_error_;  // the error of a coefficient is below min_error_ (reach_ + |q|)^2
};

// Of a patch.
class FootPointPolynomials {
 public:
  static constexpr int kMaxDegree = 6;
  FootPointPolynomials(const SurfacePiece& piece, const Vec3& origin);

  // All zeros for the point p; false if there are too many undecided parts to tell them apart.
  bool isolate(const Vec3& p, SurfaceFootPointZeros& found) const;

  // Nets of coefficients: rows with u, columns with v, whose number is a multiple of four (they are elevated).
  struct Net {
    int rows = 0, columns = 0;
    std::vector<double> values;
  };

 private:
  std::array<std::array<Net, 4>, 2> nets_;  // [by u, by v][G, G0]
  Vec3 origin_;
  double reach_, min_error_;
};

}  // namespace lekalo::geometry
