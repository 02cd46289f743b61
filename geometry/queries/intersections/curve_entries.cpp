#include "geometry/queries/intersections/curve_entries.h"

#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

void add_entries(const Curve& curve, const Box3& box, double size, const ChordHits& add_hits,
                 std::vector<double>& places) {
  constexpr double kFlat = 1e-11, kBowed = 1e-5;  // of the size, how far a part is from its chord
  constexpr int kMaxHalvings = 40;
  std::vector<double> hits;
  const auto part = [&](const auto& self, double lo, const Vec3& from, double hi, const Vec3& to, int depth) -> void {
    const double middle = 0.5 * (lo + hi);
    const Vec3 between = curve.point(middle);
    Box3 around{from, from};
    around.include(to), around.include(between);
    const double bow = glm::length(between - 0.5 * (from + to));
    if (!BoxTree::meets(around.inflated(2 * bow), box)) return;
    hits.clear();
    if (from != to) add_hits({from, to - from}, hits);
    if (hits.empty() && bow < kBowed * size) return;
    if (bow < kFlat * size || depth >= kMaxHalvings || !(lo < middle && middle < hi)) {
      for (const double hit : hits) places.push_back(lo + hit * (hi - lo));
      return;
    }
    self(self, lo, from, middle, between, depth + 1);
    self(self, middle, between, hi, to, depth + 1);
  };
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval t = intersect(piece.domain, curve.domain());
    if (!(t.width() > 0)) continue;
    const double last = next_down(t.hi);
    constexpr int kParts = 8;  // a bow between two places may be none in the middle
    for (int k = 0; k < kParts; ++k) {
      const double lo = t.lo + k * t.width() / kParts,
                   hi = k + 1 == kParts ? last : t.lo + (k + 1) * t.width() / kParts;
      part(part, lo, curve.point(lo), hi, curve.point(hi), 0);
    }
  }
}

}  // namespace lekalo::geometry
