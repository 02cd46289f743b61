#include "geometry/shapes/tube/tube_cutting.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/shapes/tube/ball_circles.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlacesOfTurns = 64;
// Parts of half a stretch by which its end is moved.
constexpr double kFirstStep = 1e-14, kLongestStep = 0.01;

double settled(const TubeLine& line, double end, double inside) {
  const auto is_exposed = [&](double t) { return line.is_exposed(t, 0.5 * kBesideBalls); };
  // From half as far outside more of the line is seen to be bare, or less.
  const bool more = is_exposed(end);
  const double way = more ? end - inside : inside - end;
  double from = end, to = end;
  for (double step = kFirstStep * way; to == end; step *= 2) {
    if (std::abs(step) > kLongestStep * std::abs(way) || !line.curve->domain().contains(end + step)) return end;
    if (is_exposed(end + step) != more) to = end + step;
  }
  for (double middle = 0.5 * (from + to); std::min(from, to) < middle && middle < std::max(from, to);
       middle = 0.5 * (from + to))
    (is_exposed(middle) == more ? from : to) = middle;
  return line.curve->domain().clamp(end + 2 * ((more ? from : to) - end));
}

void add_turns(const TubeLine& line, const Interval& range, const ViewOf& view, std::vector<double>& turns) {
  for (const auto& outward : line.outward) {
    const auto faces_viewer = [&](double t) {
      return glm::dot(outward(t), view.central ? line.curve->point(t) - view.direction_or_eye : view.direction_or_eye) <
             0;
    };
    each_stretch(range, kPlacesOfTurns, faces_viewer, [&](const Interval& part, bool) {
      if (part.lo > range.lo) turns.push_back(part.lo);
    });
  }
  std::sort(turns.begin(), turns.end());
}

}  // namespace

void add_bare(const TubeLine& line, const ViewOf& view, ShapeOutlines& found) {
  const Interval all = line.curve->domain();
  each_stretch(
      all, line.places, [&](double t) { return line.is_exposed(t, kBesideBalls); },
      [&](Interval t, bool bare) {
        if (!bare) return;
        if (t.lo > all.lo) t.lo = settled(line, t.lo, t.middle());
        if (t.hi < all.hi) t.hi = settled(line, t.hi, t.middle());
        ShapeOutline part{line.curve, true, nullptr, {}, line.image};
        if (t.width() < all.width()) part.curve = std::make_shared<CurvePart>(line.curve, t);
        add_turns(line, t, view, part.turns);
        found.lines.push_back(std::move(part));
      });
}

}  // namespace lekalo::geometry
