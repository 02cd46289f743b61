#include "geometry/curves/splines/g2_joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/numerics/polynomial.h"

namespace lekalo::geometry {

namespace {

// Sine of an angle below which a line is parallel to a plane, or planes to each other; part of a length that is none.
constexpr double kParallel = 1e-9;

// Of the first problem, one after the other.
[[noreturn]] void refuse(int number, const std::string& why, const std::string& hint) {
  throw FieldError("segments", fmt::format("segment {}: {}", number, why), hint);
}

Vec3 normal_at(const G2End& end) { return glm::normalize(glm::cross(end.curvature, end.tangent)); }

// Where the tangent's line meets the osculating plane.
Vec3 pierced(const G2End& joint, const G2Continuation& wish, int number) {
  const Vec3 n = glm::normalize(joint.curvature), m = glm::normalize(wish.line), chord = wish.to - joint.point;
  const double size = glm::length(chord), height = glm::dot(n, -chord), slope = glm::dot(n, m);
  if (std::abs(height) <= kParallel * size) {
    if (std::abs(slope) > kParallel)
      refuse(number, "its end lies in the osculating plane at its beginning, but its tangent line does not",
             "move the end out of that plane, or turn the tangent line into it");
    return wish.to - wish.end_handle.value_or(size / 3) * m;
  }
  if (std::abs(slope) <= kParallel)
    refuse(number, "its tangent line is parallel to the osculating plane at its beginning",
           "turn the line, so that it meets that plane");
  return wish.to + height / slope * m;
}

double end_invariant(const G2Continuation& wish, const Vec3& q, const Vec3& p) {
  if (!wish.curvature) return wish.end_invariant;
  return invariant_of_curvature(*wish.curvature, wish.to, p, q, "segments");
}

double start_invariant(double curvature, double handle, double height) {
  return 1.5 * curvature * handle * handle / height;
}

RationalCubic between(const G2End& from, const G2End& to, const Vec3& q, const Vec3& p, CubicWeights weights) {
  RationalCubic cubic{{from.point, q, p, to.point}, {1, 1, 1, 1}};
  const auto invariant = [](const G2End& end, const Vec3& handle, const Vec3& other) {
    return start_invariant(glm::length(end.curvature), glm::length(handle - end.point),
                           glm::length(glm::cross(end.tangent, other - end.point)));
  };
  cubic.weights = weights_of_invariants(invariant(from, q, p), invariant(to, p, q), weights);
  return cubic;
}

// Lengths x, y of a polynomial cubic in one plane: x^2 = a (b - c y), y^2 = d (e + f x) with both sides positive (de
// Boor, Hoellig, Sabin 1987); the pair with the smallest sum.
std::optional<std::array<double, 2>> polynomial_handles(const G2End& from, const G2End& to) {
  const Vec3 chord = to.point - from.point, n1 = normal_at(from), n2 = normal_at(to);
  const double a = 2 / (3 * glm::length(from.curvature)), b = glm::dot(n1, chord), c = glm::dot(n1, to.tangent);
  const double d = 2 / (3 * glm::length(to.curvature)), e = -glm::dot(n2, chord), f = glm::dot(n2, from.tangent);
  // (x^2 - a b)^2 = a^2 c^2 y^2 = a^2 c^2 d (e + f x), which has the solutions with -y too.
  const std::array<double, 5> quartic{a * a * (b * b - c * c * d * e), -a * a * c * c * d * f, -2 * a * b, 0, 1};
  std::optional<std::array<double, 2>> best;
  for (const PolynomialRoot& root : quartic_roots(quartic, {0, kInfinity})) {
    const double x = root.x, y_squared = d * (e + f * x);
    if (!(x > 0 && y_squared > 0)) continue;
    const double y = std::sqrt(y_squared);
    const bool is_solution = std::abs(x * x - a * (b - c * y)) <= 1e-6 * (x * x + std::abs(a * b)) && b - c * y > 0;
    if (is_solution && (!best || x + y < (*best)[0] + (*best)[1])) best = {x, y};
  }
  return best;
}

RationalCubic plane_transition(const G2End& from, const G2End& to, std::optional<std::array<double, 2>> handles,
                               CubicWeights weights) {
  if (!handles) handles = polynomial_handles(from, to);
  if (!handles)
    throw FieldError("to", "the ends lie in one plane, and no polynomial cubic joins them",
                     "give the lengths of both tangents: handles: [a, b]; or bend the ends towards each other");
  const Vec3 q = from.point + (*handles)[0] * from.tangent, p = to.point - (*handles)[1] * to.tangent;
  if (!(glm::dot(normal_at(from), p - from.point) > 0))
    throw FieldError("handles", "the third control point is not on the side to which `from` bends at its end",
                     "change the second length, or move `to` to that side");
  if (!(glm::dot(normal_at(to), q - to.point) > 0))
    throw FieldError("handles", "the second control point is not on the side to which `to` bends at its beginning",
                     "change the first length, or move `from` to that side");
  return between(from, to, q, p, weights);
}

}  // namespace

G2End g2_end(const Curve& curve, bool at_end, const std::string& field) {
  const CurveJet jet = curve.evaluate(at_end ? curve.domain().hi : curve.domain().lo, 2);
  const double speed = glm::length(jet.d[1]);
  if (!(speed > 0)) throw FieldError(field, "the curve has no tangent at that end");
  return {jet.d[0], jet.d[1] / speed, glm::cross(jet.d[1], jet.d[2]) / (speed * speed * speed)};
}

G2End g2_end(const RationalCubic& segment) {
  const Vec3 leg = segment.points[3] - segment.points[2];
  return {segment.points[3], glm::normalize(leg), segment.end_curvature()};
}

RationalCubic g2_continuation(const G2End& joint, const G2Continuation& wish, CubicWeights weights, int number) {
  const double size = glm::length(wish.to - joint.point), curvature = glm::length(joint.curvature);
  if (!(size > 0)) refuse(number, "its ends coincide", "leave it out, or move its end");
  if (!(curvature * size > kParallel))
    refuse(number, "the curvature at its beginning is 0: there is no osculating plane",
           "bend the segment before: move its last three control points off their line");
  const Vec3 p = pierced(joint, wish, number);
  const double height = glm::dot(normal_at(joint), p - joint.point);
  if (!(height > kParallel * size))
    refuse(number,
           fmt::format("its tangent line meets the osculating plane at [{:.6g}, {:.6g}, {:.6g}], on the wrong side of "
                       "the tangent: the curve would bend the other way",
                       p.x, p.y, p.z),
           "move the line to the side to which the segment before bends at its end");
  const double handle = wish.handle.value_or(std::sqrt(2 * height / (3 * curvature)));
  const Vec3 q = joint.point + handle * joint.tangent;
  RationalCubic cubic{{joint.point, q, p, wish.to}, {1, 1, 1, 1}};
  cubic.weights = weights_of_invariants(start_invariant(curvature, handle, height), end_invariant(wish, q, p), weights);
  return cubic;
}

RationalCubic g2_transition(const G2End& from, const G2End& to, const std::optional<std::array<double, 2>>& handles,
                            CubicWeights weights) {
  const Vec3 chord = to.point - from.point;
  const double size = glm::length(chord);
  if (!(size > 0)) throw FieldError("to", "the ends coincide: there is no gap");
  if (!(glm::length(from.curvature) * size > kParallel))
    throw FieldError("from", "the curvature at its end is 0: there is no osculating plane", "bend its end a little");
  if (!(glm::length(to.curvature) * size > kParallel))
    throw FieldError("to", "the curvature at its beginning is 0: there is no osculating plane",
                     "bend its beginning a little");
  const Vec3 n1 = glm::normalize(from.curvature), n3 = glm::normalize(to.curvature);
  if (glm::length(glm::cross(n1, n3)) <= kParallel && std::abs(glm::dot(n1, chord)) <= kParallel * size)
    return plane_transition(from, to, handles, weights);
  if (handles)
    throw FieldError("handles", "the ends do not lie in one plane: both lengths follow from them", "leave handles out");
  if (std::abs(glm::dot(n3, from.tangent)) <= kParallel)
    throw FieldError("from",
                     "its tangent at the end is parallel to the osculating plane of `to`: no single cubic joins them",
                     "turn one of the curves, or put another segment between them");
  if (std::abs(glm::dot(n1, to.tangent)) <= kParallel)
    throw FieldError(
        "to", "its tangent at the beginning is parallel to the osculating plane of `from`: no single cubic joins them",
        "turn one of the curves, or put another segment between them");
  const double s = glm::dot(n3, chord) / glm::dot(n3, from.tangent);
  const double u = -glm::dot(n1, chord) / glm::dot(n1, to.tangent);
  const Vec3 q = from.point + s * from.tangent, p = to.point + u * to.tangent;
  if (!(s > 0))
    throw FieldError(
        "from", fmt::format("its tangent meets the osculating plane of `to` behind its end, at {:.6g} along it", s),
        "move `to` forward along that tangent, or turn the beginning of `to`");
  if (!(u < 0))
    throw FieldError(
        "to",
        fmt::format("its tangent meets the osculating plane of `from` beyond its beginning, at {:.6g} along it", u),
        "move `from` back along that tangent, or turn the end of `from`");
  if (!(glm::dot(normal_at(from), p - from.point) > 0))
    throw FieldError(
        "from",
        "it bends at its end away from the third control point, on the tangent of `to`: wrong side of its tangent",
        "move `to` to the side to which `from` bends, or bend the end of `from` the other way");
  if (!(glm::dot(normal_at(to), q - to.point) > 0))
    throw FieldError("to",
                     "it bends at its beginning away from the second control point, on the tangent of `from`: wrong "
                     "side of its tangent",
                     "move `from` to the side to which `to` bends, or bend the beginning of `to` the other way");
  return between(from, to, q, p, weights);
}

BezierSegment g2_quintic(const G2End& from, const G2End& to) {
  const double c = glm::length(to.point - from.point);
  if (!(c > 0)) throw FieldError("to", "the ends coincide: there is no gap");
  // r'(0) = 5 (p_1 - p_0), r''(0) = 20 (p_2 - 2 p_1 + p_0); k N = K x T.
  const Vec3 a = c / 5 * from.tangent, b = c / 5 * to.tangent;
  const Vec3 bend_a = c * c / 20 * glm::cross(from.curvature, from.tangent);
  const Vec3 bend_b = c * c / 20 * glm::cross(to.curvature, to.tangent);
  return {{from.point, 1},   {from.point + a, 1}, {from.point + 2.0 * a + bend_a, 1}, {to.point - 2.0 * b + bend_b, 1},
          {to.point - b, 1}, {to.point, 1}};
}

NurbsCurveForm g2_chain_with_double_knots(std::span<const RationalCubic> segments) {
  NurbsCurveForm form;
  form.degree = 3;
  form.knots.assign(4, 0.0);
  BezierSegment left = segments.front().bezier();
  form.points.assign(left.begin(), left.begin() + 3);
  double at = 0, width = 1;
  for (size_t i = 1; i < segments.size(); ++i) {
    const RationalCubic& next = segments[i];
    const double r = glm::length(next.points[1] - next.points[0]) /
                     glm::length(Vec3(left[3]) / left[3].w - Vec3(left[2]) / left[2].w);
    const double a = left[2].w / left[3].w, b = 1 / (1 - r * (1 - a) / a);
    if (!(b > 0 && b < kInfinity))
      throw FieldError(
          "knots",
          fmt::format(
              "the joint of segments {} and {} cannot be a double knot: the ratio of weights there would be {:.6g}", i,
              i + 1, b),
          "knots: triple is always possible");
    at += width;
    width *= b * r / a;
    form.knots.insert(form.knots.end(), 2, at);
    const double base = left[3].w / next.weights[0], power = b * next.weights[0] / next.weights[1];
    double factor = base;
    for (int k = 0; k < 4; ++k, factor *= power) left[k] = factor * next.weights[k] * Vec4(next.points[k], 1);
    form.points.insert(form.points.end(), {left[1], left[2]});
  }
  form.points.push_back(left[3]);
  form.knots.insert(form.knots.end(), 4, at + width);
  return form;
}

}  // namespace lekalo::geometry
