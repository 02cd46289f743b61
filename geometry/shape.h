// Shapes that answer for all their hits along a line at once, and need no parameters for it: implicit surfaces, CSG,
// tubes, bodies cut by planes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// A hit of a line with a set of surfaces or a body.
struct SurfaceHit {
  double t = 0;
  double u = 0;
  double v = 0;
  int face = 0;  // of a body; 0 for a surface
  int piece = 0;
};

// How lines are met, for statistics: a name ("closed form", "Bezier pieces"), the pieces prepared and their memory.
struct LineMethod {
  std::string_view name = "closed form";
  size_t pieces = 1;
  size_t bytes = 0;
};

// What a shape shows at a hit: point, outward unit normal, parameters and the derivatives by them (zero where it has
// none). Aligned as FootPoint.
struct ShapePoint {
  alignas(16) Vec3 position{0};
  alignas(16) Vec3 normal{0, 0, 1};
  alignas(16) Vec3 du{0};
  alignas(16) Vec3 dv{0};
  double u = 0;
  double v = 0;
  double error = 0;  // bound on the distance of the position from the shape, beyond the rounding of its coordinates
};

// The same of a surface; `sign` turns its normal. `jet`: of the first order there.
ShapePoint point_on(const Surface& surface, double sign, double u, double v, const Vec3& near);
ShapePoint point_on(const Surface& surface, double sign, double u, double v, const SurfaceJet& jet);

// A part of a shape's surface, cut into pieces of like sizes; and the box of the solid that it belongs to.
struct SurfacePart {
  Box3 solid;
  int64_t pieces = 1;
  bool thin = false;  // a line between two places of such parts is hardly inside for longer than their pieces are wide
};
struct PieceOfSurface {
  int part = 0;
  int64_t piece = 0;
};

// Immutable; safe to use from many threads.
class Shape {
 public:
  virtual ~Shape() = default;
  // A box around it, unbounded where the shape is.
  virtual Box3 bounds() const = 0;
  // Adds all hits with t in the interval, in order, one for each crossing; t in units of the line's direction. A line
  // that only touches has two hits there or none.
  virtual void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const = 0;
  // The first of them; false if there is none.
  virtual bool first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const;
  // `near` is the hit's place on the line that found it.
  virtual ShapePoint point(const SurfaceHit& hit, const Vec3& near) const = 0;
  // How the unit normal m of point() turns along the shape at a hit: the symmetric map S with dm = -S dr for all dr in
  // the tangent plane, and S m = 0. Nothing where that is not known.
  virtual std::optional<Mat3> shape_operator(const SurfaceHit&, const Vec3& /*near*/) const { return std::nullopt; }
  // True if it bounds a region of space: every line crosses it in and out by turns, the normals looking out of the
  // region.
  virtual bool is_closed() const = 0;
  // What would close an open one, for messages.
  virtual std::string how_to_close() const { return ""; }
  // The method taken for lines; that of a shape of shapes is its own.
  virtual LineMethod method() const { return {}; }
  // True if a line is in that region where t goes to minus infinity; of an unbounded one.
  virtual bool begins_inside(const Line&) const { return false; }
  // Where to look for its surface, for what is measured by lines: what is small beside the whole is a part, or a piece
  // of one, of its own.
  virtual std::vector<SurfacePart> surface_parts() const { return {{bounds()}}; }
  // A box around a piece, about as large as it is; empty where nothing is left of it.
  virtual Box3 piece_box(const PieceOfSurface&) const { return bounds(); }
  // That which a hit is on.
  virtual PieceOfSurface piece_of(const SurfaceHit&) const { return {}; }
  // point() where nothing asks for the parameters and the derivatives by them: they may be zero.
  virtual ShapePoint bare_point(const SurfaceHit& hit, const Vec3& near) const { return point(hit, near); }
};
using ShapePtr = std::shared_ptr<const Shape>;

inline Box3 bounds(const Shape& shape) { return shape.bounds(); }

// The image of a shape: lines are mapped back, t is kept; normals map with the inverse transpose (Golovanov 2016, 1.4).
class TransformedShape final : public Shape {
 public:
  // The map must not be singular.
  TransformedShape(ShapePtr original, const Affine& map)
      : original_(std::move(original)), map_(map), inverse_(map.inverse()) {}
  const ShapePtr& original() const { return original_; }
  const Affine& map() const { return map_; }

  Box3 bounds() const override { return image(original_->bounds()); }
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override {
    original_->all_hits(moved_back(line), t, hits);
  }
  bool first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const override {
    return original_->first_hit(moved_back(line), t, hit);
  }
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return original_->is_closed(); }
  std::string how_to_close() const override { return original_->how_to_close(); }
  LineMethod method() const override { return original_->method(); }
  bool begins_inside(const Line& line) const override { return original_->begins_inside(moved_back(line)); }
  std::vector<SurfacePart> surface_parts() const override;
  Box3 piece_box(const PieceOfSurface& piece) const override { return image(original_->piece_box(piece)); }
  PieceOfSurface piece_of(const SurfaceHit& hit) const override { return original_->piece_of(hit); }

 private:
  Box3 image(const Box3& box) const {
    return box.empty() ? box : box.bounded() ? geometry::transformed(box, map_) : Box3::everything();
  }
  Line moved_back(const Line& line) const { return {inverse_.point(line.origin), inverse_.direction(line.direction)}; }

  ShapePtr original_;
  Affine map_;
  Affine inverse_;
};

// The shape operator of the image of a surface at a place with this unit normal.
Mat3 moved(const Mat3& shape_operator, const Vec3& normal, const Affine& map);

// A bound on how much longer the map makes a vector.
double operator_norm_bound(const Affine& map);

// The image under an affine map; the identity gives the shape itself, maps of maps are multiplied out. Throws
// std::invalid_argument for a singular map.
ShapePtr transformed(const ShapePtr& shape, const Affine& map);

}  // namespace lekalo::geometry
