#include "geometry/queries/closest/face_adjacency.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// What leaves a line or plane by less than this part of its size is straight or plane.
constexpr double kFlat = 1e-13;
// Directions tried about a corner.
constexpr int kDirections = 16;

std::array<double, 2> direction(int k, int count) {
  const double angle = kTwoPi * k / count;
  // Along a border exactly, not a rounding error beyond.
  const auto exact = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
  return {exact(std::cos(angle)), exact(std::sin(angle))};
}

bool go_on(const ParameterMap& before, const ParameterMap& behind) {
  return before.kind != ParameterMap::Kind::affine && behind.kind != ParameterMap::Kind::affine;
}

}  // namespace

std::optional<DistanceStep> FaceAdjacency::step(const Vec2& from, const std::array<double, 2>& direction) const {
  std::array<double, 2> to{from.x + kSmallStep * scale[0] * direction[0],
                           from.y + kSmallStep * scale[1] * direction[1]};
  if (trim && !trim->contains(to[0], to[1])) return std::nullopt;
  const Periods periods = surface->periods();
  const Rectangle domain = surface->domain();
  if (periods.u > 0) to[0] -= periods.u * std::floor((to[0] - domain.u.lo) / periods.u);
  if (periods.v > 0) to[1] -= periods.v * std::floor((to[1] - domain.v.lo) / periods.v);
  for (const DistanceElement* patch : patches) {
    if (!patch->domain[0].contains(to[0]) || !patch->domain[1].contains(to[1])) continue;
    DistanceStep step{patch, {}, direction};
    for (int i = 0; i < 2; ++i) step.at[i] = patch->domain[i].clamp(to[i] - kSmallStep * scale[i] * direction[i]);
    return step;
  }
  return std::nullopt;
}

void FaceAdjacency::add_all_around(const Vec2& from, std::vector<DistanceStep>& steps) const {
  for (int k = 0; k < kDirections; ++k)
    if (const auto one = step(from, direction(k, kDirections))) steps.push_back(*one);
}

void FaceAdjacency::add_across(const CurveJet& image, std::vector<DistanceStep>& steps) const {
  const double a = image.d[1].x / scale[0], b = image.d[1].y / scale[1], length = std::hypot(a, b);
  if (!(length > 0)) return add_all_around(Vec2(image.d[0]), steps);
  for (const double side : {1.0, -1.0})
    if (const auto one = step(Vec2(image.d[0]), {-side * b / length, side * a / length})) steps.push_back(*one);
}

std::vector<double> FaceAdjacency::sharp_places(int i, const Rectangle& domain, const Rectangle& borders) const {
  const Interval range = i == 0 ? domain.u : domain.v, other = i == 0 ? domain.v : domain.u;
  const Interval border = i == 0 ? borders.u : borders.v;
  const Periods periods = surface->periods();
  const double period = i == 0 ? periods.u : periods.v;
  const bool periodic = period > 0 && std::abs(period - range.width()) <= kDomainSlack * range.width();
  const auto is_crease = [&](double below, double above) {
    for (int k = 0; k <= 8; ++k) {
      const double t = other.lo + other.width() * k / 8;
      const auto across = [&](double at) {
        const SurfaceJet s = i == 0 ? surface->evaluate(at, t, 1) : surface->evaluate(t, at, 1);
        return i == 0 ? s.du() : s.dv();
      };
      const Vec3 a = across(within({range.lo, below}, below)), b = across(above);
      if (glm::length(a * glm::length(b) - b * glm::length(a)) > kSharp * glm::length(a) * glm::length(b)) return true;
    }
    return false;
  };
  std::vector<double> places;
  for (const DistanceElement* patch : patches)
    if (patch->domain[i].lo > range.lo) places.push_back(patch->domain[i].lo);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::erase_if(places, [&](double at) { return !is_crease(at, at); });
  if (periodic && is_crease(range.hi, range.lo)) places.push_back(range.lo);
  if (!periodic && border.lo == range.lo) places.push_back(range.lo);
  if (!periodic && border.hi == range.hi) places.push_back(range.hi);
  return places;
}

void FaceAdjacency::mark(int i, double at) {
  const Rectangle domain = surface->domain();
  const Interval range = i == 0 ? domain.u : domain.v;
  const bool seam = at == range.lo && (i == 0 ? surface->periods().u : surface->periods().v) > 0;
  for (DistanceElement* patch : patches) {
    if (patch->domain[i].lo == at) patch->ends_lo[i] = true;
    if (patch->domain[i].hi == at || (seam && patch->domain[i].hi == range.hi)) patch->ends_hi[i] = true;
  }
}

std::vector<CurvePiece> smooth_pieces(const Curve& curve) {
  std::vector<CurvePiece> result;
  for (CurvePiece& piece : curve.pieces()) {
    if (result.empty() || !go_on(result.back().map, piece.map)) {
      result.push_back(std::move(piece));
      continue;
    }
    result.back().domain.hi = piece.domain.hi;
    result.back().points.clear();
  }
  return result;
}

std::vector<SurfacePiece> smooth_pieces(const Surface& surface) {
  // Those that begin in the same column and row as one before.
  std::vector<SurfacePiece> result;
  for (SurfacePiece& piece : surface.pieces()) {
    bool joined = false;
    for (SurfacePiece& other : result) {
      Rectangle &all = other.domain, &own = piece.domain;
      const bool beside = all.v == own.v && all.u.hi == own.u.lo && go_on(other.map_u, piece.map_u);
      const bool above = all.u == own.u && all.v.hi == own.v.lo && go_on(other.map_v, piece.map_v);
      if (!beside && !above) continue;
      all = {hull(all.u, own.u), hull(all.v, own.v)};
      other.points.clear();
      joined = true;
      break;
    }
    if (!joined) result.push_back(std::move(piece));
  }
  return result;
}

bool is_straight(const CurvePiece& piece, const Curve& curve, DistanceElement& element) {
  const CurveJet jet = evaluate_within(curve, piece.domain, piece.domain.middle(), 1);
  const double length = glm::length(jet.d[1]), size = element.box.diameter();
  if (!(length > 0)) return false;
  element.axis = jet.d[1] / length;
  if (piece.is_rational())
    return std::all_of(piece.points.begin(), piece.points.end(), [&](const Vec4& p) {
      return glm::length(glm::cross(Vec3(p) / p.w - jet.d[0], element.axis)) <= kFlat * size;
    });
  const Box3 second = curve.enclose(piece.domain, 2).d[2];
  const double width = piece.domain.width();
  return glm::length(glm::max(glm::abs(second.lo), glm::abs(second.hi))) * width * width <= kFlat * size;
}

bool is_plane(const SurfacePiece& piece, const Surface& surface, DistanceElement& element) {
  const SurfaceJet jet = evaluate_within(surface, piece.domain, piece.domain.u.middle(), piece.domain.v.middle(), 1);
  const Vec3 across = glm::cross(jet.du(), jet.dv());
  const double length = glm::length(across), size = element.box.diameter();
  if (!(length > 0)) return false;
  element.axis = across / length;
  if (piece.is_rational())
    return std::all_of(piece.points.begin(), piece.points.end(), [&](const Vec4& p) {
      return std::abs(glm::dot(Vec3(p) / p.w - jet.point(), element.axis)) <= kFlat * size;
    });
  if (dynamic_cast<const Plane*>(&surface)) return true;
  const SurfaceEnclosure over = surface.enclose(piece.domain, 2);
  const auto bends = [&](const Box3& box, double a, double b) {
    return !(glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) * a * b <= kFlat * size);
  };
  const double u = piece.domain.u.width(), v = piece.domain.v.width();
  return !bends(over.d(2, 0), u, u) && !bends(over.d(1, 1), u, v) && !bends(over.d(0, 2), v, v);
}

}  // namespace lekalo::geometry
