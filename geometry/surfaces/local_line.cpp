#include "geometry/surfaces/local_line.h"

#include "geometry/numerics/instruction_sets.h"

namespace lekalo::geometry {

LEKALO_FUSED Vec3 fused_at(const Line& line, double t) {
  const Vec3& o = line.origin;
  const Vec3& d = line.direction;
  return {std::fma(t, d.x, o.x), std::fma(t, d.y, o.y), std::fma(t, d.z, o.z)};
}

}  // namespace lekalo::geometry
