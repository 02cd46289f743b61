// From an equation to the axes: the quadratic part is turned to its eigenvectors, the linear part vanishes at the
// center, and of a parabola the vertex is where the gradient is along the axis.
#include "geometry/curves/analytic/conic_equation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// Below these parts of the coefficients' size a conic is a parabola, or a pair of lines.
constexpr double kParabola = 1e-10, kPair = 1e-12;
constexpr double kSameAxes = 1e-12;
constexpr double kFlat = 1e-9;  // of the points' size

Vec3 in_plane(const Frame& plane, const Vec4& p) {
  const Vec3 local = plane.to_local_direction(Vec3(p) - p.w * plane.origin);
  return {local.x, local.y, p.w};
}

Mat3 symmetric_product(const Vec3& a, const Vec3& b) {
  return 0.5 * (glm::outerProduct(a, b) + glm::outerProduct(b, a));
}

// The line through two points in its normal form.
Vec3 line_through(const Vec3& a, const Vec3& b) {
  const Vec3 line = glm::cross(a, b);
  return line / std::hypot(line.x, line.y);
}

struct Lines {
  std::array<Vec3, 4> l;
  Lines(const Frame& plane, const std::array<Vec3, 4>& points) {
    const auto at = [&](int k) { return in_plane(plane, Vec4(points[k], 1)); };
    l = {line_through(at(0), at(1)), line_through(at(2), at(3)), line_through(at(0), at(2)),
         line_through(at(1), at(3))};
  }
};

// The equation with coordinates about the center of what is near the origin and in units of its size: x = s x'.
Mat3 scaled(const Mat3& q, double s) {
  const Mat3 by(Vec3(s, 0, 0), Vec3(0, s, 0), Vec3(0, 0, 1));
  Mat3 result = by * q * by;
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(result[i][j]));
  return result / size;
}

// A length that makes the quadratic and the constant coefficients, or the linear ones, alike.
double unit_of(const Mat3& q) {
  const double quadratic = std::sqrt(q[0][0] * q[0][0] + 2 * q[0][1] * q[0][1] + q[1][1] * q[1][1]);
  const double linear = std::hypot(q[2][0], q[2][1]) / quadratic, constant = std::sqrt(std::abs(q[2][2]) / quadratic);
  const double unit = std::max(linear, constant);
  return unit > 0 && unit < kInfinity ? unit : 1;
}

// The quadratic part's axes: values[0] belongs to the direction `x`.
struct Axes {
  double along, across;
  Vec2 x;
};
Axes axes_of(const Mat3& q) {
  Eigen::Matrix2d m;
  m << q[0][0], q[0][1], q[0][1], q[1][1];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(m);
  return {solver.eigenvalues()[0], solver.eigenvalues()[1], {solver.eigenvectors()(0, 0), solver.eigenvectors()(1, 0)}};
}

Frame placed(const Frame& plane, const Vec2& origin, const Vec2& x) {
  const Vec3 along = glm::normalize(x.x * plane.x + x.y * plane.y);
  return {plane.origin + origin.x * plane.x + origin.y * plane.y, along, glm::cross(plane.z, along), plane.z};
}

std::optional<CanonicalConic> parabola_of(const Frame& plane, const Mat3& q, const Axes& axes) {
  // In the axes, e the number that is not zero and d, g the linear coefficients: e y^2 + 2 d x + 2 g y + f = 0.
  const bool first_is_zero = std::abs(axes.along) < std::abs(axes.across);
  const Vec2 x = first_is_zero ? axes.x : Vec2(-axes.x.y, axes.x.x), y(-x.y, x.x);
  const double e = first_is_zero ? axes.across : axes.along;
  const Vec2 linear(q[2][0], q[2][1]);
  const double d = glm::dot(linear, x), g = glm::dot(linear, y);
  if (!(std::abs(d) > kPair)) return std::nullopt;
  const double vertex_y = -g / e, vertex_x = -(q[2][2] + g * vertex_y) / (2 * d), focal_length = -d / (2 * e);
  const Vec2 origin = vertex_x * x + vertex_y * y;
  return CanonicalConic{CanonicalConic::Kind::parabola, placed(plane, origin, focal_length > 0 ? x : -x),
                        std::abs(focal_length), 0};
}

// Both ends of an axis are alike: x is that on the side of the global x, or y, or z; of a circle that of the plane.
void turn_to_plane(CanonicalConic& conic, const Frame& plane) {
  Frame& frame = conic.frame;
  if (std::abs(conic.a - conic.b) <= kSameAxes * conic.a && conic.kind == CanonicalConic::Kind::ellipse) {
    frame.x = plane.x, frame.y = plane.y;
    return;
  }
  for (int k = 0; k < 3; ++k) {
    if (std::abs(frame.x[k]) <= kSameAxes) continue;
    if (frame.x[k] < 0) frame.x = -frame.x, frame.y = -frame.y;
    return;
  }
}

}  // namespace

std::string_view name(CanonicalConic::Kind kind) {
  switch (kind) {
    case CanonicalConic::Kind::ellipse:
      return "ellipse";
    case CanonicalConic::Kind::hyperbola:
      return "hyperbola";
    case CanonicalConic::Kind::parabola:
      break;
  }
  return "parabola";
}

std::optional<CanonicalConic> canonical(const ConicEquation& equation) {
  const double unit = unit_of(equation.q);
  const Mat3 q = scaled(equation.q, unit);
  if (!std::isfinite(q[0][0] + q[1][1] + q[2][2])) return std::nullopt;
  const Axes axes = axes_of(q);
  const double larger = std::max(std::abs(axes.along), std::abs(axes.across));
  if (!(larger > kPair)) return std::nullopt;
  std::optional<CanonicalConic> result;
  if (std::min(std::abs(axes.along), std::abs(axes.across)) <= kParabola * larger) {
    result = parabola_of({Vec3(0), equation.plane.x, equation.plane.y, equation.plane.z}, q, axes);
  } else {
    const double determinant = q[0][0] * q[1][1] - q[0][1] * q[0][1];
    const Vec2 center((q[0][1] * q[2][1] - q[1][1] * q[2][0]) / determinant,
                      (q[0][1] * q[2][0] - q[0][0] * q[2][1]) / determinant);
    const double f = q[2][2] + q[2][0] * center.x + q[2][1] * center.y;
    if (!(std::abs(f) > kPair)) return std::nullopt;
    // along x^2 + across y^2 + f = 0
    const double x2 = -f / axes.along, y2 = -f / axes.across;
    if (x2 < 0 && y2 < 0) return std::nullopt;
    const bool x_first = x2 > 0 && (y2 < 0 || x2 >= y2);
    result = CanonicalConic{x2 > 0 && y2 > 0 ? CanonicalConic::Kind::ellipse : CanonicalConic::Kind::hyperbola,
                            placed({Vec3(0), equation.plane.x, equation.plane.y, equation.plane.z}, center,
                                   x_first ? axes.x : Vec2(-axes.x.y, axes.x.x)),
                            std::sqrt(std::abs(x_first ? x2 : y2)), std::sqrt(std::abs(x_first ? y2 : x2))};
  }
  if (!result) return std::nullopt;
  if (result->kind != CanonicalConic::Kind::parabola) turn_to_plane(*result, equation.plane);
  result->frame.origin = equation.plane.origin + unit * result->frame.origin;
  result->a *= unit;
  result->b *= unit;
  return result;
}

std::optional<ConicEquation> equation_of(std::span<const Vec4> p) {
  // Directions in the plane: of a point at infinity its own.
  const auto from_first = [&](const Vec4& to) { return p[0].w * Vec3(to) - to.w * Vec3(p[0]); };
  const Vec3 a = from_first(p[1]), b = from_first(p[2]), normal = glm::cross(a, b);
  if (p[0].w == 0 || !(glm::length(normal) > kPair * glm::length(a) * glm::length(b))) return std::nullopt;
  ConicEquation result{frame_from(Vec3(p[0]) / p[0].w, normal, b), {}};
  const Vec3 p0 = in_plane(result.plane, p[0]), p1 = in_plane(result.plane, p[1]), p2 = in_plane(result.plane, p[2]);
  const Vec3 l0 = glm::cross(p1, p2), l1 = glm::cross(p2, p0), l2 = glm::cross(p0, p1);
  result.q = symmetric_product(l1, l1) - 4.0 * symmetric_product(l0, l2);
  return result;
}

ConicEquation pencil_member(const Frame& plane, const std::array<Vec3, 4>& points, double lambda) {
  const Lines lines(plane, points);
  return {plane, (1 - lambda) * symmetric_product(lines.l[0], lines.l[1]) +
                     lambda * symmetric_product(lines.l[2], lines.l[3])};
}

double pencil_number(const Frame& plane, const std::array<Vec3, 4>& points, const Vec3& fifth) {
  const Lines lines(plane, points);
  const Vec3 p = in_plane(plane, Vec4(fifth, 1));
  const double first = glm::dot(lines.l[0], p) * glm::dot(lines.l[1], p),
               second = glm::dot(lines.l[2], p) * glm::dot(lines.l[3], p);
  return first / (first - second);
}

ConicEquation touching_pencil_member(const Frame& plane, const std::array<Vec3, 3>& points, double lambda) {
  const auto at = [&](int k) { return in_plane(plane, Vec4(points[k], 1)); };
  const auto coordinate = [&](int zero, int one) {  // zero on the line from the corner to a point, one at the other
    const Vec3 line = glm::cross(at(1), at(zero));
    return line / glm::dot(line, at(one));
  };
  const Vec3 u = coordinate(2, 0), v = coordinate(0, 2), chord = u + v - Vec3(0, 0, 1);
  return {plane, (1 - lambda) * symmetric_product(u, v) + lambda * symmetric_product(chord, chord)};
}

Frame plane_of(std::span<const Vec3> points, const char* field) {
  double size = 0;
  for (const Vec3& p : points) size = std::max(size, glm::length(p - points[0]));
  Vec3 normal(0);
  for (size_t i = 1; i < points.size(); ++i)
    for (size_t j = i + 1; j < points.size(); ++j) {
      const Vec3 n = glm::cross(points[i] - points[0], points[j] - points[0]);
      if (glm::dot(n, n) > glm::dot(normal, normal)) normal = n;
    }
  if (!(glm::length(normal) > kFlat * size * size))
    throw FieldError(field, "the points lie on one line or coincide",
                     "move one of them off the line; what is straight is a segment");
  const Frame plane = frame_about(points[0], glm::normalize(normal));
  for (const Vec3& p : points)
    if (std::abs(plane.to_local_point(p).z) > kFlat * size)
      throw FieldError(field, "the points do not lie in one plane", "a conic lies in a plane: move them into one");
  return plane;
}

}  // namespace lekalo::geometry
