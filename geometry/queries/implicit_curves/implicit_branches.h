// An implicit surface whose formula has kinks as the smooth ones that it consists of (expression/branches.h), each as
// far as heights over its borders have a sign.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/curve.h"
#include "geometry/queries/implicit_curves/implicit_formula.h"

namespace lekalo::geometry {

struct ImplicitSide {
  std::shared_ptr<const ImplicitFormula> height;
  bool positive = true;  // the height is not negative, else not positive
  Affine to_formula;     // to the height's coordinates

  double value(const Vec3& p) const { return (positive ? 1 : -1) * (*height)(to_formula.point(p)); }
  // Bounds of the value.
  Interval range(const Box3& box) const;
};

bool hold(const std::vector<ImplicitSide>& sides, const Vec3& p);

struct ImplicitBranch {
  std::shared_ptr<const ImplicitFormula> formula;  // smooth but for jumps that nothing is known of
  std::vector<ImplicitSide> sides;

  bool holds(const Vec3& p) const { return geometry::hold(sides, p); }
};

// Where a stretch between cuts is looked at: not in the middle, in which symmetric things touch without a cut.
inline double place_inside(const Interval& stretch) { return stretch.lo + 0.381966 * stretch.width(); }

// put(range) for the stretches of a curve between cuts, in order, inside of which it `keeps`; of a closed one the last
// may go on beyond the end of the domain.
void each_kept(const Interval& domain, bool closed, const std::vector<double>& cuts,
               const std::function<bool(double)>& keeps, const std::function<void(const Interval&)>& put);
// The same of what lies on the right sides.
void each_kept(const Curve& curve, bool closed, const std::vector<ImplicitSide>& sides,
               const std::function<void(const Interval&)>& put);

// False where one of the heights has the wrong sign in all of a box.
bool may_hold(const std::vector<ImplicitSide>& sides, const Box3& box);

// Those that may hold somewhere in a box: of a smooth formula itself, as of one that has too many. The formula must
// outlive them; they are those of its values in coordinates that the map leads from.
std::vector<ImplicitBranch> implicit_branches(const ImplicitFormula& formula, const Box3& box,
                                              const Affine& to_formula = {});

}  // namespace lekalo::geometry
