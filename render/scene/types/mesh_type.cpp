// The scene type of meshes from files.
#include "geometry/describe.h"
#include "geometry/mesh.h"
#include "render/mesh_files/mesh_files.h"

namespace lekalo::render {

using namespace geometry;

TypeDeclaration mesh_type() {
  return declare(Category::mesh, "mesh", "Triangle mesh from an OBJ, PLY or STL file.")
      .example("file: part.stl")
      .field("file", file(), "file that ends in .obj, .ply or .stl")
      .field("normals", choice({"file", "smooth", "flat"}),
             "file: those of the file, smooth where it has none; smooth: means of the meeting triangles; flat: of each "
             "triangle's plane",
             "file")
      .optional("crease_angle", angle().between(0, geometry::kPi),
                "triangles that meet at a larger angle get no smooth normals across their common side; without it all "
                "do")
      .built_by([](const Fields& f) -> std::any {
        Mesh mesh;
        try {
          mesh = read_mesh(f.text("file"));
        } catch (const MeshFileError& error) {
          throw FieldError("file", error.what());
        }
        const std::string& normals = f.text("normals");
        if (normals == "flat")
          set_flat_normals(mesh);
        else if (normals == "smooth" || mesh.normals.empty())
          set_smooth_normals(mesh, f.has("crease_angle") ? f.number("crease_angle") : kPi);
        return MeshPtr(std::make_shared<Mesh>(std::move(mesh)));
      });
}

}  // namespace lekalo::render
