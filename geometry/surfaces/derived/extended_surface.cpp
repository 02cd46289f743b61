// Surfaces continued beyond their borders, or less than all of them (Golovanov 2016, 3.15): an analytic surface by its
// own law, any other along its tangents at the border,
//
//   r(u, v) = b + p b_u + q b_v + p q b_uv,   p = u - u_0, q = v - v_0
//
// b and its derivatives at u_0, v_0, the nearest parameters of its domain.
// The extension of an extension is one of the base.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/composition.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/derived/extended.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

double middle_of(double x) { return x; }
double middle_of(const Interval& x) { return x.middle(); }
template <class J>
auto middle_of(const J& x) {
  return middle_of(x.value());
}

template <class T>
struct Scalars {
  using Type = T;
};
template <class T>
requires requires { typename T::Scalar; }
struct Scalars<T> {
  using Type = typename T::Scalar;
};
// What a jet is of, or the number itself.
template <class T>
using ScalarOf = typename Scalars<T>::Type;

struct Extended {
  SurfacePtr of;
  Rectangle domain;  // of the extension

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    const Rectangle base = of->domain();
    const Side side_u = side_of(middle_of(u), base.u, domain.u), side_v = side_of(middle_of(v), base.v, domain.v);
    const T a = side_u.is_out ? T(side_u.border) : u, b = side_v.is_out ? T(side_v.border) : v;
    if (side_u.is_out && side_v.is_out) {
      const auto corner = [&](int i, int j) { return constant_at<T>(side_u.border, side_v.border, i, j); };
      const T p = u - a, q = v - b;
      return corner(0, 0) + p * corner(1, 0) + q * corner(0, 1) + (p * q) * corner(1, 1);
    }
    Triple<T> r = surface_at(*of, a, b);
    if (side_u.is_out) r += (u - a) * surface_at(*of, a, b, 1, 0);
    if (side_v.is_out) r += (v - b) * surface_at(*of, a, b, 0, 1);
    return r;
  }

  // The base's patches in the cells where they are.
  std::vector<SurfacePiece> rational_pieces(const std::vector<double>& breaks_u,
                                            const std::vector<double>& breaks_v) const {
    const auto form = of->as_nurbs();
    const Rectangle base = of->domain();
    std::vector<SurfacePiece> result;
    for (size_t i = 0; i + 1 < breaks_u.size(); ++i)
      for (size_t j = 0; j + 1 < breaks_v.size(); ++j) {
        const Rectangle cell{{breaks_u[i], breaks_u[i + 1]}, {breaks_v[j], breaks_v[j + 1]}};
        result.push_back(plain_piece(cell));
        if (!form || !base.u.contains(cell.u) || !base.v.contains(cell.v)) continue;
        const auto patches = bezier_pieces(*form, cell);
        if (patches.size() == 1) result.back() = patches.front();
      }
    return result;
  }

 private:
  // A derivative at a corner of the base, whose own derivatives are none.
  template <class T>
  Triple<T> constant_at(double u, double v, int i, int j) const {
    const auto d = surface_at(*of, ScalarOf<T>(u), ScalarOf<T>(v), i, j);
    return {T(d.x), T(d.y), T(d.z)};
  }
  // A cell of the extension lies on one side of the border: its middle tells where. At the border itself derivatives
  // are those from greater parameters, but at the extension's end.
  struct Side {
    bool is_out;
    double border;
  };
  static Side side_of(double at, const Interval& base, const Interval& whole) {
    if (at < base.lo) return {true, base.lo};
    return {at > base.hi || (at == base.hi && whole.hi > base.hi), base.hi};
  }
};

using ExtendedSurface = ComposedSurface<Extended>;

// A curve over a wider domain by its law; null where none is known.
CurvePtr longer(const CurvePtr& curve, const Interval& domain) {
  if (curve->domain().contains(domain)) return curve;
  if (dynamic_cast<const Segment*>(curve.get()))
    return with_domain(std::make_shared<Segment>(curve->point(domain.lo), curve->point(domain.hi)), domain);
  if (const auto* moved = dynamic_cast<const TransformedCurve*>(curve.get())) {
    const CurvePtr more = longer(moved->original(), domain);
    return more ? transformed(more, moved->map()) : nullptr;
  }
  return curve->continued(domain);
}

}  // namespace

SurfacePtr continued_by_law(const SurfacePtr& of, const Rectangle& domain) {
  const auto as = [&]<class S>(const S*) { return dynamic_cast<const S*>(of.get()); };
  if (const auto* plane = as((Plane*)nullptr)) return std::make_shared<Plane>(plane->frame(), domain);
  if (const auto* s = as((SphereSurface*)nullptr))
    return std::make_shared<SphereSurface>(s->frame(), s->radius(), domain);
  if (const auto* t = as((TorusSurface*)nullptr))
    return std::make_shared<TorusSurface>(t->frame(), t->major_radius(), t->minor_radius(), domain);
  if (const auto* c = as((CylinderSurface*)nullptr))
    return std::make_shared<CylinderSurface>(c->frame(), c->radius(), c->height(), domain);
  if (const auto* c = as((ConeSurface*)nullptr))
    return std::make_shared<ConeSurface>(c->frame(), c->radius(), c->top_radius(), c->height(), domain);
  if (const auto* f = as((FormulaSurface*)nullptr)) {
    const Periods periods = f->periods();
    const Rectangle own = f->domain();
    return std::make_shared<FormulaSurface>(
        f->formulas(), domain,
        FormulaSurface::Closed{periods.u > 0 && domain.u == own.u, periods.v > 0 && domain.v == own.v});
  }
  if (const auto* moved = as((TransformedSurface*)nullptr)) {
    const SurfacePtr more = continued_by_law(moved->original(), domain);
    return more ? transformed(more, moved->map()) : nullptr;
  }
  if (const auto* e = as((ExtrusionSurface*)nullptr)) {
    if (const CurvePtr more = longer(e->curve(), domain.u))
      return std::make_shared<ExtrusionSurface>(more, e->along(), domain);
  }
  if (const auto* r = as((RevolutionSurface*)nullptr)) {
    if (const CurvePtr more = longer(r->curve(), domain.u))
      return std::make_shared<RevolutionSurface>(more, r->axis(), domain);
  }
  return nullptr;
}

namespace {

std::shared_ptr<Surface> along_tangents(const SurfacePtr& of, const Rectangle& domain) {
  SurfaceProperties properties = properties_of(*of, 1);
  const auto cut = [](const Interval& whole, std::vector<double>& breaks) {
    std::vector<double> inside{whole.lo};
    for (const double x : breaks)
      if (x > whole.lo && x < whole.hi) inside.push_back(x);
    inside.push_back(whole.hi);
    breaks = inside;
  };
  const bool same_u = domain.u == properties.domain.u, same_v = domain.v == properties.domain.v;
  cut(domain.u, properties.breaks_u), cut(domain.v, properties.breaks_v);
  properties.domain = domain;
  if (!same_u) properties.periods.u = 0;
  if (!same_v) properties.periods.v = 0;
  return std::make_shared<ExtendedSurface>(Extended{of, domain}, properties);
}

// Both limits moved, those of a direction that is closed already not.
Interval moved(const Interval& of, double period, double before, double after, const char* direction) {
  if (!(of.width() < kInfinity) && (before != 0 || after != 0))
    throw FieldError("of", fmt::format("the surface is unbounded along {} already", direction), "leave it as it is");
  const Interval result(of.lo - before, of.hi + after);
  if (!(result.hi > result.lo))
    throw FieldError("after",
                     fmt::format("nothing is left along {}: {:.6g} to {:.6g}", direction, result.lo, result.hi),
                     "take less away");
  if (period > 0 && result.width() > period * (1 + 1e-12))
    throw FieldError("after",
                     fmt::format("along {} the surface closes after {:.6g}, and would cover itself", direction, period),
                     "extend it by less");
  return result;
}

std::any extended(const Fields& f) {
  SurfacePtr of = f.surface("of");
  const bool was_reversed = of->reversed();
  Rectangle domain = of->domain();
  if (const auto* inner = dynamic_cast<const ExtendedSurface*>(of.get())) of = inner->formula().of;
  const Periods periods = of->periods();
  domain.u = moved(domain.u, periods.u, f.u<double>("before"), f.u<double>("after"), "u");
  domain.v = moved(domain.v, periods.v, f.v<double>("before"), f.v<double>("after"), "v");
  std::shared_ptr<Surface> result;
  if (f.text("mode") == "law") try {
      result = std::const_pointer_cast<Surface>(continued_by_law(of, domain));
    } catch (const FieldError&) {
      throw;
    } catch (const std::invalid_argument& error) {
      throw FieldError("of", error.what(), "extend it by less, or along tangents (mode: tangent)");
    }
  if (!result) {
    if (!of->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
    result = along_tangents(of, domain);
  }
  result->set_reversed(was_reversed);
  return std::any(SurfacePtr(result));
}

}  // namespace

SurfacePtr extended_to(const SurfacePtr& given, const Rectangle& domain) {
  SurfacePtr of = given;
  if (const auto* inner = dynamic_cast<const ExtendedSurface*>(of.get())) of = inner->formula().of;
  std::shared_ptr<Surface> result = std::const_pointer_cast<Surface>(continued_by_law(of, domain));
  if (!result) result = along_tangents(of, domain);
  result->set_reversed(given->reversed());
  return result;
}

TypeDeclaration extended_surface_type() {
  return declare(Category::surface, "extended_surface",
                 "A surface with more, or less, of it at each border: planes, spheres, cones, tori, formulas, "
                 "extrusions and revolutions go on by their own law, others along their tangents. The parameters are "
                 "the surface's, "
                 "beyond its domain.")
      .example("of: { type: cylinder_surface, radius: 1, height: 2, domain: { u: [0, 2], v: [0, 1] } }, after: 0.5")
      .field("of", reference({Category::surface}), "the surface")
      .field("before", number().for_each_direction(),
             "how far the parameters go below the domain; negative: that much is cut off", "0")
      .field("after", number().for_each_direction(), "how far they go above it; negative: that much is cut off", "0")
      .field("mode", choice({"law", "tangent"}), "by its own law where it has one, or along its tangents in any case",
             "law")
      .built_by(extended);
}

}  // namespace lekalo::geometry
