// Balls about points: a union of as many as there are.
#pragma once

#include <span>

#include "geometry/shape.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

// Where balls overlap only the outside of their union is seen. Parameters: longitude and latitude as on a sphere in
// place, z up. face and piece of a hit: 0 and the ball's number.
class Balls final : public Shape {
 public:
  // One radius for all, or as many as centers; all positive. Throws FieldError (fields at, radius).
  Balls(std::span<const Vec3> centers, std::span<const double> radii);

  Box3 bounds() const override { return box_; }
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return true; }
  // The balls.
  std::vector<SurfacePart> surface_parts() const override;
  Box3 piece_box(const PieceOfSurface& piece) const override { return box_of(piece.part); }
  PieceOfSurface piece_of(const SurfaceHit& hit) const override { return {hit.piece}; }
  LineMethod method() const override { return {"closed form", balls_.size(), balls_.size() * sizeof(Ball)}; }

  struct Ball {
    Vec3 center;
    double radius;
  };
  const std::vector<Ball>& balls() const { return balls_; }
  // Calls visit(k) for the balls whose boxes meet that of ball i, itself too.
  template <class Visit>
  void near(size_t i, const Visit& visit) const {
    tree_.around(box_of(i), [&](int k) { visit(static_cast<size_t>(k)); });
  }

 private:
  Box3 box_of(size_t i) const { return Box3{balls_[i].center, balls_[i].center}.inflated(balls_[i].radius); }

  std::vector<Ball> balls_;
  Box3 box_;
  BoxTree tree_;
};

}  // namespace lekalo::geometry
