// The scene type of points and normals between the lines of a wire frame (Zavyalov et al. 1985, III.3).
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/frame_net.h"

namespace lekalo::render {

using namespace geometry;

TypeDeclaration frame_net_type() {
  return declare(Category::mesh, "frame_net",
                 "Mesh of points and normals of a surface of which a wire frame is known: they lie on splines through "
                 "the points where planes across a base plane meet the frame's lines.")
      .example(
          "of: [{ type: bezier_curve, points: [[0, 0], [1, 0, 1], [2, 0]] }, "
          "{ type: bezier_curve, points: [[0, 1], [1, 1, 1.5], [2, 1]] }, "
          "{ type: bezier_curve, points: [[0, 2], [1, 2, 1], [2, 2]] }, "
          "{ type: segment, from: [0, 0], to: [0, 2] }, { type: segment, from: [2, 0], to: [2, 2] }]")
      .field("of", references({Category::curve}), "the lines of the frame")
      .field("frame", frame(), "the surface projects one to one onto x, y of this frame; normals point along its z",
             "{}")
      .optional("range", rectangle(), "of x (u) and y (v); else that of the frame")
      .field("count", integer().between(2, 1000).for_each_direction(), "of sections along x (u) and y (v)", "12")
      .built_by([](const Fields& f) -> std::any {
        std::vector<CurvePtr> lines;
        for (const std::any& one : f.references("of")) lines.push_back(std::any_cast<CurvePtr>(one));
        const FrameNet net(lines, f.frame());
        const Rectangle range = f.has("range") ? f.rectangle("range") : net.range();
        return MeshPtr(std::make_shared<Mesh>(net.mesh(range, f.u<int>("count"), f.v<int>("count"))));
      });
}

}  // namespace lekalo::render
