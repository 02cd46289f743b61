// Jets map by the linear part; enclosures by the same map in interval arithmetic; homogeneous control points (w p, w)
// to (w M p, w); normals by the inverse transpose times the determinant's sign (Golovanov 2016, 1.4). Hits are found in
// the surface's own space: the line moves near to it first, so that a distant origin costs no figures.
#include "geometry/transformed.h"

#include <cmath>
#include <stdexcept>

#include "geometry/formula.h"
#include "geometry/surfaces/local_line.h"

namespace lekalo::geometry {

namespace {

Vec4 image(const Affine& map, const Vec4& p) { return {map.linear * Vec3(p) + p.w * map.offset, p.w}; }

Triple<Interval> image_direction(const Affine& map, const Box3& box) {
  const Triple<Interval> v = triple(box);
  return v.x * triple(map.linear[0]) + v.y * triple(map.linear[1]) + v.z * triple(map.linear[2]);
}
Box3 image_box(const Affine& map, const Box3& box) { return box_of(image_direction(map, box) + triple(map.offset)); }

// The sign of the determinant; throws for a map that has no inverse.
double orientation(const Affine& map) {
  const double determinant = map.determinant();
  const double largest = glm::length(map.linear[0]) * glm::length(map.linear[1]) * glm::length(map.linear[2]);
  if (!(std::abs(determinant) > 1e-14 * largest))
    throw std::invalid_argument("the transform flattens space: its determinant is zero");
  return determinant < 0 ? -1 : 1;
}

class TransformedCurve final : public Curve {
 public:
  TransformedCurve(CurvePtr curve, const Affine& map) : curve_(std::move(curve)), map_(map) { orientation(map); }
  const CurvePtr& original() const { return curve_; }
  const Affine& map() const { return map_; }

  Interval domain() const override { return curve_->domain(); }
  double period() const override { return curve_->period(); }
  bool is_closed() const override { return curve_->is_closed(); }
  CurveJet evaluate(double t, int order) const override {
    CurveJet jet = curve_->evaluate(t, order);
    for (int k = 0; k <= order; ++k) jet.d[k] = map_.linear * jet.d[k];
    jet.d[0] += map_.offset;
    return jet;
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    CurveEnclosure result = curve_->enclose(t, order);
    result.d[0] = image_box(map_, result.d[0]);
    for (int k = 1; k <= order; ++k) result.d[k] = box_of(image_direction(map_, result.d[k]));
    return result;
  }
  std::vector<CurvePiece> pieces() const override {
    std::vector<CurvePiece> result = curve_->pieces();
    for (CurvePiece& piece : result)
      for (Vec4& p : piece.points) p = image(map_, p);
    return result;
  }
  std::optional<NurbsCurveForm> as_nurbs() const override {
    auto form = curve_->as_nurbs();
    if (form)
      for (Vec4& p : form->points) p = image(map_, p);
    return form;
  }

 private:
  CurvePtr curve_;
  Affine map_;
};

class TransformedSurface final : public Surface {
 public:
  TransformedSurface(SurfacePtr surface, const Affine& map)
      : surface_(std::move(surface)),
        map_(map),
        inverse_(map.inverse()),
        normal_map_(orientation(map) * glm::transpose(inverse_.linear)) {
    set_reversed(surface_->reversed());
    const Box3 box = bounds(*surface_);
    center_ = map.point(box.bounded() ? box.center() : Vec3(0));
  }
  const SurfacePtr& original() const { return surface_; }
  const Affine& map() const { return map_; }

  Rectangle domain() const override { return surface_->domain(); }
  Periods periods() const override { return surface_->periods(); }
  SurfaceJet evaluate(double u, double v, int order) const override {
    SurfaceJet jet = surface_->evaluate(u, v, order);
    for (int k = 0; k < SurfaceJet::index(0, order) + 1; ++k) jet.values[k] = map_.linear * jet.values[k];
    jet.values[0] += map_.offset;
    return jet;
  }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override {
    SurfaceEnclosure result = surface_->enclose(box, order);
    result.values[0] = image_box(map_, result.values[0]);
    for (int k = 1; k < SurfaceJet::index(0, order) + 1; ++k)
      result.values[k] = box_of(image_direction(map_, result.values[k]));
    return result;
  }
  std::vector<SurfacePiece> pieces() const override {
    std::vector<SurfacePiece> result = surface_->pieces();
    for (SurfacePiece& piece : result)
      for (Vec4& p : piece.points) p = image(map_, p);
    return result;
  }
  std::optional<NurbsSurfaceForm> as_nurbs() const override {
    auto form = surface_->as_nurbs();
    if (form)
      for (Vec4& p : form->points) p = image(map_, p);
    return form;
  }
  DegenerateEdges degenerate_edges() const override { return surface_->degenerate_edges(); }
  bool bounded() const override { return surface_->bounded(); }
  bool has_line_formula() const override { return surface_->has_line_formula(); }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override {
    const MovedLine moved = moved_near(line, center_);
    const Line own{inverse_.point(moved.origin), inverse_.direction(moved.direction)};
    LineHits found;
    surface_->line_hits(own, Interval::entire(), found);
    for (int i = 0; i < found.size(); ++i) {
      const double at = moved.start + found[i].t;
      if (t.contains(at)) hits.add({at, found[i].u, found[i].v});
    }
  }
  Vec3 normal(double u, double v) const override {
    const Vec3 parametric = surface_->normal_sign() * surface_->normal(u, v);
    return normal_sign() * glm::normalize(normal_map_ * parametric);
  }

 private:
  SurfacePtr surface_;
  Affine map_, inverse_;
  Mat3 normal_map_;
  Vec3 center_;
};

}  // namespace

CurvePtr transformed_curve(CurvePtr curve, const Affine& map) {
  if (map.is_identity()) return curve;
  if (const auto* image = dynamic_cast<const TransformedCurve*>(curve.get()))
    return transformed_curve(image->original(), map * image->map());
  return std::make_shared<TransformedCurve>(std::move(curve), map);
}

SurfacePtr transformed_surface(SurfacePtr surface, const Affine& map) {
  if (map.is_identity()) return surface;
  if (const auto* image = dynamic_cast<const TransformedSurface*>(surface.get())) {
    auto result = std::make_shared<TransformedSurface>(image->original(), map * image->map());
    result->set_reversed(surface->reversed());
    return result;
  }
  return std::make_shared<TransformedSurface>(std::move(surface), map);
}

}  // namespace lekalo::geometry
