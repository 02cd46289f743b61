// Curves and surfaces under an affine map, with their parameters unchanged (Golovanov 2016, 1.4).
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class TransformedCurve final : public Curve {
 public:
  TransformedCurve(CurvePtr original, const Affine& map) : original_(std::move(original)), map_(map) {}
  const CurvePtr& original() const { return original_; }
  const Affine& map() const { return map_; }

  Interval domain() const override { return original_->domain(); }
  double period() const override { return original_->period(); }
  bool is_closed() const override { return original_->is_closed(); }
  CurveJet evaluate(double t, int order) const override;
  double fit_distance() const override { return map_.operator_norm_bound() * original_->fit_distance(); }
  int max_order() const override { return original_->max_order(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return original_->enclosure_order(); }
  std::vector<CurvePiece> pieces() const override;
  std::optional<NurbsCurveForm> as_nurbs() const override;

 private:
  CurvePtr original_;
  Affine map_;
};

// The normal is that of r_u x r_v of the image, as for every surface: a mirror image of an outward-oriented surface
// looks inward.
class TransformedSurface final : public Surface {
 public:
  // Throws std::invalid_argument for a singular map.
  TransformedSurface(SurfacePtr original, const Affine& map);
  const SurfacePtr& original() const { return original_; }
  const Affine& map() const { return map_; }

  Rectangle domain() const override { return original_->domain(); }
  Periods periods() const override { return original_->periods(); }
  SurfaceJet evaluate(double u, double v, int order) const override;
  double fit_distance() const override { return map_.operator_norm_bound() * original_->fit_distance(); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return original_->enclosure_order(); }
  bool is_composed() const override { return original_->is_composed(); }
  int max_order() const override { return original_->max_order(); }
  std::vector<SurfacePiece> pieces() const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override;
  DegenerateEdges degenerate_edges() const override { return original_->degenerate_edges(); }
  bool bounded() const override { return original_->bounded(); }
  Sides convex_sides(double u, double v) const override {
    const Sides sides = original_->convex_sides(u, v);
    return orientation_ < 0 ? sides.turned() : sides;
  }
  bool has_line_formula() const override { return original_->has_line_formula(); }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override { meet_line(line, t, hits); }
  Vec3 normal(double u, double v) const override;

 private:
  void meet_line(const Line& line, const Interval& t, LineHits& hits) const;
  SurfacePtr original_;
  Affine map_;
  Affine inverse_;
  double orientation_;  // sign of the determinant
  Vec3 center_;         // a place near the image, where lines are taken from
};

// The image keeps the original's `reversed`. Maps of maps are multiplied out; the identity gives the original itself.
CurvePtr transformed(const CurvePtr& curve, const Affine& map);
SurfacePtr transformed(const SurfacePtr& surface, const Affine& map);

// A surface of that type, or an image of one; null where it is neither.
template <class S>
struct Placed {
  const S* surface = nullptr;
  Affine map;
};
template <class S>
Placed<S> placed(const Surface& surface) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(&surface))
    return {dynamic_cast<const S*>(moved->original().get()), moved->map()};
  return {dynamic_cast<const S*>(&surface), {}};
}

// Whether both are one surface, or its images under equal maps.
bool is_same(const SurfacePtr& a, const SurfacePtr& b);

}  // namespace lekalo::geometry
