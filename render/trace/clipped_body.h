// A body cut by half-spaces, cuts closed with plane faces where asked for.
//
// Along a line the body is a set of intervals between outward crossings, each half-space one interval; their
// intersection is what is left. An end on the body keeps the body's face, one on a plane belongs to that plane's cap,
// or is no hit if the plane leaves the body open.
#pragma once

#include <memory>
#include <vector>

#include "render/trace/hierarchy.h"

namespace lekalo::render {

struct CutPlane {
  HalfSpace half_space;  // the normal points at what is cut away
  bool cap = false;      // close the cut
};

class ClippedBody final : public geometry::Shape {
 public:
  // With `caps_only` the body itself is shown by something else: its mesh.
  ClippedBody(geometry::BodyPtr body, std::vector<CutPlane> planes, bool caps_only);

  geometry::Box3 bounds() const override { return box_; }
  void all_hits(const geometry::Line& line, const geometry::Interval& t,
                std::vector<geometry::SurfaceHit>& hits) const override;
  // Caps are numbered behind the body's faces.
  geometry::ShapePoint point(const geometry::SurfaceHit& hit, const geometry::Vec3& near) const override;
  std::optional<geometry::Mat3> shape_operator(const geometry::SurfaceHit& hit,
                                               const geometry::Vec3& near) const override;
  bool is_closed() const override;

 private:
  geometry::BodyPtr body_;
  std::vector<CutPlane> planes_;
  bool caps_only_;
  std::vector<geometry::SurfacePtr> caps_;  // plane surfaces with the normals of planes_
  geometry::LineIntersector intersector_;
  geometry::Box3 box_;
};

}  // namespace lekalo::render
