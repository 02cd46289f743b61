// Closed or open plane outlines from a table of nodes, each joined to the next by a line or by an arc of a circle
// (Grezdov, Filippenko 2010: technical profiles).
//
// An arc over the chord from p to q is given by its bulge tan(d/4), d its angle (positive: to the left, the arc lies to
// the right of the chord), by its radius, or by a point on it. With c = (q - p)/2 and n the chord's left normal, its
// center is (p + q)/2 + n |c| cot(d/2).
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/line_arc_path.h"

namespace lekalo::geometry {

namespace {

struct Node {
  Vec3 at;
  double bulge = 0;   // of what joins it to the next; 0: a line
  double fillet = 0;  // radius that rounds the node
};

Vec3 left_of(const Vec3& v) { return {-v.y, v.x, 0}; }
double cross(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

double bulge_through(const Vec3& p, const Vec3& m, const Vec3& q, int i) {
  // The angle at m between its lines to p and q is pi - d/2.
  const double sine = cross(m - p, q - m), cosine = glm::dot(m - p, q - m);
  if (!(std::hypot(sine, cosine) > 0) || p == m || m == q)
    throw FieldError("nodes", fmt::format("the arc from node {} goes through one of its ends", i),
                     "give a point between");
  if (cosine < 0 && std::abs(sine) <= 1e-12 * -cosine)
    throw FieldError("nodes", fmt::format("the point `through` of node {} is on the chord's line beyond its ends", i),
                     "move it off that line");
  return std::tan(0.5 * std::atan2(sine, cosine));
}

double bulge_of_radius(double radius, double chord, int i) {
  if (0.5 * chord > std::abs(radius) * (1 + 1e-12))
    throw FieldError("nodes",
                     fmt::format("the arc from node {} spans a chord of {:.6g}: a radius of {:.6g} is too small", i,
                                 chord, std::abs(radius)),
                     fmt::format("the radius must be at least half of the chord, {:.6g}", 0.5 * chord));
  // sin(d/2) = chord / (2 radius), d <= pi
  return std::tan(0.5 * std::asin(std::clamp(0.5 * chord / radius, -1.0, 1.0)));
}

// Where the outline's plane is asked for.
Vec3 in_plane(const Vec3& point, int i) {
  if (point.z != 0)
    throw FieldError("nodes", fmt::format("node {} has a point outside of the outline's plane", i),
                     "leave z out; `frame` places the whole");
  return point;
}

double read_bulge(const Fields& node, const Vec3& p, const Vec3& q, int i) {
  const int given = node.has("bulge") + node.has("radius") + node.has("through");
  if (node.text("join") == "line") {
    if (given > 0)
      throw FieldError("nodes", fmt::format("node {} is joined by a line, which has no bulge, radius or point", i),
                       "say join: arc");
    if (p == q)
      throw FieldError("nodes", fmt::format("the line from node {} has no length", i), "leave one of its ends out");
    return 0;
  }
  if (given != 1)
    throw FieldError("nodes", fmt::format("the arc from node {} needs one of bulge, radius and through", i));
  if (p == q) throw FieldError("nodes", fmt::format("the arc from node {} has no length", i), "move one of its ends");
  if (node.has("through")) return bulge_through(p, in_plane(node.vec3("through"), i), q, i);
  if (node.has("radius")) return bulge_of_radius(node.number("radius"), glm::length(q - p), i);
  return node.number("bulge");
}

std::vector<Node> read_nodes(const std::vector<Fields>& groups, bool closed) {
  std::vector<Node> nodes;
  for (const Fields& group : groups) {
    Node node;
    node.at = in_plane(group.vec3("at"), static_cast<int>(nodes.size()));
    node.fillet = group.number("fillet");
    nodes.push_back(node);
  }
  const int count = static_cast<int>(nodes.size());
  for (int i = 0; i < count; ++i) {
    if (!closed && i + 1 == count) {
      if (groups[i].given("join")) throw FieldError("nodes", "the last node of an open curve is joined to nothing");
      break;
    }
    nodes[i].bulge = read_bulge(groups[i], nodes[i].at, nodes[(i + 1) % count].at, i);
  }
  for (int i = 0; i < count; ++i) {
    if (nodes[i].fillet == 0) continue;
    if (nodes[i].bulge != 0 || nodes[(i + count - 1) % count].bulge != 0)
      throw FieldError("nodes", fmt::format("node {} has a fillet beside an arc", i),
                       "fillets stand between two lines; next to an arc move the arc's end instead");
    if (!closed && (i == 0 || i + 1 == count))
      throw FieldError("nodes", fmt::format("node {} is an end: there is no corner for its fillet", i));
  }
  return nodes;
}

// Where the fillet of a node begins and ends: its tangent length on both sides.
double tangent_length(const std::vector<Node>& nodes, int i) {
  if (nodes[i].fillet == 0) return 0;
  const int count = static_cast<int>(nodes.size());
  const Vec3 in = nodes[i].at - nodes[(i + count - 1) % count].at, out = nodes[(i + 1) % count].at - nodes[i].at;
  const double turn = std::atan2(std::abs(cross(in, out)), glm::dot(in, out));
  if (turn > kPi - 1e-9)
    throw FieldError("nodes", fmt::format("at node {} the outline turns right back: no fillet can round that", i));
  return nodes[i].fillet * std::tan(0.5 * turn);
}

void check_room(const std::vector<Node>& nodes, int i, int next) {
  const double side = glm::length(nodes[next].at - nodes[i].at);
  const double taken = tangent_length(nodes, i) + tangent_length(nodes, next);
  if (!(taken > 0 && taken > side * (1 + 1e-12))) return;
  throw FieldError("nodes",
                   fmt::format("the line from node {} to node {}, of length {:.6g}, has no room for its fillets, which "
                               "need {:.6g}",
                               i, next, side, taken),
                   fmt::format("fillets of {:.4g} times these radii fit", std::floor(1e4 * side / taken) * 1e-4));
}

class Outline {
 public:
  Outline(const Frame& frame, std::vector<Node> nodes, bool closed)
      : frame_(frame), nodes_(std::move(nodes)), closed_(closed) {}

  NurbsCurve curve() const {
    const int count = static_cast<int>(nodes_.size());
    for (int i = 0; i < count - (closed_ ? 0 : 1); ++i) check_room(nodes_, i, (i + 1) % count);
    Box3 box;
    for (const Node& node : nodes_) box.include(node.at);
    LineArcPath path(frame_.point(leaving(0)), box.diameter());
    for (int i = 1; i < count + (closed_ ? 1 : 0); ++i) go_to(path, i % count);
    return path.curve(closed_);
  }

 private:
  Vec3 toward(int i, int other) const {
    const Vec3 way = nodes_[other].at - nodes_[i].at;
    return nodes_[i].fillet == 0 ? nodes_[i].at : nodes_[i].at + tangent_length(nodes_, i) / glm::length(way) * way;
  }
  Vec3 leaving(int i) const { return toward(i, (i + 1) % static_cast<int>(nodes_.size())); }
  Vec3 reaching(int i) const {
    return toward(i, (i + static_cast<int>(nodes_.size()) - 1) % static_cast<int>(nodes_.size()));
  }

  // From the node before: its line or arc, then this node's fillet.
  void go_to(LineArcPath& path, int i) const {
    const int before = (i + static_cast<int>(nodes_.size()) - 1) % static_cast<int>(nodes_.size());
    const double bulge = nodes_[before].bulge;
    if (bulge != 0) {
      const Vec3 p = nodes_[before].at, q = nodes_[i].at;
      // cot(d/2) = (1 - b^2) / (2 b)
      const Vec3 center = 0.5 * (p + q) + (1 - bulge * bulge) / (4 * bulge) * left_of(q - p);
      path.arc_to(frame_.point(center), frame_.z, 4 * std::atan(bulge), frame_.point(q));
      return;
    }
    path.line_to(frame_.point(reaching(i)));
    if (nodes_[i].fillet == 0 || (!closed_ && i + 1 == static_cast<int>(nodes_.size()))) return;
    const Vec3 begin = reaching(i), way = nodes_[i].at - begin, out = leaving(i) - nodes_[i].at;
    const double turn = std::atan2(cross(way, out), glm::dot(way, out));
    if (turn == 0) return;
    const Vec3 center = begin + std::copysign(nodes_[i].fillet / glm::length(way), turn) * left_of(way);
    path.arc_to(frame_.point(center), frame_.z, turn, frame_.point(leaving(i)));
  }

  Frame frame_;
  std::vector<Node> nodes_;
  bool closed_;
};

}  // namespace

TypeDeclaration line_arc_curve_type() {
  return declare(Category::curve, "line_arc_curve",
                 "Plane outline of lines and circular arcs from a table of nodes; each node says how it is joined to "
                 "the next. Counterclockwise outside, clockwise for holes.")
      .example(
          "nodes: [{ at: [0, 0] }, { at: [3, 0], join: arc, bulge: 1 }, { at: [3, 2] }, { at: [0, 2], fillet: 0.5 }]")
      .field("frame", frame(), "placement: nodes lie in its x, y plane", "{}")
      .field("nodes",
             groups({{"at", point(), "the node", true, ""},
                     {"join", choice({"line", "arc"}), "what joins it to the next", false, "line"},
                     {"bulge", number(), "of an arc: tan of a quarter of its angle; positive turns left", false, ""},
                     {"radius", number(), "of an arc of at most half a turn: positive turns left", false, ""},
                     {"through", point(), "a point on the arc", false, ""},
                     {"fillet", length().non_negative(), "radius that rounds the node, between two lines", false, "0"}})
                 .count(2),
             "the nodes in order")
      .field("closed", boolean(), "joins the last node to the first", "true")
      .built_by([](const Fields& f) {
        const bool closed = f.boolean("closed");
        return Outline(f.frame(), read_nodes(f.groups("nodes"), closed), closed).curve();
      });
}

}  // namespace lekalo::geometry
