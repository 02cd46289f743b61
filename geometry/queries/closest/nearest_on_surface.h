// The nearest foot point of a point on a surface, for very many points: the first that a SurfaceProjector finds,
// searched no farther away than the nearest can be (branch and bound on boxes of parts of the surface).
#pragma once

#include <memory>
#include <optional>

#include "geometry/queries/closest/closest_point.h"

namespace lekalo::geometry {

// Throws as SurfaceProjector does. Safe to use from many threads.
class NearestOnSurface {
 public:
  explicit NearestOnSurface(const SurfacePtr& surface);
  // None where the surface has no foot point, as one that has no border but a kink that is not known.
  std::optional<SurfaceFootPoint> operator()(const Vec3& point) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};

}  // namespace lekalo::geometry
