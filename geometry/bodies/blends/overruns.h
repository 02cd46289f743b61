// Blends that do not find room on a face (Golovanov 2016, 6.9, algorithm step 8): their border leaves it over one of
// its edges, the rim, and comes back. Beyond the rim
//
//   roll      the face there joins smoothly: the ball goes on on it
//   overflow  the face there cuts the blend
//   edge      the ball rests on the rim, which stays
#pragma once

#include <map>
#include <optional>

#include "geometry/bodies/blends/blend_band.h"
#include "geometry/bodies/blends/blend_edges.h"

namespace lekalo::geometry {

enum class BeyondKind { roll, overflow, edge };

// A blended edge whose border leaves a face over the edge `rim`, all of it between the points where it leaves and comes
// back. Of roll and edge the blended edge is the part beside the rim alone.
struct Beyond {
  BeyondKind kind = BeyondKind::overflow;
  int side = 0;  // of the blended edge: 0 right, 1 left
  int rim = -1;
  int face = -1;                  // beyond the rim
  std::array<double, 2> s{0, 0};  // of the band where it leaves and where it comes back
  std::array<Vec3, 2> points;     // there
  std::array<Vec3, 2> contacts;   // of both sides where it leaves
};
using Beyonds = std::map<int, Beyond>;  // by the blended edge

// Where the border of a band leaves its faces, as a first crossing: with the rim's parameters, in the order of s.
struct Overrun {
  Beyond beyond;
  std::array<double, 2> t{0, 0};  // of the blended edge
  std::array<double, 2> w{0, 0};  // of the rim
};
std::optional<Overrun> overrun_of(const Body& body, const BlendEdge& edge, const BlendBand& band, Overflow overflow);

// The body with the rim, and of roll and edge the blended edge too, divided at the overrun, and what is then known of
// it. `numbers`: the parts of each edge, in its direction.
struct Divided {
  Body body;
  std::vector<std::vector<int>> parts;
  int blended = -1;
  Beyond beyond;
};
Divided divided(const Body& body, int edge, const Overrun& overrun);

}  // namespace lekalo::geometry
