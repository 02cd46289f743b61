// Fillets taken away (Golovanov 2016, 6.12). The body's faces and edges first: a band becomes one edge, what else
// borders a band or a corner becomes a vertex. Then everything beside them is found anew, as where faces are replaced.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/fillet_chains.h"
#include "geometry/bodies/local/support.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

class Shrinking {
 public:
  Shrinking(const Body& body, const std::vector<FilletChain>& chains, const char* field)
      : old_(body), field_(field), is_gone_(body.faces.size(), 0), vertices_(body.vertices.size()) {
    std::iota(vertices_.begin(), vertices_.end(), 0);
    for (const FilletChain& chain : chains) {
      for (const int f : chain.faces) is_gone_[f] = 1;
      for (const int f : chain.corners) is_gone_[f] = 1;
    }
    for (const FilletChain& chain : chains)
      for (size_t k = 0; k < chain.faces.size(); ++k) join_borders(chain.faces[k], chain.between[k]);
    for (size_t e = 0; e < body.edges.size(); ++e) {
      if (!shrinks(static_cast<int>(e))) continue;
      join(body.edges[e].start, body.edges[e].end);
    }
  }

  FaceReplacement build() {
    add_vertices_and_edges();
    for (const Shell& shell : old_.shells) made_.shells.push_back({{}, shell.closed});
    for (size_t f = 0; f < old_.faces.size(); ++f)
      if (!is_gone_[f]) add_face(static_cast<int>(f));
    FaceReplacement result = replace_faces(made_, surfaces_, field_);
    for (int& f : result.faces) f = faces_[f];
    return result;
  }

 private:
  struct Twin {
    int edge;
    bool same;  // runs the same way
  };

  // The only coedge along which a band borders a face.
  int border(int band, int face) const {
    int found = -1, count = 0;
    for (const int l : old_.faces[band].loops)
      for (const int c : old_.loops[l].coedges)
        if (old_.edges[old_.coedges[c].edge].coedges.size() == 2 && coedge_partner(old_, c) != c &&
            face_of_coedge(old_, coedge_partner(old_, c)) == face)
          found = c, ++count;
    if (count != 1)
      throw FieldError(field_,
                       fmt::format("the fillet {} has {} edges with the face {}", name_of_face(old_, band), count,
                                   name_of_face(old_, face)),
                       "fillets that have one edge with each of the two faces beside them");
    return found;
  }

  void join_borders(int band, const std::array<int, 2>& between) {
    const Coedge& a = old_.coedges[border(band, between[0])];
    const Coedge& b = old_.coedges[border(band, between[1])];
    // The band's loops run along its borders in opposite ways.
    const bool same = a.forward != b.forward;
    twins_[b.edge] = {a.edge, same};
    is_border_[a.edge] = is_border_[b.edge] = true;
    join(old_.edges[a.edge].start, same ? old_.edges[b.edge].start : old_.edges[b.edge].end);
    join(old_.edges[a.edge].end, same ? old_.edges[b.edge].end : old_.edges[b.edge].start);
  }

  bool shrinks(int e) const {
    if (is_border_.count(e) > 0) return false;
    for (const int c : old_.edges[e].coedges)
      if (is_gone_[face_of_coedge(old_, c)]) return true;
    return false;
  }

  int root(int v) const { return vertices_[v] == v ? v : root(vertices_[v]); }
  void join(int a, int b) { vertices_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

  void add_vertices_and_edges() {
    std::map<int, int> numbers;
    const auto vertex = [&](int v) {
      const auto [found, is_new] = numbers.try_emplace(root(v), 0);
      if (is_new) found->second = made_.add_vertex(old_.vertices[root(v)].point, old_.vertices[root(v)].origin);
      return found->second;
    };
    edges_.assign(old_.edges.size(), -1);
    for (size_t e = 0; e < old_.edges.size(); ++e) {
      const Edge& edge = old_.edges[e];
      if (shrinks(static_cast<int>(e)) || twins_.count(static_cast<int>(e)) > 0) continue;
      edges_[e] = made_.add_edge(edge.curve, vertex(edge.start), vertex(edge.end),
                                 is_border_.count(static_cast<int>(e)) > 0 ? Origin{} : edge.origin, edge.kind);
      made_.edges.back().tolerance = edge.tolerance;
    }
  }

  void add_face(int f) {
    const Face& face = old_.faces[f];
    bool is_touched = false;
    std::vector<std::vector<Body::Use>> loops;
    for (const int l : face.loops) {
      loops.emplace_back();
      for (const int c : old_.loops[l].coedges) {
        const Coedge& use = old_.coedges[c];
        is_touched |= is_border_.count(use.edge) > 0 || shrinks(use.edge);
        if (shrinks(use.edge)) continue;
        loops.back().push_back(twins_.count(use.edge) > 0 ? as_twin(use)
                                                          : Body::Use{edges_[use.edge], use.forward, use.image});
      }
      if (loops.back().empty())
        throw FieldError(field_, fmt::format("nothing is left of a border of the face {}", name_of_face(old_, f)),
                         "take fewer fillets away");
    }
    // What is to be found anew has another surface before, if only in name.
    const SurfacePtr before = is_touched ? std::make_shared<TransformedSurface>(face.surface, Affine()) : face.surface;
    const int number = made_.add_face(before, face.forward, face.origin, face.trimmed);
    made_.faces[number].shell = face.shell;
    made_.shells[face.shell].faces.push_back(number);
    for (const auto& uses : loops) made_.add_loop(number, uses);
    faces_.push_back(f);
    surfaces_.push_back(face.surface);
  }

  Body::Use as_twin(const Coedge& use) const {
    const Twin& twin = twins_.at(use.edge);
    const Curve2Ptr along = twin.same ? use.image : reversed_curve(use.image);
    return {edges_[twin.edge], use.forward == twin.same, with_domain(along, old_.edges[twin.edge].curve->domain())};
  }

  const Body& old_;
  const char* field_;
  std::vector<char> is_gone_;      // of faces
  std::vector<int> vertices_;      // that become one
  std::map<int, Twin> twins_;      // borders on the second side: the border on the first
  std::map<int, bool> is_border_;  // edges along bands
  std::vector<int> edges_, faces_;
  std::vector<SurfacePtr> surfaces_;
  Body made_;
};

// Fillets along fillets go first, so that these border on faces that stay; all at once where they go round in a circle.
std::vector<std::vector<FilletChain>> outer_and_others(const std::vector<FilletChain>& chains) {
  std::vector<std::vector<FilletChain>> parts(2);
  for (const FilletChain& chain : chains) {
    const bool has_outer = std::any_of(chains.begin(), chains.end(), [&](const FilletChain& other) {
      return &other != &chain && is_along(other, chain);
    });
    parts[has_outer ? 1 : 0].push_back(chain);
  }
  if (parts[0].empty()) std::swap(parts[0], parts[1]);
  return parts;
}

// By the numbers in a body that has these faces of the old one.
std::vector<FilletChain> renumbered(std::vector<FilletChain> chains, const std::vector<int>& kept) {
  const auto renumber = [&](int& f) { f = static_cast<int>(std::find(kept.begin(), kept.end(), f) - kept.begin()); };
  for (FilletChain& chain : chains) {
    for (int& f : chain.faces) renumber(f);
    for (int& f : chain.corners) renumber(f);
    for (auto& pair : chain.between)
      for (int& f : pair) renumber(f);
  }
  return chains;
}

}  // namespace

bool is_along(const FilletChain& outer, const FilletChain& inner) {
  const auto is_inner = [&](int f) {
    return std::find(inner.faces.begin(), inner.faces.end(), f) != inner.faces.end();
  };
  return std::any_of(outer.between.begin(), outer.between.end(),
                     [&](const std::array<int, 2>& pair) { return is_inner(pair[0]) || is_inner(pair[1]); });
}

FaceReplacement without_fillets(const Body& body, const std::vector<FilletChain>& chains, const char* field) {
  const std::vector<std::vector<FilletChain>> parts = outer_and_others(chains);
  FaceReplacement made = Shrinking(body, parts[0], field).build();
  // Edges that were shorter may run the other way.
  made.turned_edges.clear();
  check_replacement(made, field, "the faces beside the fillets are continued until they meet");
  if (parts[1].empty()) return made;
  FaceReplacement rest = without_fillets(made.body, renumbered(parts[1], made.faces), field);
  for (int& f : rest.faces) f = made.faces[f];
  return rest;
}

}  // namespace lekalo::geometry
