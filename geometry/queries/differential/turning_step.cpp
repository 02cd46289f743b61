#include "geometry/queries/differential/turning_step.h"

namespace lekalo::geometry {

double turning_step(const CurveJet& jet, double angle) {
  const double speed = glm::dot(jet.d[1], jet.d[1]);
  return speed > 0 ? angle * speed / glm::length(glm::cross(jet.d[1], jet.d[2])) : 0;
}

Vec2 turning_steps(const FundamentalForms& forms, double angle) {
  return {angle / glm::length(forms.normal_du), angle / glm::length(forms.normal_dv)};
}

}  // namespace lekalo::geometry
