// Points, vectors, boxes, frames and affine maps in double precision.
//
// Points and free vectors share one type; functions say which they mean ("point" maps take the translation along,
// "direction" maps do not; normals map with the inverse transpose, Golovanov 2016, 1.4).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace lekalo::geometry {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;  // homogeneous point (w x, w y, w z, w)
using Mat3 = glm::dmat3;

inline constexpr double kPi = 3.141592653589793238462643383279502884;
inline constexpr double kTwoPi = 2 * kPi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A straight line, point(t) = origin + t direction; the direction need not be a unit vector: t is in its units.
struct Line {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};
  Vec3 at(double t) const { return origin + t * direction; }
};

// Axis-aligned box; empty when lo > hi in any coordinate (the initial state).
struct Box3 {
  Vec3 lo{kInfinity};
  Vec3 hi{-kInfinity};

  bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  bool bounded() const {
    return lo.x > -kInfinity && lo.y > -kInfinity && lo.z > -kInfinity && hi.x < kInfinity && hi.y < kInfinity &&
           hi.z < kInfinity;
  }
  void include(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void include(const Box3& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  Vec3 center() const { return 0.5 * (lo + hi); }
  Vec3 size() const { return hi - lo; }
  double diameter() const { return empty() ? 0.0 : glm::length(hi - lo); }
  Box3 inflated(double by) const { return {lo - Vec3(by), hi + Vec3(by)}; }
  bool contains(const Vec3& p) const {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x <= hi.x && p.y <= hi.y && p.z <= hi.z;
  }
  static Box3 everything() { return {Vec3(-kInfinity), Vec3(kInfinity)}; }
};

// Orthonormal right-handed frame.
struct Frame {
  Vec3 origin{0};
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};

  Vec3 point(const Vec3& local) const { return origin + direction(local); }
  Vec3 direction(const Vec3& local) const { return local.x * x + local.y * y + local.z * z; }
  Vec3 to_local_point(const Vec3& p) const { return to_local_direction(p - origin); }
  Vec3 to_local_direction(const Vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

// Any two unit vectors that complete the unit vector z to a right-handed orthonormal triple (x, y, z). The x axis is
// the global x projected into the plane normal to z, or the global y where z is within about 8 degrees of the global x,
// so that parameter zero of circles and quadrics is always defined.
Frame frame_about(const Vec3& origin, const Vec3& z);

// Frame with the given z and an x axis as near as possible to x_hint (projected). z and x_hint need not be unit vectors
// and must not be parallel; throws std::invalid_argument otherwise.
Frame frame_from(const Vec3& origin, const Vec3& z, const Vec3& x_hint);

// Affine map p -> linear p + offset (Golovanov 2016, 1.4.1).
struct Affine {
  Mat3 linear{1.0};
  Vec3 offset{0};

  Vec3 point(const Vec3& p) const { return linear * p + offset; }
  Vec3 direction(const Vec3& v) const { return linear * v; }
  bool is_identity() const { return linear == Mat3(1.0) && offset == Vec3(0); }
  double determinant() const { return glm::determinant(linear); }
  // No vector gets longer by more than this factor (Frobenius's norm: at most sqrt(3) times the least such).
  double operator_norm_bound() const {
    return std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) + glm::dot(linear[2], linear[2]));
  }
  Affine inverse() const {
    const Mat3 inverse_linear = glm::inverse(linear);
    return {inverse_linear, -(inverse_linear * offset)};
  }
  // The normal of the mapped surface, not normalised. With a negative determinant the parametric normal r_u x r_v of
  // the image is this vector reversed; callers that follow r_u x r_v multiply by the determinant's sign.
  Vec3 normal(const Vec3& n) const { return glm::transpose(glm::inverse(linear)) * n; }

  static Affine translation(const Vec3& by) { return {Mat3(1.0), by}; }
  // Rotation by the angle (radians, right-hand rule) about the axis through `about` (Golovanov 2016, 1.3.5). Sines and
  // cosines of multiples of a right angle are exact.
  static Affine rotation(double angle, const Vec3& axis, const Vec3& about = Vec3(0));
  static Affine scaling(const Vec3& factors, const Vec3& about = Vec3(0));
  // Mirror in the plane through `about` with the given normal.
  static Affine mirror(const Vec3& normal, const Vec3& about = Vec3(0));
};
// first, then second: (then * first).point(p) == then.point(first.point(p))
Affine operator*(const Affine& then, const Affine& first);
Box3 transformed(const Box3& box, const Affine& map);

// a P + b Q with a + b = 1; exact at a = 0 and b = 0 and where P = Q, so that collapsed edges stay collapsed and
// neighbouring pieces share their points.
template <class Point>
Point affine_mix(double a, const Point& p, double b, const Point& q) {
  return b < a ? p + b * (q - p) : q + a * (p - q);
}

}  // namespace lekalo::geometry
