// Conics and straight lines in space, r(t) = o + f(t) x + g(t) y with (f, g) = (cos, sin), (cosh, sinh), (t^2, t) or
// (0, t): what planes cut from quadrics (Golovanov 2016, 2.2 and 4.7). A linear function along one has roots in closed
// form.
#pragma once

#include <cmath>
#include <vector>

#include "geometry/curve.h"
#include "geometry/numerics/triple.h"

namespace lekalo::geometry {

struct Conic {
  enum class Kind { ellipse, hyperbola, parabola, line };  // of the hyperbola the branch towards x
  Kind kind = Kind::line;
  Vec3 origin{0}, x{0}, y{0};

  bool is_closed() const { return kind == Kind::ellipse; }

  // o, x and y as one function of f and g; T is double, a jet, or a jet of intervals.
  template <class T>
  Triple<T> combined(const T& f, const T& g) const {
    return {f * x.x + g * y.x + origin.x, f * x.y + g * y.y + origin.y, f * x.z + g * y.z + origin.z};
  }
  template <class T>
  Triple<T> at(const T& t) const {
    using std::cos;
    using std::cosh;
    using std::sin;
    using std::sinh;
    switch (kind) {
      case Kind::ellipse:
        return combined(T(cos(t)), T(sin(t)));
      case Kind::hyperbola:
        return combined(T(cosh(t)), T(sinh(t)));
      case Kind::parabola:
        return combined(T(t * t), t);
      case Kind::line:
        return combined(T(0.0), t);
    }
    return {};
  }
  Vec3 point(double t) const {
    const Triple<double> p = at(t);
    return {p.x, p.y, p.z};
  }
};

// The image under an affine map that takes the origin to `origin`.
inline Conic mapped(const Conic& conic, const Mat3& linear, const Vec3& origin) {
  return {conic.kind, origin, linear * conic.x, linear * conic.y};
}

// Where normal . r(t) = height, in order; of an ellipse in [0, 2 pi). A double root comes once or twice; none where the
// function is constant but for rounding.
std::vector<double> plane_roots(const Conic& conic, const Vec3& normal, double height);

// The part over t, which is finite, as a curve with the same parameter. x and y of an ellipse, a hyperbola or a
// parabola are at right angles, and the parabola's y is twice as long as its x.
CurvePtr as_curve(const Conic& conic, const Interval& t);

}  // namespace lekalo::geometry
