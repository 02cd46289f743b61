// T-spline surfaces (Sederberg et al. 2003; Golovanov 2016, 3.9.1): control points need not stand in full rows,
//
//   r(u, v) = sum_i N_i(u) N_i(v) w_i p_i / sum_i N_i(u) N_i(v) w_i
//
// N_i are B-splines of one degree, each on degree + 2 knots of its own. Their sum is not 1 in general.
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/splines/t_mesh.h"

namespace lekalo::geometry {

// It is held, exactly, as a NURBS surface on all knots of its functions.
class TSpline final : public Surface {
 public:
  // One point and weight (> 0; none: all 1) for each pair of functions; the domain lies where their sum is positive.
  // `edges` joins the points in pictures. In a direction with a period the functions repeat, and the domain is one
  // period, beginning at a knot. Throws FieldError (fields points, weights, domain).
  TSpline(std::vector<LocalKnots> functions, std::vector<Vec3> points, std::vector<double> weights,
          const Rectangle& domain, std::vector<std::array<int, 2>> edges = {}, const Periods& periods = {});

  Periods periods() const override { return surface_.periods(); }
  Rectangle domain() const override { return surface_.domain(); }
  SurfaceJet evaluate(double u, double v, int order) const override { return surface_.evaluate(u, v, order); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override { return surface_.enclose(box, order); }
  int enclosure_order() const override { return surface_.enclosure_order(); }
  std::optional<NurbsSurfaceForm> as_nurbs() const override { return surface_.as_nurbs(); }
  DegenerateEdges degenerate_edges() const override { return surface_.degenerate_edges(); }

  const std::vector<LocalKnots>& functions() const { return functions_; }
  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  // Where point i stands in the parameter plane: the middle knots of its functions.
  Vec2 place(int i) const;
  // The same of the second end of an edge, which may lie beyond the seam.
  Vec2 end_of(const std::array<int, 2>& edge) const;

 private:
  std::vector<LocalKnots> functions_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 2>> edges_;
  NurbsSurface surface_;
};

// Where the functions of a mesh sum to 1 if its lines near the border are full ones: (degree - 1)/2 cells from the
// border on (Golovanov 2016, 3.9). Throws FieldError (field degree) for too small a mesh.
Rectangle valid_domain(const TMesh& mesh, const std::vector<LocalKnots>& functions);

// Functions with all those that repeat them over a domain of one period, and which of them each repeats.
struct RepeatedFunctions {
  std::vector<LocalKnots> functions;
  std::vector<int> of;
};
RepeatedFunctions repeated(const std::vector<LocalKnots>& functions, const Rectangle& domain, const Periods& periods);

// All knots of the functions inside the domain, each as often as one of them has it, and the domain's ends, clamped.
std::vector<double> all_knots(const std::vector<LocalKnots>& functions, bool along_u, const Interval& domain);

// The points of least squared distance from a surface, over Gauss points of all cells between knots (Golovanov 2016,
// 3.9); of functions that are zero all over the domain points of the surface. Throws FieldError (fields of, lines).
std::vector<Vec3> fitted_points(const std::vector<LocalKnots>& functions, const std::vector<double>& weights,
                                const Rectangle& domain, const Surface& of, const Periods& periods = {});

}  // namespace lekalo::geometry
