// Foot points of a surface that are not isolated, or double ones.
#pragma once

#include <cmath>

#include "geometry/numerics/root_search.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The foot point by a box that may hold many, or a double one; the box's middle where none is found. `system`: the
// derivatives of the squared distance by u and v, as SurfaceSystem in closest_point_on_surface.cpp; `scale`: the widths
// of the domain, so that the parameters' units choose no direction.
//
// Newton's iteration across the line of foot points alone, along which an eigenvalue of the second derivatives
// vanishes.
template <class System>
ParameterPoint<2> degenerate_foot_point(const System& system, const Rectangle& piece, const ParameterBox<2>& box,
                                        const ParameterPoint<2>& scale) {
  constexpr int kMaxSteps = 20;
  constexpr double kBeside = 1e-8;     // of the domain: so far from its box a foot point still belongs to it
  constexpr double kVanishing = 1e-5;  // an eigenvalue, in parts of the other
  const ParameterPoint<2> middle{box[0].middle(), box[1].middle()};
  ParameterPoint<2> at = middle;
  double before = kInfinity;
  for (int step = 0; step < kMaxSteps; ++step) {
    const SystemValue<double, 2, 2> there = system.evaluate(at);
    const double f = there.value[0] * scale[0], g = there.value[1] * scale[1];
    // The symmetric matrix (a b; b c).
    const double a = there.derivative[0][0] * scale[0] * scale[0], b = there.derivative[0][1] * scale[0] * scale[1],
                 c = there.derivative[1][1] * scale[1] * scale[1];
    const double half = 0.5 * (a + c), root = std::hypot(0.5 * (a - c), b);
    const double greatest = half < 0 ? half - root : half + root;
    if (!(std::abs(greatest) > 0)) return middle;
    double x = greatest - c, y = b;
    if (std::abs(greatest - a) > std::abs(x)) x = b, y = greatest - a;
    const double length = std::hypot(x, y);
    length > 0 ? (x /= length, y /= length) : (x = 1, y = 0);
    double du = -(f * x + g * y) / greatest * x, dv = -(f * x + g * y) / greatest * y;
    if (const double other = a + c - greatest; std::abs(other) > kVanishing * std::abs(greatest)) {
      du += (f * y - g * x) / other * -y;
      dv += (f * y - g * x) / other * x;
    }
    const double by = std::hypot(du, dv);
    const ParameterPoint<2> next{piece.u.clamp(at[0] + du * scale[0]), piece.v.clamp(at[1] + dv * scale[1])};
    for (int i = 0; i < 2; ++i)
      if (!(std::abs(next[i] - middle[i]) <= 2 * box[i].width() + kBeside * scale[i])) return middle;
    at = next;
    if (by <= 1e-16 || by >= before) break;
    before = by;
  }
  return at;
}

}  // namespace lekalo::geometry
