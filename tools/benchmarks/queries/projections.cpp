#include <fmt/format.h>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>

#include "geometry/queries/closest/closest_point.h"
#include "occt/occt_shapes.h"
#include "queries/rows.h"
#include "timed.h"

namespace lekalo::benchmarks {

using namespace geometry;

namespace {

constexpr double kSame = 1e-6;  // foot points of the two that are one

// Foot points of both, and how many of each the other has too.
struct Counts {
  size_t ours = 0, theirs = 0, of_ours = 0, of_theirs = 0;

  void add(const std::vector<Vec3>& own, const std::vector<Vec3>& other) {
    ours += own.size(), theirs += other.size();
    of_ours += common(own, other), of_theirs += common(other, own);
  }

 private:
  static size_t common(const std::vector<Vec3>& all, const std::vector<Vec3>& in) {
    return std::count_if(all.begin(), all.end(), [&](const Vec3& p) {
      return std::any_of(in.begin(), in.end(), [&](const Vec3& q) { return glm::length(p - q) <= kSame; });
    });
  }
};

std::vector<Vec3> points_about(unsigned seed, int count) {
  RandomNet net(seed);
  std::vector<Vec3> points = net.points(count);
  for (Vec3& p : points) p = 1.6 * p - 0.3;
  return points;
}

// Where the distance is stationary: OCCT knows no others.
template <class FootPoints>
std::vector<Vec3> stationary(const FootPoints& found) {
  std::vector<Vec3> points;
  for (const auto& foot_point : found.foot_points)
    if (foot_point.kind != FootPointKind::border) points.push_back(foot_point.point);
  return points;
}

// OCCT's object is made once and asked for each point with Perform.
template <class Occt>
std::vector<Vec3> foot_points_of(Occt& occt, const Vec3& p) {
  occt.Perform(occt_point(p));
  std::vector<Vec3> points;
  for (int i = 1; i <= occt.NbPoints(); ++i) points.push_back(from_occt(occt.Point(i).XYZ()));
  return points;
}

template <class Projector, class Occt>
void race(int runs, const std::vector<Vec3>& points, const Projector& own, Occt& occt, Timed& ours, Timed& theirs,
          Counts& counts) {
  for (int run = 0; run < runs; ++run) {
    theirs.run([&] {
      size_t count = 0;
      for (const Vec3& p : points) {
        occt.Perform(occt_point(p));
        count += occt.NbPoints();
      }
      return count;
    });
    ours.run([&] {
      size_t count = 0;
      for (const Vec3& p : points) count += own.foot_points(p).foot_points.size();
      return count;
    });
  }
  for (const Vec3& p : points) counts.add(stationary(own.foot_points(p)), foot_points_of(occt, p));
}

void print(const std::string& name, size_t points, double ours, double theirs, const Counts& counts) {
  fmt::print(
      "{{\"name\": \"{}\", \"points\": {}, \"ours_us\": {:.2f}, \"occt_us\": {:.2f}, \"ratio\": {:.2f}, "
      "\"feet\": {}, \"occt_feet\": {}, \"feet_occt_has\": {}, \"occt_feet_we_have\": {}}}\n",
      name, points, 1e6 * ours / points, 1e6 * theirs / points, theirs / ours, counts.ours, counts.theirs,
      counts.of_ours, counts.of_theirs);
}

}  // namespace

void print_projections(int runs) {
  constexpr int kShapes = 5, kCurvePoints = 100, kSurfacePoints = 20;
  for (int degree = 2; degree <= 5; ++degree) {
    double ours = 0, theirs = 0;
    Counts counts;
    for (int k = 0; k < kShapes; ++k) {
      RandomNet net(100 * degree + k);
      const int count = degree + 6;
      const auto curve =
          std::make_shared<NurbsCurve>(clamped_axis(degree, count), net.points(count), net.weights(count));
      const Handle(Geom_BSplineCurve) spline = occt_spline(*curve);
      GeomAPI_ProjectPointOnCurve occt;
      occt.Init(spline, spline->FirstParameter(), spline->LastParameter());
      Timed own_time, occt_time;
      race(runs, points_about(7 + k, kCurvePoints), CurveProjector(curve), occt, own_time, occt_time, counts);
      ours += own_time.least(), theirs += occt_time.least();
    }
    print(fmt::format("curve, degree {}", degree), kShapes * kCurvePoints, ours, theirs, counts);
  }
  for (const int points : {4, 6}) {
    double ours = 0, theirs = 0;
    Counts counts;
    for (int k = 0; k < kShapes; ++k) {
      const SplineAxis axis = points == 4 ? bezier_axis(3) : clamped_axis(3, points);
      const auto sheet = std::make_shared<NurbsSurface>(random_sheet(500 + k, axis, axis));
      const Handle(Geom_BSplineSurface) spline = occt_spline(*sheet);
      double u0, u1, v0, v1;
      spline->Bounds(u0, u1, v0, v1);
      GeomAPI_ProjectPointOnSurf occt;
      occt.Init(spline, u0, u1, v0, v1);
      Timed own_time, occt_time;
      race(runs, points_about(7 + k, kSurfacePoints), SurfaceProjector(sheet), occt, own_time, occt_time, counts);
      ours += own_time.least(), theirs += occt_time.least();
    }
    print(fmt::format("bicubic surface, {0} x {0} spans", points - 3), kShapes * kSurfacePoints, ours, theirs, counts);
  }
}

}  // namespace lekalo::benchmarks
