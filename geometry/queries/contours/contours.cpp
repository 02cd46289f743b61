#include "geometry/queries/contours/contours.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "geometry/curves/operations/creases.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_assembly.h"
#include "geometry/queries/contours/picture_cusps.h"
#include "geometry/queries/implicit_curves/implicit_branches.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

void demand_bounded(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
}

Triple<double> triple(const Vec3& v) { return {v.x, v.y, v.z}; }

// Where the normal jumps by more, contours that depend on it do not go on.
constexpr double kJump = 1e-7;

// Near a pole functions of the tangents are divided by what vanishes there
// (geometry/queries/contours/contour_equations.h): by one thing in each parameter, so that a piece between two poles is
// cut. Not in the middle: surfaces are symmetric, and contours would run along the cut.
constexpr double kCutBetweenPoles = 0.4871;

std::vector<SurfacePiece> between_poles(const Surface& surface) {
  std::vector<SurfacePiece> pieces = surface.pieces();
  const DegenerateEdges poles = surface.degenerate_edges();
  const Rectangle all = surface.domain();
  const auto cut = [&](Interval Rectangle::*side) {
    for (size_t k = 0; k < pieces.size(); ++k) {
      const Interval whole = pieces[k].domain.*side;
      if (whole != all.*side) continue;
      const double at = whole.lo + kCutBetweenPoles * whole.width();
      pieces.push_back(pieces[k]);
      pieces[k].domain.*side = {whole.lo, at};
      pieces.back().domain.*side = {at, whole.hi};
    }
  };
  if (poles.u_min && poles.u_max) cut(&Rectangle::u);
  if (poles.v_min && poles.v_max) cut(&Rectangle::v);
  return pieces;
}

// The pieces between creases, those of each part together; and what of the surface closes within a part.
struct SmoothParts {
  std::map<std::array<size_t, 2>, std::vector<SurfacePiece>> parts;
  Periods periods;
};
SmoothParts smooth_parts(const Surface& surface) {
  SmoothParts result;
  result.periods = closed_periods(surface);
  std::array<std::vector<double>, 2> cuts;
  for (const Crease& crease : creases(surface, kJump)) {
    const bool u = crease.held == HeldParameter::u;
    (u ? result.periods.u : result.periods.v) = 0;
    if (!crease.seam) cuts[u ? 0 : 1].push_back(crease.at);
  }
  for (auto& at : cuts) {
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
  }
  const auto before = [](const std::vector<double>& at, double lo) {
    return static_cast<size_t>(std::upper_bound(at.begin(), at.end(), lo) - at.begin());
  };
  for (SurfacePiece& piece : between_poles(surface))
    result.parts[{before(cuts[0], piece.domain.u.lo), before(cuts[1], piece.domain.v.lo)}].push_back(std::move(piece));
  return result;
}

// Whether the part of a surface goes on beyond the upper border of a piece.
std::array<bool, 2> goes_on(const Rectangle& part, const Periods& periods, const Rectangle& piece) {
  return {piece.u.hi < part.u.hi || periods.u > 0, piece.v.hi < part.v.hi || periods.v > 0};
}
std::array<bool, 2> goes_on(const Surface& surface, const Rectangle& piece) {
  return goes_on(surface.domain(), closed_periods(surface), piece);
}

Rectangle around(const std::vector<SurfacePiece>& pieces) {
  Rectangle all = pieces.front().domain;
  for (const SurfacePiece& piece : pieces) all = {hull(all.u, piece.domain.u), hull(all.v, piece.domain.v)};
  return all;
}

using IsLeftOut = std::function<bool(const Rectangle& piece)>;

// Those of smooth parts end at the creases between them. A part all of whose pieces are left out has none.
Contours contours_of(const SurfacePtr& surface, const SurfaceFunction& function, const IsLeftOut& is_left_out = {}) {
  const double size = std::max(bounds(*surface).diameter(), 1e-300);
  SmoothParts smooth;
  if (function.needs_tangents)
    smooth = smooth_parts(*surface);
  else
    smooth = {{{{0, 0}, surface->pieces()}}, closed_periods(*surface)};
  Contours result;
  for (const auto& [place, pieces] : smooth.parts) {
    if (is_left_out &&
        std::all_of(pieces.begin(), pieces.end(), [&](const SurfacePiece& piece) { return is_left_out(piece.domain); }))
      continue;
    ContourAssembly<2> assembly(size, kSamePoint * size, {smooth.periods.u, smooth.periods.v});
    const Rectangle part = around(pieces);
    for (const SurfacePiece& piece : pieces) {
      PieceSearch<2> search;
      search.left_to_neighbour = goes_on(part, smooth.periods, piece.domain);
      assembly.add(function_equations(surface, piece.domain, function), search);
    }
    Contours found = assembly.joined();
    std::move(found.branches.begin(), found.branches.end(), std::back_inserter(result.branches));
    std::move(found.points.begin(), found.points.end(), std::back_inserter(result.points));
    result.coincident = result.coincident || found.coincident;
    result.complete = result.complete && found.complete;
  }
  return result;
}

// From the eye to the point, or the direction of sight.
template <class T>
Triple<T> sight(const ViewOf& view, const Triple<T>& s) {
  const Triple<double> from = triple(view.direction_or_eye);
  if (view.central) return s - from;
  return {T(from.x), T(from.y), T(from.z)};
}

Vec3 unit(const Vec3& v, const char* what) {
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument(what);
  return v / length;
}

ViewOf checked(ViewOf view) {
  if (!view.central) view.direction_or_eye = unit(view.direction_or_eye, "the direction of sight has no length");
  return view;
}

}  // namespace

Measured contour_length(const Contour& contour, const Interval& t) {
  if (const Interval all = contour.curve->domain(); contour.closed && t.hi > all.hi) {
    const Measured first = contour_length(contour, {t.lo, all.hi}),
                   rest = contour_length(contour, {all.lo, t.hi - all.width()});
    return {first.value + rest.value, first.error + rest.error};
  }
  if (!is_searched(*contour.curve)) return arc_length(*contour.curve, t.lo, t.hi);
  static const GaussRule coarse = gauss_legendre(6), fine = gauss_legendre(9);
  Measured sum;
  for (const CurvePiece& piece : contour.curve->pieces()) {
    const Interval part = intersect(t, piece.domain);
    if (!(part.width() > 0)) continue;
    const auto by = [&](const GaussRule& rule) {
      double length = 0;
      for (size_t k = 0; k < rule.nodes.size(); ++k)
        length += 0.5 * part.width() * rule.weights[k] *
                  glm::length(contour.curve->evaluate(part.middle() + 0.5 * part.width() * rule.nodes[k], 1).d[1]);
      return length;
    };
    const double length = by(fine);
    sum.value += length;
    sum.error += std::abs(length - by(coarse)) + 1e-16 * length;
  }
  return sum;
}

Contours intersect(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  for (const bool swapped : {false, true}) {
    const auto* plane = dynamic_cast<const Plane*>(swapped ? a.get() : b.get());
    const SurfacePtr& other = swapped ? b : a;
    if (plane && !plane->bounded() && other->bounded())
      return plane_section(other, plane->frame().origin, plane->frame().z);
  }
  demand_bounded(*a);
  demand_bounded(*b);
  Box3 all = bounds(*a);
  all.include(bounds(*b));
  const double size = std::max(all.diameter(), 1e-300);
  if (auto exact = closed_intersection(a, b, tolerance * size)) return *exact;
  const Periods of_a = closed_periods(*a), of_b = closed_periods(*b);
  ContourAssembly<4> assembly(size, tolerance * size, {of_a.u, of_a.v, of_b.u, of_b.v});
  const std::vector<SurfacePiece> pieces_a = a->pieces(), pieces_b = b->pieces();
  std::vector<Box3> boxes_b;
  for (const SurfacePiece& piece : pieces_b) boxes_b.push_back(bounds(*b, piece));
  const BoxTree tree_b(boxes_b);
  for (const SurfacePiece& piece_a : pieces_a)
    tree_b.around(bounds(*a, piece_a).inflated(tolerance * size), [&](int k) {
      const std::array<bool, 2> in_a = goes_on(*a, piece_a.domain), in_b = goes_on(*b, pieces_b[k].domain);
      PieceSearch<4> search;
      search.left_to_neighbour = {in_a[0], in_a[1], in_b[0], in_b[1]};
      assembly.add(meeting_equations(a, piece_a.domain, b, pieces_b[k].domain), search);
    });
  return assembly.joined();
}

namespace {

// The functions that vanish on contours; made once what they take has been checked.

SurfaceFunction height_over(const Triple<double>& origin, const Triple<double>& normal) {
  SurfaceFunction height = {false, [=](const auto& s, const auto&, const auto&) { return dot(normal, s - origin); }};
  height.plane = Vec3(normal.x, normal.y, normal.z);
  return height;
}

SurfaceFunction outline(const ViewOf& view) {
  return {true,
          [view](const auto& s, const auto& s_u, const auto& s_v) { return dot(sight(view, s), cross(s_u, s_v)); }};
}

SurfaceFunction lit_alike(const Triple<double>& direction, double cosine) {
  return {true, [=](const auto&, const auto& s_u, const auto& s_v) {
            const auto n = cross(s_u, s_v);
            return dot(direction, n) - cosine * length(n);
          }};
}

// d = i - 2 (i . n) n / n^2 for the way of sight i; it meets the lamp p + x l where (s - p) x l . d = 0.
SurfaceFunction mirrored(const ViewOf& view, const Triple<double>& p, const Triple<double>& l) {
  return {true, [=](const auto& s, const auto& s_u, const auto& s_v) {
            const auto n = cross(s_u, s_v);
            const auto i = sight(view, s);
            const auto d = dot(n, n) * i - (2.0 * dot(i, n)) * n;
            return dot(cross(s - p, l), d);
          }};
}

}  // namespace

Contours plane_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal) {
  demand_bounded(*surface);
  const Vec3 n = unit(normal, "the normal of the plane has no length");
  if (auto exact = closed_section(surface, origin, n, kSamePoint * bounds(*surface).diameter())) return *exact;
  return contours_of(surface, height_over(triple(origin), triple(n)));
}

// What of a contour the sides of a branch leave.
static void add_kept(const Contour& whole, const std::vector<ImplicitSide>& sides, const Affine& to_formula,
                     std::vector<Contour>& kept) {
  if (sides.empty()) return kept.push_back(whole);
  const CurvePtr simple = contour_approximation(whole.curve);
  each_kept(*transformed(simple, to_formula), false, sides, [&](const Interval& t) {
    Contour part = whole;
    if (t != whole.curve->domain()) {
      part.closed = false;
      part.curve = std::make_shared<CurvePart>(whole.curve, t);
      for (Curve2Ptr& image : part.images) image = std::make_shared<CurvePart>(image, t);
      std::erase_if(part.cusps, [&](double cusp) { return !t.contains(cusp); });
    }
    kept.push_back(std::move(part));
  });
}

static Contours smooth_level_section(const SurfacePtr& surface, const ImplicitFormula& formula,
                                     const Affine& to_formula) {
  // Divided by what it changes over a length, so that its values are about distances.
  constexpr int kSteps = 8;
  const Rectangle domain = surface->domain();
  double most = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Vec3 p =
          surface->point(domain.u.lo + domain.u.width() * i / kSteps, domain.v.lo + domain.v.width() * j / kSteps);
      const double slope = glm::length(glm::transpose(to_formula.linear) * formula.gradient(to_formula.point(p)));
      if (std::isfinite(slope)) most = std::max(most, slope);
    }
  const double by = most > 0 ? 1 / most : 1;
  const auto value = [formula, m = to_formula.linear, o = to_formula.offset, by](const auto& s, const auto&,
                                                                                 const auto&) {
    using T = std::decay_t<decltype(s.x)>;
    const auto coordinate = [&](int k) -> T { return s.x * m[0][k] + s.y * m[1][k] + s.z * m[2][k] + o[k]; };
    return T(formula(coordinate(0), coordinate(1), coordinate(2)) * by);
  };
  Contours found = contours_of(surface, {false, value});
  if (formula.smoothness() != Expression::Smoothness::smooth) found.complete = false;
  return found;
}

Contours level_section(const SurfacePtr& surface, const ImplicitFormula& formula, const Affine& to_formula) {
  demand_bounded(*surface);
  Contours all;
  for (const ImplicitBranch& branch : implicit_branches(formula, transformed(bounds(*surface), to_formula))) {
    Contours found = smooth_level_section(surface, *branch.formula, to_formula);
    all.points.insert(all.points.end(), found.points.begin(), found.points.end());
    all.coincident = all.coincident || found.coincident;
    all.complete = all.complete && found.complete;
    for (const Contour& contour : found.branches) add_kept(contour, branch.sides, to_formula, all.branches);
  }
  return all;
}

// Whether the way of sight runs in the surface everywhere in a part of its domain: a cylinder along its axis, a cone
// from its tip, a facet. All that is seen of it are its borders.
static bool is_edge_on(const Surface& surface, const Rectangle& part, const ViewOf& view) {
  constexpr int kSteps = 6;
  constexpr double kFlat = 1e-12;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = part.u.lo + part.u.width() * (i + 0.5) / kSteps,
                   v = part.v.lo + part.v.width() * (j + 0.5) / kSteps;
      const Vec3 sight = view.central ? surface.point(u, v) - view.direction_or_eye : view.direction_or_eye;
      if (std::abs(glm::dot(surface.normal(u, v), sight)) > kFlat * glm::length(sight)) return false;
    }
  return true;
}

Contours silhouette(const SurfacePtr& surface, const ViewOf& given) {
  demand_bounded(*surface);
  const ViewOf view = checked(given);
  if (is_edge_on(*surface, surface->domain(), view)) return {};
  if (auto exact = closed_silhouette(surface, view, kSamePoint * bounds(*surface).diameter())) return *exact;
  Contours found =
      contours_of(surface, outline(view), [&](const Rectangle& piece) { return is_edge_on(*surface, piece, view); });
  for (Contour& contour : found.branches) contour.cusps = picture_cusps(*surface, contour, view);
  return found;
}

Contours isophote(const SurfacePtr& surface, const Vec3& direction, double angle) {
  demand_bounded(*surface);
  if (!(angle > 0 && angle < kPi))
    throw std::invalid_argument("the angle of an isophote lies between 0 and 180 degrees");
  const Vec3 d = unit(direction, "the direction of the light has no length");
  return contours_of(surface, lit_alike(triple(d), surface->normal_sign() * std::cos(angle)));
}

Contours reflection_line(const SurfacePtr& surface, const ViewOf& given, const Line& lamp) {
  demand_bounded(*surface);
  const ViewOf view = checked(given);
  const Vec3 l = unit(lamp.direction, "the lamp has no direction");
  return contours_of(surface, mirrored(view, triple(lamp.origin), triple(l)));
}

}  // namespace lekalo::geometry
