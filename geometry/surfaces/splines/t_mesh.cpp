#include "geometry/surfaces/splines/t_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "geometry/describe.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

std::string words(const std::vector<Vec2>& vertices, int i) {
  return fmt::format("vertex {} at ({:.6g}, {:.6g})", i, vertices[i].x, vertices[i].y);
}

// Coordinates closer than kSameKnot of their range become equal.
void join_equal(std::vector<Vec2>& vertices, int axis) {
  std::vector<size_t> order(vertices.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return vertices[a][axis] < vertices[b][axis]; });
  const double near = kSameKnot * (vertices[order.back()][axis] - vertices[order.front()][axis]);
  for (size_t k = 1; k < order.size(); ++k) {
    double& own = vertices[order[k]][axis];
    const double before = vertices[order[k - 1]][axis];
    if (own - before <= near) own = before;
  }
}

// The edges of one line between two vertices, cut at the vertices on it.
void add_line(const std::vector<Vec2>& vertices, int from, int to, std::set<std::array<int, 2>>& edges) {
  const Vec2 a = vertices[from], b = vertices[to];
  const bool along_u = a.y == b.y;
  if (along_u == (a.x == b.x))
    throw FieldError(
        "lines",
        fmt::format("the line from {} to {} is not parallel to an axis", words(vertices, from), words(vertices, to)),
        "neighbours of a line have the same u or the same v");
  const int axis = along_u ? 0 : 1;
  const double lo = std::min(a[axis], b[axis]), hi = std::max(a[axis], b[axis]);
  std::vector<int> on;
  for (size_t i = 0; i < vertices.size(); ++i)
    if (vertices[i][1 - axis] == a[1 - axis] && vertices[i][axis] >= lo && vertices[i][axis] <= hi)
      on.push_back(static_cast<int>(i));
  std::sort(on.begin(), on.end(), [&](int i, int j) { return vertices[i][axis] < vertices[j][axis]; });
  for (size_t k = 1; k < on.size(); ++k) edges.insert({on[k - 1], on[k]});
}

enum Side { kRight, kLeft, kUp, kDown };

// Neighbours of each vertex by side, -1 where there is none.
std::vector<std::array<int, 4>> neighbours(const TMesh& mesh) {
  std::vector<std::array<int, 4>> of(mesh.vertices.size(), {-1, -1, -1, -1});
  for (const auto& [a, b] : mesh.edges) {
    const bool along_u = mesh.vertices[a].y == mesh.vertices[b].y;
    of[a][along_u ? kRight : kUp] = b;
    of[b][along_u ? kLeft : kDown] = a;
  }
  return of;
}

struct MeshBox {
  Vec2 lo{kInfinity}, hi{-kInfinity};
  bool at_end(const Vec2& p, int side) const {
    return side == kRight ? p.x == hi.x : side == kLeft ? p.x == lo.x : side == kUp ? p.y == hi.y : p.y == lo.y;
  }
};

// A closed direction has no ends.
MeshBox box_of(const TMesh& mesh) {
  MeshBox box;
  for (const Vec2& p : mesh.vertices) box.lo = glm::min(box.lo, p), box.hi = glm::max(box.hi, p);
  if (mesh.periods.u > 0) box.lo.x = -kInfinity, box.hi.x = kInfinity;
  if (mesh.periods.v > 0) box.lo.y = -kInfinity, box.hi.y = kInfinity;
  return box;
}

void check_crossings(const TMesh& mesh) {
  const auto& at = mesh.vertices;
  for (const auto& [a, b] : mesh.edges) {
    if (a >= mesh.count || at[a].y != at[b].y) continue;
    for (const auto& [c, d] : mesh.edges)
      if (at[c].x == at[d].x && at[a].x < at[c].x && at[c].x < at[b].x && at[c].y < at[a].y && at[a].y < at[d].y)
        throw FieldError("lines",
                         fmt::format("lines cross at ({:.6g}, {:.6g}), where there is no vertex", at[c].x, at[a].y),
                         "every meeting of lines is a vertex with a control point");
  }
}

void check_vertices(const TMesh& mesh, const std::vector<std::array<int, 4>>& beside) {
  constexpr const char* kNames[] = {"right", "left", "upper", "lower"};
  const MeshBox box = box_of(mesh);
  for (int i = 0; i < mesh.count; ++i) {
    const auto k = static_cast<size_t>(i);
    const Vec2& p = mesh.vertices[k];
    const auto& own = beside[k];
    if (std::all_of(own.begin(), own.end(), [](int j) { return j < 0; }))
      throw FieldError("at", fmt::format("{} is on no line", words(mesh.vertices, i)), "name it in one of the lines");
    for (const int side : {kRight, kLeft, kUp, kDown}) {
      const bool border = box.at_end(p, side);
      // Along a border the edges go on to its ends.
      for (const int along : {kRight, kLeft, kUp, kDown})
        if (border && (along < kUp) != (side < kUp) && !box.at_end(p, along) && own[along] < 0)
          throw FieldError("lines",
                           fmt::format("the {} border has a gap beside {}", kNames[side], words(mesh.vertices, i)),
                           "the outline of the mesh is a rectangle of lines");
    }
    const bool inside_u = !box.at_end(p, kRight) && !box.at_end(p, kLeft),
               inside_v = !box.at_end(p, kUp) && !box.at_end(p, kDown);
    const bool through_u = own[kRight] >= 0 && own[kLeft] >= 0, through_v = own[kUp] >= 0 && own[kDown] >= 0;
    if (inside_u && inside_v && !through_u && !through_v)
      throw FieldError(
          "lines",
          fmt::format("at {} a line ends or turns: the cells there are not rectangles", words(mesh.vertices, i)),
          "carry the line on to the next one across");
  }
}

void check_connected(const TMesh& mesh, const std::vector<std::array<int, 4>>& beside) {
  std::vector<bool> reached(mesh.vertices.size(), false);
  std::vector<int> open{0};
  reached[0] = true;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    for (const int j : beside[i])
      if (j >= 0 && !reached[j]) reached[j] = true, open.push_back(j);
  }
  for (size_t i = 0; i < static_cast<size_t>(mesh.count); ++i)
    if (!reached[i])
      throw FieldError("lines",
                       fmt::format("{} and {} are not joined by lines", words(mesh.vertices, 0),
                                   words(mesh.vertices, static_cast<int>(i))),
                       "the mesh is one rectangle cut into rectangles");
}

// Parameters of the edges across the line through p along the axis, on one side, from p on.
std::vector<double> met(const TMesh& mesh, const Vec2& p, int axis, double sign) {
  std::set<double> places;
  for (const auto& [a, b] : mesh.edges) {
    const Vec2 &from = mesh.vertices[a], &to = mesh.vertices[b];
    if (from[axis] == to[axis] && from[1 - axis] <= p[1 - axis] && p[1 - axis] <= to[1 - axis] &&
        sign * (from[axis] - p[axis]) > 0)
      places.insert(sign * from[axis]);
  }
  std::vector<double> result(places.begin(), places.end());
  for (double& x : result) x *= sign;
  return result;
}

// Vertices that face each other across a cell (Sederberg et al. 2003, rule 2).
void check_facing(const TMesh& mesh, const std::vector<std::array<int, 4>>& beside) {
  const MeshBox box = box_of(mesh);
  for (size_t i = 0; i < static_cast<size_t>(mesh.count); ++i)
    for (const int side : {kRight, kUp}) {
      const Vec2& p = mesh.vertices[i];
      if (beside[i][side] >= 0 || box.at_end(p, side)) continue;
      const int axis = side == kRight ? 0 : 1;
      const std::vector<double> across = met(mesh, p, axis, 1);
      if (across.empty()) continue;
      Vec2 facing = p;
      facing[axis] = across.front();
      const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), facing);
      if (found != mesh.vertices.end())
        throw FieldError(
            "lines",
            fmt::format("{} and {} face each other across a cell", words(mesh.vertices, static_cast<int>(i)),
                        words(mesh.vertices, static_cast<int>(found - mesh.vertices.begin()))),
            "join them by a line");
    }
}

std::vector<double> knots_along(const TMesh& mesh, const Vec2& p, int axis, int degree) {
  const size_t half = (degree + 1) / 2;
  std::vector<double> knots;
  for (const double sign : {-1.0, 1.0}) {
    std::vector<double> beside = met(mesh, p, axis, sign);
    beside.insert(beside.end(), half, beside.empty() ? p[axis] : beside.back());
    beside.resize(half);
    if (sign < 0) std::reverse(beside.begin(), beside.end());
    knots.insert(knots.end(), beside.begin(), beside.end());
    if (sign < 0) knots.push_back(p[axis]);
  }
  return knots;
}

// So many periods to both sides hold all knots of functions of degree 7 in a direction in which every period has a
// line.
constexpr int kPeriodsBeside = 4;

// How often the mesh is repeated, the mesh itself first.
std::vector<std::array<int, 2>> shifts_of(const Periods& periods) {
  const int u = periods.u > 0 ? kPeriodsBeside : 0, v = periods.v > 0 ? kPeriodsBeside : 0;
  std::vector<std::array<int, 2>> shifts{{0, 0}};
  for (int i = -u; i <= u; ++i)
    for (int j = -v; j <= v; ++j)
      if (i != 0 || j != 0) shifts.push_back({i, j});
  return shifts;
}

void check_periods(const std::vector<Vec2>& vertices, const Periods& periods) {
  Vec2 lo(kInfinity), hi(-kInfinity);
  for (const Vec2& p : vertices) lo = glm::min(lo, p), hi = glm::max(hi, p);
  for (const int axis : {0, 1}) {
    const double period = axis == 0 ? periods.u : periods.v;
    if (period > 0 && !(hi[axis] - lo[axis] < period))
      throw FieldError(
          "period",
          fmt::format("the vertices go from {} = {:.6g} to {:.6g}, as far as a period of {:.6g}, or farther",
                      axis == 0 ? "u" : "v", lo[axis], hi[axis], period),
          "vertices of a closed mesh are not repeated at its end");
  }
}

// Where the line from vertex a to b of one period ends: over the seam if b is not beyond a.
std::array<int, 2> periods_passed(const TMesh& mesh, int a, int b) {
  const Vec2 &from = mesh.vertices[a], &to = mesh.vertices[b];
  const bool over_u = mesh.periods.u > 0 && from.y == to.y && to.x <= from.x,
             over_v = mesh.periods.v > 0 && from.x == to.x && to.y <= from.y;
  if (over_u && over_v)
    throw FieldError("lines", fmt::format("a line joins {} to itself", words(mesh.vertices, a)),
                     "a line round a mesh that is closed in both directions has two vertices at least");
  return {over_u, over_v};
}

void add_lines(const TMesh& mesh, const std::vector<std::vector<int>>& lines, std::set<std::array<int, 2>>& edges) {
  const std::vector<std::array<int, 2>> shifts = shifts_of(mesh.periods);
  // A vertex moved by periods, -1 beyond all that are repeated.
  const auto moved = [&](int vertex, const std::array<int, 2>& by) {
    const std::array<int, 2>& own = shifts[static_cast<size_t>(vertex / mesh.count)];
    const auto found = std::find(shifts.begin(), shifts.end(), std::array{own[0] + by[0], own[1] + by[1]});
    return found == shifts.end() ? -1 : static_cast<int>(found - shifts.begin()) * mesh.count + vertex % mesh.count;
  };
  std::set<std::array<int, 2>> own;
  for (const std::vector<int>& line : lines)
    for (size_t j = 1; j < line.size(); ++j)
      add_line(mesh.vertices, line[j - 1], moved(line[j], periods_passed(mesh, line[j - 1], line[j])), own);
  for (const std::array<int, 2>& shift : shifts)
    for (const auto& [a, b] : own)
      if (const int from = moved(a, shift), to = moved(b, shift); from >= 0 && to >= 0) edges.insert({from, to});
}

}  // namespace

TMesh t_mesh(const std::vector<Vec3>& at, const std::vector<std::vector<int>>& lines, const Periods& periods) {
  TMesh mesh;
  mesh.count = static_cast<int>(at.size());
  mesh.periods = periods;
  const int least = periods.u > 0 || periods.v > 0 ? 2 : 4;
  if (mesh.count < least)
    throw FieldError("at", fmt::format("a mesh has {} vertices at least, not {}", least, at.size()));
  for (const Vec3& p : at) mesh.vertices.emplace_back(p);
  join_equal(mesh.vertices, 0);
  join_equal(mesh.vertices, 1);
  for (size_t i = 0; i < at.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (mesh.vertices[i] == mesh.vertices[j])
        throw FieldError("at", fmt::format("vertices {} and {} are both at ({:.6g}, {:.6g})", j, i, at[i].x, at[i].y));
  for (size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].size() < 2) throw FieldError("lines", fmt::format("line {} joins less than two vertices", k));
    for (const int i : lines[k])
      if (i < 0 || i >= mesh.count)
        throw FieldError("lines", fmt::format("line {} names vertex {}, but there are 0 to {}", k, i, at.size() - 1));
  }
  check_periods(mesh.vertices, periods);
  for (const auto& [i, j] : shifts_of(periods))
    for (int k = 0; k < mesh.count && (i != 0 || j != 0); ++k)
      mesh.vertices.push_back(mesh.vertices[static_cast<size_t>(k)] + Vec2(i * periods.u, j * periods.v));
  std::set<std::array<int, 2>> edges;
  add_lines(mesh, lines, edges);
  mesh.edges.assign(edges.begin(), edges.end());
  const auto beside = neighbours(mesh);
  check_crossings(mesh);
  check_vertices(mesh, beside);
  check_connected(mesh, beside);
  check_facing(mesh, beside);
  return mesh;
}

std::vector<std::array<int, 2>> TMesh::own_edges() const {
  std::vector<std::array<int, 2>> result;
  for (const auto& [a, b] : edges)
    if (a < count) result.push_back({a, b % count});
  return result;
}

std::vector<LocalKnots> inferred_knots(const TMesh& mesh, int degree) {
  std::vector<LocalKnots> all;
  for (int i = 0; i < mesh.count; ++i) {
    const Vec2& p = mesh.vertices[static_cast<size_t>(i)];
    all.push_back({knots_along(mesh, p, 0, degree), knots_along(mesh, p, 1, degree)});
  }
  return all;
}

}  // namespace lekalo::geometry
