// A surface from a function of number types, for tests.
#pragma once

#include "geometry/formula.h"
#include "geometry/surface.h"

namespace lekalo::tests {

template <class Formula>
class SurfaceOfFormula final : public geometry::Surface {
 public:
  SurfaceOfFormula(Formula formula, geometry::Rectangle domain) : formula_(formula), domain_(domain) {}
  geometry::Rectangle domain() const override { return domain_; }
  geometry::SurfaceJet evaluate(double u, double v, int order) const override {
    return geometry::evaluate_surface_formula(formula_, u, v, order);
  }
  geometry::SurfaceEnclosure enclose(const geometry::Rectangle& box, int order) const override {
    return geometry::enclose_surface_formula(formula_, box, order);
  }

 private:
  Formula formula_;
  geometry::Rectangle domain_;
};

}  // namespace lekalo::tests
