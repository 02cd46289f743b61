// The geometry types that come from files, and meshes: one line each; their readers belong to this folder because
// geometry knows no files.
#include "geometry/describe.h"
#include "geometry/surfaces/splines/patches.h"
#include "render/model/model.h"
#include "render/scene/yaml/include.h"

#define LEKALO_FILE_TYPES(X) \
  X(patches_type)            \
  X(mesh_type)               \
  X(triangulation_type)      \
  X(tessellation_type)       \
  X(frame_net_type)          \
  X(model_type)              \
  X(control_triangles_type)  \
  X(surfel_net_type)

namespace lekalo::geometry {

TypeDeclaration control_triangles_type();
TypeDeclaration surfel_net_type();

}  // namespace lekalo::geometry

namespace lekalo::render {

using namespace geometry;

TypeDeclaration patches_type() {
  TypeDeclaration type = declare(Category::surface, "patches",
                                 "A set of bicubic Bezier patches read from a text file: the count, then 16 points for "
                                 "each patch, four rows of four.");
  type.example("file: data/newell_teapot.txt");
  type.field("file", file(), "text file; data/newell_teapot.txt comes with the program");
  type.built_by([](const Fields& fields) -> std::any {
    std::string reason;
    const auto text = read_file(fields.text("file"), 64'000'000, true, reason);
    if (!text) throw FieldError("file", reason);
    return SurfaceSet(parse_patches(*text));
  });
  return type;
}

TypeDeclaration mesh_type();
TypeDeclaration triangulation_type();
TypeDeclaration tessellation_type();
TypeDeclaration frame_net_type();
TypeDeclaration model_type();

#define CALL(type) type(),
std::vector<TypeDeclaration> file_types() { return {LEKALO_FILE_TYPES(CALL)}; }

}  // namespace lekalo::render
