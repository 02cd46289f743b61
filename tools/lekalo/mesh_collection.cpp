#include "mesh_collection.h"

#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "geometry/transformed.h"
#include "render/model/mesh_tolerance.h"

namespace lekalo::command {

using geometry::Affine;
using geometry::Mesh;

void MeshCollection::add_shape(const render::Object& object, const Affine& to_world) {
  std::string no_boundary;
  const render::Entity entity = by_boundary(object.shape, &no_boundary);
  const std::string& name = object.name;
  const auto tolerance = [&] { return tolerance_of(object, to_world); };
  if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
    add_surface(**surface, to_world, tolerance(), name);
  } else if (const auto* set = std::get_if<render::SurfaceSet>(&entity)) {
    for (const geometry::SurfacePtr& one : *set) add_surface(*one, to_world, tolerance(), name);
  } else if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
    if (with_curves_) add_curve(**curve, to_world, tolerance(), name);
  } else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
    append(tessellate(**body, tolerance()), to_world);
  } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
    append(**mesh, to_world);
  } else if (const auto* group = std::get_if<render::GroupPtr>(&entity)) {
    for (const render::Object& object : (*group)->objects) add(object, to_world);
  } else if (std::holds_alternative<geometry::ShapePtr>(entity)) {
    left_out_.insert(no_boundary.empty() ? fmt::format("'{}' is met by rays only and has no triangles", name)
                                         : fmt::format("'{}' has no triangles: {}", name, no_boundary));
  } else {
    left_out_.insert(fmt::format("'{}' is a point and has no triangles", name));
  }
}

void MeshCollection::add(const render::Object& object, const Affine& to_world) {
  if (!object.clips.empty())
    left_out_.insert(fmt::format("'{}' is written whole: its clip planes are not applied", object.name));
  add_shape(object, to_world * object.transform);
}

void MeshCollection::add(const std::string& name, const render::Entity& entity) {
  render::Object object;
  object.name = name;
  object.shape = entity;
  add_shape(object, Affine());
}

Mesh MeshCollection::finish() {
  if (with_normals_ && without_normals_) {
    for (Mesh::Triangle& triangle : all_.triangles) {
      if (triangle.normal[0] >= 0) continue;
      const auto& p = triangle.point;
      const geometry::Vec3 area =
          glm::cross(all_.points[p[1]] - all_.points[p[0]], all_.points[p[2]] - all_.points[p[0]]);
      const double length = glm::length(area);
      triangle.normal.fill(static_cast<int32_t>(all_.normals.size()));
      all_.normals.push_back(length > 0 ? area / length : geometry::Vec3(0, 0, 1));
    }
  }
  if (without_parameters_) {
    all_.parameters.clear();
    for (Mesh::Triangle& triangle : all_.triangles) triangle.parameter.fill(-1);
  }
  return std::move(all_);
}

geometry::TessellationTolerance MeshCollection::tolerance_of(render::Object object, const Affine& to_world) const {
  if (sag_ > 0) object.sag = sag_;
  auto result = render::mesh_tolerance(object, to_world, nullptr);
  // What another program shades smooth with the normals of the file needs no finer steps.
  if (object.mesh_angle == 0 && !std::holds_alternative<geometry::CurvePtr>(object.shape))
    result.angle = geometry::TessellationTolerance().angle;
  return result;
}

void MeshCollection::add_curve(const geometry::Curve& curve, const Affine& to_world,
                               const geometry::TessellationTolerance& tolerance, const std::string& name) {
  if (!(curve.domain().width() < geometry::kInfinity)) {
    left_out_.insert(fmt::format("'{}' is left out: it has no ends", name));
    return;
  }
  lines_.emplace_back();
  for (const double t : polygon_parameters(curve, tolerance)) lines_.back().push_back(to_world.point(curve.point(t)));
}

void MeshCollection::add_surface(const geometry::Surface& surface, const Affine& to_world,
                                 const geometry::TessellationTolerance& tolerance, const std::string& name) {
  if (surface.bounded())
    append(tessellate(surface, tolerance), to_world);
  else
    left_out_.insert(fmt::format("'{}' is left out: it has no bounds; give it a domain", name));
}

void MeshCollection::append(const Mesh& given, const Affine& to_world) {
  const Mesh part = to_world.is_identity() ? given : transformed(given, to_world);
  int32_t faces = 0;
  const auto shift = [](std::array<int32_t, 3>& index, size_t by) {
    for (int32_t& i : index)
      if (i >= 0) i += static_cast<int32_t>(by);
  };
  for (Mesh::Triangle triangle : part.triangles) {
    shift(triangle.point, all_.points.size());
    shift(triangle.normal, all_.normals.size());
    shift(triangle.parameter, all_.parameters.size());
    faces = std::max(faces, triangle.face + 1);
    triangle.face += faces_;
    all_.triangles.push_back(triangle);
  }
  faces_ += faces;
  (part.normals.empty() ? without_normals_ : with_normals_) = true;
  without_parameters_ = without_parameters_ || part.parameters.empty();
  all_.points.insert(all_.points.end(), part.points.begin(), part.points.end());
  all_.normals.insert(all_.normals.end(), part.normals.begin(), part.normals.end());
  all_.parameters.insert(all_.parameters.end(), part.parameters.begin(), part.parameters.end());
}

}  // namespace lekalo::command
