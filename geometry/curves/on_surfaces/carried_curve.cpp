// Curves carried from one surface to another of the same parameters, as to the development of a surface and back
// (Zavyalov, Leus, Skorospelov 1985, IV.4): r(t) = S_1(u(t), v(t)) -> S_2(u(t), v(t)).
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
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

// Of points of the image: bounds that are certain would reach beyond a seam at which it begins.
Box3 reach_of(const Curve& image) {
  constexpr int kPlaces = 512;
  Box3 box;
  for (int i = 0; i <= kPlaces; ++i) box.include(image.point(image.domain().lo + image.domain().width() * i / kPlaces));
  return box;
}

// Where the image leaves the domain, 0 u, 1 v.
std::optional<int> side_left(const Curve& image, const Rectangle& domain) {
  const Box3 box = reach_of(image);
  for (const int k : {0, 1}) {
    const Interval& range = k == 0 ? domain.u : domain.v;
    const double room = 1e-9 * range.width();
    if (box.lo[k] < range.lo - room || box.hi[k] > range.hi + room) return k;
  }
  return std::nullopt;
}

// Moved by whole periods of the surface so that its middle lies in the domain.
Curve2Ptr moved_inside(const Curve2Ptr& image, const Surface& surface) {
  const Box3 box = reach_of(*image);
  const Periods periods = closed_periods(surface);
  const Rectangle domain = surface.domain();
  Vec3 by(0);
  if (periods.u > 0) by.x = -periods.u * std::floor((0.5 * (box.lo.x + box.hi.x) - domain.u.lo) / periods.u);
  if (periods.v > 0) by.y = -periods.v * std::floor((0.5 * (box.lo.y + box.hi.y) - domain.v.lo) / periods.v);
  return by == Vec3(0) ? image : transformed(image, Affine::translation(by));
}

// A parameter at which the image passes over the border of the domain, or whole periods beside it.
std::optional<double> seam_passage(const Curve& image, const Interval& range, int axis) {
  const auto turn = [&](double t) { return std::floor((image.point(t)[axis] - range.lo) / range.width()); };
  constexpr int kSteps = 1024;
  const Interval domain = image.domain();
  for (int i = 0; i < kSteps; ++i) {
    double lo = domain.lo + domain.width() * i / kSteps, hi = domain.lo + domain.width() * (i + 1) / kSteps;
    if (turn(lo) == turn(hi)) continue;
    for (int k = 0; k < 60; ++k) (turn(0.5 * (lo + hi)) == turn(lo) ? lo : hi) = 0.5 * (lo + hi);
    return hi;
  }
  return std::nullopt;
}

// The image of a closed curve that goes round a closed surface, begun at another parameter.
Curve2Ptr begun_at(const Curve2Ptr& image, double t) {
  const Interval domain = image->domain();
  const Vec3 round = image->point(domain.hi) - image->point(domain.lo);
  return std::make_shared<CompositeCurve>(
      std::vector<CurvePtr>{trimmed_curve(image, t, domain.hi, false),
                            transformed(trimmed_curve(image, domain.lo, t, false), Affine::translation(round))},
      false, 1e-9);
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
  const CurvePtr curve = f.curve("of");
  Curve2Ptr image = moved_inside(image_on(curve, from), *from);
  if (const auto side = side_left(*image, b); side && curve->is_closed() && !image->is_closed())
    if (const auto t = seam_passage(*image, *side == 0 ? b.u : b.v, *side))
      image = moved_inside(begun_at(image, *t), *from);
  if (const auto side = side_left(*image, b))
    throw FieldError(
        "of",
        fmt::format("the curve runs over the seam of the surface, where {} begins and ends", *side == 0 ? "u" : "v"),
        "turn the surface's frame so that its seam is elsewhere, or take a part of the curve");
  return std::any(CurvePtr(std::make_shared<SurfaceCurve>(to, image)));
}

}  // namespace

TypeDeclaration carried_curve_type() {
  return declare(Category::curve, "carried_curve",
                 "A curve on a surface carried to another surface by equal parameters u, v: to the surface's "
                 "development, or from there back. Its parameter is the curve's; a closed curve that runs over a seam "
                 "begins there, at 0.")
      .example(
          "of: { type: circle, center: [0, 1.5], radius: 1 }, from: { type: plane, size: [6, 6] }, to: { type: "
          "formula_surface, point: [cos(u/2), sin(u/2), v], domain: { u: [-3, 3], v: [-3, 3] } }")
      .field("of", reference({Category::curve}), "the curve; it lies on the surface `from`")
      .field("from", reference({Category::surface}), "the surface that it lies on")
      .field("to", reference({Category::surface}), "the surface that it is carried to, of the same domain")
      .built_by(carried_curve);
}

}  // namespace lekalo::geometry
