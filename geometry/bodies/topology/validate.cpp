// The conditions of a valid body (Golovanov 2016, 5.1, 5.3, 5.5), each by name. Intersections of faces away from their
// edges are not looked for.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/bodies/topology/characteristics.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/body.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

namespace {

// Room for rounding in evaluations that should agree, relative to the body's size (several hundred ulps, because
// parametrisations by angle lose some).
constexpr double kRounding = 1e-12;
// The same in a parameter plane, relative to the face's loops.
constexpr double kParameterRounding = 1e-9;
// Samples of every smooth piece of an edge.
constexpr int kSamples = 8;

std::vector<double> samples(const Curve& curve, int count = kSamples) {
  std::vector<double> result{curve.domain().lo};
  for (const CurvePiece& piece : curve.pieces())
    for (int k = 1; k <= count; ++k) result.push_back(piece.domain.lo + piece.domain.width() * k / count);
  result.back() = curve.domain().hi;
  return result;
}

// For a polygon: fewer of each piece where these are many.
std::vector<double> polygon_samples(const Curve& curve, int count) {
  constexpr int kPieces = 4, kMinPoints = 2;  // as many points as that many pieces have
  const int pieces = static_cast<int>(curve.pieces().size());
  return samples(curve, std::clamp(kPieces * count / pieces, std::min(kMinPoints, count), count));
}

// Whether a curve is short beside its bend: its chord stands for it.
bool is_nearly_straight(const Curve& curve, const std::vector<double>& ts) {
  constexpr double kBend = 0.05;
  const Vec3 begin = curve.point(ts.front()), chord = curve.point(ts.back()) - begin;
  const double square = glm::dot(chord, chord);
  return std::all_of(ts.begin(), ts.end(), [&](double t) {
    const Vec3 off = curve.point(t) - begin;
    return glm::length(glm::cross(off, chord)) <= kBend * square && glm::dot(off, chord) >= 0;
  });
}

// Of parameters in order those that are farther than a length from both ends, and where the curve is that far for the
// first and the last time. Where it is nowhere much farther the ends alone, or all if the curve bends between them.
std::vector<double> beyond_ends(const Curve& curve, const std::vector<double>& ts, double length) {
  const auto is_beyond = [&](double t, double end) { return glm::length(curve.point(t) - curve.point(end)) >= length; };
  const auto border = [&](double near, double far, double end) {
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (near + far);
      (is_beyond(middle, end) ? far : near) = middle;
    }
    return far;
  };
  const auto is_near_begin = [&](double t) { return !is_beyond(t, ts.front()); };
  const auto is_near_end = [&](double t) { return !is_beyond(t, ts.back()); };
  const auto first = std::find_if_not(ts.begin(), ts.end(), is_near_begin);
  const auto last = std::find_if_not(ts.rbegin(), ts.rend(), is_near_end);
  if (first == ts.end() || last == ts.rend() || !(*first < *last))
    return is_nearly_straight(curve, ts) ? std::vector<double>{ts.front(), ts.back()} : ts;
  std::vector<double> result{ts.front(), border(*(first - 1), *first, ts.front())};
  for (auto at = first; *at <= *last; ++at)
    if (*at > result.back()) result.push_back(*at);
  const double end = border(*(last - 1), *last, ts.back());
  if (end > result.back()) result.push_back(end);
  result.push_back(ts.back());
  return result;
}

double longest_side(const std::vector<Vec2>& polygon) {
  double result = 0;
  for (size_t i = 0; i < polygon.size(); ++i)
    result = std::max(result, glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]));
  return result;
}

class Validation {
 public:
  explicit Validation(const Body& body) : body_(body) {}

  std::vector<Violation> run() {
    check_links();
    // The other conditions are meaningless while links lead nowhere.
    if (!found_.empty()) return std::move(found_);
    size_ = bounds(body_).diameter();
    for (size_t i = 0; i < body_.edges.size(); ++i) check_edge(static_cast<int>(i));
    for (size_t i = 0; i < body_.loops.size(); ++i) check_loop(static_cast<int>(i));
    for (size_t i = 0; i < body_.faces.size(); ++i) check_face(static_cast<int>(i));
    check_vertices();
    if (found_.empty()) check_shells();
    return std::move(found_);
  }

 private:
  void report(std::string condition, std::string entity) {
    found_.push_back({std::move(condition), std::move(entity)});
  }
  std::string edge_name(int edge) const { return entity_name("edge", edge, body_.edges[edge].origin); }
  std::string face_name(int face) const { return entity_name("face", face, body_.faces[face].origin); }
  static std::string entity_name(const char* kind, int index, const Origin& origin) {
    const std::string text = origin.text();
    return text.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} {} ({})", kind, index, text);
  }

  void check_links() {
    const auto valid = [](int index, size_t count) { return index >= 0 && static_cast<size_t>(index) < count; };
    for (size_t i = 0; i < body_.edges.size(); ++i) {
      const Edge& edge = body_.edges[i];
      if (!edge.curve) report("an edge has a curve", edge_name(i));
      if (!valid(edge.start, body_.vertices.size()) || !valid(edge.end, body_.vertices.size()))
        report("an edge runs between vertices", edge_name(i));
      for (int coedge : edge.coedges)
        if (!valid(coedge, body_.coedges.size()) || body_.coedges[coedge].edge != static_cast<int>(i))
          report("an edge and its coedges name each other", edge_name(i));
    }
    for (size_t i = 0; i < body_.coedges.size(); ++i) {
      const Coedge& coedge = body_.coedges[i];
      const std::string name = fmt::format("coedge {}", i);
      if (!valid(coedge.edge, body_.edges.size()) || !valid(coedge.loop, body_.loops.size()))
        report("a coedge belongs to an edge and a loop", name);
      else if (!coedge.image)
        report("a coedge has an image in its face's parameter plane", name);
      else if (std::count(body_.edges[coedge.edge].coedges.begin(), body_.edges[coedge.edge].coedges.end(),
                          static_cast<int>(i)) != 1)
        report("an edge and its coedges name each other", name);
    }
    for (size_t i = 0; i < body_.loops.size(); ++i) {
      const Loop& loop = body_.loops[i];
      const std::string name = fmt::format("loop {}", i);
      if (!valid(loop.face, body_.faces.size())) report("a loop belongs to a face", name);
      if (loop.coedges.empty()) report("a loop has coedges", name);
      for (int coedge : loop.coedges)
        if (!valid(coedge, body_.coedges.size()) || body_.coedges[coedge].loop != static_cast<int>(i))
          report("a loop and its coedges name each other", name);
    }
    for (size_t i = 0; i < body_.faces.size(); ++i) {
      const Face& face = body_.faces[i];
      if (!face.surface) report("a face has a surface", face_name(i));
      if (face.loops.empty()) report("a face has loops", face_name(i));
      for (int loop : face.loops)
        if (!valid(loop, body_.loops.size()) || body_.loops[loop].face != static_cast<int>(i))
          report("a face and its loops name each other", face_name(i));
      if (!valid(face.shell, body_.shells.size())) report("a face belongs to a shell", face_name(i));
    }
  }

  double edge_tolerance(const Edge& edge) const { return edge.tolerance + kRounding * size_; }

  void check_edge(int index) {
    const Edge& edge = body_.edges[index];
    const Interval domain = edge.curve->domain();
    if (!(domain.lo > -kInfinity && domain.hi < kInfinity)) {
      report("an edge is bounded", edge_name(index));
      return;
    }
    const Vertex &start = body_.vertices[edge.start], &end = body_.vertices[edge.end];
    if (glm::length(edge.curve->point(domain.lo) - start.point) > edge_tolerance(edge) + start.tolerance ||
        glm::length(edge.curve->point(domain.hi) - end.point) > edge_tolerance(edge) + end.tolerance)
      report("an edge's curve ends at its vertices", edge_name(index));
    for (int coedge : edge.coedges) check_coincidence(index, body_.coedges[coedge]);
    check_uses(index);
  }

  void check_coincidence(int index, const Coedge& coedge) {
    const Edge& edge = body_.edges[index];
    const Interval domain = edge.curve->domain(), image = coedge.image->domain();
    if (std::abs(image.lo - domain.lo) + std::abs(image.hi - domain.hi) > kParameterRounding * domain.width()) {
      report("an edge's image runs over the edge's own parameters", edge_name(index));
      return;
    }
    const int face = body_.loops[coedge.loop].face;
    double worst = 0;
    for (double t : samples(*edge.curve)) {
      const Vec3 uv = coedge.image->point(t);
      worst = std::max(worst, glm::length(body_.faces[face].surface->point(uv.x, uv.y) - edge.curve->point(t)));
    }
    if (!(worst <= edge_tolerance(edge)))
      report(fmt::format("an edge's curve and its image on the face coincide (they are {:.3g} apart)", worst),
             fmt::format("{} on {}", edge_name(index), face_name(face)));
  }

  void check_uses(int index) {
    const Edge& edge = body_.edges[index];
    const size_t uses = edge.coedges.size();
    if (edge.kind == EdgeKind::pole) {
      if (uses != 1) report("a pole edge is used once", edge_name(index));
      if (bounds(*edge.curve).diameter() > edge_tolerance(edge) + 4 * kRounding * size_)
        report("a pole edge has no length", edge_name(index));
      return;
    }
    if (uses > 2) report("at most two faces meet in an edge", edge_name(index));
    if (uses == 0) report("an edge belongs to a face", edge_name(index));
    if (uses != 2) {
      const bool closed = uses == 1 && shell_of(edge.coedges[0]).closed;
      if (closed) report("an edge of a closed shell is used twice", edge_name(index));
      return;
    }
    const Coedge &a = body_.coedges[edge.coedges[0]], &b = body_.coedges[edge.coedges[1]];
    if (a.forward == b.forward)
      report("two faces run along their common edge in opposite directions", edge_name(index));
    if ((edge.kind == EdgeKind::seam) != (body_.loops[a.loop].face == body_.loops[b.loop].face))
      report("a seam edge is used twice by one face", edge_name(index));
  }

  const Shell& shell_of(int coedge) const {
    return body_.shells[body_.faces[body_.loops[body_.coedges[coedge].loop].face].shell];
  }
  int first_vertex(const Coedge& coedge) const {
    return coedge.forward ? body_.edges[coedge.edge].start : body_.edges[coedge.edge].end;
  }
  int last_vertex(const Coedge& coedge) const {
    return coedge.forward ? body_.edges[coedge.edge].end : body_.edges[coedge.edge].start;
  }
  static Vec2 image_end(const Coedge& coedge, bool last) {
    const Interval domain = coedge.image->domain();
    return Vec2(coedge.image->point(coedge.forward == last ? domain.hi : domain.lo));
  }

  // Images of vertices in the loops of one face: those of one point, which may be several vertices, in one place are
  // equal but for rounding.
  using Corners = std::vector<std::pair<int, Vec2>>;
  Vec2 corner(int vertex, const Vec2& at, double near, Corners& known) const {
    const auto are_one = [&](int a, int b) {
      return a == b || glm::length(body_.vertices[a].point - body_.vertices[b].point) <= kRounding * size_;
    };
    for (const auto& [of, place] : known)
      if (are_one(of, vertex) && glm::length(place - at) <= near) return place;
    known.emplace_back(vertex, at);
    return at;
  }

  // The loop as a polygon in the parameter plane, if asked with first sides of one length beside its vertices.
  std::vector<Vec2> polygon(int loop, int count = kSamples, double first_side = 0, Corners* corners = nullptr) const {
    std::vector<Vec2> result;
    for (int index : body_.loops[loop].coedges) {
      const Coedge& coedge = body_.coedges[index];
      std::vector<double> ts = polygon_samples(*coedge.image, count);
      if (first_side > 0) ts = beyond_ends(*coedge.image, ts, first_side);
      if (!coedge.forward) std::reverse(ts.begin(), ts.end());
      ts.pop_back();
      const size_t begin = result.size();
      for (double t : ts) result.push_back(Vec2(coedge.image->point(t)));
      if (corners)
        result[begin] = corner(first_vertex(coedge), result[begin],
                               kParameterRounding * bounds(*coedge.image).diameter(), *corners);
    }
    return result;
  }

  void check_loop(int index) {
    const Loop& loop = body_.loops[index];
    const std::string name = fmt::format("loop {} of {}", index, face_name(loop.face));
    Box3 box;
    for (int coedge : loop.coedges) box.include(bounds(*body_.coedges[coedge].image));
    const double small = kParameterRounding * box.diameter();
    for (size_t i = 0; i < loop.coedges.size(); ++i) {
      const Coedge& here = body_.coedges[loop.coedges[i]];
      const Coedge& next = body_.coedges[loop.coedges[(i + 1) % loop.coedges.size()]];
      if (last_vertex(here) != first_vertex(next))
        report("each coedge of a loop begins at the vertex where the one before ends", name);
      if (glm::length(image_end(here, true) - image_end(next, false)) > small)
        report("the images of a loop's coedges join in the parameter plane", name);
    }
  }

  static double signed_area(const std::vector<Vec2>& polygon) {
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
  }

  static bool contains(const std::vector<Vec2>& polygon, const Vec2& p) {
    bool inside = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
    }
    return inside;
  }

  void check_face(int index) {
    const Face& face = body_.faces[index];
    // Interaction against the surface's parametric normal r_u x r_v.
    const double side = outward_side(face);
    const std::vector<Vec2> outer = polygon(face.loops[0]);
    if (!(side * signed_area(outer) > 0)) report("an outer loop has its face on the left", face_name(index));
    std::vector<std::vector<Vec2>> holes;
    for (size_t k = 1; k < face.loops.size(); ++k) holes.push_back(polygon(face.loops[k]));
    for (const std::vector<Vec2>& hole : holes) {
      if (!(side * signed_area(hole) < 0)) report("an inner loop has its face on the left", face_name(index));
      if (!contains(outer, hole[0])) report("inner loops lie within the outer loop", face_name(index));
      for (const std::vector<Vec2>& other : holes)
        if (&other != &hole && std::all_of(hole.begin(), hole.end(), [&](const Vec2& p) { return contains(other, p); }))
          report("no inner loop lies within another", face_name(index));
    }
    if (loops_cross(face, side)) report("the loops of a face do not cross", face_name(index));
  }

  // Polygons of neighbouring loops may cross where the curves do not: finer ones decide. Beside a vertex in which loops
  // touch, with one tangent, even those of any length do unless their first sides are of one length.
  bool loops_cross(const Face& face, double side) const {
    for (const int count : {kSamples, 8 * kSamples, 64 * kSamples}) {
      if (!polygons_cross(face, side, count, 0)) return false;
      double longest = 0;
      for (const int loop : face.loops) longest = std::max(longest, longest_side(polygon(loop, count)));
      if (!polygons_cross(face, side, count, 4 * longest)) return false;
    }
    return true;
  }

  // Polygons that cross unnoticed leave triangles of another area than they enclose.
  bool polygons_cross(const Face& face, double side, int count, double first_side) const {
    std::vector<Vec2> points;
    std::vector<std::vector<int>> polygons;
    double area = 0, all = 0;
    Corners corners;
    for (const int loop : face.loops) {
      polygons.emplace_back();
      const std::vector<Vec2> border = polygon(loop, count, first_side, &corners);
      area += side * signed_area(border);
      all += std::abs(signed_area(border));
      for (const Vec2& p : border) {
        polygons.back().push_back(static_cast<int>(points.size()));
        points.push_back(p);
      }
      if (side < 0) std::reverse(polygons.back().begin(), polygons.back().end());
    }
    try {
      for (const IndexTriangle& t : triangulate(points, polygons))
        area -= signed_area({points[t[0]], points[t[1]], points[t[2]]});
      return std::abs(area) > kParameterRounding * all;
    } catch (const std::invalid_argument&) {
      return true;
    }
  }

  void check_vertices() {
    std::vector<char> used(body_.vertices.size(), 0);
    for (const Coedge& coedge : body_.coedges) used[first_vertex(coedge)] = used[last_vertex(coedge)] = 1;
    const auto name = [&](int v) { return entity_name("vertex", v, body_.vertices[v].origin); };
    for (size_t v = 0; v < used.size(); ++v)
      if (!used[v]) report("a vertex belongs to an edge", name(static_cast<int>(v)));
    for (const int v : non_manifold_places(body_).vertices) report("the faces around a vertex form one fan", name(v));
  }

  void check_shells() {
    const bool all_closed =
        std::all_of(body_.shells.begin(), body_.shells.end(), [](const Shell& shell) { return shell.closed; });
    if (body_.shells.empty()) report("a body has a shell", "body");
    if (all_closed && !body_.shells.empty() && !looks_outward())
      report("the faces of the outer shell look outward", "body");
  }

  // By the first and last face along a line; by the volume, which takes long, where lines are not to be trusted.
  bool looks_outward() const {
    if (found_.empty()) {
      constexpr size_t kMaxEdges = 8;
      constexpr double kSteep = 0.1, kThrough = 1e-3;  // of the size: a line that only grazes an edge tells nothing
      const LineIntersector lines(body_);
      for (size_t e = 0; e < std::min(kMaxEdges, body_.edges.size()); ++e)
        for (const Vec3& way : {Vec3(0.48, 0.6, 0.64), Vec3(-0.64, 0.48, 0.6), Vec3(0.6, -0.64, 0.48)}) {
          const Interval t = body_.edges[e].curve->domain();
          const std::vector<SurfaceHit> hits = lines.all_hits({body_.edges[e].curve->point(t.middle()), way});
          if (hits.size() < 2 || hits.back().t - hits.front().t < kThrough * size_) continue;
          const auto slope = [&](const SurfaceHit& hit) { return glm::dot(body_.normal(hit.face, hit.u, hit.v), way); };
          const double first = slope(hits.front()), last = slope(hits.back());
          if (std::min(std::abs(first), std::abs(last)) > kSteep && (first > 0) != (last > 0)) return last > 0;
        }
    }
    double volume = 0;
    for (size_t i = 0; i < body_.shells.size(); ++i)
      volume = std::max(volume, signed_volume(body_, static_cast<int>(i), 1e-3));
    return volume > 0;
  }

  const Body& body_;
  double size_ = 0;
  std::vector<Violation> found_;
};

}  // namespace

std::vector<Violation> Body::violations() const { return Validation(*this).run(); }

}  // namespace lekalo::geometry
