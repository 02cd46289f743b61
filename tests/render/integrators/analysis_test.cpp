// The analysis integrator on surfaces whose curvatures and angles are known: Golovanov 2016, 3.1, and closed forms.
#include "render/integrators/analysis.h"

#include <gtest/gtest.h>

#include <any>
#include <cmath>
#include <map>

#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/surfaces/analytic/torus.h"
#include "render/model/color_scale.h"
#include "render/small_scene.h"
#include "render/trace/hit_curvature.h"

namespace lekalo::render::analysis_test {
namespace {

using geometry::Affine;
using geometry::Interval;
using geometry::kPi;
using geometry::Mat3;
using geometry::SurfaceCurvature;

std::shared_ptr<const World> world_of(Entity shape, const Affine& transform = {},
                                      Representation representation = Representation::direct) {
  auto model = std::make_shared<Model>();
  Object object;
  object.shape = std::move(shape);
  object.transform = transform;
  object.material = make_material(Diffuse{});
  object.representation = representation;
  object.sag = 0.01;
  model->objects.push_back(object);
  model->integrator = make_analysis_integrator({});  // asks for parameters
  return std::make_shared<World>(model);
}

struct Seen {
  SurfacePoint point;
  SurfaceCurvature curvature;
};
Seen seen_from(const World& world, const Vec3& origin, const Vec3& at) {
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(at - origin);
  Hit hit;
  EXPECT_TRUE(world.nearest(ray, hit));
  const SurfacePoint point = world.surface_point(ray, hit);
  return {point, curvature_at(world, hit, point)};
}

geometry::SurfacePtr torus() { return std::make_shared<geometry::TorusSurface>(geometry::Frame(), 3.0, 1.0); }

TEST(HitCurvature, Torus) {
  for (const auto representation : {Representation::direct, Representation::mesh}) {
    const auto world = world_of(torus(), {}, representation);
    const double within = representation == Representation::direct ? 1e-12 : 2e-2;
    const Seen outside = seen_from(*world, {10, 0.2, 0}, {4, 0, 0});
    ASSERT_TRUE(outside.curvature.regular);
    EXPECT_NEAR(outside.curvature.principal[0], -0.25, within);
    EXPECT_NEAR(outside.curvature.principal[1], -1, within);
    const Seen inside = seen_from(*world, {0, 0, 0}, {2, 0, 0});
    EXPECT_NEAR(inside.curvature.principal[0], 0.5, within);
    EXPECT_NEAR(inside.curvature.principal[1], -1, within);
  }
}

// A ball squeezed into an ellipsoid has that one's curvatures (30 digits: docs of Golovanov 2016, 3.1).
TEST(HitCurvature, AffineImage) {
  Affine map;
  map.linear = Mat3(3, 0, 0, 0, 2, 0, 0, 0, 1);
  const auto world = world_of(sphere({0, 0, 0}, 1), map);
  const Vec3 place(2.515159930782611, 0.916025421694584, 0.295520206661340);
  const Seen seen = seen_from(*world, 3.0 * place, place);
  ASSERT_TRUE(seen.curvature.regular);
  EXPECT_NEAR(glm::length(seen.point.position - place), 0, 1e-12);
  EXPECT_NEAR(seen.curvature.mean, -0.921511803139706, 1e-10);
  EXPECT_NEAR(seen.curvature.gaussian, 0.585169620359303, 1e-10);
  EXPECT_NEAR(seen.curvature.principal[0], -0.407688503778447, 1e-10);
}

// Mirrored, the ball is still seen from outside.
TEST(HitCurvature, MirrorImage) {
  Affine map;
  map.linear = Mat3(2, 0, 0, 0, 2, 0, 0, 0, -2);
  const auto world = world_of(sphere({0, 0, 0}, 1), map);
  EXPECT_NEAR(seen_from(*world, {9, 1, 2}, {0, 0, 0}).curvature.mean, -0.5, 1e-12);
}

TEST(HitCurvature, Balls) {
  const Vec3 centers[] = {Vec3(0)};
  const double radii[] = {2.0};
  const auto world = world_of(geometry::ShapePtr(std::make_shared<geometry::Balls>(centers, radii)));
  const Seen seen = seen_from(*world, {5, 1, 0.3}, {0, 0, 0});
  ASSERT_TRUE(seen.curvature.regular);
  EXPECT_NEAR(seen.curvature.principal[0], -0.5, 1e-12);
  EXPECT_NEAR(seen.curvature.principal[1], -0.5, 1e-12);
}

// Of a pole the limit.
TEST(HitCurvature, Pole) {
  const auto world = world_of(sphere({0, 0, 0}, 2));
  const Seen seen = seen_from(*world, {0, 0, 5}, {0, 0, 0});
  ASSERT_TRUE(seen.curvature.regular);
  EXPECT_NEAR(seen.curvature.mean, -0.5, 1e-6);
}

// A quantity as a scene says it.
Quantity quantity(const std::string& name, const std::map<std::string, std::any>& fields) {
  geometry::Fields values;
  values.set("quantity", name);
  for (const auto& [field, value] : fields) values.set(field, value);
  return quantity_of(values);
}
// At a place with this normal, seen from above.
double value_at(const Quantity& q, const Vec3& place, const Vec3& normal, const Vec3& sight = {0, 0, -1}) {
  SurfacePoint point;
  point.position = place;
  point.normal = point.geometric_normal = normal;
  point.incoming = sight;
  return q.value({point, nullptr, {}}).value_or(std::nan(""));
}

TEST(Quantities, DraftAngle) {
  const Quantity draft = quantity("draft_angle", {{"direction", Vec3(0, 0, 1)}});
  EXPECT_NEAR(value_at(draft, {0, 0, 0}, {0, 0, 1}), 90, 1e-12);
  EXPECT_NEAR(value_at(draft, {0, 0, 0}, {1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(value_at(draft, {0, 0, 0}, {std::sqrt(0.75), 0, -0.5}), -30, 1e-12);
}

TEST(Quantities, IsophotesAndZebra) {
  const std::map<std::string, std::any> fields{{"direction", Vec3(0, 0, 1)}, {"stripes", 18}};
  const Vec3 leaning = glm::normalize(Vec3(std::sqrt(3.0), 0, 1));
  EXPECT_NEAR(value_at(quantity("isophotes", fields), {0, 0, 0}, leaning), 60, 1e-12);
  EXPECT_NEAR(value_at(quantity("isophotes", fields), {0, 0, 0}, -leaning), 60, 1e-12);  // seen from behind
  EXPECT_NEAR(value_at(quantity("zebra", fields), {0, 0, 0}, leaning), 120, 1e-12);
  EXPECT_EQ(quantity("zebra", fields).stripe, 10);
}

// A mirror that leans by 22.5 degrees sends sight from above off at 45 degrees: at the height 10 it is 10 aside.
TEST(Quantities, ReflectionLines) {
  const Quantity lines =
      quantity("reflection_lines",
               {{"lamp", geometry::Axis{{0, 0, 10}, {1, 0, 0}}}, {"ceiling", Vec3(0, 0, 1)}, {"spacing", 1.0}});
  const double half = kPi / 8;
  EXPECT_NEAR(value_at(lines, {3, 0, 0}, {0, std::sin(half), std::cos(half)}), 10 + 0.25, 1e-12);
  EXPECT_NEAR(value_at(lines, {3, -2, 0}, {0, 0, 1}), -2 + 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(value_at(lines, {0, 0, 20}, {0, 0, 1})));  // above the lamps
}

TEST(Quantities, DistanceAndDeviation) {
  const Quantity distance = quantity("distance", {{"to", sphere({0, 0, 0}, 2)}});
  EXPECT_NEAR(value_at(distance, {3, 4, 0}, {0, 0, 1}), 3, 1e-12);
  EXPECT_NEAR(value_at(distance, {0, 0.5, 0}, {0, 0, 1}), -1.5, 1e-12);
  const geometry::CurvePtr circle = std::make_shared<geometry::Circle>(geometry::Frame(), 2.0);
  const Quantity to_curve = quantity("distance", {{"to", circle}});
  EXPECT_FALSE(to_curve.has_sign);
  EXPECT_NEAR(value_at(to_curve, {3, 0, 0}, {0, 0, 1}), 1, 1e-12);
  EXPECT_NEAR(value_at(to_curve, {0, 0.5, 0}, {0, 0, 1}), 1.5, 1e-12);
  const Quantity deviation = quantity("deviation", {{"points", std::vector<Vec3>{{0, 0, 0.1}, {5, 0, -0.2}}}});
  EXPECT_NEAR(value_at(deviation, {0.2, 0, 0}, {0, 0, 1}), 0.1, 1e-12);
  EXPECT_NEAR(value_at(deviation, {4.8, 0, 0}, {0, 0, 1}), -0.2, 1e-12);
  EXPECT_THROW(quantity("distance", {}), geometry::FieldError);
  EXPECT_THROW(quantity("deviation", {}), geometry::FieldError);
}

// Tori on tori: along the small circle they stretch by the ratio of their radii, along the large one by less.
TEST(Quantities, Strain) {
  const auto on = [](double major, double minor) {
    return quantity(
        "strain",
        {{"to", geometry::SurfacePtr(std::make_shared<geometry::TorusSurface>(geometry::Frame(), major, minor))}});
  };
  EXPECT_NEAR(value_on(on(6, 2), *torus(), 0.7, 2), 1.5, 1e-12);
  EXPECT_NEAR(value_on(on(3, 1.1), *torus(), 0.7, 0), 0.5 * (1.1 * 1.1 - 1), 1e-12);
  EXPECT_NEAR(value_on(on(3, 0.9), *torus(), 0.7, 0), 0.5 * (0.9 * 0.9 - 1), 1e-12);
  EXPECT_TRUE(std::isnan(value_at(on(3, 1), {0, 0, 0}, {0, 0, 1})));  // nothing with parameters
  EXPECT_THROW(quantity("strain", {}), geometry::FieldError);
}

TEST(RangeOf, OutermostValuesAreLeftOut) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(0.001 * i);
  values.push_back(1e9);
  const Interval plain = range_of(values, false), about_zero = range_of(values, true);
  EXPECT_NEAR(plain.lo, 0.02, 0.0101);
  EXPECT_NEAR(plain.hi, 0.98, 0.0101);
  EXPECT_EQ(about_zero, Interval(-plain.hi, plain.hi));
  EXPECT_EQ(range_of({}, true), Interval(-1, 1));
  const Interval about = range_of({5, 5, 5}, false);
  EXPECT_LT(about.lo, 5);
  EXPECT_GT(about.hi, 5);
}

TEST(PlaceOnScale, BandsHaveTheColourOfTheirMiddle) {
  PictureScale scale{Interval(0, 10), "viridis", {2, 4, 8}, true, {}};
  EXPECT_DOUBLE_EQ(place_on_scale(scale, 1.9), 0.1);
  EXPECT_DOUBLE_EQ(place_on_scale(scale, 2), 0.3);
  EXPECT_DOUBLE_EQ(place_on_scale(scale, 7), 0.6);
  EXPECT_DOUBLE_EQ(place_on_scale(scale, 99), 0.9);
  scale.bands = false;
  EXPECT_DOUBLE_EQ(place_on_scale(scale, 7), 0.7);
  EXPECT_DOUBLE_EQ(place_on_scale(scale, -1), 0);
}

}  // namespace
}  // namespace lekalo::render::analysis_test
