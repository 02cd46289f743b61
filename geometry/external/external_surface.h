// Surfaces that code outside the program evaluates.
#pragma once

#include "geometry/external/external_function.h"
#include "geometry/external/spline_fit.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

// r(u, v) over a finite rectangle as an ExternalFunction gives it. evaluate() asks the function; pieces(), as_nurbs()
// and with them all rays take a spline through its points, which was compared with the function at many places: what it
// does between them is not known. Outside the domain, where the function is never asked, the spline goes on.
class ExternalSurface final : public Surface {
 public:
  struct Closed {
    bool u = false, v = false;
  };

  // `order`: the highest that the function knows (0..kMaxSurfaceOrder); higher derivatives are those of the spline.
  // `tolerance`: the largest distance of the spline from the function, as part of the diameter of the surface's points.
  // Throws FieldError for an empty or infinite domain (domain), edges that do not meet (closed) and a function that no
  // spline comes near to (tolerance); ExternalError.
  ExternalSurface(std::shared_ptr<const ExternalFunction> function, const Rectangle& domain, Closed closed, int order,
                  double tolerance);

  Rectangle domain() const override { return domain_; }
  Periods periods() const override { return {closed_.u ? domain_.u.width() : 0, closed_.v ? domain_.v.width() : 0}; }
  // Throw ExternalError.
  SurfaceJet evaluate(double u, double v, int order) const override;
  void evaluate_many(std::span<const Vec2> uv, int order, std::span<SurfaceJet> result) const override;
  double fit_distance() const override { return order_ > 0 ? 0 : report_.distance(); }
  // Of the spline, wider by what the function was seen to differ from it.
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override { return fit_->as_nurbs(); }
  DegenerateEdges degenerate_edges() const override { return fit_->degenerate_edges(); }

  const FitReport& report() const { return report_; }

 private:
  // The spline's points for pieces that end at these parameters.
  NurbsSurface fitted(const std::vector<double>& breaks_u, const std::vector<double>& breaks_v) const;
  void fit();

  std::shared_ptr<const ExternalFunction> function_;
  Rectangle domain_;
  Closed closed_;
  int order_;
  FitReport report_;
  std::shared_ptr<const NurbsSurface> fit_;
};

}  // namespace lekalo::geometry
