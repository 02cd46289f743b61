// Fillets that find no room on a face: a cylinder on a plate, near to the plate's edge (Golovanov 2016, figures 6.9.8
// to 6.9.11). Numbers of the spec of 6.9; the volume of what is cut off by quadrature.
#include <gtest/gtest.h>

#include "geometry/bodies/blends/blending.h"
#include "geometry/bodies/blends/body_draft.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/plane.h"
#include "tests/geometry/bodies/blends/blend_checks.h"

namespace lekalo::geometry::overruns_test {
namespace {

using blend_checks::expect_smooth_borders;
using blend_checks::violations_of;

// The plate [-3, 3] x [-1.2, 3] x [-1, 0] with a cylinder of radius 1 and height 2 on it.
Body plate_with_cylinder() {
  BodyDraft draft(box(Frame{{-3, -1.2, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {6, 4.2, 1}));
  const Body cylinder = cylinder_body(Frame{}, 1, 2);
  const int vertices = static_cast<int>(draft.vertices.size()), edges = static_cast<int>(draft.edges.size());
  for (const Vertex& v : cylinder.vertices) draft.add_vertex(v.point);
  for (const Edge& e : cylinder.edges) draft.add_edge(e.curve, vertices + e.start, vertices + e.end, e.origin, e.kind);
  for (const Face& face : cylinder.faces) {
    std::vector<std::vector<Body::Use>> loops;
    for (const int loop : face.loops) {
      loops.emplace_back();
      for (const int c : cylinder.loops[loop].coedges)
        loops.back().push_back(
            {edges + cylinder.coedges[c].edge, cylinder.coedges[c].forward, cylinder.coedges[c].image});
    }
    if (face.origin.role != "start") {
      draft.faces.push_back({face.surface, face.forward, face.trimmed, face.origin, 0, loops});
      continue;
    }
    // The plate's top takes the place of the cylinder's.
    for (DraftFace& top : draft.faces) {
      if (top.origin.role != "z_max") continue;
      Body::Use use = loops[0][0];
      use.image = image_in(dynamic_cast<const Plane&>(*top.surface).frame(), draft.edges[use.edge].curve);
      top.loops.push_back({use});
      top.trimmed = true;
    }
  }
  return draft.body();
}

BlendRequest fillet(const Body& body, const std::string& a, const std::string& b, double radius, Overflow overflow) {
  BlendRequest request;
  Selector between;
  between.between = {a, b};
  request.edges = select(body, Element::edge, between);
  request.rule.sizes = {ScalarLaw(radius), ScalarLaw(radius)};
  request.rule.role = "fillets.0", request.rule.field = "radius";
  request.rule.overflow = overflow;
  return request;
}

constexpr double kPlate = 6 * 4.2 + kTwoPi;

TEST(Overruns, TheBodyItself) {
  const Body body = plate_with_cylinder();
  EXPECT_EQ(violations_of(body), "");
  EXPECT_NEAR(measure(body).volume.value, kPlate, 1e-12);
}

TEST(Overruns, TheSideOfThePlateCuts) {
  const Body body = plate_with_cylinder();
  const Body result = blended(body, {fillet(body, "z_max", "side", 0.5, Overflow::cut)});
  EXPECT_EQ(violations_of(result), "");
  EXPECT_EQ(result.faces.size(), 9u);
  // Beyond y = -1.2 lies the integral of 2 r arccos(1.2/r) h(r), r = 1.2 + 0.3 x^2, h the height of the torus.
  double beyond = 0;
  constexpr int kSteps = 20000;
  for (int k = 0; k < kSteps; ++k) {
    const double x = (k + 0.5) / kSteps, r = 1.2 + 0.3 * x * x;
    beyond += 2 * r * std::acos(1.2 / r) * (0.5 - std::sqrt(0.25 - (1.5 - r) * (1.5 - r))) * 0.6 * x / kSteps;
  }
  EXPECT_NEAR(measure(result).volume.value, kPlate + 0.374743971088515 - beyond, 1e-10);
  // The torus stands 0.1 above the plate there.
  EXPECT_EQ(position({0, -1.2, 0.1}, result).where, Containment::on);
}

TEST(Overruns, TheBallRestsOnTheEdge) {
  const Body body = plate_with_cylinder();
  const Body result = blended(body, {fillet(body, "z_max", "side", 0.5, Overflow::edge)});
  EXPECT_EQ(violations_of(result), "");
  EXPECT_EQ(result.faces.size(), 11u);
  // The ball about O touches the cylinder and the edge; the middle of the arc between the contacts.
  for (const Vec3& center :
       {Vec3(0, -1.5, 0.4),
        Vec3(0.5, -std::sqrt(2.0), std::sqrt(0.25 - (std::sqrt(2.0) - 1.2) * (std::sqrt(2.0) - 1.2)))}) {
    const Vec3 wall(center.x / 1.5, center.y / 1.5, center.z), rim(center.x, -1.2, 0);
    EXPECT_NEAR(glm::length(rim - center), 0.5, 1e-12);
    const Vec3 middle = center + 0.5 * glm::normalize(wall + rim - 2.0 * center);
    EXPECT_LE(std::abs(position(wall, result).distance), 1e-9);
    EXPECT_LE(std::abs(position(middle, result).distance), 1e-9);
  }
}

TEST(Overruns, TheBallRollsOn) {
  const Body body = plate_with_cylinder();
  const Body rounded = blended(body, {fillet(body, "z_max", "y_min", 0.15, Overflow::cut)});
  const Body result = blended(rounded, {fillet(rounded, "z_max", "side", 0.5, Overflow::cut)});
  EXPECT_EQ(violations_of(result), "");
  expect_smooth_borders(result);
  // At x = 0 the ball stands on the rounding of radius 0.15 about (-1.05, -0.15).
  const Vec3 axis(0, -1.05, -0.15), center(0, -1.5, -0.15 + std::sqrt(0.65 * 0.65 - 0.45 * 0.45));
  EXPECT_LE(std::abs(position(axis + 0.15 / 0.65 * (center - axis), result).distance), 1e-9);
  EXPECT_LE(std::abs(position({0, -1, center.z}, result).distance), 1e-9);
}

}  // namespace
}  // namespace lekalo::geometry::overruns_test
