#include <fmt/format.h>

#include "geometry/contour.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "occt/occt_surfaces.h"
#include "queries/rows.h"
#include "timed.h"

namespace lekalo::benchmarks {

using namespace geometry;

namespace {

// What OCCT recommends; with less it comes no nearer to the surfaces, which kFinest is to show.
constexpr double kUsual = 1e-7, kFinest = 1e-10;
constexpr double kGap = 1e-4;  // ends of OCCT's pieces that are one
constexpr int kPlaces = 25;    // on each branch where the residual is measured

double size_of(const OcctPair& pair) {
  Box3 all = bounds(*pair.a.own);
  all.include(bounds(*pair.b.own));
  return all.diameter();
}

// The largest distance from both surfaces, of their size.
double residual(const OcctPair& pair, const Contours& found) {
  double most = 0;
  for (const Contour& branch : found.branches)
    for (int k = 0; k < kPlaces; ++k) {
      const Interval domain = branch.curve->domain();
      const double t = domain.lo + domain.width() * (k + 0.5) / kPlaces;
      const Vec3 p = branch.curve->point(t);
      for (int i = 0; i < 2; ++i) {
        const Vec3 uv = branch.images[i]->point(t);
        most = std::max(most, glm::length((i == 0 ? pair.a : pair.b).own->point(uv.x, uv.y) - p));
      }
    }
  return most / size_of(pair);
}
double residual(const OcctPair& pair, const OcctBranches& found) {
  double most = 0;
  for (const auto& piece : found.pieces)
    for (int k = 0; k < kPlaces; ++k) {
      const Vec3 p = occt_place(piece, (k + 0.5) / kPlaces);
      for (const OcctTwin* twin : {&pair.a, &pair.b}) {
        const SurfaceFootPoints foot_points = project(p, *twin->own);
        if (!foot_points.foot_points.empty()) most = std::max(most, foot_points.foot_points.front().distance);
      }
    }
  return most / size_of(pair);
}

size_t occt_lines(const OcctPair& pair) {
  try {
    const GeomAPI_IntSS found(pair.a.theirs, pair.b.theirs, kUsual);
    return found.IsDone() ? found.NbLines() : 0;
  } catch (const Standard_Failure&) {
    return 0;
  }
}

void race(const std::string& name, const std::vector<OcctPair>& pairs, int runs) {
  double ours = 0, theirs = 0, worst_ratio = 1e300, own_residual = 0, occt_residual = 0, min_residual = 0;
  size_t own_branches = 0, occt_found = 0, agree = 0;
  for (const OcctPair& pair : pairs) {
    Timed own_time, occt_time;
    for (int run = 0; run < runs; ++run) {
      occt_time.run([&] { return occt_lines(pair); });
      own_time.run([&] { return intersect(pair.a.own, pair.b.own).branches.size(); });
    }
    ours += own_time.least(), theirs += occt_time.least();
    worst_ratio = std::min(worst_ratio, occt_time.least() / own_time.least());
    const Contours own = intersect(pair.a.own, pair.b.own);
    const double gap = kGap * size_of(pair);
    const OcctBranches found = occt_branches(pair, kUsual, gap), least = occt_branches(pair, kFinest, gap);
    own_residual = std::max(own_residual, residual(pair, own));
    occt_residual = std::max(occt_residual, residual(pair, found));
    min_residual = std::max(min_residual, residual(pair, least));
    own_branches += own.branches.size(), occt_found += found.count();
    agree += found.count() == static_cast<int>(own.branches.size());
    fmt::print(stderr, "{:24} {:8.2f} ms, OCCT {:8.2f} ms; branches {} and {}\n", pair.name, 1e3 * own_time.least(),
               1e3 * occt_time.least(), own.branches.size(), found.count());
  }
  fmt::print(
      "{{\"name\": \"{}\", \"pairs\": {}, \"ours_ms\": {:.3f}, \"occt_ms\": {:.3f}, \"ratio\": {:.2f}, "
      "\"worst_ratio\": {:.2f}, \"residual\": {:.1e}, \"occt_residual\": {:.1e}, \"occt_least_residual\": {:.1e}, "
      "\"branches\": {}, \"occt_branches\": {}, \"agree\": {}}}\n",
      name, pairs.size(), 1e3 * ours / pairs.size(), 1e3 * theirs / pairs.size(), theirs / ours, worst_ratio,
      own_residual, occt_residual, min_residual, own_branches, occt_found, agree);
}

// Cut at n - 1 places in each direction: the same surface.
NurbsSurface cut(const NurbsSurface& surface, int n) {
  NurbsSurfaceForm form = surface.form();
  for (const bool of_u : {true, false}) {
    const int rows = form.count_u(), columns = form.count_v(), lines = of_u ? columns : rows;
    std::vector<NurbsCurveForm> cuts;
    for (int line = 0; line < lines; ++line) {
      NurbsCurveForm curve{of_u ? form.degree_u : form.degree_v, of_u ? form.knots_u : form.knots_v, {}, {}};
      for (int k = 0; k < (of_u ? rows : columns); ++k)
        curve.points.push_back(form.points[of_u ? k * columns + line : line * columns + k]);
      const Interval domain = curve.domain();
      for (int k = 1; k < n; ++k) curve = insert_knot(curve, domain.lo + domain.width() * k / n);
      cuts.push_back(std::move(curve));
    }
    (of_u ? form.knots_u : form.knots_v) = cuts.front().knots;
    const int count = static_cast<int>(cuts.front().points.size());
    form.points.clear();
    for (int i = 0; i < (of_u ? count : rows); ++i)
      for (int j = 0; j < (of_u ? columns : count); ++j)
        form.points.push_back(of_u ? cuts[j].points[i] : cuts[i].points[j]);
  }
  return NurbsSurface(form);
}

}  // namespace

void print_intersections(int runs) {
  race("random bicubic patches", sheet_pairs(1000, 4, 20), runs);
  race("random bicubic splines, 3 x 3 spans", sheet_pairs(2000, 6, 10), runs);
  const std::vector<OcctPair> analytic = analytic_pairs(31, 3);
  race("sphere, cylinder, cone, torus", analytic, runs);
  std::vector<OcctPair> splines;
  for (const OcctPair& pair : analytic)
    splines.push_back({pair.name + "_nurbs", spline_twin(pair.a), spline_twin(pair.b)});
  race("the same as NURBS", splines, runs);
}

void print_sizes(int runs) {
  const SplineAxis axis = bezier_axis(3);
  const NurbsSurface a = random_sheet(1000, axis, axis), b = random_sheet(1001, axis, axis);
  for (const int across : {1, 4, 16, 32}) {
    const auto own_a = std::make_shared<NurbsSurface>(cut(a, across)),
               own_b = std::make_shared<NurbsSurface>(cut(b, across));
    Timed time;
    for (int run = 0; run < runs; ++run) time.run([&] { return intersect(own_a, own_b).branches.size(); });
    fmt::print("{{\"pieces\": {}, \"ms\": {:.2f}, \"branches\": {}}}\n", across * across, 1e3 * time.least(),
               time.result());
  }
}

}  // namespace lekalo::benchmarks
