// Frames that move along a curve: the tangent T, a direction w across it, and T x w.
//
//   normal, binormal       of the curve (Golovanov 2016, 2.1)
//   rotation_minimizing    turns about the tangent no more than it must, w' = -(w . T') T (Bishop 1975); of a closed
//                          curve it turns beside that by the angle that closes it, evenly with the length
//   fixed                  as near as possible to a given direction
//   on_surface             N x T, N the normal of a surface on which the curve lies
//
// w has no closed form by the derivatives of the curve alone that would give bounds of its second derivative. So it is
// a polynomial on each of some parts of the curve that agrees with the direction meant to 1e-13.
#pragma once

#include "geometry/curves/splines/polynomial_curve.h"
#include "geometry/describe.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

enum class FrameKind { normal, binormal, rotation_minimizing, fixed, on_surface };

struct FrameLaw {
  FrameKind kind = FrameKind::rotation_minimizing;
  Vec3 fixed{0, 0, 1};  // of the kind fixed
  // Of rotation_minimizing: as near as possible to w where the curve begins (zero: any), and the angle in radians by
  // which w turns more than it must from there to the end, evenly with the length.
  Vec3 start{0};
  double twist = 0;
  SurfacePtr on;  // of the kind on_surface
};

// w over the curve's domain, with the curve's parameter. Throws FieldError (fields of, across, start, on) for a curve
// without such directions: unbounded, with a corner, resting somewhere, straight somewhere for the normals, along the
// fixed direction, or not on the surface.
std::shared_ptr<const PolynomialCurve> direction_across(const Curve& curve, const FrameLaw& law);

// A law from the fields of a declaration: `across` (a direction, or the word rotation_minimizing, normal, binormal),
// and where these are declared `start`, `twist` (radians) and `on` (a surface). Throws FieldError for those that do not
// go together.
FrameLaw read_frame_law(const Fields& fields);

}  // namespace lekalo::geometry
