// The new surfaces of a body's faces, and the points that they have in common where the faces come together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/bodies/local/corner_tree.h"
#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/edge_curve.h"

namespace lekalo::geometry {

class NewFaces {
 public:
  // As replace_faces has them. Throws FieldError (that field) for an open body.
  NewFaces(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field);

  // The body without seams of plane faces.
  const Body& old() const { return old_; }
  const char* field() const { return field_; }
  double size() const { return size_; }
  bool are_plane() const { return plane_; }

  const std::vector<char>& removed() const { return removed_; }
  bool is_changed(int face) const { return changed_[face] != 0; }
  bool is_changed(const Corner& corner) const;
  // The new surface; of a plane the plane without bounds.
  const SurfacePtr& support(int face) const { return supports_[face]; }
  const std::optional<Frame>& plane(int face) const { return planes_[face]; }
  // The coedge whose image carries over an edge that is a seam, or smooth and stays so; -1 for other edges.
  int carrier(int edge) const { return carriers_[edge]; }

  // Parameters of the support near to an end of an old edge: of the coedge as its loop runs, or of its edge.
  Vec2 near(int coedge, bool at_end, bool along_loop = true) const;
  EdgeSide side_of(int coedge) const;
  // Parameters of a face's support near to the middle of one of its edges.
  Vec2 near_middle(int face, int edge) const;
  std::string name(int face) const { return name_of_face(old_, face); }

  // Where the faces of a corner come together. Throws FieldError where they do not.
  CornerTree tree_of(const Corner& corner) const;
  // A vertex in which two faces alone meet may be anywhere along their edges.
  bool may_slide(const Corner& corner) const;
  // The same for such a vertex, near to the middle of one of its edges.
  CornerTree tree_along(const Corner& corner, int edge) const;
  // An edge that has a carrier, between its new ends: along its image, or the straight line of the parameter plane
  // where it was one. Nothing where the faces do not run along it.
  std::optional<EdgeCurve> carried_edge(int edge, const Vec3& from, const Vec3& to) const;

 private:
  int face_of(int coedge) const { return face_of_coedge(old_, coedge); }
  const Coedge& use(int coedge) const { return old_.coedges[coedge]; }
  int found_carrier(int edge) const;
  SurfaceNear near_surface(const Sector& s) const;
  Vec3 normal_at(const Sector& s) const;
  std::string names_of(const Corner& corner) const;
  std::optional<Vec3> carried_point(const Corner& corner) const;
  // Of faces some of which lie in one plane.
  std::optional<Vec3> point_of_few_planes(const Corner& corner) const;
  Vec3 point_on(const Sector& s, int coedge, bool at_begin = false) const;

  const Body old_;
  const char* field_;
  double size_;
  bool plane_ = true;
  std::vector<char> removed_, changed_;
  std::vector<SurfacePtr> supports_;
  std::vector<std::optional<Frame>> planes_;
  std::vector<int> carriers_;
};

}  // namespace lekalo::geometry
