// Conics by their equation in a plane, and by their axes (Golovanov 2016, 2.5).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "geometry/curve.h"

namespace lekalo::geometry {

// X^T Q X = 0 for the points X = (x, y, 1) of a plane, x and y along its frame. Q is symmetric, of any scale.
struct ConicEquation {
  Frame plane;
  Mat3 q{0.0};
};

// The conic by its axes: (a cos t, b sin t) with a >= b, (+-a cosh t, b sinh t), or (a t^2, 2 a t) in the frame, whose
// origin is the center or the vertex. The first axis of an ellipse or a hyperbola points to the side of the global x
// (else y, z); a circle has those of its plane.
struct CanonicalConic {
  enum class Kind { ellipse, hyperbola, parabola };
  Kind kind = Kind::ellipse;
  Frame frame;
  double a = 0, b = 0;
};
std::string_view name(CanonicalConic::Kind kind);

// None for a pair of lines, a point, or nothing.
std::optional<CanonicalConic> canonical(const ConicEquation& equation);

// Of the rational quadratic with these homogeneous points (Golovanov 2016, 2.5.10): with l_0 = P_1 x P_2, l_1 = P_2 x
// P_0, l_2 = P_0 x P_1 in the plane it is (l_1 X)^2 = 4 (l_0 X) (l_2 X). None where the points lie on a line.
std::optional<ConicEquation> equation_of(std::span<const Vec4> points);

// (1 - lambda) l_1 l_2 + lambda l_3 l_4 = 0 with the lines AB, CD, AC, BD in their normal forms: all conics through
// four points of a plane (Golovanov 2016, 2.5.2). One through a fifth point has the lambda of pencil_number().
ConicEquation pencil_member(const Frame& plane, const std::array<Vec3, 4>& points, double lambda);
double pencil_number(const Frame& plane, const std::array<Vec3, 4>& points, const Vec3& fifth);
// (1 - lambda) u v + lambda (u + v - 1)^2 = 0 in the oblique coordinates r = p_1 + u (p_0 - p_1) + v (p_2 - p_1):
// all conics that touch p_1 p_0 at p_0 and p_1 p_2 at p_2 (Golovanov 2016, 2.5.5).
ConicEquation touching_pencil_member(const Frame& plane, const std::array<Vec3, 3>& points, double lambda);

// The frame of the plane of points, its origin the first; throws FieldError (field as named) where they lie on one
// line, or are not in one plane to 1e-9 of their size.
Frame plane_of(std::span<const Vec3> points, const char* field);

}  // namespace lekalo::geometry
