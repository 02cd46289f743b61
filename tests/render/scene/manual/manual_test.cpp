// Every example of the manual is a scene that the program takes.
#include "render/scene/manual/manual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "render/scene/scene_text.h"

namespace lekalo::render::manual_test {
namespace {

// The things that examples name.
const std::string kNamed =
    "geometry:\n"
    "  my_curve: { type: nurbs_curve, degree: 1, points: [[1, 0], [2, 0, 1], [3, 0]] }\n"
    "  my_body: { type: ball, radius: 1 }\n"
    "  round: { type: circle, radius: 1 }\n"
    "  pipe: { type: cylinder_surface, radius: 1, height: 2 }\n";

bool offers(const std::string& type, const std::string& helper) {
  for (const TypeDeclaration& one : all_types()) {
    if (one.name != type) continue;
    const std::vector<std::string> offered = helpers_of(one);
    return std::find(offered.begin(), offered.end(), helper) != offered.end();
  }
  return false;
}

// The example of the first type that offers it.
std::string example_offering(const std::string& helper) {
  for (const TypeDeclaration& one : all_types())
    if (offers(one.name, helper)) return example_of(one);
  return "{}";
}

// A scene with the example where things of its category stand.
std::string scene_of(const TypeDeclaration& type, const std::string& example) {
  const bool curve = type.helpers.empty() && (type.name == "de_casteljau" || type.name == "control_polygon");
  switch (type.category) {
    case Category::object:
      return kNamed + "objects: [" + example + "]\n";
    case Category::material:
      return "materials: { a: " + example + " }\n";
    case Category::texture:
      return "materials: { a: { type: diffuse, color: " + example + " } }\n";
    case Category::light:
      return "lights: { a: " + example + " }\n";
    case Category::camera:
      return kNamed + "camera: " + example + "\n";
    case Category::integrator:
      return "integrator: " + example + "\n";
    case Category::style:
      return "styles: { a: " + example + " }\n";
    case Category::panel:
      return kNamed + "panels: { a: " + example + " }\n";
    case Category::quantity:
      return "info: { unit: m }\n" + kNamed + "parameters: { a: " + example +
             " }\nattributes: { of: my_body, density: 1000, temperature: 20 }\n";
    case Category::annotation:
      return kNamed + "drawing: { annotations: [" + example + "] }\n";
    case Category::helper:
      return kNamed + "  c: " +
             (curve                                ? "{ type: bezier_curve, points: [[0, 0], [1, 1], [2, 0]] }"
              : offers("nurbs_curve", type.name)   ? "{ type: nurbs_curve, points: [[0, 0], [1, 1], [2, 0], [3, 1]] }"
              : offers("triangulation", type.name) ? "{ type: triangulation, points: [[0, 0], [1, 0], [0, 1]] }"
              : offers("nurbs_surface", type.name)
                  ? "{ type: nurbs_surface, degree: 1, points: [[[0, 0], [0, 1]], [[1, 0], [1, 1, 1]]] }"
                  : example_offering(type.name)) +
             "\nobjects: { shape: c, show: { " + example + " } }\n";
    default:
      return kNamed + "  a: " + example + "\n";
  }
}

TEST(Manual, ExamplesAreScenes) {
  for (const TypeDeclaration& type : all_types()) {
    const std::string example = example_of(type);
    if (example.find("file:") != std::string::npos || type.runs_foreign_code) continue;  // the reader's own file
    std::string scene = scene_of(type, example);
    // A radius is that of something round.
    if (type.name.ends_with("s_dimension") || type.name.ends_with("r_dimension"))
      if (const size_t at = scene.find("of: my_curve"); at != std::string::npos) scene.replace(at, 12, "of: round");
    // A cutting plane is that of a panel with a section.
    if (type.name == "cutting_plane")
      scene += "panels: { text: { camera: { view: front }, section: { planes: { normal: -y } } } }\n";
    if (type.name == "detail_circle")
      scene += "panels: { text: { camera: { view: front }, detail: { around: [0, 0, 0], radius: 1 } } }\n";
    EXPECT_EQ(build_text(scene).said, "") << type.name << "\n" << scene;
  }
}

TEST(Manual, NamesOfOneCategoryAreUnique) {
  std::set<std::pair<Category, std::string>> names;
  for (const TypeDeclaration& type : all_types())
    EXPECT_TRUE(names.emplace(type.category, type.name).second) << type.name;
}

// Ranges of angles are declared in radians and read in degrees.
TEST(Manual, RangesOfAnglesAreInDegrees) {
  for (const TypeDeclaration& type : all_types())
    EXPECT_EQ(description_of(type).find("-5156"), std::string::npos) << type.name;
}

}  // namespace
}  // namespace lekalo::render::manual_test
