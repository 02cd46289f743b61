// Foot points of a point on a surface of formulas with kinks or steps: those on its smooth parts, as far as these are
// the surface's own, and on the edges that the parts have at steps and creases.
#pragma once

#include <vector>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"

namespace lekalo::geometry {

class ProjectorOfParts {
 public:
  // Of smooth_parts, more than one. Throws std::invalid_argument where the lines between them are not all known.
  explicit ProjectorOfParts(std::vector<SmoothPart> parts);
  SurfaceFootPoints foot_points(const Vec3& point) const;

 private:
  // Where one part ends, or two meet in a crease: the way into each, across the edge, in parameters.
  struct Edge {
    Curve2Ptr image;
    std::vector<size_t> parts;
    CurveProjector foot_points;
  };
  void add_edge(const Curve2Ptr& image, std::vector<size_t> parts);
  bool is_minimum(const Edge& edge, double t, const Vec3& point) const;

  std::vector<SmoothPart> parts_;
  std::vector<SurfaceProjector> projectors_;
  std::vector<Edge> edges_;
};

}  // namespace lekalo::geometry
