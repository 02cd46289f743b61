// The oracle of implicit surfaces along a ray: all zeros of a function of one variable, by a complete search.
//
// On a stretch of the ray the function and its first derivative are enclosed by jets of ranges in long double, in
// centred form; a stretch is left out where the function has no zero, has one at most where the derivative has none,
// and is halved else. What is shorter than kTiny and still not told holds zeros that nearly touch. It shares nothing
// with the product.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/surface.h"
#include "geometry/vectors.h"

namespace lekalo::oracle::implicit {

using Real = long double;

// Wide enough for the rounding of one operation.
struct Range {
  Real lo, hi;
  Range(Real a, Real b) : lo(a - kRounding * std::abs(a)), hi(b + kRounding * std::abs(b)) {}
  Range(Real a) : lo(a), hi(a) {}
  bool has_zero() const { return lo <= 0 && hi >= 0; }

 private:
  static constexpr Real kRounding = 2.2e-19L;
};
inline Range operator+(const Range& a, const Range& b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline Range operator-(const Range& a, const Range& b) { return {a.lo - b.hi, a.hi - b.lo}; }
inline Range operator*(const Range& a, const Range& b) {
  const Real p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
// The divisor is above zero.
inline Range operator/(const Range& a, const Range& b) { return a * Range(1 / b.hi, 1 / b.lo); }
inline Range square(const Range& a) {
  const Real p = a.lo * a.lo, q = a.hi * a.hi;
  return {a.has_zero() ? 0 : std::min(p, q), std::max(p, q)};
}
inline Range root(const Range& a) { return {std::sqrt(std::max(a.lo, Real(0))), std::sqrt(std::max(a.hi, Real(0)))}; }
inline Range common(const Range& a, const Range& b) {
  Range c = a;
  c.lo = std::max(a.lo, b.lo), c.hi = std::min(a.hi, b.hi);
  return c;
}

// A function with two derivatives.
struct Jet {
  Range f, f1, f2;
};
inline Jet operator+(const Jet& a, const Jet& b) { return {a.f + b.f, a.f1 + b.f1, a.f2 + b.f2}; }
inline Jet operator-(const Jet& a, const Jet& b) { return {a.f - b.f, a.f1 - b.f1, a.f2 - b.f2}; }
inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.f * b.f, a.f1 * b.f + a.f * b.f1, a.f2 * b.f + Range(2) * a.f1 * b.f1 + a.f * b.f2};
}
inline Jet operator*(Real a, const Jet& b) { return {Range(a) * b.f, Range(a) * b.f1, Range(a) * b.f2}; }
inline Jet square(const Jet& a) { return {square(a.f), Range(2) * a.f * a.f1, Range(2) * (square(a.f1) + a.f * a.f2)}; }
// q = r r, q' = 2 r r', q'' = 2 r' r' + 2 r r''.
inline Jet root(const Jet& q) {
  const Range r = root(q.f), r1 = q.f1 / (Range(2) * r);
  return {r, r1, (Range(0.5L) * q.f2 - square(r1)) / r};
}
// c = a / b, a' = c' b + c b', a'' = c'' b + 2 c' b' + c b''.
inline Jet operator/(const Jet& a, const Jet& b) {
  const Range c = a.f / b.f, c1 = (a.f1 - c * b.f1) / b.f;
  return {c, c1, (a.f2 - Range(2) * c1 * b.f1 - c * b.f2) / b.f};
}

struct Ray {
  Real ox, oy, oz, dx, dy, dz;  // of unit direction
};

// The Klein bottle that a figure of eight sweeps (scenes/gallery/klein_bottle.yaml), in the half-plane at the angle u
// about z the curve (X, Y) = (sin v, sin 2v), Y^2 = 4 X^2 (1 - X^2), turned by u/2, its middle at the distance a:
//
//   X^2 = (w^2 + z^2)/2 + cos u (w^2 - z^2)/2 + sin u w z,   w = rho - a,
//   Y^2 = (w^2 + z^2)/2 - cos u (w^2 - z^2)/2 - sin u w z
//
// with cos u = x/rho, sin u = y/rho: half of the angle, which would change its sign after a turn, is not asked for.
class FigureEightBottle {
 public:
  explicit FigureEightBottle(double a) : a_(a) {}
  // Whether the surface is far from all of the stretch; else whether the function has derivatives there.
  bool is_far(const Ray& ray, const Range& t) const {
    const Range x = Range(ray.ox) + t * Range(ray.dx), y = Range(ray.oy) + t * Range(ray.dy),
                z = Range(ray.oz) + t * Range(ray.dz);
    return (square(root(square(x) + square(y)) - Range(a_)) + square(z)).lo > kReach;
  }
  bool is_smooth(const Ray& ray, const Range& t) const {
    const Range x = Range(ray.ox) + t * Range(ray.dx), y = Range(ray.oy) + t * Range(ray.dy);
    return (square(x) + square(y)).lo > 0;
  }
  Jet value(const Ray& ray, const Range& t) const {
    const auto linear = [&](Real o, Real d) { return Jet{Range(o) + t * Range(d), d, 0}; };
    const Jet x = linear(ray.ox, ray.dx), y = linear(ray.oy, ray.dy), z = linear(ray.oz, ray.dz);
    const Jet rho = root(square(x) + square(y)), w = rho - Jet{a_, 0, 0};
    const Jet ww = square(w), zz = square(z), half = 0.5L * (ww + zz),
              turned = 0.5L * (x / rho * (ww - zz)) + y / rho * (w * z);
    const Jet xx = half + turned, yy = half - turned;
    return yy - 4 * (xx - square(xx));
  }

 private:
  static constexpr Real kReach = 1.57L;  // X^2 + Y^2 = 5 X^2 - 4 X^4 is at most 25/16
  Real a_;
};

template <class Surface>
class Zeros {
 public:
  Zeros(const Surface& surface, const Ray& ray, Real from, Real to) : surface_(surface), ray_(ray) {
    constexpr int kParts = 24;
    for (int k = 0; k < kParts; ++k) search(from + (to - from) * k / kParts, from + (to - from) * (k + 1) / kParts);
  }
  const std::vector<Real>& found() const { return found_; }
  // The middles of stretches that are not told.
  const std::vector<Real>& untold() const { return untold_; }

 private:
  void search(Real lo, Real hi) {
    // Both ends as they are, with no room for rounding: stretches meet in them.
    Range t(lo);
    t.hi = hi;
    if (surface_.is_far(ray_, t)) return;
    const Real middle = (lo + hi) / 2;
    if (surface_.is_smooth(ray_, t)) {
      const Jet all = surface_.value(ray_, t), at = surface_.value(ray_, Range(middle));
      const Range off(lo - middle, hi - middle);
      const Range slope = common(all.f1, at.f1 + all.f2 * off);
      if (!common(all.f, at.f + slope * off).has_zero()) return;
      if (!slope.has_zero()) {
        if (is_below(lo) != is_below(hi)) found_.push_back(halved(lo, hi));
        return;
      }
    }
    if (hi - lo < kTiny) {
      untold_.push_back(middle);
      return;
    }
    search(lo, middle), search(middle, hi);
  }
  bool is_below(Real t) const {
    const Range f = surface_.value(ray_, Range(t)).f;
    return f.lo + f.hi < 0;
  }
  Real halved(Real lo, Real hi) const {
    const bool below = is_below(lo);
    for (int step = 0; step < 40; ++step) {
      const Real middle = (lo + hi) / 2;
      (is_below(middle) == below ? lo : hi) = middle;
    }
    return (lo + hi) / 2;
  }

  static constexpr Real kTiny = 1e-10L;
  const Surface& surface_;
  const Ray& ray_;
  std::vector<Real> found_, untold_;
};

// How many sheets lie before a point as seen from another, those as near as `own` left out; -1 where it is not clear:
// a sheet is nearer than `own_too`, or two nearly touch.
template <class Surface>
int layers_before(const Surface& surface, const geometry::Vec3& from, const geometry::Vec3& point, Real own,
                  Real own_too) {
  const Real x = Real(point.x) - from.x, y = Real(point.y) - from.y, z = Real(point.z) - from.z,
             length = std::sqrt(x * x + y * y + z * z);
  const Ray ray{from.x, from.y, from.z, x / length, y / length, z / length};
  const Zeros<Surface> zeros(surface, ray, 0, length - own);
  if (!zeros.untold().empty()) return -1;
  for (const Real t : zeros.found())
    if (t > length - own_too) return -1;
  return static_cast<int>(zeros.found().size());
}

}  // namespace lekalo::oracle::implicit
