// A surface by its formulas (Golovanov 2016, 3.1): r(u, v) = point(f(u, v), g(u, v), h(u, v)).
#include "geometry/surfaces/analytic/formula_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/describe.h"
#include "geometry/expression/branches.h"
#include "geometry/formula.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places along each direction where the formulas are tried before anything else asks.
constexpr int kTried = 32;
// As of formula curves: parts of the domain down to this are taken in halves where bounds are infinite or enormous.
constexpr double kMinHalved = 1.0 / 16;
constexpr double kEnormous = 8;

double place(const Interval& range, int i) { return i == kTried ? range.hi : range.lo + range.width() * i / kTried; }

const std::vector<std::string> kVariables{"u", "v"};

}  // namespace

FormulaSurface::FormulaSurface(PointFormulas point_formulas, const Rectangle& domain, Closed closed)
    : point_(std::move(point_formulas)), domain_(domain) {
  for (const Interval& side : {domain.u, domain.v})
    if (!(side.width() > 0 && side.width() < kInfinity))
      throw FieldError("domain", "the domain of a surface of formulas must be finite and not empty");
  Box3 box;
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const double u = place(domain.u, i), v = place(domain.v, j);
      const Vec3 p = point(u, v);
      if (!is_finite(p)) throw FieldError("domain", point_.no_value({{u, v}}));
      box.include(p);
    }
  const double same = kClosedCurve * box.diameter();
  // The largest distance between places along u (or v) that two functions of it give.
  const auto farthest = [&](const Interval& range, auto a, auto b) {
    double result = 0;
    for (int i = 0; i <= kTried; ++i) result = std::max(result, glm::length(a(place(range, i)) - b(place(range, i))));
    return result;
  };
  const auto at_u = [&](double u) { return [this, u](double v) { return point(u, v); }; };
  const auto at_v = [&](double v) { return [this, v](double u) { return point(u, v); }; };
  const auto refuse = [](const char* direction) {
    throw FieldError(
        "closed", std::string("the surface is not closed along ") + direction + ": its edges there are not the same");
  };
  if (closed.u && farthest(domain.v, at_u(domain.u.lo), at_u(domain.u.hi)) > same) refuse("u");
  if (closed.v && farthest(domain.u, at_v(domain.v.lo), at_v(domain.v.hi)) > same) refuse("v");
  const auto is_point = [&](const Interval& range, auto edge) {
    const Vec3 first = edge(range.lo);
    return farthest(range, edge, [&](double) { return first; }) <= kCollapsedEdge * box.diameter();
  };
  degenerate_ = {is_point(domain.v, at_u(domain.u.lo)), is_point(domain.v, at_u(domain.u.hi)),
                 is_point(domain.u, at_v(domain.v.lo)), is_point(domain.u, at_v(domain.v.hi))};
  const auto branches = expression_branches(point_.formulas());
  has_branches_ = !branches || branches->size() > 1;
  closed_ = closed;
  size_ = box.diameter();
}

SurfaceJet FormulaSurface::evaluate(double u, double v, int order) const {
  if (closed_.u) u = wrapped(u, domain_.u);
  if (closed_.v) v = wrapped(v, domain_.v);
  return evaluate_surface_formula(point_, u, v, order);
}

SurfaceEnclosure FormulaSurface::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure whole = enclose_surface_centered(point_, box, order);
  if (has_branches_) {  // centered forms do not hold over kinks
    const SurfaceEnclosure plain = enclose_surface_formula(point_, box, std::min(order, 1));
    for (int k = 0; k <= SurfaceJet::index(0, std::min(order, 1)); ++k) whole.values[k] = plain.values[k];
  }
  const int count = SurfaceJet::index(0, order) + 1;
  const double share_u = box.u.width() / domain_.u.width(), share_v = box.v.width() / domain_.v.width();
  const auto is_good = [&] {
    return whole.d(0, 0).diameter() <= kEnormous * size_ &&
           std::all_of(whole.values.begin(), whole.values.begin() + count, [](const Box3& b) { return b.bounded(); });
  };
  if (!(std::max(share_u, share_v) > kMinHalved) || is_good()) return whole;
  Rectangle below = box, above = box;
  if (share_u >= share_v)
    below.u.hi = above.u.lo = box.u.middle();
  else
    below.v.hi = above.v.lo = box.v.middle();
  whole = enclose(below, order);
  const SurfaceEnclosure other = enclose(above, order);
  for (int k = 0; k < count; ++k) whole.values[k].include(other.values[k]);
  return whole;
}

TypeDeclaration formula_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "formula_surface",
              "Surface given by formulas of its parameters u and v; the normal is r_u x r_v. Formulas must be smooth "
              "inside the domain but for kinks of abs, min, max, clamp and `if`, which are creases, steps of floor, "
              "ceil, round, mod, sign and `if`, whose two edges have no wall between them, and places where a root or "
              "power of zero has no derivatives, as the tip of sqrt(u^2 + v^2); surfaces may meet themselves and have "
              "poles, cusps and pinch points.");
  type.example("point: [u*cos(v), u*sin(v), 0.4*v], domain: { u: [-1, 1], v: [0, 2*pi] }");
  declare_formulas(type, kVariables);
  type.field("domain", rectangle(), "of u and v, or of x and y");
  type.field("closed", boolean().for_each_direction(), "the opposite edges are one, and the parameter wraps", "false");
  return type.built_by([](const Fields& f) {
    return FormulaSurface(read_formulas(f, kVariables), f.rectangle("domain"),
                          {f.u<bool>("closed"), f.v<bool>("closed")});
  });
}

}  // namespace lekalo::geometry
