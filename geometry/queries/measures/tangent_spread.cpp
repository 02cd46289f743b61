#include "geometry/queries/measures/tangent_spread.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Places of the curve from which the search begins, and of a piece.
constexpr int kPlaces = 2048, kMinPlaces = 8, kPlacesOfPiece = 256;
// Halvings of the step by which the best pair is searched further.
constexpr int kHalvings = 45;

struct Place {
  double t;
  Interval piece;
  Vec3 tangent;
};

// Zero where the curve rests.
Vec3 tangent_at(const Curve& curve, double t, const Interval& piece) {
  const Vec3 d = curve.evaluate(std::min(t, next_down(piece.hi)), 1).d[1];
  return glm::length(d) > 0 ? glm::normalize(d) : Vec3(0);
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

}  // namespace

TangentSpread tangent_spread(const Curve& curve) {
  if (!(curve.domain().width() < kInfinity)) throw std::invalid_argument("the curve is unbounded");
  const std::vector<CurvePiece> pieces = curve.pieces();
  const int count = std::clamp(kPlaces / static_cast<int>(pieces.size()), kMinPlaces, kPlacesOfPiece);
  std::vector<Place> places;  // in the order of t
  for (const CurvePiece& piece : pieces)
    for (int i = 0; i <= count; ++i) {
      const Interval range = intersect(piece.domain, curve.domain());
      const double t = range.lo + range.width() * i / count;
      const Vec3 tangent = tangent_at(curve, t, range);
      if (tangent != Vec3(0)) places.push_back({t, range, tangent});
    }
  TangentSpread best;
  double least = 1;  // cosine of the angle
  const Place *first = nullptr, *second = nullptr;
  for (auto a = places.begin(); a != places.end(); ++a)
    for (auto b = std::next(a); b != places.end(); ++b)
      if (const double cosine = glm::dot(a->tangent, b->tangent); cosine < least && a->t < b->t) {
        least = cosine;
        first = &*a, second = &*b;
      }
  if (first) best = {angle_between(first->tangent, second->tangent), first->t, second->t};
  if (!first) return best;
  const auto angle = [&](double s, double t) {
    return angle_between(tangent_at(curve, s, first->piece), tangent_at(curve, t, second->piece));
  };
  const double step_s = first->piece.width() / count, step_t = second->piece.width() / count;
  double step = 0.5;
  for (int halving = 0; halving < kHalvings; ++halving, step /= 2)
    for (const Vec2 by : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
      const double s = first->piece.clamp(best.s + step * by.x * step_s);
      const double t = second->piece.clamp(best.t + step * by.y * step_t);
      if (const double wider = angle(s, t); wider > best.angle) best = {wider, s, t};
    }
  return best;
}

}  // namespace lekalo::geometry
