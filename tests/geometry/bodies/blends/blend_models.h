// Random bodies with edges to fillet or to chamfer, for comparisons with other programs: faces are planes, cylinders,
// cones, balls and tori but of those whose kind says otherwise. No corners of mixed convexity, none of more than three
// edges.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "geometry/bodies/blends/blending.h"
#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

struct BlendModel {
  std::string kind;
  Body body;
  std::vector<int> edges;
  bool is_chamfer = false;
  double size = 0;  // radius, or both lengths

  std::vector<BlendRequest> requests() const {
    BlendRequest one;
    one.edges = edges;
    one.rule.kind = is_chamfer ? BlendKind::chamfer : BlendKind::ball;
    one.rule.sizes = {ScalarLaw(size), ScalarLaw(size)};
    one.rule.role = is_chamfer ? "chamfers.0" : "fillets.0";
    one.rule.field = is_chamfer ? "length" : "radius";
    return {one};
  }
};

// One generator a model, so that each can be made again alone.
class BlendModels {
 public:
  explicit BlendModels(unsigned seed) : random_(seed) {}

  static constexpr int kKinds = 20;
  BlendModel model(int number) {
    BlendModel model = made(number % kKinds);
    // Only where faces are straight across the edges: on others lengths may be measured in several ways.
    constexpr std::array kCurved{9, 10, 12, 15, 18};
    const bool is_curved = std::find(kCurved.begin(), kCurved.end(), number % kKinds) != kCurved.end();
    model.is_chamfer = number / kKinds % 3 == 2 && !is_curved;
    // Elsewhere, and turned.
    const Vec3 axis(between(-1, 1), between(-1, 1), between(-1, 1));
    model.body =
        transformed(model.body, Affine::translation({between(-2, 2), between(-2, 2), between(-2, 2)}) *
                                    Affine::rotation(between(0, kTwoPi), glm::normalize(axis + Vec3(0, 0, 1e-3))));
    return model;
  }

 private:
  using Where = std::function<bool(const Vec3&)>;

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  static Frame at(const Vec3& origin) {
    Frame frame;
    frame.origin = origin;
    return frame;
  }
  static Frame along(const Vec3& origin, const Vec3& z) { return frame_about(origin, glm::normalize(z)); }

  // Regular edges all of whose points are there.
  static std::vector<int> edges_where(const Body& body, const Where& where) {
    std::vector<int> result;
    for (size_t e = 0; e < body.edges.size(); ++e) {
      if (body.edges[e].kind != EdgeKind::regular) continue;
      const Curve& curve = *body.edges[e].curve;
      const Interval t = curve.domain();
      bool all = true;
      for (const double share : {0.0, 0.21, 0.5, 0.83, 1.0}) all = all && where(curve.point(t.lo + share * t.width()));
      if (all) result.push_back(static_cast<int>(e));
    }
    return result;
  }
  static Where on_plane(int axis, double height) {
    return [=](const Vec3& p) { return std::abs(p[axis] - height) < 1e-7; };
  }
  static Where both(const Where& a, const Where& b) {
    return [=](const Vec3& p) { return a(p) && b(p); };
  }

  // Counterclockwise about the origin; convex where all corners lie on one circle.
  std::vector<Vec2> polygon(int corners, double size, bool convex) {
    std::vector<Vec2> result;
    for (int k = 0; k < corners; ++k) {
      const double angle = kTwoPi * (k + between(0, 0.5)) / corners;
      result.push_back((convex ? size : size * between(0.55, 1)) * Vec2(std::cos(angle), std::sin(angle)));
    }
    return result;
  }

  // A side whose u is the segment's parameter, along (0, 0, h).
  static Body extruded(const std::vector<CurvePtr>& curves, const Vec3& by) {
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (const CurvePtr& from : curves) {
      const CurvePtr to = transformed(from, Affine::translation(by));
      const Vec3 begin = from->point(from->domain().lo), end = to->point(from->domain().lo);
      loop.sides.push_back(
          {std::make_shared<ExtrusionSurface>(from, by), from, to, std::make_shared<Segment>(begin, end)});
    }
    parts.ends = {at({0, 0, 0}), at(by)};
    return swept_body(parts);
  }

  // Four sides, each a Bezier surface.
  Body loft() {
    constexpr int kCorners = 4, kSections = 3;
    std::vector<std::vector<Vec3>> rows;
    for (int i = 0; i < kSections; ++i) {
      std::vector<Vec3> row;
      for (int k = 0; k < kCorners; ++k) {
        const double angle = kTwoPi * (k + between(0, 0.2)) / kCorners, radius = between(0.8, 1.1);
        row.push_back({radius * std::cos(angle), radius * std::sin(angle), 1.5 * i / (kSections - 1)});
      }
      rows.push_back(row);
    }
    SweptParts parts;
    SweptLoop& loop = parts.loops.emplace_back();
    for (int k = 0; k < kCorners; ++k) {
      std::vector<Vec3> rail, other;
      for (const auto& row : rows) rail.push_back(row[k]), other.push_back(row[(k + 1) % kCorners]);
      Grid<Vec3> net{2, kSections, rail};
      net.values.insert(net.values.end(), other.begin(), other.end());
      loop.sides.push_back(
          {std::make_shared<NurbsSurface>(bezier_surface(net)), std::make_shared<Segment>(rail.front(), other.front()),
           std::make_shared<Segment>(rail.back(), other.back()), std::make_shared<NurbsCurve>(bezier_curve(rail))});
    }
    parts.ends = {at({0, 0, 0}), at({0, 0, 1.5})};
    return swept_body(parts);
  }

  BlendModel made(int kind) {
    const double a = between(0.8, 2), b = between(0.8, 2), c = between(0.8, 2), r = between(0.05, 0.2);
    const Body block = box(at({0, 0, 0}), {a, b, c});
    const auto result = [&](const char* name, Body body, const Where& where, double size) {
      std::vector<int> edges = edges_where(body, where);
      return BlendModel{name, std::move(body), std::move(edges), false, size};
    };
    const Where everywhere = [](const Vec3&) { return true; };
    switch (kind) {
      case 0:
        return result("box, one edge", block, both(on_plane(0, 0), on_plane(2, c)), r);
      case 1:
        return result("box, all edges", block, everywhere, r);
      case 2:
        return result("box, a face's edges", block, on_plane(2, c), r);
      case 3: {
        const std::vector<Vec2> corners = polygon(5 + static_cast<int>(3 * unit()), 1.2, false);
        return result(
            "prism, sides", prism(at({0, 0, 0}), corners, c),
            [=](const Vec3& p) {
              return std::any_of(corners.begin(), corners.end(),
                                 [&](const Vec2& corner) { return glm::length(Vec2(p) - corner) < 1e-7; });
            },
            0.4 * r);
      }
      case 4:
        return result("prism, rim", prism(at({0, 0, 0}), polygon(5, 1.2, true), c), on_plane(2, c), 0.5 * r);
      case 5:
        return result("frustum, rims", frustum(at({0, 0, 0}), 0.6 * a, 0.3 * b, c), everywhere, 0.5 * r);
      case 6:
        return result("cylinder, rims", cylinder_body(at({0, 0, 0}), 0.6 * a, c), everywhere, r);
      case 7: {
        const double radius = between(0.2, 0.35) * std::min(a, b);
        const Vec3 foot(0.5 * a, 0.5 * b, c);
        const Body rod = cylinder_body(along({0.5 * a, 0.5 * b, 0.5 * c}, {0, 0, 1}), radius, c + 0.5);
        return result("cylinder on plate, foot", boolean(BooleanOperation::unite, block, rod),
                      both(on_plane(2, c), [=](const Vec3& p) { return glm::length(p - foot) < radius + 1e-6; }),
                      0.3 * r + 0.02);
      }
      case 8: {
        const double radius = between(0.15, 0.25) * std::min(a, b);
        const Vec3 rim(0.5 * a, 0.5 * b, c);
        const Body rod = cylinder_body(along({0.5 * a, 0.5 * b, -1}, {0, 0, 1}), radius, c + 2);
        return result("bored box, rim", boolean(BooleanOperation::subtract, block, rod),
                      both(on_plane(2, c), [=](const Vec3& p) { return glm::length(p - rim) < radius + 1e-6; }),
                      0.5 * r);
      }
      case 9: {
        const double radius = between(0.1, 0.2) * std::min(a, b);
        const Vec3 middle(0.5 * a, 0.5 * b, 0.5 * c), lean(between(-0.3, 0.3), between(-0.3, 0.3), 1);
        const Vec3 rim = middle + 0.5 * c * lean;
        const Body rod = cylinder_body(along(middle - 2.0 * c * lean, lean), radius, 5 * c);
        return result("box bored aslant, rim (elliptic)", boolean(BooleanOperation::subtract, block, rod),
                      both(on_plane(2, c), [=](const Vec3& p) { return glm::length(p - rim) < 1.4 * radius; }),
                      0.3 * r);
      }
      case 10:
        return result("loft, rim (bilinear and plane)", loft(), on_plane(2, 1.5), 0.4 * r);
      case 11: {
        const double major = between(0.6, 1), minor = between(0.4, 0.6);
        const CurvePtr ellipse = std::make_shared<Ellipse>(at({0, 0, 0}), major, minor);
        return result("elliptic cylinder, rim", extruded({ellipse}, {0, 0, c}), on_plane(2, c), 0.5 * r);
      }
      case 12: {
        const double run = between(0.5, 0.7), branch = between(0.4, 0.9) * run;
        const Body through = cylinder_body(along({0, 0, -2}, {0, 0, 1}), run, 4);
        const Body across = cylinder_body(along({0, 0, 0}, {1, 0, between(-0.2, 0.2)}), branch, 2);
        return result(
            "tee, joint", boolean(BooleanOperation::unite, through, across),
            [=](const Vec3& p) { return std::abs(std::hypot(p.x, p.y) - run) < 1e-6 && std::abs(p.z) < 1.9; }, 0.3 * r);
      }
      case 13: {
        std::vector<Vec2> base = polygon(4, 1.2, true);
        return result("pyramid, base", pyramid(at({0, 0, 0}), base, {0.1, -0.1, c}), on_plane(2, 0), 0.4 * r);
      }
      case 14: {
        const double x = between(0.3, 0.5) * a, y = between(0.3, 0.5) * b;
        const Body notch = box(at({x, y, -1}), {3, 3, 5});
        return result("notched box, inner edge", boolean(BooleanOperation::subtract, block, notch),
                      both(on_plane(0, x), on_plane(1, y)), r);
      }
      case 15: {
        const double radius = between(0.25, 0.4) * std::min(a, b);
        const Vec3 middle(0.5 * a, 0.5 * b, c + between(-0.5, 0.5) * radius);
        const auto on_both =
            both(on_plane(2, c), [=](const Vec3& p) { return glm::length(p - middle) < radius + 1e-6; });
        const bool dome = unit() < 0.5;
        return result(
            dome ? "dome on a box, foot" : "bowl in a box, rim",
            boolean(dome ? BooleanOperation::unite : BooleanOperation::subtract, block, ball(at(middle), radius)),
            on_both, 0.2 * r + 0.01);
      }
      case 16: {
        // A step of two cylinders on one axis.
        const double lower = 0.6 * a, upper = 0.35 * a;
        const Body shaft = boolean(BooleanOperation::unite, cylinder_body(at({0, 0, 0}), lower, c),
                                   cylinder_body(at({0, 0, 0.5 * c}), upper, c));
        return result("stepped shaft, all circles", shaft, everywhere, 0.4 * r);
      }
      case 17: {
        const double radius = between(0.15, 0.3) * b;
        // Half of a bore in the side of the box: its rim on the top ends on the box's edges.
        const Body rod = cylinder_body(along({0, 0.5 * b, -1}, {0, 0, 1}), radius, c + 2);
        const Vec3 rim(0, 0.5 * b, c);
        return result(
            "half a bore, rim", boolean(BooleanOperation::subtract, block, rod),
            both(on_plane(2, c), [=](const Vec3& p) { return std::abs(glm::length(p - rim) - radius) < 1e-6; }),
            0.4 * r);
      }
      case 18: {
        const double radius = between(0.2, 0.3) * std::min(a, c);
        // A groove of half a cylinder along the top, its long edges.
        const Body rod = cylinder_body(along({0.5 * a, -1, c}, {0, 1, 0}), radius, b + 2);
        return result(
            "groove, edges", boolean(BooleanOperation::subtract, block, rod),
            both(on_plane(2, c), [=](const Vec3& p) { return std::abs(std::abs(p.x - 0.5 * a) - radius) < 1e-6; }),
            0.4 * r);
      }
      default: {
        // A pocket with a cone's wall.
        const double radius = between(0.2, 0.3) * std::min(a, b);
        const Vec3 rim(0.5 * a, 0.5 * b, c);
        const Body pin = frustum(at({0.5 * a, 0.5 * b, 0.4 * c}), 0.7 * radius, 1.3 * radius, 1.2 * c);
        return result(
            "conical pocket, rims", boolean(BooleanOperation::subtract, block, pin),
            [=](const Vec3& p) {
              return p.z > 0.3 * c && std::hypot(p.x - rim.x, p.y - rim.y) < 1.3 * radius + 1e-6 &&
                     (std::abs(p.z - c) < 1e-7 || std::abs(p.z - 0.4 * c) < 1e-7);
            },
            0.3 * r);
      }
    }
  }

  std::mt19937 random_;
};

}  // namespace lekalo::geometry
