// Curves carried from one surface to another of the same parameters, as to the development of a surface and back
// (Zavyalov, Leus, Skorospelov 1985, IV.4): r(t) = S_1(u(t), v(t)) -> S_2(u(t), v(t)).
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

TypeDeclaration projected_curve_type();

namespace {

// A curve this near to a surface, relative to the surface's size, lies on it.
constexpr double kOnSurface = 1e-6;
constexpr int kTried = 64;

Curve2Ptr image_on(const CurvePtr& curve, const SurfacePtr& surface) {
  const auto* known = dynamic_cast<const SurfaceCurve*>(curve.get());
  if (known && is_same(known->surface(), surface)) return known->image();
  static const TypeDeclaration projected = projected_curve_type();
  Fields fields;
  fields.set("of", curve);
  fields.set("onto", surface);
  fields.set("hit", 0);
  CurvePtr foot;
  try {
    foot = std::any_cast<CurvePtr>(projected.build(fields));
  } catch (const FieldError& error) {
    throw FieldError("of", fmt::format("the curve is not followed on the surface: {}", error.what()),
                     "take a part of the curve, or turn the surface's seam out of its way");
  }
  const double size = bounds(*surface).diameter();
  for (int i = 0; i <= kTried; ++i) {
    const double t = curve->domain().lo + curve->domain().width() * i / kTried;
    const double off = glm::length(foot->point(t) - curve->point(t));
    if (!(off <= kOnSurface * size))
      throw FieldError("of",
                       fmt::format("the curve does not lie on the surface: at t = {:.6g} it is {:.6g} away", t, off),
                       "projected_curve leads it there");
  }
  return dynamic_cast<const SurfaceCurve&>(*foot).image();
}

std::any carried_curve(const Fields& f) {
  const SurfacePtr from = f.surface("from"), to = f.surface("to");
  for (const auto& [surface, field] : {std::pair(from, "from"), std::pair(to, "to")})
    if (!surface->bounded()) throw FieldError(field, "the surface is unbounded", "give it a domain");
  const Rectangle a = from->domain(), b = to->domain();
  if (a.u != b.u || a.v != b.v)
    throw FieldError("to",
                     fmt::format("the surfaces have other parameters: u {:.6g} to {:.6g}, v {:.6g} to {:.6g} and u "
                                 "{:.6g} to {:.6g}, v {:.6g} to {:.6g}",
                                 a.u.lo, a.u.hi, a.v.lo, a.v.hi, b.u.lo, b.u.hi, b.v.lo, b.v.hi),
                     "as a surface and its development have the same");
  const Curve2Ptr image = image_on(f.curve("of"), from);
  const Periods periods = closed_periods(*to);
  const Box3 box = bounds(*image);
  for (const int k : {0, 1}) {
    const Interval& domain = k == 0 ? b.u : b.v;
    const double room = 1e-9 * domain.width();
    if ((k == 0 ? periods.u : periods.v) == 0 && !(box.lo[k] >= domain.lo - room && box.hi[k] <= domain.hi + room))
      throw FieldError("of",
                       fmt::format("the curve runs over the seam of the surface, {} = {:.6g}", k == 0 ? "u" : "v",
                                   box.lo[k] < domain.lo - room ? domain.lo : domain.hi),
                       "turn the surface's frame so that its seam is elsewhere, or begin the curve there");
  }
  return std::any(CurvePtr(std::make_shared<SurfaceCurve>(to, image)));
}

}  // namespace

TypeDeclaration carried_curve_type() {
  return declare(Category::curve, "carried_curve",
                 "A curve on a surface carried to another surface by equal parameters u, v: to the surface's "
                 "development, or from there back.")
      .example(
          "of: { type: geodesic_curve, of: pipe, from: [0, 0], direction: 30, length: 2 }, from: pipe, to: { type: "
          "development, of: pipe }")
      .field("of", reference({Category::curve}), "the curve; it lies on the surface `from`")
      .field("from", reference({Category::surface}), "the surface that it lies on")
      .field("to", reference({Category::surface}), "the surface that it is carried to, of the same domain")
      .built_by(carried_curve);
}

}  // namespace lekalo::geometry
