#include "geometry/queries/contours/contours_of_function.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry/curves/operations/creases.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/contour_assembly.h"
#include "geometry/queries/implicit_curves/surface_tips.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

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
struct PartsBetweenCreases {
  std::map<std::array<size_t, 2>, std::vector<SurfacePiece>> parts;
  Periods periods;
};
PartsBetweenCreases parts_between_creases(const Surface& surface) {
  PartsBetweenCreases result;
  result.periods = closed_periods(surface);
  std::array<std::vector<double>, 2> cuts;
  for (const Crease& crease : creases(surface, kJump)) {
    const bool u = crease.held == IsoDirection::u;
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
  std::vector<SurfacePiece> pieces = between_poles(surface);
  // A crease may end inside of a piece's side, and its line go on through larger pieces.
  for (size_t k = 0; k < pieces.size(); ++k)
    for (const auto side : {&Rectangle::u, &Rectangle::v}) {
      const std::vector<double>& at = cuts[side == &Rectangle::u ? 0 : 1];
      const size_t first = before(at, (pieces[k].domain.*side).lo);
      if (first == at.size() || !(at[first] < (pieces[k].domain.*side).hi)) continue;
      pieces.push_back(pieces[k]);
      (pieces[k].domain.*side).hi = (pieces.back().domain.*side).lo = at[first];
    }
  for (SurfacePiece& piece : pieces)
    result.parts[{before(cuts[0], piece.domain.u.lo), before(cuts[1], piece.domain.v.lo)}].push_back(std::move(piece));
  return result;
}

// Whether the part of a surface goes on beyond the upper border of a piece.
std::array<bool, 2> goes_on(const Rectangle& part, const Periods& periods, const Rectangle& piece) {
  return {piece.u.hi < part.u.hi || periods.u > 0, piece.v.hi < part.v.hi || periods.v > 0};
}
Rectangle around(const std::vector<SurfacePiece>& pieces) {
  Rectangle all = pieces.front().domain;
  for (const SurfacePiece& piece : pieces) all = {hull(all.u, piece.domain.u), hull(all.v, piece.domain.v)};
  return all;
}

// The tips through which a contour goes.
std::vector<Vec2> tips_on(const Surface& surface, const SurfaceFunction& function, double size) {
  std::vector<Vec2> tips = surface_tips(surface);
  std::erase_if(tips, [&](const Vec2& tip) {
    const Vec3 p = surface.point(tip.x, tip.y);
    const Triple<Jet<double, 1>> s{p.x, p.y, p.z};
    return std::abs(function.slopes(s, s, s).c[0]) > kSamePoint * size;
  });
  return tips;
}

}  // namespace

void demand_bounded(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
}

Vec3 unit(const Vec3& v, const char* message) {
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument(message);
  return v / length;
}

ViewOf checked(ViewOf view) {
  if (!view.central) view.direction_or_eye = unit(view.direction_or_eye, "the direction of sight has no length");
  return view;
}

std::array<bool, 2> goes_on(const Surface& surface, const Rectangle& piece) {
  return goes_on(surface.domain(), closed_periods(surface), piece);
}

Contours contours_of(const SurfacePtr& surface, const SurfaceFunction& function, const IsLeftOut& is_left_out) {
  const double size = std::max(bounds(*surface).diameter(), 1e-300);
  PartsBetweenCreases smooth;
  if (function.needs_tangents)
    smooth = parts_between_creases(*surface);
  else
    smooth = {{{{0, 0}, pieces_about_tips(*surface, tips_on(*surface, function, size))}}, closed_periods(*surface)};
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

}  // namespace lekalo::geometry
