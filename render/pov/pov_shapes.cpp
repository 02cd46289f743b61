// Geometry in POV-Ray's shapes (POV-Ray 3.7 documentation, "Objects").
//
// POV-Ray transforms in the order written and clips in the coordinates reached so far, so a shape is: primitive, matrix
// of its frame, clipped_by in the surface's coordinates. `plane { n, d }` is inside where dot(p, n) < d.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/tessellation/tessellate.h"
#include "geometry/transformed.h"
#include "render/pov/pov_parts.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Parts of a turn and of lengths that are the whole up to the rounding of multiples of pi.
constexpr double kWhole = 1e-12;

bool is_turn(const Interval& u) { return u.hi - u.lo >= kTwoPi * (1 - kWhole); }

// Keeps the points whose angle about the frame's axis lies in u: two half-spaces, both (up to half a turn) or either.
std::string wedge(const Frame& frame, const Interval& u) {
  if (is_turn(u)) return {};
  const auto across = [&](double angle) { return -std::sin(angle) * frame.x + std::cos(angle) * frame.y; };
  const std::string begin = pov_plane(-across(u.lo), frame.origin), end = pov_plane(across(u.hi), frame.origin);
  return u.hi - u.lo <= kPi ? begin + " " + end : fmt::format("union {{ {} {} }}", begin, end);
}

// Keeps lo <= dot(p - origin, axis) <= hi; infinite ends keep all.
std::string slab(const Vec3& origin, const Vec3& axis, double lo, double hi) {
  std::string text;
  if (lo > -kInfinity) text += fmt::format(" {}", pov_plane(-axis, origin + lo * axis));
  if (hi < kInfinity) text += fmt::format(" {}", pov_plane(axis, origin + hi * axis));
  return text;
}

std::string clipped(const std::string& planes) {
  if (planes.find_first_not_of(' ') == std::string::npos) return {};
  return fmt::format("\n  clipped_by {{ {} }}", planes.substr(planes.find_first_not_of(' ')));
}

// x^2 s.x + y^2 s.y + z^2 s.z + linear z + constant = 0 in the frame.
std::string quadric(const Frame& frame, const Vec3& squares, double linear, double constant) {
  return fmt::format("quadric {{ {}, <0, 0, 0>, <0, 0, {}>, {}{}", pov(squares), linear, constant,
                     pov(pov_frame(frame)));
}

// Radius and height along the axis of a cone at v.
double radius_at(const ConeSurface& c, double v) { return c.radius() + (c.top_radius() - c.radius()) * v; }

std::optional<std::string> cone(const ConeSurface& c, bool open) {
  const Interval v = c.domain().v;
  const std::string angle = wedge(c.frame(), c.domain().u);
  if (!c.bounded()) {
    const double slope = (c.top_radius() - c.radius()) / c.height(), r = c.radius();
    return quadric(c.frame(), {1, 1, -slope * slope}, -2 * r * slope, -r * r) +
           clipped(angle + slab(c.frame().origin, c.frame().z, c.height() * v.lo, c.height() * v.hi));
  }
  const double r0 = radius_at(c, v.lo), r1 = radius_at(c, v.hi);
  if (r0 * r1 < 0) return std::nullopt;
  const Vec3 p0 = c.frame().point({0, 0, c.height() * v.lo}), p1 = c.frame().point({0, 0, c.height() * v.hi});
  const std::string end = open ? " open" : "";
  if (r0 == r1) return fmt::format("cylinder {{ {}, {}, {}{}{}", pov(p0), pov(p1), std::abs(r0), end, clipped(angle));
  return fmt::format("cone {{ {}, {}, {}, {}{}{}", pov(p0), std::abs(r0), pov(p1), std::abs(r1), end, clipped(angle));
}

std::optional<std::string> meridian_surface(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const Interval v = domain.v;
  if (const auto* s = dynamic_cast<const SphereSurface*>(&surface)) {
    const bool whole = v.hi - v.lo >= kPi * (1 - kWhole);
    const double lo = whole ? -kInfinity : s->radius() * std::sin(v.lo),
                 hi = whole ? kInfinity : s->radius() * std::sin(v.hi);
    return fmt::format("sphere {{ {}, {}{}", pov(s->frame().origin), s->radius(),
                       clipped(wedge(s->frame(), domain.u) + slab(s->frame().origin, s->frame().z, lo, hi)));
  }
  if (const auto* c = dynamic_cast<const ConeSurface*>(&surface)) return cone(*c, true);
  if (const auto* t = dynamic_cast<const TorusSurface*>(&surface)) {
    if (t->major_radius() < t->minor_radius() || !is_turn(v)) return std::nullopt;
    // POV-Ray's torus lies in its xz plane.
    const Frame& f = t->frame();
    const Affine place{Mat3(f.x, f.z, f.y), f.origin};
    return fmt::format("torus {{ {}, {} sturm{}{}", t->major_radius(), t->minor_radius(), pov(place),
                       clipped(wedge(f, domain.u)));
  }
  if (const auto* e = dynamic_cast<const Ellipsoid*>(&surface)) {
    const double c = e->semi_axes().z;
    const bool whole = v.hi - v.lo >= kPi * (1 - kWhole);
    return fmt::format("sphere {{ <0, 0, 0>, 1{}{}", pov(pov_frame(e->frame(), e->semi_axes())),
                       clipped(wedge(e->frame(), domain.u) + slab(e->frame().origin, e->frame().z,
                                                                  whole ? -kInfinity : c * std::sin(v.lo),
                                                                  whole ? kInfinity : c * std::sin(v.hi))));
  }
  if (const auto* h = dynamic_cast<const HyperboloidOneSheet*>(&surface)) {
    const Vec3 a = h->semi_axes();
    return quadric(h->frame(), {1 / (a.x * a.x), 1 / (a.y * a.y), -1 / (a.z * a.z)}, 0, -1) +
           clipped(wedge(h->frame(), domain.u) +
                   slab(h->frame().origin, h->frame().z, a.z * std::sinh(v.lo), a.z * std::sinh(v.hi)));
  }
  if (const auto* h = dynamic_cast<const HyperboloidTwoSheets*>(&surface)) {
    const Vec3 a = h->semi_axes();
    // From v = 0 the plane through the middle separates the sheets without touching the vertex.
    const double lo = v.lo > 0 ? std::abs(a.z) * std::cosh(v.lo) : 0, hi = std::abs(a.z) * std::cosh(v.hi);
    return quadric(h->frame(), {1 / (a.x * a.x), 1 / (a.y * a.y), -1 / (a.z * a.z)}, 0, 1) +
           clipped(wedge(h->frame(), domain.u) +
                   slab(h->frame().origin, a.z > 0 ? h->frame().z : -h->frame().z, lo, hi));
  }
  if (const auto* p = dynamic_cast<const EllipticParaboloid*>(&surface)) {
    const Vec2 a = p->semi_axes();
    return quadric(p->frame(), {1 / (a.x * a.x), 1 / (a.y * a.y), 0}, -1, 0) +
           clipped(wedge(p->frame(), domain.u) +
                   slab(p->frame().origin, p->frame().z, v.lo > 0 ? v.lo * v.lo : -kInfinity, v.hi * v.hi));
  }
  return std::nullopt;
}

std::optional<std::string> saddle(const Surface& surface) {
  const auto* p = dynamic_cast<const HyperbolicParaboloid*>(&surface);
  if (p == nullptr) return std::nullopt;
  const Vec2 a = p->semi_axes();
  const Rectangle d = p->domain();
  return quadric(p->frame(), {1 / (a.x * a.x), -1 / (a.y * a.y), 0}, -1, 0) +
         clipped(slab(p->frame().origin, p->frame().x, a.x * d.u.lo, a.x * d.u.hi) +
                 slab(p->frame().origin, p->frame().y, a.y * d.v.lo, a.y * d.v.hi));
}

// Cartesian control points of a polynomial row raised to degree 3:
// q_0 = p_0, q_i = i/(n+1) p_(i-1) + (1 - i/(n+1)) p_i, q_(n+1) = p_n.
std::vector<Vec3> cubic(std::vector<Vec3> row) {
  while (row.size() < 4) {
    const size_t n = row.size();
    std::vector<Vec3> raised(n + 1);
    for (size_t i = 0; i <= n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(n);
      raised[i] = (i > 0 ? share * row[i - 1] : Vec3(0)) + (i < n ? (1 - share) * row[i] : Vec3(0));
    }
    row = std::move(raised);
  }
  return row;
}

// The piece as 4 x 4 points where it is polynomial of degrees up to 3.
std::optional<std::vector<Vec3>> bicubic(const SurfacePiece& piece) {
  if (!piece.is_rational() || piece.degree_u > 3 || piece.degree_v > 3) return std::nullopt;
  std::vector<std::vector<Vec3>> rows;
  for (int i = 0; i <= piece.degree_u; ++i) {
    std::vector<Vec3> row;
    for (int j = 0; j <= piece.degree_v; ++j) {
      const Vec4& p = piece.points[i * (piece.degree_v + 1) + j];
      if (p.w != piece.points[0].w) return std::nullopt;
      row.push_back(Vec3(p) / p.w);
    }
    rows.push_back(cubic(row));
  }
  std::vector<Vec3> points(16);
  for (int j = 0; j < 4; ++j) {
    std::vector<Vec3> column;
    for (const auto& row : rows) column.push_back(row[j]);
    column = cubic(column);
    for (int i = 0; i < 4; ++i) points[4 * i + j] = column[i];
  }
  return points;
}

std::optional<std::string> patches(const Surface& surface, const PovOptions& options) {
  std::string text;
  const std::vector<SurfacePiece> pieces = surface.pieces();
  if (pieces.empty()) return std::nullopt;
  for (const SurfacePiece& piece : pieces) {
    const auto points = bicubic(piece);
    if (!points) return std::nullopt;
    text += pieces.size() > 1 ? "\n  " : "";
    text += fmt::format("bicubic_patch {{ type 1 flatness {0} u_steps {1} v_steps {1}", options.flatness,
                        options.patch_steps);
    for (int i = 0; i < 16; ++i) text += (i % 4 == 0 ? "\n    " : " ") + pov((*points)[i]) + (i < 15 ? "," : "");
    if (pieces.size() > 1) text += " }";
  }
  return pieces.size() > 1 ? fmt::format("union {{{}", text) : text;
}

TessellationTolerance tolerance(const Box3& box, const std::string& name, const PovOptions& options, PovNotes& notes) {
  TessellationTolerance t;
  t.sag = options.sag > 0 ? options.sag : 1e-4 * box.diameter();
  notes.add(
      fmt::format("{}: POV-Ray has no such shape; written as smooth triangles, at most {:.3g} from it", name, t.sag));
  return t;
}

bool is_box(const Body& body, Affine& place) {
  if (body.faces.size() != 6 || body.vertices.size() != 8) return false;
  for (const Face& face : body.faces)
    if (dynamic_cast<const Plane*>(face.surface.get()) == nullptr) return false;
  std::vector<Vec3> sides;
  const Vec3 corner = body.vertices[0].point;
  for (const Edge& edge : body.edges)
    if (edge.start == 0 || edge.end == 0)
      sides.push_back(body.vertices[edge.start == 0 ? edge.end : edge.start].point - corner);
  if (sides.size() != 3) return false;
  const double same = kWhole * bounds(body).diameter();
  for (int c = 0; c < 8; ++c) {
    Vec3 p = corner;
    for (int k = 0; k < 3; ++k)
      if (c >> k & 1) p += sides[k];
    bool found = false;
    for (const Vertex& vertex : body.vertices) found = found || glm::length(vertex.point - p) <= same;
    if (!found) return false;
  }
  place = {Mat3(sides[0], sides[1], sides[2]), corner};
  return true;
}

}  // namespace

PovShape pov_shape(const Mesh& mesh) {
  std::string text = fmt::format("mesh2 {{\n  vertex_vectors {{ {}", mesh.points.size());
  for (const Vec3& p : mesh.points) text += ",\n    " + pov(p);
  text += " }";
  const bool smooth = !mesh.normals.empty() && !mesh.triangles.empty() && mesh.triangles[0].normal[0] >= 0;
  if (smooth) {
    text += fmt::format("\n  normal_vectors {{ {}", mesh.normals.size());
    for (const Vec3& n : mesh.normals) text += ",\n    " + pov(n);
    text += " }";
  }
  std::string faces, normals;
  for (const Mesh::Triangle& t : mesh.triangles) {
    faces += fmt::format(",\n    <{}, {}, {}>", t.point[0], t.point[1], t.point[2]);
    if (smooth) normals += fmt::format(",\n    <{}, {}, {}>", t.normal[0], t.normal[1], t.normal[2]);
  }
  text += fmt::format("\n  face_indices {{ {}{} }}", mesh.triangles.size(), faces);
  if (smooth) text += fmt::format("\n  normal_indices {{ {}{} }}", mesh.triangles.size(), normals);
  return {text, {}};
}

PovShape pov_shape(const SurfacePtr& surface, const std::string& name, const PovOptions& options, PovNotes& notes) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    PovShape shape = pov_shape(moved->original(), name, options, notes);
    shape.text += pov(moved->map());
    shape.parameters.reset();
    return shape;
  }
  if (const auto* plane = dynamic_cast<const Plane*>(surface.get())) {
    const Frame& f = plane->frame();
    const Rectangle d = plane->domain();
    // pov_plane is a whole plane object; its brace opens again for the attributes.
    std::string text = pov_plane(f.z, f.origin);
    text.erase(text.rfind(" }"));
    return {text + clipped(slab(f.origin, f.x, d.u.lo, d.u.hi) + slab(f.origin, f.y, d.v.lo, d.v.hi)), f};
  }
  if (const auto text = meridian_surface(*surface)) return {*text, {}};
  if (const auto text = saddle(*surface)) return {*text, {}};
  if (const auto text = patches(*surface, options)) return {*text, {}};
  return pov_shape(tessellate(*surface, tolerance(bounds(*surface), name, options, notes)));
}

namespace {

// The straight column over what a loop of the plane encloses, from one unit below the plane to one above; nothing for
// curves other than whole circles and straight lines.
std::optional<std::string> column(const Body& body, const Loop& loop, const Frame& frame) {
  std::vector<Vec3> corners;
  for (const int index : loop.coedges) {
    const Coedge& coedge = body.coedges[index];
    const auto* circle = dynamic_cast<const Circle*>(coedge.image.get());
    if (circle != nullptr && loop.coedges.size() == 1 && is_turn(circle->domain())) {
      const Vec3 center = frame.point(circle->frame().origin);
      return fmt::format("cylinder {{ {}, {}, {} }}", pov(center - frame.z), pov(center + frame.z), circle->radius());
    }
    std::vector<CurvePiece> pieces = coedge.image->pieces();
    if (!coedge.forward) std::reverse(pieces.begin(), pieces.end());
    for (const CurvePiece& piece : pieces) {
      if (!piece.is_rational() || piece.degree() != 1) return std::nullopt;
      corners.push_back(coedge.image->point(coedge.forward ? piece.domain.lo : piece.domain.hi));
    }
  }
  corners.push_back(corners.front());
  // POV-Ray's prisms stand on its xz plane.
  std::string text = fmt::format("prism {{ linear_spline -1, 1, {}", corners.size());
  for (const Vec3& corner : corners) text += fmt::format(", <{}, {}>", corner.x, corner.y);
  return text + pov(Affine{Mat3(frame.x, frame.z, frame.y), frame.origin}) + " }";
}

// Parts of one plane between loops: the plane clipped by the columns over them.
std::optional<PovShape> trimmed_plane(const Body& body) {
  const auto* plane = dynamic_cast<const Plane*>(body.faces[0].surface.get());
  if (plane == nullptr || body.is_closed()) return std::nullopt;
  std::string parts;
  for (const Face& face : body.faces) {
    if (face.surface != body.faces[0].surface || !face.trimmed) return std::nullopt;
    std::string columns;
    for (const int loop : face.loops) {
      const auto text = column(body, body.loops[loop], plane->frame());
      if (!text) return std::nullopt;
      columns += "\n    " + *text;
    }
    parts += face.loops.size() == 1 ? columns : fmt::format("\n    difference {{{} }}", columns);
  }
  if (body.faces.size() > 1) parts = fmt::format("\n    union {{{} }}", parts);
  std::string text = pov_plane(plane->frame().z, plane->frame().origin);
  text.erase(text.rfind(" }"));
  return PovShape{text + fmt::format("\n  clipped_by {{{} }}", parts), plane->frame()};
}

bool has_straight_edges(const Body& body) {
  return std::all_of(body.edges.begin(), body.edges.end(), [](const Edge& edge) {
    const std::vector<CurvePiece> pieces = edge.curve->pieces();
    return std::all_of(pieces.begin(), pieces.end(),
                       [](const CurvePiece& piece) { return piece.is_rational() && piece.degree() == 1; });
  });
}

}  // namespace

PovShape pov_shape(const Body& body, const std::string& name, const PovOptions& options, PovNotes& notes) {
  Affine place;
  if (is_box(body, place)) {
    const Vec3 diagonal = place.linear * Vec3(1);
    const Mat3& m = place.linear;
    const bool aligned = m[0].y == 0 && m[0].z == 0 && m[1].x == 0 && m[1].z == 0 && m[2].x == 0 && m[2].y == 0;
    if (aligned) return {fmt::format("box {{ {}, {}", pov(place.offset), pov(place.offset + diagonal)), {}};
    return {fmt::format("box {{ <0, 0, 0>, <1, 1, 1>{}", pov(place)), {}};
  }
  if (body.faces.size() == 1 && !body.faces[0].trimmed)
    if (const auto text = meridian_surface(*body.faces[0].surface)) return {*text, {}};
  if (const auto shape = trimmed_plane(body)) return *shape;
  const ConeSurface* side = nullptr;
  bool all_flat = true;
  int flat = 0;
  for (const Face& face : body.faces) {
    if (dynamic_cast<const Plane*>(face.surface.get()) != nullptr)
      ++flat;
    else
      all_flat = false;
    if (!face.trimmed) side = dynamic_cast<const ConeSurface*>(face.surface.get());
  }
  if (side != nullptr && side->bounded() && static_cast<size_t>(flat) + 1 == body.faces.size() &&
      flat == (radius_at(*side, side->domain().v.lo) != 0) + (radius_at(*side, side->domain().v.hi) != 0))
    if (const auto text = cone(*side, false)) return {*text, {}};
  if (all_flat && has_straight_edges(body)) {
    Mesh mesh = tessellate(body, {});
    for (Mesh::Triangle& t : mesh.triangles) t.normal = {-1, -1, -1};
    return pov_shape(mesh);
  }
  return pov_shape(tessellate(body, tolerance(bounds(body), name, options, notes)));
}

}  // namespace lekalo::render
