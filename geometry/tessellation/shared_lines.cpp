// Common grid lines of faces that meet along whole sides.
//
// Two untrimmed faces with an edge along a whole side of each can take the same points there as grid lines; then
// neither needs a band of other triangles beside it. Such sides tie the lines of a direction of one face to those of
// the other, and so on around rings of faces: each class of tied directions gets one set of lines, as dense everywhere
// as the densest of its members.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/tessellation/body_mesh.h"

namespace lekalo::geometry {

namespace {

// A direction of a face: 2 face + (0 along u, 1 along v), and whether it runs against its class.
struct Member {
  int direction;
  bool reversed;
};

class LineClasses {
 public:
  LineClasses(const Body& body, const std::vector<SurfaceGrid>& grids) : body_(body), grids_(grids) {
    parent_.resize(2 * body.faces.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    against_.assign(parent_.size(), 0);
    for (const Edge& edge : body.edges)
      if (edge.coedges.size() == 2 && edge.kind != EdgeKind::pole) tie(edge);
  }

  std::vector<std::vector<Member>> classes() {
    std::vector<std::vector<Member>> result(parent_.size());
    for (int i = 0; i < static_cast<int>(parent_.size()); ++i) {
      const auto [root, reversed] = find(i);
      result[root].push_back({i, reversed});
    }
    std::erase_if(result, [](const auto& members) { return members.size() < 2; });
    return result;
  }

 private:
  struct Side {
    int direction = -1;  // -1: the edge does not run evenly along a whole side
    bool reversed = false;
  };

  Side side_of(const Coedge& coedge) const {
    const int face = body_.loops[coedge.loop].face;
    const int constant = constant_coordinate(*coedge.image);
    if (body_.faces[face].trimmed || constant < 0) return {};
    const int moving = 1 - constant;
    const std::vector<double>& lines = moving == 0 ? grids_[face].u : grids_[face].v;
    const Interval t = coedge.image->domain();
    const double from = coedge.image->point(t.lo)[moving], to = coedge.image->point(t.hi)[moving];
    const double width = lines.back() - lines.front(), gap = 1e-9 * width;
    const bool whole =
        std::abs(std::min(from, to) - lines.front()) <= gap && std::abs(std::max(from, to) - lines.back()) <= gap;
    const double third = coedge.image->point(t.lo + t.width() / 3)[moving];
    const bool even = std::abs(third - (from + (to - from) / 3)) <= gap;
    if (!whole || !even) return {};
    return {2 * face + moving, to < from};
  }

  void tie(const Edge& edge) {
    const Side a = side_of(body_.coedges[edge.coedges[0]]), b = side_of(body_.coedges[edge.coedges[1]]);
    if (a.direction < 0 || b.direction < 0) return;
    const auto [root_a, against_a] = find(a.direction);
    const auto [root_b, against_b] = find(b.direction);
    // Rings that come back reversed (a Moebius strip) stay as they are.
    if (root_a == root_b) return;
    parent_[root_a] = root_b;
    against_[root_a] = (a.reversed != b.reversed) != (against_a != against_b);
  }

  std::pair<int, bool> find(int i) const {
    bool against = false;
    while (parent_[i] != i) {
      against = against != static_cast<bool>(against_[i]);
      i = parent_[i];
    }
    return {i, against};
  }

  const Body& body_;
  const std::vector<SurfaceGrid>& grids_;
  std::vector<int> parent_;
  std::vector<char> against_;  // runs against its parent
};

// Lines as parts of the whole, 0 to 1, in the direction of the class; a crease's two copies stay together.
std::vector<double> parts_of(const std::vector<double>& lines, bool reversed) {
  std::vector<double> result;
  for (double x : lines) {
    const double part = (x - lines.front()) / (lines.back() - lines.front());
    result.push_back(reversed ? 1 - part : part);
  }
  if (reversed) std::reverse(result.begin(), result.end());
  return result;
}

std::vector<double> common_lines(const std::vector<std::vector<double>>& members) {
  std::vector<double> at, creases{0, 1};
  for (const auto& lines : members) {
    at.insert(at.end(), lines.begin(), lines.end());
    for (size_t i = 1; i < lines.size(); ++i)
      if (lines[i] == lines[i - 1]) creases.push_back(lines[i]);
  }
  const auto unique = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    std::vector<double> result;
    for (double x : values)
      if (result.empty() || x > result.back() + 1e-9) result.push_back(x);
    result.back() = values.back();
    values = std::move(result);
  };
  unique(at);
  unique(creases);
  std::vector<double> density(at.size() - 1, 0.0);
  for (const auto& lines : members) {
    size_t k = 0;
    for (size_t i = 0; i + 1 < at.size(); ++i) {
      const double middle = 0.5 * (at[i] + at[i + 1]);
      while (k + 2 < lines.size() && lines[k + 1] < middle) ++k;
      if (lines[k + 1] > lines[k]) density[i] = std::max(density[i], 1 / (lines[k + 1] - lines[k]));
    }
  }
  std::vector<double> result{0};
  for (size_t c = 0; c + 1 < creases.size(); ++c) {
    LineDensity section;
    for (size_t i = 0; i + 1 < at.size(); ++i) {
      if (at[i + 1] <= creases[c] + 1e-9 || at[i] >= creases[c + 1] - 1e-9) continue;
      if (section.at.empty()) section.at.push_back(creases[c]);
      section.at.push_back(std::min(at[i + 1], creases[c + 1]));
      section.value.push_back(density[i]);
    }
    if (section.value.empty()) continue;
    section.at.back() = creases[c + 1];
    const std::vector<double> lines = section.lines();
    result.insert(result.end(), lines.begin() + 1, lines.end());
  }
  return result;
}

// Parts back in the member's own parameters, its creases doubled.
std::vector<double> own_lines(std::vector<double> parts, bool reversed, const std::vector<double>& before) {
  if (reversed) {
    std::reverse(parts.begin(), parts.end());
    for (double& x : parts) x = 1 - x;
  }
  const double lo = before.front(), hi = before.back(), gap = 1e-8 * (hi - lo);
  std::vector<double> result;
  for (double part : parts) {
    double x = part <= 0 ? lo : part >= 1 ? hi : lo + part * (hi - lo);
    // Where a line was, it is again, to the last digit; creases stand where the surface has them.
    const auto near = std::lower_bound(before.begin(), before.end(), x - gap);
    if (near != before.end() && std::abs(*near - x) <= gap) x = *near;
    result.push_back(x);
    if (std::count(before.begin(), before.end(), x) == 2) result.push_back(x);
  }
  return result;
}

}  // namespace

void share_lines(const Body& body, const TessellationTolerance& tolerance, std::vector<SurfaceGrid>& grids) {
  std::vector<std::vector<double>> lines(2 * grids.size());
  std::vector<char> changed(grids.size(), 0);
  for (const std::vector<Member>& members : LineClasses(body, grids).classes()) {
    std::vector<std::vector<double>> parts;
    for (const Member& member : members) {
      const SurfaceGrid& grid = grids[member.direction / 2];
      parts.push_back(parts_of(member.direction % 2 == 0 ? grid.u : grid.v, member.reversed));
    }
    const std::vector<double> common = common_lines(parts);
    for (const Member& member : members) {
      const SurfaceGrid& grid = grids[member.direction / 2];
      const std::vector<double>& before = member.direction % 2 == 0 ? grid.u : grid.v;
      std::vector<double> after = own_lines(common, member.reversed, before);
      if (after == before) continue;
      changed[member.direction / 2] = 1;
      lines[member.direction] = std::move(after);
    }
  }
  for (size_t face = 0; face < grids.size(); ++face) {
    if (!changed[face]) continue;
    std::vector<double> u = lines[2 * face].empty() ? grids[face].u : lines[2 * face];
    std::vector<double> v = lines[2 * face + 1].empty() ? grids[face].v : lines[2 * face + 1];
    grids[face] = grid_on(*body.faces[face].surface, std::move(u), std::move(v), tolerance);
  }
}

}  // namespace lekalo::geometry
