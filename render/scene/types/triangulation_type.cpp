// The scene type of planar triangulations (Golovanov 2016, 8.6).
#include <fmt/format.h>

#include "geometry/describe.h"
#include "geometry/mesh.h"
#include "geometry/tessellation/planar_triangulations.h"

namespace lekalo::render {

using namespace geometry;

namespace {

std::vector<Vec2> plane_points(const Fields& f) {
  const std::vector<Vec3>& points = f.points("points");
  std::vector<Vec2> result;
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].z != points[0].z)
      throw FieldError("points", fmt::format("point {} does not lie at the height of point 0", i),
                       "the points lie in the plane x, y, or in one parallel to it");
    result.emplace_back(points[i].x, points[i].y);
  }
  return result;
}

std::vector<std::vector<int>> polygons_of(const Fields& f, size_t count) {
  const std::vector<std::vector<int>> polygons =
      f.has("polygons") ? f.get<std::vector<std::vector<int>>>("polygons") : std::vector<std::vector<int>>();
  for (size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i].size() < 3) throw FieldError("polygons", fmt::format("polygon {} has less than three corners", i));
    for (const int corner : polygons[i])
      if (corner < 0 || corner >= static_cast<int>(count))
        throw FieldError("polygons", fmt::format("polygon {} names point {}; there are points 0 to {}", i, corner,
                                                 static_cast<int>(count) - 1));
  }
  return polygons;
}

std::vector<IndexTriangle> triangles_of(const Fields& f, std::vector<Vec2> points) {
  const std::string& method = f.text("method");
  const auto polygons = polygons_of(f, points.size());
  const std::optional<int> steps = f.has("steps") ? std::optional(f.integer("steps")) : std::nullopt;
  const bool takes_polygons = method == "delaunay" || method == "advancing_front";
  if (!polygons.empty() && !takes_polygons)
    throw FieldError("polygons", fmt::format("method {} joins all points", method),
                     "method: delaunay or advancing_front");
  if (method == "advancing_front" && polygons.empty())
    throw FieldError("polygons", "an advancing front begins at polygons", "give the numbers of their points");
  if (steps && !polygons.empty() && method != "advancing_front")
    throw FieldError("steps", "Delaunay's triangles of polygons have no steps to show", "method: advancing_front");
  if (method == "greedy") return greedy_triangulation(points, steps);
  if (method == "flips") return triangulation_by_flips(points, steps);
  if (method == "advancing_front") return advancing_front(points, polygons, steps);
  if (method == "optimal") {
    if (points.size() > kMaxOptimalPoints)
      throw FieldError("points", fmt::format("the optimal triangulation of {} points takes too long", points.size()),
                       fmt::format("up to {}; method: greedy comes near", kMaxOptimalPoints));
    return optimal_triangulation(points, steps);
  }
  if (!polygons.empty()) return triangulate(points, polygons);
  if (steps && static_cast<size_t>(*steps) < points.size()) points.resize(static_cast<size_t>(*steps));
  return delaunay(points);
}

}  // namespace

TypeDeclaration triangulation_type() {
  return declare(Category::mesh, "triangulation",
                 "Points of a plane joined to triangles: by Delaunay's condition (no point in a triangle's "
                 "circumcircle), by increasing length of the edges, with the least length of all edges, or of a "
                 "region from its borders inwards. Its smooth lines are the inner edges.")
      .example("points: [[0, 0], [4, 0], [5, 3], [2, 5], [-1, 3], [2, 2]]")
      .field("points", points().count(3, 2000), "the points, in the plane x, y or at one height")
      .field("method", choice({"delaunay", "greedy", "optimal", "flips", "advancing_front"}),
             "flips: from the greedy one to Delaunay's by exchanged diagonals; optimal: of ten points at most",
             "delaunay")
      .optional("polygons", indices(),
                "of delaunay and advancing_front: numbers of the points of closed polygons with the region on their "
                "left, outer ones counterclockwise, holes clockwise; all other points are inner ones")
      .optional("steps", integer().at_least(0),
                "only so many: flips, also from the greedy one on a shortest way to the optimal one; triangles of the "
                "front; points taken up by delaunay; edges kept by greedy, which the helper greedy_edges shows")
      .shows({"circumcircles", "voronoi", "greedy_edges"})
      .built_by([](const Fields& f) -> std::any {
        Mesh mesh;
        mesh.points = f.points("points");
        std::vector<IndexTriangle> triangles;
        try {
          triangles = triangles_of(f, plane_points(f));
        } catch (const FieldError&) {
          throw;
        } catch (const std::invalid_argument& error) {
          throw FieldError(f.has("polygons") ? "polygons" : "points", error.what());
        }
        if (triangles.empty() && !f.has("steps"))
          throw FieldError("points", "they make no triangle: all lie on one line, or the region is empty");
        for (const IndexTriangle& t : triangles) mesh.triangles.push_back({{t[0], t[1], t[2]}});
        mesh.normals = {Vec3(0, 0, 1)};
        // Each a face of its own, so that the sides are lines of the mesh.
        for (size_t k = 0; k < mesh.triangles.size(); ++k) {
          mesh.triangles[k].normal = {0, 0, 0};
          mesh.triangles[k].face = static_cast<int32_t>(k);
        }
        return MeshPtr(std::make_shared<Mesh>(std::move(mesh)));
      });
}

}  // namespace lekalo::render
