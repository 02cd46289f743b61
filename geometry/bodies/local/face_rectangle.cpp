#include "geometry/bodies/local/face_rectangle.h"

#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

SurfacePtr over_its_rectangle(const Body& body, int number) {
  const Face& face = body.faces[number];
  Rectangle domain = face.surface->domain();
  if (face.trimmed) {
    Box3 box;
    for (const int c : body.loops[face.loops[0]].coedges) {
      const Curve& image = *body.coedges[c].image;
      for (const CurvePiece& piece : image.pieces())
        for (int k = 0; k <= 16; ++k) box.include(image.point(piece.domain.lo + piece.domain.width() * k / 16));
    }
    domain = {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}};
  }
  auto base = std::const_pointer_cast<Surface>(extended_to(face.surface, domain));
  base->set_reversed(face.surface->reversed() == face.forward);
  return base;
}

}  // namespace lekalo::geometry
