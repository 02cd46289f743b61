#include "render/cameras/framed_content.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <span>

#include "geometry/box_corners.h"
#include "geometry/queries/closest/position.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "render/cameras/kept_points.h"
#include "render/lines/curve_helpers.h"
#include "render/model/objects.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kSteps = 32;        // of a grid in each direction: (1 - cos(pi / 32)) / 2 = 0.24 % of a circle's diameter
constexpr int kStepsOfParts = 8;  // of surfaces that are cut: lines find what is between
constexpr int kNarrowings = 80;   // by golden section: 0.618^80 of a step is below rounding
constexpr size_t kMaxObjects = 500;  // and parts of a solid, with grids of their own

double between(const Interval& range, int i, int steps = kSteps) {
  return range.lo + (range.hi - range.lo) * i / steps;
}

// A list of points that grows by those that an object's planes leave.
class Kept {
 public:
  explicit Kept(std::vector<Vec3>& points, std::span<const ClipPlane> planes = {}) : points_(points), planes_(planes) {}

  bool is_cut() const { return !planes_.empty(); }
  void add(const Vec3& point) {
    if (keeps(point)) points_.push_back(point);
  }
  // Where planes cut the curve point(t) between samples.
  template <class F>
  void add_cuts(const F& point, const Interval& range, int steps) {
    if (!is_cut()) return;
    for (int i = 0; i < steps; ++i) {
      double in = between(range, i, steps), out = between(range, i + 1, steps);
      if (keeps(point(in)) == keeps(point(out))) continue;
      if (!keeps(point(in))) std::swap(in, out);
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (in + out);
        (keeps(point(middle)) ? in : out) = middle;
      }
      points_.push_back(point(in));
    }
  }
  template <class F>
  void add_along(const F& point, const Interval& range, int steps) {
    for (int i = 0; i <= steps; ++i) add(point(between(range, i, steps)));
    add_cuts(point, range, steps);
  }

 private:
  static constexpr int kHalvings = 30;

  bool keeps(const Vec3& point) const {
    return std::all_of(planes_.begin(), planes_.end(),
                       [&](const ClipPlane& plane) { return glm::dot(point - plane.through, plane.normal) <= 0; });
  }

  std::vector<Vec3>& points_;
  const std::span<const ClipPlane> planes_;
};

void add_corners(const Box3& box, const Affine& map, Kept points) {
  if (box.empty() || !box.bounded()) return;
  const auto all = corners(box);
  const auto corner = [&](int i) { return map.point(all[static_cast<size_t>(i)]); };
  for (int i = 0; i < 8; ++i) points.add(corner(i));
  for (int i = 0; i < 8; ++i)
    for (const int axis : {1, 2, 4})
      if ((i & axis) == 0)
        points.add_cuts([&](double t) { return glm::mix(corner(i), corner(i | axis), t); }, {0, 1}, 1);
}

void add_curve(const Curve& curve, const Affine& map, Kept points) {
  points.add_along([&](double t) { return map.point(curve.evaluate(t, 0).point()); }, curve.domain(), kSteps);
}

// Points of the surface inside `limit`, which keeps the parts of a face's surface beyond the body out.
void add_surface(const Surface& surface, const Box3& limit, const Affine& map, Kept points, int steps = kSteps) {
  if (!surface.bounded()) return;
  const Rectangle domain = surface.domain();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Vec3 p = surface.point(between(domain.u, i, steps), between(domain.v, j, steps));
      if (limit.contains(p)) points.add(map.point(p));
    }
  if (!points.is_cut()) return;
  const auto at = [&](double u, double v) { return map.point(surface.point(u, v)); };
  for (int i = 0; i <= steps; ++i) {
    const double u = between(domain.u, i, steps), v = between(domain.v, i, steps);
    points.add_cuts([&](double t) { return at(t, v); }, domain.u, steps);
    points.add_cuts([&](double t) { return at(u, t); }, domain.v, steps);
  }
}

void add_body(const Body& body, const Affine& map, Kept points, int steps = kSteps) {
  for (const Edge& edge : body.edges)
    if (edge.curve) add_curve(*edge.curve, map, points);
  const Box3 limit = bounds(body);
  for (const Face& face : body.faces) add_surface(*face.surface, limit, map, points, steps);
}

// Where lines along the axes meet a shape, in a grid over a box that holds it. Between a line that meets it and one
// beside it that does not, the last that does is found too: so along its rows the grid shows to where the shape goes.
class MetByLines {
 public:
  MetByLines(const Shape& shape, const Box3& box) : shape_(shape), box_(box) {
    for (axis_ = 0; axis_ < 3; ++axis_) {
      bool met[kSteps + 1][kSteps + 1];
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) met[i][j] = meets(i, j);
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          if (met[i][j] != met[i][j + 1]) find_last({i, j}, {i, j + 1}, met[i][j]);
          if (met[j][i] != met[j + 1][i]) find_last({j, i}, {j + 1, i}, met[j][i]);
        }
    }
  }
  const std::vector<Vec3>& points() const { return points_; }

 private:
  static constexpr int kHalvings = 12;
  static constexpr double kWithin = 1e-6;  // of the box, from its sides: faces that lie in them are met

  double coordinate(int axis, double step) const {
    const double share = std::clamp(step / kSteps, kWithin, 1 - kWithin);
    return box_.lo[axis] + share * (box_.hi[axis] - box_.lo[axis]);
  }

  bool meets(double i, double j) {
    Line line{Vec3(0), Vec3(0)};
    line.direction[axis_] = 1;
    line.origin[(axis_ + 1) % 3] = coordinate((axis_ + 1) % 3, i);
    line.origin[(axis_ + 2) % 3] = coordinate((axis_ + 2) % 3, j);
    std::vector<SurfaceHit> hits;
    shape_.all_hits(line, {-kInfinity, kInfinity}, hits);
    for (const SurfaceHit& hit : hits) points_.push_back(line.at(hit.t));
    return !hits.empty();
  }

  void find_last(Vec2 one, Vec2 other, bool first_meets) {
    if (!first_meets) std::swap(one, other);
    for (int k = 0; k < kHalvings; ++k) {
      const Vec2 middle = 0.5 * (one + other);
      (meets(middle.x, middle.y) ? one : other) = middle;
    }
  }

  const Shape& shape_;
  const Box3 box_;
  int axis_ = 0;
  std::vector<Vec3> points_;
};

// The same of a box that does not fit the shape: again within what was found, until that hardly shrinks.
void add_met_by_lines(const Shape& shape, const Affine& map, std::vector<Vec3>& points) {
  constexpr double kShrinks = 0.9;
  Box3 box = shape.bounds();
  if (box.empty() || !box.bounded()) return;
  for (;;) {
    const MetByLines met(shape, box);
    Box3 found;
    for (const Vec3& p : met.points()) found.include(p);
    // What no line of the grid meets is within a step of what they meet.
    const Vec3 step = box.size() / static_cast<double>(kSteps);
    const Box3 narrow{glm::max(box.lo, found.lo - step), glm::min(box.hi, found.hi + step)};
    const Vec3 before = box.size(), after = narrow.size();
    if (found.empty() || !(after.x * after.y * after.z < kShrinks * before.x * before.y * before.z)) {
      for (const Vec3& p : met.points()) points.push_back(map.point(p));
      return;
    }
    box = narrow;
  }
}

// A point of a solid's part, and the middle of that part.
struct PartPoint {
  Vec3 point, middle;
};

// Of all parts of a solid but those that it takes away. Of a part no more than its box if `steps` is 0.
void add_parts(const Shape& shape, const Affine& map, std::vector<PartPoint>& points, int steps) {
  if (const auto* moved = dynamic_cast<const TransformedShape*>(&shape))
    return add_parts(*moved->original(), map * moved->map(), points, steps);
  if (const auto* solid = dynamic_cast<const Csg*>(&shape)) {
    const size_t parts = solid->operation() == Csg::Operation::subtract ? 1 : solid->operands().size();
    for (size_t k = 0; k < parts; ++k) add_parts(*solid->operands()[k], map, points, steps);
    return;
  }
  if (!shape.bounds().bounded()) return;
  std::vector<Vec3> own;
  if (steps == 0)
    add_corners(shape.bounds(), map, Kept(own));
  else if (const auto* body = dynamic_cast<const BodyShape*>(&shape))
    add_body(*body->body(), map, Kept(own), steps);
  else
    add_met_by_lines(shape, map, own);
  const Vec3 middle = map.point(shape.bounds().center());
  for (const Vec3& p : own) points.push_back({p, middle});
}

// Of a solid that is put together: of a union what all operands show, else what is left of its parts' points, and where
// it is cut.
void add_solid(const Shape& shape, const Affine& map, std::vector<Vec3>& points, int steps) {
  if (const auto* moved = dynamic_cast<const TransformedShape*>(&shape))
    return add_solid(*moved->original(), map * moved->map(), points, steps);
  const auto* solid = dynamic_cast<const Csg*>(&shape);
  if (solid && solid->operation() == Csg::Operation::unite) {
    for (const ShapePtr& operand : solid->operands()) add_solid(*operand, map, points, steps);
    return;
  }
  std::vector<PartPoint> parts;
  add_parts(shape, Affine(), parts, solid ? std::min(steps, kStepsOfParts) : steps);
  if (!solid) {
    for (const PartPoint& part : parts) points.push_back(map.point(part.point));
    return;
  }
  constexpr double kInwards = 1e-6;  // of the way to a part's middle: from a point of its surface into it
  for (const auto& [p, middle] : parts)
    if (solid->bounds().contains(p) && is_inside(glm::mix(p, middle, kInwards), *solid)) points.push_back(map.point(p));
  add_met_by_lines(*solid, map, points);
}

// The solid that is put together, if the shape is one.
const Csg* put_together(const Shape& shape) {
  const auto* moved = dynamic_cast<const TransformedShape*>(&shape);
  return dynamic_cast<const Csg*>(moved ? moved->original().get() : &shape);
}

void add(const Entity& entity, const Affine& map, Kept points) {
  if (const auto* point = std::get_if<Vec3>(&entity)) {
    points.add(map.point(*point));
  } else if (const auto* curve = std::get_if<CurvePtr>(&entity)) {
    add_curve(**curve, map, points);
  } else if (const auto* surface = std::get_if<SurfacePtr>(&entity)) {
    add_surface(**surface, Box3::everything(), map, points);
  } else if (const auto* set = std::get_if<SurfaceSet>(&entity)) {
    for (const SurfacePtr& one : *set) add_surface(*one, Box3::everything(), map, points);
  } else if (const auto* body = std::get_if<BodyPtr>(&entity)) {
    add_body(**body, map, points);
  } else if (const auto* shape = std::get_if<ShapePtr>(&entity)) {
    if (const Csg* solid = put_together(**shape); solid && bounds(**shape).bounded()) {
      std::vector<Vec3> whole;
      add_solid(**shape, map, whole, solid->leaf_count() <= static_cast<int>(kMaxObjects) ? kSteps : 0);
      for (const Vec3& p : whole) points.add(p);
    } else {
      add_corners(bounds(entity), map, points);
    }
  } else if (const auto* mesh = std::get_if<MeshPtr>(&entity)) {
    std::vector<Vec3> placed;
    for (const Vec3& p : (*mesh)->points) placed.push_back(map.point(p));
    for (const Vec3& p : placed) points.add(p);
    if (!points.is_cut()) return;
    for (const Mesh::Triangle& triangle : (*mesh)->triangles)
      for (int k = 0; k < 3; ++k) {
        const Vec3 &a = placed[static_cast<size_t>(triangle.point[k])],
                   &b = placed[static_cast<size_t>(triangle.point[(k + 1) % 3])];
        points.add_cuts([&](double t) { return glm::mix(a, b, t); }, {0, 1}, 1);
      }
  }
}

using PointsPtr = std::shared_ptr<const std::vector<Vec3>>;

struct Found {
  Entity shape;  // so that no address is used again
  PointsPtr points;
};
struct FoundPoints {
  std::mutex guard;
  int asking = 0;
  std::map<std::pair<size_t, const void*>, Found> shapes;  // by kind and identity()
};

FoundPoints& found_points() {
  static FoundPoints all;
  return all;
}

// Those of a shape that no planes cut, in its own coordinates.
PointsPtr points_of(const Entity& shape) {
  const std::pair<size_t, const void*> key{shape.index(), identity(shape)};
  {
    const std::lock_guard lock(found_points().guard);
    if (const auto known = found_points().shapes.find(key); known != found_points().shapes.end())
      return known->second.points;
  }
  std::vector<Vec3> list;
  add(shape, Affine(), Kept(list));
  auto points = std::make_shared<const std::vector<Vec3>>(std::move(list));
  const std::lock_guard lock(found_points().guard);
  if (found_points().asking > 0 && key.second) found_points().shapes.emplace(key, Found{shape, points});
  return points;
}

void add(const std::vector<Object>& objects, const Affine& map, std::vector<Vec3>& points) {
  for (const Object& object : objects) {
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
      add((*group)->objects, map * object.transform, points);
    } else {
      if (object.clips.empty()) {
        const PointsPtr own = points_of(object.shape);
        for (const Vec3& p : *own) points.push_back(map.point(object.transform.point(p)));
      } else {
        std::vector<Vec3> own;  // where the object is placed, as its planes are
        add(object.shape, object.transform, Kept(own, object.clips));
        for (const Vec3& p : own) points.push_back(map.point(p));
      }
      for (const Vec3& p : helper_points(object)) points.push_back(map.point(object.transform.point(p)));
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
    if (!curve || !object.clips.empty()) continue;
    for (const CurvePiece& piece : (*curve)->pieces()) include_farthest(**curve, placed, piece.domain, box);
  }
}

}  // namespace

KeptPoints::KeptPoints() {
  const std::lock_guard lock(found_points().guard);
  ++found_points().asking;
}
KeptPoints::~KeptPoints() {
  const std::lock_guard lock(found_points().guard);
  if (--found_points().asking == 0) found_points().shapes.clear();
}

struct FramedContent::Points {
  std::once_flag once, box_once;
  std::vector<Object> objects;  // that are looked at closely
  std::vector<Vec3> list;
  Box3 tight;
};

FramedContent::FramedContent(const Box3& box) : box(box), points_(std::make_shared<Points>()) {}

FramedContent::FramedContent(const std::vector<Object>& objects) : points_(std::make_shared<Points>()) {
  Boxes boxes;
  box = boxes.of(objects);
  if (PlacedObjects(objects).count() <= kMaxObjects) {
    points_->objects = objects;
    return;
  }
  points_->list.reserve(8 * objects.size());
  for (const Object& object : objects)
    add_corners(boxes.of(object.shape), object.transform, Kept(points_->list, object.clips));
}

const std::vector<Vec3>& FramedContent::points() const {
  Points& p = *points_;
  std::call_once(p.once, [&] {
    add(p.objects, Affine(), p.list);
    if (!p.list.empty()) return;
    const bool usable = !box.empty() && box.bounded();
    add_corners(usable ? box : Box3{Vec3(-0.5), Vec3(0.5)}, Affine(), Kept(p.list));
  });
  return p.list;
}

const Box3& FramedContent::tight_box() const {
  Points& p = *points_;
  std::call_once(p.box_once, [&] {
    for (const Vec3& point : points()) p.tight.include(point);
    include_farthest(p.objects, Affine(), p.tight);
  });
  return p.tight;
}

}  // namespace lekalo::render
