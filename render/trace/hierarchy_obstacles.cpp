// What may stand between a place and a box: asked once for several shadow rays.
#include <algorithm>

#include "render/trace/hierarchy_rays.h"

namespace lekalo::render {

namespace {

// All segments from a point to the places of a box. At the part s of the way they fill the box from + s (to - from).
class Shaft {
 public:
  Shaft(const Vec3& from, const Box3& to) : from_(from), lo_(to.lo - from), hi_(to.hi - from) {}
  // True if one of them may meet the box.
  bool may_enter(const Box3& box) const {
    double begin = 0, end = 1;
    const auto at_most = [&](double slope, double value) {  // slope s <= value
      if (slope > 0)
        end = std::min(end, value / slope);
      else if (slope < 0)
        begin = std::max(begin, value / slope);
      else if (value < 0)
        end = -1;
    };
    for (int k = 0; k < 3; ++k) {
      at_most(lo_[k], box.hi[k] - from_[k]);
      at_most(-hi_[k], from_[k] - box.lo[k]);
    }
    return begin <= end;
  }

 private:
  Vec3 from_, lo_, hi_;
};

constexpr size_t kLastBit = 63;

}  // namespace

Obstacles Hierarchy::obstacles(const Ray& from, const Box3& to) const {
  const Parts& p = *parts_;
  Query query(from);
  begin(query, from);
  const Shaft shaft(from.origin, to);
  Obstacles result{0, false};
  size_t number = 0;
  const auto list = [&](bool listed) {
    if (listed) result.listed |= uint64_t{1} << std::min(number, kLastBit);
    ++number;
  };
  for (const Parts::Piece& piece : p.few) list(!query.has_left(*piece.record) && shaft.may_enter(piece.box));
  for (const Parts::Piece& piece : p.unbounded) list(!query.has_left(*piece.record) && shaft.may_enter(piece.box));
  result.scene = p.scene && shaft.may_enter(p.box.inflated(kBoxInflation * p.radius));
  return result;
}

}  // namespace lekalo::render
