// Mesh files: what is written is read again, the formats' variants, and one clear message for every broken file.
#include "render/mesh_files/mesh_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::render::mesh_files_test {
namespace {

using geometry::Mesh;
using geometry::Vec3;

Mesh parse(MeshFormat format, std::string_view text) { return parse_mesh(format, text, "part"); }

std::string error_of(MeshFormat format, std::string_view text) {
  try {
    parse(format, text);
  } catch (const MeshFileError& error) {
    return error.what();
  }
  return "no error";
}

Mesh sample() { return tessellate(geometry::cylinder_body(geometry::frame_about({1, 2, 3}, {1, 1, 1}), 1, 2), {}); }

Vec3 corner(const Mesh& mesh, size_t triangle, int k) { return mesh.points[mesh.triangles[triangle].point[k]]; }

TEST(MeshFiles, RoundTripsKeepEveryDigit) {
  const Mesh mesh = sample();
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply}) {
    const Mesh again = parse(format, mesh_bytes(format, mesh));
    ASSERT_EQ(again.triangles.size(), mesh.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(corner(again, i, k), corner(mesh, i, k));
        // Reading makes them unit vectors once more.
        EXPECT_LT(glm::length(again.normals[again.triangles[i].normal[k]] - mesh.normals[mesh.triangles[i].normal[k]]),
                  1e-15);
        EXPECT_EQ(again.parameters[again.triangles[i].parameter[k]], mesh.parameters[mesh.triangles[i].parameter[k]]);
      }
  }
  const Mesh obj = parse(MeshFormat::obj, mesh_bytes(MeshFormat::obj, mesh));
  EXPECT_TRUE(is_closed(obj));
  // Points that stand several times in a PLY file for their normals are one again.
  const Mesh ply = parse(MeshFormat::ply, mesh_bytes(MeshFormat::ply, mesh));
  EXPECT_TRUE(is_closed(ply));
  EXPECT_EQ(ply.points.size(), obj.points.size());
  EXPECT_EQ(obj.triangles.back().face, 2);
}

TEST(MeshFiles, StlIsWeldedAndSinglePrecision) {
  const Mesh mesh = sample();
  const Mesh again = parse(MeshFormat::stl, mesh_bytes(MeshFormat::stl, mesh));
  ASSERT_EQ(again.triangles.size(), mesh.triangles.size());
  EXPECT_TRUE(is_closed(again));
  EXPECT_TRUE(again.normals.empty());
  EXPECT_NEAR(measure(again).volume.value, measure(mesh).volume.value, 1e-5);
}

TEST(MeshFiles, FilesOnDiskByTheirExtension) {
  const auto folder = std::filesystem::temp_directory_path() / "lekalo_mesh_files_test";
  std::filesystem::create_directories(folder);
  for (const char* name : {"a.obj", "a.PLY", "a.stl"}) {
    write_mesh(folder / name, sample());
    EXPECT_EQ(read_mesh(folder / name).triangles.size(), sample().triangles.size());
  }
  EXPECT_THROW(mesh_format("a.3ds"), MeshFileError);
  EXPECT_THROW(read_mesh(folder / "missing.obj"), MeshFileError);
  EXPECT_THROW(read_mesh(folder), MeshFileError);
  std::filesystem::remove_all(folder);
}

TEST(MeshFiles, ObjVariants) {
  const Mesh mesh = parse(MeshFormat::obj,
                          "# a square and a triangle\r\n"
                          "mtllib colors.mtl\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nv +1 1 0\r\nv 0 1 0\r\nvn 0 0 2\r\n"
                          "g square\r\nusemtl red\r\nf 1//1 2//1 \\\r\n 3//1 4//1\r\no other\r\n"
                          "v .5 .5 1e0\r\nf -1//-1 -4//1 -3//1");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0].face, 0);
  EXPECT_EQ(mesh.triangles[2].face, 1);
  EXPECT_EQ(mesh.normals.at(mesh.triangles[2].normal[0]), Vec3(0, 0, 1));
  EXPECT_EQ(corner(mesh, 2, 0), Vec3(0.5, 0.5, 1));
  EXPECT_EQ(corner(mesh, 2, 1), Vec3(1, 0, 0));
  EXPECT_TRUE(mesh.parameters.empty());
}

TEST(MeshFiles, PolygonsKeepTheirShape) {
  // A concave pentagon (an arrow head with a notch) in a tilted plane, area 1.5, and a dart-shaped quadrangle, area 1.
  const Mesh mesh = parse(MeshFormat::obj,
                          "v 0 0 0\nv 2 0 2\nv 2 1 2\nv 1 .5 1\nv 0 1 0\nf 1 2 3 4 5\n"
                          "v 0 0 5\nv 2 1 5\nv 0 2 5\nv 1 1 5\nf 6 7 8 9\n");
  ASSERT_EQ(mesh.triangles.size(), 5u);
  double area = 0;
  for (size_t i = 0; i < 5; ++i) {
    const Vec3 n = 0.5 * glm::cross(corner(mesh, i, 1) - corner(mesh, i, 0), corner(mesh, i, 2) - corner(mesh, i, 0));
    EXPECT_GT(i < 3 ? n.z - n.x : n.z, 0);
    area += glm::length(n);
  }
  EXPECT_NEAR(area, 1.5 * std::sqrt(2.0) + 1, 1e-12);
}

const char* kPlyHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement material 1\nproperty list uchar float color\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n";

TEST(MeshFiles, PlyVariants) {
  const Mesh text =
      parse(MeshFormat::ply,
            std::string(kPlyHeader) + "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0 255\n3 1 0 0\n3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(text.triangles.size(), 2u);

  // The same in big-endian binary, indices as unsigned shorts.
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
      "element face 1\nproperty uchar flags\nproperty list uint ushort vertex_index\nend_header\n";
  const auto append = [&](auto value) {
    char copy[sizeof(value)];
    std::memcpy(copy, &value, sizeof(value));
    std::reverse(copy, copy + sizeof(value));
    bytes.append(copy, sizeof(value));
  };
  for (int i = 0; i < 3; ++i) {
    append(0.5 * i);
    append(static_cast<float>(i == 1));
    append(static_cast<int16_t>(-i));
  }
  append(static_cast<uint8_t>(7));
  append(static_cast<uint32_t>(3));
  for (uint16_t i : {0, 1, 2}) append(i);
  const Mesh binary = parse(MeshFormat::ply, bytes);
  ASSERT_EQ(binary.triangles.size(), 1u);
  EXPECT_EQ(corner(binary, 0, 1), Vec3(0.5, 1, -1));
  EXPECT_EQ(corner(binary, 0, 2), Vec3(1, 0, -2));
}

TEST(MeshFiles, AsciiStl) {
  const Mesh mesh =
      parse(MeshFormat::stl,
            "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n"
            "  endloop\n endfacet\n facet normal 0 0 1\n outer loop\n vertex 1 0 0\n vertex 1 1 0\n"
            " vertex 0 1 0\n endloop\n endfacet\nendsolid\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.points.size(), 4u);
}

TEST(MeshFiles, BrokenFilesNameThePlaceAndTheReason) {
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 0\nv 1 x 0\n"), "part:2: 'x' is not a number");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0\n"), "part:1: a vertex has too few numbers");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 nan\n"), "part:1: 'nan' is not a number");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 0\nf 1 2 3\n"), "part:2: there is no vertex 2: 1 are defined so far");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 0\nf 0 1 1\n"),
            "part:2: '0' is not the number of a vertex (they count from 1)");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 0\nf 1/1 1 1\n"),
            "part:2: there is no texture coordinate 1: 0 are defined so far");
  EXPECT_EQ(error_of(MeshFormat::obj, "v 0 0 0\nf 1 1\n"), "part:2: a face needs at least three corners");
  EXPECT_EQ(error_of(MeshFormat::obj, ""), "part: the file has no triangles");

  EXPECT_EQ(error_of(MeshFormat::ply, "plx\n"), "part:1: the first line of a PLY file is 'ply'");
  EXPECT_EQ(error_of(MeshFormat::ply, "ply\nformat ascii 1.0\n"), "part:2: the header has no end_header");
  EXPECT_EQ(error_of(MeshFormat::ply, "ply\nformat text 1.0\n"),
            "part:2: unknown format 'text' (ascii, binary_little_endian or binary_big_endian)");
  EXPECT_EQ(
      error_of(MeshFormat::ply, std::string(kPlyHeader) + "0 0 0 255\n1 0 0\n1 1 0 2\n1 2 3 4\n3 1 1 1\n3 0 1 2\n"),
      "part:15: the line has too few numbers");
  EXPECT_EQ(error_of(MeshFormat::ply,
                     std::string(kPlyHeader) + "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n3 1 0 0\n3 0 1 4\n3 0 2 3\n"),
            "part:19: there is no vertex 4 (the first is 0, 4 are defined)");
  const std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\nabcd";
  EXPECT_EQ(error_of(MeshFormat::ply, binary), "part:byte " + std::to_string(binary.size() - 4) +
                                                   ": the file is too short for 2000000000 elements 'vertex'");

  EXPECT_EQ(error_of(MeshFormat::stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n"),
            "part:6: a facet has three vertices, not 1");
  EXPECT_EQ(error_of(MeshFormat::stl, "solid\nfacets\n"), "part:2: unknown word 'facets'");
  std::string cut = mesh_bytes(MeshFormat::stl, sample());
  cut.pop_back();
  EXPECT_NE(error_of(MeshFormat::stl, cut).find("part:byte 80: the file has"), std::string::npos);
  // A binary file that begins like a text is none.
  cut.replace(0, 28, "solid of lekalo, in a binary");
  EXPECT_NE(error_of(MeshFormat::stl, cut).find("part:byte 80: the file has"), std::string::npos);

  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(error_of(MeshFormat::ply, list + std::string(12, '\0') + "\4abcd"),
            fmt::format("part:byte {}: the file ends within a list of 4 entries", list.size() + 13));
}

TEST(MeshFiles, WordsOfTextStlInAnyCase) {
  const Mesh mesh = parse(MeshFormat::stl,
                          "SOLID a\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\n"
                          "ENDFACET\nENDSOLID a\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(MeshFiles, DamagedBytesNeverCrash) {
  // Every prefix in steps, and single bytes changed: an error or a mesh, nothing else (run under the sanitizers).
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::stl}) {
    const std::string good = mesh_bytes(format, tessellate(geometry::box(geometry::Frame{}, {1, 2, 3}), {}));
    const auto attempt = [&](std::string_view bytes) {
      try {
        for (const Mesh::Triangle& t : parse(format, bytes).triangles) ASSERT_GE(t.point[0], 0);
      } catch (const MeshFileError&) {
      }
    };
    for (size_t length = 0; length < good.size(); length += 7) attempt(std::string_view(good).substr(0, length));
    for (size_t at = 0; at < good.size(); at += 3)
      for (char byte : {'\0', '\xff', '9', '-', '\n'}) {
        std::string bad = good;
        bad[at] = byte;
        attempt(bad);
      }
  }
}

}  // namespace
}  // namespace lekalo::render::mesh_files_test
