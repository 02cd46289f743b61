// Each plane that holds faces is divided by its own polygons and by the traces of all others. Of a point beside a line
// of this arrangement the number of times that the faces enclose what lies above and below tells whether it belongs to
// the result's boundary: one side is enclosed, the other is not (the winding number rule; Jacobson, Kavan,
// Sorkine-Hornung 2013, for soups of triangles). Lines that part such points from others are the edges.
#include "geometry/bodies/local/untangled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/plane_polygons.h"
#include "geometry/bodies/topology/characteristics.h"
#include "geometry/curves/analytic/segment.h"

namespace lekalo::geometry {

namespace {

// Points nearer to each other than this, relative to the size, are one.
constexpr double kSame = 1e-9;
// How far beside a line its sides are looked at.
constexpr double kBeside = 1e-6;

using Line = std::pair<int, int>;

class Untangling {
 public:
  explicit Untangling(const Body& body) : old_(body), size_(bounds(body).diameter()), polygons_(polygons_of(body)) {}

  Untangled build() {
    group_planes();
    for (size_t g = 0; g < groups_.size(); ++g) collect_lines(static_cast<int>(g));
    for (size_t g = 0; g < groups_.size(); ++g) divide(groups_[g]);
    for (size_t g = 0; g < groups_.size(); ++g) classify(groups_[g]);
    if (is_unchanged()) {
      Untangled same{old_, {}, false};
      for (size_t f = 0; f < old_.faces.size(); ++f) same.faces.push_back(static_cast<int>(f));
      return same;
    }
    drop_straight_points();
    for (const Boundary& one : boundaries_) add_faces(one);
    add_shells();
    made_.changed = true;
    return std::move(made_);
  }

 private:
  // Faces in one plane, whose normals may be opposite.
  struct Group {
    Frame frame;
    std::vector<int> members;
    std::vector<char> skip;  // of all polygons: members
    std::vector<Line> lines;
  };
  // Of one group, the loops of what looks along its normal (side 1) or against it, seen against the normal of the face.
  struct Boundary {
    const Group* group;
    int side;
    std::vector<std::vector<int>> loops;
  };

  int point(const Vec3& p) {
    for (size_t k = 0; k < points_.size(); ++k)
      if (glm::length(points_[k] - p) <= kSame * size_) return static_cast<int>(k);
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  void group_planes() {
    for (size_t i = 0; i < polygons_.size(); ++i) {
      const Frame& f = polygons_[i].frame;
      auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
        return glm::length(glm::cross(g.frame.z, f.z)) < kSame &&
               std::abs(glm::dot(f.origin - g.frame.origin, g.frame.z)) <= kSame * size_;
      });
      if (same == groups_.end()) {
        groups_.push_back({f, {}, std::vector<char>(polygons_.size(), 0), {}});
        same = groups_.end() - 1;
      }
      same->members.push_back(static_cast<int>(i));
      same->skip[i] = 1;
    }
  }

  void add_line(Group& group, const Vec3& a, const Vec3& b) {
    const int from = point(a), to = point(b);
    if (from != to) group.lines.emplace_back(std::min(from, to), std::max(from, to));
  }

  void collect_lines(int g) {
    Group& group = groups_[g];
    for (size_t i = 0; i < polygons_.size(); ++i) {
      if (!group.skip[i]) {
        for (const auto& [a, b] : traces(polygons_[i], group.frame, kSame * size_)) add_line(group, a, b);
        continue;
      }
      for (const auto& loop : polygons_[i].loops)
        for (size_t k = 0; k < loop.size(); ++k) add_line(group, loop[k], loop[(k + 1) % loop.size()]);
    }
    deduplicate(group.lines);
  }

  static void deduplicate(std::vector<Line>& lines) {
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  }

  // Lines cut where they cross, or where ends of others lie on them.
  void divide(Group& group) {
    const std::vector<Line> lines = group.lines;
    std::vector<Line> parts;
    for (const auto& [a, b] : lines) {
      std::vector<std::pair<double, int>> cuts{{0, a}, {1, b}};
      const Vec3 p = points_[a], d = points_[b] - p;
      const double length = glm::length(d);
      for (const auto& [c, e] : lines) {
        for (const int end : {c, e}) {
          if (end == a || end == b) continue;
          const double t = glm::dot(points_[end] - p, d) / (length * length);
          if (t > 0 && t < 1 && glm::length(points_[end] - (p + t * d)) <= kSame * size_) cuts.emplace_back(t, end);
        }
        const Vec3 q = points_[c], f = points_[e] - q;
        const double det = glm::dot(group.frame.z, glm::cross(d, f));
        if (!(std::abs(det) > kSame * length * glm::length(f))) continue;
        const double t = glm::dot(group.frame.z, glm::cross(q - p, f)) / det;
        const double s = glm::dot(group.frame.z, glm::cross(q - p, d)) / det;
        if (t > 0 && t < 1 && s > 0 && s < 1) cuts.emplace_back(t, point(p + t * (points_[b] - points_[a])));
      }
      std::sort(cuts.begin(), cuts.end());
      for (size_t k = 0; k + 1 < cuts.size(); ++k)
        if (cuts[k].second != cuts[k + 1].second)
          parts.emplace_back(std::min(cuts[k].second, cuts[k + 1].second),
                             std::max(cuts[k].second, cuts[k + 1].second));
    }
    group.lines = parts;
    deduplicate(group.lines);
  }

  // 1, -1: the point is of the result's boundary, which looks along the normal, or against it.
  int side_at(const Group& group, const Vec3& p) {
    int own = 0;
    for (const int i : group.members) {
      const auto turns = winding(polygons_[i], p, 0);
      own += turns.value_or(0) * (glm::dot(polygons_[i].frame.z, group.frame.z) > 0 ? 1 : -1);
    }
    if (own == 0) return 0;
    const int above = enclosing(polygons_, p, group.frame.z, group.skip, size_), below = above + own;
    return (below >= 1) == (above >= 1) ? 0 : below >= 1 ? 1 : -1;
  }

  void classify(const Group& group) {
    std::array<std::vector<Line>, 2> directed;  // with the boundary on the left, seen against the group's normal
    for (const auto& [a, b] : group.lines) {
      const Vec3 middle = 0.5 * (points_[a] + points_[b]);
      const Vec3 left = glm::cross(group.frame.z, glm::normalize(points_[b] - points_[a]));
      const int l = side_at(group, middle + kBeside * size_ * left),
                r = side_at(group, middle - kBeside * size_ * left);
      if (l == r) continue;
      if (l != 0) directed[l > 0 ? 0 : 1].emplace_back(a, b);
      if (r != 0) directed[r > 0 ? 0 : 1].emplace_back(b, a);
    }
    for (const int k : {0, 1}) {
      if (directed[k].empty()) continue;
      Boundary one{&group, k == 0 ? 1 : -1, chained(directed[k], group.frame.z)};
      if (k == 1)
        for (auto& loop : one.loops) std::reverse(loop.begin(), loop.end());
      boundaries_.push_back(std::move(one));
    }
  }

  // Where loops touch, each keeps to its own side.
  std::vector<std::vector<int>> chained(std::vector<Line> lines, const Vec3& normal) const {
    std::vector<std::vector<int>> loops;
    while (!lines.empty()) {
      std::vector<int> loop{lines.front().first};
      int at = lines.front().second, before = lines.front().first;
      lines.erase(lines.begin());
      while (at != loop.front()) {
        loop.push_back(at);
        const Vec3 back = points_[before] - points_[at];
        auto best = lines.end();
        double smallest = kInfinity;
        for (auto next = lines.begin(); next != lines.end(); ++next) {
          if (next->first != at) continue;
          const Vec3 out = points_[next->second] - points_[at];
          double angle = std::atan2(glm::dot(normal, glm::cross(out, back)), glm::dot(out, back));
          if (angle <= 0) angle += kTwoPi;
          if (angle < smallest) smallest = angle, best = next;
        }
        if (best == lines.end()) throw std::invalid_argument("the boundary of a face does not close");
        before = at;
        at = best->second;
        lines.erase(best);
      }
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  // No line but the sides of the polygons, and each of these has its polygon on its left and in the result.
  bool is_unchanged() {
    for (const Group& group : groups_) {
      std::vector<Line> sides;
      for (const int i : group.members) {
        const Frame& frame = polygons_[i].frame;
        const int expected = glm::dot(frame.z, group.frame.z) > 0 ? 1 : -1;
        for (const auto& loop : polygons_[i].loops)
          for (size_t k = 0; k < loop.size(); ++k) {
            const Vec3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
            const int a = point(p), b = point(q);
            if (a == b) return false;
            sides.emplace_back(std::min(a, b), std::max(a, b));
            const Vec3 left = glm::cross(frame.z, glm::normalize(q - p));
            if (side_at(group, 0.5 * (p + q) + kBeside * size_ * left) != expected) return false;
          }
      }
      deduplicate(sides);
      if (sides != group.lines) return false;
    }
    return true;
  }

  // A point through which all loops go straight is none of the result's.
  void drop_straight_points() {
    std::vector<char> bent(points_.size(), 0);
    const auto count = [](const std::vector<int>& loop) { return loop.size(); };
    for (const Boundary& one : boundaries_)
      for (const auto& loop : one.loops)
        for (size_t k = 0; k < count(loop); ++k) {
          const Vec3 a = points_[loop[(k + count(loop) - 1) % count(loop)]], b = points_[loop[k]],
                     c = points_[loop[(k + 1) % count(loop)]];
          if (glm::length(glm::cross(glm::normalize(b - a), glm::normalize(c - b))) > 1e-9) bent[loop[k]] = 1;
        }
    for (Boundary& one : boundaries_)
      for (auto& loop : one.loops)
        loop.erase(std::remove_if(loop.begin(), loop.end(), [&](int p) { return !bent[p]; }), loop.end());
  }

  Vec3 area_of(const std::vector<int>& loop) const {
    Vec3 sum(0);
    for (size_t k = 1; k + 1 < loop.size(); ++k)
      sum += 0.5 * glm::cross(points_[loop[k]] - points_[loop[0]], points_[loop[k + 1]] - points_[loop[0]]);
    return sum;
  }

  PlanePolygon polygon_of(const Group& group, const std::vector<int>& loop) const {
    PlanePolygon polygon{group.frame, {{}}, -1};
    for (const int p : loop) polygon.loops[0].push_back(points_[p]);
    return polygon;
  }

  void add_faces(const Boundary& one) {
    const Vec3 normal = double(one.side) * one.group->frame.z;
    std::vector<std::vector<std::vector<int>>> faces;
    std::vector<std::vector<int>> holes;
    for (const auto& loop : one.loops) {
      if (glm::dot(area_of(loop), normal) > 0)
        faces.push_back({loop});
      else
        holes.push_back(loop);
    }
    for (const auto& hole : holes) {
      // The smallest around it.
      auto best = faces.end();
      double smallest = kInfinity;
      for (auto face = faces.begin(); face != faces.end(); ++face) {
        const Vec3 inside = 0.5 * (points_[hole[0]] + points_[hole[1]]);
        const double area = glm::length(area_of((*face)[0]));
        if (winding(polygon_of(*one.group, (*face)[0]), inside, 0).value_or(0) != 0 && area < smallest)
          smallest = area, best = face;
      }
      if (best == faces.end()) throw std::invalid_argument("a hole lies outside of its face");
      best->push_back(hole);
    }
    for (const auto& loops : faces) add_face(one, normal, loops);
  }

  void add_face(const Boundary& one, const Vec3& normal, const std::vector<std::vector<int>>& loops) {
    std::vector<std::vector<Body::Use>> uses;
    std::vector<CurvePtr> images;
    for (const auto& loop : loops) {
      uses.emplace_back();
      for (size_t k = 0; k < loop.size(); ++k) {
        const int a = loop[k], b = loop[(k + 1) % loop.size()];
        const int e = edge(a, b);
        images.push_back(image_in(one.group->frame, made_.body.edges[e].curve));
        uses.back().push_back({e, made_.body.edges[e].start == vertex(a), images.back()});
      }
    }
    const int source = source_of(one, normal, loops[0]);
    const int face = add_plane_face(made_.body, one.group->frame, one.side > 0, old_.faces[source].origin, images);
    for (const auto& loop : uses) made_.body.add_loop(face, loop);
    made_.faces.push_back(source);
  }

  // The face that a part of the result comes from: one that looks to its side and covers a point of it.
  int source_of(const Boundary& one, const Vec3& normal, const std::vector<int>& loop) const {
    for (size_t k = 0; k < loop.size(); ++k) {
      const Vec3 a = points_[loop[k]], b = points_[loop[(k + 1) % loop.size()]];
      const Vec3 left = glm::cross(normal, glm::normalize(b - a));
      for (const int i : one.group->members)
        if (glm::dot(polygons_[i].frame.z, normal) > 0 &&
            winding(polygons_[i], 0.5 * (a + b) + kBeside * size_ * left, 0).value_or(0) > 0)
          return polygons_[i].face;
    }
    return polygons_[one.group->members.front()].face;
  }

  int vertex(int p) {
    const auto [found, is_new] = vertices_.try_emplace(p, static_cast<int>(made_.body.vertices.size()));
    if (is_new) {
      Origin origin;
      for (const Vertex& v : old_.vertices)
        if (glm::length(v.point - points_[p]) <= kSame * size_) origin = v.origin;
      made_.body.add_vertex(points_[p], origin);
    }
    return found->second;
  }

  int edge(int a, int b) {
    const Line key(std::min(a, b), std::max(a, b));
    const auto found = edges_.find(key);
    if (found != edges_.end()) return found->second;
    const int start = vertex(key.first), end = vertex(key.second);
    const int made = made_.body.add_edge(std::make_shared<Segment>(points_[key.first], points_[key.second]), start, end,
                                         name_of(points_[key.first], points_[key.second]));
    edges_[key] = made;
    return made;
  }

  // That of the old edge on which it lies.
  Origin name_of(const Vec3& a, const Vec3& b) {
    for (const Edge& old : old_.edges) {
      const Vec3 p = old_.vertices[old.start].point, d = old_.vertices[old.end].point - p;
      const auto on = [&](const Vec3& x) {
        const double t = glm::dot(x - p, d) / glm::dot(d, d);
        return t > -kSame && t < 1 + kSame && glm::length(x - (p + t * d)) <= kSame * size_;
      };
      if (glm::dot(d, d) > 0 && on(a) && on(b)) return old.origin;
    }
    return {"", "crossing", crossings_++};
  }

  void add_shells() {
    Body& body = made_.body;
    for (const Edge& e : body.edges)
      if (e.coedges.size() != 2) throw std::invalid_argument("the body touches itself along an edge");
    divide_shells(body);
  }

  const Body& old_;
  double size_;
  std::vector<PlanePolygon> polygons_;
  std::vector<Vec3> points_;
  std::vector<Group> groups_;
  std::vector<Boundary> boundaries_;
  std::map<int, int> vertices_;
  std::map<Line, int> edges_;
  int crossings_ = 0;
  Untangled made_;
};

}  // namespace

Untangled untangled(const Body& body) { return Untangling(body).build(); }

}  // namespace lekalo::geometry
