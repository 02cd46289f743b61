// Surfaces of formulas with kinks as the smooth ones of which they consist (expression/branches.h), and the lines in
// which these meet.
#pragma once

#include <vector>

#include "geometry/queries/implicit_curves/implicit_branches.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// A surface over the whole domain of another one, which is the same where heights at (u, v, 0) have the right sign.
struct SmoothPart {
  SurfacePtr surface;
  std::vector<ImplicitSide> sides;
};

// A surface that is smooth alone, and one of which nothing is known: where a branch has no value in some part of the
// domain.
std::vector<SmoothPart> smooth_parts(const SurfacePtr& surface);

// The smooth parts of a surface that steps somewhere from one point to another, of which queries as a whole would find
// what bridges the gap; none of any other.
struct SteppedParts {
  std::vector<SmoothPart> parts;
  bool known = true;  // else it may step, but nothing is known of where
};
SteppedParts parts_between_steps(const SurfacePtr& surface);
// Throws std::invalid_argument where it may step and nothing is known of where.
void demand_known(const SteppedParts& stepped);
// (u, v) lies on the right sides, to rounding.
bool is_in(const SmoothPart& part, double u, double v);

// Where two parts meet and their normals differ by kSmoothEdge somewhere, in the parameter plane of both; or where they
// do not meet, for the surface steps from one to the other.
struct FreeCrease {
  Curve2Ptr image;
  int parts[2];
  bool step = false;
};
struct FreeCreases {
  std::vector<FreeCrease> lines;
  bool complete = true;
};
FreeCreases free_creases(const std::vector<SmoothPart>& parts);

}  // namespace lekalo::geometry
