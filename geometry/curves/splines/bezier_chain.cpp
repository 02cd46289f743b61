#include "geometry/curves/splines/bezier_chain.h"

#include <numeric>

namespace lekalo::geometry {

namespace {

std::vector<double> integers(size_t count) {
  std::vector<double> result(count);
  std::iota(result.begin(), result.end(), 0.0);
  return result;
}

// Control points with the joints taken once, the end point included.
std::vector<Vec4> joined_points(std::span<const BezierSegment> segments) {
  std::vector<Vec4> points{segments.front().front()};
  for (const BezierSegment& segment : segments) {
    const double factor = points.back().w / segment.front().w;
    for (size_t i = 1; i < segment.size(); ++i) points.push_back(factor * segment[i]);
  }
  return points;
}

}  // namespace

NurbsCurveForm bezier_chain(std::span<const BezierSegment> segments, std::span<const double> breaks) {
  const std::vector<double> ends =
      breaks.empty() ? integers(segments.size() + 1) : std::vector(breaks.begin(), breaks.end());
  NurbsCurveForm form;
  form.degree = static_cast<int>(segments.front().size()) - 1;
  form.points = joined_points(segments);
  form.knots.push_back(ends.front());
  for (const double t : ends) form.knots.insert(form.knots.end(), form.degree, t);
  form.knots.push_back(ends.back());
  return form;
}

NurbsCurve closed_bezier_chain(std::span<const BezierSegment> segments, std::span<const double> breaks) {
  const NurbsCurveForm open = bezier_chain(segments, breaks);
  const int degree = open.degree, size = static_cast<int>(open.knots.size());
  const double period = open.knots.back() - open.knots.front();
  std::vector<double> knots = open.knots;
  knots.front() = open.knots[size - 2 - degree] - period;
  knots.back() = open.knots[degree + 1] + period;
  knots.insert(knots.end(), degree - 1, knots.back());
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (size_t i = 0; i + 1 < open.points.size(); ++i) {
    weights.push_back(open.points[i].w);
    points.push_back(Vec3(open.points[i]) / open.points[i].w);
  }
  return NurbsCurve(SplineAxis(degree, std::move(knots), Extension::periodic), points, weights);
}

}  // namespace lekalo::geometry
