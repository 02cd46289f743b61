#include "geometry/bodies/local/crossing_faces.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "geometry/bodies/topology/copied_face.h"
#include "geometry/queries/contours/body_contours.h"

namespace lekalo::geometry {

namespace {

constexpr double kApart = 1e-9;  // of the size: boxes of faces that only touch do not overlap

std::set<int> vertices_of(const Body& body, int face) {
  std::set<int> vertices;
  for (const int loop : body.faces[face].loops)
    for (const int c : body.loops[loop].coedges) {
      const Edge& edge = body.edges[body.coedges[c].edge];
      vertices.insert({edge.start, edge.end});
    }
  return vertices;
}

bool have_common(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&](int v) { return b.count(v) > 0; });
}

bool boxes_overlap(const Box3& a, const Box3& b, double small) {
  for (int k = 0; k < 3; ++k)
    if (a.hi[k] < b.lo[k] + small || b.hi[k] < a.lo[k] + small) return false;
  return true;
}

bool do_cross(const Body& body, int a, int b) {
  try {
    return !intersect(face_alone(body, a), face_alone(body, b)).branches.empty();
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

std::optional<std::pair<int, int>> crossing_faces(const Body& body, const std::function<bool(int)>& is_new) {
  const int count = static_cast<int>(body.faces.size());
  const double size = bounds(body).diameter();
  const double small = kApart * size;
  std::vector<Box3> boxes;
  std::vector<std::set<int>> vertices;
  for (int f = 0; f < count; ++f) {
    boxes.push_back(bounds(body, f));
    vertices.push_back(vertices_of(body, f));
  }
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if ((is_new(a) || is_new(b)) && boxes_overlap(boxes[a], boxes[b], small) &&
          !have_common(vertices[a], vertices[b]) && do_cross(body, a, b))
        return std::pair(a, b);
  return std::nullopt;
}

}  // namespace lekalo::geometry
