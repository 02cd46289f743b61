// A body as a shape: an operand of CSG.
#pragma once

#include "geometry/body.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/shape.h"

namespace lekalo::geometry {

class BodyShape final : public Shape {
 public:
  // The body must be closed; throws std::invalid_argument.
  explicit BodyShape(BodyPtr body);
  const BodyPtr& body() const { return body_; }

  Box3 bounds() const override { return box_; }
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return true; }
  // Its faces.
  std::vector<SurfacePart> surface_parts() const override { return {body_->faces.size(), {box_}}; }
  Box3 piece_box(const PieceOfSurface& piece) const override { return geometry::bounds(*body_, piece.part); }
  PieceOfSurface piece_of(const SurfaceHit& hit) const override { return {hit.face}; }

 private:
  BodyPtr body_;
  LineIntersector intersector_;
  Box3 box_;
};

}  // namespace lekalo::geometry
