// Watertight mesh of a body (Golovanov 2016, 8.8): one polygon for every edge, used by both faces.
//
// Every face first gets its own grid lines. An edge along the border of an untrimmed face takes that face's lines as
// its points; any other edge takes as many as its own curvature and the grids of both faces ask for. Then each face is
// filled: grid cells inside, a constrained triangulation between them and the border (face_mesh.cpp).
#include "geometry/tessellation/body_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/tessellation/curve_polygon.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

Rectangle grid_box(const Body& body, int face) {
  const Surface& surface = *body.faces[face].surface;
  if (!body.faces[face].trimmed) return surface.domain();
  Box3 box;
  for (int loop : body.faces[face].loops)
    for (int coedge : body.loops[loop].coedges) box.include(bounds(*body.coedges[coedge].image));
  // Boxes are a little wide; beyond a pole the surface has the opposite normal.
  const Rectangle domain = surface.domain();
  const Periods periods = surface.periods();
  Rectangle result{{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}};
  if (periods.u == 0) result.u = intersect(result.u, domain.u);
  if (periods.v == 0) result.v = intersect(result.v, domain.v);
  return result;
}

int constant_coordinate(const Curve& image) {
  const Box3 box = bounds(image);
  const Vec3 size = box.size();
  if (size.x <= 1e-9 * size.y) return 0;
  if (size.y <= 1e-9 * size.x) return 1;
  return -1;
}

double parameter_at(const Curve& image, int coordinate, double value) {
  const Interval domain = image.domain();
  double a = domain.lo, b = domain.hi;
  const double at_a = image.point(a)[coordinate], at_b = image.point(b)[coordinate];
  const double straight = a + (b - a) * (value - at_a) / (at_b - at_a);
  if (std::abs(image.point(straight)[coordinate] - value) <= 1e-13 * std::abs(at_b - at_a)) return straight;
  const bool rising = at_b > at_a;
  for (int step = 0; step < 80 && b - a > 1e-16 * domain.width(); ++step) {
    const double middle = 0.5 * (a + b);
    ((image.point(middle)[coordinate] < value) == rising ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

namespace {

// Position of a parameter among grid lines: whole numbers at the lines, linear between them.
double position(const std::vector<double>& lines, double x) {
  const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
  const auto before = after - 1;
  return static_cast<double>(before - lines.begin()) + (x - *before) / (*after - *before);
}

class BodyMesher {
 public:
  BodyMesher(const Body& body, const TessellationTolerance& tolerance) : body_(body), tolerance_(tolerance) {
    for (size_t i = 0; i < body.faces.size(); ++i)
      grids_.push_back(make_grid(*body.faces[i].surface, grid_box(body, static_cast<int>(i)), tolerance));
    share_lines(body, tolerance, grids_);
    fineness_.assign(body.edges.size(), 1.0);
  }

  Mesh run() {
    // Border polygons that cross in a parameter plane, where faces are narrower than the sag, are made finer.
    for (int attempt = 0;; ++attempt) {
      BodyMesh result;
      name_points(result);
      int face = -1;
      try {
        for (int at : order_of_faces(result)) {
          face = at;
          add_face_mesh(body_, at, grids_[at], tolerance_, result);
        }
        return std::move(result.mesh);
      } catch (const CoarseBorder&) {
        if (attempt == 12) throw;
        for (int loop : body_.faces[face].loops)
          for (int coedge : body_.loops[loop].coedges) fineness_[body_.coedges[coedge].edge] *= 0.25;
      }
    }
  }

 private:
  // Faces that take their grid as it is come first: others can still avoid a side that those use.
  std::vector<int> order_of_faces(const BodyMesh& result) const {
    std::vector<int> order;
    std::vector<char> first(body_.faces.size());
    for (size_t i = 0; i < body_.faces.size(); ++i)
      first[i] = is_all_grid(body_, static_cast<int>(i), grids_[i], result.edges);
    for (char wanted : {1, 0})
      for (size_t i = 0; i < body_.faces.size(); ++i)
        if (first[i] == wanted) order.push_back(static_cast<int>(i));
    return order;
  }

  void name_points(BodyMesh& result) {
    for (const Vertex& vertex : body_.vertices) result.mesh.points.push_back(vertex.point);
    for (size_t i = 0; i < body_.edges.size(); ++i) {
      const Edge& edge = body_.edges[i];
      EdgePolygon polygon{edge_parameters(static_cast<int>(i)), {}};
      polygon.point.assign(polygon.t.size(), edge.start);
      if (edge.kind != EdgeKind::pole) {
        polygon.point.back() = edge.end;
        for (size_t k = 1; k + 1 < polygon.t.size(); ++k) {
          polygon.point[k] = static_cast<int32_t>(result.mesh.points.size());
          result.mesh.points.push_back(edge.curve->point(polygon.t[k]));
        }
        for (size_t k = 1; k < polygon.t.size(); ++k) result.border_sides.add(polygon.point[k - 1], polygon.point[k]);
      }
      result.edges.push_back(std::move(polygon));
    }
    result.border_points = static_cast<int32_t>(result.mesh.points.size());
  }

  int face_of(const Coedge& coedge) const { return body_.loops[coedge.loop].face; }

  // Parameters of the edge where its image on an untrimmed face meets that face's lines; empty for other faces.
  std::vector<double> line_parameters(const Coedge& coedge) const {
    const int face = face_of(coedge);
    if (body_.faces[face].trimmed) return {};
    const Curve& image = *coedge.image;
    const int constant = constant_coordinate(image);
    if (constant < 0) return {};
    const int moving = 1 - constant;
    const std::vector<double>& lines = moving == 0 ? grids_[face].u : grids_[face].v;
    const Interval domain = image.domain();
    const double from = image.point(domain.lo)[moving], to = image.point(domain.hi)[moving];
    const double gap = 1e-9 * std::abs(to - from);
    std::vector<double> result{domain.lo};
    for (double line : lines)
      if (line > std::min(from, to) + gap && line < std::max(from, to) - gap &&
          (result.size() == 1 || line != last_line_))
        result.push_back(parameter_at(image, moving, last_line_ = line));
    result.push_back(domain.hi);
    std::sort(result.begin(), result.end());
    return result;
  }

  std::vector<double> edge_parameters(int index) const {
    const Edge& edge = body_.edges[index];
    TessellationTolerance tolerance = tolerance_;
    const double share = fineness_[index];
    tolerance.sag *= share;
    if (tolerance_.sag_at) tolerance.sag_at = [=, this](const Vec3& p) { return share * tolerance_.sag_at(p); };

    std::vector<double> result;
    for (int c : edge.coedges) {
      std::vector<double> lines = line_parameters(body_.coedges[c]);
      if (lines.size() > result.size()) result = std::move(lines);
    }
    const bool from_lines = !result.empty();
    if (!from_lines) {
      if (edge.kind == EdgeKind::pole) {
        result = {edge.curve->domain().lo, edge.curve->domain().hi};
      } else {
        // Triangles beside the edge add their own deviation: half is left for them.
        TessellationTolerance half = tolerance;
        half.sag *= 0.5;
        if (tolerance.sag_at) half.sag_at = [tolerance](const Vec3& p) { return 0.5 * tolerance.sag_at(p); };
        result = polygon_parameters(*edge.curve, half);
      }
    }
    std::vector<double> finer{result.front()};
    for (size_t i = 0; i + 1 < result.size(); ++i) {
      const int parts = parts_of(edge, result[i], result[i + 1], tolerance, from_lines, result.size() == 2);
      for (int k = 1; k <= parts; ++k)
        finer.push_back(k == parts ? result[i + 1] : result[i] + (result[i + 1] - result[i]) * k / parts);
    }
    return from_lines && edge.kind != EdgeKind::pole && meets_breaks(edge) ? over_breaks(edge, finer, tolerance)
                                                                           : finer;
  }

  bool meets_breaks(const Edge& edge) const {
    return std::any_of(edge.coedges.begin(), edge.coedges.end(),
                       [&](int c) { return !grids_[face_of(body_.coedges[c])].broken.empty(); });
  }

  // Where a face breaks its lines do not keep the sag: chords there are halved until they do.
  static std::vector<double> over_breaks(const Edge& edge, std::vector<double> waiting,
                                         const TessellationTolerance& tolerance) {
    const double least = kSmallestCell * (waiting.back() - waiting.front());
    std::reverse(waiting.begin(), waiting.end());
    std::vector<double> result{waiting.back()};
    waiting.pop_back();
    while (!waiting.empty()) {
      const double a = result.back(), b = waiting.back();
      if (b - a > least && chord_excess(*edge.curve, a, b, tolerance) > 1.05) {
        waiting.push_back(0.5 * (a + b));
      } else {
        result.push_back(b);
        waiting.pop_back();
      }
    }
    return result;
  }

  // Into how many parts the grids of the faces, and the edge's own sag, want a chord cut.
  int parts_of(const Edge& edge, double a, double b, const TessellationTolerance& tolerance, bool from_lines,
               bool only) const {
    double wanted = 1;
    for (int c : edge.coedges) {
      const Coedge& coedge = body_.coedges[c];
      const SurfaceGrid& grid = grids_[face_of(coedge)];
      const Vec3 from = coedge.image->point(a), to = coedge.image->point(b);
      wanted = std::max(wanted, std::abs(position(grid.u, from.x) - position(grid.u, to.x)));
      wanted = std::max(wanted, std::abs(position(grid.v, from.y) - position(grid.v, to.y)));
    }
    int parts = static_cast<int>(std::ceil(wanted - 1e-6));
    if (edge.kind == EdgeKind::pole) return parts;
    if (from_lines) {
      // Lines keep the surface's sag; the edge may bend within the surface too. Equal demands differ by rounding.
      const double excess = chord_excess(*edge.curve, a, b, tolerance);
      if (excess > 1.05) parts = std::max(parts, static_cast<int>(std::ceil(std::sqrt(excess))));
    }
    // A curved edge is never a single chord: two edges between the same vertices would fall on each other.
    if (only && parts == 1) {
      const Vec3 p = edge.curve->point(a), q = edge.curve->point(b), m = edge.curve->point(0.5 * (a + b)),
                 n = edge.curve->point(0.3 * a + 0.7 * b);
      const double length = glm::length(q - p);
      const auto off = [&](const Vec3& x) { return glm::length(glm::cross(x - p, q - p)); };
      if (!(std::max(off(m), off(n)) <= 1e-9 * length * length)) parts = 2;
    }
    return parts;
  }

  const Body& body_;
  const TessellationTolerance& tolerance_;
  std::vector<SurfaceGrid> grids_;
  std::vector<double> fineness_;
  mutable double last_line_ = 0;
};

}  // namespace

Mesh tessellate(const Body& body, const TessellationTolerance& tolerance) { return BodyMesher(body, tolerance).run(); }

}  // namespace lekalo::geometry
