#include "geometry/queries/quadrics/quadric_sections.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Rounding of the entries of a matrix, as a part of the largest.
constexpr double kRounding = 32 * kEpsilon;
// A principal value that is so much smaller than the other, but not zero, leaves a center too far away to be known.
constexpr double kFlat = 1e-10;
// Distances nearer to the tolerance than by this factor are left to a search: they are estimates here.
constexpr double kUnclear = 10;

double largest(const Mat3& m) {
  double most = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(m[i][j]));
  return most;
}

// The quadric in a plane: over p = base + s x + t y with x, y along the principal axes, |l1| >= |l2|.
struct PlaneForm {
  Vec3 base, x, y;
  double l1, l2, b1, b2, c;
};

PlaneForm form_in(const QuadricForm& quadric, const PlaneEquation& plane) {
  const Frame frame = frame_about(plane.height * plane.normal, plane.normal);
  const Vec3 ax = quadric.a * frame.x, ay = quadric.a * frame.y;
  const double xx = glm::dot(frame.x, ax), xy = glm::dot(frame.x, ay), yy = glm::dot(frame.y, ay);
  double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const auto value = [&](double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    return c * c * xx + 2 * c * s * xy + s * s * yy;
  };
  if (std::abs(value(angle)) < std::abs(value(angle + 0.5 * kPi))) angle += 0.5 * kPi;
  PlaneForm form;
  form.base = frame.origin;
  form.x = std::cos(angle) * frame.x + std::sin(angle) * frame.y;
  form.y = std::cos(angle) * frame.y - std::sin(angle) * frame.x;
  form.l1 = value(angle);
  form.l2 = value(angle + 0.5 * kPi);
  const Vec3 half = quadric.a * form.base + quadric.b;
  form.b1 = glm::dot(form.x, half);
  form.b2 = glm::dot(form.y, half);
  form.c = quadric.at(form.base);
  return form;
}

Conic line(const Vec3& through, const Vec3& along) { return {Conic::Kind::line, through, Vec3(0), along}; }

// How far the quadric is from a point where it has a value, to the first order.
double distance_at(const QuadricForm& quadric, const Vec3& p) {
  return std::abs(quadric.at(p)) / glm::length(quadric.gradient(p));
}

// l1 (s - s0)^2 + k = 0: two lines, a double one or none.
std::optional<PlaneIntersection> parallel_lines(const QuadricForm& quadric, const PlaneForm& form, double s0, double k,
                                                double rounding, double tolerance) {
  PlaneIntersection result;
  const Vec3 middle = form.base + s0 * form.x;
  if (std::abs(k) <= rounding) {
    result.touching = true;
    result.conics = {line(middle, form.y)};
  } else if (const double square = -k / form.l1; square > 0) {
    for (const double off : {-std::sqrt(square), std::sqrt(square)})
      result.conics.push_back(line(middle + off * form.x, form.y));
  } else if (!(distance_at(quadric, middle) > kUnclear * tolerance)) {
    return std::nullopt;
  }
  return result;
}

// l1 s^2 + l2 t^2 + k = 0 about a center.
std::optional<PlaneIntersection> central(const QuadricForm& quadric, const PlaneForm& form, const Vec3& center,
                                         double k, double rounding, double tolerance) {
  PlaneIntersection result;
  const bool degenerate = std::abs(k) <= rounding;
  if (form.l1 * form.l2 > 0) {
    if (degenerate) {
      result.contacts = {center};
    } else if (-k / form.l1 > 0) {
      result.conics = {
          {Conic::Kind::ellipse, center, std::sqrt(-k / form.l1) * form.x, std::sqrt(-k / form.l2) * form.y}};
    } else {
      const double distance = distance_at(quadric, center);
      if (distance < tolerance / kUnclear)
        result.contacts = {center};
      else if (!(distance > kUnclear * tolerance))
        return std::nullopt;
    }
    return result;
  }
  if (degenerate) {
    const double slope = std::sqrt(-form.l2 / form.l1);
    for (const double sign : {1.0, -1.0})
      result.conics.push_back(line(center, glm::normalize(form.y + sign * slope * form.x)));
    result.crossings = {center};
    return result;
  }
  const bool along_x = -k / form.l1 > 0;
  const Vec3 x = std::sqrt(std::abs(k / form.l1)) * form.x, y = std::sqrt(std::abs(k / form.l2)) * form.y;
  for (const double sign : {1.0, -1.0})
    result.conics.push_back({Conic::Kind::hyperbola, center, sign * (along_x ? x : y), along_x ? y : x});
  return result;
}

}  // namespace

std::optional<PlaneIntersection> plane_section(const QuadricForm& quadric, const PlaneEquation& plane,
                                               const SectionScale& scale) {
  const PlaneForm form = form_in(quadric, plane);
  const double whole = largest(quadric.a), rounding_of_b = quadric.rounding / scale.size;
  PlaneIntersection result;
  if (std::abs(form.l1) <= kRounding * whole) {
    // The plane holds a generatrix of a saddle, and another one lies at infinity.
    const double slope = std::hypot(form.b1, form.b2);
    if (!(slope > kRounding / kFlat * rounding_of_b)) return std::nullopt;
    const Vec3 across = (form.b1 * form.x + form.b2 * form.y) / slope;
    result.conics = {line(form.base - (0.5 * form.c / slope) * across, glm::cross(plane.normal, across))};
    return result;
  }
  const double s0 = -form.b1 / form.l1, k1 = form.c + form.b1 * s0;
  const double rounding1 = quadric.rounding + rounding_of_b * std::abs(s0);
  if (std::abs(form.l2) > kFlat * std::abs(form.l1)) {
    const double t0 = -form.b2 / form.l2, rounding = rounding1 + rounding_of_b * std::abs(t0);
    return central(quadric, form, form.base + s0 * form.x + t0 * form.y, k1 + form.b2 * t0, rounding, scale.tolerance);
  }
  if (std::abs(form.l2) > kRounding * whole) return std::nullopt;
  if (std::abs(form.b2) <= rounding_of_b) return parallel_lines(quadric, form, s0, k1, rounding1, scale.tolerance);
  if (!(std::abs(form.b2) > rounding_of_b / kFlat * kRounding)) return std::nullopt;
  const double focal = std::abs(form.b2 / (2 * form.l1)), sign = form.l1 * form.b2 < 0 ? 1 : -1;
  const Vec3 vertex = form.base + s0 * form.x - k1 / (2 * form.b2) * form.y;
  result.conics = {{Conic::Kind::parabola, vertex, sign * focal * form.y, 2 * focal * form.x}};
  return result;
}

namespace {

struct Principal {
  std::array<double, 3> value;  // in order
  std::array<Vec3, 3> axis;
};

Principal principal(const Mat3& m) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = 0.5 * (m[i][j] + m[j][i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  Principal result;
  for (int k = 0; k < 3; ++k) {
    result.value[k] = solver.eigenvalues()[k];
    const auto v = solver.eigenvectors().col(k);
    result.axis[k] = {v[0], v[1], v[2]};
  }
  return result;
}

QuadricForm times(double factor, const QuadricForm& q) {
  return {factor * q.a, factor * q.b, factor * q.c, std::abs(factor) * q.rounding};
}

// The value that belongs to all directions across an axis of revolution; 0 where there is none.
double value_across(const QuadricForm& quadric) {
  const std::array<double, 3> v = principal(quadric.a).value;
  const double same = kRounding * std::max(std::abs(v[0]), std::abs(v[2]));
  if (std::abs(v[1] - v[0]) <= same) return 0.5 * (v[0] + v[1]);
  if (std::abs(v[2] - v[1]) <= same) return 0.5 * (v[1] + v[2]);
  return 0;
}

// The second times a number, so that the difference can be a product; nothing where no number does that.
std::optional<QuadricForm> comparable(const QuadricForm& first, const QuadricForm& second) {
  double both = 0, square = 0;
  for (int i = 0; i < 3; ++i) both += glm::dot(first.a[i], second.a[i]), square += glm::dot(second.a[i], second.a[i]);
  const double alike = both / square;
  if (alike != 0 && largest(first.a - alike * second.a) <= kRounding * largest(first.a)) return times(alike, second);
  const double a = value_across(first), b = value_across(second);
  if (a == 0 || b == 0) return std::nullopt;
  return times(a / b, second);
}

PlaneEquation plane_of(const Vec3& normal, double height) {
  const double length = glm::length(normal);
  return {normal / length, height / length};
}

// The difference of two quadrics, D(p) = p . a p + 2 b . p + c, with the rounding of its parts.
struct Difference {
  QuadricForm d;
  double in_a, in_b, in_c;
};

// a = 0: 2 b . p + c = 0.
std::optional<CommonPlanes> linear(const Difference& difference, const QuadricForm& first, const SectionScale& scale) {
  const auto& [d, in_a, in_b, in_c] = difference;
  CommonPlanes result;
  const double slope = glm::length(d.b);
  if (slope <= in_b && std::abs(d.c) <= in_c) {
    result.coincident = true;
    return result;
  }
  // How far apart the quadrics are, seen along normals of the first.
  const double steep =
      2 * std::sqrt(largest(first.a) * (std::abs(first.c) + largest(first.a) * scale.size * scale.size));
  if ((2 * slope * scale.size + std::abs(d.c)) <= kUnclear * scale.tolerance * steep) return std::nullopt;
  if (slope > in_b) result.planes = {plane_of(2.0 * d.b, -d.c)};
  return result;
}

// a = e n n: planes across n at the roots of e h^2 + 2 (b . n) h + c.
std::optional<CommonPlanes> parallel(const Difference& difference, double e, const Vec3& n, const QuadricForm& first,
                                     const SectionScale& scale) {
  const auto& [d, in_a, in_b, in_c] = difference;
  const double along = glm::dot(d.b, n);
  if (glm::length(d.b - along * n) > in_b) return std::nullopt;
  CommonPlanes result;
  const double middle = -along / e, square = (along * along / e - d.c) / e;
  const double rounding = (in_c + in_b * std::abs(middle)) / std::abs(e);
  if (std::abs(square) <= rounding) {
    result.touching = true;
    result.planes = {{n, middle}};
  } else if (square > 0) {
    for (const double off : {-std::sqrt(square), std::sqrt(square)}) result.planes.push_back({n, middle + off});
  } else {
    const double steep = 2 * std::sqrt(largest(first.a) * std::abs(first.c)) + 2 * glm::length(first.b);
    if (!(std::abs(e * square) > kUnclear * scale.tolerance * steep)) return std::nullopt;
  }
  return result;
}

}  // namespace

std::optional<CommonPlanes> common_planes(const QuadricForm& first, const QuadricForm& given,
                                          const SectionScale& scale) {
  const std::optional<QuadricForm> second = comparable(first, given);
  if (!second) return std::nullopt;
  const double rounding = first.rounding + second->rounding;
  const Difference difference{{first.a - second->a, first.b - second->b, first.c - second->c, rounding},
                              2 * kRounding * std::max(largest(first.a), largest(second->a)),
                              rounding / scale.size,
                              rounding};
  const QuadricForm& d = difference.d;
  const Principal axes = principal(d.a);
  const bool lowest = std::abs(axes.value[0]) > difference.in_a, highest = std::abs(axes.value[2]) > difference.in_a;
  if (std::abs(axes.value[1]) > difference.in_a) return std::nullopt;
  if (!lowest && !highest) return linear(difference, first, scale);
  if (lowest != highest) {
    const int k = lowest ? 0 : 2;
    return parallel(difference, axes.value[k], axes.axis[k], first, scale);
  }
  // e2 (y - y0)^2 - e0 (x - x0)^2 = (r y - s x - ..)(r y + s x - ..), with nothing left over.
  const double s = std::sqrt(-axes.value[0]), r = std::sqrt(axes.value[2]);
  const double along_x = glm::dot(d.b, axes.axis[0]), along_y = glm::dot(d.b, axes.axis[2]);
  const double x0 = -along_x / axes.value[0], y0 = -along_y / axes.value[2];
  const double rest = d.c + along_x * x0 + along_y * y0;
  if (std::abs(glm::dot(d.b, axes.axis[1])) > difference.in_b ||
      std::abs(rest) > difference.in_c + difference.in_b * (std::abs(x0) + std::abs(y0)))
    return std::nullopt;
  CommonPlanes result;
  for (const double sign : {1.0, -1.0})
    result.planes.push_back(plane_of(r * axes.axis[2] + sign * s * axes.axis[0], r * y0 + sign * s * x0));
  return result;
}

}  // namespace lekalo::geometry
