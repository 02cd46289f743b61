// Two bodies with the curves in which their boundaries meet drawn on both: edges cut at common points, faces divided.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/bodies/booleans/arrangement.h"
#include "geometry/bodies/trims/trim.h"
#include "geometry/body.h"

namespace lekalo::geometry {

// A part of an edge or of a curve of intersection that meets others at its ends only. All faces that it lies on, of
// either body, share it.
struct Strand {
  CurvePtr curve;
  int from = -1, to = -1;  // points
  EdgeKind kind = EdgeKind::regular;
  Origin origin;
  // The edge of each body that it is a part of.
  std::array<int, 2> edge{-1, -1};
};

struct ImprintedFace {
  std::vector<DirectedCurve> curves;
  // Faces of the other body on the same surface, where these have points in common.
  std::vector<int> coincident;
};

struct Imprint {
  double tolerance = 0;  // points that are nearer are one
  std::vector<Vec3> points;
  std::vector<Origin> origins;  // of points
  std::vector<Strand> strands;
  std::array<std::vector<ImprintedFace>, 2> faces;  // of either body
  // Whether a strand lies on the boundary of each body.
  std::vector<std::array<bool, 2>> lies_on;
};

// Curves of a face run so that it lies on their left in the parameter plane. Throws BooleanError.
Imprint imprint(const Body& a, const Body& b);

// +1 where loops of the face have it on their left in the parameter plane, -1 where on their right.
double side_of(const Face& face);

}  // namespace lekalo::geometry
