// Ribbons: strips of constant width along a curve.
//
//   r(u, v) = c(u) + v w(u),   |w| = 1,   w . c' = 0
//
// The direction across, w, is one of
//
//   normal, binormal       of the curve (Golovanov 2016, 2.1)
//   rotation_minimizing    turns about the tangent no more than it must, w' = -(w . T') T (Bishop 1975); of a closed
//                          curve it turns beside that by the angle that closes it, evenly with the length
//   fixed                  as near as possible to a given direction
//   flat                   N x T, N the normal of a surface on which the curve lies
//
// w has no closed form by the derivatives of c alone that would give bounds on r_uu. So it is a polynomial on each of
// some parts of the curve that agrees with the direction meant to 1e-13; the points r(u, 0) are those of the curve.
#pragma once

#include "geometry/numerics/polynomial_part.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

enum class RibbonKind { normal, binormal, rotation_minimizing, fixed, flat };

struct RibbonDirection {
  RibbonKind kind = RibbonKind::rotation_minimizing;
  Vec3 fixed{0, 0, 1};  // of the kind fixed
  // Of rotation_minimizing: as near as possible to w where the curve begins (zero: any), and the angle in radians by
  // which w turns more than it must from there to the end, evenly with the length.
  Vec3 start{0};
  double twist = 0;
  SurfacePtr on;  // of the kind flat
};

// u is the curve's own parameter, v in [-width/2, width/2] a length; the normal is (tangent) x (w).
class Ribbon final : public Surface {
 public:
  // Throws FieldError (fields of, width, across, start, on) for a curve without such directions: with a corner, resting
  // somewhere, straight somewhere for the normals, along the fixed direction, or not on the surface.
  Ribbon(CurvePtr curve, double width, const RibbonDirection& direction);

  Rectangle domain() const override { return domain_; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  std::vector<SurfacePiece> pieces() const override;

  // The direction w and its derivatives up to `order`.
  CurveJet direction(double u, int order) const;

  static constexpr int kTerms = 14;
  using Part = PolynomialPart<kTerms>;  // w over a range of u

 private:
  CurvePtr curve_;
  Rectangle domain_;
  std::vector<Part> parts_;
};

}  // namespace lekalo::geometry
