// A line with what its pieces ask of it: the unit vectors across, computed once for a line.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/numerics/lanes.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// Unit vectors across a unit direction (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
inline void vectors_across(const double (&d)[3], double (&n1)[3], double (&n2)[3]) {
  const double sign = std::copysign(1.0, d[2]);
  const double a = -1 / (sign + d[2]), b = d[0] * d[1] * a;
  n1[0] = 1 + sign * d[0] * d[0] * a, n1[1] = sign * b, n1[2] = -sign * d[0];
  n2[0] = b, n2[1] = sign + d[1] * d[1] * a, n2[2] = -d[1];
}

// Where the line passes `center`, but for 1e-7 of the way there, in coordinates relative to `center`; `upper` is the
// direction in floats, `lower` the rest. Origin - center is taken with its rounding error (Knuth, TAOCP 2, 4.2.2). With
// the foot point's parameter, which is returned, a float, its products with a float and with what is left of the
// direction are exact; the first nearly takes the difference away.
inline double move_near(const double (&origin)[3], const double (&direction)[3], const double (&upper)[3],
                        const double (&lower)[3], double inverse_length2, const Vec3& center, double (&near)[3]) {
  double from[3], error[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = origin[k] - center[k];
    const double taken = origin[k] - from[k];
    error[k] = (origin[k] - (from[k] + taken)) + (taken - center[k]);
  }
  const double along = from[0] * direction[0] + from[1] * direction[1] + from[2] * direction[2];
  const double foot_point = static_cast<float>(-along * inverse_length2);
  for (int k = 0; k < 3; ++k) near[k] = (from[k] + foot_point * upper[k]) + (foot_point * lower[k] + error[k]);
  return foot_point;
}

struct LineBasis {
  Line line;
  Vec3 n1{0}, n2{0};           // unit vectors across the line
  double inverse_length2 = 1;  // 1 / |direction|^2
  double inverse_length = 1;
  Lanes axes[3];  // (n1, n2, direction / length) as columns; the fourth lane is 0

  explicit LineBasis(const Line& l) : line(l) {
    const double length2 = glm::dot(l.direction, l.direction);
    inverse_length2 = 1 / length2;
    inverse_length = 1 / std::sqrt(length2);
    const Vec3 d = inverse_length * l.direction;
    double across[2][3];
    vectors_across({d.x, d.y, d.z}, across[0], across[1]);
    n1 = {across[0][0], across[0][1], across[0][2]};
    n2 = {across[1][0], across[1][1], across[1][2]};
    for (int k = 0; k < 3; ++k) axes[k] = Lanes{n1[k], n2[k], d[k], 0};
  }
};

// A line on its way through many pieces. Closed forms need the line alone; the first piece that needs the vectors
// across makes them for all (not to be shared between threads). The line must live as long.
class PreparedLine {
 public:
  explicit PreparedLine(const Line& line) : line_(line) {}
  explicit PreparedLine(Line&&) = delete;
  const Line& line() const { return line_; }

  // The same line measured from its point nearest to `center` (whose parameter goes to `foot point`) but for 1e-7 of
  // the way there, in coordinates relative to `center`: all rounds at the size of things there, however far the line
  // begins, so that neighbouring pieces see the same line. Holds until the next call.
  const LineBasis& near(const Vec3& center, double& foot_point) const {
    if (basis_ && center == center_) {
      foot_point = foot_point_;
      return *basis_;
    }
    if (!basis_) {
      basis_.emplace(line_);
      for (int k = 0; k < 3; ++k) upper_[k] = static_cast<float>(line_.direction[k]);
      lower_ = line_.direction - upper_;
    }
    const Vec3 &o = line_.origin, &d = line_.direction;
    double near[3];
    foot_point = foot_point_ = move_near({o.x, o.y, o.z}, {d.x, d.y, d.z}, {upper_.x, upper_.y, upper_.z},
                                         {lower_.x, lower_.y, lower_.z}, basis_->inverse_length2, center, near);
    basis_->line.origin = {near[0], near[1], near[2]};
    center_ = center;
    return *basis_;
  }

 private:
  const Line& line_;
  mutable std::optional<LineBasis> basis_;
  mutable Vec3 upper_{0}, lower_{0};  // the direction in floats, and the rest
  mutable Vec3 center_{0};            // of the last call, often the next one's too: neighbours are asked together
  mutable double foot_point_ = 0;
};

}  // namespace lekalo::geometry
