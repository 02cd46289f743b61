// What scene files can name: builders make the same materials as the plain structs.
#include "geometry/describe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "render/cameras/cameras.h"
#include "render/integrators/classic_reading.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/materials/textures.h"

namespace lekalo::render {

std::vector<geometry::TypeDeclaration> material_types();
std::vector<geometry::TypeDeclaration> texture_types();
std::vector<geometry::TypeDeclaration> light_types();
std::vector<geometry::TypeDeclaration> camera_types();
std::vector<geometry::TypeDeclaration> integrator_types();

}  // namespace lekalo::render

namespace lekalo::render::declarations_test {

namespace {

using geometry::Category;
using geometry::Fields;
using geometry::TypeDeclaration;

TypeDeclaration type(const std::vector<TypeDeclaration>& family, const std::string& name) {
  return *std::find_if(family.begin(), family.end(), [&](const TypeDeclaration& t) { return t.name == name; });
}

TEST(Declarations, FamiliesAreWhole) {
  const auto check = [](const std::vector<TypeDeclaration>& family, Category category, std::set<std::string> names) {
    std::set<std::string> found;
    for (const TypeDeclaration& t : family) {
      EXPECT_EQ(t.category, category) << t.name;
      EXPECT_FALSE(t.description.empty()) << t.name;
      EXPECT_TRUE(t.build) << t.name;
      std::set<std::string> fields;
      for (const geometry::Field& field : t.fields) {
        EXPECT_FALSE(field.description.empty()) << t.name << '.' << field.name;
        EXPECT_TRUE(fields.insert(field.name).second) << t.name << '.' << field.name;
      }
      found.insert(t.name);
    }
    EXPECT_EQ(found, names);
  };
  check(material_types(), Category::material,
        {"classic", "diffuse", "plastic", "conductor", "dielectric", "principled", "cloth", "translucent_sheet", "mix",
         "emission", "shadow_catcher"});
  check(texture_types(), Category::texture, {"checker", "grid", "parameter_lines", "image", "noise", "ramp"});
  check(light_types(), Category::light,
        {"point_light", "spot_light", "distant_light", "rectangle_light", "disc_light", "sphere_light",
         "environment_light", "sky_light", "sun_light", "profile_light", "ambient_light"});
  check(camera_types(), Category::camera, {"graph", "perspective", "parallel", "panorama"});
  check(integrator_types(), Category::integrator,
        {"analysis", "classic", "path", "direct_lighting", "ambient_occlusion"});
}

TEST(Declarations, ColourFieldsTakeColoursAndTextures) {
  const TypeDeclaration diffuse = type(material_types(), "diffuse");
  SurfacePoint point;
  point.u = 0.5;
  point.v = 0.5;
  Fields plain;
  plain.set("color", Vec3(0.1, 0.2, 0.3));
  plain.set("roughness", 0.0);
  const auto material = std::any_cast<MaterialPtr>(diffuse.build(plain));
  EXPECT_EQ(classic_reading(*material, point, {}).diffuse, Spectrum(0.1f, 0.2f, 0.3f));
  Fields textured;
  textured.set("roughness", 0.0);
  textured.set("color", make_texture(Checker{.color = 0.25}));
  EXPECT_EQ(classic_reading(*std::any_cast<MaterialPtr>(diffuse.build(textured)), point, {}).diffuse[1], 0.25f);
}

TEST(Declarations, GlassKnowsItsIndexForEveryWavelength) {
  Fields fields;
  fields.set("glass", std::string("N-BK7"));
  fields.set("absorption", Vec3(0));
  fields.set("roughness", 0.1);
  fields.set("priority", 0);
  fields.set("thin", false);
  fields.set("scattering", Vec3(0));
  fields.set("forward", 0.0);
  const auto glass = std::any_cast<MaterialPtr>(type(material_types(), "dielectric").build(fields));
  EXPECT_NEAR(glass->interior({{587.5618f, 0, 0, 0}})->index, 1.5168, 1e-6);
  EXPECT_NEAR(glass->interior({{435.8343f, 0, 0, 0}})->index, 1.52668, 1e-5);  // Schott's data sheet, line g
  fields.set("index", 1.5);
  EXPECT_THROW(type(material_types(), "dielectric").build(fields), geometry::FieldError);
}

TEST(Declarations, CamerasWaitForThePictureAndTheScene) {
  Fields fields;
  fields.set("up", Vec3(0, 0, 1));
  fields.set("view", std::string("front"));
  fields.set("frame", std::string("all"));
  fields.set("margin", 0.1);
  const auto factory = std::any_cast<CameraFactory>(type(camera_types(), "parallel").build(fields));
  const CameraPtr camera = factory(200, 100, FramedContent(geometry::Box3{Vec3(-1), Vec3(1)}));
  EXPECT_NEAR(camera->project({-1, 0, 1}).y, 10, 1e-9);
  fields.set("from", Vec3(0, -5, 0));
  EXPECT_THROW(type(camera_types(), "parallel").build(fields), geometry::FieldError);  // needs height
}

}  // namespace
}  // namespace lekalo::render::declarations_test
