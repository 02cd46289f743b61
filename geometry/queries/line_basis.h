// A line with what its pieces ask of it: the unit vectors across, computed once for a line.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/vectors.h"

namespace lekalo::geometry {

struct LineBasis {
  Line line;
  Vec3 n1{0}, n2{0};           // unit vectors across the line
  double inverse_length2 = 1;  // 1 / |direction|^2

  explicit LineBasis(const Line& l) : line(l) {
    const double length2 = glm::dot(l.direction, l.direction);
    inverse_length2 = 1 / length2;
    const Vec3 d = l.direction / std::sqrt(length2);
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
    const double sign = std::copysign(1.0, d.z);
    const double a = -1 / (sign + d.z), b = d.x * d.y * a;
    n1 = {1 + sign * d.x * d.x * a, sign * b, -sign * d.x};
    n2 = {b, sign + d.y * d.y * a, -d.y};
  }
};

// A line on its way through many pieces. Closed forms need the line alone; the first piece that needs the vectors
// across makes them for all (not to be shared between threads). The line must live as long.
class PreparedLine {
 public:
  explicit PreparedLine(const Line& line) : line_(line) {}
  explicit PreparedLine(Line&&) = delete;
  const Line& line() const { return line_; }

  // The same line measured from its point nearest to `center` (whose parameter goes to `foot`), in coordinates relative
  // to `center`: what follows rounds at the size of things there.
  LineBasis near(const Vec3& center, double& foot) const {
    if (!basis_) basis_.emplace(line_);
    foot = glm::dot(center - line_.origin, line_.direction) * basis_->inverse_length2;
    LineBasis result = *basis_;
    result.line.origin = line_.at(foot) - center;
    return result;
  }

 private:
  const Line& line_;
  mutable std::optional<LineBasis> basis_;
};

}  // namespace lekalo::geometry
