#include "geometry/queries/contours/contour_approximation.h"

#include <algorithm>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/queries/contours/contour_curve.h"

namespace lekalo::geometry {

namespace {

constexpr double kRounding = 4e-15;  // of coordinates: points of searched contours are no better

// Of contours that are searched, and of curves on surfaces, each point takes long.
bool takes_long(const Curve& curve) {
  const auto* part = dynamic_cast<const CurvePart*>(&curve);
  const Curve& whole = part ? *part->of() : curve;
  return is_searched(whole) || dynamic_cast<const SurfaceCurve*>(&whole);
}

}  // namespace

CurvePtr contour_approximation(const CurvePtr& curve, double coarsest, double finest) {
  if (!dynamic_cast<const ParameterLine*>(curve.get()) && !takes_long(*curve)) return curve;
  // Its box from a few points: bounds of a searched curve take as long as all else.
  Box3 box;
  constexpr int kPlaces = 8;
  for (int k = 0; k <= kPlaces; ++k)
    box.include(curve->point(curve->domain().lo + curve->domain().width() * k / kPlaces));
  const Vec3 farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  const double rounding = kRounding * std::max({farthest.x, farthest.y, farthest.z});
  const auto nearer_than = [&](double share) {
    return polynomial_approximation(*curve, std::max(share * box.diameter(), rounding), coarsest > finest);
  };
  if (auto simple = nearer_than(finest)) return simple;
  auto simple = coarsest > finest ? nearer_than(coarsest) : nullptr;
  return simple ? simple : curve;
}

Curve2Ptr contour_approximation(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image, double coarsest,
                                double finest) {
  const Rectangle domain = surface.domain();
  const double size = std::max(domain.u.width(), domain.v.width());
  if (!takes_long(*curve) || !(size < kInfinity)) return image;
  const CurvePart part(image, curve->domain());
  auto simple = polynomial_approximation(part, finest * size, coarsest > finest);
  if (!simple && coarsest > finest) simple = polynomial_approximation(part, coarsest * size, true);
  return simple ? simple : image;
}

CurvePtr contour_approximation_within(const CurvePtr& curve, double length) {
  if (!takes_long(*curve)) return curve;
  const CurvePtr simple = polynomial_approximation(*curve, length, true);
  return simple ? simple : curve;
}

Curve2Ptr contour_approximation_within(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image,
                                       double length) {
  if (!takes_long(*curve)) return image;
  constexpr int kPlaces = 8;
  double fastest = 0;
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 uv = image->point(curve->domain().lo + curve->domain().width() * k / kPlaces);
    const SurfaceJet jet = surface.evaluate(uv.x, uv.y, 1);
    fastest = std::max({fastest, glm::length(jet.du()), glm::length(jet.dv())});
  }
  if (!(fastest > 0)) return image;
  const Curve2Ptr simple = polynomial_approximation(CurvePart(image, curve->domain()), length / fastest, true);
  return simple ? simple : image;
}

}  // namespace lekalo::geometry
