#include "geometry/bodies/local/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

int neighbour_in_loop(const Body& body, int coedge, int step) {
  const std::vector<int>& loop = body.loops[body.coedges[coedge].loop].coedges;
  const auto count = static_cast<int>(loop.size());
  const auto at = static_cast<int>(std::find(loop.begin(), loop.end(), coedge) - loop.begin());
  return loop[(at + step + count) % count];
}

}  // namespace

int coedge_before(const Body& body, int coedge) { return neighbour_in_loop(body, coedge, -1); }
int coedge_after(const Body& body, int coedge) { return neighbour_in_loop(body, coedge, 1); }

int coedge_partner(const Body& body, int coedge) {
  const Edge& edge = body.edges[body.coedges[coedge].edge];
  if (edge.kind == EdgeKind::pole) return coedge;
  if (edge.coedges.size() != 2)
    throw std::invalid_argument(fmt::format("edge {} is used by {} loops", edge.origin.text(), edge.coedges.size()));
  return edge.coedges[edge.coedges[0] == coedge ? 1 : 0];
}

int vertex_before(const Body& body, int coedge) {
  const Coedge& use = body.coedges[coedge];
  return use.forward ? body.edges[use.edge].start : body.edges[use.edge].end;
}

int vertex_after(const Body& body, int coedge) {
  const Coedge& use = body.coedges[coedge];
  return use.forward ? body.edges[use.edge].end : body.edges[use.edge].start;
}

int face_of_coedge(const Body& body, int coedge) { return body.loops[body.coedges[coedge].loop].face; }

std::vector<Corner> corners_of(const Body& body, const std::vector<char>& removed) {
  const auto is_removed = [&](int coedge) { return removed[face_of_coedge(body, coedge)] != 0; };
  // Of a face that stays, along one that goes.
  const auto at_wound = [&](int coedge) { return is_removed(coedge_partner(body, coedge)); };
  std::vector<char> seen(body.coedges.size(), 0);
  std::vector<Corner> result;
  for (size_t c = 0; c < body.coedges.size(); ++c) {
    const int first = static_cast<int>(c);
    if (seen[c] || is_removed(first) || at_wound(first)) continue;
    Corner corner;
    corner.vertex = vertex_before(body, first);
    for (int out = first; !seen[out];) {
      seen[out] = 1;
      int in = coedge_before(body, out);
      while (at_wound(in)) in = coedge_before(body, in), corner.vertex = -1;
      corner.sectors.push_back({face_of_coedge(body, out), out, in});
      out = coedge_partner(body, in);
    }
    result.push_back(std::move(corner));
  }
  std::stable_sort(result.begin(), result.end(), [](const Corner& a, const Corner& b) {
    return static_cast<unsigned>(a.vertex) < static_cast<unsigned>(b.vertex);
  });
  return result;
}

}  // namespace lekalo::geometry
