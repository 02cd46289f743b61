// NURBS surfaces: tensor products of B-splines, rational, of any degrees on any valid knot vectors.
//
//   r(u, v) = sum_i sum_j N_i^p(u) N_j^q(v) w_ij p_ij / (the same with w_ij alone)      (Golovanov 2016, 3.8.1)
//
// The first index of a point runs with u, the second with v (Golovanov's own grids are transposed). Bezier surfaces
// (3.7) are those on the knots 0, .., 0, 1, .., 1.
#pragma once

#include "geometry/curves/splines/spline_axis.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class NurbsSurface final : public Surface {
 public:
  // Unrepeated control points, row i at points[i * v.distinct()], and their weights in the same order (none: all 1).
  // Weights may be zero or negative as long as the denominator keeps one sign. The axes may be restricted to parts.
  // Throws FieldError (fields points, weights) when counts do not agree with the axes, or the denominator vanishes.
  NurbsSurface(SplineAxis u, SplineAxis v, std::span<const Vec3> points, std::span<const double> weights = {});

  // The surface of a form over the form's domain; its parameters are the form's rational ones (maps are not read).
  explicit NurbsSurface(const NurbsSurfaceForm& form);

  Rectangle domain() const override { return {u_.domain(), v_.domain()}; }
  Periods periods() const override { return {u_.period(), v_.period()}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return kMaxSurfaceOrder; }
  std::optional<NurbsSurfaceForm> as_nurbs() const override { return form_; }
  DegenerateEdges degenerate_edges() const override { return degenerate_; }

  const SplineAxis& axis_u() const { return u_; }
  const SplineAxis& axis_v() const { return v_; }
  // Degrees, knots and homogeneous points; those of a periodic direction are repeated as its axis says.
  const NurbsSurfaceForm& form() const { return form_; }

 private:
  void finish();

  SplineAxis u_, v_;
  NurbsSurfaceForm form_;
  bool rational_ = false;
  DegenerateEdges degenerate_;
};

// Which edges of the form's part over `domain` shrink to a point: all Cartesian control points of the edge agree to
// kCollapsedEdge of the net's size.
DegenerateEdges collapsed_edges(const NurbsSurfaceForm& form, const Rectangle& domain);

// The field `weights` of a net, or none. Throws FieldError when its shape is not that of `points`.
std::vector<double> weights_of_net(const Fields& fields);

}  // namespace lekalo::geometry
