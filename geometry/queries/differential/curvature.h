// Curvatures of curves and surfaces at a point, from their derivatives.
#pragma once

#include <optional>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Frenet's frame, curvature and torsion (Golovanov 2016, 2.1.2-2.1.4). At a singular point (r' = 0) nothing is known;
// at a straightening point (r' parallel to r'') the curvature is 0 and normal, binormal and torsion are not defined.
struct CurveCurvature {
  bool has_tangent = false;
  bool has_curvature = false;
  bool has_normal = false;
  bool is_straight = false;  // part of a straight line: curvature and torsion are 0, there is no normal
  Vec3 tangent{0}, normal{0}, binormal{0};
  double curvature = 0;  // >= 0, 1/length
  double torsion = 0;    // positive for a right-handed helix
};
CurveCurvature curvature(const CurveJet& jet);  // order >= 3

// The same at a parameter, where the curve tells what is rounding: derivatives below 1e-12 of its smooth piece are
// none. At a singular point the tangent is the limit from greater t (at the end of the domain from smaller), along the
// second or third derivative, the first that does not vanish; a cusp's other side has the opposite one.
CurveCurvature curvature(const Curve& curve, double t);

// Gaussian, mean and principal curvatures, signed by the normal: a convex surface seen from outside has negative ones
// (Golovanov 2016, 3.1.4-3.1.12). principal[0] >= principal[1]; directions are unit vectors of space.
struct SurfaceCurvature {
  bool regular = false;  // false: all that follows is not known
  double gaussian = 0, mean = 0;
  double principal[2] = {0, 0};
  Vec3 directions[2]{Vec3(0), Vec3(0)};
};
// At a regular place, r_u x r_v != 0. The jet is of order >= 2, the normal of length 1.
SurfaceCurvature curvature(const SurfaceJet& jet, const Vec3& normal);

// The same from the shape operator, the symmetric map S of space with dm = -S dr and S m = 0; and that of it.
SurfaceCurvature curvature(const Mat3& shape_operator, const Vec3& normal);
Mat3 shape_operator(const SurfaceCurvature& curvature);
// Of a surface whose normal is turned by `sign`; nothing where r_u x r_v vanishes or the second derivatives are not
// known.
std::optional<Mat3> shape_operator(const Surface& surface, double sign, double u, double v);

// The same everywhere in the domain: where r_u x r_v vanishes, and beside such a place, the limit from inside if there
// is one, the same for all directions at a pole. There is none at the tip of a cone. To about 1e-7 of the curvature, or
// of 1 / the length of the parameter lines where the surface is flatter.
SurfaceCurvature curvature(const Surface& surface, double u, double v);

}  // namespace lekalo::geometry
