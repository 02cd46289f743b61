#include "geometry/bodies/booleans/near_curve.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kJoint = 1e-13;  // of the domain: places that near to the end of a piece are that end

}  // namespace

NearCurve::NearCurve(CurvePtr curve) : curve_(std::move(curve)) {
  const std::vector<CurvePiece> pieces = curve_->pieces();
  const int parts = std::max(1, 32 / static_cast<int>(pieces.size()));
  ends_.push_back(curve_->domain().lo);
  for (const CurvePiece& piece : pieces)
    for (int k = 1; k <= parts; ++k)
      ends_.push_back(k == parts ? piece.domain.hi : piece.domain.lo + piece.domain.width() * k / parts);
  for (size_t k = 0; k < ends_.size(); ++k) {
    corners_.push_back(curve_->point(ends_[k]));
    if (k == 0) continue;
    const Vec3 a = corners_[k - 1], b = corners_[k];
    length_ += glm::length(b - a);
    for (const double part : {0.25, 0.5, 0.75}) {
      const Vec3 p = curve_->point(ends_[k - 1] + part * (ends_[k] - ends_[k - 1]));
      const double along = glm::dot(b - a, b - a);
      const Vec3 foot = a + (along > 0 ? glm::clamp(glm::dot(p - a, b - a) / along, 0.0, 1.0) : 0.0) * (b - a);
      sag_ = std::max(sag_, 2 * glm::length(p - foot));
    }
  }
  for (const Vec3& p : corners_) box_.include(p);
  box_ = box_.inflated(sag_);
}

template <class Visit>
void NearCurve::near_places(const Vec3& p, double near, Visit&& visit) const {
  if (!box_.inflated(near).contains(p)) return;
  const Interval domain = curve_->domain();
  for (size_t k = 0; k + 1 < corners_.size(); ++k) {
    const Vec3 chord = corners_[k + 1] - corners_[k];
    const double square = glm::dot(chord, chord);
    const double part = square > 0 ? glm::clamp(glm::dot(p - corners_[k], chord) / square, 0.0, 1.0) : 0.0;
    if (glm::length(corners_[k] + part * chord - p) > sag_ + near) continue;
    const Interval around{ends_[k], ends_[k + 1]};
    double t = ends_[k] + part * around.width();
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
      const CurveJet at = curve_->evaluate(t, 2);
      const Vec3 way = at.d[0] - p;
      const double slope = glm::dot(way, at.d[1]), speed = glm::dot(at.d[1], at.d[1]);
      double bend = speed + glm::dot(way, at.d[2]);
      if (!(bend > 0.25 * speed)) bend = speed;
      if (!(bend > 0)) break;
      const double before = t;
      t = domain.clamp(t - slope / bend);
      if (std::abs(t - before) <= 1e-16 * (std::abs(t) + domain.width())) break;
    }
    // Else a cut would leave a scrap of the next piece, whose derivatives are not quite those of this one.
    for (const double joint : {around.lo, around.hi})
      if (std::abs(t - joint) <= kJoint * domain.width()) t = joint;
    const double apart = glm::length(curve_->point(t) - p);
    if (apart <= near) visit(t, apart);
  }
}

std::optional<double> NearCurve::place_of(const Vec3& p, double near) const {
  std::optional<double> best;
  double nearest = near;
  near_places(p, near, [&](double t, double apart) {
    if (apart <= nearest) nearest = apart, best = t;
  });
  return best;
}

std::vector<double> NearCurve::places_of(const Vec3& p, double near) const {
  struct Place {
    double t, apart;
  };
  std::vector<Place> found;
  near_places(p, near, [&](double t, double apart) { found.push_back({t, apart}); });
  std::sort(found.begin(), found.end(), [](const Place& a, const Place& b) { return a.t < b.t; });
  const double one_passage = length_ > 0 ? 4 * near / length_ * curve_->domain().width() : kInfinity;
  std::vector<double> result;
  double last = 0, nearest = 0;
  for (const Place& place : found) {
    if (result.empty() || place.t - last > one_passage)
      result.push_back(place.t), nearest = place.apart;
    else if (place.apart <= nearest)
      result.back() = place.t, nearest = place.apart;
    last = place.t;
  }
  return result;
}

}  // namespace lekalo::geometry
