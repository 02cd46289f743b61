// The boundary of a body that a profile makes as it moves (Golovanov 2016, 5.7, 5.8): side faces between the first and
// the last place of each segment, and two plane ends, or none where the path is closed.
#pragma once

#include <array>
#include <optional>

#include "geometry/bodies/constructions/profile.h"
#include "geometry/body.h"

namespace lekalo::geometry {

// One segment of a profile and the face that it makes.
struct SweptSide {
  // u is the segment's parameter, over its whole domain; v runs from the start to the end. r_u x r_v looks outward
  // where the region lies to the left of the segment. Null for a segment that stays where it is (on an axis).
  SurfacePtr surface;
  CurvePtr start, end;  // the lines v_min and v_max
  CurvePtr rail;        // the line u_min, which is also that of the segment before at its end; null: a pole
};

struct SweptLoop {
  std::vector<SweptSide> sides;
  bool left = true;  // the region lies to the left, seen against the direction of motion
};

struct SweptParts {
  std::vector<SweptLoop> loops;  // the outer one first
  // z along the motion. None where the path is closed: then each surface goes on at v_max as at v_min.
  std::optional<std::array<Frame, 2>> ends;
};

// Faces: start, end, side.k; edges: start.k, end.k, rail.k in the order of the segments. Edges hold how far their
// curves are from the faces.
Body swept_body(const SweptParts& parts);

// A plane face whose surface reaches a little beyond the images of its edges.
int add_plane_face(Body& body, const Frame& frame, bool forward, Origin origin, const std::vector<CurvePtr>& images);

// The image of a curve in a plane's own coordinates.
CurvePtr image_in(const Frame& plane, const CurvePtr& curve);

// Sets the tolerance of each edge to how far its curve is from its images, where that is more than rounding.
void measure_tolerances(Body& body);

}  // namespace lekalo::geometry
