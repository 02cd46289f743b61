// The shapes of a scene as triangles and polylines for other programs.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/tessellation/tessellate.h"
#include "render/model/model.h"

namespace lekalo::command {

// Meshes collected into one; faces are numbered on, so that a file keeps them apart.
class MeshCollection {
 public:
  // `sag`: of all of them in scene units; 0: their objects' own.
  explicit MeshCollection(double sag) : sag_(sag) {}

  // Without curves, which then are nothing at all: their caller has them otherwise.
  void leave_out_curves() { with_curves_ = false; }

  // The object says how the shape is to be meshed; its own transform is in to_world.
  void add_shape(const render::Object& object, const geometry::Affine& to_world);
  void add(const render::Object& object, const geometry::Affine& to_world);
  void add(const std::string& name, const render::Entity& entity);

  // Corners without normals or parameters get them where others have some: a file has them for all or none.
  geometry::Mesh finish();

  // The polygons of curves.
  const std::vector<std::vector<geometry::Vec3>>& lines() const { return lines_; }
  // What has no triangles, in words.
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  geometry::TessellationTolerance tolerance_of(render::Object object, const geometry::Affine& to_world) const;
  void add_curve(const geometry::Curve& curve, const geometry::Affine& to_world,
                 const geometry::TessellationTolerance& tolerance, const std::string& name);
  void add_surface(const geometry::Surface& surface, const geometry::Affine& to_world,
                   const geometry::TessellationTolerance& tolerance, const std::string& name);
  void append(const geometry::Mesh& given, const geometry::Affine& to_world);

  double sag_;
  bool with_curves_ = true;
  geometry::Mesh all_;
  std::vector<std::vector<geometry::Vec3>> lines_;
  int32_t faces_ = 0;
  bool with_normals_ = false, without_normals_ = false, without_parameters_ = false;
  std::set<std::string> left_out_;
};

}  // namespace lekalo::command
