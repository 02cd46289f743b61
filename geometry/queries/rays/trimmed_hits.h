// Which hits of a line with a whole surface count.
#pragma once

#include <memory>

#include "geometry/bodies/trims/trim.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Keeps hits in an interval of the line and inside the trims, if there are any.
class HitFilter {
 public:
  explicit HitFilter(std::shared_ptr<const TrimRegion> trim);
  bool keeps(const LineHit& hit, const Interval& t, const Line& line, const Surface& surface) const {
    return hit.t >= t.lo && hit.t <= t.hi && (!trim_ || is_inside(hit, line, surface));
  }
  const TrimRegion* trim() const { return trim_.get(); }

 private:
  bool is_inside(const LineHit& hit, const Line& line, const Surface& surface) const;

  std::shared_ptr<const TrimRegion> trim_;
  double slack_ = 0;
};

}  // namespace lekalo::geometry
