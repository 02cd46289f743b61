// Curves and surfaces as entities of STEP files (ISO 10303-42).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "geometry/body.h"
#include "render/step/step_writer.h"

namespace lekalo::render {

class StepGeometry {
 public:
  // Called with the largest distance seen between a fit and what it stands for.
  using Fitted = std::function<void(double deviation)>;
  // `tolerance`: of fits, of the size of each.
  StepGeometry(StepWriter& writer, double tolerance, Fitted fitted)
      : writer_(writer), tolerance_(tolerance), fitted_(std::move(fitted)) {}

  // The curve over its domain runs in the entity's direction. Throws std::invalid_argument for an unbounded curve, or
  // one that no fit comes near to.
  std::string curve(const geometry::Curve& curve);

  struct SurfaceEntity {
    std::string name;
    bool forward = true;  // its normal is r_u x r_v
  };
  // Throws std::invalid_argument as curve().
  SurfaceEntity surface(const geometry::SurfacePtr& surface);

 private:
  std::string spline(const geometry::NurbsCurveForm& form);
  std::string spline(const geometry::NurbsSurfaceForm& form);
  std::optional<SurfaceEntity> elementary(const geometry::SurfacePtr& surface);
  std::optional<SurfaceEntity> extruded(const geometry::SurfacePtr& surface);
  std::optional<SurfaceEntity> revolved(const geometry::SurfacePtr& surface);

  StepWriter& writer_;
  double tolerance_;
  Fitted fitted_;
};

}  // namespace lekalo::render
