// What holds of every body with blends.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/bodies/line_parity.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/body.h"
#include "geometry/queries/rays/line_intersections.h"

namespace lekalo::geometry::blend_checks {

inline std::string violations_of(const Body& body) {
  constexpr int kLines = 2000;
  std::string result;
  for (const Violation& v : body.violations()) result += v.condition + ": " + v.entity + "\n";
  if (const int odd = line_parity(body, LineIntersector(body), kLines, 1).odd; odd > 0)
    result += std::to_string(odd) + " lines cross it an odd number of times\n";
  return result;
}

inline bool is_blend(const Body& body, int face) { return body.faces[face].origin.role.rfind("fillets", 0) == 0; }

// The borders of fillets lie on both faces, which have one normal there (issue: 1e-9 of the size, 1e-7).
inline void expect_smooth_borders(const Body& body) {
  const double size = bounds(body).diameter();
  for (size_t e = 0; e < body.edges.size(); ++e) {
    const Edge& edge = body.edges[e];
    if (edge.kind != EdgeKind::regular) continue;
    ASSERT_EQ(edge.coedges.size(), 2u);
    std::array<int, 2> faces{face_of(body, edge.coedges[0]), face_of(body, edge.coedges[1])};
    const std::string& role = edge.origin.role;
    const bool is_smooth = role.find(".right") != std::string::npos || role.find(".left") != std::string::npos ||
                           role.find(".section") != std::string::npos;
    if (!is_smooth || !(is_blend(body, faces[0]) || is_blend(body, faces[1]))) continue;
    const Interval t = edge.curve->domain();
    for (int k = 0; k <= 20; ++k) {
      const double at = t.lo + t.width() * (k + 0.5) / 21;
      const Vec3 p = edge.curve->point(at);
      std::array<Vec3, 2> normals;
      for (int i = 0; i < 2; ++i) {
        const Vec2 uv(body.coedges[edge.coedges[i]].image->point(at));
        EXPECT_LE(glm::length(body.faces[faces[i]].surface->point(uv.x, uv.y) - p), 1e-9 * size)
            << name_of_edge(body, static_cast<int>(e));
        normals[i] = body.normal(faces[i], uv.x, uv.y);
      }
      EXPECT_LE(glm::length(normals[0] - normals[1]), 1e-7) << name_of_edge(body, static_cast<int>(e));
    }
  }
}

}  // namespace lekalo::geometry::blend_checks
