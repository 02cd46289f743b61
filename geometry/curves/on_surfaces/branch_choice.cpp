#include "geometry/curves/on_surfaces/branch_choice.h"

#include <fmt/format.h>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_length.h"

namespace lekalo::geometry {

namespace {

std::string list_of(const std::vector<Contour>& branches) {
  std::string text;
  constexpr size_t kListed = 6;
  for (size_t k = 0; k < branches.size() && k < kListed; ++k) {
    const Vec3 at = branches[k].curve->point(0);
    text += fmt::format("{}{} {}, length {:.4g}, through [{:.4g}, {:.4g}, {:.4g}]", k == 0 ? "" : "; ", k + 1,
                        branches[k].closed ? "closed" : "open", contour_length(branches[k]).value, at.x, at.y, at.z);
  }
  return text + (branches.size() > kListed ? "; ..." : "");
}

}  // namespace

TypeDeclaration& choose_branch(TypeDeclaration& type) {
  return type
      .optional("branch", integer().at_least(1),
                "which of several, counted as `lekalo measure` lists them; without it there must be one only")
      .optional("near", point(), "the branch that passes nearest to this point, instead");
}

CurvePtr chosen_branch(const std::vector<Contour>& branches, const Fields& f, const std::string& field) {
  const size_t count = branches.size();
  if (f.has("branch")) {
    const int branch = f.integer("branch");
    if (branch > static_cast<int>(count))
      throw FieldError("branch", fmt::format("there are only {} branches: {}", count, list_of(branches)));
    return branches[branch - 1].curve;
  }
  if (f.has("near")) {
    size_t best = 0;
    double least = kInfinity;
    for (size_t k = 0; k < count; ++k) {
      const double distance =
          project(f.vec3("near"), *contour_approximation(branches[k].curve)).foot_points.front().distance;
      if (distance < least) least = distance, best = k;
    }
    return branches[best].curve;
  }
  if (count > 1)
    throw FieldError(field, fmt::format("there are {} branches: {}", count, list_of(branches)),
                     "choose one with `branch` or `near`");
  return branches.front().curve;
}

}  // namespace lekalo::geometry
