// Faces of a draft whose loops have changed.
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/blends/body_draft.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

namespace {

// Twice the area between a curve and the origin.
double area_beside(const Curve& image) {
  constexpr int kSteps = 32;
  const Interval t = image.domain();
  double area = 0;
  Vec3 last = image.point(t.lo);
  for (int k = 1; k <= kSteps; ++k) {
    const Vec3 here = image.point(t.lo + t.width() * k / kSteps);
    area += last.x * here.y - last.y * here.x;
    last = here;
  }
  return area;
}

}  // namespace

Box3 sampled_box(const Curve& curve) {
  constexpr int kSamples = 32;
  Box3 box;
  for (const CurvePiece& piece : curve.pieces())
    for (int k = 0; k <= kSamples; ++k) box.include(curve.point(piece.domain.lo + piece.domain.width() * k / kSamples));
  return box;
}

bool chain_loops(const BodyDraft& draft, DraftFace& face) {
  std::map<int, Body::Use> leaving;  // of each vertex
  for (const auto& loop : face.loops)
    for (const Body::Use& use : loop) {
      const Edge& edge = draft.edges[use.edge];
      if (!leaving.emplace(use.forward ? edge.start : edge.end, use).second) return false;
    }
  std::vector<std::pair<double, std::vector<Body::Use>>> loops;
  while (!leaving.empty()) {
    std::vector<Body::Use> loop;
    double area = 0;
    int at = leaving.begin()->first;
    for (auto next = leaving.find(at); next != leaving.end(); next = leaving.find(at)) {
      const Body::Use use = next->second;
      leaving.erase(next);
      const Edge& edge = draft.edges[use.edge];
      at = use.forward ? edge.end : edge.start;
      area += (use.forward ? 1 : -1) * area_beside(*use.image);
      loop.push_back(use);
    }
    loops.emplace_back(std::abs(area), std::move(loop));
  }
  std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  face.loops.clear();
  for (auto& [area, loop] : loops) face.loops.push_back(std::move(loop));
  return true;
}

bool reaches_loops(DraftFace& face) {
  Box3 box;
  for (const auto& loop : face.loops)
    for (const Body::Use& use : loop) box.include(sampled_box(*use.image));
  Rectangle domain = face.surface->domain();
  const Periods periods = face.surface->periods();
  const double slack = 1e-9 * box.diameter(),
               reach = dynamic_cast<const Plane*>(face.surface.get()) ? 0.05 * box.diameter() : 0;
  const auto widened = [&](Interval& range, double period, double lo, double hi) {
    if (period > 0 && range.width() >= period * (1 - 1e-12)) return false;
    const bool leaves = lo - reach < range.lo - slack || hi + reach > range.hi + slack;
    if (leaves) range = {std::min(range.lo, lo - reach), std::max(range.hi, hi + reach)};
    return leaves;
  };
  const bool u = widened(domain.u, periods.u, box.lo.x, box.hi.x), v = widened(domain.v, periods.v, box.lo.y, box.hi.y);
  if (!u && !v) return true;
  const bool was_reversed = face.surface->reversed();
  const SurfacePtr more = continued_by_law(face.surface, domain);
  if (!more) return false;
  std::const_pointer_cast<Surface>(more)->set_reversed(was_reversed);
  face.surface = more;
  return true;
}

}  // namespace lekalo::geometry
