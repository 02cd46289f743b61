// The foot of a point on a surface by Newton's method from parameters that are near: for points that lie on it, or
// close by.
#pragma once

#include <optional>

#include "geometry/surface.h"

namespace lekalo::geometry {

// The parameters at which the iteration came to rest, and whether it did: not where the surface is singular on the way.
struct NearFoot {
  Vec2 place{0};
  bool found = false;
};
NearFoot near_foot(const Surface& surface, const Vec3& p, const Vec2& near);

// The same; nothing where it is not found.
inline std::optional<Vec2> foot_place(const Surface& surface, const Vec3& p, const Vec2& near) {
  const NearFoot foot = near_foot(surface, p, near);
  return foot.found ? std::optional(foot.place) : std::nullopt;
}

}  // namespace lekalo::geometry
