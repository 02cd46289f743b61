#include "geometry/surface.h"

#include <algorithm>
#include <stdexcept>

namespace lekalo::geometry {

void LineHits::add_to_more(double t, double u, double v) {
  if (!more_) more_ = std::make_unique<std::vector<LineHit>>();
  more_->push_back({t, u, v});
  ++count_;
}

void Surface::evaluate_many(std::span<const Vec2> uv, int order, std::span<SurfaceJet> result) const {
  for (size_t i = 0; i < uv.size(); ++i) result[i] = evaluate(uv[i].x, uv[i].y, order);
}

std::vector<SurfacePiece> Surface::pieces() const {
  if (!bounded()) return {};
  if (const auto form = as_nurbs()) return bezier_pieces(*form, domain());
  SurfacePiece piece;
  piece.domain = domain();
  piece.map_u = {ParameterMap::Kind::affine, piece.domain.u.lo, piece.domain.u.hi};
  piece.map_v = {ParameterMap::Kind::affine, piece.domain.v.lo, piece.domain.v.hi};
  return {piece};
}

FootPoint Surface::foot_point(const Vec3&) const { throw std::logic_error("this surface does not know its feet"); }

void Surface::line_hits(const Line&, const Interval&, LineHits&) const {
  throw std::logic_error("this surface has no formula for lines");
}

Vec3 Surface::normal(double u, double v) const {
  return normal_sign() * parametric_normal(*this, u, v, evaluate(u, v, 1));
}

Vec3 Surface::normal(double u, double v, const SurfaceJet& jet) const {
  // Well away from singular points the cross product is good to its last digits.
  constexpr double kRegular = 1e-6;
  const Vec3 across = glm::cross(jet.du(), jet.dv());
  const double area2 = glm::dot(across, across);
  if (!(area2 > kRegular * kRegular * glm::dot(jet.du(), jet.du()) * glm::dot(jet.dv(), jet.dv()))) return normal(u, v);
  return (normal_sign() / std::sqrt(area2)) * across;
}

Box3 bounds(const Surface& surface, const SurfacePiece& piece) {
  Box3 box;
  if (piece.is_rational() && control_point_box(piece.points, box)) return box;
  return surface.enclose(piece.domain, 0).values[0];
}

Box3 bounds(const Surface& surface) {
  if (!surface.bounded()) return Box3::everything();
  Box3 box;
  for (const SurfacePiece& piece : surface.pieces()) box.include(bounds(surface, piece));
  return box;
}

}  // namespace lekalo::geometry
