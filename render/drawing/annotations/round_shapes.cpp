// Circles that dimensions of radii and diameters measure.
#include <cmath>

#include "geometry/body.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/differential/roundness.h"
#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// The circle or arc that a curve is, or that a surface has across its axis.
Circle circle_of(CurvePtr curve, const SurfacePtr& surface) {
  if (!curve) {
    const Rectangle domain = surface->domain();
    const auto middle = [](const Interval& range) { return range.width() < kInfinity ? range.middle() : 0.0; };
    for (const IsoDirection held : {IsoDirection::v, IsoDirection::u}) {
      curve = std::make_shared<ParameterLine>(surface, held, middle(held == IsoDirection::v ? domain.v : domain.u));
      if (curve->domain().width() < kInfinity && is_round(*curve)) break;
    }
  }
  const Interval t = curve->domain();
  const auto at = [&](double x) { return curve->point(t.lo + x * t.width()); };
  const Circle part = arc_through(at(0), at(0.31), at(0.67));
  constexpr double kClosed = 1e-6;  // of the radius
  if (glm::length(at(1) - at(0)) > kClosed * part.radius()) return arc_through(at(0), at(0.5), at(1));
  return Circle(part.frame(), part.radius(), {0, kTwoPi});
}

}  // namespace

std::vector<Circle> circles_of(const std::vector<std::any>& things) {
  std::vector<Circle> circles;
  for (const std::any& one : things) {
    if (const auto* curve = std::any_cast<CurvePtr>(&one); curve && is_round(**curve))
      circles.push_back(circle_of(*curve, nullptr));
    if (const auto* surface = std::any_cast<SurfacePtr>(&one); surface && is_round(**surface))
      circles.push_back(circle_of(nullptr, *surface));
    if (const auto* body = std::any_cast<BodyPtr>(&one))
      for (const Face& face : (*body)->faces)
        if (is_round(*face.surface)) {
          circles.push_back(circle_of(nullptr, face.surface));
          break;
        }
  }
  return circles;
}

}  // namespace lekalo::render
