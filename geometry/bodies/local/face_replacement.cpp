#include "geometry/bodies/local/face_replacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/crossing_faces.h"
#include "geometry/bodies/local/new_faces.h"
#include "geometry/bodies/local/support.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

namespace {

constexpr int kGuide = 8;

// Vertices of two faces alone that slide to the middle of one of their edges, because the other one would vanish.
using Sliding = std::map<int, int>;

// Points at even distances along others.
std::vector<Vec3> evenly(const std::vector<Vec3>& points, int count) {
  std::vector<double> way{0};
  for (size_t k = 1; k < points.size(); ++k) way.push_back(way.back() + glm::length(points[k] - points[k - 1]));
  std::vector<Vec3> result;
  size_t at = 1;
  for (int k = 0; k <= count; ++k) {
    const double s = way.back() * k / count;
    while (at + 1 < points.size() && way[at] < s) ++at;
    const double part = way[at] - way[at - 1];
    result.push_back(glm::mix(points[at - 1], points[at], part > 0 ? std::min(1.0, (s - way[at - 1]) / part) : 0.0));
  }
  return result;
}

class Replacing {
 public:
  Replacing(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field, bool cut_off,
            Sliding sliding = {})
      : new_(body, surfaces, field),
        old_(new_.old()),
        field_(field),
        size_(new_.size()),
        cut_off_(cut_off),
        sliding_(std::move(sliding)) {}

  FaceReplacement build() {
    made_.polyhedral = new_.are_plane();
    edges_.resize(old_.edges.size());
    joints_.resize(old_.coedges.size());
    for (const Corner& corner : corners_of(old_, new_.removed())) add_corner(corner);
    add_edges();
    add_faces();
    add_shells();
    measure_tolerances(made_.body);
    return std::move(made_);
  }

  // What may be tried where edges have turned.
  Sliding sliding() const {
    Sliding result;
    for (const Corner& corner : corners_of(old_, new_.removed())) {
      if (!new_.may_slide(corner)) continue;
      const int a = use(corner.sectors[0].in).edge, b = use(corner.sectors[1].in).edge;
      if (turned_.count(a) != turned_.count(b)) result[corner.vertex] = turned_.count(a) ? b : a;
    }
    return result;
  }

 private:
  int face_of(int coedge) const { return face_of_coedge(old_, coedge); }
  const Coedge& use(int coedge) const { return old_.coedges[coedge]; }
  struct NewEdge {
    int start = -1, end = -1;  // new vertices
  };
  // An edge to which a corner has opened.
  struct Joint {
    int from, to;    // new vertices
    int coedges[2];  // that arrive at the corner in the faces beside it
    std::vector<Vec3> guide;
    int edge = -1;  // the new edge, with its images in these faces
    Curve2Ptr images[2];
  };
  struct JointUse {
    int joint;
    int side;
    bool forward;
  };

  void add_corner(const Corner& corner) {
    const auto sliding = sliding_.find(corner.vertex);
    const CornerTree tree = sliding == sliding_.end() ? new_.tree_of(corner) : new_.tree_along(corner, sliding->second);
    std::vector<int> vertices;
    const bool one = tree.joints.empty();
    for (size_t k = 0; k < tree.points.size(); ++k) {
      Origin origin = corner.vertex >= 0 ? old_.vertices[corner.vertex].origin : Origin{};
      if (!one) origin = {};
      const bool used = !one || k == static_cast<size_t>(tree.of_spoke[0]);
      vertices.push_back(used ? made_.body.add_vertex(tree.points[k], origin) : -1);
      if (used && corner.vertex >= 0 && !new_.is_changed(corner))
        made_.body.vertices.back().tolerance = old_.vertices[corner.vertex].tolerance;
    }
    const size_t count = corner.sectors.size();
    for (size_t k = 0; k < count; ++k) {
      const Coedge& in = use(corner.sectors[k].in);
      const int vertex = vertices[tree.of_spoke[k]];
      (in.forward ? edges_[in.edge].end : edges_[in.edge].start) = vertex;
      if (old_.edges[in.edge].kind == EdgeKind::pole) edges_[in.edge] = {vertex, vertex};
    }
    const size_t first = all_joints_.size();
    for (const CornerTree::Joint& j : tree.joints)
      all_joints_.push_back({vertices[j.from],
                             vertices[j.to],
                             {corner.sectors[j.sectors[0]].in, corner.sectors[j.sectors[1]].in},
                             {tree.points[j.from], tree.points[j.to]}});
    // Along each sector's border, from the spoke after it to the one before it.
    for (size_t i = 0; i < count; ++i) {
      int at = tree.of_spoke[i];
      const int last = tree.of_spoke[(i + count - 1) % count];
      std::vector<char> used(tree.joints.size(), 0);
      while (at != last) {
        size_t k = 0;
        const auto fits = [&](const CornerTree::Joint& j) {
          return (j.sectors[0] == static_cast<int>(i) || j.sectors[1] == static_cast<int>(i)) &&
                 (j.from == at || j.to == at);
        };
        while (k < used.size() && (used[k] || !fits(tree.joints[k]))) ++k;
        if (k == used.size()) throw std::logic_error("the tree of a corner is broken");
        used[k] = 1;
        const CornerTree::Joint& j = tree.joints[k];
        const bool forward = j.from == at;
        joints_[corner.sectors[i].in].push_back(
            {static_cast<int>(first + k), j.sectors[0] == static_cast<int>(i) ? 0 : 1, forward});
        at = forward ? j.to : j.from;
      }
    }
  }

  bool is_kept(int e) const {
    const Edge& edge = old_.edges[e];
    for (const int c : edge.coedges)
      if (new_.is_changed(face_of(c))) return false;
    const Body& body = made_.body;
    return body.vertices[edges_[e].start].point == old_.vertices[edge.start].point &&
           body.vertices[edges_[e].end].point == old_.vertices[edge.end].point;
  }

  void add_edges() {
    images_.resize(old_.coedges.size());
    numbers_.assign(old_.edges.size(), -1);
    for (size_t e = 0; e < old_.edges.size(); ++e)
      if (stays(static_cast<int>(e))) add_edge(static_cast<int>(e));
    for (Joint& joint : all_joints_) add_joint(joint);
  }

  bool stays(int e) const {
    for (const int c : old_.edges[e].coedges)
      if (new_.removed()[face_of(c)]) return false;
    return true;
  }

  void add_edge(int e) {
    const Edge& old = old_.edges[e];
    const auto [start, end] = edges_[e];
    const Vec3 from = made_.body.vertices[start].point, to = made_.body.vertices[end].point;
    std::vector<Curve2Ptr> images;
    CurvePtr curve;
    bool is_old = false;
    if (old.kind == EdgeKind::pole) {
      curve = point_curve(old.curve->domain(), from);
      images = {use(old.coedges[0]).image};
    } else if (is_kept(e)) {
      curve = old.curve;
      is_old = true;
      for (const int c : old.coedges) images.push_back(kept_image(c));
    } else {
      const EdgeCurve found = curve_between(e, from, to);
      curve = found.curve;
      images = {found.images[0], found.images[1]};
      note_turn(e, *curve);
    }
    numbers_[e] = made_.body.add_edge(curve, start, end, old.origin, old.kind);
    if (is_old) made_.body.edges.back().tolerance = old.tolerance;
    for (size_t k = 0; k < old.coedges.size(); ++k) images_[old.coedges[k]] = images[k];
  }

  Curve2Ptr kept_image(int c) const {
    const int face = face_of(c);
    const bool same = dynamic_cast<const Plane*>(old_.faces[face].surface.get()) || !new_.plane(face);
    return same ? use(c).image : image_in(*new_.plane(face), old_.edges[use(c).edge].curve);
  }

  EdgeCurve curve_between(int e, const Vec3& from, const Vec3& to) const {
    const Edge& old = old_.edges[e];
    const int a = old.coedges[0], b = old.coedges[1];
    if (new_.carrier(e) >= 0)
      if (auto edge = new_.carried_edge(e, from, to)) return *edge;
    const std::vector<Vec3> guide = guide_of(e);
    std::string why;
    try {
      if (auto edge = intersection_edge({side_of(a), side_of(b)}, from, to, guide, size_)) return *edge;
    } catch (const FieldError&) {
      throw;
    } catch (const std::invalid_argument& error) {
      why = fmt::format(" ({})", error.what());
    }
    throw FieldError(field_,
                     fmt::format("the faces {} and {} do not meet along an edge any more{}",
                                 name_of_face(old_, face_of(a)), name_of_face(old_, face_of(b)), why),
                     "a smaller change, or one of the neighbours too");
  }

  EdgeSide side_of(int c) const {
    EdgeSide side = new_.side_of(c);
    const Edge& edge = old_.edges[use(c).edge];
    for (int k = 0; k < 2; ++k) {
      const auto sliding = sliding_.find(k == 0 ? edge.start : edge.end);
      if (sliding != sliding_.end()) side.near[k] = new_.near_middle(face_of(c), sliding->second);
    }
    return side;
  }

  // Where the edge was; of one with a vertex that slides from or to there.
  std::vector<Vec3> guide_of(int e) const {
    const Edge& edge = old_.edges[e];
    std::vector<Vec3> points;
    const auto add = [&](int of, double from, double to) {
      const Interval t = old_.edges[of].curve->domain();
      for (int k = 0; k <= kGuide; ++k)
        points.push_back(old_.edges[of].curve->point(t.lo + t.width() * (from + (to - from) * k / kGuide)));
    };
    const auto start = sliding_.find(edge.start), end = sliding_.find(edge.end);
    const bool from = start != sliding_.end(), to = end != sliding_.end();
    if (from && start->second != e) add(start->second, 0.5, old_.edges[start->second].start == edge.start ? 0 : 1);
    add(e, from && start->second == e ? 0.5 : 0, to && end->second == e ? 0.5 : 1);
    if (to && end->second != e) add(end->second, old_.edges[end->second].start == edge.end ? 0 : 1, 0.5);
    return from || to ? evenly(points, kGuide) : points;
  }

  void note_turn(int e, const Curve& curve) {
    const std::vector<Vec3> old = guide_of(e);
    const Vec3 before = old[kGuide / 2] - old[0],
               after = curve.point(curve.domain().middle()) - curve.point(curve.domain().lo);
    if (!(glm::dot(before, after) > 0)) {
      turned_.insert(e);
      const std::string name = old_.edges[e].origin.text();
      made_.turned_edges.push_back(name.empty() ? std::to_string(e) : name);
    }
  }

  void add_joint(Joint& joint) {
    std::array<EdgeSide, 2> sides;
    for (int k = 0; k < 2; ++k) {
      const int c = joint.coedges[k];
      const Vec2 at = new_.near(c, true);
      sides[k] = {new_.support(face_of(c)), new_.plane(face_of(c)), {at, at}};
    }
    const auto edge = intersection_edge(sides, joint.guide[0], joint.guide[1], joint.guide, size_);
    if (!edge)
      throw FieldError(
          field_,
          fmt::format("the faces {} and {} do not meet along an edge", name_of_face(old_, face_of(joint.coedges[0])),
                      name_of_face(old_, face_of(joint.coedges[1]))),
          "a smaller change");
    joint.edge = made_.body.add_edge(edge->curve, joint.from, joint.to, {"", "joint", joints_made_++});
    for (int k = 0; k < 2; ++k) joint.images[k] = edge->images[k];
  }

  void add_faces() {
    for (size_t f = 0; f < old_.faces.size(); ++f)
      if (!new_.removed()[f]) add_face(static_cast<int>(f));
  }

  void add_face(int f) {
    const Face& old = old_.faces[f];
    std::vector<std::vector<Body::Use>> loops;
    bool same = !new_.is_changed(f);
    for (size_t l = 0; l < old.loops.size(); ++l) {
      std::vector<Body::Use> uses;
      for (const int c : old_.loops[old.loops[l]].coedges) {
        const int e = use(c).edge;
        if (numbers_[e] < 0) continue;
        uses.push_back({numbers_[e], use(c).forward, images_[c]});
        same = same && images_[c] == use(c).image;
        for (const JointUse& j : joints_[c]) {
          const Joint& joint = all_joints_[j.joint];
          uses.push_back({joint.edge, j.forward, joint.images[j.side]});
          same = false;
        }
      }
      if (uses.empty()) {
        if (l == 0 && !cut_off_)
          throw FieldError(field_, fmt::format("the face {} is left without its outer border", name_of_face(old_, f)),
                           "take it away too");
        continue;
      }
      loops.push_back(std::move(uses));
    }
    const int face =
        same ? made_.body.add_face(old.surface, old.forward, old.origin, old.trimmed) : add_face_on(f, loops);
    for (const std::vector<Body::Use>& uses : loops) made_.body.add_loop(face, uses);
    made_.faces.push_back(f);
    made_.changed.push_back(!same);
    if (cut_off_) turn_to_loop(face);
  }

  // The face lies to the left of its loop.
  void turn_to_loop(int f) {
    Face& face = made_.body.faces[f];
    std::vector<Body::Use> uses;
    for (const int c : made_.body.loops[face.loops[0]].coedges) {
      const Coedge& u = made_.body.coedges[c];
      uses.push_back({u.edge, u.forward, u.image});
    }
    face.forward = (area_of_loop(uses) > 0) == (face.surface->normal_sign() > 0);
  }

  int add_face_on(int f, const std::vector<std::vector<Body::Use>>& loops) {
    const Face& old = old_.faces[f];
    std::vector<CurvePtr> images;
    Box3 box;
    for (const auto& uses : loops)
      for (const Body::Use& u : uses) images.push_back(u.image), box.include(bounds(*u.image));
    // Rounding of the boxes of images is not to move a border.
    const bool untrimmed = !old.trimmed && loops.size() == 1 && fills(loops[0], box);
    if (new_.plane(f)) {
      if (!untrimmed) {
        const int face = add_plane_face(made_.body, *new_.plane(f), old.forward, old.origin, images);
        return turned_as(face, old);
      }
      return turned_as(
          made_.body.add_face(std::make_shared<Plane>(*new_.plane(f), rectangle(box)), old.forward, old.origin, false),
          old);
    }
    const Rectangle d = new_.support(f)->domain();
    SurfacePtr surface = new_.support(f);
    snap(box.lo.x, d.u), snap(box.hi.x, d.u), snap(box.lo.y, d.v), snap(box.hi.y, d.v);
    const Rectangle asked = untrimmed ? rectangle(box) : widened(d, box, surface->periods());
    if (!(asked.u == d.u && asked.v == d.v)) {
      try {
        surface = extended_to(surface, asked);
      } catch (const FieldError&) {
        throw;
      } catch (const std::invalid_argument& error) {
        throw FieldError(field_,
                         fmt::format("the face {} cannot be continued: {}", name_of_face(old_, f), error.what()),
                         "a smaller change");
      }
    }
    return made_.body.add_face(surface, old.forward, old.origin, !untrimmed);
  }

  // A surface keeps its side; the plane that stands for one of another kind has it by its frame.
  int turned_as(int face, const Face& old) {
    if (!old.surface->reversed()) return face;
    auto plane = std::make_shared<Plane>(*dynamic_cast<const Plane*>(made_.body.faces[face].surface.get()));
    plane->set_reversed(true);
    made_.body.faces[face].surface = plane;
    return face;
  }

  static void snap(double& x, const Interval& own) {
    for (const double border : {own.lo, own.hi})
      if (std::abs(x - border) <= 1e-12 * own.width()) x = border;
  }

  static Rectangle rectangle(const Box3& box) { return {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}}; }

  // Whether a loop runs along the border of its box.
  static bool fills(const std::vector<Body::Use>& uses, const Box3& box) {
    const Vec3 size = box.size();
    for (const Body::Use& u : uses) {
      const Interval t = u.image->domain();
      bool on_side[4] = {true, true, true, true};
      for (int k = 0; k <= 4; ++k) {
        const Vec3 p = u.image->point(t.lo + t.width() * k / 4);
        on_side[0] = on_side[0] && p.x - box.lo.x <= 1e-13 * size.x;
        on_side[1] = on_side[1] && box.hi.x - p.x <= 1e-13 * size.x;
        on_side[2] = on_side[2] && p.y - box.lo.y <= 1e-13 * size.y;
        on_side[3] = on_side[3] && box.hi.y - p.y <= 1e-13 * size.y;
      }
      if (!(on_side[0] || on_side[1] || on_side[2] || on_side[3])) return false;
    }
    return true;
  }

  static Rectangle widened(const Rectangle& d, const Box3& box, const Periods& periods) {
    const auto along = [](const Interval& own, double lo, double hi, double period) {
      if (own.lo <= lo && hi <= own.hi) return own;
      if (period > 0 && hi - lo >= period * (1 - 1e-9)) return Interval(lo, lo + period);
      const double more = 0.02 * (hi - lo);
      const Interval wide(lo < own.lo ? lo - more : own.lo, hi > own.hi ? hi + more : own.hi);
      // What goes over the end of a whole turn needs another one.
      if (period > 0 && wide.width() > period) return Interval(0.5 * (lo + hi - period), 0.5 * (lo + hi + period));
      return wide;
    };
    return {along(d.u, box.lo.x, box.hi.x, periods.u), along(d.v, box.lo.y, box.hi.y, periods.v)};
  }

  void add_shells() {
    Body& body = made_.body;
    for (const Shell& old : old_.shells) {
      Shell shell{{}, true};
      for (size_t f = 0; f < made_.faces.size(); ++f)
        if (std::find(old.faces.begin(), old.faces.end(), made_.faces[f]) != old.faces.end()) {
          body.faces[f].shell = static_cast<int>(body.shells.size());
          shell.faces.push_back(static_cast<int>(f));
        }
      if (!shell.faces.empty()) body.shells.push_back(std::move(shell));
    }
  }

  const NewFaces new_;
  const Body& old_;
  const char* field_;
  double size_;
  bool cut_off_;
  Sliding sliding_;
  std::set<int> turned_;                       // edges
  std::vector<NewEdge> edges_;                 // of each old edge
  std::vector<std::vector<JointUse>> joints_;  // that follow each old coedge in its loop
  std::vector<Joint> all_joints_;
  std::vector<Curve2Ptr> images_;  // of each old coedge
  std::vector<int> numbers_;       // of each old edge, its new number
  int joints_made_ = 0;
  FaceReplacement made_;
};

}  // namespace

FaceReplacement replace_faces(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field,
                              bool cut_off) {
  Replacing replacing(body, surfaces, field, cut_off);
  FaceReplacement made = replacing.build();
  if (made.turned_edges.empty()) return made;
  const Sliding sliding = replacing.sliding();
  if (sliding.empty()) return made;
  FaceReplacement slid = Replacing(body, surfaces, field, cut_off, sliding).build();
  return slid.turned_edges.empty() ? slid : made;
}

void check_replacement(const FaceReplacement& made, const char* field, const char* hint) {
  if (!made.turned_edges.empty())
    throw FieldError(
        field,
        fmt::format("the edge {} vanishes: the faces at its ends run into each other", made.turned_edges.front()),
        hint);
  const std::vector<Violation> found = made.body.violations();
  if (!found.empty())
    throw FieldError(
        field,
        fmt::format("the faces make no body: not met is '{}' ({})", found.front().condition, found.front().entity),
        hint);
  const auto is_changed = [&](int f) { return !made.changed.empty() && made.changed[f]; };
  if (const auto pair = crossing_faces(made.body, is_changed))
    throw FieldError(field,
                     fmt::format("the faces {} and {} run into each other", name_of_face(made.body, pair->first),
                                 name_of_face(made.body, pair->second)),
                     hint);
}

}  // namespace lekalo::geometry
