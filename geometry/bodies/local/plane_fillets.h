// Fillets between plane faces, recognised by their shape: cylinders that are smooth with a plane on both sides
// (Golovanov 2016, 6.12).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

struct PlaneFillet {
  int face;
  std::array<int, 2> planes;  // the faces beside it
  double radius;
  Vec3 center, axis;  // a point on the axis, and its direction
};

std::optional<PlaneFillet> plane_fillet(const Body& body, int face);
std::vector<PlaneFillet> plane_fillets(const Body& body);

// It meets another fillet or a ball at an end, with which it does not change.
bool ends_in_corner(const Body& body, const PlaneFillet& fillet);

// The fillet's surface with another radius between the same planes, its parameters unchanged.
SurfacePtr with_radius(const Body& body, const PlaneFillet& fillet, double radius);

// Fillets beside planes that are moved along their normals follow with their radius: their surfaces among those of the
// body's faces are moved too, but those that are changed already. Throws FieldError (that field) where a plane has
// turned.
void let_fillets_follow(const Body& body, std::vector<SurfacePtr>& surfaces, const char* field);

}  // namespace lekalo::geometry
