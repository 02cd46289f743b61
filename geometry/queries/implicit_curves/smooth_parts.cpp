#include "geometry/queries/implicit_curves/smooth_parts.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "geometry/curves/operations/creases.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/describe.h"
#include "geometry/expression/branches.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// So far beside a line, of the domain, the part on its other side is looked for.
constexpr double kBeside = 1e-6;
// Parts farther from each other than this share of their size do not meet.
constexpr double kStep = 1e-7;
// So far beyond a border, of the domain, a place is on it.
constexpr double kRounding = 1e-12;
constexpr double kPlaces[] = {0.05, 0.23, 0.5, 0.81, 0.97};

Box3 around(const Rectangle& domain) { return {{domain.u.lo, domain.v.lo, 0}, {domain.u.hi, domain.v.hi, 0}}; }

std::optional<std::vector<ExpressionBranch>> branches_of(const FormulaSurface& surface) {
  const std::array ranges{surface.domain().u, surface.domain().v};
  return expression_branches(surface.formulas().formulas(), ranges);
}

bool may_step(const Surface& surface) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(&surface)) return may_step(*moved->original());
  const auto* whole = dynamic_cast<const FormulaSurface*>(&surface);
  if (!whole || !have_steps(whole->formulas().formulas())) return false;
  const auto branches = branches_of(*whole);
  return !branches || branches->size() > 1;
}

}  // namespace

std::vector<SmoothPart> smooth_parts(const SurfacePtr& surface) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    std::vector<SmoothPart> parts = smooth_parts(moved->original());
    if (parts.size() == 1) return {{surface, {}}};
    for (SmoothPart& part : parts) part.surface = transformed(part.surface, moved->map());
    return parts;
  }
  const auto* whole = dynamic_cast<const FormulaSurface*>(surface.get());
  if (!whole) return {{surface, {}}};
  const auto branches = branches_of(*whole);
  if (!branches || branches->size() == 1) return {{surface, {}}};
  const Rectangle domain = whole->domain();
  std::vector<SmoothPart> parts;
  for (const ExpressionBranch& branch : *branches) {
    SmoothPart part;
    for (const ExpressionBranch::Side& side : branch.sides)
      part.sides.push_back({std::make_shared<ImplicitFormula>(side.height, 0), side.positive, Affine()});
    if (!may_hold(part.sides, around(domain))) continue;
    const auto& f = branch.formulas;
    try {
      const auto one = std::make_shared<FormulaSurface>(
          PointFormulas({f[0], f[1], f[2]}, whole->formulas().coordinates(), whole->formulas().variables()), domain,
          FormulaSurface::Closed{});
      one->set_reversed(whole->reversed());
      part.surface = one;
    } catch (const FieldError&) {
      return {{surface, {}}};
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

bool is_in(const SmoothPart& part, double u, double v) {
  const Rectangle domain = part.surface->domain();
  const Vec3 at(u, v, 0), slack(kRounding * domain.u.width(), kRounding * domain.v.width(), 0);
  return std::all_of(part.sides.begin(), part.sides.end(), [&](const ImplicitSide& side) {
    const double value = side.value(at);
    return value >= 0 || value >= -glm::dot(slack, glm::abs(side.height->gradient(at)));
  });
}

FreeCreases free_creases(const std::vector<SmoothPart>& parts) {
  FreeCreases found;
  if (parts.size() < 2) return found;
  const Rectangle domain = parts[0].surface->domain();
  const ImplicitRegion region{around(domain)};
  const double beside = kBeside * region.box.diameter();
  const auto add = [&](int on, const ImplicitFormula& height, const CurvePtr& image) {
    FreeCrease line{image, {on, -1}};
    const Interval t = image->domain();
    bool is_sharp = false;
    for (const double share : kPlaces) {
      const Vec3 at = image->point(t.lo + share * t.width());
      const Vec3 up = height.gradient(at);
      if (!(glm::length(up) > 0)) continue;
      const Vec3 below = at - beside / glm::length(up) * up;
      const auto other =
          std::find_if(parts.begin(), parts.end(), [&](const SmoothPart& one) { return hold(one.sides, below); });
      if (other == parts.end()) continue;
      line.parts[1] = static_cast<int>(other - parts.begin());
      const auto part = [&](int k) -> const Surface& { return *parts[static_cast<size_t>(line.parts[k])].surface; };
      const auto normal = [&](int k) { return part(k).normal(at.x, at.y); };
      const SurfaceJet here = part(0).evaluate(at.x, at.y, 1);
      const double size = glm::length(here.du()) * domain.u.width() + glm::length(here.dv()) * domain.v.width();
      line.step = line.step || glm::length(here.point() - part(1).point(at.x, at.y)) > kStep * size;
      is_sharp = is_sharp || glm::length(normal(0) - normal(1)) > kSmoothEdge;
    }
    if (line.parts[1] < 0) found.complete = false;
    if (is_sharp || line.step) found.lines.push_back(std::move(line));
  };
  for (size_t on = 0; on < parts.size(); ++on)
    for (size_t k = 0; k < parts[on].sides.size(); ++k) {
      const ImplicitSide& side = parts[on].sides[k];
      if (!side.positive) continue;  // that is another part's
      const ImplicitArcs arcs = implicit_arcs(*side.height, region, Frame(), domain.u, domain.v);
      if (!arcs.complete) found.complete = false;
      std::vector<ImplicitSide> others = parts[on].sides;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      for (const ImplicitArc& arc : arcs.arcs)
        each_kept(*arc.curve, arc.closed, others, [&](const Interval& t) {
          add(static_cast<int>(on), *side.height, t == arc.curve->domain() ? arc.curve : stretch(arc.curve, t));
        });
    }
  return found;
}

SteppedParts parts_between_steps(const SurfacePtr& surface) {
  if (!may_step(*surface)) return {};
  std::vector<SmoothPart> parts = smooth_parts(surface);
  const FreeCreases found = free_creases(parts);
  if (parts.size() == 1 || !found.complete) return {{}, false};
  if (std::none_of(found.lines.begin(), found.lines.end(), [](const FreeCrease& line) { return line.step; })) return {};
  return {std::move(parts), true};
}

void demand_known(const SteppedParts& stepped) {
  if (!stepped.known)
    throw std::invalid_argument(
        "the formulas of the surface may step, in places that are not known: branches without values beyond them, or "
        "too "
        "many; give each branch as a surface of its own");
}

}  // namespace lekalo::geometry
