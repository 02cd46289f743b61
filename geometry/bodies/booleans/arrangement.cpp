#include "geometry/bodies/booleans/arrangement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/trims/trim.h"
#include "geometry/bodies/trims/trim_loops.h"
#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

namespace {

// Of the box of all: images of one point of space that are farther apart are two (on both sides of a seam).
constexpr double kSamePlace = 1e-6;
// Directions that differ by less, in radians, are compared some way on.
constexpr double kSameDirection = 1e-3;

// The curve as places in its direction, the last left out; fewer of each piece than `parts` where these are many.
void append_polygon(const DirectedCurve& curve, int parts, std::vector<Vec2>& polygon) {
  constexpr int kPieces = 4, kMinParts = 2;
  std::vector<double> ts;
  const std::vector<CurvePiece> pieces = curve.image->pieces();
  parts = std::clamp(kPieces * parts / static_cast<int>(pieces.size()), kMinParts, parts);
  for (const CurvePiece& piece : pieces)
    for (int k = 0; k < parts; ++k) ts.push_back(piece.domain.lo + piece.domain.width() * k / parts);
  ts.push_back(curve.image->domain().hi);
  if (!curve.forward) std::reverse(ts.begin(), ts.end());
  ts.pop_back();
  for (const double t : ts) polygon.push_back(Vec2(curve.image->point(t)));
}

double signed_area(const std::vector<Vec2>& polygon) {
  double sum = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

class Arrangement {
 public:
  Arrangement(const std::vector<DirectedCurve>& curves, const Surface& surface) : curves_(curves), surface_(surface) {
    for (const DirectedCurve& curve : curves_) {
      box_.include(Vec3(curve.begin(), 0));
      box_.include(Vec3(curve.end(), 0));
      const Interval t = curve.image->domain();
      for (const double part : {0.25, 0.5, 0.75}) box_.include(curve.image->point(t.lo + part * t.width()));
    }
    size_ = box_.diameter();
    for (const DirectedCurve& curve : curves_) {
      from_.push_back(place(curve.from, curve.begin()));
      to_.push_back(place(curve.to, curve.end()));
    }
    leaving_.resize(places_.size());
    for (size_t k = 0; k < curves_.size(); ++k) leaving_[from_[k]].push_back(static_cast<int>(k));
  }

  std::vector<PlaneRegion> regions() {
    std::vector<char> used(curves_.size(), 0);
    std::vector<std::vector<int>> cycles;
    for (size_t k = 0; k < curves_.size(); ++k) {
      if (used[k]) continue;
      std::vector<int>& cycle = cycles.emplace_back();
      for (int at = static_cast<int>(k); !used[at]; at = next(at)) {
        used[at] = 1;
        cycle.push_back(at);
      }
      if (next(cycle.back()) != cycle.front()) throw open_at(to_[cycle.back()]);
    }
    return nested(std::move(cycles));
  }

 private:
  struct Place {
    int point;
    Vec2 uv;
  };

  int place(int point, const Vec2& uv) {
    for (size_t k = 0; k < places_.size(); ++k)
      if (places_[k].point == point && glm::length(places_[k].uv - uv) <= kSamePlace * size_)
        return static_cast<int>(k);
    places_.push_back({point, uv});
    return static_cast<int>(places_.size()) - 1;
  }

  BooleanError open_at(int place) const {
    const Vec2 uv = places_[place].uv;
    return {"a loop of a face does not go on", surface_.point(uv.x, uv.y)};
  }

  // A curve seen from one of its ends.
  struct Ray {
    const DirectedCurve* curve;
    bool from_end;

    double end() const {
      const Interval t = curve->image->domain();
      return curve->forward != from_end ? t.lo : t.hi;
    }
    double sign() const { return curve->forward != from_end ? 1 : -1; }
    Vec2 origin() const { return from_end ? curve->end() : curve->begin(); }
    double length() const {
      const Interval t = curve->image->domain();
      double longest = 0;
      for (const double part : {0.25, 0.5, 0.75, 1.0})
        longest =
            std::max(longest, glm::length(Vec2(curve->image->point(end() + sign() * part * t.width())) - origin()));
      return longest;
    }
    // Where it is at that distance for the first time.
    Vec2 at_distance(double distance) const {
      const Interval t = curve->image->domain();
      double lo = 0, hi = 1e-9;
      const auto reached = [&](double part) {
        return glm::length(Vec2(curve->image->point(end() + sign() * part * t.width())) - origin()) >= distance;
      };
      while (hi < 1 && !reached(hi)) lo = hi, hi = std::min(1.0, 2 * hi);
      for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (lo + hi);
        (reached(middle) ? hi : lo) = middle;
      }
      return Vec2(curve->image->point(end() + sign() * hi * t.width()));
    }
    double direction(double distance) const {
      if (distance > 0) {
        const Vec2 way = at_distance(distance) - origin();
        return std::atan2(way.y, way.x);
      }
      const Vec3 way = sign() * curve->image->evaluate(end(), 1).d[1];
      if (!(glm::length(way) > 0)) return direction(1e-3 * length());
      return std::atan2(way.y, way.x);
    }
  };

  static double turn(double from, double to) {
    const double by = std::fmod(to - from, kTwoPi);
    return by < 0 ? by + kTwoPi : by;
  }

  // The one that turns most to the left: counterclockwise from the way back it is the last.
  int next(int arriving) const {
    const std::vector<int>& candidates = leaving_[to_[arriving]];
    const Ray back{&curves_[arriving], true};
    int best = -1;
    for (const int k : candidates) {
      if (curves_[k].strand == curves_[arriving].strand && curves_[k].forward != curves_[arriving].forward &&
          is_way_back(arriving, k))
        continue;
      if (best < 0 || is_more_left(back, k, best)) best = k;
    }
    // Only the way back.
    if (best < 0 && !candidates.empty()) best = candidates.front();
    if (best < 0) throw open_at(to_[arriving]);
    return best;
  }
  // A closed curve ends where it begins, and its other direction leaves there in both ways.
  bool is_way_back(int arriving, int leaving) const {
    return to_[arriving] == from_[leaving] && from_[arriving] == to_[leaving];
  }

  bool is_more_left(const Ray& back, int a, int b) const {
    const Ray ray_a{&curves_[a], false}, ray_b{&curves_[b], false};
    const auto turns = [&](double distance) {
      const double from = back.direction(distance);
      return std::pair(turn(from, ray_a.direction(distance)), turn(from, ray_b.direction(distance)));
    };
    const auto apart = [](double x, double y) { return std::abs(std::remainder(x - y, kTwoPi)); };
    const auto decided = [&](const std::pair<double, double>& at, double least) {
      return apart(at.first, at.second) > least && apart(at.first, 0) > least && apart(at.second, 0) > least;
    };
    std::pair<double, double> at = turns(0);
    const double shortest = std::min({back.length(), ray_a.length(), ray_b.length()});
    for (const double part : {1e-3, 1e-2, 0.1}) {
      if (decided(at, part == 1e-3 ? kSameDirection : 1e-5)) break;
      at = turns(part * shortest);
    }
    return at.first > at.second;
  }

  // By curve, the number of the connected part that it belongs to: a loop is no hole of a region that it touches.
  std::vector<int> connected() const {
    std::vector<int> root(places_.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    for (size_t k = 0; k < curves_.size(); ++k) root[find(from_[k])] = find(to_[k]);
    std::vector<int> result;
    for (const int place : from_) result.push_back(find(place));
    return result;
  }

  std::vector<PlaneRegion> nested(std::vector<std::vector<int>> cycles) const {
    struct Outline {
      std::vector<Vec2> polygon;
      double area;
    };
    std::vector<Outline> outlines;
    for (const std::vector<int>& cycle : cycles) {
      Outline& outline = outlines.emplace_back();
      for (const int k : cycle) append_polygon(curves_[k], 32, outline.polygon);
      outline.area = signed_area(outline.polygon);
    }
    const double none = 1e-14 * size_ * size_;
    const std::vector<int> parts = connected();
    std::vector<PlaneRegion> regions;
    std::vector<int> region_of(cycles.size(), -1);
    for (size_t k = 0; k < cycles.size(); ++k) {
      if (!(outlines[k].area > none)) continue;
      region_of[k] = static_cast<int>(regions.size());
      regions.push_back({{cycles[k]}});
    }
    for (size_t k = 0; k < cycles.size(); ++k) {
      if (region_of[k] >= 0) continue;
      int around = -1;
      for (size_t j = 0; j < cycles.size(); ++j)
        if (region_of[j] >= 0 && parts[cycles[j].front()] != parts[cycles[k].front()] &&
            (around < 0 || outlines[j].area < outlines[around].area) &&
            lies_in(outlines[k].polygon, outlines[j].polygon))
          around = static_cast<int>(j);
      if (around < 0) throw open_at(from_[cycles[k].front()]);
      regions[region_of[around]].loops.push_back(std::move(cycles[k]));
    }
    return regions;
  }

  static bool lies_in(const std::vector<Vec2>& inner, const std::vector<Vec2>& outer) {
    int votes = 0;
    for (size_t k = 0; k < inner.size(); k += std::max<size_t>(1, inner.size() / 15))
      votes += is_in(0.5 * (inner[k] + inner[(k + 1) % inner.size()]), outer) ? 1 : -1;
    return votes > 0;
  }

  const std::vector<DirectedCurve>& curves_;
  const Surface& surface_;
  Box3 box_;
  double size_ = 0;
  std::vector<Place> places_;
  std::vector<int> from_, to_;
  std::vector<std::vector<int>> leaving_;
};

}  // namespace

std::vector<PlaneRegion> regions_of(const std::vector<DirectedCurve>& curves, const Surface& surface) {
  return Arrangement(curves, surface).regions();
}

Vec2 point_inside(const std::vector<DirectedCurve>& curves, const PlaneRegion& region,
                  const std::function<bool(const Vec2&)>& suits) {
  std::vector<std::vector<TrimRegion::Part>> parts_of_loops;
  for (const std::vector<int>& loop : region.loops) {
    parts_of_loops.emplace_back();
    for (const int k : loop) parts_of_loops.back().push_back({curves[k].image, curves[k].forward});
  }
  const TrimRegion trim(parts_of_loops);
  for (const int parts : {8, 32, 128}) {
    std::vector<Vec2> points;
    std::vector<std::vector<int>> polygons;
    for (const std::vector<int>& loop : region.loops) {
      std::vector<Vec2> polygon;
      for (const int k : loop) append_polygon(curves[k], parts, polygon);
      polygons.emplace_back();
      for (const Vec2& p : polygon) {
        polygons.back().push_back(static_cast<int>(points.size()));
        points.push_back(p);
      }
    }
    try {
      std::vector<std::pair<double, Vec2>> centers;  // of the circles in the triangles, with their size
      for (const IndexTriangle& triangle : triangulate(points, polygons)) {
        const Vec2 a = points[triangle[0]], b = points[triangle[1]], c = points[triangle[2]];
        const double la = glm::length(b - c), lb = glm::length(c - a), lc = glm::length(a - b), around = la + lb + lc;
        const double area = std::abs((b - a).x * (c - a).y - (b - a).y * (c - a).x);
        if (area > 0) centers.emplace_back(area / around, (la * a + lb * b + lc * c) / around);
      }
      std::stable_sort(centers.begin(), centers.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
      for (const auto& [size, center] : centers) {
        // Where curves bend more than the polygons tell the point may be on the wrong side of them.
        if (!trim.contains(center.x, center.y)) break;
        if (suits(center)) return center;
      }
    } catch (const std::invalid_argument&) {
      // Polygons of neighbouring curves may cross where these do not.
    }
  }
  // Beside a cusp polygons always cross: a step to the left of a curve, as long as can be.
  double size = 0;
  for (const int k : region.loops.front()) size = std::max(size, bounds(*curves[k].image).diameter());
  for (double step = 0.25 * size; step > 1e-6 * size; step *= 0.5)
    for (const std::vector<int>& loop : region.loops)
      for (const int k : loop)
        for (const double part : {0.5, 0.3, 0.7}) {
          const Interval t = curves[k].image->domain();
          const CurveJet at = curves[k].image->evaluate(t.lo + part * t.width(), 1);
          const Vec2 along = (curves[k].forward ? 1.0 : -1.0) * Vec2(at.d[1]);
          const double speed = glm::length(along);
          if (!(speed > 0)) continue;
          const Vec2 left(-along.y / speed, along.x / speed), p = Vec2(at.d[0]) + step * left;
          if (trim.contains(p.x, p.y) && trim.contains(p.x + 0.5 * step * left.x, p.y + 0.5 * step * left.y) &&
              suits(p))
            return p;
        }
  throw std::invalid_argument("no point is found inside of a region of a face");
}

}  // namespace lekalo::geometry
