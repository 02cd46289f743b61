// Derivatives at points of a curve that is known by its points alone (Golovanov 2016, 2.3; Zavyalov et al. 1985, I.2,
// II.5; Akima 1970; Fritsch, Carlson 1980).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Points at increasing parameters; those of a closed curve repeat after the period, and may be asked for by any number.
struct PointSequence {
  std::span<const Vec3> points;
  std::span<const double> parameters;  // one for each point; one more when closed
  bool closed = false;

  int size() const { return static_cast<int>(points.size()); }
  const Vec3& point(int i) const { return points[turn(i).second]; }
  double parameter(int i) const;
  Vec3 chord(int i) const { return point(i + 1) - point(i); }  // from point i to point i + 1
  double step(int i) const { return parameter(i + 1) - parameter(i); }
  Vec3 slope(int i) const { return chord(i) / step(i); }

 private:
  std::pair<int, int> turn(int i) const;  // how often around, and the number of the point
};

// The estimates that estimated_tangents knows:
//   two_point, three_point, four_point, five_point
//                derivative of the polynomial through so many neighbours; at ends of open curves through the first ones
//   bessel       three_point; at the ends of open curves r'' = 0 (Golovanov 2016, 2.3)
//   secant       (p_{i+1} - p_{i-1}) / (t_{i+1} - t_{i-1}), at ends two_point (Catmull, Rom 1974)
//   akima        a mean of the slopes beside that favours the one like its neighbour, each coordinate by itself
//   monotone     each coordinate is monotone where its data are
//   circle       direction of the circle through three neighbours (Zavyalov et al. 1985, 124)
//   five_point_circle   of five neighbours (the same, 125); both with lengths by local_speeds
std::vector<std::string> tangent_estimates();
std::vector<Vec3> estimated_tangents(const std::string& estimate, const PointSequence& data);

// Lengths of derivatives with these unit directions.
// local: of the parabola through the arc lengths of three neighbours, chords taken for arcs (the same, 123).
std::vector<double> local_speeds(const PointSequence& data);
// Those of the smallest integral of r''^2 over the composite Hermite cubic (the same, II.5). They may be negative where
// a direction turns away from the chords.
std::vector<double> min_energy_speeds(const PointSequence& data, std::span<const Vec3> directions);

}  // namespace lekalo::geometry
