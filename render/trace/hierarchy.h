// Pieces, triangles, shapes and instances in a bounding-volume hierarchy. Every Embree call of the program is in
// hierarchy*.cpp and device.cpp; see docs/internals/rays.md for what the floats may and may not decide.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/queries/rays/line_intersections.h"
#include "geometry/shape.h"
#include "render/ray.h"
#include "render/trace/obstacles.h"
#include "render/trace/packed_mesh.h"

namespace lekalo::render {

using geometry::Affine;
using geometry::Box3;

// Half-spaces dot(p - through, normal) <= 0 that a leaf is cut to.
struct HalfSpace {
  Vec3 through;
  Vec3 normal;
};

// One thing in a hierarchy: surfaces or a body (line targets, one for each face), a mesh, or a shape.
struct Leaf {
  std::vector<std::unique_ptr<geometry::LineTarget>> targets;
  std::vector<double> signs;  // of the outward normal of each target, or of each surface behind a mesh
  PackedMeshPtr mesh;
  std::vector<geometry::SurfacePtr> mesh_surfaces;  // by PackedTriangle::face, of a mesh that stands for surfaces
  bool flat = false;
  bool parameters = true;  // something shows them
  geometry::ShapePtr shape;
  std::vector<HalfSpace> clips;  // their normals of length 1
  bool solid = false;            // a closed body or shape: its normals look out of it
  uint32_t visible_to = kVisibleToAll;
  int object = 0;
  // Set by Hierarchy::add.
  Box3 box;
  double size = 0;  // diameter of what of it is bounded; 1 if nothing is
  // By target: its surface if the nearest hits on it come without parameters and its foot point tells all that is
  // shown.
  std::vector<const geometry::Surface*> foot_points;
};

class Hierarchy {
 public:
  Hierarchy();
  ~Hierarchy();
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  // Leaves and instances are numbered in the order in which they are added; an instance takes as many numbers as its
  // child has leaves. Throws std::invalid_argument if there are more than can be numbered.
  void add(Leaf leaf);
  // Room for at most so many instances: growing takes twice the memory for a while.
  void reserve_instances(size_t count);
  // `object` is the number of all that is in the instance; -1: its leaves keep their own.
  void add_instance(std::shared_ptr<const Hierarchy> child, const Affine& to_parent, int object);
  // Builds; nothing may be added afterwards.
  void commit();

  bool nearest(const Ray& ray, Hit& hit, const Obstacles& among = {}) const;
  // The nearest hit of each ray; its instance is -1 where there is none.
  void nearest(std::span<const Ray> rays, std::span<Hit> hits) const;
  bool occluded(const Ray& ray) const { return occluded(ray, {}); }
  // What may stand between the origin of shadow rays and the places of a bounded box.
  Obstacles obstacles(const Ray& from, const Box3& to) const;
  // The same as occluded(ray) for a ray that ends in the box.
  bool occluded(const Ray& ray, const Obstacles& among) const;
  // The same for each of as many rays.
  void occluded(std::span<const Ray> rays, const Obstacles& among, std::span<bool> occluded) const;
  bool gains_by_lists() const;  // of rays
  // In order of t, one for each crossing of each leaf, in place of what `hits` held.
  void all_hits(const Ray& ray, std::vector<Hit>& hits) const;

  // The leaf that a hit belongs to, the map from its space to this hierarchy's, and the number of the object that the
  // outermost instance or leaf was added for.
  struct Place {
    // Not a constant: compilers would clear all of it, for every hit.
    Place() {}

    const Leaf* leaf = nullptr;
    std::optional<Affine> to_world;  // the identity where there is none
    int object = 0;
    double error = 0;  // bound on the distance between what Embree saw and what is meant, in this space
  };
  Place place(int64_t instance) const;

  int64_t leaf_count() const;
  Box3 bounds() const;                  // of the bounded leaves
  Box3 bounds(int64_t instance) const;  // of one leaf
  Vec3 center() const;
  double radius() const;
  size_t piece_count() const;
  size_t triangle_count() const;
  size_t memory() const;  // of pieces, meshes and instances; what children have is theirs

  struct Parts;
  struct Query;
  void run(Query& query) const;  // one query in this hierarchy's space; used by Embree's callbacks

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace lekalo::render
