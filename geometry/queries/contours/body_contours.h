// Sections of bodies by planes, silhouettes of bodies and lines where bodies meet: contours of their faces, cut at the
// edges and joined into loops.
#pragma once

#include <vector>

#include "geometry/body.h"
#include "geometry/contour.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// A stretch of a face's contour.
struct BodyContourPart {
  Contour contour;         // of the whole surface
  Interval t;              // the stretch; beyond the domain's end where it passes the end of a closed contour
  bool backwards = false;  // as the loop runs
  int face = -1;
  int other_face = -1;  // of the other body
  Vec3 begin{0}, end{0};
};
struct BodyContour {
  std::vector<BodyContourPart> parts;  // in order, each beginning where the one before ends
  bool closed = false;
};
struct BodyContours {
  std::vector<BodyContour> branches;
  std::vector<ContourPoint> points;
  bool complete = true;     // false where a face lies in the plane or on the other body
  bool coincident = false;  // faces coincide in part, as Contours::coincident
};

// Throw std::invalid_argument as the queries of surfaces do.
BodyContours plane_section(const Body& body, const Vec3& origin, const Vec3& normal);
// Smooth faces only; the edges of the body are no part of it.
BodyContours silhouette(const Body& body, const ViewOf& view);
BodyContours intersect(const Body& a, const Body& b, double tolerance = kSamePoint);
BodyContours intersect(const Body& a, const SurfacePtr& b, double tolerance = kSamePoint);

}  // namespace lekalo::geometry
