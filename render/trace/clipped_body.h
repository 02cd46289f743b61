// A body cut by half-spaces, the cuts closed with plane faces.
//
// Along a line the body is a set of intervals between outward crossings, each half-space one interval; their
// intersection is what is left. An end on the body keeps the body's face, one on a plane belongs to that plane's cap.
#pragma once

#include <memory>
#include <vector>

#include "render/trace/hierarchy.h"

namespace lekalo::render {

class ClippedBody final : public Shape {
 public:
  // The planes' normals point at what is cut away.
  ClippedBody(geometry::BodyPtr body, std::vector<HalfSpace> planes);

  geometry::Box3 bounds() const override { return box_; }
  void all_hits(const geometry::Line& line, const geometry::Interval& t,
                std::vector<geometry::SurfaceHit>& hits) const override;
  // Caps are numbered behind the body's faces.
  const geometry::Surface& surface(int face) const override;
  double sign(int face) const override;

 private:
  geometry::BodyPtr body_;
  std::vector<HalfSpace> planes_;
  std::vector<geometry::SurfacePtr> caps_;  // plane surfaces with the normals of planes_
  geometry::LineIntersector intersector_;
  geometry::Box3 box_;
};

}  // namespace lekalo::render
