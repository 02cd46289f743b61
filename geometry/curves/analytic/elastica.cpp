// Between two supports the bending moment, and so the curvature k, is linear in the place:
//
//   k = k0 + a x + b y,   x' = cos w, y' = sin w, w' = k        (from the first support, x along the tangent there)
//
// with k continuous over supports, and b = -k0^2 / 2 because the length is free (the energy of the pendulum that this
// equation is, vanishes). The linearised lath y'' = M(x) is the cubic spline (Zavyalov et al. 1985, 1, 2).
//
// Unknown are the angle and the curvature at each point, and a and the length for each span; known are the places where
// spans end, and at both ends of the lath the curvature, 0, or the angle: solved by Newton's method from the cubic
// spline.
#include "geometry/curves/analytic/elastica.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/numerics/gradient.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Runge-Kutta steps of a span, and of each of its polynomial pieces: errors of 1e-12 and less for turns up to a half.
constexpr int kStepsOfPiece = 8, kPieces = 32;
constexpr int kMaxIterations = 12;
constexpr double kSolved = 1e-12;
// Largest change of an angle, and of a part of a length, in one step of Newton's method; smallest part of the turns by
// which supports are bent.
constexpr double kSmallestBend = 1.0 / 1024;
constexpr double kLargestChange = 0.3;

template <class T>
using State = std::array<T, 3>;  // x, y, w

template <class T>
State<T> rate(const State<T>& s, const T& k0, const T& a) {
  using std::cos, std::sin;
  return {cos(s[2]), sin(s[2]), k0 + a * s[0] - 0.5 * k0 * k0 * s[1]};
}

// The places along a span of that length where its pieces end, the beginning included.
template <class T>
std::vector<State<T>> integrated(const T& k0, const T& a, const T& length) {
  const T h = length / double(kPieces * kStepsOfPiece);
  std::vector<State<T>> ends{State<T>{T(0), T(0), T(0)}};
  State<T> s = ends[0];
  const auto ahead = [&s](const State<T>& d, const T& step) {
    return State<T>{s[0] + step * d[0], s[1] + step * d[1], s[2] + step * d[2]};
  };
  for (int piece = 0; piece < kPieces; ++piece) {
    for (int step = 0; step < kStepsOfPiece; ++step) {
      const State<T> d1 = rate(s, k0, a), d2 = rate(ahead(d1, 0.5 * h), k0, a), d3 = rate(ahead(d2, 0.5 * h), k0, a);
      const State<T> d4 = rate(ahead(d3, h), k0, a);
      for (int i = 0; i < 3; ++i) s[i] = s[i] + h / 6.0 * (d1[i] + 2.0 * (d2[i] + d3[i]) + d4[i]);
    }
    ends.push_back(s);
  }
  return ends;
}

// Unknowns, all in units of the mean chord: angle and curvature of point i at 2 i, a and length of span i behind them.
class Lath {
 public:
  Lath(std::vector<Vec2> points, const std::optional<double>& start_angle, const std::optional<double>& end_angle)
      : points_(std::move(points)),
        spans_(static_cast<int>(points_.size()) - 1),
        start_(start_angle),
        end_(end_angle) {}

  int angle(int i) const { return 2 * i; }
  int curvature(int i) const { return 2 * i + 1; }
  int slope(int span) const { return 2 * (spans_ + 1) + 2 * span; }
  int length(int span) const { return slope(span) + 1; }
  int count() const { return 4 * spans_ + 2; }
  int spans() const { return spans_; }
  const Vec2& point(int i) const { return points_[i]; }

  // Residuals and their derivatives by the unknowns.
  void evaluate(const Eigen::VectorXd& u, Eigen::VectorXd& residual, Eigen::MatrixXd& jacobian) const {
    residual.setZero(count());
    jacobian.setZero(count(), count());
    for (int i = 0; i < spans_; ++i) add_span(u, i, residual, jacobian);
    add_end(u, 0, start_, 4 * spans_, residual, jacobian);
    add_end(u, spans_, end_, 4 * spans_ + 1, residual, jacobian);
  }

  // The largest of a step: of angles, and of lengths in proportion.
  double change(const Eigen::VectorXd& u, const Eigen::VectorXd& step) const {
    double largest = 1e-300;
    for (int i = 0; i <= spans_; ++i) largest = std::max(largest, std::abs(step[angle(i)]));
    for (int i = 0; i < spans_; ++i) largest = std::max(largest, std::abs(step[length(i)] / u[length(i)]));
    return largest;
  }

 private:
  void add_span(const Eigen::VectorXd& u, int i, Eigen::VectorXd& residual, Eigen::MatrixXd& jacobian) const {
    using Dual = Gradient<double>;
    const Dual k0 = Dual::variable(u[curvature(i)], 0), a = Dual::variable(u[slope(i)], 1);
    const State<Dual> end = integrated(k0, a, Dual::variable(u[length(i)], 2)).back();
    const double c = std::cos(u[angle(i)]), s = std::sin(u[angle(i)]);
    const Dual x = c * end[0] - s * end[1], y = s * end[0] + c * end[1];
    const Dual k = k0 + a * end[0] - 0.5 * k0 * k0 * end[1];
    const Vec2 chord = points_[i + 1] - points_[i];
    const Dual values[4] = {x - chord.x, y - chord.y, end[2] + (u[angle(i)] - u[angle(i + 1)]),
                            k - u[curvature(i + 1)]};
    const double by_angle[4] = {-y.c[0], x.c[0], 1, 0};
    for (int row = 0; row < 4; ++row) {
      residual[4 * i + row] = values[row].c[0];
      jacobian(4 * i + row, angle(i)) = by_angle[row];
      jacobian(4 * i + row, curvature(i)) = values[row].c[1];
      jacobian(4 * i + row, slope(i)) = values[row].c[2];
      jacobian(4 * i + row, length(i)) = values[row].c[3];
    }
    jacobian(4 * i + 2, angle(i + 1)) = -1;
    jacobian(4 * i + 3, curvature(i + 1)) = -1;
  }

  void add_end(const Eigen::VectorXd& u, int i, const std::optional<double>& given, int row, Eigen::VectorXd& residual,
               Eigen::MatrixXd& jacobian) const {
    const int unknown = given ? angle(i) : curvature(i);
    residual[row] = given ? std::remainder(u[unknown] - *given, kTwoPi) : u[unknown];
    jacobian(row, unknown) = 1;
  }

  std::vector<Vec2> points_;
  int spans_;
  std::optional<double> start_, end_;
};

// The polygon of the supports with all its turns, and those of given directions from its sides, in the same proportion:
// at 0 a straight line, at 1 itself.
class BentSupports {
 public:
  BentSupports(std::vector<Vec2> points, const std::optional<double>& start, const std::optional<double>& end)
      : points_(std::move(points)) {
    for (size_t i = 0; i + 1 < points_.size(); ++i) {
      const Vec2 chord = points_[i + 1] - points_[i];
      const double angle = std::atan2(chord.y, chord.x);
      lengths_.push_back(glm::length(chord));
      angles_.push_back(i == 0 ? angle : angles_[i - 1] + std::remainder(angle - angles_[i - 1], kTwoPi));
    }
    if (start) start_ = std::remainder(*start - angles_.front(), kTwoPi);
    if (end) end_ = std::remainder(*end - angles_.back(), kTwoPi);
  }

  Lath at(double part) const {
    std::vector<Vec2> points{points_[0]};
    for (size_t i = 0; i < lengths_.size(); ++i)
      points.push_back(part == 1
                           ? points_[i + 1]
                           : points.back() + lengths_[i] * Vec2(std::cos(angle(i, part)), std::sin(angle(i, part))));
    std::optional<double> start, end;
    if (start_) start = angle(0, part) + part * *start_;
    if (end_) end = angle(angles_.size() - 1, part) + part * *end_;
    return Lath(std::move(points), start, end);
  }

  // The straight lath's unknowns.
  Eigen::VectorXd straight() const {
    const Lath lath = at(0);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(lath.count());
    for (int i = 0; i <= lath.spans(); ++i) u[lath.angle(i)] = angles_[0];
    for (int i = 0; i < lath.spans(); ++i) u[lath.length(i)] = lengths_[i];
    return u;
  }

 private:
  double angle(size_t i, double part) const { return angles_[0] + part * (angles_[i] - angles_[0]); }

  std::vector<Vec2> points_;
  std::vector<double> lengths_, angles_;
  std::optional<double> start_, end_;
};

// Newton's method; false where it does not settle near u.
bool solve(const Lath& lath, Eigen::VectorXd& u) {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    lath.evaluate(u, residual, jacobian);
    if (residual.norm() <= kSolved) return true;
    const Eigen::VectorXd step = jacobian.partialPivLu().solve(residual);
    if (!(lath.change(u, step) <= kLargestChange)) return false;
    u -= step;
  }
  return false;
}

// The lath as its supports are bent from a straight line to their places.
Eigen::VectorXd bent(const BentSupports& supports) {
  Eigen::VectorXd u = supports.straight();
  double done = 0;
  for (double step = 1; done < 1;) {
    const double part = std::min(1.0, done + step);
    Eigen::VectorXd trial = u;
    if (solve(supports.at(part), trial)) {
      u = trial;
      done = part;
      step *= 2;
    } else if ((step /= 2) < kSmallestBend) {
      throw FieldError(
          "points",
          fmt::format("a lath slips off these supports when they are bent to {:.0f}% of their turns", 100 * done),
          "more points where it turns sharply; a spline_curve always exists");
    }
  }
  return u;
}

// The plane of the points, x from the first to the last of them that differ most.
Frame plane_of(std::span<const Vec3> points) {
  Vec3 far(0), normal(0);
  for (const Vec3& p : points)
    if (glm::length(p - points[0]) > glm::length(far)) far = p - points[0];
  for (const Vec3& p : points)
    if (glm::length(glm::cross(far, p - points[0])) > glm::length(normal)) normal = glm::cross(far, p - points[0]);
  const double size = glm::length(far);
  if (!(size > 0)) throw FieldError("points", "all points coincide");
  const Vec3 x = far / size;
  const bool straight = !(glm::length(normal) > kSamePoint * size * size);
  const Vec3 z = straight ? frame_about(Vec3(0), x).x : glm::normalize(normal);
  for (size_t i = 0; i < points.size(); ++i)
    if (std::abs(glm::dot(points[i] - points[0], z)) > kSamePoint * size)
      throw FieldError("points", fmt::format("point {} is not in the plane of the others", i),
                       "an elastica is a plane curve");
  return {points[0], x, glm::cross(z, x), z};
}

std::optional<double> angle_in(const Frame& plane, const std::optional<Vec3>& tangent, const char* field) {
  if (!tangent) return {};
  const Vec3 local = plane.to_local_direction(*tangent);
  if (!(std::hypot(local.x, local.y) > 0) || std::abs(local.z) > kSamePoint * glm::length(local))
    throw FieldError(field, "the direction is not in the plane of the points");
  return std::atan2(local.y, local.x);
}

// Bezier points of degree 5 with place, tangent and curvature vector at both ends, but the last.
void add_piece(const Vec3 (&from)[3], const Vec3 (&to)[3], double h, std::vector<Vec3>& points) {
  points.push_back(from[0]);
  points.push_back(from[0] + h / 5 * from[1]);
  points.push_back(from[0] + 2 * h / 5 * from[1] + h * h / 20 * from[2]);
  points.push_back(to[0] - 2 * h / 5 * to[1] + h * h / 20 * to[2]);
  points.push_back(to[0] - h / 5 * to[1]);
}

NurbsCurve curve_of(const Lath& lath, const Eigen::VectorXd& u, const Frame& plane, double unit,
                    std::span<const Vec3> points) {
  std::vector<Vec3> control;
  std::vector<double> knots(6, 0.0);
  for (int i = 0; i < lath.spans(); ++i) {
    const double k0 = u[lath.curvature(i)], a = u[lath.slope(i)], length = u[lath.length(i)];
    const auto ends = integrated(k0, a, length);
    const double c = std::cos(u[lath.angle(i)]), s = std::sin(u[lath.angle(i)]), begin = knots.back();
    const auto jet = [&](const State<double>& at, Vec3(&result)[3]) {
      const double x = c * at[0] - s * at[1], y = s * at[0] + c * at[1], w = at[2] + u[lath.angle(i)];
      const double k = (k0 + a * at[0] - 0.5 * k0 * k0 * at[1]) / unit;
      result[0] = points[i] + plane.direction({unit * x, unit * y, 0});
      result[1] = plane.direction({std::cos(w), std::sin(w), 0});
      result[2] = k * plane.direction({-std::sin(w), std::cos(w), 0});
    };
    Vec3 from[3], to[3];
    for (int piece = 0; piece < kPieces; ++piece) {
      jet(ends[piece], from);
      jet(ends[piece + 1], to);
      if (piece + 1 == kPieces) to[0] = points[i + 1];
      add_piece(from, to, unit * length / kPieces, control);
      knots.insert(knots.end(), 5, begin + unit * length * (piece + 1) / kPieces);
    }
  }
  knots.push_back(knots.back());
  control.push_back(points.back());
  return NurbsCurve(SplineAxis(5, std::move(knots), Extension::tangent), control);
}

}  // namespace

NurbsCurve elastica(std::span<const Vec3> points, const std::optional<Vec3>& start_tangent,
                    const std::optional<Vec3>& end_tangent) {
  const std::vector<double> chords = point_parameters({"chord_length", {}}, points, false);
  const double unit = chords.back() / (points.size() - 1);
  Frame plane = plane_of(points);
  // Points on a line leave the plane to the tangents.
  const std::optional<Vec3>& tangent = start_tangent ? start_tangent : end_tangent;
  if (tangent) {
    bool straight = true;
    for (const Vec3& p : points) straight = straight && std::abs(plane.to_local_point(p).y) <= kSamePoint * unit;
    const Vec3 normal = glm::cross(plane.x, *tangent);
    if (straight && glm::length(normal) > 0)
      plane = {plane.origin, plane.x, glm::cross(glm::normalize(normal), plane.x), glm::normalize(normal)};
  }
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back(Vec2(plane.to_local_point(p)) / unit);
  const BentSupports supports(std::move(flat), angle_in(plane, start_tangent, "start_tangent"),
                              angle_in(plane, end_tangent, "end_tangent"));
  return curve_of(supports.at(1), bent(supports), plane, unit, points);
}

TypeDeclaration elastica_type() {
  return declare(Category::curve, "elastica",
                 "The plane curve through points that an elastic lath takes: its squared curvature has the smallest "
                 "integral of all curves nearby. t is the length of arc.")
      .example("points: [[0, 0], [1, 0.8], [2, 0.2]]")
      .field("points", points().count(2), "points in a plane")
      .optional("start_tangent", vector(), "direction at the first point; without it the curvature vanishes there")
      .optional("end_tangent", vector(), "direction at the last point; without it the curvature vanishes there")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        const auto direction = [&](const char* field) {
          return f.has(field) ? std::optional<Vec3>(f.vec3(field)) : std::nullopt;
        };
        return elastica(f.points("points"), direction("start_tangent"), direction("end_tangent"));
      });
}

}  // namespace lekalo::geometry
