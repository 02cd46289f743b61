// The oracle of visibility: how often a line enters or leaves solids before a point, by closed forms in long double
// that share nothing with the product. Solids are balls, boxes, frustums, tori, and what union and difference make of
// them: the line's crossings with all parts, of which those count where inside and outside change.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::oracle::sight {

using geometry::Frame;
using geometry::Vec3;
using Real = long double;

struct Real3 {
  Real x, y, z;
};
inline Real dot(const Real3& a, const Real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Real roots of a polynomial c[0] + c[1] t + ..: between those of its derivative by halving.
inline std::vector<Real> roots(const std::vector<Real>& c, Real lo, Real hi) {
  std::vector<Real> result;
  if (c.size() < 2) return result;
  if (c.size() == 2) {
    if (c[1] != 0 && -c[0] / c[1] >= lo && -c[0] / c[1] <= hi) result.push_back(-c[0] / c[1]);
    return result;
  }
  std::vector<Real> slope;
  for (size_t k = 1; k < c.size(); ++k) slope.push_back(c[k] * static_cast<Real>(k));
  std::vector<Real> cuts = roots(slope, lo, hi);
  cuts.insert(cuts.begin(), lo);
  cuts.push_back(hi);
  const auto value = [&](Real t) {
    Real sum = 0;
    for (size_t k = c.size(); k-- > 0;) sum = sum * t + c[k];
    return sum;
  };
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    Real a = cuts[k], b = cuts[k + 1];
    const bool below = value(a) < 0;
    if (below == (value(b) < 0)) continue;
    for (int step = 0; step < 200 && a < b; ++step) {
      const Real middle = (a + b) / 2;
      if (middle == a || middle == b) break;
      ((value(middle) < 0) == below ? a : b) = middle;
    }
    result.push_back((a + b) / 2);
  }
  return result;
}

class Solid {
 public:
  virtual ~Solid() = default;
  // Where the line o + t d may cross the boundary, and whether the point lies inside. Two crossings of one part that
  // both lie within `contact` of t = 1 are none: there the line only touches.
  virtual void crossings(const Real3& o, const Real3& d, Real contact, std::vector<Real>& t) const = 0;
  virtual bool contains(const Real3& p) const = 0;
};
using SolidPtr = std::shared_ptr<const Solid>;

// A solid in a frame of its own.
class Placed : public Solid {
 public:
  explicit Placed(const Frame& frame) : frame_(frame) {}
  void crossings(const Real3& o, const Real3& d, Real contact, std::vector<Real>& t) const override {
    std::vector<Real> own;
    local_crossings(local(o, true), local(d, false), own);
    const auto near = [&](Real at) { return std::abs(at - 1) < contact; };
    const bool touches = std::count_if(own.begin(), own.end(), near) > 1;
    for (const Real at : own)
      if (!touches || !near(at)) t.push_back(at);
  }
  bool contains(const Real3& p) const override { return local_contains(local(p, true)); }

 protected:
  virtual void local_crossings(const Real3& o, const Real3& d, std::vector<Real>& t) const = 0;
  virtual bool local_contains(const Real3& p) const = 0;
  static constexpr Real kFar = 1e6L;

 private:
  static Real3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }
  Real3 local(const Real3& p, bool point) const {
    Real3 q = p;
    if (point) q = {p.x - frame_.origin.x, p.y - frame_.origin.y, p.z - frame_.origin.z};
    return {dot(q, wide(frame_.x)), dot(q, wide(frame_.y)), dot(q, wide(frame_.z))};
  }
  Frame frame_;
};

class BallSolid final : public Placed {
 public:
  BallSolid(const Frame& frame, double radius) : Placed(frame), radius_(radius) {}

 protected:
  void local_crossings(const Real3& o, const Real3& d, std::vector<Real>& t) const override {
    for (const Real root : roots({dot(o, o) - radius_ * radius_, 2 * dot(o, d), dot(d, d)}, -kFar, kFar))
      t.push_back(root);
  }
  bool local_contains(const Real3& p) const override { return dot(p, p) < radius_ * radius_; }

 private:
  Real radius_;
};

// From the frame's origin to `size`.
class BoxSolid final : public Placed {
 public:
  BoxSolid(const Frame& frame, const Vec3& size) : Placed(frame), size_{size.x, size.y, size.z} {}

 protected:
  void local_crossings(const Real3& o, const Real3& d, std::vector<Real>& t) const override {
    const Real from[] = {o.x, o.y, o.z}, way[] = {d.x, d.y, d.z}, size[] = {size_.x, size_.y, size_.z};
    for (int k = 0; k < 3; ++k)
      if (way[k] != 0) t.push_back(-from[k] / way[k]), t.push_back((size[k] - from[k]) / way[k]);
  }
  bool local_contains(const Real3& p) const override {
    return p.x > 0 && p.y > 0 && p.z > 0 && p.x < size_.x && p.y < size_.y && p.z < size_.z;
  }

 private:
  Real3 size_;
};

// About z from 0 to the height; its radius goes from one to the other.
class FrustumSolid final : public Placed {
 public:
  FrustumSolid(const Frame& frame, double radius, double top, double height)
      : Placed(frame), radius_(radius), slope_((top - radius) / static_cast<Real>(height)), height_(height) {}

 protected:
  void local_crossings(const Real3& o, const Real3& d, std::vector<Real>& t) const override {
    if (d.z != 0) t.push_back(-o.z / d.z), t.push_back((height_ - o.z) / d.z);
    const Real r0 = radius_ + slope_ * o.z, r1 = slope_ * d.z;
    for (const Real root : roots(
             {o.x * o.x + o.y * o.y - r0 * r0, 2 * (o.x * d.x + o.y * d.y - r0 * r1), d.x * d.x + d.y * d.y - r1 * r1},
             -kFar, kFar))
      t.push_back(root);
  }
  bool local_contains(const Real3& p) const override {
    const Real r = radius_ + slope_ * p.z;
    return p.z > 0 && p.z < height_ && p.x * p.x + p.y * p.y < r * r;
  }

 private:
  Real radius_, slope_, height_;
};

class TorusSolid final : public Placed {
 public:
  TorusSolid(const Frame& frame, double major, double minor) : Placed(frame), major_(major), minor_(minor) {}

 protected:
  // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2), from the line's point nearest to the centre.
  void local_crossings(const Real3& start, const Real3& d, std::vector<Real>& t) const override {
    const Real dd = dot(d, d), near = -dot(start, d) / dd;
    const Real3 o{start.x + near * d.x, start.y + near * d.y, start.z + near * d.z};
    const Real a0 = dot(o, o) + major_ * major_ - minor_ * minor_, a1 = 2 * dot(o, d);
    const Real q = 4 * major_ * major_;
    const std::vector<Real> c{a0 * a0 - q * (o.x * o.x + o.y * o.y), 2 * a0 * a1 - 2 * q * (o.x * d.x + o.y * d.y),
                              2 * a0 * dd + a1 * a1 - q * (d.x * d.x + d.y * d.y), 2 * a1 * dd, dd * dd};
    const Real reach = 2 * (major_ + minor_) / std::sqrt(dd);
    for (const Real root : roots(c, -reach, reach)) t.push_back(root + near);
  }
  bool local_contains(const Real3& p) const override {
    const Real rho = std::sqrt(p.x * p.x + p.y * p.y) - major_;
    return rho * rho + p.z * p.z < minor_ * minor_;
  }

 private:
  Real major_, minor_;
};

// All balls of one radius about a curve: what they fill of a line is, for each stretch of the parameter on which they
// meet it, one interval. Stretches are found at places close together, closer still where balls only just meet the line
// or miss it; ends of intervals by parts of three.
class TubeSolid final : public Solid {
 public:
  TubeSolid(std::function<Real3(Real)> curve, Real length, Real radius)
      : curve_(std::move(curve)), length_(length), radius_(radius) {
    for (int k = 0; k <= kPlaces; ++k) places_.push_back(curve_(length_ * k / kPlaces));
  }
  void crossings(const Real3& o, const Real3& d, Real contact, std::vector<Real>& t) const override {
    const Real speed = std::sqrt(dot(d, d));
    // The middle of a ball's part of the line, and the square of half of it.
    const auto ball = [&](const Real3& c) {
      const Real3 f{c.x - o.x, c.y - o.y, c.z - o.z};
      const Real a = dot(f, d) / speed;
      return std::pair(a, radius_ * radius_ - (dot(f, f) - a * a));
    };
    const auto at = [&](Real x) { return ball(curve_(length_ * x / kPlaces)); };
    std::vector<Real> x;
    std::vector<std::pair<Real, Real>> all;
    for (int k = 0; k <= kPlaces; ++k) {
      const auto next = ball(places_[k]);
      if (k > 0 && std::min(std::abs(next.second), std::abs(all.back().second)) < kJust)
        for (int i = 1; i < kFiner; ++i) {
          x.push_back(k - 1 + static_cast<Real>(i) / kFiner);
          all.push_back(at(x.back()));
        }
      x.push_back(k), all.push_back(next);
    }
    const auto best = [](Real lo, Real hi, const auto& value) {
      for (int step = 0; step < 90; ++step) {
        const Real a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (value(a) > value(b) ? hi : lo) = value(a) > value(b) ? b : a;
      }
      return (lo + hi) / 2;
    };
    // Gaps between places, and stretches between places.
    for (size_t k = 1; k + 1 < x.size(); ++k) {
      const Real here = all[k].second, before = all[k - 1].second, next = all[k + 1].second;
      const Real sign = here < 0 ? 1 : -1;
      if (sign * here < sign * before || sign * here < sign * next || (before < 0) != (here < 0) ||
          (next < 0) != (here < 0) || std::abs(here) > kJust)
        continue;
      const Real extreme = best(x[k - 1], x[k + 1], [&](Real place) { return sign * at(place).second; });
      if ((at(extreme).second < 0) == (here < 0)) continue;
      const size_t to = extreme < x[k] ? k : k + 1;
      x.insert(x.begin() + static_cast<std::ptrdiff_t>(to), extreme);
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(to), at(extreme));
      ++k;
    }
    const int end_place = static_cast<int>(x.size()) - 1;
    std::vector<Real> found;
    for (int k = 0; k <= end_place; ++k) {
      const bool begins = all[k].second >= 0 && (k == 0 || all[k - 1].second < 0);
      if (begins) {
        int last = k;
        while (last < end_place && all[last + 1].second >= 0) ++last;
        for (const Real side : {-1.0L, 1.0L}) {
          const auto end = [&](Real place) {
            const auto [a, square] = at(place);
            return square < 0 ? -1e3L + square : side * a + std::sqrt(square);  // uphill to where it meets
          };
          const auto known = [&](int i) { return side * all[i].first + std::sqrt(all[i].second); };
          int nearest = k;
          for (int i = k; i <= last; ++i)
            if (known(i) > known(nearest)) nearest = i;
          // Beside the first and last places of the stretch balls meet the line too.
          const Real lo = x[std::max(nearest - 1, 0)], hi = x[std::min(nearest + 1, end_place)];
          found.push_back(side * end(best(lo, hi, end)) / speed);
        }
        k = last;
      }
    }
    const auto near = [&](Real one) { return std::abs(one - 1) < contact; };
    const bool touches = std::count_if(found.begin(), found.end(), near) > 1;
    for (const Real one : found)
      if (!touches || !near(one)) t.push_back(one);
  }
  bool contains(const Real3& p) const override {
    for (int k = 0; k <= kPlaces; ++k) {
      const auto off = [&](Real x) {
        const Real3 c = curve_(length_ * x / kPlaces);
        const Real3 f{c.x - p.x, c.y - p.y, c.z - p.z};
        return dot(f, f);
      };
      const Real3 f{places_[k].x - p.x, places_[k].y - p.y, places_[k].z - p.z};
      if (dot(f, f) < radius_ * radius_) return true;
      if (dot(f, f) > radius_ * radius_ * 1.01L) continue;
      Real lo = std::max(k - 1, 0), hi = std::min(k + 1, kPlaces);
      for (int step = 0; step < 60; ++step) {
        const Real a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (off(a) < off(b) ? hi : lo) = off(a) < off(b) ? b : a;
      }
      if (off((lo + hi) / 2) < radius_ * radius_) return true;
    }
    return false;
  }

 private:
  static constexpr int kPlaces = 600, kFiner = 32;
  static constexpr Real kJust = 5e-3L;  // of the square of half of a ball's part
  std::function<Real3(Real)> curve_;
  Real length_, radius_;
  std::vector<Real3> places_;
};

// What lies in the first of two, and in the second too, or not.
class PairSolid final : public Solid {
 public:
  enum class Kind { unite, subtract, intersect };
  PairSolid(Kind kind, SolidPtr a, SolidPtr b) : kind_(kind), a_(std::move(a)), b_(std::move(b)) {}
  void crossings(const Real3& o, const Real3& d, Real contact, std::vector<Real>& t) const override {
    a_->crossings(o, d, contact, t), b_->crossings(o, d, contact, t);
  }
  bool contains(const Real3& p) const override {
    if (kind_ == Kind::unite) return a_->contains(p) || b_->contains(p);
    return a_->contains(p) && b_->contains(p) == (kind_ == Kind::intersect);
  }

 private:
  Kind kind_;
  SolidPtr a_, b_;
};

// How many sheets of the solids lie before the point on the line from `from` to it, nearer ones than `free` left out,
// and contacts as near as `contact`.
inline int layers_before(const std::vector<SolidPtr>& solids, const Vec3& from, const Vec3& point, double free,
                         double contact) {
  const Real3 o{from.x, from.y, from.z};
  const Real3 d{Real(point.x) - o.x, Real(point.y) - o.y, Real(point.z) - o.z};
  const Real length = std::sqrt(dot(d, d)), end = 1 - free / length;
  int layers = 0;
  for (const SolidPtr& solid : solids) {
    std::vector<Real> t;
    solid->crossings(o, d, contact / length, t);
    std::sort(t.begin(), t.end());
    const auto inside = [&](Real at) { return solid->contains({o.x + at * d.x, o.y + at * d.y, o.z + at * d.z}); };
    for (size_t k = 0; k < t.size(); ++k) {
      if (!(t[k] > 0 && t[k] < end)) continue;
      const Real before = k > 0 ? (t[k - 1] + t[k]) / 2 : t[k] - 1,
                 behind = k + 1 < t.size() ? (t[k] + t[k + 1]) / 2 : t[k] + 1;
      if (inside(before) != inside(behind)) ++layers;
    }
  }
  return layers;
}

}  // namespace lekalo::oracle::sight
