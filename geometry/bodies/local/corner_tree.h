// The tree of edges to which a corner opens whose faces have no point in common any more (Golovanov 2016, 6.7).
#pragma once

#include <optional>
#include <vector>

#include "geometry/bodies/local/common_point.h"

namespace lekalo::geometry {

// Points, the one where each spoke ends, and the
// joints between them, each between two of the sectors' faces.
struct CornerTree {
  struct Joint {
    int sectors[2];
    int from, to;  // points
  };
  std::vector<Vec3> points;
  std::vector<int> of_spoke;  // spoke k follows sector k
  std::vector<Joint> joints;
};

// What is known of a sector for it.
struct SectorSurface {
  int face;
  SurfaceNear on;
  Vec3 normal;    // of the new surface near the corner
  Vec3 spoke_to;  // the other end of the spoke that follows, before
};

// A tree without joints where one point will do; else a triangulation of the cycle of sectors whose edges do not cross
// (Aurenhammer, Walzl 2016: there is one for plane faces). Nothing where there is none, or more than 8 sectors.
std::optional<CornerTree> corner_tree(const std::vector<SectorSurface>& sectors, double size);

}  // namespace lekalo::geometry
