#include "geometry/queries/shape_measures.h"

#include <cmath>
#include <random>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

constexpr int kShifts = 16;
constexpr int kLines = 1 << 13;  // of one shift

// Mean of several estimates, and the standard deviation of that mean.
template <class T>
class Estimates {
 public:
  void add(const T& x) {
    ++count_;
    sum_ += x;
    squares_ += x * x;
  }
  T mean() const { return sum_ / static_cast<double>(count_); }
  T deviation() const {
    const T m = mean(), variance = squares_ / static_cast<double>(count_) - m * m;
    if constexpr (std::is_same_v<T, double>)
      return std::sqrt(std::max(variance, 0.0) / (count_ - 1));
    else
      return glm::sqrt(glm::max(variance, T(0)) / static_cast<double>(count_ - 1));
  }

 private:
  int count_ = 0;
  T sum_{0}, squares_{0};
};

// Point k of the lattice of the generalised golden ratio g (g^(D+1) = g + 1), shifted and wrapped into the unit cube
// (Roberts 2018).
template <int D>
std::array<double, D> lattice_point(int k, const std::array<double, D>& shift) {
  static const double g = [] {
    double x = 2;
    for (int i = 0; i < 60; ++i) x = std::pow(1 + x, 1.0 / (D + 1));
    return x;
  }();
  std::array<double, D> point;
  double power = 1;
  for (int d = 0; d < D; ++d) {
    power /= g;
    const double x = shift[d] + k * power;
    point[d] = x - std::floor(x);
  }
  return point;
}

// Length of the line (unit direction) inside, and the integral of the place along it.
struct Chords {
  double length = 0;
  Vec3 moment{0};
};
Chords chords(const Line& line, const std::vector<SurfaceHit>& hits) {
  Chords sum;
  for (size_t i = 0; i + 1 < hits.size(); i += 2) {
    const double length = hits[i + 1].t - hits[i].t;
    sum.length += length;
    sum.moment += length * line.at(0.5 * (hits[i].t + hits[i + 1].t));
  }
  return sum;
}

}  // namespace

ShapeMeasures measure(const Shape& shape) {
  if (!shape.is_closed()) throw std::invalid_argument("the shape is not closed: it has no volume");
  const Box3 box = shape.bounds();
  if (!box.bounded() || box.empty()) throw std::invalid_argument("the shape is not bounded: it has no volume");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<SurfaceHit> hits;
  const auto cross = [&](const Line& line) {
    hits.clear();
    shape.all_hits(line, Interval::entire(), hits);
  };
  // Coordinates about the box's centre: moments then round at its size.
  const Vec3 center = box.center(), half = 0.5 * box.size();

  Estimates<double> volume;
  Estimates<Vec3> moment;
  for (int shift = 0; shift < kShifts; ++shift) {
    const int z = shift % 3, x = (z + 1) % 3, y = (z + 2) % 3;
    const std::array<double, 2> shifts{unit(random), unit(random)};
    Line line;
    line.direction = Vec3(0);
    line.direction[z] = 1;
    double length = 0;
    Vec3 sum(0);
    for (int k = 0; k < kLines; ++k) {
      const auto p = lattice_point<2>(k, shifts);
      line.origin = center;
      line.origin[x] += half[x] * (2 * p[0] - 1);
      line.origin[y] += half[y] * (2 * p[1] - 1);
      cross(line);
      const Chords found = chords(line, hits);
      length += found.length;
      sum += found.moment - found.length * center;
    }
    const double share = 4 * half[x] * half[y] / kLines;
    volume.add(share * length);
    moment.add(share * sum);
  }

  Estimates<double> area;
  const double radius = glm::length(half);
  for (int shift = 0; shift < kShifts; ++shift) {
    const std::array<double, 4> shifts{unit(random), unit(random), unit(random), unit(random)};
    double crossings = 0;
    for (int k = 0; k < kLines; ++k) {
      const auto p = lattice_point<4>(k, shifts);
      const double z = 2 * p[0] - 1, across = std::sqrt(1 - z * z);
      const Frame frame =
          frame_about(center, Vec3(across * std::cos(kTwoPi * p[1]), across * std::sin(kTwoPi * p[1]), z));
      const double r = radius * std::sqrt(p[2]);
      cross({frame.origin + r * std::cos(kTwoPi * p[3]) * frame.x + r * std::sin(kTwoPi * p[3]) * frame.y, frame.z});
      crossings += static_cast<double>(hits.size());
    }
    area.add(kTwoPi * radius * radius * crossings / kLines);
  }

  ShapeMeasures result;
  result.area = {area.mean(), 3 * area.deviation()};
  result.volume = {volume.mean(), 3 * volume.deviation()};
  if (!(result.volume.value > 0)) throw std::invalid_argument("nothing is left of the shape: it has no volume");
  result.centroid = center + moment.mean() / result.volume.value;
  result.centroid_error =
      (3 * glm::length(moment.deviation()) + glm::length(result.centroid - center) * result.volume.error) /
      result.volume.value;
  return result;
}

}  // namespace lekalo::geometry
