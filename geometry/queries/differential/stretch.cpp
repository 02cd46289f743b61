#include "geometry/queries/differential/stretch.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Halvings of the step by which the best place is searched further.
constexpr int kHalvings = 40;

struct Form {
  double e, f, g;
};

Form first_form(const Surface& surface, double u, double v) {
  const SurfaceJet jet = surface.evaluate(u, v, 1);
  return {glm::dot(jet.du(), jet.du()), glm::dot(jet.du(), jet.dv()), glm::dot(jet.dv(), jet.dv())};
}

// From the place on, by steps along the parameters that become smaller.
template <class Value>
void climb(const Rectangle& domain, double step, const Value& value, Stretch& best) {
  for (int halving = 0; halving < kHalvings; ++halving, step /= 2)
    for (bool moved = true; moved;) {
      moved = false;
      for (const Vec2 by : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        const double u = domain.u.clamp(best.u + step * by.x * domain.u.width());
        const double v = domain.v.clamp(best.v + step * by.y * domain.v.width());
        if (value(u, v) > value(best.u, best.v)) best.u = u, best.v = v, moved = true;
      }
    }
}

}  // namespace

std::pair<double, double> principal_stretches(const Surface& from, const Surface& to, double u, double v) {
  const Form a = first_form(from, u, v), b = first_form(to, u, v);
  // B in coordinates in which A is the identity (Cholesky): a symmetric matrix m.
  const double slope = a.f / a.e, rest = a.g - slope * a.f;
  if (!(rest > 0)) return {NAN, NAN};
  const double m11 = b.e / a.e, m12 = (b.f - slope * b.e) / std::sqrt(a.e * rest);
  const double m22 = (b.g - 2 * slope * b.f + slope * slope * b.e) / rest;
  const double mean = 0.5 * (m11 + m22), off = std::hypot(0.5 * (m11 - m22), m12);
  return {std::sqrt(std::max(mean - off, 0.0)), std::sqrt(mean + off)};
}

Stretches stretches(const Surface& from, const Surface& to, int samples) {
  if (!from.bounded() || !to.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
  const Rectangle domain = from.domain();
  if (domain.u != to.domain().u || domain.v != to.domain().v)
    throw std::invalid_argument("the surfaces have other parameters: as a surface and its development have the same");
  const auto least = [&](double u, double v) { return -principal_stretches(from, to, u, v).first; };
  const auto greatest = [&](double u, double v) { return principal_stretches(from, to, u, v).second; };
  Stretches result;
  double lowest = -kInfinity, highest = -kInfinity;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const double u = domain.u.lo + domain.u.width() * i / (samples - 1);
      const double v = domain.v.lo + domain.v.width() * j / (samples - 1);
      if (least(u, v) > lowest) lowest = least(u, v), result.least.u = u, result.least.v = v;
      if (greatest(u, v) > highest) highest = greatest(u, v), result.greatest.u = u, result.greatest.v = v;
    }
  if (!(highest > -kInfinity)) throw std::invalid_argument("the surface has no tangent planes");
  climb(domain, 0.5 / (samples - 1), least, result.least);
  climb(domain, 0.5 / (samples - 1), greatest, result.greatest);
  result.least.value = -least(result.least.u, result.least.v);
  result.greatest.value = greatest(result.greatest.u, result.greatest.v);
  return result;
}

}  // namespace lekalo::geometry
