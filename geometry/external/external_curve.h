// Curves that code outside the program evaluates.
#pragma once

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/external/external_function.h"
#include "geometry/external/spline_fit.h"

namespace lekalo::geometry {

// r(t) over a finite domain as an ExternalFunction gives it; for all that needs more than values, a spline through its
// points, as for ExternalSurface.
class ExternalCurve final : public Curve {
 public:
  // `order`: the highest that the function knows (0..kMaxCurveOrder); higher derivatives are those of the spline.
  // `tolerance`: the largest distance of the spline from the function, as part of the diameter of the curve's points.
  // Throws FieldError for an empty or infinite domain (domain), ends that do not meet (closed) and a function that no
  // spline comes near to (tolerance); ExternalError.
  ExternalCurve(std::shared_ptr<const ExternalFunction> function, const Interval& domain, bool closed, int order,
                double tolerance);

  Interval domain() const override { return domain_; }
  double period() const override { return closed_ ? domain_.width() : 0; }
  // Throw ExternalError.
  CurveJet evaluate(double t, int order) const override;
  void evaluate_many(std::span<const double> t, int order, std::span<CurveJet> result) const override;
  double fit_distance() const override { return order_ > 0 ? 0 : report_.distance(); }
  // Of the spline, wider by what the function was seen to differ from it.
  CurveEnclosure enclose(const Interval& t, int order) const override;
  std::optional<NurbsCurveForm> as_nurbs() const override { return fit_->as_nurbs(); }

  const FitReport& report() const { return report_; }

 private:
  std::shared_ptr<const ExternalFunction> function_;
  Interval domain_;
  bool closed_;
  int order_;
  FitReport report_;
  std::shared_ptr<const NurbsCurve> fit_;
};

}  // namespace lekalo::geometry
