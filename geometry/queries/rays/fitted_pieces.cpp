// With the zeros x_j of T_8 as nodes the error of interpolation is f^(8)(y)/8! times T_8(x)/2^7: it is largest near the
// nine places cos(k pi/8) where |T_8| = 1, and shrinks with the eighth power of the interval (Trefethen 2013, ch. 4).
#include "geometry/queries/rays/fitted_pieces.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "geometry/grid_points.h"
#include "geometry/numerics/chebyshev.h"

namespace lekalo::geometry {

namespace {

constexpr int kNodes = 8;  // degree 7
constexpr int kMaxParts = 8;
// From so many on what is near enough is not cut for the sake of a tenth of that.
constexpr size_t kManyPatches = 1024, kMaxPatches = 16384;
// Parts of a smooth surface gain more. Parts that do not, twice in a row, are beside a place that is not smooth, or
// rounding is all that is left.
constexpr double kMinGain = 4;
constexpr int kMaxMisses = 2;
// What rounding leaves of a patch, in parts of kFitDistance.
constexpr double kRounding = 0.01;

using Values = std::array<std::array<Vec3, kNodes>, kNodes>;
using Matrix = std::array<std::array<double, kNodes>, kNodes>;

double node(int j) { return chebyshev_point(j, kNodes); }
double extremum(int k) { return std::cos(std::numbers::pi * k / kNodes); }

// Bernstein coefficients on [-1, 1] from values in the nodes.
const Matrix& bernstein_of_values() {
  static const Matrix matrix = [] {
    Eigen::Matrix<long double, kNodes, kNodes> at;
    for (int j = 0; j < kNodes; ++j) {
      const long double s = 0.5L * (1 + static_cast<long double>(node(j)));
      long double choose = 1;
      for (int k = 0; k < kNodes; ++k) {
        at(j, k) = choose * std::pow(s, k) * std::pow(1 - s, kNodes - 1 - k);
        choose = choose * (kNodes - 1 - k) / (k + 1);
      }
    }
    const Eigen::Matrix<long double, kNodes, kNodes> inverse = at.inverse();
    Matrix result;
    for (int i = 0; i < kNodes; ++i)
      for (int j = 0; j < kNodes; ++j) result[i][j] = static_cast<double>(inverse(i, j));
    return result;
  }();
  return matrix;
}

// Lagrange's polynomials of the nodes at x (barycentric form of the second kind; x is no node).
std::array<double, kNodes> lagrange_at(double x) {
  std::array<double, kNodes> result;
  double sum = 0;
  for (int j = 0; j < kNodes; ++j) {
    const double weight = (j % 2 == 0 ? 1 : -1) * std::sin(std::numbers::pi * (j + 0.5) / kNodes);
    result[j] = weight / (x - node(j));
    sum += result[j];
  }
  for (double& value : result) value /= sum;
  return result;
}

// What a part's fit is like, in the worse places along each parameter.
struct Fit {
  Rectangle box;
  double before_u = kInfinity, before_v = kInfinity;  // the distances of the part that it comes from
  int misses = 0;                                     // parts before this one that gained nothing
  double off_u = 0, off_v = 0;
  Values values;

  double u(double x) const { return box.u.middle() + 0.5 * box.u.width() * x; }
  double v(double y) const { return box.v.middle() + 0.5 * box.v.width() * y; }
  bool is_near(double tolerance) const { return off_u <= tolerance && off_v <= tolerance; }
  // Finer parts are no better.
  bool misses_again(double tolerance) const {
    const auto gains = [&](double off, double before) { return off <= tolerance || off * kMinGain <= before; };
    return !gains(off_u, before_u) || !gains(off_v, before_v);
  }
};

SurfacePiece patch_of(const Fit& fit) {
  const Matrix& matrix = bernstein_of_values();
  // About a point of the part, so that the matrix magnifies the rounding of its size only.
  const Vec3 middle = fit.values[kNodes / 2][kNodes / 2];
  SurfacePiece piece = plain_piece(fit.box);
  piece.degree_u = piece.degree_v = kNodes - 1;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j) {
      Vec3 sum(0);
      for (int k = 0; k < kNodes; ++k)
        for (int l = 0; l < kNodes; ++l) sum += matrix[i][k] * matrix[j][l] * (fit.values[k][l] - middle);
      piece.points.push_back(Vec4(middle + sum, 1));
    }
  return piece;
}

// Beyond `farthest` distances are not known to the end.
void fit(const Surface& surface, Fit& fit, double tolerance, double farthest) {
  const auto* of_grid = dynamic_cast<const GridPoints*>(&surface);
  // Points (x_i, y_j) at i * (number of y_j) + j.
  const auto points = [&](std::vector<double> x, std::vector<double> y) {
    for (double& one : x) one = fit.u(one);
    for (double& one : y) one = fit.v(one);
    if (of_grid) return of_grid->points_over_grid(std::move(x), std::move(y));
    std::vector<Vec3> all;
    for (const double u : x)
      for (const double v : y) all.push_back(surface.point(u, v));
    return all;
  };
  std::vector<double> nodes;
  for (int j = 0; j < kNodes; ++j) nodes.push_back(node(j));
  const std::vector<Vec3> values = points(nodes, nodes);
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j) fit.values[i][j] = values[i * kNodes + j];
  const auto off = [&](const Vec3& point, const Vec3& there) {
    const double distance = glm::length(point - there);
    return std::isfinite(distance) ? distance : kInfinity;
  };
  constexpr std::array<int, 3> kTriedNodes{0, 3, 7};
  const std::vector<double> tried{node(0), node(3), node(7)};
  for (const int k : {0, 3, 4, 8}) {
    const double x = extremum(k);
    const auto weights = lagrange_at(x);
    const std::vector<Vec3> at_u = points({x}, tried), at_v = points(tried, {x});
    for (size_t m = 0; m < tried.size(); ++m) {
      const int j = kTriedNodes[m];
      Vec3 along_u(0), along_v(0);
      for (int i = 0; i < kNodes; ++i) {
        along_u += weights[i] * fit.values[i][j];
        along_v += weights[i] * fit.values[j][i];
      }
      fit.off_u = std::max(fit.off_u, off(along_u, at_u[m]));
      fit.off_v = std::max(fit.off_v, off(along_v, at_v[m]));
    }
    if (fit.off_u > farthest && fit.off_v > farthest) return;
  }
  if (!fit.is_near(farthest)) return;
  std::vector<double> extrema;
  for (int k = 0; k <= kNodes; k += 2) extrema.push_back(extremum(k));
  const std::vector<Vec3> there = points(extrema, extrema);
  for (size_t k = 0; k < extrema.size(); ++k)
    for (size_t l = 0; l < extrema.size(); ++l) {
      const double x = extrema[k], y = extrema[l];
      const auto in_u = lagrange_at(x), in_v = lagrange_at(y);
      Vec3 sum(0);
      for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j) sum += in_u[i] * in_v[j] * fit.values[i][j];
      const double here = off(sum, there[k * extrema.size() + l]);
      if (here > 4 * tolerance) fit.off_u = std::max(fit.off_u, here), fit.off_v = std::max(fit.off_v, here);
    }
}

// In how many parts a distance comes below the tolerance, by the eighth power.
int parts(double off, double tolerance, int most) {
  if (off <= tolerance) return 1;
  return static_cast<int>(std::clamp(std::ceil(std::pow(2 * off / tolerance, 1.0 / kNodes)), 2.0, 1.0 * most));
}

void divide(const Fit& whole, double tolerance, std::vector<Fit>& result) {
  const int most = whole.misses > 0 ? 2 : kMaxParts;
  const int across_u = parts(whole.off_u, tolerance, most), across_v = parts(whole.off_v, tolerance, most);
  const auto part = [](const Interval& range, int k, int count) -> Interval {
    const auto at = [&](int i) { return i == count ? range.hi : range.lo + range.width() * i / count; };
    return {at(k), at(k + 1)};
  };
  for (int i = 0; i < across_u; ++i)
    for (int j = 0; j < across_v; ++j) {
      Fit one;
      one.box = {part(whole.box.u, i, across_u), part(whole.box.v, j, across_v)};
      one.misses = whole.misses;
      one.before_u = across_u > 1 ? whole.off_u : kInfinity;
      one.before_v = across_v > 1 ? whole.off_v : kInfinity;
      result.push_back(one);
    }
}

// From points, since boxes of composed surfaces are wide.
double size_of(const Surface& surface, const std::vector<Rectangle>& boxes) {
  constexpr int kTried = 4;
  Box3 all;
  const auto at = [](const Interval& range, int k) { return range.lo + range.width() * k / kTried; };
  for (const Rectangle& box : boxes)
    for (int i = 0; i <= kTried; ++i)
      for (int j = 0; j <= kTried; ++j) all.include(surface.point(at(box.u, i), at(box.v, j)));
  return all.diameter();
}

}  // namespace

FittedPieces fitted_pieces(const Surface& surface, const std::vector<Rectangle>& boxes) {
  FittedPieces result;
  const double farthest = kFitDistance * size_of(surface, boxes), tolerance = 0.1 * farthest;
  std::vector<Fit> open(boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i) open[i].box = boxes[i];
  const auto add = [&](const Fit& one) {
    result.patches.push_back(patch_of(one));
    result.distances.push_back(std::max({one.off_u, one.off_v, kRounding * farthest}));
  };
  while (!open.empty()) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, open.size()), [&](const tbb::blocked_range<size_t>& some) {
      for (size_t i = some.begin(); i < some.end(); ++i) fit(surface, open[i], tolerance, farthest);
    });
    std::vector<Fit> next;
    for (Fit& one : open) {
      if (one.is_near(tolerance)) {
        add(one);
        continue;
      }
      one.misses = one.misses_again(tolerance) ? one.misses + 1 : 0;
      const size_t count = result.patches.size() + next.size();
      if (one.is_near(farthest) && (one.misses > 0 || count > kManyPatches)) {
        add(one);
        continue;
      }
      if (one.misses > kMaxMisses || count > kMaxPatches)
        result.rest.push_back(one.box);
      else
        divide(one, tolerance, next);
    }
    open = std::move(next);
  }
  return result;
}

namespace {

struct Kept {
  std::mutex guard;
  int asking = 0;
  std::map<SurfacePtr, std::shared_ptr<const FittedPieces>> fits;
};
Kept& kept() {
  static Kept all;
  return all;
}

}  // namespace

std::shared_ptr<const FittedPieces> fitted_pieces(const SurfacePtr& surface) {
  Kept& all = kept();
  {
    const std::lock_guard lock(all.guard);
    if (const auto found = all.fits.find(surface); found != all.fits.end()) return found->second;
  }
  std::vector<Rectangle> boxes;
  for (const SurfacePiece& piece : surface->pieces()) boxes.push_back(piece.domain);
  auto fit = std::make_shared<const FittedPieces>(fitted_pieces(*surface, boxes));
  const std::lock_guard lock(all.guard);
  if (all.asking > 0) all.fits.emplace(surface, fit);
  return fit;
}

KeptFits::KeptFits() {
  const std::lock_guard lock(kept().guard);
  ++kept().asking;
}
KeptFits::~KeptFits() {
  const std::lock_guard lock(kept().guard);
  if (--kept().asking == 0) kept().fits.clear();
}

}  // namespace lekalo::geometry
