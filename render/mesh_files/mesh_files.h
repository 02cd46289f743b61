// Triangle meshes in files: Wavefront OBJ, PLY (ascii, binary of both byte orders), STL (ascii, binary).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "geometry/mesh.h"

namespace lekalo::render {

// A mesh file is broken. what() names the file and the line or byte: "part.obj:12: REASON".
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class MeshFormat { obj, ply, stl };

// By the file name's extension, in any case of letters. Throws MeshFileError for another extension.
MeshFormat mesh_format(const std::filesystem::path& path);

// Polygons become triangles; corners of no width are dropped. Normals and texture coordinates are those of the file,
// the arrays are empty where it has none (STL facet normals are not read: they say nothing more than the corners).
// Triangle groups (OBJ g, o) are numbered by Triangle::face. STL corners, and vertices of PLY files with normals or
// parameters, at the same place become one point. Throws MeshFileError for files that cannot be read, are too long (2
// GB), or are not what their format asks for.
geometry::Mesh read_mesh(const std::filesystem::path& path);

// The same from memory; `name` is the file's name in messages.
geometry::Mesh parse_mesh(MeshFormat format, std::string_view bytes, const std::string& name);

// The file's bytes. OBJ keeps shared points with normals of their own for each corner; PLY (binary, little-endian,
// doubles) repeats a point for each of its normals; STL (binary) has single-precision corners and facet normals.
// Throws std::invalid_argument for a point or normal that is infinite or has no value.
std::string mesh_bytes(MeshFormat format, const geometry::Mesh& mesh);

// Polylines for the end of an OBJ file that has `points` points already: the vertices of each and an `l` element.
std::string obj_lines(size_t points, const std::vector<std::vector<geometry::Vec3>>& polylines);

// Writes mesh_bytes in the format of the extension, in one step. Throws MeshFileError for the extension and ImageError
// when the file cannot be written.
void write_mesh(const std::filesystem::path& path, const geometry::Mesh& mesh);

}  // namespace lekalo::render
