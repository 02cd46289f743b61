// How far two descriptions of one curve or surface differ at the same parameters.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The largest difference of one quantity.
struct Deviation {
  std::string quantity;        // of curves: point, d1, d2, tangent; of surfaces: point, du, dv, duu, duv, dvv, normal
  double largest = 0;          // length of the difference of the two vectors; infinite where one is not finite
  double scale = 0;            // largest length of the first one's vector
  std::array<double, 2> at{};  // where the difference is largest: t, or u and v
  Vec3 first{0}, second{0};    // the two vectors there
};

// Of jets of at least `order` (0..2) at the same places: point and derivatives.
std::vector<Deviation> deviations(std::span<const CurveJet> first, std::span<const CurveJet> second,
                                  std::span<const double> t, int order);
std::vector<Deviation> deviations(std::span<const SurfaceJet> first, std::span<const SurfaceJet> second,
                                  std::span<const Vec2> uv, int order);

// Point, derivatives up to `order` (0..2) and, from order 1, unit tangents or normals at parameters of the first. The
// second's domain is mapped to the first's linearly, and its derivatives with it. A side of a curve's cusp has no
// tangent: it counts as zero there. Throws std::invalid_argument for a domain that is not finite.
std::vector<Deviation> deviations(const Curve& first, const Curve& second, std::span<const double> t, int order);
std::vector<Deviation> deviations(const Surface& first, const Surface& second, std::span<const Vec2> uv, int order);

}  // namespace lekalo::geometry
