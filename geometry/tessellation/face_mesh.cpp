// Triangles of one face of a body (Golovanov 2016, 8.7).
//
// Grid cells wholly inside the face are split by their diagonals; what is left between them and the border polygons is
// a constrained Delaunay triangulation. It works in the plane where grid lines stand at whole numbers: there cells are
// unit squares, and a distance of one is what the tolerance allows. Points are inserted where sides still deviate too
// much, never on the border, which belongs to the neighbour as well.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/tessellation/breaks.h"
#include "geometry/tessellation/face_border.h"
#include "geometry/tessellation/triangulation.h"

namespace lekalo::geometry {

namespace {

// How near to the border, in cells, the grid is used.
constexpr double kMargin = 0.3;
// Deviations that the grid's own measurement let pass need no new points.
constexpr double kWorthSplitting = 1.04;

// A vertex of the face's triangles. On a seam two of them share a mesh point.
struct FaceVertex {
  Vec2 uv;
  int32_t point = -1;
  Vec3 normal{0};
  int32_t corner = -1;  // index of its normal and parameters in the mesh, once used
  // On a pole edge the coordinate that runs along it means nothing: 0 u, 1 v, -1 no pole.
  int free_coordinate = -1;
  bool on_crease = false;
};

class FaceMesher {
 public:
  FaceMesher(const Body& body, int face, const SurfaceGrid& grid, const TessellationTolerance& tolerance,
             BodyMesh& result)
      : body_(body),
        face_(face),
        surface_(*body.faces[face].surface),
        side_(side_of(body, face)),
        grid_(grid),
        tolerance_(tolerance),
        result_(result),
        plane_(grid, surface_) {}

  void run() {
    node_vertex_.assign(grid_.points.size(), -1);
    keep_.assign(static_cast<size_t>(grid_.columns()) * grid_.rows(), 0);
    for (int loop : body_.faces[face_].loops) add_border(loop);
    if (body_.faces[face_].trimmed)
      keep_cells_inside();
    else
      keep_cells_of_rectangle();
    const size_t first = result_.mesh.triangles.size();
    emit_cells();
    const size_t band = result_.mesh.triangles.size();
    if (!sides_.empty()) fill_band();
    if (!grid_.broken.empty()) split_over_breaks(first, band);
  }

 private:
  int add_vertex(const Vec2& uv, int32_t point, const Vec3& normal) {
    FaceVertex vertex;
    vertex.uv = uv;
    vertex.point = point;
    vertex.normal = normal;
    vertices_.push_back(vertex);
    return static_cast<int>(vertices_.size()) - 1;
  }

  void add_border(int loop) {
    const std::vector<BorderPoint> border = border_of(body_, loop, side_ > 0, result_.edges);
    std::vector<int> polygon;
    for (const BorderPoint& p : border) {
      const EdgePolygon& edge = result_.edges[p.edge];
      const int vertex = add_vertex(p.uv, edge.point[p.index], Vec3(0));
      polygon.push_back(vertex);
    }
    for (size_t i = 0; i < polygon.size(); ++i) toggle_side(polygon[i], polygon[(i + 1) % polygon.size()]);
    // Points on a pole edge, its two ends included.
    std::vector<int> pole_of(polygon.size(), -1);
    for (int c : body_.loops[loop].coedges) {
      const Coedge& coedge = body_.coedges[c];
      if (body_.edges[coedge.edge].kind != EdgeKind::pole) continue;
      const int constant = constant_coordinate(*coedge.image);
      for (size_t i = 0; i < polygon.size(); ++i) {
        const size_t before = (i + polygon.size() - 1) % polygon.size();
        if (border[i].edge == coedge.edge || border[before].edge == coedge.edge)
          vertices_[polygon[i]].free_coordinate = constant < 0 ? -1 : 1 - constant;
      }
    }
    borders_.push_back(std::move(polygon));
  }

  // Directed sides with the region on their left; a side and its opposite cancel.
  void toggle_side(int a, int b) {
    if (sides_.erase({b, a}) == 0) sides_.insert({a, b});
  }

  char& keep(int i, int j) { return keep_[static_cast<size_t>(i) * grid_.rows() + j]; }

  void keep_cells_of_rectangle() {
    std::vector<BorderPoint> border;
    for (int loop : body_.faces[face_].loops) {
      const auto part = border_of(body_, loop, side_ > 0, result_.edges);
      border.insert(border.end(), part.begin(), part.end());
    }
    const std::array<bool, 4> matched = matched_sides(grid_, border);
    std::fill(keep_.begin(), keep_.end(), 1);
    for (int j = 0; j < grid_.rows(); ++j) {
      if (!matched[0]) keep(0, j) = 0;
      if (!matched[1]) keep(grid_.columns() - 1, j) = 0;
    }
    for (int i = 0; i < grid_.columns(); ++i) {
      if (!matched[2]) keep(i, 0) = 0;
      if (!matched[3]) keep(i, grid_.rows() - 1) = 0;
    }
    // Border vertices are the nodes of matched sides.
    for (const std::vector<int>& polygon : borders_)
      for (int vertex : polygon) {
        auto [i, j] = border_node(grid_, vertices_[vertex].uv);
        if (i < 0 || j < 0) continue;
        node_vertex_[grid_.node(i, j)] = vertex;
        vertices_[vertex].uv = {grid_.u[i], grid_.v[j]};
        const bool twice_u = i > 0 && grid_.u[i] == grid_.u[i - 1], twice_v = j > 0 && grid_.v[j] == grid_.v[j - 1];
        if (twice_u) node_vertex_[grid_.node(i - 1, j)] = vertex;
        if (twice_v) node_vertex_[grid_.node(i, j - 1)] = vertex;
        if (twice_u && twice_v) node_vertex_[grid_.node(i - 1, j - 1)] = vertex;
        vertices_[vertex].on_crease = twice_u || twice_v;
      }
  }

  // Cells that no border comes near to are inside or outside as a whole, together with their neighbours.
  void keep_cells_inside() {
    const int m = grid_.columns(), n = grid_.rows();
    if (m * n == 1) return;
    std::vector<char> near(keep_.size(), 0);
    for (const std::vector<int>& polygon : borders_)
      for (size_t k = 0; k < polygon.size(); ++k)
        mark_near(vertices_[polygon[k]].uv, vertices_[polygon[(k + 1) % polygon.size()]].uv, near);
    // 0 not yet known, 1 inside, 2 outside.
    std::vector<char> known(keep_.size(), 0);
    std::vector<std::array<int, 2>> front;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j) {
        const size_t at = static_cast<size_t>(i) * n + j;
        if (near[at] || known[at] || grid_.is_empty_cell(i, j)) continue;
        const Vec2 middle(0.5 * (grid_.u[i] + grid_.u[i + 1]), 0.5 * (grid_.v[j] + grid_.v[j + 1]));
        const char answer = contains(middle) ? 1 : 2;
        known[at] = answer;
        front = {{i, j}};
        while (!front.empty()) {
          const auto [x, y] = front.back();
          front.pop_back();
          for (const auto& [p, q] : {std::array{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
            if (p < 0 || q < 0 || p >= m || q >= n) continue;
            const size_t next = static_cast<size_t>(p) * n + q;
            if (near[next] || known[next]) continue;
            known[next] = answer;
            front.push_back({p, q});
          }
        }
      }
    for (size_t k = 0; k < keep_.size(); ++k) keep_[k] = known[k] == 1;
  }

  // Cells that the segment comes nearer to than the margin.
  void mark_near(const Vec2& a, const Vec2& b, std::vector<char>& near) const {
    const auto range = [](const std::vector<double>& lines, double lo, double hi) {
      const int last = static_cast<int>(lines.size()) - 2;
      const auto cell = [&](double x) {
        return std::clamp(static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin()) - 1, 0,
                          last);
      };
      // One cell more on each side: the margin is less than a cell.
      return std::array{std::max(0, cell(lo) - 1), std::min(last, cell(hi) + 1)};
    };
    const auto [i0, i1] = range(grid_.u, std::min(a.x, b.x), std::max(a.x, b.x));
    const auto [j0, j1] = range(grid_.v, std::min(a.y, b.y), std::max(a.y, b.y));
    for (int i = i0; i <= i1; ++i) {
      const double margin = kMargin * (grid_.u[i + 1] - grid_.u[i]);
      const double lo = grid_.u[i] - margin, hi = grid_.u[i + 1] + margin;
      // The part of the segment over this column.
      double s0 = 0, s1 = 1;
      const double du = b.x - a.x;
      if (du != 0) {
        const double at_lo = (lo - a.x) / du, at_hi = (hi - a.x) / du;
        s0 = std::max(s0, std::min(at_lo, at_hi));
        s1 = std::min(s1, std::max(at_lo, at_hi));
        if (s0 > s1) continue;
      } else if (a.x < lo || a.x > hi) {
        continue;
      }
      const double v0 = a.y + s0 * (b.y - a.y), v1 = a.y + s1 * (b.y - a.y);
      for (int j = j0; j <= j1; ++j) {
        const double up = kMargin * (grid_.v[j + 1] - grid_.v[j]);
        if (std::max(v0, v1) >= grid_.v[j] - up && std::min(v0, v1) <= grid_.v[j + 1] + up)
          near[static_cast<size_t>(i) * grid_.rows() + j] = 1;
      }
    }
  }

  bool contains(const Vec2& p) const {
    bool inside = false;
    for (const std::vector<int>& polygon : borders_)
      for (size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &a = vertices_[polygon[k]].uv, &b = vertices_[polygon[(k + 1) % polygon.size()]].uv;
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
      }
    return inside;
  }

  int vertex_of_node(int i, int j) {
    int& vertex = node_vertex_[grid_.node(i, j)];
    if (vertex >= 0) return vertex;
    // The two copies of a crease's node are one vertex, with a normal for each side.
    const bool first_u = i < grid_.columns() && grid_.u[i] == grid_.u[i + 1],
               first_v = j < grid_.rows() && grid_.v[j] == grid_.v[j + 1];
    if (first_u || first_v) return vertex = vertex_of_node(i + first_u, j + first_v);
    vertex = add_vertex({grid_.u[i], grid_.v[j]}, static_cast<int32_t>(result_.mesh.points.size()),
                        grid_.normals[grid_.node(i, j)]);
    result_.mesh.points.push_back(grid_.points[grid_.node(i, j)]);
    vertices_[vertex].on_crease = (i > 0 && grid_.u[i] == grid_.u[i - 1]) || (j > 0 && grid_.v[j] == grid_.v[j - 1]);
    return vertex;
  }

  void emit_cells() {
    for (int i = 0; i < grid_.columns(); ++i)
      for (int j = 0; j < grid_.rows(); ++j) {
        if (!keep(i, j) || grid_.is_empty_cell(i, j)) continue;
        const std::array<int, 4> v{vertex_of_node(i, j), vertex_of_node(i + 1, j), vertex_of_node(i + 1, j + 1),
                                   vertex_of_node(i, j + 1)};
        bool other = grid_.other_diagonal[grid_.cell(i, j)];
        const auto taken = [&](int a, int b) {
          return result_.chords.contains(vertices_[v[a]].point, vertices_[v[b]].point);
        };
        if (taken(other ? 1 : 0, other ? 3 : 2)) other = !other;
        const size_t before = result_.mesh.triangles.size();
        if (other) {
          emit({v[0], v[1], v[3]});
          emit({v[1], v[2], v[3]});
        } else {
          emit({v[0], v[1], v[2]});
          emit({v[0], v[2], v[3]});
        }
        if (grid_.is_broken(i, j))
          for (size_t k = before; k < result_.mesh.triangles.size(); ++k) over_breaks_.push_back(static_cast<int>(k));
        // The cell's outline is a hole of the band: its sides the other way round.
        for (int k = 0; k < 4; ++k) toggle_side(v[(k + 1) % 4], v[k]);
      }
  }

  Vec3 normal_at(const Vec2& uv) const { return surface_.normal(uv.x, uv.y); }

  // Index of the corner's normal and parameters.
  int32_t corner_of(int index, const std::array<int, 3>& triangle) {
    FaceVertex& vertex = vertices_[index];
    if (vertex.free_coordinate < 0 && !vertex.on_crease) {
      if (vertex.corner < 0) vertex.corner = add_corner(vertex.uv, normal_of(vertex));
      return vertex.corner;
    }
    Vec2 middle(0);
    int count = 0;
    for (int other : triangle)
      if (vertices_[other].free_coordinate < 0) middle += vertices_[other].uv, ++count;
    if (count > 0) middle /= count;
    Vec2 uv = vertex.uv;
    if (vertex.free_coordinate >= 0) {
      if (count > 0) uv[vertex.free_coordinate] = middle[vertex.free_coordinate];
      return add_corner(uv, normal_at(uv));
    }
    return add_corner(uv, normal_at(uv + 1e-7 * (middle - uv)));
  }

  int32_t add_corner(const Vec2& uv, const Vec3& normal) {
    const double sign = body_.faces[face_].forward ? 1 : -1;
    result_.mesh.normals.push_back(sign * normal);
    result_.mesh.parameters.push_back(uv);
    return static_cast<int32_t>(result_.mesh.normals.size()) - 1;
  }

  const Vec3& normal_of(FaceVertex& vertex) {
    if (vertex.normal == Vec3(0)) vertex.normal = normal_at(vertex.uv);
    return vertex.normal;
  }

  void emit(std::array<int, 3> v) {
    if (side_ < 0) std::swap(v[1], v[2]);
    Mesh::Triangle triangle;
    for (int k = 0; k < 3; ++k) triangle.point[k] = vertices_[v[k]].point;
    const auto& p = triangle.point;
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) return;  // at a pole
    for (int k = 0; k < 3; ++k) {
      triangle.normal[k] = triangle.parameter[k] = corner_of(v[k], v);
      const int32_t a = p[k], b = p[(k + 1) % 3];
      if (a < result_.border_points && b < result_.border_points && !result_.border_sides.contains(a, b))
        result_.chords.add(a, b);
    }
    triangle.face = face_;
    result_.mesh.triangles.push_back(triangle);
  }

  // Triangles of broken cells, and those of the band wherever they are.
  void split_over_breaks(size_t first, size_t band) {
    for (size_t k = band; k < result_.mesh.triangles.size(); ++k) over_breaks_.push_back(static_cast<int>(k));
    std::map<int32_t, int> poles;
    for (const FaceVertex& vertex : vertices_)
      if (vertex.free_coordinate >= 0) poles.emplace(vertex.point, vertex.free_coordinate);
    const auto is_shared = [&](int32_t a, int32_t b) { return result_.border_sides.contains(a, b); };
    const double sign = body_.faces[face_].forward ? 1 : -1;
    split_at_breaks(result_.mesh, {surface_, sign, first, over_breaks_, is_shared, poles}, tolerance_);
  }

  // What lies between the kept cells and the border.
  void fill_band() {
    Vec2 lo(kInfinity), hi(-kInfinity);
    std::vector<int> used;
    for (const auto& [a, b] : sides_) {
      lo = glm::min(lo, plane_.place(vertices_[a].uv));
      hi = glm::max(hi, plane_.place(vertices_[a].uv));
      used.push_back(a);
    }
    // The border of a face thinner than the body's tolerance lies on one line: there is nothing inside.
    if (!(lo.x < hi.x && lo.y < hi.y)) return;
    PlanarTriangulation triangulation(lo, hi);
    std::vector<int> planar(vertices_.size(), -1);
    for (int vertex : used) planar[vertex] = insert(triangulation, vertex);
    try {
      for (const auto& [a, b] : sides_) triangulation.constrain(planar[a], planar[b]);
    } catch (const std::invalid_argument& error) {
      throw CoarseBorder(error.what());
    }
    insert_free_nodes(triangulation);
    triangulation.keep_left();
    refine(triangulation);
    for (const IndexTriangle& t : triangulation.triangles())
      emit({band_vertex_[t[0]], band_vertex_[t[1]], band_vertex_[t[2]]});
  }

  // The first face vertex at a place stands for the others: a loop may touch itself.
  int insert(PlanarTriangulation& triangulation, int vertex) {
    const int index = triangulation.insert(plane_.place(vertices_[vertex].uv));
    if (index == static_cast<int>(band_vertex_.size())) band_vertex_.push_back(vertex);
    return index;
  }

  // Nodes inside the face that no kept cell uses, unless they are close to the border.
  void insert_free_nodes(PlanarTriangulation& triangulation) {
    if (grid_.columns() * grid_.rows() == 1) return;
    const bool trimmed = body_.faces[face_].trimmed;
    // Border points by cell of the line plane, to ask only those nearby.
    std::map<std::array<int, 2>, std::vector<std::array<Vec2, 2>>> nearby;
    for (const auto& [a, b] : sides_) {
      const Vec2 p = plane_.place(vertices_[a].uv), q = plane_.place(vertices_[b].uv);
      for (int x = int(std::floor(std::min(p.x, q.x) - kMargin)); x <= int(std::floor(std::max(p.x, q.x) + kMargin));
           ++x)
        for (int y = int(std::floor(std::min(p.y, q.y) - kMargin)); y <= int(std::floor(std::max(p.y, q.y) + kMargin));
             ++y)
          nearby[{x, y}].push_back({p, q});
    }
    for (int i = 1; i < grid_.columns(); ++i)
      for (int j = 1; j < grid_.rows(); ++j) {
        if (node_vertex_[grid_.node(i, j)] >= 0) continue;
        const Vec2 uv(grid_.u[i], grid_.v[j]), p = plane_.place(uv);
        if (trimmed && !contains(uv)) continue;
        const auto found = nearby.find({int(std::floor(p.x)), int(std::floor(p.y))});
        bool close = false;
        if (found != nearby.end())
          for (const auto& [a, b] : found->second) {
            const Vec2 ab = b - a;
            const double s = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
            close = close || glm::length(a + s * ab - p) < kMargin;
          }
        if (!close) insert(triangulation, vertex_of_node(i, j));
      }
  }

  // The deviation of a side's middle as a multiple of the sag; `middle` becomes its place in the parameter plane.
  double side_excess(int a, int b, Vec2& middle) {
    FaceVertex &p = vertices_[a], &q = vertices_[b];
    middle = plane_.parameters(0.5 * (plane_.place(p.uv) + plane_.place(q.uv)));
    if (p.free_coordinate >= 0 && q.free_coordinate < 0) middle[p.free_coordinate] = q.uv[p.free_coordinate];
    if (q.free_coordinate >= 0 && p.free_coordinate < 0) middle[q.free_coordinate] = p.uv[q.free_coordinate];
    const Vec3 point = surface_.point(middle.x, middle.y);
    const Vec3 chord_middle = 0.5 * (result_.mesh.points[p.point] + result_.mesh.points[q.point]);
    const Vec3 offset = point - chord_middle;
    Vec3 n = normal_of(p) + normal_of(q);
    if (p.free_coordinate >= 0 || q.free_coordinate >= 0 || p.on_crease || q.on_crease) n = normal_at(middle);
    const double length = glm::length(n);
    return (length > 0.5 ? std::abs(glm::dot(offset, n)) / length : glm::length(offset)) / tolerance_.sag_near(point);
  }

  void refine(PlanarTriangulation& triangulation) {
    const int limit = 64 + 20 * static_cast<int>(band_vertex_.size());
    Vec2 uv;
    const auto better = [&](const IndexTriangle& t, const std::array<bool, 3>& fixed, Vec2& place) {
      const std::array<int, 3> v{band_vertex_[t[0]], band_vertex_[t[1]], band_vertex_[t[2]]};
      double worst = kWorthSplitting;
      bool found = false;
      for (int k = 0; k < 3; ++k) {
        if (fixed[k]) continue;
        const int a = v[(k + 1) % 3], b = v[(k + 2) % 3];
        Vec2 middle;
        double excess = side_excess(a, b, middle);
        // What deviates where the surface breaks is split there afterwards.
        if (!grid_.broken.empty()) excess = 0;
        // The place between a pole and another vertex is not on their side in the plane: only in need.
        if (vertices_[a].free_coordinate >= 0 || vertices_[b].free_coordinate >= 0) excess *= 0.7;
        if (result_.chords.contains(vertices_[a].point, vertices_[b].point) && vertices_[a].point != vertices_[b].point)
          excess = kInfinity;
        if (excess > worst) worst = excess, uv = middle, found = true;
      }
      if (!found && grid_.broken.empty() && fixed[0] + fixed[1] + fixed[2] < 3) found = center_deviates(v, uv);
      if (found) place = plane_.place(uv);
      return found;
    };
    const auto inserted = [&](int index) {
      if (index != static_cast<int>(band_vertex_.size())) return;
      const Vec2 at = plane_.parameters(triangulation.point(index));
      band_vertex_.push_back(add_vertex(at, static_cast<int32_t>(result_.mesh.points.size()), normal_at(at)));
      result_.mesh.points.push_back(surface_.point(at.x, at.y));
    };
    triangulation.refine(better, inserted, limit);
  }

  // Sides within the tolerance may still span a hollow.
  bool center_deviates(const std::array<int, 3>& v, Vec2& uv) {
    Vec2 place(0);
    Vec3 flat(0), n(0);
    for (int each : v) {
      FaceVertex& vertex = vertices_[each];
      if (vertex.free_coordinate >= 0 || vertex.on_crease) return false;
      place += plane_.place(vertex.uv) / 3.0;
      flat += result_.mesh.points[vertex.point] / 3.0;
      n += normal_of(vertex);
    }
    uv = plane_.parameters(place);
    const Vec3 point = surface_.point(uv.x, uv.y);
    const double length = glm::length(n);
    return length > 0.5 && std::abs(glm::dot(point - flat, n)) / length > tolerance_.sag_near(point) * kWorthSplitting;
  }

  const Body& body_;
  const int face_;
  const Surface& surface_;
  const double side_;
  const SurfaceGrid& grid_;
  const TessellationTolerance& tolerance_;
  BodyMesh& result_;
  LinePlane plane_;
  std::vector<FaceVertex> vertices_;
  std::vector<int> node_vertex_;  // face vertex of each grid node, -1 where none is needed yet
  std::vector<char> keep_;        // cells that are split as they are
  std::vector<std::vector<int>> borders_;
  std::set<std::pair<int, int>> sides_;  // outline of what is left for the band
  std::vector<int> over_breaks_;         // triangles of broken cells
  std::vector<int> band_vertex_;         // face vertex of each vertex of the triangulation
};

}  // namespace

void add_face_mesh(const Body& body, int face, const SurfaceGrid& grid, const TessellationTolerance& tolerance,
                   BodyMesh& result) {
  FaceMesher(body, face, grid, tolerance, result).run();
}

}  // namespace lekalo::geometry
