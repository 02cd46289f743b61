#include "geometry/surface.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/curves/blossom.h"
#include "geometry/curves/knot_spans.h"

namespace lekalo::geometry {

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

Foot Surface::foot(const Vec3&) const { throw std::logic_error("this surface does not know its feet"); }

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

namespace {

// Parts have bounds where the whole has none that its weights, some of them negative, would show; those of a few parts
// more are much closer.
constexpr int kHalvings = 16, kFewest = 8;

Box3 enclosed(const Surface& surface, const Rectangle& part, int depth) {
  Box3 box = surface.enclose(part, 0).values[0];
  const bool is_enough = box.bounded() ? depth == 0 || depth >= kFewest : depth == kHalvings;
  if (is_enough || !(std::max(part.u.width(), part.v.width()) < kInfinity)) return box;
  Rectangle first = part, second = part;
  if (depth % 2 == 0)
    first.u.hi = second.u.lo = part.u.middle();
  else
    first.v.hi = second.v.lo = part.v.middle();
  box = enclosed(surface, first, depth + 1);
  if (box.bounded()) box.include(enclosed(surface, second, depth + 1));
  return box;
}

}  // namespace

Box3 bounds(const Surface& surface, const SurfacePiece& piece) {
  Box3 box;
  if (piece.is_rational() && control_point_box(piece.points, box)) return box;
  return enclosed(surface, piece.domain, 0);
}

Box3 bounds(const Surface& surface) {
  if (!surface.bounded()) return Box3::everything();
  Box3 box;
  for (const SurfacePiece& piece : surface.pieces()) box.include(bounds(surface, piece));
  return box;
}

std::vector<SurfacePiece> bezier_pieces(const NurbsSurfaceForm& form, const Rectangle& domain) {
  const auto parts_u = span_parts(form.degree_u, form.knots_u, form.maps_u, domain.u);
  const auto parts_v = span_parts(form.degree_v, form.knots_v, form.maps_v, domain.v);
  const int p = form.degree_u, q = form.degree_v, count_v = form.count_v();
  std::vector<SurfacePiece> pieces;
  pieces.reserve(parts_u.size() * parts_v.size());
  std::vector<Vec4> strip(static_cast<size_t>(p + 1) * count_v);  // Bezier in u, still B-spline in v
  for (const SpanPart& part_u : parts_u) {
    for (int j = 0; j < count_v; ++j)
      bezier_points(p, form.knots_u, part_u.span, form.points.data() + j, count_v, part_u.rational.lo,
                    part_u.rational.hi, strip.data() + j, count_v);
    for (const SpanPart& part_v : parts_v) {
      SurfacePiece piece;
      piece.domain = {part_u.natural, part_v.natural};
      piece.map_u = part_u.map;
      piece.map_v = part_v.map;
      piece.degree_u = p;
      piece.degree_v = q;
      piece.points.resize(static_cast<size_t>(p + 1) * (q + 1));
      for (int i = 0; i <= p; ++i)
        bezier_points(q, form.knots_v, part_v.span, strip.data() + static_cast<size_t>(i) * count_v, 1,
                      part_v.rational.lo, part_v.rational.hi, piece.points.data() + static_cast<size_t>(i) * (q + 1),
                      1);
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace lekalo::geometry
