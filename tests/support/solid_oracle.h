// The oracle of solids made of balls, boxes and half-spaces: it only knows which points lie in them.
//
// Along a line a solid begins or ends where the answers at the middles of neighbouring stretches between the roots of
// its parts differ. All in long double; it shares nothing with the product's solvers.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::oracle {

struct Solid {
  using Real = long double;
  using Vec3 = geometry::Vec3;

  enum class Kind { ball, box, half_space, unite, intersect, subtract } kind;
  Vec3 a{0}, b{0};  // ball: centre; box: corners; half-space: a point of the plane and its normal, which looks outward
  double radius = 0;  // of a ball
  std::vector<Solid> operands;

  static Solid ball(const Vec3& center, double radius) { return {Kind::ball, center, Vec3(0), radius, {}}; }
  static Solid box(const Vec3& lo, const Vec3& hi) { return {Kind::box, lo, hi, 0, {}}; }
  static Solid half_space(const Vec3& through, const Vec3& normal) {
    return {Kind::half_space, through, normal, 0, {}};
  }
  static Solid of(Kind kind, std::vector<Solid> operands) { return {kind, Vec3(0), Vec3(0), 0, std::move(operands)}; }

  bool holds(Real x, Real y, Real z) const {
    const auto has = [&](const Solid& one) { return one.holds(x, y, z); };
    switch (kind) {
      case Kind::ball: {
        const Real dx = x - a.x, dy = y - a.y, dz = z - a.z;
        return dx * dx + dy * dy + dz * dz < Real(radius) * radius;
      }
      case Kind::box:
        return x > a.x && x < b.x && y > a.y && y < b.y && z > a.z && z < b.z;
      case Kind::half_space:
        return (x - a.x) * b.x + (y - a.y) * b.y + (z - a.z) * b.z < 0;
      case Kind::unite:
        return std::any_of(operands.begin(), operands.end(), has);
      case Kind::intersect:
        return std::all_of(operands.begin(), operands.end(), has);
      case Kind::subtract:
        return has(operands[0]) && std::none_of(operands.begin() + 1, operands.end(), has);
    }
    return false;
  }

  // Where the line meets the borders of the parts.
  void roots(const geometry::Line& line, std::vector<Real>& t) const {
    const Vec3 &o = line.origin, &d = line.direction;
    if (kind == Kind::ball) {
      const Real ox = o.x - Real(a.x), oy = o.y - Real(a.y), oz = o.z - Real(a.z);
      const Real dd = Real(d.x) * d.x + Real(d.y) * d.y + Real(d.z) * d.z;
      const Real h = (ox * d.x + oy * d.y + oz * d.z) / dd;
      const Real px = ox - h * d.x, py = oy - h * d.y, pz = oz - h * d.z;
      const Real rest = (Real(radius) * radius - (px * px + py * py + pz * pz)) / dd;
      if (rest > 0) t.insert(t.end(), {-h - std::sqrt(rest), -h + std::sqrt(rest)});
    } else if (kind == Kind::box) {
      for (int k = 0; k < 3; ++k)
        if (d[k] != 0) t.insert(t.end(), {(Real(a[k]) - o[k]) / d[k], (Real(b[k]) - o[k]) / d[k]});
    } else if (kind == Kind::half_space) {
      const Real slope = Real(d.x) * b.x + Real(d.y) * b.y + Real(d.z) * b.z;
      if (slope != 0)
        t.push_back(((a.x - Real(o.x)) * b.x + (a.y - Real(o.y)) * b.y + (a.z - Real(o.z)) * b.z) / slope);
    }
    for (const Solid& one : operands) one.roots(line, t);
  }

  // Where the line enters and leaves the solid, by turns. `close` is set where two roots of parts are nearer than the
  // distance.
  std::vector<double> crossings(const geometry::Line& line, double distance, bool& close) const {
    std::vector<Real> all;
    roots(line, all);
    std::sort(all.begin(), all.end());
    const auto holds_at = [&](Real t) {
      return holds(line.origin.x + t * line.direction.x, line.origin.y + t * line.direction.y,
                   line.origin.z + t * line.direction.z);
    };
    const Real length = glm::length(line.direction);
    std::vector<double> result;
    for (size_t r = 0; r < all.size(); ++r) {
      if (r > 0 && (all[r] - all[r - 1]) * length < distance) close = true;
      const Real before = r == 0 ? all[r] - 1 : (all[r - 1] + all[r]) / 2;
      const Real after = r + 1 == all.size() ? all[r] + 1 : (all[r] + all[r + 1]) / 2;
      if (holds_at(before) != holds_at(after)) result.push_back(static_cast<double>(all[r]));
    }
    return result;
  }
};

}  // namespace lekalo::oracle
