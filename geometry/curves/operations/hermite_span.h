// How far a curve is from a cubic that takes its place over a part of its domain, with proof; and how long such parts
// may be (Zavyalov et al. 1985, I.2, I.4, I.5).
//
// The difference e of two curves of class C2 between a and b is at most max(|e(a)|, |e(b)|) + (b - a)^2 / 8 max |e''|:
// enclosures of second derivatives and halving bound it as closely as is asked for.
#pragma once

#include <functional>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// The cubic with these points and derivatives at the ends of t.
struct HermiteSpan {
  Interval t;
  Vec3 from{0}, to{0};
  Vec3 tangent_from{0}, tangent_to{0};

  Vec3 point(double at) const;
  Vec3 second(double at) const;  // r'', linear in t
};
HermiteSpan straight_span(const Interval& t, const Vec3& from, const Vec3& to);
// With the curve's own points and derivatives, those from inside of t.
HermiteSpan hermite_span(const Curve& curve, const Interval& t);

// Whether the two are proved to be no farther apart than the tolerance at the same parameters.
bool is_within(const Curve& curve, const HermiteSpan& span, double tolerance);
// The same of the curve's distance from the chord between its points at the ends of t.
bool chord_is_within(const Curve& curve, const Interval& t, double tolerance);

// Ends of the domain and where the first derivative jumps. Throws FieldError (field of) for an infinite domain.
std::vector<double> corners(const Curve& curve);

// Parameters from the beginning to the end of t, each about as far from the one before as `fits` allows. Throws
// FieldError (field tolerance) where steps become too small.
std::vector<double> longest_steps(const Interval& t, const std::function<bool(const Interval&)>& fits);
// The same with equal steps, as few as fit.
std::vector<double> equal_steps(const Interval& t, const std::function<bool(const Interval&)>& fits);

}  // namespace lekalo::geometry
