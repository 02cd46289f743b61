// Circles that dimensions of radii and diameters measure.
#include <cmath>
#include <optional>

#include "geometry/body.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/differential/roundness.h"
#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// The circle or arc that a curve is.
Circle circle_of(const Curve& curve) {
  const Interval t = curve.domain();
  const auto at = [&](double x) { return curve.point(t.lo + x * t.width()); };
  const Circle part = arc_through(at(0), at(0.31), at(0.67));
  constexpr double kClosed = 1e-6;  // of the radius
  if (glm::length(at(1) - at(0)) > kClosed * part.radius()) return arc_through(at(0), at(0.5), at(1));
  return Circle(part.frame(), part.radius(), {0, kTwoPi});
}

constexpr double kLarger = 1e-9;  // of a radius: what is no larger by so much is as large

struct CircleAcross {
  Circle circle;
  bool at_end = false;
};

// The largest circle that a surface has across its axis: in the middle if it is as large there, else at an end. Of a
// cone no other circle has a place that anybody could tell.
CircleAcross circle_across(const SurfacePtr& surface) {
  const Rectangle domain = surface->domain();
  for (const IsoDirection held : {IsoDirection::v, IsoDirection::u}) {
    const Interval range = held == IsoDirection::v ? domain.v : domain.u;
    const bool bounded = range.width() < kInfinity;
    std::optional<CircleAcross> largest;
    for (const double at : bounded ? std::vector{range.middle(), range.lo, range.hi} : std::vector{0.0}) {
      const ParameterLine line(surface, held, at);
      // An end may be a point.
      if (!(line.domain().width() < kInfinity) || !is_round(line)) continue;
      const Circle one = circle_of(line);
      if (!largest || one.radius() > (1 + kLarger) * largest->circle.radius())
        largest = CircleAcross{one, bounded && at != range.middle()};
    }
    if (largest) return *largest;
  }
  return {circle_of(ParameterLine(surface, IsoDirection::u, domain.u.middle()))};
}

// Of what a cut has left of a cone, the largest circle is one of its edges.
Circle circle_across(const Body& body, const Face& face) {
  const auto [whole, at_end] = circle_across(face.surface);
  if (!face.trimmed || !at_end) return whole;
  std::optional<Circle> largest;
  for (const int loop : face.loops)
    for (const int coedge : body.loops[loop].coedges) {
      const Edge& edge = body.edges[body.coedges[coedge].edge];
      if (edge.kind != EdgeKind::regular || !is_round(*edge.curve)) continue;
      const Circle one = circle_of(*edge.curve);
      const Vec3 off = one.frame().origin - whole.frame().origin;
      constexpr double kSameAxis = 1e-6;
      if (glm::length(glm::cross(one.frame().z, whole.frame().z)) > kSameAxis ||
          glm::length(glm::cross(off, whole.frame().z)) > kSameAxis * whole.radius())
        continue;
      if (!largest || one.radius() > largest->radius()) largest = one;
    }
  return largest.value_or(whole);
}

}  // namespace

std::vector<Circle> circles_of(const std::vector<std::any>& things) {
  std::vector<Circle> circles;
  for (const std::any& one : things) {
    if (const auto* curve = std::any_cast<CurvePtr>(&one); curve && is_round(**curve))
      circles.push_back(circle_of(**curve));
    if (const auto* surface = std::any_cast<SurfacePtr>(&one); surface && is_round(**surface))
      circles.push_back(circle_across(*surface).circle);
    if (const auto* body = std::any_cast<BodyPtr>(&one))
      for (const Face& face : (*body)->faces)
        if (is_round(*face.surface)) {
          circles.push_back(circle_across(**body, face));
          break;
        }
  }
  return circles;
}

}  // namespace lekalo::render
