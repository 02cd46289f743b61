#include "geometry/bodies/primitives/construct.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tessellation/predicates.h"

namespace lekalo::geometry {

namespace {

// A degree-1 curve over any interval; the points may be equal.
CurvePtr line_over(const Interval& t, const Vec3& from, const Vec3& to) {
  const std::array<Vec3, 2> points{from, to};
  return std::make_shared<NurbsCurve>(SplineAxis(1, {t.lo, t.lo, t.hi, t.hi}, Extension::analytic), points);
}

Vec3 polygon_normal(const std::vector<Vec3>& points, const std::vector<int>& corners) {
  Vec3 sum(0);
  const Vec3 o = points[corners[0]];
  for (size_t i = 1; i + 1 < corners.size(); ++i) sum += glm::cross(points[corners[i]] - o, points[corners[i + 1]] - o);
  return sum;
}

}  // namespace

Curve2Ptr image_line(const Interval& t, const Vec2& from, const Vec2& to) {
  return line_over(t, Vec3(from, 0), Vec3(to, 0));
}

CurvePtr point_curve(const Interval& t, const Vec3& point) { return line_over(t, point, point); }

Body polyhedron(const std::vector<Vec3>& points, const std::vector<PolygonFace>& faces) {
  Body body;
  for (const Vec3& p : points) body.add_vertex(p);
  std::map<std::pair<int, int>, int> edges;
  const auto edge_between = [&](int a, int b) {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto [found, is_new] = edges.try_emplace(key, static_cast<int>(body.edges.size()));
    if (is_new)
      body.add_edge(std::make_shared<Segment>(points[key.first], points[key.second]), key.first, key.second,
                    {"", "edge", found->second});
    return found->second;
  };

  for (const PolygonFace& polygon : faces) {
    const std::vector<int>& corners = polygon.corners;
    const Vec3 outward = polygon_normal(points, corners);
    const Frame frame = polygon.frame
                            ? *polygon.frame
                            : frame_from(points[corners[0]], outward, points[corners[1]] - points[corners[0]]);
    const bool forward = glm::dot(frame.z, outward) > 0;
    std::vector<Vec2> flat;
    Vec2 lo(kInfinity), hi(-kInfinity);
    for (int corner : corners) {
      flat.push_back(Vec2(frame.to_local_point(points[corner])));
      lo = glm::min(lo, flat.back());
      hi = glm::max(hi, flat.back());
    }
    // A rectangle is its surface's whole domain; any other polygon lies well inside it, so that lines near an edge
    // still meet the surface.
    const Vec2 size = hi - lo;
    const double small = 1e-13 * (std::abs(lo.x) + std::abs(lo.y) + size.x + size.y);
    bool rectangle = corners.size() == 4;
    for (Vec2& p : flat) {
      for (int k = 0; k < 2; ++k) {
        const bool at_lo = std::abs(p[k] - lo[k]) <= small, at_hi = std::abs(p[k] - hi[k]) <= small;
        rectangle = rectangle && (at_lo || at_hi);
      }
    }
    if (rectangle) {
      for (Vec2& p : flat)
        for (int k = 0; k < 2; ++k) p[k] = std::abs(p[k] - lo[k]) <= small ? lo[k] : hi[k];
    } else {
      lo -= 0.05 * size;
      hi += 0.05 * size;
    }
    auto plane = std::make_shared<Plane>(frame, Rectangle{{lo.x, hi.x}, {lo.y, hi.y}});
    const int face = body.add_face(std::move(plane), forward, polygon.origin, !rectangle);
    std::vector<Body::Use> uses;
    for (size_t i = 0; i < corners.size(); ++i) {
      const size_t next = (i + 1) % corners.size();
      const int edge = edge_between(corners[i], corners[next]);
      const bool along = body.edges[edge].start == corners[i];
      const Vec2 &a = flat[i], &b = flat[next];
      uses.push_back({edge, along, image_line({0, 1}, along ? a : b, along ? b : a)});
    }
    body.add_loop(face, uses);
  }
  body.close_shell();
  return body;
}

void declare_base(TypeDeclaration& type) {
  type.field("frame", frame(), "placement: the base lies in the plane of x and y", "{}")
      .optional("sides", integer().between(3, 10000), "number of sides of a regular base; needs a radius")
      .optional("radius", length().positive(),
                "distance of a regular base's corners from its center; the first is on x")
      .optional("points", parameter_points().count(3), "corners of the base in the frame's x and y, in place of sides");
}

namespace {

// Sides of a simple polygon meet only at their common corner.
void require_simple(const std::vector<Vec2>& polygon) {
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    if (a == b) throw FieldError("points", "two neighbouring corners of the base are equal");
    for (size_t j = i + 1; j < n; ++j) {
      const Vec2 &c = polygon[j], &d = polygon[(j + 1) % n];
      const bool neighbours = j == i + 1 || (i == 0 && j + 1 == n);
      const double c_side = orient2d(a, b, c), d_side = orient2d(a, b, d);
      const double a_side = orient2d(c, d, a), b_side = orient2d(c, d, b);
      if (neighbours) {
        // Folded back onto each other.
        const Vec2 &far = j == i + 1 ? d : c, &common = j == i + 1 ? b : a, &near = j == i + 1 ? a : b;
        if ((j == i + 1 ? d_side : c_side) == 0 && glm::dot(far - common, near - common) > 0)
          throw FieldError("points", "the sides of the base overlap");
        continue;
      }
      const auto opposite = [](double x, double y) { return (x <= 0 && y >= 0) || (x >= 0 && y <= 0); };
      const bool collinear = c_side == 0 && d_side == 0;
      if (collinear) {
        const double along = glm::dot(b - a, b - a), p = glm::dot(c - a, b - a), q = glm::dot(d - a, b - a);
        if (std::max(p, q) < 0 || std::min(p, q) > along) continue;
      }
      if (opposite(c_side, d_side) && opposite(a_side, b_side))
        throw FieldError("points", "the sides of the base cross or touch", "give the corners in order around it");
    }
  }
}

}  // namespace

std::vector<Vec2> base_polygon(const Fields& fields) {
  std::vector<Vec2> polygon;
  if (fields.has("points")) {
    if (fields.has("sides") || fields.has("radius"))
      throw FieldError("points", "the base is given by points or by sides and radius, not both");
    for (const Vec3& p : fields.points("points")) polygon.push_back(Vec2(p));
    require_simple(polygon);
    double area = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
      area += a.x * b.y - a.y * b.x;
    }
    if (area < 0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  }
  if (!fields.has("sides")) throw FieldError("sides", "the base is missing", "give sides and radius, or points");
  if (!fields.has("radius")) throw FieldError("radius", "a regular base needs a radius");
  const int sides = fields.integer("sides");
  for (int k = 0; k < sides; ++k) {
    const Affine turn = Affine::rotation(kTwoPi * k / sides, Vec3(0, 0, 1));
    polygon.push_back(Vec2(turn.point({fields.number("radius"), 0, 0})));
  }
  return polygon;
}

void declare_axis(TypeDeclaration& type) {
  type.field("frame", frame(), "placement: the center of the base circle, the axis z, x at the angle 0", "{}")
      .optional("height", length().positive(), "length along the axis, from the base")
      .optional("heights", range(), "where the body begins and ends along the axis, in place of height");
}

AxialPlacement axial_placement(const Fields& fields) {
  Frame frame = fields.frame();
  if (fields.has("height") == fields.has("heights"))
    throw FieldError("height", fields.has("height") ? "height and heights are both given" : "the height is missing",
                     "give height, or heights: [from, to]");
  if (fields.has("height")) return {frame, fields.number("height")};
  const Interval heights = fields.range("heights");
  frame.origin += heights.lo * frame.z;
  return {frame, heights.width()};
}

}  // namespace lekalo::geometry
