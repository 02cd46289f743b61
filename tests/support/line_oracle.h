// The ray oracle: all intersections of a line with a rational Bezier patch, found by halving alone.
//
// It shares nothing with the product's solver. The two plane equations of the line are put in Bernstein form over the
// patch; a rectangle is discarded only if all coefficients of one of them, or of a sum of multiples of the two, have
// one strict sign beyond the rounding of the arithmetic; rectangles narrower than 1e-11 that remain are gathered into
// clusters, and each cluster is a root. No Newton iteration, no derivative. Patch and line are first moved near the
// origin in long double, so that a scene far away loses no digits here.
#pragma once

#include <array>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::oracle {

using geometry::Line;
using geometry::Vec2;
using geometry::Vec3;
using geometry::Vec4;

struct Root {
  double t, s_u, s_v;  // along the line; parameters of the patch in [0, 1]
};

class PatchOracle {
 public:
  // Control point (i, j) at points[i * (degree_v + 1) + j].
  PatchOracle(std::vector<Vec4> points, int degree_u, int degree_v);

  // In order of t. `undecided` tells that there were more rectangles than room (none is gathered then): the line runs
  // along the patch, or through a collapsed edge; or that a root is no place but a stretch of the line, which lies in
  // the patch there.
  std::vector<Root> roots(const Line& given, bool* undecided = nullptr) const;

  // Point of the patch by de Casteljau's algorithm.
  Vec3 point(double u, double v) const { return local_point(u, v) + center_; }

 private:
  static constexpr size_t kMaxPoints = 64;
  using Net = std::array<Vec2, kMaxPoints>;  // of both plane equations: two coefficients a point
  struct Cell {
    double u, v;    // the middle
    double hu, hv;  // half widths
  };
  struct Search {
    double slack;  // bound on the rounding of a coefficient
    std::vector<Cell> cells;
    bool full;
  };

  Vec3 local_point(double u, double v) const;
  // Largest step of the two coefficients between neighbours in one direction, times the number of steps.
  double extent(const Net& net, bool along_u) const;

  void split(const Net& net, bool along_u, Net& a, Net& b) const;

  // True if the hull of the coefficients (f, g), points of a plane, does not hold the origin: seen along either axis,
  // or along either side of the rectangle's image, which may be a sliver.
  bool excludes_line(const Net& net, double slack) const;

  void halve(const Net& net, double u, double v, double hu, double hv, Search& search) const;

  std::vector<Root> cluster(std::vector<Cell> cells, const Line& line, bool& runs_along) const;

  std::vector<Vec4> points_;  // about center_
  int p_, q_;
  Vec3 center_{0};
  double radius_ = 0;  // of a ball about center_ around the convex hull; infinite where there is none
};

}  // namespace lekalo::oracle
