#include "geometry/queries/intersections/leaving_border.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

// Of the rounding of points: what is added to the distance of an end from a border; and an end that is farther from it
// does not lie on it.
constexpr double kRoundings = 4, kOffBorder = 100;

class BorderTest {
 public:
  BorderTest(const CurveCells::Cell& c, const CurveCells::End& end, const SurfaceCells::Cell& s, const Surface& surface)
      : end_(end), c_(c), s_(s), surface_(surface) {
    const Vec3 normal = glm::cross(s.corners[1] - s.corners[0] + s.corners[3] - s.corners[2],
                                   s.corners[2] - s.corners[0] + s.corners[3] - s.corners[1]);
    normal_ = normal / glm::length(normal);
  }

  bool leaves() const {
    if (!(across(s_.first_u, s_.first_v).lo > 0)) return false;
    const Rectangle domain = surface_.domain();
    for (const bool upper : {false, true}) {
      const double side = upper ? end_.way : -end_.way;
      const auto end_of = [&](const Interval& range) { return upper ? range.hi : range.lo; };
      if (end_of(s_.domain.v) == end_of(domain.v) &&
          leaves(side * across(s_.first_u, c_.first), s_.first_u, false, upper))
        return true;
      if (end_of(s_.domain.u) == end_of(domain.u) &&
          leaves(side * across(c_.first, s_.first_v), s_.first_v, true, upper))
        return true;
    }
    return false;
  }

 private:
  // D(a, b).
  Interval across(const VectorRange& a, const VectorRange& b) const {
    const Vec3 of_a = glm::cross(b.middle, normal_), of_b = glm::cross(normal_, a.middle);
    const Vec3 both{a.half.y * b.half.z + a.half.z * b.half.y, a.half.z * b.half.x + a.half.x * b.half.z,
                    a.half.x * b.half.y + a.half.y * b.half.x};
    const double most =
        glm::dot(glm::abs(of_a), a.half) + glm::dot(glm::abs(of_b), b.half) + glm::dot(glm::abs(normal_), both);
    const double middle = glm::dot(of_b, b.middle);
    return {middle - most, middle + most};
  }

  // `speed`: of the way out; `along`: of the border.
  bool leaves(const Interval& speed, const VectorRange& along, bool at_u, bool upper) const {
    if (!(speed.lo > 0)) return false;
    const double off = distance_from_border(at_u, upper);
    return speed.lo * end_.left_out > along.largest * (off + kRoundings * rounding());
  }

  double rounding() const { return c_.rounding + s_.rounding; }

  // Infinite where no place of the border within the cell is found.
  double distance_from_border(bool at_u, bool upper) const {
    constexpr int kSteps = 8;
    const Interval range = at_u ? s_.domain.v : s_.domain.u;
    const double border = at_u ? (upper ? s_.domain.u.hi : s_.domain.u.lo) : (upper ? s_.domain.v.hi : s_.domain.v.lo);
    const int first = upper ? (at_u ? 1 : 2) : 0;
    const Vec3 chord = s_.corners[first + (at_u ? 2 : 1)] - s_.corners[first], off = end_.point - s_.corners[first];
    const double square = glm::dot(chord, chord), x = glm::dot(off, chord) / square;
    if (!(glm::length(off - x * chord) <= s_.bulge + kOffBorder * rounding())) return kInfinity;
    double t = range.clamp(range.lo + x * range.width()), least = kInfinity;
    for (int step = 0; step < kSteps; ++step) {
      const SurfaceJet s = surface_.evaluate(at_u ? border : t, at_u ? t : border, 1);
      const Vec3 to = end_.point - s.point(), derivative = at_u ? s.dv() : s.du();
      const double distance = glm::length(to);
      // It comes nearer by halves and more, or no more.
      if (!(distance < 0.5 * least)) return std::min(distance, least);
      least = distance;
      t = range.clamp(t + glm::dot(to, derivative) / glm::dot(derivative, derivative));
    }
    return least;
  }

  const CurveCells::End& end_;
  const CurveCells::Cell& c_;
  const SurfaceCells::Cell& s_;
  const Surface& surface_;
  Vec3 normal_{0};
};

}  // namespace

bool leaves_border(const CurveCells::Cell& curve, const CurveCells::End& end, const SurfaceCells::Cell& cell,
                   const Surface& surface) {
  return cell.box.contains(end.point) && BorderTest(curve, end, cell, surface).leaves();
}

}  // namespace lekalo::geometry
