#include "geometry/bodies/topology/blank_box.h"

#include <cmath>
#include <vector>

#include "geometry/bodies/topology/landmarks.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 30;  // angles over a right angle
constexpr double kAngle = 1e-9;
constexpr double kEqual = 1e-9;  // of an area: these are one

// What the thing takes of the directions across the axis.
class Widths {
 public:
  Widths(const Distant& of, const Box3& box, const Vec3& axis)
      : of_(of), box_(box), about_(frame_about(Vec3(0), axis)) {}

  Vec3 direction(double angle) const { return std::cos(angle) * about_.x + std::sin(angle) * about_.y; }
  Interval along(const Vec3& way) const {
    return {glm::dot(way, extreme_point(of_, box_, -way)), glm::dot(way, extreme_point(of_, box_, way))};
  }
  double area(double angle) const {
    return along(direction(angle)).width() * along(direction(angle + 0.5 * kPi)).width();
  }
  const Frame& about() const { return about_; }

 private:
  const Distant& of_;
  const Box3& box_;
  Frame about_;
};

// The least area between two angles beside a lower one, by golden sections.
double min_between(const Widths& widths, double lo, double hi) {
  const double share = 0.5 * (3 - std::sqrt(5.0));
  double a = lo + share * (hi - lo), b = hi - share * (hi - lo), at_a = widths.area(a), at_b = widths.area(b);
  while (hi - lo > kAngle)
    if (at_a <= at_b) {
      hi = b, b = a, at_b = at_a;
      a = lo + share * (hi - lo), at_a = widths.area(a);
    } else {
      lo = a, a = b, at_a = at_b;
      b = hi - share * (hi - lo), at_b = widths.area(b);
    }
  return at_a <= at_b ? a : b;
}

}  // namespace

BlankBox blank_box(const Distant& of, const Box3& box, const Vec3& axis) {
  const Widths widths(of, box, axis);
  const double step = 0.5 * kPi / kTried;
  std::vector<double> areas;
  for (int k = 0; k < kTried; ++k) areas.push_back(widths.area(k * step));
  double angle = 0, least = kInfinity;
  const auto take = [&](double tried, double area) {
    if (area < least) least = area, angle = tried;
  };
  for (int k = 0; k < kTried; ++k) {
    take(k * step, areas[k]);
    // A right angle on, the sides change places.
    const double before = areas[(k + kTried - 1) % kTried], behind = areas[(k + 1) % kTried];
    // Of what is round all are equal but for rounding, and there is nothing to look for.
    if (areas[k] > std::min(before, behind) || areas[k] > (1 - kEqual) * std::max(before, behind)) continue;
    const double found = min_between(widths, (k - 1) * step, (k + 1) * step);
    take(found, widths.area(found));
  }
  angle -= 0.5 * kPi * std::floor(angle / (0.5 * kPi));
  const Vec3 x = widths.direction(angle), z = widths.about().z, y = glm::cross(z, x);
  const Interval along_x = widths.along(x), along_y = widths.along(y), along_z = widths.along(z);
  return {{along_x.lo * x + along_y.lo * y + along_z.lo * z, x, y, z},
          {along_x.width(), along_y.width(), along_z.width()},
          angle};
}

}  // namespace lekalo::geometry
