// How a pocket of constant depth is cleared: trapezoids, the graph of their contacts, a way that visits all with little
// air motion, zigzags in them, and the way along the contours (Zavyalov et al. 1985, V.2).
#pragma once

#include "geometry/machining/pocket_trapezoids.h"
#include "geometry/machining/route_path.h"

namespace lekalo::geometry {

struct PocketContours {
  CurvePtr outer;
  std::vector<CurvePtr> islands;
};

struct PocketTools {
  double radius = 0;            // of the tool that clears
  Interval allowance;           // what it leaves at the contours, from least to most
  double step = 0;              // between the rows of a zigzag, at most
  double finishing_radius = 0;  // of the tool that runs along the contours
};

struct PocketPlan {
  PocketRegion region;     // of the centers of the clearing tool
  PocketRegion finishing;  // its rims are the ways of the finishing tool, within a tenth of the allowance's range
  double height = 0;       // z of all
  Affine to_plane;         // from the coordinates of the split, in which its lines are upright
  TrapezoidSplit split;
  RoutePlan route;        // vertices are trapezoids, weights the distances of their centers
  double cut_length = 0;  // of the zigzags
  double air_length = 0;  // of the moves between them
  Vec3 at(const Vec2& split_point) const { return to_plane.point(Vec3(split_point, height)); }
};

// `upright`: direction of the lines of the split, in the plane x, y. `path` becomes the way of the center of the
// clearing tool. Throws FieldError (fields of inset_region(); direction) and where the region falls apart.
PocketPlan pocket_plan(const PocketContours& contours, const PocketTools& tools, const Vec3& upright,
                       std::vector<Vec3>& path);

}  // namespace lekalo::geometry
