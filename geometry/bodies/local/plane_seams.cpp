#include "geometry/bodies/local/plane_seams.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/support.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

class Unseaming {
 public:
  explicit Unseaming(const Body& body) : old_(body) {}

  Body build() {
    for (const Face& face : old_.faces) planes_.push_back(has_seam(face) ? plane_of(face.surface) : std::nullopt);
    if (std::none_of(planes_.begin(), planes_.end(), [](const auto& plane) { return plane.has_value(); })) return old_;
    std::vector<char> used(old_.vertices.size(), 0);
    for (const Edge& edge : old_.edges)
      if (!goes(edge)) used[edge.start] = used[edge.end] = 1;
    for (size_t v = 0; v < used.size(); ++v) {
      vertices_.push_back(used[v] ? made_.add_vertex(old_.vertices[v].point, old_.vertices[v].origin) : -1);
      if (used[v]) made_.vertices.back().tolerance = old_.vertices[v].tolerance;
    }
    for (const Edge& edge : old_.edges) {
      if (goes(edge)) {
        edges_.push_back(-1);
        continue;
      }
      edges_.push_back(made_.add_edge(edge.curve, vertices_[edge.start], vertices_[edge.end], edge.origin, edge.kind));
      made_.edges.back().tolerance = edge.tolerance;
    }
    for (size_t f = 0; f < old_.faces.size(); ++f) add_face(static_cast<int>(f));
    made_.shells = old_.shells;
    for (size_t f = 0; f < old_.faces.size(); ++f) made_.faces[f].shell = old_.faces[f].shell;
    return std::move(made_);
  }

 private:
  bool has_seam(const Face& face) const {
    for (const int l : face.loops)
      for (const int c : old_.loops[l].coedges)
        if (old_.edges[old_.coedges[c].edge].kind != EdgeKind::regular) return true;
    return false;
  }

  bool goes(const Edge& edge) const {
    return edge.kind != EdgeKind::regular && planes_[face_of_coedge(old_, edge.coedges[0])];
  }

  void add_face(int f) {
    const Face& face = old_.faces[f];
    std::vector<std::vector<Body::Use>> loops;
    for (const int l : face.loops) {
      if (planes_[f])
        split(l, *planes_[f], loops);
      else
        copy(l, loops);
    }
    if (!planes_[f]) {
      made_.add_face(face.surface, face.forward, face.origin, face.trimmed);
    } else {
      std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
        return std::abs(area_of_loop(a)) > std::abs(area_of_loop(b));
      });
      std::vector<CurvePtr> images;
      for (const auto& uses : loops)
        for (const Body::Use& u : uses) images.push_back(u.image);
      add_plane_face(made_, *planes_[f], outward_side(face) > 0, face.origin, images);
    }
    for (const auto& uses : loops) made_.add_loop(f, uses);
  }

  void copy(int l, std::vector<std::vector<Body::Use>>& loops) const {
    loops.emplace_back();
    for (const int c : old_.loops[l].coedges)
      loops.back().push_back({edges_[old_.coedges[c].edge], old_.coedges[c].forward, old_.coedges[c].image});
  }

  // What is left between the seams, joined where it goes on.
  void split(int l, const Frame& plane, std::vector<std::vector<Body::Use>>& loops) const {
    std::vector<int> left;
    for (const int c : old_.loops[l].coedges)
      if (edges_[old_.coedges[c].edge] >= 0) left.push_back(c);
    while (!left.empty()) {
      std::vector<Body::Use> uses;
      const int first = vertex_before(old_, left.front());
      int at = first;
      do {
        const auto next = std::find_if(left.begin(), left.end(), [&](int c) { return vertex_before(old_, c) == at; });
        if (next == left.end()) break;
        const Coedge& c = old_.coedges[*next];
        uses.push_back({edges_[c.edge], c.forward, image_in(plane, old_.edges[c.edge].curve)});
        at = vertex_after(old_, *next);
        left.erase(next);
      } while (at != first);
      loops.push_back(std::move(uses));
    }
  }

  const Body& old_;
  std::vector<std::optional<Frame>> planes_;  // of faces with seams
  std::vector<int> vertices_, edges_;
  Body made_;
};

}  // namespace

Body without_plane_seams(const Body& body) { return Unseaming(body).build(); }

}  // namespace lekalo::geometry
