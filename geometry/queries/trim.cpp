#include "geometry/queries/trim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace lekalo::geometry {

namespace {

Vec2 plane_point(const Vec4& p) { return {p.x / p.w, p.y / p.w}; }

// Control points of an arc. Those of usual degrees take no memory of their own: arcs are halved for every hit of every
// ray near their edge.
class Points {
 public:
  Points() = default;
  explicit Points(std::span<const Vec4> points) {
    resize(points.size());
    std::copy(points.begin(), points.end(), data());
  }
  void resize(size_t n) {
    size_ = n;
    if (n > kFew) many_.resize(n);
  }
  size_t size() const { return size_; }
  Vec4* data() { return size_ > kFew ? many_.data() : few_.data(); }
  const Vec4* begin() const { return size_ > kFew ? many_.data() : few_.data(); }
  const Vec4* end() const { return begin() + size_; }
  const Vec4& front() const { return *begin(); }
  const Vec4& back() const { return begin()[size_ - 1]; }

 private:
  static constexpr size_t kFew = 6;
  size_t size_ = 0;
  std::array<Vec4, kFew> few_;  // not initialised
  std::vector<Vec4> many_;
};

void split_in_two(const Points& points, Points& left, Points& right) {
  const size_t n = points.size();
  left.resize(n);
  right = points;
  Vec4 *const first = left.data(), *const work = right.data();
  // Row after row of de Casteljau's scheme: its left edge is the left half, what stays in place the right one.
  for (size_t k = 0; k < n; ++k) {
    first[k] = work[0];
    for (size_t i = 0; i + 1 < n - k; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
  }
}

bool monotone_in_y(const Points& points) {
  bool up = true, down = true;
  for (const Vec4* p = points.begin(); p + 1 < points.end(); ++p) {
    const double a = p[0].y / p[0].w, b = p[1].y / p[1].w;
    up = up && b >= a;
    down = down && b <= a;
  }
  return up || down;
}

bool positive_weights(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Vec4& p) { return p.w > 0; });
}

// Distance from a point to the box of the control polygon: a lower bound for the distance to the curve.
double hull_distance(const Points& points, const Vec2& p) {
  Vec2 lo(kInfinity), hi(-kInfinity);
  for (const Vec4& c : points) {
    lo = glm::min(lo, plane_point(c));
    hi = glm::max(hi, plane_point(c));
  }
  const Vec2 outside = glm::max(glm::max(lo - p, p - hi), Vec2(0));
  return glm::length(outside);
}

bool within(const Points& points, const Vec2& p, double tolerance, int depth) {
  if (hull_distance(points, p) > tolerance) return false;
  if (glm::length(plane_point(points.front()) - p) <= tolerance ||
      glm::length(plane_point(points.back()) - p) <= tolerance)
    return true;
  if (depth == 0) return true;
  Points left, right;
  split_in_two(points, left, right);
  return within(left, p, tolerance, depth - 1) || within(right, p, tolerance, depth - 1);
}

}  // namespace

TrimRegion::TrimRegion(const std::vector<std::vector<Part>>& loops) {
  u_ = v_ = {kInfinity, -kInfinity};
  // An arc that is not monotone after 40 cuts is a point or an extremum narrower than the rounding of its ends: the
  // segment between its ends stands for it.
  const auto add = [&](auto&& self, Points points, int depth) -> void {
    if (!positive_weights(points) || (!monotone_in_y(points) && depth < 40)) {
      if (depth < 40) {
        Points left, right;
        split_in_two(points, left, right);
        self(self, std::move(left), depth + 1);
        self(self, std::move(right), depth + 1);
        return;
      }
      points = Points(std::array{points.front(), points.back()});
    }
    Arc arc{{points.begin(), points.end()}, kInfinity, -kInfinity, kInfinity, -kInfinity};
    for (const Vec4& p : points) {
      const Vec2 q = plane_point(p);
      arc.x_lo = std::min(arc.x_lo, q.x);
      arc.x_hi = std::max(arc.x_hi, q.x);
      arc.y_lo = std::min(arc.y_lo, q.y);
      arc.y_hi = std::max(arc.y_hi, q.y);
    }
    u_ = {std::min(u_.lo, arc.x_lo), std::max(u_.hi, arc.x_hi)};
    v_ = {std::min(v_.lo, arc.y_lo), std::max(v_.hi, arc.y_hi)};
    arcs_.push_back(std::move(arc));
  };
  for (const auto& loop : loops)
    for (const Part& part : loop)
      for (const CurvePiece& piece : part.curve->pieces()) add(add, Points(piece.points), 0);
  std::sort(arcs_.begin(), arcs_.end(), [](const Arc& a, const Arc& b) { return a.y_lo < b.y_lo; });
}

bool TrimRegion::contains(double u, double v, double tolerance) const {
  if (u < u_.lo - tolerance || u > u_.hi + tolerance || v < v_.lo - tolerance || v > v_.hi + tolerance) return false;
  bool inside = false;
  for (const Arc& arc : arcs_) {
    if (arc.y_lo > v) break;  // sorted
    const Vec2 a = plane_point(arc.points.front()), b = plane_point(arc.points.back());
    // Half-open in y, by the ends, so that a vertex between two arcs counts once.
    if ((a.y <= v) == (b.y <= v)) continue;
    if (arc.x_hi < u) continue;
    if (arc.x_lo > u) {
      inside = !inside;
      continue;
    }
    // Halve the arc until its box lies on one side of the point or is a rounding error wide.
    Points points(arc.points);
    bool crosses_right = false;
    for (int depth = 0;; ++depth) {
      double x_lo = kInfinity, x_hi = -kInfinity;
      for (const Vec4& p : points) {
        x_lo = std::min(x_lo, p.x / p.w);
        x_hi = std::max(x_hi, p.x / p.w);
      }
      if (x_lo > u || x_hi <= u || depth == 60) {
        crosses_right = x_lo > u;
        break;
      }
      Points left, right;
      split_in_two(points, left, right);
      const double start = points.front().y / points.front().w, middle = left.back().y / left.back().w;
      points = ((start <= v) != (middle <= v)) ? left : right;
    }
    if (crosses_right) inside = !inside;
  }
  return inside || (tolerance > 0 && near_border(u, v, tolerance));
}

bool TrimRegion::near_border(double u, double v, double tolerance) const {
  for (const Arc& arc : arcs_) {
    if (arc.y_lo > v + tolerance) break;
    if (arc.y_hi < v - tolerance || arc.x_lo > u + tolerance || arc.x_hi < u - tolerance) continue;
    if (within(Points(arc.points), {u, v}, tolerance, 50)) return true;
  }
  return false;
}

std::shared_ptr<const TrimRegion> trim_of(const Body& body, int face_index) {
  const Face& face = body.faces[face_index];
  if (!face.trimmed) return nullptr;
  std::vector<std::vector<TrimRegion::Part>> loops;
  for (int loop : face.loops) {
    loops.emplace_back();
    for (int c : body.loops[loop].coedges) loops.back().push_back({body.coedges[c].image, body.coedges[c].forward});
  }
  return std::make_shared<const TrimRegion>(loops);
}

}  // namespace lekalo::geometry
