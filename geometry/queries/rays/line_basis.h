// A line with what its pieces ask of it: the unit vectors across, computed once for a line.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/numerics/lanes.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

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
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
    const double sign = std::copysign(1.0, d.z);
    const double a = -1 / (sign + d.z), b = d.x * d.y * a;
    n1 = {1 + sign * d.x * d.x * a, sign * b, -sign * d.x};
    n2 = {b, sign + d.y * d.y * a, -d.y};
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
    // origin - center and its rounding error (Knuth, TAOCP 2, 4.2.2). With `foot point` a float, its products with a
    // float and with what is left of the direction are exact; the first nearly takes the difference away.
    const Vec3 &o = line_.origin, from = o - center, taken = o - from;
    const Vec3 error = (o - (from + taken)) + (taken - center);
    foot_point = foot_point_ = static_cast<float>(-glm::dot(from, line_.direction) * basis_->inverse_length2);
    basis_->line.origin = (from + foot_point * upper_) + (foot_point * lower_ + error);
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
