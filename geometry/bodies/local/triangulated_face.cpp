// A face of a body replaced by curved triangles on a net of its points, some of which are moved (Golovanov 2016, 3.17
// and 6.13). The border stays: it is straight, and so are the sides of triangles along it, whose normals are across it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/face_rectangle.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/bodies/triangulations/triangulation.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/splines/bezier_chain.h"
#include "geometry/surfaces/triangles/curved_triangles.h"

namespace lekalo::geometry {

namespace {

// A side of the net: the edge of the body along it, the nodes in the direction of the edge, with its parameters there.
struct Side {
  int edge = -1;
  std::vector<int> nodes;
  std::vector<double> t;
};

class Net {
 public:
  Net(const Body& body, int face, int cells_u, int cells_v)
      : base_(over_its_rectangle(body, face)), cells_u_(cells_u), cells_v_(cells_v) {
    net_ = triangulation_of_surface(*base_, cells_u, cells_v);
    if (net_.points.size() != static_cast<size_t>(cells_u + 1) * static_cast<size_t>(cells_v + 1))
      throw FieldError("face", "the face closes, or runs to a point", "one with four sides");
    find_sides(body, face);
  }

  const SpatialTriangulation& net() const { return net_; }
  const std::vector<Side>& sides() const { return sides_; }
  bool is_reversed() const { return base_->reversed(); }
  int node(int i, int j) const { return i * (cells_v_ + 1) + j; }

  void move(const Fields& one, size_t number) {
    const std::vector<double>& at = one.numbers("at");
    const auto is_inside = [](double x, int count) { return x == std::floor(x) && x > 0 && x < count; };
    if (!is_inside(at[0], cells_u_) || !is_inside(at[1], cells_v_))
      throw FieldError("moves",
                       fmt::format("item {}: the point [{}, {}] is none inside of the net", number, at[0], at[1]),
                       fmt::format("u from 1 to {}, v from 1 to {}: the border stays", cells_u_ - 1, cells_v_ - 1));
    if (one.has("by") == one.has("height"))
      throw FieldError("moves", fmt::format("item {}: a point is moved by a vector, or by a height", number),
                       "give one of 'by' and 'height'");
    const auto k = static_cast<size_t>(node(static_cast<int>(at[0]), static_cast<int>(at[1])));
    net_.points[k] += one.has("by") ? one.vec3("by") : one.number("height") * net_.normals[k];
  }

  // Means of the triangles' normals; along the border the part of them across it, none at corners.
  void take_mean_normals() {
    const std::vector<Vec3> before = net_.normals;
    set_mean_normals(net_);
    for (Vec3& n : net_.normals)
      if (is_reversed()) n = -n;
    for (const Side& side : sides_) {
      const Vec3 along = glm::normalize(net_.points[side.nodes.back()] - net_.points[side.nodes.front()]);
      for (const int k : side.nodes)
        net_.normals[k] = glm::normalize(net_.normals[k] - glm::dot(net_.normals[k], along) * along);
      for (const int k : {side.nodes.front(), side.nodes.back()}) net_.normals[k] = before[k];
    }
  }

 private:
  void find_sides(const Body& body, int number) {
    const Face& face = body.faces[number];
    const auto refuse = [](const char* why) -> void {
      throw FieldError("face", fmt::format("the face {}", why), "one with four straight sides, and no hole");
    };
    if (face.loops.size() != 1 || body.loops[face.loops[0]].coedges.size() != 4) refuse("has not four sides");
    for (const int c : body.loops[face.loops[0]].coedges) {
      const Edge& edge = body.edges[body.coedges[c].edge];
      if (edge.kind != EdgeKind::regular || edge.coedges.size() != 2) refuse("has a side that is no edge of two faces");
      sides_.push_back(side_along(body.coedges[c].edge, *edge.curve));
      if (sides_.back().nodes.empty()) refuse("has a border that is not straight, or none of its parameters");
    }
  }

  // The nodes on a straight edge; none where not all of a side are.
  Side side_along(int edge, const Curve& curve) const {
    const Interval t = curve.domain();
    const Vec3 from = curve.point(t.lo), way = curve.point(t.hi) - from;
    const double small = 1e-10 * glm::length(way);
    for (const double f : {0.2, 0.5, 0.9})
      if (glm::length(curve.point(t.lo + f * t.width()) - from - f * way) > small) return {};
    for (const bool along_u : {true, false})
      for (const bool at_end : {false, true}) {
        const int count = along_u ? cells_u_ : cells_v_;
        Side side{edge, {}, {}};
        for (int k = 0; k <= count; ++k) {
          const int number = along_u ? node(k, at_end ? cells_v_ : 0) : node(at_end ? cells_u_ : 0, k);
          const double f = glm::dot(net_.points[number] - from, way) / glm::dot(way, way);
          if (glm::length(net_.points[number] - from - f * way) > small) break;
          side.nodes.push_back(number), side.t.push_back(t.lo + f * t.width());
        }
        if (static_cast<int>(side.nodes.size()) <= count) continue;
        if (side.t.front() > side.t.back())
          std::reverse(side.nodes.begin(), side.nodes.end()), std::reverse(side.t.begin(), side.t.end());
        side.t.front() = t.lo, side.t.back() = t.hi;
        return side;
      }
    return {};
  }

  SurfacePtr base_;
  int cells_u_, cells_v_;
  SpatialTriangulation net_;
  std::vector<Side> sides_;
};

TriangularNet patch_of(const std::string& kind, const std::array<TriangleCorner, 3>& corners) {
  if (kind == "flat") return net_of_points(1, {corners[0].point, corners[1].point, corners[2].point});
  return curved_triangle(corners, kind == "balanced" ? CurvedTriangle::balanced : CurvedTriangle::pn);
}

// The side from corner k to the next.
CurvePtr side_of(const TriangularNet& net, int k) {
  BezierSegment points;
  for (int i = net.degree; i >= 0; --i) {
    const std::array<int, 3> index = k == 0   ? std::array{i, net.degree - i, 0}
                                     : k == 1 ? std::array{0, i, net.degree - i}
                                              : std::array{net.degree - i, 0, i};
    points.push_back(net.at(index[0], index[1]));
  }
  return std::make_shared<NurbsCurve>(bezier_chain(std::array{points}));
}

class Replacing {
 public:
  Replacing(const Body& body, int face, const Net& net, std::string kind)
      : body_(body), face_(face), net_(net), kind_(std::move(kind)) {}

  FaceReplacement build() {
    add_old_edges();
    made_.body.shells.resize(body_.shells.size());
    for (size_t s = 0; s < body_.shells.size(); ++s) made_.body.shells[s].closed = body_.shells[s].closed;
    for (size_t f = 0; f < body_.faces.size(); ++f) {
      if (static_cast<int>(f) == face_)
        for (size_t k = 0; k < net_.net().triangles.size(); ++k) add_triangle(k);
      else
        add_old_face(static_cast<int>(f));
    }
    measure_tolerances(made_.body);
    return std::move(made_);
  }

 private:
  struct NetEdge {
    int edge;
    int from;  // the node where it begins
  };

  void add_old_edges() {
    Body& made = made_.body;
    for (const Vertex& v : body_.vertices) {
      made.add_vertex(v.point, v.origin);
      made.vertices.back().tolerance = v.tolerance;
    }
    parts_.resize(body_.edges.size());
    for (size_t e = 0; e < body_.edges.size(); ++e) {
      const Edge& edge = body_.edges[e];
      const Side* side = side_along(static_cast<int>(e));
      if (side)
        split(*side);
      else
        parts_[e] = {made.add_edge(edge.curve, edge.start, edge.end, edge.origin, edge.kind)};
    }
    for (size_t k = 0; k < net_.net().points.size(); ++k) vertices_.try_emplace(static_cast<int>(k), -1);
    for (auto& [node, vertex] : vertices_)
      if (vertex < 0) vertex = made.add_vertex(net_.net().points[node]);
  }

  const Side* side_along(int edge) const {
    for (const Side& side : net_.sides())
      if (side.edge == edge) return &side;
    return nullptr;
  }

  void split(const Side& side) {
    Body& made = made_.body;
    const Edge& edge = body_.edges[side.edge];
    const size_t last = side.nodes.size() - 1;
    vertices_[side.nodes[0]] = edge.start, vertices_[side.nodes[last]] = edge.end;
    for (size_t k = 1; k < last; ++k) vertices_[side.nodes[k]] = made.add_vertex(edge.curve->point(side.t[k]));
    for (size_t k = 0; k < last; ++k) {
      Origin origin = edge.origin;
      const CurvePtr part =
          last == 1 ? edge.curve : std::make_shared<CurvePart>(edge.curve, Interval{side.t[k], side.t[k + 1]});
      const int number = made.add_edge(part, vertices_[side.nodes[k]], vertices_[side.nodes[k + 1]], origin);
      parts_[side.edge].push_back(number);
      net_edges_[key(side.nodes[k], side.nodes[k + 1])] = {number, side.nodes[k]};
    }
  }

  void add_old_face(int f) {
    const Face& face = body_.faces[f];
    const int number =
        put(made_.body.add_face(face.surface, face.forward, face.origin, face.trimmed), face.shell, false);
    for (const int l : face.loops) {
      std::vector<Body::Use> uses;
      for (const int c : body_.loops[l].coedges) {
        const Coedge& use = body_.coedges[c];
        std::vector<Body::Use> parts;
        for (const int e : parts_[use.edge]) {
          const Interval t = made_.body.edges[e].curve->domain();
          parts.push_back(
              {e, use.forward, t == use.image->domain() ? use.image : std::make_shared<CurvePart>(use.image, t)});
        }
        if (!use.forward) std::reverse(parts.begin(), parts.end());
        uses.insert(uses.end(), parts.begin(), parts.end());
      }
      made_.body.add_loop(number, uses);
    }
  }

  void add_triangle(size_t k) {
    const SpatialTriangulation& net = net_.net();
    const std::array<int, 3>& nodes = net.triangles[k];
    const std::array<Vec2, 3>& uv = net.parameters[k];
    std::array<TriangleCorner, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = {net.points[nodes[i]], net.normals[nodes[i]], uv[i]};
    const TriangularNet patch = patch_of(kind_, corners);
    // The border of the square over which the triangle is seen: its pole, u = 1, is the first corner.
    static const std::array<std::array<Vec2, 2>, 3> kSides{
        {{Vec2(1, 1), Vec2(0, 1)}, {Vec2(0, 1), Vec2(0, 0)}, {Vec2(0, 0), Vec2(1, 0)}}};
    std::vector<Body::Use> uses;
    for (const int i : {2, 0, 1}) {
      const int a = nodes[i], b = nodes[(i + 1) % 3];
      auto found = net_edges_.find(key(a, b));
      if (found == net_edges_.end())
        found = net_edges_
                    .emplace(key(a, b), NetEdge{made_.body.add_edge(side_of(patch, i), vertices_[a], vertices_[b]), a})
                    .first;
      const bool forward = found->second.from == a;
      const Interval t = made_.body.edges[found->second.edge].curve->domain();
      const auto& [from, to] = kSides[i];
      uses.push_back({found->second.edge, forward, forward ? image_line(t, from, to) : image_line(t, to, from)});
      if (i != 2) continue;
      const int pole =
          made_.body.add_edge(point_curve({0, 1}, corners[0].point), vertices_[b], vertices_[b], {}, EdgeKind::pole);
      uses.push_back({pole, true, image_line({0, 1}, Vec2(1, 0), Vec2(1, 1))});
    }
    // Seen from outside the parameters run clockwise where the surface looks inward.
    if (net_.is_reversed()) {
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& use : uses) use.forward = !use.forward;
    }
    const auto surface = std::make_shared<BezierTriangle>(patch, ParameterTriangle{uv});
    Origin origin = body_.faces[face_].origin;
    origin.role = origin.index < 0 ? origin.role : fmt::format("{}.{}", origin.role, origin.index);
    origin.index = static_cast<int>(k);
    const int f = put(made_.body.add_face(surface, !net_.is_reversed(), origin, false), body_.faces[face_].shell, true);
    made_.body.add_loop(f, uses);
  }

  int put(int face, int shell, bool is_changed) {
    made_.body.faces[face].shell = shell;
    made_.body.shells[shell].faces.push_back(face);
    made_.changed.push_back(is_changed);
    return face;
  }

  static std::pair<int, int> key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

  const Body& body_;
  int face_;
  const Net& net_;
  std::string kind_;
  FaceReplacement made_;
  std::vector<std::vector<int>> parts_;               // of each old edge, its new edges along it
  std::map<int, int> vertices_;                       // of nodes
  std::map<std::pair<int, int>, NetEdge> net_edges_;  // between nodes
};

BodyPtr triangulated(const Fields& f) {
  const Body& body = *f.body("of");
  const int face = one_called(body, Element::face, f.text("face"), "face");
  Net net(body, face, f.u<int>("cells"), f.v<int>("cells"));
  if (f.has("moves")) {
    size_t number = 0;
    for (const Fields& one : f.groups("moves")) net.move(one, number++);
  }
  if (f.text("normals_of_moved") == "mean") net.take_mean_normals();
  FaceReplacement made = Replacing(body, face, net, f.text("patch")).build();
  check_replacement(made, "moves", "moves by less");
  return std::make_shared<Body>(std::move(made.body));
}

}  // namespace

TypeDeclaration triangulated_face_type() {
  return declare(
             Category::body, "triangulated_face",
             "A body one of whose faces, with four straight sides, becomes curved triangles on a net of its points, "
             "and some points inside of the net are moved. The border stays; its edges are cut at the net. (A "
             "deformed_face is smooth instead.)")
      .example("of: { type: box, size: [4, 4, 1] }, face: z_max, cells: 4, moves: { at: [2, 2], height: 1.5 }")
      .field("of", reference({Category::body}), "the body")
      .field("face", text(),
             "name or number of the face, as 'lekalo measure --topology' gives them; triangle k is called "
             "FACE.k")
      .field("cells", integer().between(1, 100).for_each_direction(),
             "of the face's rectangle along u and v, each two triangles", "4")
      .optional("moves",
                groups({{"at", numbers().count(2, 2), "the point: its numbers along u and v, from 0", true, {}},
                        {"by", vector(), "how far", false, {}},
                        {"height", number(), "in place of it: along the outward normal", false, {}}}),
                "points that are moved")
      .field("patch", choice({"pn", "balanced", "flat"}), "pn: cubics; balanced: of degree 4; flat: facets", "pn")
      .field("normals_of_moved", choice({"mean", "kept"}),
             "mean: those of the triangles about each point; kept: those of the face", "mean")
      .built_by(triangulated);
}

}  // namespace lekalo::geometry
