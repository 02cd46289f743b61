#include "render/mesh_files/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/tessellation/triangulation.h"
#include "render/image/atomic_file.h"
#include "render/mesh_files/mesh_parts.h"
#include "render/scene/yaml/include.h"

namespace lekalo::render {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr size_t kLongestFile = 2'000'000'000;

// Normal of a polygon by Newell's sum (Sutherland, Sproull, Schumacker 1974), twice its area long.
Vec3 polygon_normal(const Mesh& mesh, std::span<const MeshCorner> corners) {
  Vec3 sum(0);
  const Vec3 first = mesh.points[corners[0].point];
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(mesh.points[corners[i].point] - first, mesh.points[corners[i + 1].point] - first);
  return sum;
}

void add_triangle(Mesh& mesh, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c, int32_t face) {
  if (a.point == b.point || b.point == c.point || c.point == a.point) return;
  Mesh::Triangle triangle;
  triangle.point = {a.point, b.point, c.point};
  triangle.normal = {a.normal, b.normal, c.normal};
  triangle.parameter = {a.parameter, b.parameter, c.parameter};
  triangle.face = face;
  mesh.triangles.push_back(triangle);
}

// A strictly convex quadrangle by its shorter diagonal; false where it is not one.
bool add_quadrangle(Mesh& mesh, std::span<const MeshCorner> q, const Vec3& normal, int32_t face) {
  const auto p = [&](int i) { return mesh.points[q[i % 4].point]; };
  for (int i = 0; i < 4; ++i)
    if (!(glm::dot(glm::cross(p(i + 1) - p(i), p(i + 2) - p(i + 1)), normal) > 0)) return false;
  const int k = glm::length(p(2) - p(0)) <= glm::length(p(3) - p(1)) ? 0 : 1;
  add_triangle(mesh, q[k], q[k + 1], q[k + 2], face);
  add_triangle(mesh, q[k], q[k + 2], q[(k + 3) % 4], face);
  return true;
}

}  // namespace

void add_polygon(Mesh& mesh, std::span<const MeshCorner> given, int32_t face) {
  if (given.size() == 3) return add_triangle(mesh, given[0], given[1], given[2], face);
  std::vector<MeshCorner> corners;
  for (const MeshCorner& corner : given)
    if (corners.empty() || corner.point != corners.back().point) corners.push_back(corner);
  while (corners.size() > 1 && corners.back().point == corners[0].point) corners.pop_back();
  if (corners.size() < 3) return;
  const Vec3 normal = polygon_normal(mesh, corners);
  if (corners.size() == 4 && add_quadrangle(mesh, corners, normal, face)) return;

  const auto fan = [&] {
    for (size_t i = 1; i + 1 < corners.size(); ++i) add_triangle(mesh, corners[0], corners[i], corners[i + 1], face);
  };
  if (corners.size() == 3 || !(glm::length(normal) > 0)) return fan();
  const geometry::Frame frame = geometry::frame_about(mesh.points[corners[0].point], normal);
  std::vector<Vec2> flat;
  std::vector<int> polygon;
  for (const MeshCorner& corner : corners) {
    polygon.push_back(static_cast<int>(flat.size()));
    flat.push_back(Vec2(frame.to_local_point(mesh.points[corner.point])));
  }
  try {
    const auto triangles = geometry::triangulate(flat, {polygon});
    if (triangles.size() + 2 != corners.size()) return fan();
    for (const auto& t : triangles) add_triangle(mesh, corners[t[0]], corners[t[1]], corners[t[2]], face);
  } catch (const std::invalid_argument&) {
    fan();  // it crosses itself
  }
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  throw MeshFileError(fmt::format("{}: a mesh file ends in .obj, .ply or .stl", path.string()));
}

Mesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = mesh_format(path);
  std::string reason;
  const auto bytes = read_file(path, kLongestFile, true, reason);
  if (!bytes) throw MeshFileError(fmt::format("{}: {}", path.string(), reason));
  return parse_mesh(format, *bytes, path.string());
}

Mesh parse_mesh(MeshFormat format, std::string_view bytes, const std::string& name) {
  Mesh mesh = format == MeshFormat::obj   ? parse_obj(bytes, name)
              : format == MeshFormat::ply ? parse_ply(bytes, name)
                                          : parse_stl(bytes, name);
  if (mesh.triangles.empty()) throw MeshFileError(fmt::format("{}: the file has no triangles", name));
  // Indices of corners make sense only if all corners have them.
  const auto all_have = [&](auto member) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Mesh::Triangle& t) {
      return (t.*member)[0] >= 0 && (t.*member)[1] >= 0 && (t.*member)[2] >= 0;
    });
  };
  if (!all_have(&Mesh::Triangle::normal)) {
    mesh.normals.clear();
    for (Mesh::Triangle& t : mesh.triangles) t.normal.fill(-1);
  }
  if (!all_have(&Mesh::Triangle::parameter)) {
    mesh.parameters.clear();
    for (Mesh::Triangle& t : mesh.triangles) t.parameter.fill(-1);
  }
  for (Vec3& n : mesh.normals) {
    const double length = glm::length(n);
    n = length > 0 ? n / length : Vec3(0, 0, 1);
  }
  return mesh;
}

std::string mesh_bytes(MeshFormat format, const Mesh& mesh) {
  const auto is_finite = [](const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  if (!std::all_of(mesh.points.begin(), mesh.points.end(), is_finite) ||
      !std::all_of(mesh.normals.begin(), mesh.normals.end(), is_finite))
    throw std::invalid_argument("the mesh has points or normals that are infinite or have no value");
  return format == MeshFormat::obj ? obj_bytes(mesh) : format == MeshFormat::ply ? ply_bytes(mesh) : stl_bytes(mesh);
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  write_file_atomically(path, mesh_bytes(mesh_format(path), mesh));
}

}  // namespace lekalo::render
