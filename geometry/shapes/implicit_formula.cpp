#include "geometry/shapes/implicit_formula.h"

#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

Vec3 ImplicitFormula::gradient(const Vec3& p) const {
  using Jet = geometry::Jet<double, 1>;
  Vec3 result;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](int axis) { return axis == k ? Jet::variable(p[axis]) : Jet(p[axis]); };
    result[k] = (*this)(at(0), at(1), at(2)).c[1];
  }
  return result;
}

Interval ImplicitFormula::enclose(const Box3& box) const {
  return (*this)(Interval(box.lo.x, box.hi.x), Interval(box.lo.y, box.hi.y), Interval(box.lo.z, box.hi.z));
}

}  // namespace lekalo::geometry
