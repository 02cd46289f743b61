// Surfaces by least squares: polynomials and splines in two variables (Zavyalov et al. 1985, I.1, II.6; Piegl, Tiller
// 1997, 9.4).
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// Points with their parameters, and weights of their squared distances (> 0; none: all 1).
struct SurfaceData {
  std::vector<Vec3> points;
  std::vector<Vec2> at;
  std::vector<double> weights;
};

struct SurfaceFitOptions {
  int degree_u = 3, degree_v = 3;
  std::vector<double> knots_u, knots_v;  // inner ones
  double stiffness = 0;                  // of the integral of r_uu^2 + 2 r_uv^2 + r_vv^2 beside the sum of squares
  int passes = 0;                        // of moving parameters to the feet of the points, each followed by another fit
};

// The spline over the domain that makes the sum of squared distances from the points at their parameters smallest.
// `data.at` becomes what the last pass made of it. Throws FieldError (field points) where the points do not determine
// it.
NurbsSurface fit_surface(SurfaceData& data, const Rectangle& domain, const SurfaceFitOptions& options);

// The same with spans halved where a point is farther away than the tolerance, in both directions, until none is.
// Throws FieldError (field tolerance) where that cannot be.
NurbsSurface fit_surface_within(SurfaceData& data, const Rectangle& domain, const SurfaceFitOptions& options,
                                double tolerance);

// Parameters of the point of a surface that is nearest to p, by Newton's method from the nearest of 33 x 33 places. The
// surface must stay.
class FootSearch {
 public:
  explicit FootSearch(const Surface& surface);
  Vec2 at(const Vec3& p) const;

 private:
  struct Start {
    Vec2 uv;
    Vec3 point;
  };
  const Surface& surface_;
  std::vector<Start> grid_;
};

}  // namespace lekalo::geometry
