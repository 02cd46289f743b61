// Bumps, maps of normals and holes, made as scene files make them.
#include "render/materials/surface_detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries/differential/curvature.h"
#include "render/lobes/bsdf.h"
#include "render/materials/materials.h"

namespace lekalo::render {

std::vector<geometry::TypeDeclaration> texture_types();

}  // namespace lekalo::render

namespace lekalo::render::surface_detail_test {
namespace {

using geometry::Fields;

// Grows along u, falls along v.
class Slope final : public Texture {
 public:
  Spectrum at(const SurfacePoint& point) const override {
    const auto h = static_cast<float>(0.5 + 0.3 * point.u - 0.2 * point.v);
    return {h, h, h};
  }
};

class Constant final : public Texture {
 public:
  explicit Constant(const Spectrum& color) : color_(color) {}
  Spectrum at(const SurfacePoint&) const override { return color_; }

 private:
  Spectrum color_;
};

// Of a plane with skew parameters: r_u = (2, 0, 0), r_v = (1, 3, 0).
SurfacePoint point() {
  SurfacePoint p;
  p.du = {2, 0, 0};
  p.dv = {1, 3, 0};
  p.u = 0.4;
  p.v = 0.1;
  p.incoming = {0, 0, -1};
  p.pixel_size = 0.01;
  return p;
}

MaterialPtr material(const Fields& fields) {
  geometry::TypeDeclaration plain = geometry::declare(geometry::Category::material, "plain", "white");
  plain.built_by([](const Fields&) { return make_material(Diffuse{1.0, 0, {}}); });
  return std::any_cast<MaterialPtr>(with_surface_detail(plain).build(fields));
}

TEST(Bump, TurnsTheNormalAsTheHigherSurfaceHasIt) {
  Fields bump, fields;
  bump.set("texture", TexturePtr(std::make_shared<Slope>()));
  bump.set("height", 0.5);
  fields.set("bump", bump);
  // The surface r + 0.5 h m: r_u' = (2, 0, 0.15), r_v' = (1, 3, -0.1).
  const Vec3 expected = glm::normalize(glm::cross(Vec3(2, 0, 0.15), Vec3(1, 3, -0.1)));
  const Vec3 found = material(fields)->shading_normal(point());
  EXPECT_NEAR(glm::length(found - expected), 0, 1e-4);
}

TEST(NormalMap, HasItsFrame) {
  const auto mapped = [](const Spectrum& color, double strength) {
    Fields map, fields;
    map.set("texture", TexturePtr(std::make_shared<Constant>(color)));
    map.set("strength", strength);
    fields.set("normal_map", map);
    return material(fields)->shading_normal(point());
  };
  EXPECT_NEAR(glm::length(mapped({0.5f, 0.5f, 1}, 1) - Vec3(0, 0, 1)), 0, 1e-7);
  EXPECT_NEAR(glm::length(mapped({1, 0.5f, 1}, 1) - glm::normalize(Vec3(1, 0, 1))), 0, 1e-7);
  EXPECT_NEAR(glm::length(mapped({0.5f, 1, 1}, 1) - glm::normalize(Vec3(0, 1, 1))), 0, 1e-7);
  EXPECT_NEAR(glm::length(mapped({1, 0.5f, 1}, 0) - Vec3(0, 0, 1)), 0, 1e-7);
}

TEST(Opacity, LetsTheRestGoStraightThrough) {
  Fields fields;
  fields.set("opacity", Vec3(0.25, 0.5, 1));
  const MaterialPtr m = material(fields);
  EXPECT_TRUE(m->transmits());
  const Scattering s = m->scattering(point(), Wavelengths{});
  const Spectrum through = straight_share(s, 0.3, {});
  EXPECT_NEAR(through[0], 0.75, 1e-6);
  EXPECT_NEAR(through[1], 0.5, 1e-6);
  EXPECT_NEAR(through[2], 0, 1e-6);
  EXPECT_NEAR(matt_reflectance(s)[0], 0.25, 1e-6);
}

TEST(SurfaceDetail, OfNoneIsTheMaterialItself) { EXPECT_TRUE(material({})->made_from().has_value()); }

// Curvature of a ball of radius 2.
class Ball final : public CurvatureSource {
 public:
  geometry::SurfaceCurvature curvature(const SurfacePoint& at) const override {
    geometry::SurfaceCurvature c;
    c.regular = at.u > 0;
    c.principal[0] = c.principal[1] = c.mean = 0.5;
    c.gaussian = 0.25;
    return c;
  }
};

TexturePtr ramp(const std::string& by) {
  const auto types = texture_types();
  const auto found =
      std::find_if(types.begin(), types.end(), [](const geometry::TypeDeclaration& t) { return t.name == "ramp"; });
  std::vector<Fields> stops(3);
  for (int k = 0; k < 3; ++k) {
    stops[static_cast<size_t>(k)].set("at", 0.5 * std::max(0, k - 1) + (k > 0 ? 0.1 : 0));
    stops[static_cast<size_t>(k)].set("color", Vec3(0.5 * k));
  }
  Fields fields;
  fields.set("by", by);
  fields.set("stops", stops);
  fields.set("unknown", Vec3(0.3));
  return std::any_cast<TexturePtr>(found->build(fields));
}

// Black at 0, grey at 0.1, white at 0.6.
TEST(Ramp, MixesItsStopsByTheNumber) {
  const Ball ball;
  SurfacePoint p = point();
  p.curvature_source = &ball;
  p.position = {0, 0, 0.05};
  EXPECT_NEAR(ramp("z")->at(p)[0], 0.25, 1e-6);
  EXPECT_NEAR(ramp("u")->at(p)[0], 0.8, 1e-6);
  EXPECT_NEAR(ramp("gaussian_curvature")->at(p)[0], 0.65, 1e-6);
  EXPECT_NEAR(ramp("largest_curvature")->at(p)[0], 0.9, 1e-6);
  p.u = -1;
  EXPECT_NEAR(ramp("u")->at(p)[0], 0, 1e-6);
  EXPECT_NEAR(ramp("mean_curvature")->at(p)[0], 0.3, 1e-6);
  p.position.z = 8;
  EXPECT_NEAR(ramp("z")->at(p)[0], 1, 1e-6);
}

}  // namespace
}  // namespace lekalo::render::surface_detail_test
