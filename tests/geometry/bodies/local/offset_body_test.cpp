// Offset bodies beside an oracle that shares nothing with them: the corners of a convex polyhedron are those common
// points of three of its planes that lie on the inner side of all.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/bodies/local/offset_of_body.h"
#include "geometry/bodies/local/untangled.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry::offset_body_test {
namespace {

struct HalfSpace {
  Vec3 normal;  // outward
  double height;
};

std::vector<HalfSpace> half_spaces(const Body& body) {
  std::vector<HalfSpace> result;
  for (size_t f = 0; f < body.faces.size(); ++f) {
    const Loop& loop = body.loops[body.faces[f].loops[0]];
    const Coedge& use = body.coedges[loop.coedges[0]];
    const Vec3 n = body.normal(static_cast<int>(f), 0, 0);
    result.push_back({n, glm::dot(n, body.vertices[body.edges[use.edge].start].point)});
  }
  return result;
}

std::vector<Vec3> corners(const std::vector<HalfSpace>& planes) {
  std::vector<Vec3> result;
  const size_t count = planes.size();
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i + 1; j < count; ++j)
      for (size_t k = j + 1; k < count; ++k) {
        const Vec3 a = planes[i].normal, b = planes[j].normal, c = planes[k].normal;
        const double det = glm::dot(a, glm::cross(b, c));
        if (std::abs(det) < 1e-9) continue;
        const Vec3 p = (planes[i].height * glm::cross(b, c) + planes[j].height * glm::cross(c, a) +
                        planes[k].height * glm::cross(a, b)) /
                       det;
        bool inside = true;
        for (const HalfSpace& h : planes) inside = inside && glm::dot(h.normal, p) <= h.height + 1e-10;
        for (const Vec3& known : result) inside = inside && glm::length(known - p) > 1e-9;
        if (inside) result.push_back(p);
      }
  return result;
}

Body pyramid(const std::vector<Vec2>& base, const Vec3& apex) {
  std::vector<Vec3> points;
  std::vector<PolygonFace> faces(1);
  const auto count = static_cast<int>(base.size());
  for (const Vec2& p : base) points.push_back(Vec3(p, 0));
  points.push_back(apex);
  for (int k = count; k-- > 0;) faces[0].corners.push_back(k);
  for (int k = 0; k < count; ++k) faces.push_back({{k, (k + 1) % count, count}, {"", "side", k}});
  return polyhedron(points, faces);
}

class OffsetBody : public testing::Test {
 protected:
  double random(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(numbers_); }

  Body random_pyramid() {
    const int count = 3 + static_cast<int>(random(0, 4.999));
    std::vector<Vec2> base;
    for (int k = 0; k < count; ++k) {
      const double angle = kTwoPi * (k + random(-0.3, 0.3)) / count;
      base.push_back(Vec2(2 * std::cos(angle), 2 * std::sin(angle)));
    }
    return pyramid(base, {random(-0.5, 0.5), random(-0.5, 0.5), random(1.5, 4)});
  }

  static FaceReplacement offset(const Body& body, double h) {
    return offset_of_body(body, std::vector<double>(body.faces.size(), h), "distance", "");
  }

  std::mt19937 numbers_{7};
};

TEST_F(OffsetBody, HasTheCornersOfTheMovedPlanes) {
  for (int trial = 0; trial < 60; ++trial) {
    const Body body = random_pyramid();
    const double h = random(-0.15, 0.5);
    const FaceReplacement made = offset(body, h);
    std::vector<HalfSpace> planes = half_spaces(body);
    for (HalfSpace& plane : planes) plane.height += h;
    const std::vector<Vec3> expected = corners(planes);
    ASSERT_EQ(made.body.vertices.size(), expected.size()) << trial;
    for (const Vertex& v : made.body.vertices) {
      double nearest = kInfinity;
      for (const Vec3& p : expected) nearest = std::min(nearest, glm::length(p - v.point));
      EXPECT_LT(nearest, 1e-12) << trial;
    }
  }
}

TEST_F(OffsetBody, ThereAndBackIsTheBody) {
  for (int trial = 0; trial < 40; ++trial) {
    const Body body = random_pyramid();
    const double h = random(0.02, 0.12);
    // Inwards and out again: the ridge at the apex shrinks to a point.
    const Body inner = offset(body, -h).body;
    const Body again = offset(inner, h).body;
    EXPECT_NEAR(measure(again).volume.value, measure(body).volume.value, 1e-11) << trial;
  }
}

TEST_F(OffsetBody, IsTheUntangledOneWhereNothingCrosses) {
  const Body body = box(Frame{}, {3, 2, 1});
  const Untangled same = untangled(offset(body, 0.25).body);
  EXPECT_FALSE(same.changed);
  EXPECT_EQ(same.body.edges.size(), 12u);
}

TEST_F(OffsetBody, FacesAreSetOffEachByItsOwnDistance) {
  const Body body = box(Frame{}, {3, 2, 1});
  const std::vector<double> distances{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const Body made = offset_of_body(body, distances, "distance", "").body;
  EXPECT_NEAR(measure(made).volume.value, 3.3 * 2.7 * 2.1, 1e-12);
  EXPECT_THROW(offset(body, -0.5), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::offset_body_test
