// Shells of separate surfaces and bodies (Golovanov 2016, 5.1 to 5.4): sides that coincide become one edge.
#include <fmt/format.h>

#include <vector>

#include "geometry/bodies/topology/sew.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// The faces of a body that fill their surfaces' domains.
void add_faces(const Body& body, std::vector<SurfacePtr>& surfaces) {
  for (size_t i = 0; i < body.faces.size(); ++i) {
    if (body.faces[i].trimmed)
      throw FieldError("of", fmt::format("face {} of a body is trimmed: only whole surfaces are sewn", i),
                       "bodies with faces of four sides, like boxes");
    surfaces.push_back(body.faces[i].surface);
  }
}

Body sewn(const Fields& f) {
  std::vector<SurfacePtr> surfaces;
  for (const std::any& one : f.references("of")) {
    if (const auto* body = std::any_cast<BodyPtr>(&one))
      add_faces(**body, surfaces);
    else
      surfaces.push_back(std::any_cast<SurfacePtr>(one));
  }
  if (surfaces.empty()) throw FieldError("of", "there is nothing to sew", "surfaces whose sides coincide");
  try {
    return f.boolean("solid") ? enclosed_by(surfaces, f.number("tolerance"))
                              : sew(surfaces, f.number("tolerance"), true);
  } catch (const FieldError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
}

}  // namespace

TypeDeclaration sewn_shell_type() {
  return declare(Category::body, "sewn_shell",
                 "Surfaces joined along sides that coincide: an open shell, or a body where they enclose one. 'lekalo "
                 "measure --topology' tells what it is, non-manifold and one-sided ones too. Faces: face.k.")
      .example(
          "of: [{ type: bilinear_surface, points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]] }, { type: "
          "bilinear_surface, points: [[[1, 0, 0], [1, 1, 0]], [[2, 0, 1], [2, 1, 1]]] }]")
      .field("of", references({Category::surface, Category::body}), "surfaces, and bodies for all of their faces")
      .field("solid", boolean(), "they enclose a body: faces are turned to look outward, and an opening is an error",
             "false")
      .field("tolerance", number().positive().at_most(1e-3), "of coincidence, relative to the size of all", "1e-9")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(sewn(f)); });
}

}  // namespace lekalo::geometry
