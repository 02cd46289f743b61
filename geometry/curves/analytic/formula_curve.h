// Curves given by formulas of scene files (Golovanov 2016, 2.1).
#pragma once

#include "geometry/curve.h"
#include "geometry/curves/analytic/rational_form.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

// r(t) = point of three formulas of t in Cartesian, cylindrical or spherical coordinates, over a finite domain. All
// derivatives are exact (jets), enclosures certified (jets of intervals in centered form). Kinks, steps and poles part
// its pieces (formula_breaks.h); over a piece enclosures hold the limits at its ends from inside.
class FormulaCurve final : public Curve {
 public:
  // The formulas are bound to one variable, t. `closed`: r(lo) = r(hi), and the parameter wraps. Throws FieldError for
  // an empty or infinite domain, a formula that has no value in it, or ends that do not meet.
  // `law`: that the formulas are rational, where it is known.
  FormulaCurve(PointFormulas point, const Interval& domain, bool closed = false,
               const std::optional<RationalLaw>& law = {});

  Interval domain() const override { return domain_; }
  double period() const override { return closed_ ? domain_.width() : 0; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::vector<CurvePiece> pieces() const override;
  // Of rational formulas of t, or of cosines and sines of t itself.
  std::optional<NurbsCurveForm> as_nurbs() const override;
  // Of all rational ones.
  const std::optional<RationalForm>& rational() const { return rational_; }
  CurvePtr continued(const Interval& domain) const override {
    return std::make_shared<FormulaCurve>(point_, domain, false);
  }

 private:
  PointFormulas point_;
  Interval domain_;
  bool closed_ = false;  // set once the ends are known to meet
  std::vector<Interval> stretches_;
  std::optional<RationalForm> rational_;
  double size_ = 0;  // of what the formulas gave where they were tried
};

}  // namespace lekalo::geometry
