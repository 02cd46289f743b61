#include "geometry/constraints/conditions.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <unsupported/Eigen/AutoDiff>

#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

namespace {

// By those unknowns that a condition depends on: at most six of each of four points.
constexpr int kMaxUnknowns = 24;
using Derivatives = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxUnknowns, 1>;
using Dual = Eigen::AutoDiffScalar<Derivatives>;

// All unknowns, of which those in `used` (sorted) have derivatives.
class Unknowns {
 public:
  explicit Unknowns(std::span<const double> values, std::span<const int> used = {}) : values_(values), used_(used) {}
  Eigen::Index count() const { return static_cast<Eigen::Index>(used_.size()); }
  Dual operator[](int number) const {
    Dual result(values_[static_cast<size_t>(number)], Derivatives::Zero(count()));
    const auto found = std::lower_bound(used_.begin(), used_.end(), number);
    if (found != used_.end() && *found == number) result.derivatives()[found - used_.begin()] = 1;
    return result;
  }

 private:
  std::span<const double> values_;
  std::span<const int> used_;
};

std::vector<int> used_by(std::initializer_list<UnknownPoint> points) {
  std::vector<int> used;
  for (const UnknownPoint& p : points) {
    for (const int number : p.coordinates)
      if (number >= 0) used.push_back(number);
    if (p.parameter >= 0) used.push_back(p.parameter);
    for (int k = 0; k < 6 && p.pose.first >= 0; ++k) used.push_back(p.pose.first + k);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}
std::vector<int> used_by(const Marker& a, const Marker& b) { return used_by({a.point, b.point}); }

struct Point {
  Dual x, y, z;
};
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Dual dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Dual length(const Point& a) { return sqrt(Dual(dot(a, a))); }

Dual constant(double value, const Unknowns& x) { return {value, Derivatives::Zero(x.count())}; }
Point constant(const Vec3& p, const Unknowns& x) { return {constant(p.x, x), constant(p.y, x), constant(p.z, x)}; }

// R(w) a = a + s (w x a) + c (w x (w x a)), s = sin q / q, c = (1 - cos q) / q^2, q = |w| (Rodrigues).
Point turned(const UnknownPose& pose, const Vec3& a, const Unknowns& x) {
  const Point w{x[pose.first], x[pose.first + 1], x[pose.first + 2]}, from = constant(a, x);
  const Dual square = dot(w, w);
  Dual s, c;
  if (square.value() < 1e-6) {
    s = 1.0 - square / 6.0 * (1.0 - square / 20.0);
    c = 0.5 - square / 24.0 * (1.0 - square / 30.0);
  } else {
    const Dual q = sqrt(square);
    s = sin(q) / q;
    c = (1.0 - cos(q)) / square;
  }
  const Point once = cross(w, from), twice = cross(w, once);
  return {from.x + s * once.x + c * twice.x, from.y + s * once.y + c * twice.y, from.z + s * once.z + c * twice.z};
}

Point place(const UnknownPoint& p, const Unknowns& x) {
  if (p.curve) {
    const CurveJet jet = p.curve->evaluate(x[p.parameter].value(), 1);
    const auto along = [&](int k) {
      return Dual(jet.d[0][k], Derivatives(jet.d[1][k] * x[p.parameter].derivatives()));
    };
    return {along(0), along(1), along(2)};
  }
  if (p.pose.first >= 0) {
    const int shift = p.pose.first + 3;
    return turned(p.pose, p.at - p.pose.origin, x) + constant(p.pose.origin, x) +
           Point{x[shift], x[shift + 1], x[shift + 2]};
  }
  const auto coordinate = [&](int k) { return p.coordinates[k] >= 0 ? x[p.coordinates[k]] : constant(p.at[k], x); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

Point vector(const Marker& marker, const Vec3& v, const Unknowns& x) {
  return marker.point.pose.first >= 0 ? turned(marker.point.pose, v, x) : constant(v, x);
}
Vec3 across(const Marker& marker) { return glm::cross(marker.normal, marker.direction); }

// Formula: gives `count` numbers of the unknowns in `used`.
template <class Formula>
Constraint made(std::string name, int count, std::vector<int> used, Formula formula) {
  Constraint result{std::move(name), count, false, std::move(used), {}};
  result.evaluate = [count, used = result.unknowns, formula = std::move(formula)](
                        std::span<const double> values, Eigen::Ref<Eigen::VectorXd> f,
                        Eigen::Ref<Eigen::MatrixXd> jacobian) {
    const std::vector<Dual> numbers = formula(Unknowns(values, used));
    for (int i = 0; i < count; ++i) {
      f[i] = numbers[i].value();
      for (Eigen::Index k = 0; k < numbers[i].derivatives().size(); ++k)
        jacobian(i, used[static_cast<size_t>(k)]) = numbers[i].derivatives()[k];
    }
  };
  return result;
}

}  // namespace

Vec3 place_of(const UnknownPoint& point, std::span<const double> unknowns) {
  const Point p = place(point, Unknowns(unknowns));
  return {p.x.value(), p.y.value(), p.z.value()};
}

Affine map_of(const UnknownPose& pose, std::span<const double> unknowns) {
  if (pose.first < 0) return {};
  const auto at = [&](int k) { return unknowns[static_cast<size_t>(pose.first + k)]; };
  const Vec3 w(at(0), at(1), at(2)), shift(at(3), at(4), at(5));
  const double angle = glm::length(w);
  const Affine turn = angle > 0 ? Affine::rotation(angle, w / angle, pose.origin) : Affine();
  return Affine::translation(shift) * turn;
}

Constraint coincidence(std::string name, const UnknownPoint& a, const UnknownPoint& b) {
  const bool plane = a.is_plane() && b.is_plane() && a.at.z == b.at.z;
  return made(std::move(name), plane ? 2 : 3, used_by({a, b}), [=](const Unknowns& x) {
    const Point d = place(b, x) - place(a, x);
    return std::vector{d.x, d.y, d.z};
  });
}

Constraint fixation(std::string name, const UnknownPoint& a, Start start) {
  if (a.curve)
    return made(std::move(name), 1, used_by({a}), [=, t = start[static_cast<size_t>(a.parameter)]](const Unknowns& x) {
      return std::vector<Dual>{x[a.parameter] - t};
    });
  const Vec3 at = place_of(a, start);
  return made(std::move(name), a.is_plane() ? 2 : 3, used_by({a}), [=](const Unknowns& x) {
    const Point d = place(a, x) - constant(at, x);
    return std::vector{d.x, d.y, d.z};
  });
}

Constraint fixation(std::string name, const UnknownPose& pose) {
  return made(std::move(name), 6, used_by({{.pose = pose}}), [=](const Unknowns& x) {
    std::vector<Dual> result;
    for (int k = 0; k < 6; ++k) result.push_back(x[pose.first + k]);
    return result;
  });
}

Constraint distance_between(std::string name, const UnknownPoint& a, const UnknownPoint& b, double d) {
  return made(std::move(name), 1, used_by({a, b}),
              [=](const Unknowns& x) { return std::vector<Dual>{length(place(b, x) - place(a, x)) - d}; });
}

Constraint coordinate_distance(std::string name, const UnknownPoint& a, const UnknownPoint& b, int axis, double d,
                               Start start) {
  const double sign = place_of(b, start)[axis] < place_of(a, start)[axis] ? -1 : 1;
  return made(std::move(name), 1, used_by({a, b}), [=](const Unknowns& x) {
    const Point way = place(b, x) - place(a, x);
    const Dual& along = axis == 0 ? way.x : axis == 1 ? way.y : way.z;
    return std::vector<Dual>{sign * along - d};
  });
}

// |u x v| cos q - u . v sin q = |u| |v| sin(angle - q).
Constraint angle_between(std::string name, const UnknownPoint& a, const UnknownPoint& b, const UnknownPoint& c,
                         double angle) {
  return made(std::move(name), 1, used_by({a, b, c}), [=](const Unknowns& x) {
    const Point middle = place(b, x), u = place(a, x) - middle, v = place(c, x) - middle;
    const Dual whole = length(u) * length(v);
    return std::vector<Dual>{(std::cos(angle) * length(cross(u, v)) - std::sin(angle) * dot(u, v)) / whole};
  });
}

Constraint parallel(std::string name, const Segment2& a, const Segment2& b, Start start) {
  const auto is_level = [](const Segment2& s) { return s[0].is_plane() && s[1].is_plane() && s[0].at.z == s[1].at.z; };
  const bool plane = is_level(a) && is_level(b);
  const Vec3 way = glm::abs(place_of(b[1], start) - place_of(b[0], start));
  // Of three components of the product the one along the segment says nothing new.
  const int left_out = plane ? -1 : way.x >= way.y && way.x >= way.z ? 0 : way.y >= way.z ? 1 : 2;
  return made(std::move(name), plane ? 1 : 2, used_by({a[0], a[1], b[0], b[1]}), [=](const Unknowns& x) {
    const Point u = place(a[1], x) - place(a[0], x), v = place(b[1], x) - place(b[0], x), w = cross(u, v);
    const Dual whole = length(u) * length(v);
    std::vector<Dual> result;
    if (plane) return std::vector<Dual>{w.z / whole};
    if (left_out != 0) result.emplace_back(w.x / whole);
    if (left_out != 1) result.emplace_back(w.y / whole);
    if (left_out != 2) result.emplace_back(w.z / whole);
    return result;
  });
}

Constraint perpendicular(std::string name, const Segment2& a, const Segment2& b, Start) {
  return made(std::move(name), 1, used_by({a[0], a[1], b[0], b[1]}), [=](const Unknowns& x) {
    const Point u = place(a[1], x) - place(a[0], x), v = place(b[1], x) - place(b[0], x);
    return std::vector<Dual>{dot(u, v) / Dual(length(u) * length(v))};
  });
}

Constraint equal_lengths(std::string name, const Segment2& a, const Segment2& b) {
  return made(std::move(name), 1, used_by({a[0], a[1], b[0], b[1]}), [=](const Unknowns& x) {
    return std::vector<Dual>{length(place(a[1], x) - place(a[0], x)) - length(place(b[1], x) - place(b[0], x))};
  });
}

Constraint point_to_plane(std::string name, const Marker& point, const Marker& plane, double d) {
  return made(std::move(name), 1, used_by(point, plane), [=](const Unknowns& x) {
    return std::vector<Dual>{dot(place(point.point, x) - place(plane.point, x), vector(plane, plane.normal, x)) - d};
  });
}

Constraint point_on_axis(std::string name, const Marker& point, const Marker& axis) {
  return made(std::move(name), 2, used_by(point, axis), [=](const Unknowns& x) {
    const Point way = place(point.point, x) - place(axis.point, x);
    return std::vector<Dual>{dot(way, vector(axis, axis.direction, x)), dot(way, vector(axis, across(axis), x))};
  });
}

Constraint axis_along_plane(std::string name, const Marker& axis, const Marker& plane) {
  return made(std::move(name), 1, used_by(axis, plane), [=](const Unknowns& x) {
    return std::vector<Dual>{dot(vector(axis, axis.normal, x), vector(plane, plane.normal, x))};
  });
}

Constraint plane_angle(std::string name, const Marker& a, const Marker& b, double angle) {
  return made(std::move(name), 1, used_by(a, b), [=](const Unknowns& x) {
    return std::vector<Dual>{dot(vector(a, a.normal, x), vector(b, b.normal, x)) - std::cos(angle)};
  });
}

Constraint parallel_planes(std::string name, const Marker& a, const Marker& b) {
  return made(std::move(name), 2, used_by(a, b), [=](const Unknowns& x) {
    const Point n = vector(a, a.normal, x);
    return std::vector<Dual>{dot(n, vector(b, b.direction, x)), dot(n, vector(b, across(b), x))};
  });
}

Constraint aligned(std::string name, const Marker& a, const Marker& b) {
  return made(std::move(name), 1, used_by(a, b), [=](const Unknowns& x) {
    return std::vector<Dual>{dot(vector(a, a.direction, x), vector(b, across(b), x))};
  });
}

Constraint formula_constraint(std::string name, const Expression& difference, std::vector<int> variables,
                              std::vector<int> used, bool is_inequality) {
  return {std::move(name), 1, is_inequality, used,
          [difference, variables = std::move(variables), used = std::move(used)](
              std::span<const double> unknowns, Eigen::Ref<Eigen::VectorXd> f, Eigen::Ref<Eigen::MatrixXd> jacobian) {
            std::vector<Jet<double, 1>> values;
            for (const int k : variables) values.emplace_back(unknowns[static_cast<size_t>(k)]);
            for (size_t i = 0; i < variables.size(); ++i) {
              if (std::find(used.begin(), used.end(), variables[i]) == used.end()) continue;
              const double at = unknowns[static_cast<size_t>(variables[i])];
              values[i] = Jet<double, 1>::variable(at);
              jacobian(0, variables[i]) = difference.evaluate<Jet<double, 1>>(values).c[1];
              values[i] = Jet<double, 1>(at);
            }
            f[0] = difference.evaluate<Jet<double, 1>>(values).c[0];
          }};
}

}  // namespace lekalo::geometry
