// The image of a conic in the parameter plane of a canonical surface on which it lies: u and v as functions of the
// conic's own parameter, by the surface's inverse formulas.
#pragma once

#include <optional>
#include <vector>

#include "geometry/queries/quadrics/canonical_surface.h"

namespace lekalo::geometry {

class ConicImage final : public Curve {
 public:
  // The conic in space, over a finite part. Angles start in the surface's domain and go on beyond it where they have
  // to; where the conic passes through a pole they jump.
  ConicImage(CanonicalSurface surface, const Conic& conic, const Interval& t);

  Interval domain() const override { return domain_; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  std::vector<CurvePiece> pieces() const override;

  // The conic comes so near to a pole, but not through it, that angles are not known.
  bool passes_beside_pole() const { return beside_pole_; }

 private:
  // Where u and v change by less than half a turn.
  struct Part {
    Interval t;
    // At the middle: the point's direction as seen from the axis and u; of a torus the same on its meridian and v.
    Vec2 direction{1, 0}, on_meridian{1, 0};
    double u = 0, v = 0;
    double side = 1;             // -1 beyond a cone's apex
    std::optional<double> pole;  // at an end of the part
  };
  void divide(const std::vector<double>& poles);
  std::vector<double> find_poles();
  Part made(const Interval& t, const std::vector<double>& poles) const;
  template <class T>
  Triple<T> place(const Part& part, const T& t) const;
  // The point in q as (across the axis) / factor; the factor, positive, is 1 but near poles.
  template <class T>
  Triple<T> seen(const Part& part, const T& t, T& factor) const;

  CanonicalSurface surface_;
  Conic conic_;  // in q
  Interval domain_;
  std::vector<Part> parts_;
  bool beside_pole_ = false;
};

}  // namespace lekalo::geometry
