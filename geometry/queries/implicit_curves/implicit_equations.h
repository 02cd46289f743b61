// The equations of curves on an implicit surface F = level: a second one beside it, and both over boxes and at places.
//
//   sight    grad F . s = 0       its silhouette: s the direction of view, or p - e from an eye e (Golovanov 2016, 4.6)
//   sphere   |p - c|^2 = R^2      its border on a ball
//   plane    n . (p - o) = 0      its section by a plane
//   other    G(A p) = level       where it meets another implicit surface, A an affine map to that one's coordinates
//
// Bounds over a box X about m come from interval arithmetic (Moore, Kearfott, Cloud 2009, ch. 6), with H for the second
// derivatives:
//
//   F(x) in F(m) + grad F(m) (X - m) + (X - m) H(X) (X - m)/2,   grad F(x) in grad F(m) + H(X) (X - m),
//
// whose excess falls with the square of the size, that of the formula's own only with the size.
#pragma once

#include "geometry/contour.h"
#include "geometry/numerics/root_search.h"
#include "geometry/numerics/triple.h"
#include "geometry/queries/implicit_curves/implicit_formula.h"

namespace lekalo::geometry {

// F - level with its derivatives.
template <class S>
struct SecondOrder {
  S value{};
  Triple<S> gradient;
  S xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  static SecondOrder of(const Jet3<S, 2>& jet) {
    const auto& c = jet.c;
    return {c[0], {c[1], c[2], c[3]}, S(2) * c[4], c[5], c[6], S(2) * c[7], c[8], S(2) * c[9]};
  }
  // H v.
  template <class A>
  Triple<S> second(const Triple<A>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
};

Triple<double> triple(const Vec3& v);
Triple<Interval> triple(const Box3& box);

SecondOrder<double> second_order(const ImplicitFormula& formula, const Vec3& p);

// Over a box, and at its middle.
struct ImplicitRange {
  SecondOrder<Interval> over;
  Triple<Interval> middle, off;  // m, X - m
  Gradient<Interval> at_middle;
  bool is_smooth = true;  // else only the formula's own bounds hold
};
ImplicitRange range_of(const ImplicitFormula& formula, const Box3& box);

class ImplicitCondition {
 public:
  static ImplicitCondition sight(const ViewOf& view) {
    return {view.central ? Kind::sight_from_eye : Kind::sight, view.direction_or_eye, 0};
  }
  static ImplicitCondition sphere(const Vec3& center, double radius) { return {Kind::sphere, center, radius}; }
  // The normal a unit vector.
  static ImplicitCondition plane(const Vec3& origin, const Vec3& normal) {
    return {Kind::plane, normal, glm::dot(origin, normal)};
  }

  // The formula must outlive it.
  static ImplicitCondition other(const ImplicitFormula& formula, const Affine& to_formula) {
    ImplicitCondition result(Kind::other, Vec3(0), 0);
    result.other_ = &formula, result.to_other_ = to_formula;
    return result;
  }

  // Of a silhouette.
  std::optional<ViewOf> view() const {
    if (kind_ != Kind::sight && kind_ != Kind::sight_from_eye) return std::nullopt;
    return ViewOf{kind_ == Kind::sight_from_eye, vector_};
  }
  // Of another implicit surface.
  const ImplicitFormula* formula() const { return other_; }
  const Affine& to_formula() const { return to_other_; }

  template <class S>
  struct Value {
    S value;
    Triple<S> gradient;
  };
  template <class S>
  Value<S> at(const SecondOrder<S>& f, const Triple<S>& p) const {
    const Triple<double> v = triple(vector_);
    switch (kind_) {
      case Kind::sight:
        return {dot(f.gradient, v), f.second(v)};
      case Kind::sight_from_eye: {
        const Triple<S> sight = p - v;
        return {dot(f.gradient, sight), f.second(sight) + f.gradient};
      }
      case Kind::sphere: {
        const Triple<S> off = p - v;
        return {sqr(off.x) + sqr(off.y) + sqr(off.z) - S(number_) * S(number_), S(2) * off};
      }
      case Kind::other:
        return of_other(p);
      case Kind::plane:
        break;
    }
    return {dot(p, v) - S(number_), Triple<S>{S(v.x), S(v.y), S(v.z)}};
  }
  // Over the box of `range`.
  Value<Interval> enclose(const ImplicitRange& range, const Box3& box) const;

 private:
  enum class Kind { sight, sight_from_eye, sphere, plane, other };
  ImplicitCondition(Kind kind, const Vec3& vector, double number) : kind_(kind), vector_(vector), number_(number) {}

  template <class S>
  Value<S> of_other(const Triple<S>& p) const {
    using G = Gradient<S>;
    const Triple<G> x{G::variable(p.x, 0), G::variable(p.y, 1), G::variable(p.z, 2)};
    const Mat3& m = to_other_.linear;
    const auto coordinate = [&](int k) -> G {
      return x.x * m[0][k] + x.y * m[1][k] + x.z * m[2][k] + to_other_.offset[k];
    };
    const G found = (*other_)(coordinate(0), coordinate(1), coordinate(2));
    return {found.c[0], {found.c[1], found.c[2], found.c[3]}};
  }

  Kind kind_;
  Vec3 vector_;
  double number_;
  const ImplicitFormula* other_ = nullptr;
  Affine to_other_;
};

// How the surface bends along a line of sight that touches it, s . H s: above zero F is larger than the level on both
// sides of the contact, so that the way passes where F is larger; zero where the silhouette runs along the line of
// sight and its picture has a cusp.
template <class S>
S bend_along(const SecondOrder<S>& f, const Triple<S>& sight) {
  return dot(sight, f.second(sight));
}

}  // namespace lekalo::geometry
