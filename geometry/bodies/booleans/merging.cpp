#include "geometry/bodies/booleans/merging.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/booleans/coincidence.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Images this near, of their box, are one place of the parameter plane.
constexpr double kSamePlace = 1e-6;

struct Side {
  size_t piece;
  const DirectedCurve* curve;
};

std::map<int, std::vector<Side>> sides_of(const std::vector<FacePiece>& pieces) {
  std::map<int, std::vector<Side>> result;
  for (size_t p = 0; p < pieces.size(); ++p)
    for (const auto& loop : pieces[p].loops)
      for (const DirectedCurve& curve : loop) result[curve.strand].push_back({p, &curve});
  return result;
}

const Plane* plane_of(const FacePiece& piece) { return dynamic_cast<const Plane*>(piece.surface.get()); }

bool in_one_plane(const FacePiece& a, const FacePiece& b, const Imprint& imprint, const Vec3& near, double size) {
  const Plane *of_a = plane_of(a), *of_b = plane_of(b);
  if (!of_a || !of_b) return false;
  const double along = glm::dot(of_a->normal(0, 0), of_b->normal(0, 0)) * (a.forward == b.forward ? 1 : -1);
  return along > 0 && have_same_equation(a.surface, b.surface, near, size, imprint.tolerance).value_or(false);
}

double extent_of(const FacePiece& piece) {
  Box3 box;
  for (const auto& loop : piece.loops)
    for (const DirectedCurve& curve : loop) box.include(Vec3(curve.begin(), 0));
  return box.diameter();
}

std::vector<DirectedCurve> curves_of(const FacePiece& piece) {
  std::vector<DirectedCurve> result;
  for (const auto& loop : piece.loops) result.insert(result.end(), loop.begin(), loop.end());
  return result;
}

// The curves of b with images on the surface of a, in the period in which both have the strand in one place.
std::vector<DirectedCurve> moved_over(const FacePiece& a, const FacePiece& b, const Side& at_a, const Side& at_b,
                                      const Imprint& imprint) {
  std::vector<DirectedCurve> curves = curves_of(b);
  if (a.surface == b.surface) {
    const double t = at_a.curve->image->domain().middle();
    const Vec3 by = at_a.curve->image->point(t) - at_b.curve->image->point(t);
    for (DirectedCurve& curve : curves) curve.image = transformed(curve.image, Affine::translation(by));
    return curves;
  }
  const bool turned =
      side_of({a.surface, a.forward, {}, -1, true, {}}) != side_of({b.surface, b.forward, {}, -1, true, {}});
  for (DirectedCurve& curve : curves) {
    curve.image = image_on(a.surface, imprint.strands[curve.strand].curve);
    if (!turned) continue;
    curve.forward = !curve.forward;
    std::swap(curve.from, curve.to);
  }
  return curves;
}

// Without strands that have the region on both sides.
void drop_inner(std::vector<DirectedCurve>& curves) {
  Box3 box;
  for (const DirectedCurve& curve : curves) box.include(Vec3(curve.begin(), 0));
  const double near = kSamePlace * box.diameter();
  std::vector<bool> dropped(curves.size(), false);
  for (size_t i = 0; i < curves.size(); ++i)
    for (size_t k = i + 1; k < curves.size() && !dropped[i]; ++k) {
      if (dropped[k] || curves[i].strand != curves[k].strand || curves[i].forward == curves[k].forward) continue;
      const double t = curves[i].image->domain().middle();
      if (glm::length(curves[i].image->point(t) - curves[k].image->point(t)) <= near) dropped[i] = dropped[k] = true;
    }
  size_t kept = 0;
  for (size_t i = 0; i < curves.size(); ++i)
    if (!dropped[i]) curves[kept++] = curves[i];
  curves.resize(kept);
}

// A plane that reaches beyond the curves.
SurfacePtr wide_plane(const Plane& plane, const std::vector<DirectedCurve>& curves) {
  Box3 box;
  for (const DirectedCurve& curve : curves) box.include(bounds(*curve.image));
  const double beyond = 0.25 * box.diameter();
  auto wide = std::make_shared<Plane>(
      plane.frame(), Rectangle{{box.lo.x - beyond, box.hi.x + beyond}, {box.lo.y - beyond, box.hi.y + beyond}});
  if (plane.normal_sign() < 0) return nullptr;
  return wide;
}

bool merge(FacePiece& a, const FacePiece& b, const Side& at_a, const Side& at_b, const Imprint& imprint) {
  std::vector<DirectedCurve> curves = curves_of(a), others = moved_over(a, b, at_a, at_b, imprint);
  curves.insert(curves.end(), others.begin(), others.end());
  drop_inner(curves);
  if (curves.empty()) return false;
  SurfacePtr surface = a.surface;
  if (a.surface != b.surface) surface = wide_plane(*plane_of(a), curves);
  if (!surface) return false;
  std::vector<PlaneRegion> regions;
  try {
    regions = regions_of(curves, *surface);
  } catch (const BooleanError&) {
    return false;
  }
  if (regions.size() != 1) return false;
  a.surface = surface;
  a.loops.clear();
  for (const auto& loop : regions[0].loops) {
    a.loops.emplace_back();
    for (const int k : loop) a.loops.back().push_back(curves[k]);
  }
  return true;
}

bool merge_one(std::vector<FacePiece>& pieces, const Imprint& imprint) {
  for (const auto& [strand, sides] : sides_of(pieces)) {
    if (sides.size() != 2 || sides[0].piece == sides[1].piece) continue;
    FacePiece &a = pieces[sides[0].piece], &b = pieces[sides[1].piece];
    const CurvePtr& curve = imprint.strands[strand].curve;
    const bool one_surface = a.surface == b.surface && a.forward == b.forward;
    if (!one_surface &&
        !in_one_plane(a, b, imprint, curve->point(curve->domain().middle()), std::max(extent_of(a), extent_of(b))))
      continue;
    if (!merge(a, b, sides[0], sides[1], imprint)) continue;
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(sides[1].piece));
    return true;
  }
  return false;
}

}  // namespace

void merge_pieces(std::vector<FacePiece>& pieces, const Imprint& imprint) {
  while (merge_one(pieces, imprint)) {
  }
}

}  // namespace lekalo::geometry
