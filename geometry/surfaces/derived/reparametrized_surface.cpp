// The points of a surface with other parameters (Golovanov 2016, 3.15; for curves 2.15):
//
//   r(a, b) = s(u(a), v(b)), or s(u(b), v(a)) with the parameters swapped
//
// u and v run evenly over a new domain, forward or backward, or by formulas.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"

namespace lekalo::geometry {

namespace {

// A parameter of the base as a monotone function of the new one, w in `range`.
struct ParameterLaw {
  Interval range, base;
  bool is_reversed = false;
  std::optional<ScalarLaw> formula;

  template <class T>
  T operator()(const T& w) const {
    if (formula) return (*formula)(w);
    if (range == base && !is_reversed) return w;
    const double factor = base.width() / range.width();
    return is_reversed ? base.hi - factor * (w - range.lo) : base.lo + factor * (w - range.lo);
  }
  // The new parameter of a place, by halving.
  double inverse(double place) const {
    Interval w = range;
    for (int k = 0; k < 60; ++k) (((*this)(w.middle()) < place) != is_reversed ? w.lo : w.hi) = w.middle();
    return w.middle();
  }
  // Whether a map from the parameter of a patch is one of the same kind for w.
  bool keeps(const ParameterMap& map) const {
    return map.kind == ParameterMap::Kind::affine || range.width() == base.width();
  }
  ParameterMap image(const ParameterMap& map) const {
    const double factor = range.width() / base.width();
    const auto at = [&](double t) { return range.lo + factor * (is_reversed ? base.hi - t : t - base.lo); };
    if (!is_reversed) return {map.kind, at(map.lo), at(map.hi), map.from, map.to};
    return {map.kind, at(map.hi), at(map.lo), 1 - map.to, 1 - map.from};
  }
  std::vector<double> lines(const std::vector<double>& of_base) const {
    std::vector<double> result;
    for (const double line : of_base) {
      const double w = line == base.lo   ? (is_reversed ? range.hi : range.lo)
                       : line == base.hi ? (is_reversed ? range.lo : range.hi)
                                         : inverse(line);
      result.push_back(w);
    }
    std::sort(result.begin(), result.end());
    return result;
  }
};

struct Reparametrized {
  SurfacePtr of;
  ParameterLaw u, v;
  bool is_swapped = false;

  template <class T>
  Triple<T> operator()(const T& a, const T& b) const {
    return surface_at(*of, u(is_swapped ? b : a), v(is_swapped ? a : b));
  }

  // The base's patches where the parameters run evenly; patches with angles for parameters where they are not
  // stretched.
  std::vector<SurfacePiece> rational_pieces(const std::vector<double>& breaks_a,
                                            const std::vector<double>& breaks_b) const {
    if (u.formula || v.formula) return {};
    std::vector<SurfacePiece> result;
    for (size_t i = 0; i + 1 < breaks_a.size(); ++i)
      for (size_t j = 0; j + 1 < breaks_b.size(); ++j)
        result.push_back(plain_piece({{breaks_a[i], breaks_a[i + 1]}, {breaks_b[j], breaks_b[j + 1]}}));
    for (const SurfacePiece& patch : of->pieces()) {
      if (!patch.is_rational() || !u.keeps(patch.map_u) || !v.keeps(patch.map_v)) return {};
      const double at_u = u.inverse(patch.domain.u.middle()), at_v = v.inverse(patch.domain.v.middle());
      for (SurfacePiece& piece : result)
        if (piece.domain.contains(is_swapped ? at_v : at_u, is_swapped ? at_u : at_v)) take(patch, piece);
    }
    return result;
  }

 private:
  void take(const SurfacePiece& patch, SurfacePiece& piece) const {
    const int p = patch.degree_u, q = patch.degree_v;
    piece.degree_u = is_swapped ? q : p, piece.degree_v = is_swapped ? p : q;
    (is_swapped ? piece.map_v : piece.map_u) = u.image(patch.map_u);
    (is_swapped ? piece.map_u : piece.map_v) = v.image(patch.map_v);
    piece.points.resize(patch.points.size());
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j) {
        const int k = u.is_reversed ? p - i : i, l = v.is_reversed ? q - j : j;
        piece.points[is_swapped ? l * (p + 1) + k : k * (q + 1) + l] = patch.points[i * (q + 1) + j];
      }
  }
};

void check_formula(const ParameterLaw& law, const char* field) {
  constexpr int kTried = 256;
  const double slack = 1e-12 * law.base.width();
  double before = -kInfinity;
  for (int k = 0; k <= kTried; ++k) {
    const double w = law.range.lo + law.range.width() * k / kTried, at = law(w);
    if (!(at > before))
      throw FieldError(field, fmt::format("it does not increase at w = {:.6g}", w), "it increases over the new domain");
    if (!(at >= law.base.lo - slack && at <= law.base.hi + slack))
      throw FieldError(field, fmt::format("at w = {:.6g} it is {:.6g}, beyond the surface's {:.6g} to {:.6g}", w, at,
                                          law.base.lo, law.base.hi));
    before = at;
  }
}

std::any reparametrized(const Fields& f) {
  const SurfacePtr of = f.surface("of");
  if (!of->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  Reparametrized formula{of, {}, {}, f.boolean("swap")};
  const Rectangle base = of->domain();
  const auto& reversed = f.get<std::vector<std::string>>("reverse");
  const auto is_reversed = [&](const char* word) { return std::count(reversed.begin(), reversed.end(), word) > 0; };
  formula.u = {base.u, base.u, is_reversed("u"), std::nullopt};
  formula.v = {base.v, base.v, is_reversed("v"), std::nullopt};
  if (f.has("domain")) {
    const Rectangle domain = f.rectangle("domain");
    formula.u.range = formula.is_swapped ? domain.v : domain.u;
    formula.v.range = formula.is_swapped ? domain.u : domain.v;
  }
  SurfaceProperties properties = properties_of(*of);
  for (const auto& [field, law, lines, period] :
       {std::tuple("u", &formula.u, &properties.breaks_u, &properties.periods.u),
        std::tuple("v", &formula.v, &properties.breaks_v, &properties.periods.v)}) {
    *period *= law->range.width() / law->base.width();
    if (f.has(field)) {
      if (law->is_reversed) throw FieldError(field, "a formula and 'reverse' do not mix", "leave one of them out");
      law->formula = ScalarLaw(f.get<Expression>(field));
      check_formula(*law, field);
      *period = 0;
      law->base = {(*law)(law->range.lo), (*law)(law->range.hi)};
      std::vector<double> inside{law->base.lo};
      for (const double line : *lines)
        if (line > law->base.lo && line < law->base.hi) inside.push_back(line);
      inside.push_back(law->base.hi);
      *lines = inside;
    }
    *lines = law->lines(*lines);
  }
  properties.domain = {formula.u.range, formula.v.range};
  if (formula.is_swapped) {
    std::swap(properties.domain.u, properties.domain.v);
    std::swap(properties.breaks_u, properties.breaks_v);
    std::swap(properties.periods.u, properties.periods.v);
  }
  auto result = std::make_shared<ComposedSurface<Reparametrized>>(formula, properties);
  result->set_reversed(of->reversed());
  return std::any(SurfacePtr(result));
}

}  // namespace

TypeDeclaration reparametrized_surface_type() {
  return declare(
             Category::surface, "reparametrized_surface",
             "The points of a surface with other parameters: swapped, run through backward, over another domain, or "
             "by formulas. The normal is that of the new parameters: it turns where they are swapped, or one is "
             "reversed.")
      .example("of: { type: sphere_surface, radius: 1 }, swap: true")
      .field("of", reference({Category::surface}), "the surface; bounded")
      .field("swap", boolean(), "the first parameter is the surface's v, the second its u", "false")
      .field("reverse", words({"u", "v"}), "the surface's parameters that are run through backward", "[]")
      .optional("domain", rectangle(), "of the new parameters; the surface's own are stretched evenly over it")
      .optional("u", formula({"w"}), "the surface's u as an increasing formula of the new parameter w")
      .optional("v", formula({"w"}), "its v")
      .built_by(reparametrized);
}

}  // namespace lekalo::geometry
