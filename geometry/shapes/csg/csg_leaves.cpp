#include "geometry/shapes/csg/csg_leaves.h"

#include <cmath>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/shapes/tube/balls.h"

namespace lekalo::geometry {

namespace {

constexpr double kStraight = 1e-12;  // relative

class Leaves {
 public:
  explicit Leaves(const Csg& solid) {
    for (const ShapePtr& operand : solid.operands()) collect(operand, Affine());
  }
  std::vector<CsgLeaf> all;
  std::vector<CsgTube> tubes;

 private:
  void collect(const ShapePtr& shape, const Affine& map) {
    if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
      return collect(moved->original(), map * moved->map());
    if (const auto* csg = dynamic_cast<const Csg*>(shape.get())) {
      for (const ShapePtr& operand : csg->operands()) collect(operand, map);
    } else if (!is_new(shape, map)) {
      return;
    } else if (const auto* body = dynamic_cast<const BodyShape*>(shape.get())) {
      add(*body->body(), map);
    } else if (const auto* half = dynamic_cast<const HalfSpaceShape*>(shape.get())) {
      const Frame& frame = half->frame();
      const Vec3 normal = glm::normalize(glm::cross(map.direction(frame.x), map.direction(frame.y)));
      CsgLeaf leaf;
      leaf.plane = std::make_shared<Plane>(frame_from(map.point(frame.origin), normal, map.direction(frame.x)));
      all.push_back(std::move(leaf));
    } else if (const auto* balls = dynamic_cast<const Balls*>(shape.get())) {
      for (const Balls::Ball& one : balls->balls()) add(ball_at(one.center, one.radius), map);
    } else if (const auto tube = std::dynamic_pointer_cast<const Tube>(shape)) {
      const int first = static_cast<int>(all.size());
      if (!add_ring(*tube, map) && !add_straight(*tube, map)) add_shape(shape, map).tube = tube;
      tubes.push_back({tube, map, {}});
      for (int k = first; k < static_cast<int>(all.size()); ++k) tubes.back().leaves.push_back(k);
    } else {
      CsgLeaf& leaf = add_shape(shape, map);
      leaf.implicit = std::dynamic_pointer_cast<const ImplicitSurface>(shape);
      if (leaf.implicit) add_region(leaf.implicit->region(), map);
    }
  }

  // What is cut off and added again has its lines once.
  bool is_new(const ShapePtr& shape, const Affine& map) {
    const auto thing = [](const ShapePtr& one) -> const void* {
      const auto* body = dynamic_cast<const BodyShape*>(one.get());
      return body ? static_cast<const void*>(body->body().get()) : one.get();
    };
    for (const auto& [other, place] : known_)
      if (thing(other) == thing(shape) && place.linear == map.linear && place.offset == map.offset) return false;
    known_.emplace_back(shape, map);
    return true;
  }

  void add(const Body& body, const Affine& map) {
    CsgLeaf leaf;
    leaf.body = std::make_shared<const Body>(transformed(body, map));
    leaf.box = bounds(*leaf.body);
    all.push_back(std::move(leaf));
  }
  CsgLeaf& add_shape(const ShapePtr& shape, const Affine& map) {
    CsgLeaf leaf;
    leaf.shape = transformed(shape, map);
    leaf.map = map;
    leaf.box = leaf.shape->bounds();
    all.push_back(std::move(leaf));
    return all.back();
  }
  void add_region(const ImplicitRegion& region, const Affine& map) {
    all.back().region = static_cast<int>(all.size());
    const Frame corner = frame_from(region.box.lo, {0, 0, 1}, {1, 0, 0});
    add(region.is_ball ? ball_at(region.box.center(), region.radius()) : box(corner, region.box.hi - region.box.lo),
        map);
    all.back().is_region = true;
  }
  static Body ball_at(const Vec3& center, double radius) {
    return ball(frame_from(center, {0, 0, 1}, {1, 0, 0}), radius);
  }

  // About a whole circle, or a part of one with round ends.
  bool add_ring(const Tube& tube, const Affine& map) {
    const auto* circle = dynamic_cast<const Circle*>(&tube.sweep().curve());
    if (!circle || tube.caps() != Caps::round) return false;
    const Interval t = circle->domain();
    const BallJet begin = tube.sweep().ball(t.lo), end = tube.sweep().ball(next_down(t.hi));
    for (const double x : {0.0, 0.2, 0.5, 0.9})
      if (tube.sweep().ball(t.lo + x * t.width()).radius[1] != 0) return false;
    if (!(begin.radius[0] < circle->radius())) return false;
    add(torus_body(circle->frame(), circle->radius(), begin.radius[0]), map);
    if (!circle->is_closed())
      for (const BallJet& last : {begin, end}) add(ball_at(last.center[0], last.radius[0]), map);
    return true;
  }

  // Pieces that are straight, with one radius.
  bool add_straight(const Tube& tube, const Affine& map) {
    const Curve& curve = tube.sweep().curve();
    const std::vector<CurvePiece> pieces = curve.pieces();
    if (tube.caps() != Caps::round && pieces.size() > 1) return false;
    const auto is_straight = [&](double t, const BallJet& first) {
      const BallJet at = tube.sweep().ball(t);
      return at.radius == first.radius && glm::dot(first.center[1], at.center[1]) > 0 &&
             glm::length(glm::cross(first.center[1], at.center[1])) <=
                 kStraight * glm::dot(first.center[1], first.center[1]);
    };
    std::vector<Body> balls, walls;
    for (const CurvePiece& piece : pieces) {
      const BallJet begin = tube.sweep().ball(piece.domain.lo), end = tube.sweep().ball(next_down(piece.domain.hi));
      if (begin.radius[1] != 0 || begin.radius[2] != 0) return false;
      for (const double x : {0.13, 0.4, 0.77, 0.93})
        if (!is_straight(piece.domain.lo + x * piece.domain.width(), begin)) return false;
      const Vec3 way = end.center[0] - begin.center[0];
      if (!(glm::length(way) > 0) ||
          glm::length(glm::cross(way, begin.center[1])) > kStraight * glm::length(way) * glm::length(begin.center[1]))
        return false;
      walls.push_back(
          cylinder_body(frame_about(begin.center[0], glm::normalize(way)), begin.radius[0], glm::length(way)));
      balls.push_back(ball_at(begin.center[0], begin.radius[0]));
      if (piece.domain.hi == curve.domain().hi && !curve.is_closed())
        balls.push_back(ball_at(end.center[0], end.radius[0]));
    }
    if (tube.caps() != Caps::round) balls.clear();
    const int first = static_cast<int>(all.size()), count = static_cast<int>(balls.size());
    for (const Body& ball : balls) add(ball, map);
    for (int k = 0; k < static_cast<int>(walls.size()); ++k) {
      add(walls[k], map);
      if (count > 0) all.back().ends = {first + k, first + (k + 1) % count};
    }
    return true;
  }

  std::vector<std::pair<ShapePtr, Affine>> known_;
};

}  // namespace

std::vector<CsgLeaf> csg_leaves(const Csg& solid) { return Leaves(solid).all; }
std::vector<CsgTube> csg_tubes(const Csg& solid) { return Leaves(solid).tubes; }

}  // namespace lekalo::geometry
