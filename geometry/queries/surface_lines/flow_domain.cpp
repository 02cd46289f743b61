#include "geometry/queries/surface_lines/flow_domain.h"

#include <cmath>

#include "geometry/curves/operations/surface_curve.h"

namespace lekalo::geometry {

double slack(const Interval& range) {
  const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
  return largest < kInfinity ? 8e-16 * largest : 0;
}

FlowDomain::FlowDomain(const Surface& of) : surface(of), whole(of.domain()) {
  for (const SurfacePiece& piece : surface.pieces()) pieces.push_back(piece.domain);
  if (pieces.empty()) pieces.push_back(whole);
  const Periods periods = closed_periods(surface);
  period[0] = periods.u;
  period[1] = periods.v;

  const DegenerateEdges edges = surface.degenerate_edges();
  const auto add = [&](bool is_pole, int axis, bool above) {
    if (!is_pole) return;
    Pole pole{axis, above, Vec3(0)};
    const double other = side(whole, 1 - axis).lo;
    pole.point = axis == 0 ? surface.point(edge(pole), other) : surface.point(other, edge(pole));
    poles.push_back(pole);
  };
  add(edges.u_min, 0, false);
  add(edges.u_max, 0, true);
  add(edges.v_min, 1, false);
  add(edges.v_max, 1, true);
  if (poles.empty()) return;

  constexpr int kPlaces = 12;
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; j <= kPlaces; ++j) {
      const SurfaceJet at =
          surface.evaluate(whole.u.lo + whole.u.width() * i / kPlaces, whole.v.lo + whole.v.width() * j / kPlaces, 1);
      speeds[0] = std::max(speeds[0], glm::length(at.du()));
      speeds[1] = std::max(speeds[1], glm::length(at.dv()));
    }
}

double FlowDomain::edge(const Pole& pole) const {
  return pole.above ? side(whole, pole.axis).hi : side(whole, pole.axis).lo;
}

// Along the parameter line that leaves the pole in the direction asked for: found among all by bisection of its
// sideways part.
std::optional<Vec2> FlowDomain::beyond(const Pole& pole, const Vec3& out) const {
  const Interval& along = side(whole, 1 - pole.axis);
  const double distance = glm::length(out), sign = pole.above ? -1 : 1;
  const auto place = [&](double w, double x) { return pole.axis == 0 ? Vec2(x, w) : Vec2(w, x); };
  const auto inward = [&](double w) {
    const Vec2 at = place(w, edge(pole));
    const SurfaceJet jet = surface.evaluate(at.x, at.y, 1);
    return sign * (pole.axis == 0 ? jet.du() : jet.dv());
  };
  const Vec2 corner = place(along.lo, edge(pole));
  const Vec3 sideways = glm::cross(surface.normal(corner.x, corner.y), out);
  const auto beside = [&](double w) { return glm::dot(inward(w), sideways); };
  constexpr int kPlaces = 64;
  for (int i = 0; i < kPlaces; ++i) {
    double lo = along.lo + along.width() * i / kPlaces, hi = along.lo + along.width() * (i + 1) / kPlaces;
    if (beside(lo) * beside(hi) > 0 || !(glm::dot(inward(lo), out) > 0)) continue;
    const bool falls = beside(lo) > 0 || beside(hi) < 0;
    for (int time = 0; time < 60; ++time) {
      const double middle = 0.5 * (lo + hi);
      ((beside(middle) > 0) == falls ? lo : hi) = middle;
    }
    const Vec3 direction = inward(lo);
    const double speed = glm::length(direction);
    if (!(glm::dot(direction, out) > (1 - 1e-10) * speed * distance)) return std::nullopt;  // an apex
    return place(lo, edge(pole) + sign * distance / speed);
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
