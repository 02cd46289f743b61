// Where three surfaces or bodies meet: all common points (Golovanov 2016, 4.5; capability 4.5b).
//
// The curves of two of them (geometry/queries/contours), none of which is lost, meet the third
// (geometry/queries/intersections/curve_intersections.h). Where enclosures of such a curve are too wide, next to poles,
// that search goes on from the middle of a stretch: a second crossing of it could be lost there. Three planes have one
// point in closed form (4.5.2).
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "geometry/body.h"
#include "geometry/contour.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

using SurfaceOrBody = std::variant<SurfacePtr, BodyPtr>;

struct CommonPoint {
  Vec3 point{0};
  std::array<Vec2, 3> places{};          // u, v on each
  std::array<int, 3> faces{-1, -1, -1};  // of a body
  double distance = 0;                   // the largest between two of them
  bool contact = false;                  // the normals lie in one plane: the surfaces do not cross in this point only
};
// A curve that all three have; in a trimmed face where its middle is.
struct CommonCurve {
  CurvePtr curve;
  Interval t;
};
struct CommonPoints {
  std::vector<CommonPoint> points;  // ordered by x, then y, then z
  std::vector<CommonCurve> curves;  // their ends are not among the points
  // False where all three coincide, or each pair coincides or touches along a curve: what these have is left out.
  bool complete = true;
};

// `tolerance` is relative to the size of all. Throws std::invalid_argument for unbounded surfaces other than planes.
CommonPoints common_points(const std::array<SurfaceOrBody, 3>& of, double tolerance = kSamePoint);

}  // namespace lekalo::geometry
