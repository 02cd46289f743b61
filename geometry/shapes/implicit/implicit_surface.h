// An implicit surface: where a formula F of x, y, z has a value, the level, inside a region.
//
// Lines meet it where F changes its sign on them. If F is a polynomial its restriction to the line is computed as a
// polynomial in Bernstein form, whose crossings are isolated by its coefficients' signs (LinePolynomial,
// find_crossings). Other formulas are followed through cells with certified models (ImplicitCells). A line that only
// touches has two hits or none.
#pragma once

#include <optional>

#include "geometry/describe.h"
#include "geometry/expression/line_polynomial.h"
#include "geometry/queries/implicit_curves/implicit_region.h"
#include "geometry/shape.h"
#include "geometry/shapes/implicit/implicit_cells.h"

namespace lekalo::geometry {

class ImplicitSurface final : public Shape {
 public:
  // `formula` is bound to x, y, z. `closed`: the border of the solid F <= level, with the region's border where it cuts
  // the solid; else F = level alone. Throws FieldError where the region is empty or not finite, F has no value in it or
  // does not depend on the place, or the surface does not meet the region.
  ImplicitSurface(Expression formula, double level, const ImplicitRegion& region, bool closed);

  Box3 bounds() const override { return bounds_; }
  // Faces: 0 is F = level; the border of the region is 1 to 6 (x_min, x_max, y_min, ... of a box) or 1 (of a ball).
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  bool first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const override;
  // The normal is grad F / |grad F| on face 0, or its limit where grad F is infinite. There are no parameters: u = v =
  // 0.
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  // On face 0 from the second derivatives of F, S = -P H P / |grad F| with P the projection along the gradient.
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return closed_; }
  std::string how_to_close() const override { return "an implicit surface is closed with closed: true"; }
  LineMethod method() const override {
    if (cells_) return {"implicit cells", static_cast<size_t>(cells_->count()), cells_->memory()};
    return {"polynomial on the line"};
  }

  const ImplicitFormula& formula() const { return formula_; }
  const ImplicitRegion& region() const { return region_; }

  // F - level.
  double value(const Vec3& p) const { return formula_(p); }
  Vec3 gradient(const Vec3& p) const { return formula_.gradient(p); }
  Interval enclose(const Box3& box) const { return formula_.enclose(box); }
  // The degree of F if lines are met by polynomials; 0: by cells.
  int degree() const { return polynomial_ ? polynomial_->degree() : 0; }
  int cell_count() const { return cells_ ? cells_->count() : 0; }

 private:
  // The part of a line in the region, with the faces of its ends; -1 where an end is none of the region's border.
  struct Chord {
    double t0, t1;
    int enter = -1, leave = -1;
  };
  bool find_chord(const Line& line, Chord& chord) const;
  void find(const Line& line, const Interval& t, bool first_only, std::vector<SurfaceHit>& hits) const;
  ShapePoint border_point(int face, const Vec3& near) const;

  ImplicitFormula formula_;
  ImplicitRegion region_;
  double size_;  // of the region
  bool closed_;
  std::optional<LinePolynomial> polynomial_;
  double noise_ = 0;  // of the polynomial's coefficients
  std::optional<ImplicitCells> cells_;
  Box3 bounds_;
  bool ends_at_bounds_ = false;  // an open surface that its region's box holds with room to spare
};

}  // namespace lekalo::geometry
