// NURBS curves: piecewise rational curves of any degree on any valid knot vector.
//
//   r(t) = sum N_j^p(t) w_j p_j / sum N_j^p(t) w_j                          (Golovanov 2016, 2.9.1)
//
// over [t_p, t_{n+1}]. Polylines, Bezier curves and exact conic arcs are special cases.
#pragma once

#include "geometry/curves/splines/spline_axis.h"

namespace lekalo::geometry {

class NurbsCurve final : public Curve {
 public:
  // Unrepeated control points and their weights (none: all 1). Weights may be zero or negative as long as the
  // denominator keeps one sign over the knots' domain; only their ratios matter. `axis` may be restricted to a part.
  // Throws FieldError (fields points, weights) when counts do not agree with the axis, or the denominator vanishes.
  NurbsCurve(SplineAxis axis, std::span<const Vec3> points, std::span<const double> weights = {});

  // The curve of a form over the form's domain; its parameter is the form's rational one (maps are not read).
  explicit NurbsCurve(const NurbsCurveForm& form);

  Interval domain() const override { return axis_.domain(); }
  double period() const override { return axis_.period(); }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::optional<NurbsCurveForm> as_nurbs() const override;

  int degree() const { return axis_.degree(); }
  const SplineAxis& axis() const { return axis_; }
  // Homogeneous control points; those of a periodic curve are repeated as its axis says.
  const std::vector<Vec4>& points() const { return points_; }

 private:
  void check_denominator() const;
  bool add_hull_of_span(int span, Box3& hull) const;

  SplineAxis axis_;
  std::vector<Vec4> points_;
  bool rational_ = false;
};

// Lengths of the sides of a control polygon, the closing one included when closed.
std::vector<double> polygon_steps(std::span<const Vec3> points, bool closed);

}  // namespace lekalo::geometry
