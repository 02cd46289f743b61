// STEP files read back by OCCT: its shapes are valid and have our volumes and areas.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>

#include <filesystem>
#include <fstream>
#include <map>

#include "geometry/curves/analytic/circle.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/plane.h"
#include "occt/step_reader.h"
#include "render/scene/build/load.h"
#include "render/step/step_export.h"

namespace lekalo::render::step_test {
namespace {

using geometry::BodyPtr;

constexpr double kMass = 1e-6;

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  int found = 0;
  for (TopExp_Explorer it(shape, kind); it.More(); it.Next()) ++found;
  return found;
}

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("lekalo_step_scene_{}", getpid());
  Folder() { std::filesystem::create_directory(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

BodyPtr body_of(const std::string& geometry) {
  const Folder folder;
  const std::filesystem::path file = folder.path / "scene.yaml";
  std::ofstream(file) << "lekalo: 1\ngeometry:\n" << geometry;
  const LoadedScene scene = load_scene(file);
  return std::get<BodyPtr>(scene.model->geometry.at("b"));
}

struct Case {
  const char* name;
  const char* geometry;
  int solids = 1;
};

class Step : public testing::TestWithParam<Case> {};

TEST_P(Step, ReadBackByOcct) {
  const BodyPtr body = body_of(GetParam().geometry);
  const StepFile file = step_file({{"b", body, {}, geometry::Vec3(0.5, 0.6, 0.7)}}, "b", "mm", 1e-9);
  for (const std::string& note : file.notes) EXPECT_EQ(note.find("left out"), std::string::npos) << note;
  const TopoDS_Shape shape = tests::read_step(file.text);
  ASSERT_FALSE(shape.IsNull());
  EXPECT_EQ(count(shape, TopAbs_SOLID), GetParam().solids);
  EXPECT_EQ(count(shape, TopAbs_FACE), static_cast<int>(body->faces.size()));
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  GProp_GProps area, volume;
  BRepGProp::SurfaceProperties(shape, area, 1e-9);
  BRepGProp::VolumeProperties(shape, volume, 1e-9);
  const geometry::MassProperties own = measure(*body);
  EXPECT_NEAR(area.Mass(), own.area.value, kMass * own.area.value);
  if (GetParam().solids > 0) {
    EXPECT_NEAR(volume.Mass(), own.volume.value, kMass * own.volume.value);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Step,
    testing::Values(
        Case{"box", "  b: { type: box, size: [1, 2, 3], transform: { rotate: 20, axis: [1, 2, 3] } }\n"},
        Case{"cylinder",
             "  b: { type: cylinder_body, radius: 1.5, height: 2, center: [1, 2, 3], axis: [1, 0.5, 2] }\n"},
        Case{"cone", "  b: { type: cone_body, radius: 1.5, height: 2 }\n"},
        Case{"frustum", "  b: { type: cone_body, radius: 1, top_radius: 2, height: 2 }\n"},
        Case{"ball", "  b: { type: ball, radius: 1.5, transform: { rotate: 20, axis: [1, 2, 3] } }\n"},
        Case{"torus", "  b: { type: torus_body, major_radius: 2, minor_radius: 0.7 }\n"},
        Case{"plate",
             "  b: { type: extrusion_body, of: [{ type: rectangle, size: [4, 3], corner_radius: 0.5 }, "
             "{ type: circle, radius: 0.6 }], along: [0, 0, 1] }\n"},
        Case{"drafted",
             "  b: { type: extrusion_body, of: { type: rectangle, size: [4, 3] }, along: [0, 0, 1], "
             "draft: 10 }\n"},
        Case{"scaled", "  b: { type: cylinder_body, radius: 1, height: 2, transform: { scale: [1, 2, 1] } }\n"},
        Case{"mirrored", "  b: { type: cone_body, radius: 1, top_radius: 2, height: 2, transform: { mirror: x } }\n"},
        Case{"swept",
             "  path: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 2.4], [2.4, 0, 2.6], [3, 2.4, 2.6]] }\n"
             "  b: { type: sweep_body, of: { type: rectangle, size: [1, 0.6] }, path: path }\n"},
        Case{"revolved",
             "  b: { type: revolution_body, of: { type: rectangle, size: [1, 0.6], center: [2, 0] }, "
             "axis: y }\n"},
        Case{"hollow",
             "  outer: { type: ball, radius: 2 }\n  inner: { type: box, size: [1, 1, 1] }\n"
             "  b: { type: hollow_body, of: outer, voids: [inner] }\n"},
        Case{"fillets",
             "  o: { type: rectangle, size: [6, 4], corner_radius: 0.8 }\n"
             "  p: { type: extrusion_body, of: o, along: [0, 0, 1.2] }\n"
             "  b: { type: fillet_body, of: p, fillets: { edges: { between: [end, side] }, radius: 0.3 } }\n"},
        Case{"rounded_corner",
             "  p: { type: box, size: [1, 1, 1] }\n"
             "  b: { type: fillet_body, of: p, fillets: { edges: {}, radius: 0.1 } }\n"},
        Case{"chamfer",
             "  p: { type: cylinder_body, radius: 1, height: 1 }\n"
             "  b: { type: chamfer_body, of: p, chamfers: { edges: { between: [end, side] }, lengths: "
             "[0.2, 0.3] } }\n"},
        Case{"offset",
             "  o: { type: polygon, points: [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]] }\n"
             "  p: { type: extrusion_body, of: o, along: [0, 0, 2] }\n"
             "  b: { type: offset_body, of: p, distance: 0.2 }\n"},
        Case{"drafted_faces",
             "  p: { type: box, size: [2, 2, 1] }\n"
             "  b: { type: drafted_faces, of: p, faces: [x_max, y_max], angle: 10 }\n"},
        Case{"window",
             "  b: { type: trimmed_surface, of: { type: cylinder_surface, radius: 1, height: 2 }, loops: { type: "
             "circle, center: [3, 0.5], radius: 0.3 }, keep: outside }\n",
             0},
        Case{"window_in_a_torus",
             "  b: { type: trimmed_surface, of: { type: torus_surface, major_radius: 3, "
             "minor_radius: 1 }, loops: { type: circle, center: [3, 0.5], radius: 0.3 }, keep: "
             "outside }\n",
             0},
        Case{"band",
             "  b: { type: trimmed_surface, of: { type: sphere_surface, radius: 1 }, loops: [{ type: segment, "
             "from: [0, -0.5], to: [6.283185307179586, -0.5] }, { type: segment, from: [0, 0.5], to: "
             "[6.283185307179586, 0.5] }] }\n",
             0}),
    [](const auto& info) { return std::string(info.param.name); });

// Swept lines and arcs are planes, cylinders, cones, spheres and tori there; other sweeps keep their exact section.
struct Elementary {
  const char* name;
  const char* geometry;
  std::map<GeomAbs_SurfaceType, int> faces;
};

class StepElementary : public testing::TestWithParam<Elementary> {};

TEST_P(StepElementary, FacesAreWhatTheyAre) {
  const BodyPtr body = body_of(GetParam().geometry);
  const StepFile file = step_file({{"b", body, {}, {}}}, "b", "mm", 1e-9);
  EXPECT_TRUE(file.notes.empty());
  const TopoDS_Shape shape = tests::read_step(file.text);
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  EXPECT_EQ(count(shape, TopAbs_SOLID), 1);
  std::map<GeomAbs_SurfaceType, int> faces;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
    ++faces[BRepAdaptor_Surface(TopoDS::Face(it.Current())).GetType()];
  EXPECT_EQ(faces, GetParam().faces);
  GProp_GProps area, volume;
  BRepGProp::SurfaceProperties(shape, area, 1e-11);
  BRepGProp::VolumeProperties(shape, volume, 1e-11);
  const geometry::MassProperties own = measure(*body);
  EXPECT_NEAR(area.Mass(), own.area.value, 1e-9 * own.area.value);
  EXPECT_NEAR(volume.Mass(), own.volume.value, 1e-9 * own.volume.value);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, StepElementary,
    testing::Values(
        Elementary{"plate",
                   "  b: { type: extrusion_body, of: [{ type: rectangle, size: [4, 3], corner_radius: 0.5 }, "
                   "{ type: circle, radius: 0.6 }], along: [0, 0, 1] }\n",
                   {{GeomAbs_Plane, 6}, {GeomAbs_Cylinder, 5}}},
        Elementary{"plate_mirrored",
                   "  b: { type: extrusion_body, of: { type: rectangle, size: [4, 3], corner_radius: 0.5 }, "
                   "along: [0, 0, 1], transform: { mirror: x } }\n",
                   {{GeomAbs_Plane, 6}, {GeomAbs_Cylinder, 4}}},
        Elementary{"drafted",
                   "  b: { type: extrusion_body, of: { type: rectangle, size: [4, 3], corner_radius: 0.5 }, "
                   "along: [0, 0, 1], draft: 10 }\n",
                   {{GeomAbs_Plane, 6}, {GeomAbs_Cone, 4}}},
        Elementary{"ring",
                   "  b: { type: revolution_body, of: { type: rectangle, size: [1, 0.6], center: [2, 0], "
                   "corner_radius: 0.2 }, axis: y }\n",
                   {{GeomAbs_Plane, 2}, {GeomAbs_Cylinder, 2}, {GeomAbs_Torus, 4}}},
        Elementary{"tyre",
                   "  b: { type: revolution_body, of: { type: circle, radius: 0.6, center: [2, 0, 0] }, axis: y }\n",
                   {{GeomAbs_Torus, 1}}},
        Elementary{"sector",
                   "  b: { type: revolution_body, of: { type: circle, radius: 0.6, center: [2, 0, 0] }, axis: y, "
                   "angle: 100 }\n",
                   {{GeomAbs_Plane, 2}, {GeomAbs_Torus, 1}}},
        Elementary{"bulb",
                   "  b: { type: revolution_body, of: { type: circle, radius: 2, arc: [-90, 90] }, axis: y }\n",
                   {{GeomAbs_Sphere, 1}}},
        Elementary{"cone",
                   "  b: { type: revolution_body, of: { type: segment, from: [0, 2, 0], to: [1, 0, 0] }, axis: y }\n",
                   {{GeomAbs_Plane, 1}, {GeomAbs_Cone, 1}}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Step, OtherSweepsKeepTheirSections) {
  const auto kind_of = [](const std::string& geometry) {
    const TopoDS_Shape shape = tests::read_step(step_file({{"b", body_of(geometry), {}, {}}}, "b", "mm", 1e-9).text);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    std::map<GeomAbs_SurfaceType, int> faces;
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
      ++faces[BRepAdaptor_Surface(TopoDS::Face(it.Current())).GetType()];
    return faces;
  };
  using Faces = std::map<GeomAbs_SurfaceType, int>;
  const Faces extruded{{GeomAbs_Plane, 2}, {GeomAbs_SurfaceOfExtrusion, 1}};
  EXPECT_EQ(kind_of("  b: { type: extrusion_body, of: { type: circle, radius: 1 }, along: [0.4, 0, 1] }\n"), extruded);
  EXPECT_EQ(kind_of("  b: { type: extrusion_body, of: { type: ellipse, semi_axes: [2, 1] }, along: [0, 0, 1] }\n"),
            extruded);
  const Faces vase{{GeomAbs_SurfaceOfRevolution, 1}};
  EXPECT_EQ(kind_of("  b: { type: revolution_body, of: { type: bezier_curve, points: [[0, 0, 0], [2, 0.1, 0], "
                    "[1, 2, 0], [0, 3, 0]] }, axis: y }\n"),
            vase);
}

// A sheet is an open shell; a curve keeps its length.
TEST(Step, SheetsAndCurves) {
  geometry::Frame frame;
  const geometry::SurfacePtr surface = std::make_shared<geometry::Plane>(frame, geometry::Rectangle{{0, 2}, {0, 3}});
  const TopoDS_Shape sheet = tests::read_step(step_file({{"s", surface, {}, {}}}, "s", "mm", 1e-9).text);
  EXPECT_EQ(count(sheet, TopAbs_SOLID), 0);
  GProp_GProps area;
  BRepGProp::SurfaceProperties(sheet, area, 1e-9);
  EXPECT_NEAR(area.Mass(), 6, 1e-9);
  const geometry::CurvePtr arc = std::make_shared<geometry::Circle>(frame, 2.0, geometry::Interval{0.3, 1.7});
  const TopoDS_Shape edge = tests::read_step(step_file({{"c", arc, {}, {}}}, "c", "m", 1e-9).text);
  GProp_GProps length;
  BRepGProp::LinearProperties(edge, length);
  EXPECT_NEAR(length.Mass(), 2000 * 1.4, 1e-6);  // OCCT reads in millimetres
}

TEST(Step, WhatHasNoBoundaryIsLeftOut) {
  EXPECT_THROW(step_file({{"m", std::make_shared<const geometry::Mesh>(), {}, {}}}, "", "mm", 1e-9),
               std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::render::step_test
