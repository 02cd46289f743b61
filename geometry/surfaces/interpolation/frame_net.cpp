#include "geometry/surfaces/interpolation/frame_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-9;    // of the size: points that are one
constexpr double kSteep = 1e-6;   // of the size: points of one place at one height
constexpr double kInside = 1e-9;  // of the range
constexpr int kAlong = 16;        // points of a line that lies in a section

// Over these places that follow one another, by the degree that so many points allow.
CurvePtr through(const std::vector<Vec3>& points, const std::vector<double>& places) {
  const int degree = std::min<int>(3, static_cast<int>(points.size()) - 1);
  return std::make_shared<NurbsCurve>(spline_curve(points, places, degree, {}, {}));
}

}  // namespace

FrameNet::FrameNet(std::vector<CurvePtr> frame, const Frame& base) : frame_(std::move(frame)), base_(base) {
  Box3 box;
  for (const CurvePtr& line : frame_) {
    const Interval t = line->domain();
    if (!(t.width() < kInfinity)) throw FieldError("of", "a line of the frame is unbounded", "give it a domain");
    constexpr int kLooked = 64;
    for (int k = 0; k <= kLooked; ++k) box.include(base_.to_local_point(line->point(t.lo + t.width() * k / kLooked)));
  }
  range_ = {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}};
  size_ = std::max(box.diameter(), 1e-300);
}

CurvePtr FrameNet::section(bool along_y, double at) const {
  const Vec3& across = along_y ? base_.x : base_.y;
  const Plane plane(frame_from(base_.origin + at * across, across, base_.z));
  std::vector<Vec3> found;  // local
  for (const CurvePtr& line : frame_) {
    const SurfaceIntersections met = intersect(*line, plane);
    for (const SurfaceIntersection& one : met.points) found.push_back(base_.to_local_point(one.point));
    for (const Interval& part : met.on_surface)
      for (int k = 0; k <= kAlong; ++k)
        found.push_back(base_.to_local_point(line->point(part.lo + part.width() * k / kAlong)));
  }
  const auto place = [&](const Vec3& p) { return along_y ? p.y : p.x; };
  std::sort(found.begin(), found.end(), [&](const Vec3& a, const Vec3& b) { return place(a) < place(b); });
  std::vector<Vec3> points;
  std::vector<double> places;
  for (const Vec3& p : found) {
    if (!places.empty() && place(p) - places.back() <= kSame * size_) {
      const double apart = std::abs(p.z - base_.to_local_point(points.back()).z);
      if (apart > kSteep * size_)
        throw FieldError("frame",
                         fmt::format("at x = {:.6g}, y = {:.6g} two lines of the frame are {:.3g} above each other",
                                     p.x, p.y, apart),
                         "take a frame onto whose x, y the surface projects one to one");
      continue;
    }
    places.push_back(place(p));
    points.push_back(base_.point(p));
  }
  return points.size() < 2 ? nullptr : through(points, places);
}

Mesh FrameNet::mesh(const Rectangle& range, int count_x, int count_y) const {
  const auto even = [](const Interval& of, int count, int k) { return of.lo + of.width() * k / (count - 1); };
  std::vector<CurvePtr> along_y, along_x;
  for (int i = 0; i < count_x; ++i) along_y.push_back(section(true, even(range.u, count_x, i)));
  for (int j = 0; j < count_y; ++j) along_x.push_back(section(false, even(range.v, count_y, j)));
  const auto holds = [](const CurvePtr& curve, double at) {
    if (!curve) return false;
    const Interval t = curve->domain();
    return at >= t.lo - kInside * t.width() && at <= t.hi + kInside * t.width();
  };
  Mesh mesh;
  std::vector<int32_t> index(static_cast<size_t>(count_x) * count_y, -1);
  for (int i = 0; i < count_x; ++i)
    for (int j = 0; j < count_y; ++j) {
      const double x = even(range.u, count_x, i), y = even(range.v, count_y, j);
      if (!holds(along_y[i], y) || !holds(along_x[j], x)) continue;
      index[static_cast<size_t>(i) * count_y + j] = static_cast<int32_t>(mesh.points.size());
      const CurveJet l = along_y[i]->evaluate(y, 1), m = along_x[j]->evaluate(x, 1);
      mesh.points.push_back(l.d[0]);
      mesh.normals.push_back(glm::normalize(glm::cross(m.d[1], l.d[1])));
      mesh.parameters.emplace_back(x, y);
    }
  for (int i = 0; i + 1 < count_x; ++i)
    for (int j = 0; j + 1 < count_y; ++j) {
      const auto at = [&](int k, int l) { return index[static_cast<size_t>(i + k) * count_y + j + l]; };
      std::vector<int32_t> corners;
      for (const int32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 1)})
        if (corner >= 0) corners.push_back(corner);
      for (size_t k = 2; k < corners.size(); ++k) {
        const std::array<int32_t, 3> of{corners[0], corners[k - 1], corners[k]};
        mesh.triangles.push_back({of, of, of});
      }
    }
  if (mesh.triangles.empty())
    throw FieldError("of", "the sections of the frame have no cell in common",
                     "lines of the frame surround the range, and cross each section in two places at least");
  return mesh;
}

TypeDeclaration frame_section_type() {
  return declare(Category::curve, "frame_section",
                 "Section of a surface of which a wire frame is known, by a plane across a base plane: a cubic spline "
                 "through the points where the plane meets the frame's lines. Its parameter is the other coordinate.")
      .example(
          "of: [{ type: bezier_curve, points: [[0, 0], [1, 0, 1], [2, 0]] }, { type: bezier_curve, points: [[0, 1, "
          "0.5], "
          "[1, 1, 1.5], [2, 1, 0.5]] }, { type: bezier_curve, points: [[0, 2], [1, 2, 1], [2, 2]] }], x: 0.5")
      .field("of", references({Category::curve}), "the lines of the frame")
      .field("frame", frame(), "the base plane is x, y of this frame", "{}")
      .optional("x", number(), "the section x = this")
      .optional("y", number(), "or y = this")
      .built_by([](const Fields& f) {
        if (f.has("x") == f.has("y"))
          throw FieldError(f.has("x") ? "y" : "x", "a section is held at x, or at y", "give one");
        std::vector<CurvePtr> lines;
        for (const std::any& one : f.references("of")) lines.push_back(std::any_cast<CurvePtr>(one));
        const CurvePtr found = FrameNet(lines, f.frame()).section(f.has("x"), f.number(f.has("x") ? "x" : "y"));
        if (!found)
          throw FieldError(f.has("x") ? "x" : "y", "the plane meets the frame in fewer than two places",
                           "take a place that the frame surrounds");
        return std::any(found);
      });
}

}  // namespace lekalo::geometry
