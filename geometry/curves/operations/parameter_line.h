// Parameter lines of surfaces: s(a, t) with u held at a, or s(t, a) with v held (Golovanov 2016, 3.1).
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

enum class IsoDirection { u, v };

// A parameter line over the surface's domain or a part of it, its parameter being the other of u and v.
class ParameterLine final : public Curve {
 public:
  // Throws std::invalid_argument for a surface that is unbounded that way and no range, or `at` outside of its domain.
  ParameterLine(SurfacePtr surface, IsoDirection held, double at, std::optional<Interval> range = std::nullopt);

  Interval domain() const override { return domain_; }
  double period() const override;
  // Throws std::invalid_argument for an order above kMaxSurfaceOrder.
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override { return surface_->max_order(); }
  double fit_distance() const override { return surface_->fit_distance(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return surface_->enclosure_order(); }
  std::vector<CurvePiece> pieces() const override;

  // Its exact form, where the surface has one.
  std::optional<NurbsCurveForm> form() const;

 private:
  bool holds_u() const { return held_ == IsoDirection::u; }

  SurfacePtr surface_;
  IsoDirection held_;
  double at_;
  Interval domain_;
};

}  // namespace lekalo::geometry
