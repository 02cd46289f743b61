// Rough surfaces of tiny mirrors whose normals are spread as Trowbridge and Reitz's (GGX), with Smith's shadowing at
// correlated heights (Walter et al. 2007; Heitz, "Understanding the masking-shadowing function", 2014). With
// alpha_x, alpha_y the slopes along x and y:
//
//   D(h) = 1 / (pi a_x a_y (h_x^2/a_x^2 + h_y^2/a_y^2 + h_z^2)^2)
//   L(w) = (-1 + sqrt(1 + (a_x^2 w_x^2 + a_y^2 w_y^2) / w_z^2)) / 2
//   G(out, in) = 1 / (1 + L(out) + L(in)),  G(out) = 1 / (1 + L(out))
//
// D G(out) max(0, out.h) / out.z is the density of the facets that are seen; sampled by spherical caps (Dupuy and
// Benyoub 2023).
#pragma once

#include "render/lobes/lobe.h"

namespace lekalo::render {

// Below this slope a surface is smooth: its lobe would be narrower than floats tell directions apart.
inline constexpr double kSmoothSlope = 1e-3;

class Microfacets {
 public:
  Microfacets(double alpha_x, double alpha_y) : x_(alpha_x), y_(alpha_y) {}

  bool smooth() const { return x_ < kSmoothSlope && y_ < kSmoothSlope; }
  double facets(const Vec3& h) const;                           // D
  double seen(const Vec3& out) const;                           // G(out)
  double seen_and_lit(const Vec3& out, const Vec3& in) const;   // G(out, in), also for `in` behind
  double visible_facets(const Vec3& out, const Vec3& h) const;  // density of the facets seen
  Vec3 visible_facet(const Vec3& out, const Vec2& square) const;

 private:
  double lambda(const Vec3& w) const;

  double x_, y_;
};

// alpha = roughness^2, stretched by `anisotropy` in [0, 1): alpha_x = alpha sqrt(2 / (1 + (1 - a)^2)) along x,
// alpha_y = (1 - a) alpha_x across (OpenPBR's scale).
Microfacets microfacets(double roughness, double anisotropy);

}  // namespace lekalo::render
