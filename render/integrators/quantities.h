// What the `analysis` integrator can tell of a surface at a place that is seen, as a number.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"
#include "render/model/model.h"
#include "render/ray.h"

namespace lekalo::render {

// A place as quantities see it, in world space.
struct AnalysedPlace {
  const SurfacePoint& point;
  const geometry::Surface* surface = nullptr;  // whose parameters the point has; none of shapes and bare meshes
  const Object* object = nullptr;              // that is seen; null: only its surface is known
  geometry::SurfaceCurvature curvature;        // where it is asked for and known, else not regular
};

struct Quantity {
  std::string name;  // of the layer and in scenes
  // Nothing where the quantity is not known, or not finite.
  std::function<std::optional<double>(const AnalysedPlace&)> value;
  bool has_sign = false;         // 0 is the middle of its colours
  bool needs_curvature = false;  // else AnalysedPlace::curvature is left out
  bool needs_parameters = false;
  bool is_direction = false;  // no number: the normal itself, its coordinates as colour
  double stripe = 0;          // shown as light and dark stripes so wide; 0: by a scale of colours
};

// The fields of `analysis` that say which quantity, and the quantity of their values. Throws FieldError.
void add_quantity_fields(geometry::TypeDeclaration& type);
Quantity quantity_of(const geometry::Fields& fields);

// The same for quantities that a place of a surface has whoever looks at it.
void add_quantity_of_place(geometry::TypeDeclaration& type);
// NaN where it is not known. In the surface's own coordinates.
double value_on(const Quantity& quantity, const geometry::Surface& surface, double u, double v);
// Its range on bounded surfaces together, as seen at places of each, but for the outermost.
geometry::Interval range_on(const Quantity& quantity, const std::vector<geometry::SurfacePtr>& surfaces);

// The range of a list of values but for the outermost two in a hundred, its ends rounded outwards to two digits;
// symmetric where they have signs. Of one value a range about it.
geometry::Interval range_of(std::vector<double> values, bool has_sign);

}  // namespace lekalo::render
