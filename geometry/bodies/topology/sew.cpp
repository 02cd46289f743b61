#include "geometry/bodies/topology/sew.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

namespace {

class Sewing {
 public:
  Sewing(std::span<const SurfacePtr> surfaces, double tolerance, bool crowded) : crowded_(crowded) {
    Box3 box;
    for (const SurfacePtr& surface : surfaces) {
      if (!surface->bounded()) throw std::invalid_argument("an unbounded surface has no sides to sew");
      box.include(bounds(*surface));
    }
    near_ = tolerance * box.diameter();
    for (const SurfacePtr& surface : surfaces) add(surface);
    body_.close_shell(body_.is_closed());
  }
  Body take() { return std::move(body_); }

 private:
  static constexpr std::array<double, 7> kProbes{0, 0.13, 0.31, 0.5, 0.69, 0.87, 1};
  using Probes = std::array<Vec3, kProbes.size()>;

  void add(const SurfacePtr& surface) {
    const Rectangle d = surface->domain();
    const int face = body_.add_face(surface, true, {"", "face", static_cast<int>(body_.faces.size())}, false);
    // Counterclockwise: the lower side, the right one, the upper one backwards, the left one backwards.
    const Side sides[4] = {
        {0, d.v.lo, d.u, true}, {1, d.u.hi, d.v, true}, {0, d.v.hi, d.u, false}, {1, d.u.lo, d.v, false}};
    std::vector<Body::Use> uses;
    for (const Side& side : sides) uses.push_back(use(surface, face, side));
    if (surface->reversed()) {
      // The normal is the opposite one, so the face lies on the left the other way round.
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& each : uses) each.forward = !each.forward;
    }
    body_.add_loop(face, uses);
  }

  struct Side {
    int moving;
    double fixed;
    Interval range;
    bool along;
  };

  Body::Use use(const SurfacePtr& surface, int face, const Side& side) {
    const auto curve = std::make_shared<ParameterLine>(surface, side.moving == 0 ? IsoDirection::v : IsoDirection::u,
                                                       side.fixed, side.range);
    Probes probes;
    for (size_t k = 0; k < kProbes.size(); ++k)
      probes[k] = curve->point(affine_mix(1 - kProbes[k], side.range.lo, kProbes[k], side.range.hi));
    const Vec2 from = side.moving == 0 ? Vec2(side.range.lo, side.fixed) : Vec2(side.fixed, side.range.lo);
    const Vec2 to = side.moving == 0 ? Vec2(side.range.hi, side.fixed) : Vec2(side.fixed, side.range.hi);
    const bool pole = matches(probes, [&](size_t) { return probes[0]; });
    const int start = vertex(probes.front()), end = vertex(probes.back());
    const std::pair key = std::minmax(start, end);
    const auto [first, last] = edges_between_.equal_range({key.first, key.second});
    for (auto at = first; at != last && !pole; ++at) {
      const int e = at->second;
      Edge& edge = body_.edges[e];
      if (edge.kind == EdgeKind::pole || (uses_[e].size() > 1 && !crowded_)) continue;
      const Probes& other = probes_[e];
      const bool same = matches(probes, [&](size_t k) { return other[k]; });
      const bool opposite = matches(probes, [&](size_t k) { return other[kProbes.size() - 1 - k]; });
      if (!same && !opposite) continue;
      for (size_t k = 0; k < kProbes.size(); ++k)
        edge.tolerance = std::max(edge.tolerance, glm::length(probes[k] - other[same ? k : kProbes.size() - 1 - k]));
      if (uses_[e][0] == face) edge.kind = EdgeKind::seam;
      uses_[e].push_back(face);
      return {e, side.along == same, image_line(edge.curve->domain(), same ? from : to, same ? to : from)};
    }
    const int edge = body_.add_edge(curve, start, end, {}, pole ? EdgeKind::pole : EdgeKind::regular);
    edges_between_.insert({{key.first, key.second}, edge});
    probes_.push_back(probes);
    uses_.push_back({face});
    return {edge, side.along, image_line(side.range, from, to)};
  }

  template <class Other>
  bool matches(const Probes& probes, Other other) const {
    for (size_t k = 0; k < probes.size(); ++k)
      if (glm::length(probes[k] - other(k)) > near_) return false;
    return true;
  }

  int vertex(const Vec3& point) {
    for (auto at = vertices_by_x_.lower_bound(point.x - near_);
         at != vertices_by_x_.end() && at->first <= point.x + near_; ++at) {
      Vertex& vertex = body_.vertices[at->second];
      const double distance = glm::length(vertex.point - point);
      if (distance > near_) continue;
      vertex.tolerance = std::max(vertex.tolerance, distance);
      return at->second;
    }
    const int index = body_.add_vertex(point);
    vertices_by_x_.insert({point.x, index});
    return index;
  }

  Body body_;
  double near_ = 0;
  bool crowded_;
  std::vector<Probes> probes_;          // of each edge
  std::vector<std::vector<int>> uses_;  // faces of each edge
  std::multimap<std::pair<int, int>, int> edges_between_;
  std::multimap<double, int> vertices_by_x_;
};

std::string text_of(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

void check_no_opening(const Body& body) {
  int open = 0;
  const Edge* first = nullptr;
  for (const Edge& edge : body.edges) {
    if (edge.kind == EdgeKind::pole || edge.coedges.size() == 2) continue;
    if (open++ == 0) first = &edge;
  }
  if (!first) return;
  throw std::invalid_argument(fmt::format("it is open: {} of its edges {} free, one of them at {}", open,
                                          open == 1 ? "is" : "are",
                                          text_of(first->curve->point(first->curve->domain().middle()))));
}

void turn(Body& body, Face& face) {
  face.forward = !face.forward;
  for (const int loop : face.loops) {
    std::vector<int>& coedges = body.loops[loop].coedges;
    std::reverse(coedges.begin(), coedges.end());
    for (const int coedge : coedges) body.coedges[coedge].forward = !body.coedges[coedge].forward;
  }
}

// Turns faces until each edge is used once in either sense, from the first face on.
void turn_alike(Body& body) {
  std::vector<char> reached(body.faces.size(), 0);
  std::vector<int> waiting{0};
  reached[0] = 1;
  const auto face_of = [&](int coedge) { return body.loops[body.coedges[coedge].loop].face; };
  while (!waiting.empty()) {
    const int face = waiting.back();
    waiting.pop_back();
    for (const int loop : body.faces[face].loops)
      for (const int coedge : body.loops[loop].coedges) {
        const Edge& edge = body.edges[body.coedges[coedge].edge];
        if (edge.kind == EdgeKind::pole) continue;
        const int other = edge.coedges[0] == coedge ? edge.coedges[1] : edge.coedges[0];
        const bool alike = body.coedges[coedge].forward != body.coedges[other].forward;
        const int next = face_of(other);
        if (reached[next]) {
          if (!alike)
            throw std::invalid_argument("it has only one side, like a Klein bottle: see the edge at " +
                                        text_of(edge.curve->point(edge.curve->domain().middle())));
          continue;
        }
        reached[next] = 1;
        waiting.push_back(next);
        if (!alike) turn(body, body.faces[next]);
      }
  }
  if (std::find(reached.begin(), reached.end(), 0) != reached.end())
    throw std::invalid_argument("it is in several parts that do not touch along edges");
}

}  // namespace

Body enclosed_by(std::span<const SurfacePtr> surfaces, double tolerance) {
  Body body = sew(surfaces, tolerance);
  check_no_opening(body);
  turn_alike(body);
  body.shells[0].closed = true;
  // Enough to tell the sign.
  constexpr double kAccuracy = 1e-3;
  if (signed_volume(body, 0, kAccuracy) < 0)
    for (Face& face : body.faces) turn(body, face);
  return body;
}

Body sew(std::span<const SurfacePtr> surfaces, double tolerance, bool crowded) {
  return Sewing(surfaces, tolerance, crowded).take();
}

}  // namespace lekalo::geometry
