// Random pairs of bodies for tests of booleans: in general position, and with each kind of coincidence.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <string>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/nets/lofts.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

struct BodyPair {
  std::string kind;
  Body a, b;
};

// One generator a pair, so that each can be made again alone.
class BodyPairs {
 public:
  explicit BodyPairs(unsigned seed) : random_(seed) {}

  // Primitives, sweeps, lofts, results of booleans.
  BodyPair general() {
    const auto [kind_a, a] = any_body();
    const auto [kind_b, b] = any_body();
    return {kind_a + " and " + kind_b, transformed(a, placed()), transformed(b, placed())};
  }

  // Of planes, cylinders, cones, spheres and tori, for programs that represent these exactly.
  BodyPair elementary() {
    const auto [kind_a, a] = primitive();
    const auto [kind_b, b] = primitive();
    return {kind_a + " and " + kind_b, transformed(a, placed()), transformed(b, placed())};
  }

  // The kinds of coincidence by turns, half of the pairs turned.
  static constexpr int kKinds = 42, kExtrudedTwice = 26, kRevolvedTwice = 27;
  BodyPair degenerate(int number) {
    BodyPair pair = coincident(number % kKinds);
    if (unit() < 0.5) return pair;
    const Affine turn = placed();
    return {pair.kind + ", turned", transformed(pair.a, turn), transformed(pair.b, turn)};
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }

 private:
  using Named = std::pair<std::string, Body>;

  static Frame at(const Vec3& origin) {
    Frame frame;
    frame.origin = origin;
    return frame;
  }
  static Frame along_x(const Vec3& origin) { return frame_from(origin, {1, 0, 0}, {0, 1, 0}); }
  // The seam elsewhere.
  Frame turned_at(const Vec3& origin) {
    const double angle = between(0, kTwoPi);
    return frame_from(origin, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0});
  }

  Affine placed() {
    const Vec3 axis(between(-0.5, 0.5), between(-0.5, 0.5), between(-0.5, 0.5));
    const double angle = between(0, kTwoPi);
    return Affine::translation({unit(), unit(), unit()}) * Affine::rotation(angle, glm::normalize(axis));
  }

  Named primitive() {
    const double a = between(0.4, 1.4), b = between(0.3, 1.3), c = between(0.3, 1.3);
    switch (static_cast<int>(5 * unit())) {
      case 0:
        return {"box", box(at({0, 0, 0}), {a, b, c})};
      case 1:
        return {"cylinder", cylinder_body(at({0, 0, 0}), 0.5 * a, b + c)};
      case 2:
        return {"ball", ball(at({0, 0, 0}), 0.6 * a)};
      case 3:
        return {"frustum", frustum(at({0, 0, 0}), 0.6 * a, unit() < 0.3 ? 0 : 0.3 * b, b + c)};
      default:
        return {"torus", torus_body(at({0, 0, 0}), 0.6 * a, 0.6 * a * between(0.2, 0.7))};
    }
  }

  Named any_body() {
    switch (static_cast<int>(8 * unit())) {
      case 0:
      case 1:
      case 2:
        return primitive();
      case 3:
        return {"extrusion", extrusion()};
      case 4:
        return {"revolution", revolution()};
      case 5:
        return {"translation", translation()};
      case 6:
        return {"loft", loft()};
      default:
        return result();
    }
  }

  // An operation on primitives that has a result.
  Named result() {
    for (;;) {
      const auto [kind_a, a] = primitive();
      const auto [kind_b, b] = primitive();
      const int operation = static_cast<int>(3 * unit());
      try {
        const char* names[] = {"or", "and", "minus"};
        return {"(" + kind_a + " " + names[operation] + " " + kind_b + ")",
                boolean(static_cast<BooleanOperation>(operation), transformed(a, placed()), transformed(b, placed()))};
      } catch (const BooleanError&) {
        // Nothing is left, or refused: pairs of primitives are tried by themselves.
      }
    }
  }

  // ---- Sweeps and lofts

  // Counterclockwise about the center, not always convex.
  std::vector<Vec2> polygon(int corners, double size) {
    std::vector<Vec2> result;
    for (int k = 0; k < corners; ++k) {
      const double angle = kTwoPi * (k + between(0, 0.6)) / corners, radius = size * between(0.4, 1);
      result.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return result;
  }
  static std::vector<CurvePtr> segments(const std::vector<Vec3>& corners) {
    std::vector<CurvePtr> result;
    for (size_t k = 0; k < corners.size(); ++k)
      result.push_back(std::make_shared<Segment>(corners[k], corners[(k + 1) % corners.size()]));
    return result;
  }
  static std::vector<Vec3> in_plane(const std::vector<Vec2>& corners, const Frame& frame) {
    std::vector<Vec3> result;
    for (const Vec2& p : corners) result.push_back(frame.origin + p.x * frame.x + p.y * frame.y);
    return result;
  }
  // Sides that bulge: quadratic Bezier curves.
  std::vector<CurvePtr> bulging(const std::vector<Vec3>& corners) {
    std::vector<CurvePtr> result;
    for (size_t k = 0; k < corners.size(); ++k) {
      const Vec3 a = corners[k], b = corners[(k + 1) % corners.size()];
      const Vec3 middle = 0.5 * (a + b) * between(1.05, 1.4);
      result.push_back(std::make_shared<NurbsCurve>(bezier_curve(std::array{a, middle, b})));
    }
    return result;
  }
  std::vector<CurvePtr> profile(double size) {
    const int kind = static_cast<int>(3 * unit());
    if (kind == 2) return {std::make_shared<Ellipse>(at({0, 0, 0}), size * between(0.5, 1), size * between(0.3, 0.9))};
    const std::vector<Vec3> corners = in_plane(polygon(3 + static_cast<int>(4 * unit()), size), at({0, 0, 0}));
    return kind == 0 ? segments(corners) : bulging(corners);
  }

  Body extrusion() { return extruded(profile(0.7), {between(-0.3, 0.3), between(-0.3, 0.3), between(0.4, 1.4)}); }
  static Body extruded(const std::vector<CurvePtr>& curves, const Vec3& by) {
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (const CurvePtr& from : curves) {
      const CurvePtr to = transformed(from, Affine::translation(by));
      const Interval t = from->domain();
      loop.sides.push_back({std::make_shared<ExtrusionSurface>(from, by), from, to,
                            std::make_shared<Segment>(from->point(t.lo), to->point(t.lo))});
    }
    parts.ends = {at(curves[0]->point(curves[0]->domain().lo)), at(curves[0]->point(curves[0]->domain().lo) + by)};
    return swept_body(parts);
  }

  // About z; the profile lies in the plane of z and x.
  Body revolution() {
    const double angle = unit() < 0.5 ? kTwoPi : between(1, 5);
    const Frame plane = frame_from({between(0.5, 0.9), 0, 0}, {0, 1, 0}, {0, 0, 1});
    const std::vector<Vec3> corners = in_plane(polygon(3 + static_cast<int>(3 * unit()), 0.45), plane);
    return revolved(unit() < 0.5 ? segments(corners) : curved(corners), angle);
  }
  // As bulging(), for a polygon that is not about the origin.
  std::vector<CurvePtr> curved(const std::vector<Vec3>& corners) {
    Vec3 center(0);
    for (const Vec3& p : corners) center += p / static_cast<double>(corners.size());
    std::vector<Vec3> moved = corners;
    for (Vec3& p : moved) p -= center;
    std::vector<CurvePtr> result = bulging(moved);
    for (CurvePtr& one : result) one = transformed(one, Affine::translation(center));
    return result;
  }
  static Body revolved(const std::vector<CurvePtr>& curves, double angle) {
    const Axis axis{{0, 0, 0}, {0, 0, 1}};
    const Affine turn = Affine::rotation(angle, axis.along);
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (const CurvePtr& from : curves) {
      const Vec3 begin = from->point(from->domain().lo), center(0, 0, begin.z);
      loop.sides.push_back({std::make_shared<RevolutionSurface>(from, axis, angle), from, transformed(from, turn),
                            std::make_shared<Circle>(frame_from(center, axis.along, begin - center),
                                                     glm::length(begin - center), Interval(0, angle))});
    }
    if (angle < kTwoPi) {
      const Frame start = frame_from(curves[0]->point(curves[0]->domain().lo), {0, 1, 0}, {0, 0, 1});
      parts.ends = {start, Frame{turn.point(start.origin), turn.direction(start.x), turn.direction(start.y),
                                 turn.direction(start.z)}};
    }
    return swept_body(parts);
  }

  // Along a bent path, parallel to itself.
  Body translation() {
    const std::vector<CurvePtr> curves = profile(0.5);
    const Vec3 bend(between(-0.5, 0.5), between(-0.5, 0.5), 0.5), whole(between(-0.3, 0.3), between(-0.3, 0.3), 1);
    const CurvePtr path = std::make_shared<NurbsCurve>(bezier_curve(std::array{Vec3(0), bend, whole}));
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (const CurvePtr& from : curves)
      loop.sides.push_back({translation_surface(from, path), from, transformed(from, Affine::translation(whole)),
                            transformed(path, Affine::translation(from->point(from->domain().lo)))});
    parts.ends = {at({0, 0, 0}), at(whole)};
    return swept_body(parts);
  }

  // Four sides, each a Bezier surface through sides of polygons.
  Body loft() {
    constexpr int kCorners = 4;
    const int sections = 2 + static_cast<int>(3 * unit());
    std::vector<std::vector<Vec3>> rows;
    for (int i = 0; i < sections; ++i) {
      const double height = 1.0 * i / (sections - 1);
      std::vector<Vec3> row;
      for (int k = 0; k < kCorners; ++k) {
        const double angle = kTwoPi * (k + between(0, 0.3)) / kCorners, radius = between(0.35, 0.7);
        row.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
      }
      rows.push_back(row);
    }
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (int k = 0; k < kCorners; ++k) {
      const int next = (k + 1) % kCorners;
      std::vector<Vec3> rail, other;
      for (const std::vector<Vec3>& row : rows) rail.push_back(row[k]), other.push_back(row[next]);
      Grid<Vec3> net{2, sections, rail};
      net.values.insert(net.values.end(), other.begin(), other.end());
      loop.sides.push_back(
          {std::make_shared<NurbsSurface>(bezier_surface(net)), std::make_shared<Segment>(rail.front(), other.front()),
           std::make_shared<Segment>(rail.back(), other.back()), std::make_shared<NurbsCurve>(bezier_curve(rail))});
    }
    parts.ends = {at({0, 0, 0}), at({0, 0, 1})};
    return swept_body(parts);
  }

  // ---- Coincidences

  BodyPair coincident(int kind) {
    const Vec3 size(between(0.5, 2), between(0.5, 2), between(0.5, 2)),
        other(between(0.5, 2), between(0.5, 2), between(0.5, 2));
    const double r = between(0.3, 1), h = between(0.5, 2), s = between(0.2, 0.8);
    const Body block = box(at({0, 0, 0}), size), rod = cylinder_body(at({0, 0, 0}), r, h),
               globe = ball(at({0, 0, 0}), r);
    switch (kind) {
      case 0:
        return {"face on face", block, box(at({s * size.x, -s, size.z}), other)};
      case 1:
        return {"common planes", block, box(at({s * size.x, 0, 0}), {size.x, s * size.y, size.z})};
      case 2:
        return {"equal boxes", block, block};
      case 3:
        return {"edge on edge from outside", block, box(at({size.x, -s, size.z}), other)};
      case 4:
        return {"vertex on vertex", block, box(at(size), other)};
      case 5:
        return {"edge on face", block,
                transformed(box(at({0, 0, 0}), other), Affine::translation({s * size.x, -0.3, size.z}) *
                                                           Affine::rotation(-0.25 * kPi, {0, 1, 0}))};
      case 6:
        return {"vertex on face", block, on_its_corner({s * size.x, s * size.y, size.z}, other)};
      case 7:
        return {"vertex on edge", block, on_its_corner({s * size.x, 0, size.z}, other)};
      case 8:
        return {"edge across edge", block,
                transformed(box(at({-other.x * s, 0, 0}), other), Affine::translation({size.x, s * size.y, size.z}) *
                                                                      Affine::rotation(0.25 * kPi, {1, 0, 0}))};
      case 9:
        return {"equal cylinders on one axis", rod, cylinder_body(turned_at({0, 0, s * h}), r, h)};
      case 10:
        return {"equal cones on one axis", frustum(at({0, 0, 0}), 2 * r, r, h),
                frustum(turned_at({0, 0, 0.5 * h}), 1.5 * r, 0.5 * r, h)};
      case 11:
        return {"ball equal to a ball", globe, ball(turned_at({0, 0, 0}), r)};
      case 12:
        return {"plane touches a cylinder", rod, box(at({r, -s, -s}), other)};
      case 13:
        return {"plane touches a cylinder from inside", rod, box(at({-r, -2, s * h}), {r + s * r, 4, h})};
      case 14:
        return {"cylinders touch", rod, cylinder_body(turned_at({r + s, 0, -0.1}), s, h)};
      case 15:
        return {"cylinders touch from inside", rod, cylinder_body(turned_at({r - s * r, 0, 0.1 * h}), s * r, h)};
      case 16:
        return {"plane touches a ball", globe, box(at({-s, -s, r}), other)};
      case 17:
        return {"balls touch", globe, ball(turned_at({0, r + s, 0}), s)};
      case 18:
        return {"balls touch from inside", globe, ball(turned_at({0, 0, r - s * r}), s * r)};
      case 19:
        return {"equal cylinders across", cylinder_body(at({0, 0, -2}), r, 4),
                cylinder_body(along_x({-2, 0, 0}), r, 4)};
      case 20:
        return {"ball in a cylinder", rod, ball(turned_at({0, 0, s * h}), r)};
      case 21:
        return {"torus cut through its axis and equator", torus_body(at({0, 0, 0}), r + 0.5, 0.3),
                box(at({0, -3, 0}), {3, 6, 3})};
      case 22:
        return {"torus on a plane", torus_body(at({0, 0, 0.3}), r + 0.5, 0.3), box(at({-s, -3, -2}), {3, 6, 2})};
      case 23:
        return {"cylinder in a torus", torus_body(at({0, 0, 0}), r + 0.5, 0.3),
                cylinder_body(turned_at({0, 0, -1}), r + 0.5, 2)};
      case 24:
        return {"through the apex", frustum(at({0, 0, 0}), r, 0, h), box(at({0, -3, -1}), {3, 6, 4})};
      case 25:
        return {"through a pole", globe, box(at({0, 0, -2}), {3, 3, 4})};
      case kExtrudedTwice: {
        const std::vector<CurvePtr> curves = profile(0.7);
        return {"one profile extruded twice", extruded(curves, {0, 0, h}),
                transformed(extruded(curves, {0, 0, 1}), Affine::translation({0, 0, s * h}))};
      }
      case kRevolvedTwice: {
        const Frame plane = frame_from({0.8, 0, 0}, {0, 1, 0}, {0, 0, 1});
        const std::vector<CurvePtr> curves = curved(in_plane(polygon(4, 0.45), plane));
        return {"one profile revolved twice", revolved(curves, 2 + s),
                transformed(revolved(curves, 3), Affine::rotation(1 + s, {0, 0, 1}))};
      }
      case 28:
        return with_operand();
      case 29: {
        // Across the axis, neither along it nor through it.
        const Affine tilted = Affine::translation({0, 0, h}) * Affine::rotation(between(0.2, 1.3), {1, 0.3, 0});
        const Body half = transformed(box(at({-4, -4, -4}), {8, 8, 4}), tilted);
        if (unit() < 0.5) return {"a plane through the apex", frustum(at({0, 0, 0}), r, 0, h), half};
        return {"a plane through a pole", ball(at({0, 0, h - r}), r), half};
      }
      case 30: {
        const Frame plane = frame_from({0.8, 0, 0}, {0, 1, 0}, {0, 0, 1});
        const std::vector<Vec2> corners = polygon(4, 0.45);
        return {"corner of a revolved profile on a side",
                revolved(unit() < 0.5 ? segments(in_plane(corners, plane)) : curved(in_plane(corners, plane)), 2 + s),
                revolved(segments(in_plane(beside(corners[0]), plane)), 3)};
      }
      case 31: {
        const std::vector<Vec2> corners = polygon(5, 0.7);
        const Frame plane = at({0, 0, 0});
        return {
            "corner of an extruded profile on a side",
            extruded(unit() < 0.5 ? segments(in_plane(corners, plane)) : bulging(in_plane(corners, plane)), {0, 0, h}),
            transformed(extruded(segments(in_plane(beside(corners[0]), plane)), {0, 0, 1}),
                        Affine::translation({0, 0, s * h}))};
      }
      case 32:
        return {"ball touches a torus along a circle", torus_body(at({0, 0, 0}), r + 0.5, 0.3),
                ball(turned_at({0, 0, 0}), unit() < 0.5 ? r + 0.2 : r + 0.8)};
      case 33: {
        // Where a ball about (0, 0, c) touches the cone of radius r at z = 0 and slope r / h.
        const double slant = std::hypot(r, h), inscribed = (s * h) * r / slant;
        return {"ball in a cone", frustum(at({0, 0, 0}), r, 0, h), ball(turned_at({0, 0, h - s * h}), inscribed)};
      }
      case 34:
        return {"edge touches a ball", globe,
                transformed(box(at({-s, 0, 0}), other),
                            Affine::translation({0, 0, r}) * Affine::rotation(0.25 * kPi, {1, 0, 0}))};
      case 35:
        return {"equal tori", torus_body(at({0, 0, 0}), r + 0.5, 0.3), torus_body(turned_at({0, 0, 0}), r + 0.5, 0.3)};
      case 36:
        return {"equal cylinders aslant", cylinder_body(at({0, 0, -4}), r, 8),
                transformed(cylinder_body(at({0, 0, -4}), r, 8), Affine::rotation(between(0.7, 2.3), {1, 0, 0}))};
      case 37: {
        const double angle = between(0, kTwoPi), c = r * std::cos(angle), d = r * std::sin(angle);
        return {"edge on a cylinder", rod, box(at({c, d, -s}), other)};
      }
      case 38: {
        const double side = r * std::sqrt(2.0);
        return {"box in a cylinder", rod, box(at({-0.5 * side, -0.5 * side, s * h}), {side, side, h})};
      }
      case 39: {
        const double side = 2 * r / std::sqrt(3.0);
        return {"box in a ball", globe, box(at({-0.5 * side, -0.5 * side, -0.5 * side}), {side, side, side})};
      }
      case 40:
        return {"Viviani's window", globe, cylinder_body(turned_at({0.5 * r, 0, -2}), 0.5 * r, 4)};
      default:
        return {"cylinder in a box", box(at({-r, -r, 0}), {2 * r, 2 * r, h}),
                cylinder_body(turned_at({0, 0, s * h}), r, h)};
    }
  }

  // A rectangle with the place on its lower side.
  static std::vector<Vec2> beside(const Vec2& place) {
    return {place + Vec2(-1, 0), place + Vec2(1.3, 0), place + Vec2(1.3, 0.6), place + Vec2(-1, 0.6)};
  }

  static Body on_its_corner(const Vec3& place, const Vec3& size) {
    // The diagonal (1, 1, 1) upright.
    const Affine upright = Affine::rotation(std::acos(1 / std::sqrt(3.0)), glm::normalize(Vec3(1, -1, 0)));
    return transformed(box(at({0, 0, 0}), size), Affine::translation(place) * upright);
  }

  // The result of an operation, and one of its operands.
  BodyPair with_operand() {
    for (;;) {
      const auto [kind_a, a] = primitive();
      const auto [kind_b, b] = primitive();
      const Body first = transformed(a, placed()), second = transformed(b, placed());
      const int operation = static_cast<int>(3 * unit());
      try {
        const Body both = boolean(static_cast<BooleanOperation>(operation), first, second);
        const char* names[] = {"or", "and", "minus"};
        return {"(" + kind_a + " " + names[operation] + " " + kind_b + ") and " + kind_b, both, second};
      } catch (const BooleanError&) {
      }
    }
  }

  std::mt19937 random_;
};

}  // namespace lekalo::geometry
