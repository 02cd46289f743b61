#include "geometry/shape.h"

#include <stdexcept>

namespace lekalo::geometry {

Box3 TransformedShape::bounds() const {
  const Box3 box = original_->bounds();
  return box.bounded() ? geometry::transformed(box, map_) : box;
}

ShapePoint TransformedShape::point(const SurfaceHit& hit, const Vec3& near) const {
  ShapePoint at = original_->point(hit, inverse_.point(near));
  at.position = map_.point(at.position);
  at.normal = glm::normalize(glm::transpose(inverse_.linear) * at.normal);
  at.du = map_.direction(at.du);
  at.dv = map_.direction(at.dv);
  return at;
}

ShapePtr transformed(const ShapePtr& shape, const Affine& map) {
  if (map.is_identity()) return shape;
  if (!(std::abs(glm::determinant(map.linear)) > 0)) throw std::invalid_argument("the map is singular");
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
    return transformed(moved->original(), map * moved->map());
  return std::make_shared<TransformedShape>(shape, map);
}

}  // namespace lekalo::geometry
