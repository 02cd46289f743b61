// Surfaces between two others, by equal shares of their domains (Zavyalov et al. 1985, VII.3: the mid surface of a
// blade):
//
//   r(u, v) = (1 - w) a(u, v) + w b(u', v'),   w = 1/2 for the middle, u', v' at the same shares of b's domain
#include "geometry/composition.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// An affine map of one interval to another.
struct Shares {
  Interval from, to;
  template <class T>
  T operator()(const T& x) const {
    return from == to ? x : T(to.lo) + (to.width() / from.width()) * (x - T(from.lo));
  }
};

struct Between {
  SurfacePtr a, b;
  Shares u_of_b, v_of_b;
  double share;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    return T(1 - share) * surface_at(*a, u, v) + T(share) * surface_at(*b, u_of_b(u), v_of_b(v));
  }
};

// Lines of kinks of both, those of the second at their places on the first.
std::vector<double> joined(std::vector<double> breaks, const std::vector<double>& others, const Shares& back) {
  for (const double other : others) breaks.push_back(back(other));
  std::sort(breaks.begin(), breaks.end());
  const double same = 1e-12 * (breaks.back() - breaks.front());
  const double lo = breaks.front(), hi = breaks.back();
  breaks.erase(std::unique(breaks.begin(), breaks.end(), [&](double x, double y) { return y - x <= same; }),
               breaks.end());
  breaks.front() = lo, breaks.back() = hi;
  return breaks;
}

std::any mid_surface(const Fields& f) {
  const SurfacePtr a = f.surface("of"), b = f.surface("to");
  for (const auto& [surface, field] : {std::pair(a, "of"), std::pair(b, "to")})
    if (!surface->bounded()) throw FieldError(field, "the surface is unbounded", "give it a domain");
  const Rectangle from = a->domain(), to = b->domain();
  SurfaceProperties properties = properties_of(*a);
  const SurfaceProperties others = properties_of(*b);
  properties.breaks_u = joined(properties.breaks_u, others.breaks_u, {to.u, from.u});
  properties.breaks_v = joined(properties.breaks_v, others.breaks_v, {to.v, from.v});
  properties.max_order = std::min(properties.max_order, others.max_order);
  properties.enclosure_order = std::min(properties.enclosure_order, others.enclosure_order);
  // A part of a surface that closes has its period, and does not close.
  const auto closes = [](const Interval& domain, double period) {
    return period > 0 && domain.width() >= period * (1 - 1e-12);
  };
  if (!closes(from.u, properties.periods.u) || !closes(to.u, others.periods.u)) properties.periods.u = 0;
  if (!closes(from.v, properties.periods.v) || !closes(to.v, others.periods.v)) properties.periods.v = 0;
  const Between formula{a, b, {from.u, to.u}, {from.v, to.v}, f.number("share")};
  const auto result = std::make_shared<ComposedSurface<Between>>(formula, std::move(properties));
  result->set_reversed(a->reversed());
  return std::any(SurfacePtr(result));
}

}  // namespace

TypeDeclaration mid_surface_type() {
  return declare(Category::surface, "mid_surface",
                 "The surface midway between two others, or nearer to one of them: points at equal shares of their "
                 "domains, as of the two sides of a blade. Its parameters are those of the first.")
      .example(
          "of: { type: plane, size: [2, 2] }, to: { type: formula_surface, point: [u, v, 2 + u*v], domain: { u: [-1, "
          "1], v: [-1, 1] } }")
      .field("of", reference({Category::surface}), "one surface")
      .field("to", reference({Category::surface}), "the other one; its parameters run the same way")
      .field("share", number().between(0, 1), "of the way from the first to the second", "0.5")
      .built_by(mid_surface);
}

}  // namespace lekalo::geometry
