// Parts of the searches for intersections of curves: what geometry/queries/intersections/curve_intersections.h and
// self_intersections.h share.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/curves/operations/uneven_places.h"
#include "geometry/numerics/root_search.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// Tangents at a smaller angle (its sine) are parallel: at a contact they are known to about the square root of the
// tolerance.
inline constexpr double kParallel = 1e-3;
inline constexpr int kMaxSteps = 30;
// Of open boxes, in least sides: larger ones hold no contact but a common part.
inline constexpr double kLargestContact = 256;

inline bool are_near(const Box3& a, const Box3& b, double by) {
  for (int k = 0; k < 3; ++k)
    if (a.lo[k] - by > b.hi[k] || b.lo[k] - by > a.hi[k]) return false;
  return true;
}

// Where curves within the tolerance of each other touch, they are so over about its square root of their length.
inline double min_box(double tolerance) { return std::max(1e-8, 0.05 * std::sqrt(tolerance)); }

// How far beyond an end of the curve the tolerance reaches, in its parameter.
inline double slack_of(const Curve& curve, const Interval& piece, double tolerance) {
  double speed = kInfinity;
  for (const double t : {piece.lo, piece.hi})
    speed = std::min(speed, glm::length(evaluate_within(curve, piece, t, 1).d[1]));
  const double width = curve.domain().width();
  return std::clamp(tolerance / speed, kBorderSlack * width, 1e-6 * width);
}

inline double sine_between(const Vec3& a, const Vec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0 ? glm::length(glm::cross(a, b)) / lengths : 0;
}

// Newton's iteration for M equations in N unknowns, least squares of more; the start where it does not end inside
// `reach` of it.
template <int N, int M, class Equations>
ParameterPoint<N> refined(const ParameterPoint<N>& start, const ParameterPoint<N>& reach, Equations&& equations) {
  ParameterPoint<N> x = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const SystemValue<double, N, M> there = equations(x);
    std::array<std::array<double, M>, N> inverse;
    if (!root_search::solve_for<N, M>(there.derivative, inverse)) return start;
    bool small = true;
    for (int i = 0; i < N; ++i) {
      double by = 0;
      for (int k = 0; k < M; ++k) by -= inverse[i][k] * there.value[k];
      x[i] += by;
      small = small && std::abs(by) <= 1e-14 * std::max(1.0, std::abs(x[i]));
      if (!(std::abs(x[i] - start[i]) <= reach[i])) return start;
    }
    if (small) return x;
  }
  return x;
}

// What rounding leaves between operands in this box where they meet.
inline double rounding_in(const Box3& box) {
  return kHitRounding * glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
}

// Looks into the boxes that a search has left open once more, with `share` of its tolerance, which rounding allows:
// crossings far from each other may lie in one open box where the operands are within the tolerance of each other all
// the way between them. A box in which none is found stays open.
template <int N, int M, class System>
void isolate_crossings(const System& system, const ParameterBox<N>& domain, RootSearchOptions<N, M> options,
                       double share, RootSearchResult<N>& found) {
  if (!(share < 1)) return;
  const std::array<double, N> least = options.least;
  for (double& side : options.least) side *= std::sqrt(share);
  for (double& value : options.tolerance) value *= share;
  std::vector<ParameterBox<N>> open;
  for (const ParameterBox<N>& box : found.open) {
    bool small = true;
    // With its surroundings, in which crossings have counted as its own.
    ParameterBox<N> part;
    for (int i = 0; i < N; ++i) {
      small = small && box[i].width() <= kLargestContact * least[i];
      part[i] = intersect(domain[i], {box[i].lo - least[i], box[i].hi + least[i]});
    }
    RootSearchResult<N> inside;
    if (small) inside = search_roots<N, M>(system, domain, options, part);
    found.isolated.insert(found.isolated.end(), inside.isolated.begin(), inside.isolated.end());
    if (inside.isolated.empty()) inside.open = {box};
    open.insert(open.end(), inside.open.begin(), inside.open.end());
  }
  found.open = std::move(open);
}

// Keeps either a contact or the crossings beside it, from which the operands stay within the tolerance of each other:
// where only rounding is between them a contact, else the crossings, between which they only come near each other.
// `are_one(a, b, by)`: they stay so from an intersection to another.
template <class Intersection, class IsContact, class AreOne>
void tell_contacts_from_crossings(std::vector<Intersection>& points, double tolerance, double rounding,
                                  IsContact&& is_contact, AreOne&& are_one) {
  std::vector<Intersection> contacts, crossings;
  for (const Intersection& point : points) (is_contact(point) ? contacts : crossings).push_back(point);
  const auto nearest_of = [](const std::vector<Intersection>& of, const Intersection& one) {
    return *std::min_element(of.begin(), of.end(), [&](const Intersection& a, const Intersection& b) {
      return glm::distance(a.point, one.point) < glm::distance(b.point, one.point);
    });
  };
  if (contacts.empty()) return;
  std::erase_if(crossings, [&](const Intersection& one) {
    const Intersection contact = nearest_of(contacts, one);
    return contact.distance <= rounding && are_one(one, contact, rounding);
  });
  if (!crossings.empty())
    std::erase_if(contacts, [&](const Intersection& one) {
      return one.distance > rounding && are_one(one, nearest_of(crossings, one), tolerance);
    });
  points = std::move(contacts);
  points.insert(points.end(), crossings.begin(), crossings.end());
}

// Whether `holds` at places between two of a curve's parameters, the shorter way round a closed curve.
template <class Holds>
bool holds_between(const Curve& curve, double from, double to, Holds&& holds) {
  const double turn = curve.is_closed() || curve.period() > 0 ? curve.domain().width() : 0;
  if (turn > 0) to -= turn * std::round((to - from) / turn);
  for (const double share : {0.25, 0.5, 0.75}) {
    double t = from + share * (to - from);
    if (!curve.domain().contains(t)) t += t < curve.domain().lo ? turn : -turn;
    if (!holds(curve.domain().clamp(t))) return false;
  }
  return true;
}

// r_a(s) - r_b(t) = 0: three equations, two unknowns.
struct PairSystem {
  const Curve &a, &b;
  Interval piece_a, piece_b;

  SystemValue<Interval, 2, 3> enclose(const ParameterBox<2>& box) const {
    const CurveEnclosure ra = a.enclose(box[0], 1), rb = b.enclose(box[1], 1);
    SystemValue<Interval, 2, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = along(ra.d[0], k) - along(rb.d[0], k);
      result.derivative[k] = {along(ra.d[1], k), -along(rb.d[1], k)};
    }
    return result;
  }
  SystemValue<double, 2, 3> evaluate(const ParameterPoint<2>& at) const {
    const CurveJet ra = evaluate_within(a, piece_a, at[0], 1), rb = evaluate_within(b, piece_b, at[1], 1);
    SystemValue<double, 2, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = ra.d[0][k] - rb.d[0][k];
      result.derivative[k] = {ra.d[1][k], -rb.d[1][k]};
    }
    return result;
  }
  // (r_a - r_b) . r_a' = 0 and (r_a' x r_b') . n = 0, n across the plane of contact (Golovanov 2016, (4.3.6), in a form
  // that is regular where the curves touch).
  ParameterPoint<2> contact_near(const ParameterPoint<2>& start, const ParameterPoint<2>& reach) const {
    const CurveJet a0 = evaluate_within(a, piece_a, start[0], 2), b0 = evaluate_within(b, piece_b, start[1], 2);
    const auto curvature = [](const CurveJet& r) {
      const double square = glm::dot(r.d[1], r.d[1]);
      return (r.d[2] - glm::dot(r.d[2], r.d[1]) / square * r.d[1]) / square;
    };
    const Vec3 n = glm::cross(a0.d[1], curvature(a0) - curvature(b0));
    if (!(glm::dot(n, n) > 0)) return start;
    return refined<2, 2>(start, reach, [&](const ParameterPoint<2>& at) {
      const CurveJet ra = a.evaluate(at[0], 2), rb = b.evaluate(at[1], 2);
      const Vec3 way = ra.d[0] - rb.d[0];
      SystemValue<double, 2, 2> f;
      f.value = {glm::dot(way, ra.d[1]), glm::dot(glm::cross(ra.d[1], rb.d[1]), n)};
      f.derivative[0] = {glm::dot(ra.d[1], ra.d[1]) + glm::dot(way, ra.d[2]), -glm::dot(rb.d[1], ra.d[1])};
      f.derivative[1] = {glm::dot(glm::cross(ra.d[2], rb.d[1]), n), glm::dot(glm::cross(ra.d[1], rb.d[2]), n)};
      return f;
    });
  }
};

// Parts of [places.front(), places.back()] between neighbouring places all of whose points satisfy `lies_on`.
template <class LiesOn>
std::vector<Interval> common_parts(std::vector<double> places, double least, LiesOn&& lies_on) {
  std::sort(places.begin(), places.end());
  std::vector<Interval> parts;
  for (size_t k = 0; k + 1 < places.size(); ++k) {
    const Interval part{places[k], places[k + 1]};
    if (!(part.width() > least)) continue;
    // The middle first: most parts are told by it.
    bool common = lies_on(part.middle());
    for (int i = 1; common && i < kPlacesOfCommonPart; ++i)
      common = lies_on(part.lo + part.width() * share_of_place(i));
    if (!common) continue;
    if (!parts.empty() && part.lo - parts.back().hi <= least)
      parts.back().hi = part.hi;
    else
      parts.push_back(part);
  }
  return parts;
}

inline bool is_within(const std::vector<Interval>& parts, double t, double by) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Interval& part) { return t >= part.lo - by && t <= part.hi + by; });
}

// A place of the parameters of a curve, or both sides of its seam.
inline bool is_one_place(const Curve& curve, double a, double b, double near) {
  const double width = curve.domain().width(), apart = std::abs(a - b);
  return apart <= near || (apart >= width - near && (curve.period() > 0 || curve.is_closed()));
}

}  // namespace lekalo::geometry
