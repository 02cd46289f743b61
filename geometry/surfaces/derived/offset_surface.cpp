// Offset surfaces (Golovanov 2016, 3.15):
//
//   r(u, v) = s(u, v) + d n(u, v),   n = s_u x s_v/|s_u x s_v|
//
// d a constant or a formula of u and v. The offsets of plane, sphere, cylinder, cone and torus at a constant distance
// are surfaces of their kind, the offset of an offset is one of its base. n is not smooth at a pole of s, whose offset
// is built without it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/no_longer.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/derived/normals.h"
#include "geometry/surfaces/derived/offset.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// A sum of distances along r_u x r_v: those of an offset of an offset add up.
struct Distance {
  struct Term {
    double factor;
    std::shared_ptr<const Expression> law;  // of u and v; null: 1
  };
  std::vector<Term> terms;

  bool is_constant() const {
    return std::all_of(terms.begin(), terms.end(),
                       [](const Term& term) { return !term.law || term.law->is_constant(); });
  }
  template <class T>
  T at(const T& u, const T& v) const {
    const std::array<T, 2> place{u, v};
    T sum(0);
    for (const Term& term : terms)
      sum += term.law ? term.factor * term.law->evaluate(std::span<const T>(place)) : T(term.factor);
    return sum;
  }
  Distance times(double factor) const {
    Distance result = *this;
    for (Term& term : result.terms) term.factor *= factor;
    return result;
  }
};

struct Offset {
  SurfacePtr of;
  Distance distance;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    const Triple<T> n = cross(surface_at(*of, u, v, 1, 0), surface_at(*of, u, v, 0, 1));
    const T reach = distance.at(u, v);
    return surface_at(*of, u, v) + no_longer((reach / length(n)) * n, reach);
  }
};

// Of a cone or cylinder on one side of its apex: radii and base move with the normal, (h, -w)/|(h, w)| in its meridian
// plane, w the difference of the radii.
std::shared_ptr<Surface> cone_offset(const ConeSurface& of, double d) {
  const double w = of.top_radius() - of.radius(), h = of.height(), length = std::hypot(w, h);
  const Rectangle domain = of.domain();
  const auto radius_at = [&](double v, double by) { return of.radius() + (w != 0 ? w * v : 0) + by; };
  const double by = d * h / length;
  for (const double v : {domain.v.lo, domain.v.hi})
    if (!(radius_at(v, 0) > 0 && radius_at(v, by) > 0)) return nullptr;
  Frame frame = of.frame();
  frame.origin -= (d * w / length) * frame.z;
  if (w == 0) return std::make_shared<CylinderSurface>(frame, of.radius() + by, h, domain);
  return std::make_shared<ConeSurface>(frame, of.radius() + by, of.top_radius() + by, h, domain);
}

// The surface of the same kind at a distance, with the same parameters; null where there is none.
std::shared_ptr<Surface> analytic_offset(const Surface& of, double d) {
  if (const auto* sphere = dynamic_cast<const SphereSurface*>(&of); sphere && sphere->radius() + d > 0)
    return std::make_shared<SphereSurface>(sphere->frame(), sphere->radius() + d, sphere->domain());
  if (const auto* torus = dynamic_cast<const TorusSurface*>(&of); torus && torus->minor_radius() + d > 0) {
    try {
      return std::make_shared<TorusSurface>(torus->frame(), torus->major_radius(), torus->minor_radius() + d,
                                            torus->domain());
    } catch (const std::invalid_argument&) {
      return nullptr;  // it would pass its axis within the domain
    }
  }
  if (const auto* plane = dynamic_cast<const Plane*>(&of)) {
    Frame frame = plane->frame();
    frame.origin += d * frame.z;
    return std::make_shared<Plane>(frame, plane->domain());
  }
  const auto* cone = dynamic_cast<const ConeSurface*>(&of);
  return cone ? cone_offset(*cone, d) : nullptr;
}

// +1 or -1 where the normals of an offset are those of its base everywhere, or all opposite to them, which they are
// beyond one of the radii of curvature; else 0. Looked at in places of a grid.
double side_of_normals(const Surface& offset, const Surface& base) {
  const Rectangle domain = base.domain();
  double side = 0;
  constexpr int kTried = 16;
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const double u = domain.u.lo + domain.u.width() * i / kTried, v = domain.v.lo + domain.v.width() * j / kTried;
      const SurfaceJet a = offset.evaluate(u, v, 1), b = base.evaluate(u, v, 1);
      const double here = glm::dot(glm::cross(a.du(), a.dv()), glm::cross(b.du(), b.dv()));
      if (!(here * side >= 0) || here == 0) return 0;
      side = here > 0 ? 1 : -1;
    }
  return side;
}

// Of a map that keeps angles: the factor of lengths, negative for a mirror image; else 0.
double similarity(const Affine& map) {
  const Mat3& a = map.linear;
  const double scale = std::cbrt(map.determinant());
  const Mat3 square = glm::transpose(a) * a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(square[i][j] - (i == j ? scale * scale : 0)) > 1e-14 * scale * scale) return 0;
  return scale;
}

// Offsets of offsets and of moved surfaces are offsets of the base (Golovanov 2016, 3.15): with the base's parameters,
// and of the closed form that it may have.
std::shared_ptr<Surface> offset_of(const SurfacePtr& of, const Distance& distance) {
  if (const auto* inner = dynamic_cast<const ComposedSurface<Offset>*>(of.get())) {
    const Offset& offset = inner->formula();
    if (const double side = side_of_normals(*inner, *offset.of); side != 0) {
      Distance sum = distance.times(side);
      sum.terms.insert(sum.terms.begin(), offset.distance.terms.begin(), offset.distance.terms.end());
      return std::make_shared<ComposedSurface<Offset>>(Offset{offset.of, sum}, properties_of(*offset.of, 1));
    }
  }
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(of.get()))
    if (const double scale = similarity(moved->map()); scale != 0)
      return std::make_shared<TransformedSurface>(offset_of(moved->original(), distance.times(1 / scale)),
                                                  moved->map());
  if (distance.is_constant())
    if (auto offset = analytic_offset(*of, distance.at(0.0, 0.0))) return offset;
  check_normals(*of, "of");
  return std::make_shared<ComposedSurface<Offset>>(Offset{of, distance}, properties_of(*of, 1));
}

}  // namespace

SurfacePtr offset_surface(const SurfacePtr& of, double distance) {
  const auto offset = offset_of(of, {{{of->normal_sign() * distance, nullptr}}});
  offset->set_reversed(of->reversed());
  return offset;
}

TypeDeclaration offset_surface_type() {
  return declare(Category::surface, "offset_surface",
                 "Surface at a distance from another along its normals, with its parameters. Where the distance is "
                 "beyond a "
                 "radius of curvature it folds over.")
      .example("of: { type: cylinder_surface, radius: 1, height: 2 }, distance: 0.2")
      .field("of", reference({Category::surface}), "the surface; bounded, and with a normal everywhere")
      .field("distance", formula({"u", "v"}), "along the normal; a number, or a formula of the parameters")
      .built_by([](const Fields& f) {
        const SurfacePtr of = f.surface("of");
        if (!of->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
        const Distance distance{
            {{of->normal_sign(), std::make_shared<const Expression>(f.get<Expression>("distance"))}}};
        const std::shared_ptr<Surface> offset = offset_of(of, distance);
        offset->set_reversed(of->reversed());
        return std::any(SurfacePtr(offset));
      });
}

}  // namespace lekalo::geometry
