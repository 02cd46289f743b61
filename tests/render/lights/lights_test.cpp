// Lights against closed forms of their irradiance.
#include "render/lights/lights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lekalo::render::lights_test {
namespace {

using geometry::kPi;

// Irradiance on a surface at the origin with the normal z, as a sum over all samples, each in the middle of its
// stratum.
double irradiance(const Light& light, const Vec3& normal = {0, 0, 1}) {
  double sum = 0;
  for (int i = 0; i < light.sample_count(); ++i) {
    const LightSample s = light.sample(Vec3(0), i, 0.5, 0.5);
    sum += s.weight * s.irradiance[0] * std::max(0.0, glm::dot(s.direction, normal));
  }
  return sum;
}

TEST(Lights, PointLightIsConstantOrFallsWithTheSquare) {
  const LightPtr constant = make_light(PointLight{{0, 0, 4}, {.intensity = 3}});
  EXPECT_NEAR(irradiance(*constant), 3 * kPi, 1e-5);
  const LightPtr falling = make_light(PointLight{{0, 0, 4}, {.intensity = 3, .inverse_square = true}});
  EXPECT_NEAR(irradiance(*falling), 3 * kPi / 16, 1e-6);
}

TEST(Lights, SpotFadesBetweenItsAngles) {
  const auto lit = [](double degrees) {
    const double a = degrees * kPi / 180;
    SpotLight spot{{0, 0, 1}, {std::sin(a), 0, -std::cos(a)}, kPi / 6, kPi / 9, {}};
    return irradiance(*make_light(spot)) / kPi;
  };
  EXPECT_NEAR(lit(19.9), 1, 1e-6);
  EXPECT_EQ(lit(30.1), 0);
  // Half way between the cosines the smooth step is 1/2.
  const double half = std::acos(0.5 * (std::cos(kPi / 6) + std::cos(kPi / 9))) * 180 / kPi;
  EXPECT_NEAR(lit(half), 0.5, 1e-6);
}

TEST(Lights, OneSidedRectangleIsAMattEmitter) {
  // Radiance L = pi I / area over a square of half-side 1 at height 2 above a parallel surface: E = pi L F, four times
  // the form factor of a corner (Howell, catalogue of configuration factors, B-4):
  // F = (X atan(Y / sqrt(1+X^2)) / sqrt(1+X^2) + Y atan(X / sqrt(1+Y^2)) / sqrt(1+Y^2)) / (2 pi), X = Y = 1/2.
  RectangleLight light;
  light.frame = geometry::frame_about({0, 0, 2}, {0, 0, -1});
  light.size = {2, 2};
  light.one_sided = true;
  light.sampling.n = 64;
  light.lamp.inverse_square = true;
  const double x = 0.5, root = std::sqrt(1 + x * x);
  const double factor = 4 * 2 * x * std::atan(x / root) / root / (2 * kPi);
  const double radiance = kPi / 4;
  EXPECT_NEAR(irradiance(*make_light(light)), kPi * radiance * factor, 2e-4 * kPi * radiance * factor);
  light.frame = geometry::frame_about({0, 0, 2}, {0, 0, 1});
  EXPECT_EQ(irradiance(*make_light(light)), 0);
}

TEST(Lights, OneSidedDiscIsAMattEmitter) {
  // E = pi L R^2 / (R^2 + h^2) on the axis.
  DiscLight light;
  light.frame = geometry::frame_about({0, 0, 2}, {0, 0, -1});
  light.radius = 1;
  light.one_sided = true;
  light.sampling.n = 64;
  light.lamp.inverse_square = true;
  const double expected = kPi * (kPi / kPi) * 1 / 5;  // L = pi I / area = 1
  EXPECT_NEAR(irradiance(*make_light(light)), expected, 5e-4 * expected);
}

TEST(Lights, GridOfARectangleReachesItsEdges) {
  RectangleLight light;
  light.frame.origin = {0, 0, 5};
  light.size = {2, 4};
  light.sampling = {3, true};
  const LightPtr lamp = make_light(light);
  ASSERT_EQ(lamp->sample_count(), 9);
  Vec3 places[9];
  for (int i = 0; i < 9; ++i) {
    const LightSample s = lamp->sample(Vec3(0), i, 0.3, 0.9);
    places[i] = s.distance * s.direction;
    EXPECT_NEAR(s.weight, 1.0 / 9, 1e-16);
  }
  EXPECT_LT(glm::length(places[0] - Vec3(-1, -2, 5)), 1e-14);
  EXPECT_LT(glm::length(places[4] - Vec3(0, 0, 5)), 1e-14);
  EXPECT_LT(glm::length(places[5] - Vec3(1, 0, 5)), 1e-14);
  EXPECT_LT(glm::length(places[8] - Vec3(1, 2, 5)), 1e-14);
}

TEST(Lights, StrataAreJitteredInside) {
  const AreaSampling sampling{4, false};
  for (int i = 0; i < 16; ++i) {
    const Vec2 low = area_sample(sampling, i, 0, 0), high = area_sample(sampling, i, 0.999, 0.999);
    EXPECT_EQ(low, Vec2((i % 4) / 4.0, (i / 4) / 4.0));
    EXPECT_LT(high.x, (i % 4 + 1) / 4.0);
    EXPECT_LT(high.y, (i / 4 + 1) / 4.0);
  }
}

TEST(Lights, ConcentricMapKeepsAreas) {
  // A quarter of the square, its inner half by sides, goes to the disc of half the radius.
  EXPECT_NEAR(glm::length(concentric_disc({0.75, 0.6})), 0.5, 1e-15);
  EXPECT_NEAR(glm::length(concentric_disc({0.75, 0.75})), 0.5, 1e-15);
  EXPECT_NEAR(glm::length(concentric_disc({1, 0.2})), 1, 1e-15);
  EXPECT_EQ(concentric_disc({0.5, 0.5}), Vec2(0));
}

TEST(Lights, SphereSamplesLieOnItsNearSideWithinItsOutline) {
  SphereLight light{.center = {0, 3, 4}, .radius = 2, .sampling = {8, false}};
  const LightPtr lamp = make_light(light);
  for (int i = 0; i < lamp->sample_count(); ++i) {
    const LightSample s = lamp->sample(Vec3(0), i, 0.7, 0.2);
    EXPECT_NEAR(glm::length(s.distance * s.direction - light.center), 2, 1e-12);
    EXPECT_LE(s.distance, std::sqrt(21.0) + 1e-12);
    EXPECT_GE(glm::dot(s.direction, glm::normalize(light.center)), std::sqrt(21.0) / 5 - 1e-12);
  }
}

// A surface that faces the middle of a round source receives its intensity, however large it is seen, in the mean of
// random samples as in all fixed ones; one whose normal is `slant` away the cosine of it, if all of the source is above
// its horizon.
TEST(Lights, RoundSourcesGiveTheirIntensityAtAnySize) {
  for (const AreaSampling& sampling : {AreaSampling{64, false}, {1, true}, {2, true}, {5, true}}) {
    const double near = sampling.grid ? 1e-6 : 2e-3;
    for (const double diameter : {0.0, 10.0, 60.0, 120.0, 170.0}) {
      const auto sun = make_light(
          DistantLight{.direction = {0, 0, -1}, .angular_diameter = diameter * kPi / 180, .sampling = sampling});
      EXPECT_EQ(sun->sample_count() == 1, diameter == 0 || sampling.n == 1);
      EXPECT_NEAR(irradiance(*sun) / kPi, 1, near) << diameter << " " << sampling.n;
      if (const auto cone = sun->cone(Vec3(0))) {
        for (const double slant : {0.0, 0.5 * (90 - 0.5 * diameter)})
          EXPECT_NEAR(cone->mean_cosine(std::cos(slant * kPi / 180)) * cone->irradiance[0] / kPi,
                      std::cos(slant * kPi / 180), 1e-6);
      }
    }
    // A ball of the radiance L gives pi L (r / d)^2 at right angles: the law of the square to its very surface.
    for (const double distance : {1.01, 1.5, 2.0, 4.0}) {
      const auto even = make_light(SphereLight{{0, 0, distance}, 1, sampling, {.intensity = 3}});
      EXPECT_NEAR(irradiance(*even) / kPi, 3, 3 * near) << distance;
      const auto ball =
          make_light(SphereLight{{0, 0, distance}, 1, sampling, {.intensity = 3, .inverse_square = true}});
      EXPECT_NEAR(irradiance(*ball) / kPi, 3 / (distance * distance), 3 * near) << distance;
    }
  }
}

TEST(Lights, ConeAboveAndBelowTheHorizonBringsTheMeanOfItsSamples) {
  // The closed form against the midpoint rule over the cone, rings of equal solid angle.
  for (const double half : {0.05, 0.3, 1.0, 1.4})
    for (const double angle : {0.0, 0.4, 1.2, 1.5, kPi / 2, 1.65, 1.9, 2.5}) {
      double sum = 0;
      const int n = 400;
      for (int i = 0; i < n; ++i) {
        const double c = 1 - (i + 0.5) / n * (1 - std::cos(half)), s = std::sqrt(1 - c * c);
        for (int j = 0; j < n; ++j) {
          const double azimuth = 2 * kPi * (j + 0.5) / n;
          sum += std::fmax(0.0, std::cos(angle) * c + std::sin(angle) * s * std::cos(azimuth));
        }
      }
      const ConeLight cone{{0, 0, 1}, std::sin(half), {}};
      EXPECT_NEAR(cone.mean_cosine(std::cos(angle)), sum / (n * n), 2e-5) << half << " " << angle;
    }
}

// Directions are as close as the cosine: means over them are those of samples that fill the cone evenly, weighted with
// the cosine. Cones above the horizon, cut by it, and about the normal.
TEST(Lights, DirectionsOfAConeAreAsCloseAsTheirCosines) {
  SampleStream random(1, 2, 0, 1, 3);
  for (const double half : {0.1, 0.6, 1.3})
    for (const double slant : {0.0, 0.05, 0.5, 1.0, 1.4, 1.57, 1.65, 2.1, 2.8}) {
      if (slant - half >= 0.5 * kPi - 1e-3) continue;  // below the horizon
      const Vec3 axis(0.6 * std::sin(slant), 0.8 * std::sin(slant), std::cos(slant)), normal(0, 0, 1);
      const LightPtr light = make_light(DistantLight{-axis, 2 * half, {.n = 24}});
      const ConeLight cone = *light->cone(Vec3(0));
      Vec3 sum(0), squares(0), weighted(0), weighted_squares(0);
      double weights = 0;
      const int rounds = 40, count = light->sample_count();
      for (int k = 0; k < rounds; ++k)
        for (int i = 0; i < count; ++i) {
          const Vec3 d = cone.direction(normal, i, random);
          ASSERT_NEAR(glm::length(d), 1, 1e-12);
          ASSERT_GE(d.z, 0);
          ASSERT_GE(glm::dot(d, axis), std::cos(half) - 1e-12);
          sum += d, squares += d * d;
          const Vec2 jitter = random.next_pair();
          const Vec3 even = light->sample(Vec3(0), i, jitter.x, jitter.y).direction;
          const double weight = std::max(0.0, even.z);
          weights += weight;
          weighted += weight * even, weighted_squares += weight * even * even;
        }
      const double all = rounds * count;
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(sum[k] / all, weighted[k] / weights, 3e-3) << half << " " << slant << " " << k;
        EXPECT_NEAR(squares[k] / all, weighted_squares[k] / weights, 3e-3) << half << " " << slant << " " << k;
      }
    }
}

TEST(Lights, OnlyThoseWithASizeAreFoundByDirections) {
  EXPECT_FALSE(make_light(PointLight{})->has_size());
  EXPECT_FALSE(make_light(SpotLight{})->has_size());
  EXPECT_FALSE(make_light(DistantLight{})->has_size());
  DistantLight sun;
  sun.angular_diameter = 0.01;
  for (const LightPtr& light :
       {make_light(sun), make_light(RectangleLight{}), make_light(DiscLight{}), make_light(SphereLight{})})
    EXPECT_TRUE(light->has_size());
}

TEST(Lights, AmbientLightIsTakenOnce) {
  const LightPtr ambient = make_light(AmbientLight{{1, 0.5, 0.25}, 2});
  EXPECT_EQ(ambient->sample_count(), 0);
  EXPECT_EQ(ambient->ambient(), Spectrum(2, 1, 0.5f));
}

}  // namespace
}  // namespace lekalo::render::lights_test
