// The regions into which curves divide the parameter plane of a face (Golovanov 2016, 6.2: loops by the sharpest turn).
#pragma once

#include <functional>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// A curve of the arrangement in the direction in which it may be run, with what is kept on its left. Curves meet at
// their ends only.
struct DirectedCurve {
  int strand = -1;  // both directions of one curve have the same
  bool forward = true;
  int from = -1, to = -1;  // points of space
  Curve2Ptr image;
  bool inner = false;  // there is more of the face on its other side

  Vec2 begin() const { return Vec2(image->point(forward ? image->domain().lo : image->domain().hi)); }
  Vec2 end() const { return Vec2(image->point(forward ? image->domain().hi : image->domain().lo)); }
};

struct PlaneRegion {
  std::vector<std::vector<int>> loops;  // of curves; the outer one first, counterclockwise, the others clockwise
};

// Every curve is in one region. `place` in space is for messages only. Throws BooleanError where a loop does not go on.
std::vector<PlaneRegion> regions_of(const std::vector<DirectedCurve>& curves, const Surface& surface);

// A point deep inside of a region, of those that suit.
Vec2 point_inside(const std::vector<DirectedCurve>& curves, const PlaneRegion& region,
                  const std::function<bool(const Vec2&)>& suits);

}  // namespace lekalo::geometry
