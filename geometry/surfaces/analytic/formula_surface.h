// Surfaces given by formulas of scene files (Golovanov 2016, 3.1).
#pragma once

#include "geometry/point_formulas.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// r(u, v) = point of three formulas of u and v in Cartesian, cylindrical or spherical coordinates, over a finite
// rectangle. All derivatives are exact (jets), enclosures certified (jets of intervals in centered form). The formulas
// must be smooth inside the domain, but for what branches of abs, min, max, clamp, sign, `if`, floor, ceil, round and
// mod make of them (queries/smooth_parts.h); singular points (poles, cusps, pinch points) are welcome.
class FormulaSurface : public Surface {
 public:
  struct Closed {
    bool u = false, v = false;
  };

  // The formulas are bound to two variables, u and v. `closed`: the opposite edges are the same curve, and the
  // parameter wraps. Throws FieldError for an empty or infinite domain, a formula that has no value in it, or edges
  // that do not meet.
  FormulaSurface(PointFormulas point, const Rectangle& domain, Closed closed);

  const PointFormulas& formulas() const { return point_; }

  Rectangle domain() const override { return domain_; }
  Periods periods() const override { return {closed_.u ? domain_.u.width() : 0, closed_.v ? domain_.v.width() : 0}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return kMaxSurfaceOrder; }
  DegenerateEdges degenerate_edges() const override { return degenerate_; }

 private:
  PointFormulas point_;
  Rectangle domain_;
  Closed closed_;    // set once the edges are known to meet
  double size_ = 0;  // of what the formulas gave where they were tried
  DegenerateEdges degenerate_;
  bool has_branches_ = false;
};

}  // namespace lekalo::geometry
