#include "geometry/bodies/topology/characteristics.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

namespace {

// Disjoint sets of numbers.
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

int face_of(const Body& body, int coedge) { return body.loops[body.coedges[coedge].loop].face; }

Sets connected_faces(const Body& body) {
  Sets sets(body.faces.size());
  for (const Edge& edge : body.edges)
    for (const int coedge : edge.coedges) sets.join(face_of(body, edge.coedges[0]), face_of(body, coedge));
  return sets;
}

// Faces are turned one after another; a contradiction is a shell with one side.
bool is_orientable(const Body& body, const std::set<int>& faces) {
  std::map<int, bool> turned{{*faces.begin(), false}};
  std::vector<int> waiting{*faces.begin()};
  while (!waiting.empty()) {
    const int face = waiting.back();
    waiting.pop_back();
    for (const int loop : body.faces[face].loops)
      for (const int coedge : body.loops[loop].coedges) {
        const Edge& edge = body.edges[body.coedges[coedge].edge];
        if (edge.kind == EdgeKind::pole || edge.coedges.size() != 2) continue;
        const int other = edge.coedges[0] == coedge ? edge.coedges[1] : edge.coedges[0], next = face_of(body, other);
        const bool alike = body.coedges[coedge].forward != body.coedges[other].forward;
        const bool wanted = turned[face] != !alike;
        const auto [found, is_new] = turned.try_emplace(next, wanted);
        if (is_new) waiting.push_back(next);
        if (found->second != wanted) return false;
      }
  }
  return true;
}

int borders_of(const Body& body, const std::vector<int>& edges) {
  Sets ends(body.vertices.size());
  std::set<int> used;
  for (const int e : edges) {
    const Edge& edge = body.edges[e];
    if (edge.coedges.size() != 1) continue;
    ends.join(edge.start, edge.end);
    used.insert({edge.start, edge.end});
  }
  return static_cast<int>(std::count_if(used.begin(), used.end(), [&](int v) { return ends.find(v) == v; }));
}

// The shell alone as a body, for its volume.
double volume_of(const Body& body, const std::set<int>& faces) {
  Body one = body;
  one.shells = {Shell{{faces.begin(), faces.end()}, true}};
  return signed_volume(one, 0, kMeasureAccuracy);
}

ShellCharacteristics of_faces(const Body& body, const std::set<int>& faces, const NonManifold& bad) {
  ShellCharacteristics result;
  result.faces = static_cast<int>(faces.size());
  std::vector<int> edges;
  std::set<int> vertices;
  for (size_t e = 0; e < body.edges.size(); ++e) {
    const Edge& edge = body.edges[e];
    if (edge.coedges.empty() || !faces.count(face_of(body, edge.coedges[0]))) continue;
    vertices.insert({edge.start, edge.end});
    if (edge.kind != EdgeKind::pole) edges.push_back(static_cast<int>(e));
  }
  for (const int face : faces) result.loops += static_cast<int>(body.faces[face].loops.size());
  result.edges = static_cast<int>(edges.size());
  result.vertices = static_cast<int>(vertices.size());
  result.euler_characteristic = result.faces - result.edges + result.vertices + (result.faces - result.loops);
  result.borders = borders_of(body, edges);
  result.orientable = is_orientable(body, faces);
  for (const int e : edges) result.manifold = result.manifold && !std::count(bad.edges.begin(), bad.edges.end(), e);
  for (const int v : vertices)
    result.manifold = result.manifold && !std::count(bad.vertices.begin(), bad.vertices.end(), v);
  if (!result.manifold) return result;
  const bool closed = result.borders == 0;
  result.connectivity = (closed ? 3 : 2) - result.euler_characteristic;
  if (closed && result.orientable) {
    result.genus = 1 - result.euler_characteristic / 2;
    result.volume = volume_of(body, faces);
  }
  return result;
}

int end_vertex(const Body& body, int coedge, bool last) {
  const Coedge& use = body.coedges[coedge];
  return use.forward == last ? body.edges[use.edge].end : body.edges[use.edge].start;
}

}  // namespace

std::vector<ShellCharacteristics> characteristics(const Body& body) {
  const Sets sets = connected_faces(body);
  std::map<int, std::set<int>> parts;
  for (size_t f = 0; f < body.faces.size(); ++f) parts[sets.find(static_cast<int>(f))].insert(static_cast<int>(f));
  const NonManifold bad = non_manifold_places(body);
  std::vector<ShellCharacteristics> result;
  for (const auto& [first, faces] : parts) result.push_back(of_faces(body, faces, bad));
  return result;
}

NonManifold non_manifold_places(const Body& body) {
  NonManifold result;
  for (size_t e = 0; e < body.edges.size(); ++e)
    if (body.edges[e].kind != EdgeKind::pole && body.edges[e].coedges.size() > 2)
      result.edges.push_back(static_cast<int>(e));
  // Corners of faces at a vertex are joined where they share the end of an edge.
  std::vector<std::vector<std::pair<int, int>>> corners(body.vertices.size());
  for (const Loop& loop : body.loops)
    for (size_t i = 0; i < loop.coedges.size(); ++i) {
      const int arriving = loop.coedges[i], leaving = loop.coedges[(i + 1) % loop.coedges.size()];
      corners[end_vertex(body, arriving, true)].push_back({arriving, leaving});
    }
  for (size_t v = 0; v < corners.size(); ++v) {
    Sets fans(corners[v].size());
    std::map<std::pair<int, bool>, int> ends;  // (edge, at its start)
    for (size_t i = 0; i < corners[v].size(); ++i) {
      const Coedge &in = body.coedges[corners[v][i].first], &out = body.coedges[corners[v][i].second];
      for (auto end : {std::pair{in.edge, !in.forward}, std::pair{out.edge, out.forward}}) {
        // A pole edge ends twice in one point.
        if (body.edges[end.first].kind == EdgeKind::pole) end.second = false;
        const auto [found, is_new] = ends.try_emplace(end, static_cast<int>(i));
        if (!is_new) fans.join(found->second, static_cast<int>(i));
      }
    }
    int count = 0;
    for (size_t i = 0; i < corners[v].size(); ++i) count += fans.find(static_cast<int>(i)) == static_cast<int>(i);
    if (count > 1) result.vertices.push_back(static_cast<int>(v));
  }
  return result;
}

void divide_shells(Body& body) {
  Sets sets(body.faces.size());
  for (const Edge& edge : body.edges)
    for (const int c : edge.coedges)
      sets.join(body.loops[body.coedges[c].loop].face, body.loops[body.coedges[edge.coedges.front()].loop].face);
  std::map<int, int> shell_of;
  body.shells.clear();
  for (int f = 0; f < static_cast<int>(body.faces.size()); ++f) {
    const auto [found, is_new] = shell_of.try_emplace(sets.find(f), static_cast<int>(body.shells.size()));
    if (is_new) body.shells.push_back({{}, true});
    body.faces[f].shell = found->second;
    body.shells[found->second].faces.push_back(f);
  }
}

}  // namespace lekalo::geometry
