#include "geometry/queries/differential/regularity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

// Parts of a piece, and of each direction of a surface's, that are not halved any more.
constexpr double kSmallestPart = 0x1p-30;
constexpr double kSmallestSide = 0x1p-9;
// Bounds are made this tight, if that takes no more parts.
constexpr double kTight = 1.01;
constexpr int kPartsForBounds = 20000;
constexpr double kSmallestTight = 0x1p-16;
// Of the largest speed or area: less is rounding, that of a pole whose parameter is written in decimals.
constexpr double kVanishes = 1e-12;

double min_length(const Box3& box) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Interval x = along(box, k);
    const double d = std::max({x.lo, -x.hi, 0.0});
    sum += d * d;
  }
  return std::sqrt(sum) * (1 - 1e-15);
}

double greatest_length(const Box3& box) {
  return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) * (1 + 1e-15);
}

class CurveSearch {
 public:
  explicit CurveSearch(const Curve& curve) : curve_(curve) {}

  CurveRegularity run() {
    result_.min_speed = kInfinity;
    for (const CurvePiece& piece : curve_.pieces()) {
      ++result_.pieces;
      for (int k = 0; k <= 64; ++k) sample(piece.domain, piece.domain.lo + piece.domain.width() * k / 64);
      look(piece.domain, piece.domain);
    }
    if (!result_.is_regular()) result_.min_speed = 0, result_.curvature_bound = kInfinity;
    return result_;
  }

 private:
  void sample(const Interval& piece, double t) {
    const CurveJet jet = evaluate_within(curve_, piece, t, 2);
    const double speed = glm::length(jet.d[1]);
    if (!(speed > 0)) return;
    slowest_ = std::min(slowest_, speed);
    fastest_ = std::max(fastest_, speed);
    max_bent_ = std::max(max_bent_, glm::length(glm::cross(jet.d[1], jet.d[2])) / (speed * speed * speed));
  }

  void look(const Interval& piece, const Interval& t) {
    const CurveEnclosure box = curve_.enclose(t, 2);
    const double speed = min_length(box.d[1]);
    const double bend = greatest_length(box_of(cross(triple(box.d[1]), triple(box.d[2])))) / (speed * speed * speed);
    const bool is_proven = speed > kVanishes * fastest_;
    const bool is_tight = speed * kTight >= slowest_ && bend <= kTight * max_bent_ + 1e-12 / curve_size();
    const double share = t.width() / piece.width();
    if (is_proven && (is_tight || share <= kSmallestTight || ++parts_ > kPartsForBounds)) {
      result_.min_speed = std::min(result_.min_speed, speed);
      result_.curvature_bound = std::max(result_.curvature_bound, bend);
    } else if (share <= kSmallestPart || !(t.lo < t.middle() && t.middle() < t.hi)) {
      add_singular(piece, t.middle());
    } else {
      look(piece, {t.lo, t.middle()});
      look(piece, {t.middle(), t.hi});
    }
  }

  void add_singular(const Interval& piece, double t) {
    const double beside = 1e-6 * piece.width();
    if (result_.singular.empty() || std::abs(result_.singular.back() - t) > beside) result_.singular.push_back(t);
  }

  double curve_size() {
    if (size_ == 0) size_ = std::max(bounds(curve_).diameter(), 1e-300);
    return size_;
  }

  const Curve& curve_;
  CurveRegularity result_;
  double slowest_ = kInfinity, fastest_ = 0, max_bent_ = 0, size_ = 0;
  int parts_ = 0;
};

class SurfaceSearch {
 public:
  explicit SurfaceSearch(const Surface& surface) : surface_(surface) {}

  SurfaceRegularity run() {
    result_.min_area = kInfinity;
    const Rectangle domain = surface_.domain();
    for (int i = 0; i <= 16; ++i)
      for (int j = 0; j <= 16; ++j) {
        const SurfaceJet jet =
            surface_.evaluate(domain.u.lo + domain.u.width() * i / 16, domain.v.lo + domain.v.width() * j / 16, 1);
        const double area = glm::length(glm::cross(jet.du(), jet.dv()));
        smallest_ = std::min(smallest_, area);
        largest_ = std::max(largest_, area);
      }
    for (const SurfacePiece& piece : surface_.pieces()) look(piece.domain, piece.domain);
    if (!result_.is_regular()) result_.min_area = 0;
    return result_;
  }

 private:
  void look(const Rectangle& piece, const Rectangle& part) {
    const SurfaceEnclosure box = surface_.enclose(part, 1);
    const double area = min_length(box_of(cross(triple(box.d(1, 0)), triple(box.d(0, 1)))));
    const double share = part.u.width() / piece.u.width();
    if (area > kVanishes * largest_ && (area * 1.1 >= smallest_ || share <= 1.0 / 64)) {
      result_.min_area = std::min(result_.min_area, area);
      return;
    }
    if (share <= kSmallestSide) return add_singular(part);
    const double u = part.u.middle(), v = part.v.middle();
    for (const Interval& a : {Interval(part.u.lo, u), Interval(u, part.u.hi)})
      for (const Interval& b : {Interval(part.v.lo, v), Interval(v, part.v.hi)}) look(piece, {a, b});
  }

  // Joined with all that it touches.
  void add_singular(Rectangle part) {
    auto& all = result_.singular;
    for (size_t i = 0; i < all.size();) {
      const bool touches =
          all[i].u.lo <= part.u.hi && part.u.lo <= all[i].u.hi && all[i].v.lo <= part.v.hi && part.v.lo <= all[i].v.hi;
      if (!touches) {
        ++i;
        continue;
      }
      part = {hull(part.u, all[i].u), hull(part.v, all[i].v)};
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    all.push_back(part);
  }

  const Surface& surface_;
  SurfaceRegularity result_;
  double smallest_ = kInfinity, largest_ = 0;
};

}  // namespace

CurveRegularity regularity(const Curve& curve) {
  if (!(curve.domain().width() < kInfinity)) throw std::invalid_argument("the curve is unbounded");
  return CurveSearch(curve).run();
}

SurfaceRegularity regularity(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded");
  return SurfaceSearch(surface).run();
}

}  // namespace lekalo::geometry
