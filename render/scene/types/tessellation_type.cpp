// The scene type of the triangles into which a surface or a body is divided, as a mesh of its own (Golovanov 2016, 8.7
// and 8.8).
#include "geometry/describe.h"
#include "geometry/tessellation/tessellate.h"

namespace lekalo::render {

using namespace geometry;

TypeDeclaration tessellation_type() {
  return declare(Category::mesh, "tessellation",
                 "The triangles into which a surface or a body is divided. Its smooth and sharp lines are their sides.")
      .example("of: { type: torus_surface, major_radius: 2, minor_radius: 1 }, angle: 25")
      .field("of", reference({Category::surface, Category::body}), "what is divided; a body without cracks")
      .optional("sag", length().positive(), "largest distance from the surface")
      .field("angle", angle().above(0).at_most(kPi / 2), "largest turn of the normal along u and along v", "10")
      .built_by([](const Fields& f) -> std::any {
        const std::any& of = f.any("of");
        TessellationTolerance tolerance;
        tolerance.angle = f.number("angle");
        tolerance.sag = f.has("sag") ? f.number("sag") : kInfinity;
        try {
          if (const auto* body = std::any_cast<BodyPtr>(&of))
            return MeshPtr(std::make_shared<Mesh>(tessellate(**body, tolerance)));
          return MeshPtr(std::make_shared<Mesh>(tessellate(*f.surface("of"), tolerance)));
        } catch (const std::invalid_argument& error) {
          throw FieldError("of", error.what());
        }
      });
}

}  // namespace lekalo::render
