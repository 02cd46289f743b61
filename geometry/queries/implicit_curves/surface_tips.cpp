#include "geometry/queries/implicit_curves/surface_tips.h"

#include <algorithm>

#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Boxes are halved down to this part of the domain; those that remain at one tip are nearer to each other than kOne.
constexpr double kMinBox = 1e-12, kOne = 1e-9;
// More boxes of one size hold a line, not points.
constexpr size_t kMaxBoxes = 64;

bool has_bounded_derivatives(const Surface& surface, const Rectangle& box) {
  const SurfaceEnclosure s = surface.enclose(box, 1);
  return s.d(1, 0).bounded() && s.d(0, 1).bounded();
}

}  // namespace

std::vector<Vec2> surface_tips(const Surface& surface) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(&surface)) return surface_tips(*moved->original());
  if (!dynamic_cast<const FormulaSurface*>(&surface)) return {};
  const Rectangle domain = surface.domain();
  const auto is_small = [&](const Rectangle& box) {
    return box.u.width() <= kMinBox * domain.u.width() && box.v.width() <= kMinBox * domain.v.width();
  };
  std::vector<Rectangle> level{domain};
  while (!level.empty() && !is_small(level.front())) {
    std::vector<Rectangle> next;
    for (const Rectangle& box : level) {
      if (has_bounded_derivatives(surface, box)) continue;
      for (const Interval& u : {Interval(box.u.lo, box.u.middle()), Interval(box.u.middle(), box.u.hi)})
        for (const Interval& v : {Interval(box.v.lo, box.v.middle()), Interval(box.v.middle(), box.v.hi)})
          next.push_back({u, v});
    }
    if (next.size() > kMaxBoxes) return {};
    level.swap(next);
  }
  std::vector<Vec2> tips;
  for (const Rectangle& box : level) {
    if (has_bounded_derivatives(surface, box)) continue;
    // Corners of the boxes are what formulas are written for: zero, not a number beside it.
    const Vec2 at(box.u.contains(0) ? 0 : box.u.lo, box.v.contains(0) ? 0 : box.v.lo);
    const auto is_same = [&](const Vec2& other) {
      return std::abs(other.x - at.x) <= kOne * domain.u.width() && std::abs(other.y - at.y) <= kOne * domain.v.width();
    };
    if (std::none_of(tips.begin(), tips.end(), is_same)) tips.push_back(at);
  }
  return tips;
}

std::vector<SurfacePiece> pieces_about_tips(const Surface& surface, const std::vector<Vec2>& tips) {
  std::vector<SurfacePiece> pieces = surface.pieces();
  const auto cut = [&](Interval Rectangle::*side, double at) {
    for (size_t k = 0, count = pieces.size(); k < count; ++k) {
      const Interval whole = pieces[k].domain.*side;
      if (!(whole.lo < at && at < whole.hi)) continue;
      pieces.push_back(pieces[k]);
      pieces[k].domain.*side = {whole.lo, at};
      pieces.back().domain.*side = {at, whole.hi};
    }
  };
  for (const Vec2& tip : tips) cut(&Rectangle::u, tip.x), cut(&Rectangle::v, tip.y);
  return pieces;
}

}  // namespace lekalo::geometry
