#include "render/cameras/shown.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "render/lines/curve_helpers.h"
#include "render/scene/model.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kSteps = 32;       // of a grid in each direction: (1 - cos(pi / 32)) / 2 = 0.24 % of a circle's diameter
constexpr int kNarrowings = 80;  // by golden section: 0.618^80 of a step is below rounding
constexpr size_t kMostObjects = 500;  // with grids of their own

void add_corners(const Box3& box, const Affine& map, std::vector<Vec3>& points) {
  if (box.empty() || !box.bounded()) return;
  for (int i = 0; i < 8; ++i)
    points.push_back(
        map.point({i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 4 ? box.hi.z : box.lo.z}));
}

double between(const Interval& range, int i) { return range.lo + (range.hi - range.lo) * i / kSteps; }

void add_curve(const Curve& curve, const Affine& map, std::vector<Vec3>& points) {
  const Interval domain = curve.domain();
  for (int i = 0; i <= kSteps; ++i) points.push_back(map.point(curve.evaluate(between(domain, i), 0).point()));
}

// Points of the surface inside `limit`, which keeps the parts of a face's surface beyond the body out.
void add_surface(const Surface& surface, const Box3& limit, const Affine& map, std::vector<Vec3>& points) {
  if (!surface.bounded()) return;
  const Rectangle domain = surface.domain();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Vec3 p = surface.point(between(domain.u, i), between(domain.v, j));
      if (limit.contains(p)) points.push_back(map.point(p));
    }
}

void add(const Entity& entity, const Affine& map, std::vector<Vec3>& points) {
  if (const auto* point = std::get_if<Vec3>(&entity)) {
    points.push_back(map.point(*point));
  } else if (const auto* curve = std::get_if<CurvePtr>(&entity)) {
    add_curve(**curve, map, points);
  } else if (const auto* surface = std::get_if<SurfacePtr>(&entity)) {
    add_surface(**surface, Box3::everything(), map, points);
  } else if (const auto* set = std::get_if<SurfaceSet>(&entity)) {
    for (const SurfacePtr& one : *set) add_surface(*one, Box3::everything(), map, points);
  } else if (const auto* body = std::get_if<BodyPtr>(&entity)) {
    for (const Edge& edge : (*body)->edges)
      if (edge.curve) add_curve(*edge.curve, map, points);
    const Box3 limit = bounds(**body);
    for (const Face& face : (*body)->faces) add_surface(*face.surface, limit, map, points);
  } else if (std::holds_alternative<ShapePtr>(entity)) {
    add_corners(bounds(entity), map, points);
  } else if (const auto* mesh = std::get_if<MeshPtr>(&entity)) {
    for (const Vec3& p : (*mesh)->points) points.push_back(map.point(p));
  }
}

size_t count(const std::vector<Object>& objects) {
  size_t sum = 0;
  for (const Object& object : objects) {
    const auto* group = std::get_if<GroupPtr>(&object.shape);
    sum += group ? count((*group)->objects) : 1;
    if (sum > kMostObjects) break;
  }
  return sum;
}

void add(const std::vector<Object>& objects, const Affine& map, bool closely, std::vector<Vec3>& points) {
  for (const Object& object : objects) {
    const Affine placed = map * object.transform;
    const auto* group = std::get_if<GroupPtr>(&object.shape);
    if (group && closely) {
      add((*group)->objects, placed, closely, points);
    } else if (closely) {
      add(object.shape, placed, points);
      for (const Vec3& p : helper_points(object)) points.push_back(placed.point(p));
    } else {
      add_corners(bounds(object.shape), placed, points);
    }
  }
}

// The largest value between two parameters, where there is one summit; by golden section, which needs no derivatives:
// summits may be corners.
template <class F>
double largest_between(const F& value, double lo, double hi) {
  const double share = 0.5 * (std::sqrt(5.0) - 1);
  double a = hi - share * (hi - lo), b = lo + share * (hi - lo), at_a = value(a), at_b = value(b);
  for (int k = 0; k < kNarrowings; ++k)
    if (at_a < at_b)
      lo = a, a = b, at_a = at_b, b = lo + share * (hi - lo), at_b = value(b);
    else
      hi = b, b = a, at_b = at_a, a = hi - share * (hi - lo), at_a = value(a);
  return std::max(at_a, at_b);
}

// The box grows to where a smooth piece of a curve is farthest along x and y: about each sample that may be next to it.
void include_farthest(const Curve& curve, const Affine& map, const Interval& part, Box3& box) {
  std::vector<Vec3> samples;
  for (int i = 0; i <= kSteps; ++i) {
    samples.push_back(map.point(curve.evaluate(between(part, i), 0).point()));
    box.include(samples.back());
  }
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0})
      for (int i = 0; i <= kSteps; ++i) {
        const int before = std::max(i - 1, 0), after = std::min(i + 1, kSteps);
        const auto height = [&](int k) { return sign * samples[static_cast<size_t>(k)][axis]; };
        const double here = height(i), beside = std::min(height(before), height(after));
        double& border = sign < 0 ? box.lo[axis] : box.hi[axis];
        // A summit between two samples rises over them by less than their neighbours fall.
        if (here < height(before) || here < height(after) || !(here + 2 * (here - beside) > sign * border)) continue;
        const auto value = [&](double t) { return sign * map.point(curve.evaluate(t, 0).point())[axis]; };
        const double summit = largest_between(value, between(part, before), between(part, after));
        if (summit > sign * border) border = sign * summit;
      }
}

void include_farthest(const std::vector<Object>& objects, const Affine& map, Box3& box) {
  for (const Object& object : objects) {
    const Affine placed = map * object.transform;
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) include_farthest((*group)->objects, placed, box);
    const auto* curve = std::get_if<CurvePtr>(&object.shape);
    if (!curve) continue;
    for (const CurvePiece& piece : (*curve)->pieces()) include_farthest(**curve, placed, piece.domain, box);
  }
}

}  // namespace

struct Shown::Points {
  std::once_flag once, box_once;
  std::vector<Object> objects;
  std::vector<Vec3> list;
  Box3 tight;
};

Shown::Shown(const Box3& box) : box(box), points_(std::make_shared<Points>()) {}

Shown::Shown(const std::vector<Object>& objects) : Shown(bounds(objects)) { points_->objects = objects; }

const std::vector<Vec3>& Shown::points() const {
  Points& p = *points_;
  std::call_once(p.once, [&] {
    add(p.objects, Affine(), count(p.objects) <= kMostObjects, p.list);
    if (!p.list.empty()) return;
    const bool usable = !box.empty() && box.bounded();
    add_corners(usable ? box : Box3{Vec3(-0.5), Vec3(0.5)}, Affine(), p.list);
  });
  return p.list;
}

const Box3& Shown::tight_box() const {
  Points& p = *points_;
  std::call_once(p.box_once, [&] {
    for (const Vec3& point : points()) p.tight.include(point);
    if (count(p.objects) <= kMostObjects) include_farthest(p.objects, Affine(), p.tight);
  });
  return p.tight;
}

}  // namespace lekalo::render
