// The sections drawing, panels, layout and outputs, annotations, graphs. What is expected follows from the scene's own
// text.
#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::drawing_sections_test {
namespace {

using geometry::Anchor;
using geometry::Vec3;

Model model(const std::string& text) {
  BuiltText result = build_text("lights: {}\n" + text);
  EXPECT_EQ(result.said, "") << text;
  return std::move(result.model);
}
std::string said(const std::string& text) { return build_text("lights: {}\n" + text).said; }

const std::string kGeometry =
    "geometry: { l: { type: segment, from: [0, 0], to: [4, 0] }, b: { type: ball, radius: 1 }, c: { type: circle, "
    "radius: 2 } }\n";

// One annotation, in line 6; its map begins in column 7.
std::string scene_with(const std::string& annotation) {
  return kGeometry + "drawing:\n  annotations:\n    - " + annotation + "\n";
}
Annotation annotation(const std::string& text) { return model(scene_with(text)).drawing.annotations.at(0); }
std::string about(const std::string& annotation) { return said(scene_with(annotation)); }

TEST(Drawing, PageWideChoices) {
  const Model m = model(
      "camera: { type: graph }\n"
      "styles: { net: { like: thin } }\n"
      "drawing:\n"
      "  ground: shaded\n"
      "  paper: '#000'\n"
      "  lines: { sharp: net, hidden: dashed }\n"
      "  axes:\n"
      "    x: { label: '$t$', ticks: 0..3 }\n"
      "    y: { label: '$N$', ticks: [0, 0.5, 1], grid: true }\n"
      "  legend: { side: above right, title: Basis }\n");
  EXPECT_EQ(m.drawing.ground, Ground::shaded);
  EXPECT_EQ(m.drawing.paper, Vec3(0));
  EXPECT_EQ(m.drawing.lines.styles.size(), 1u);
  EXPECT_EQ(m.drawing.lines.hidden.way, HiddenLines::Way::dashed);
  EXPECT_EQ(m.drawing.axes->x->tick_values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_FALSE(m.drawing.axes->x->grid);
  EXPECT_EQ(m.drawing.axes->y->label.text(), "$N$");
  EXPECT_TRUE(m.drawing.axes->y->grid);
  EXPECT_EQ(m.drawing.legend->side, "above right");
  EXPECT_EQ(m.drawing.legend->title->text(), "Basis");
}

TEST(Drawing, Errors) {
  EXPECT_EQ(said("drawing: { grund: fill }\n"), "3:12 unknown field 'grund' of 'drawing' (did you mean 'ground'?)\n");
  EXPECT_EQ(said("drawing: { ground: shade }\n"), "3:20 unknown word 'shade' (did you mean 'shaded'?)\n");
  EXPECT_EQ(said("drawing: { lines: { parameter: {} } }\n"), "3:32 parameter lines need 'at_u' or 'at_v'\n");
  EXPECT_EQ(said("drawing: { axes: { x: { ticks: many } } }\ncamera: { type: graph }\n"), "3:32 unknown name 'many'\n");
  EXPECT_EQ(said("drawing: { legend: { side: rigth } }\n"), "3:28 unknown word 'rigth' (did you mean 'right'?)\n");
  EXPECT_EQ(said("drawing: 3\n"), "3:10 'drawing' is a map of fields, found a single value\n");
}

TEST(Annotations, PlacesAreEvaluated) {
  const Annotation label = annotation("{ type: label, at: { of: l, t: 0.25 }, text: '$x$', side: below right }");
  EXPECT_EQ(label.type, "label");
  EXPECT_EQ(label.values.get<Anchor>("at").point, Vec3(1, 0, 0));
  EXPECT_FALSE(label.values.get<Anchor>("at").on_page);
  EXPECT_EQ(label.values.text("side"), "below right");
  EXPECT_EQ(label.style.name, "label");
  const Annotation corner = annotation("{ type: axes, at: { page: [5 mm, 72 pt] }, length: 2 }");
  EXPECT_TRUE(corner.values.get<Anchor>("at").on_page);
  EXPECT_NEAR(corner.values.get<Anchor>("at").point.y, 25.4, 1e-14);
  EXPECT_EQ(corner.style.arrows, "end");
  const Annotation arrow = annotation(
      "{ type: arrow, from: [1, 2], along: { of: c, t: 0, vector: tangent }, length: 1, style: { color: red } }");
  EXPECT_EQ(arrow.values.vec3("along"), Vec3(0, 1, 0));
  EXPECT_EQ(arrow.style.arrows, "end");  // the default style, changed
  EXPECT_EQ(arrow.style.color, Vec3(1, 0, 0));
  const Annotation dimension =
      annotation("{ type: linear_dimension, from: [0, 0], to: [1, 1], along: x, offset: -12 mm }");
  EXPECT_EQ(dimension.values.number("offset"), -12);
  EXPECT_EQ(dimension.style.name, "dimension");
  const Annotation path = annotation("{ type: light_path, from: [0, 0], along: y, wavelength: 633 nm }");
  EXPECT_EQ(path.values.number("wavelength"), 633);
  const Annotation leader = annotation("{ type: diameter_dimension, of: c, prefix: '12 × ', leader: 30 deg }");
  EXPECT_DOUBLE_EQ(leader.values.number("leader"), geometry::kPi / 6);
}

TEST(Annotations, EveryTypeFromItsShortestForm) {
  for (const char* text :
       {"{ type: point, at: [0, 0] }", "{ type: frame }", "{ type: axes }",
        "{ type: angle, at: [0, 0], from: [1, 0], to: [0, 1] }", "{ type: leader, at: [0, 0], to: [1, 1], text: a }",
        "{ type: brace, from: [0, 0], to: [1, 0] }", "{ type: linear_dimension, from: [0, 0], to: [1, 0] }",
        "{ type: radius_dimension, of: c }", "{ type: angle_dimension, at: [0, 0], from: [1, 0], to: [0, 1] }",
        "{ type: knots, of: c }", "{ type: light_path, from: [0, 0], to: [1, 0] }"})
    EXPECT_EQ(about(text), "") << text;
}

TEST(Annotations, RepeatsMakeSeveral) {
  const Model m = model(scene_with("{ repeat: { h: [-7.5, 0, 7.5] }, type: label, at: [h, 0], text: '%(h)' }"));
  ASSERT_EQ(m.drawing.annotations.size(), 3u);
  EXPECT_EQ(m.drawing.annotations[0].values.get<TextTemplate>("text").text(), "-7.5");
  EXPECT_EQ(m.drawing.annotations[2].values.get<Anchor>("at").point.x, 7.5);
}

// Radii of what is a circle in some other form, and of nothing else.
TEST(Annotations, RadiiAreOfRoundThings) {
  const auto of = [](const std::string& thing) { return about("{ type: radius_dimension, of: " + thing + " }"); };
  for (const char* round :
       {"{ type: circle, radius: 2, arc: [0, 90] }", "{ type: arc_through_points, points: [[0, 0], [1, 1], [3, 1]] }",
        "{ type: ellipse, semi_axes: [2, 2] }",
        "{ type: bezier_curve, points: [[1, 0], [1, 1], [0, 1]], weights: [1, sqrt(0.5), 1] }",
        "{ type: circle, radius: 1, transform: [{ scale: 3 }, { rotate: 20, axis: y }] }",
        "{ type: sphere_surface, radius: 1 }", "{ type: cylinder_surface, radius: 1 }",
        "{ type: cone_surface, radius: 1, height: 2 }", "{ type: torus_surface, major_radius: 2, minor_radius: 1 }",
        "{ type: ellipsoid, semi_axes: [2, 2, 1] }", "{ type: extrusion_surface, of: c, along: [0, 0, 1] }",
        "{ type: revolution_surface, of: { type: segment, from: [1, 0, 0], to: [2, 0, 3] }, axis: z }"})
    EXPECT_EQ(of(round), "") << round;
  for (const char* other : {"{ type: segment, from: [0, 0], to: [1, 0] }", "{ type: ellipse, semi_axes: [2, 1] }",
                            "{ type: polyline, points: [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 0]] }",
                            "{ type: bezier_curve, points: [[1, 0], [1, 1], [0, 1]] }",
                            "{ type: circle, radius: 1, transform: { scale: [1, 2, 1] } }",
                            "{ type: plane, size: [1, 1] }", "{ type: ellipsoid, semi_axes: [3, 2, 1] }",
                            "{ type: hyperbolic_paraboloid, semi_axes: [1, 1], domain: { u: [-1, 1], v: [-1, 1] } }"})
    EXPECT_EQ(of(other), "6:37 this is not round: it has no radius\n") << other;
  EXPECT_EQ(about("{ type: diameter_dimension, of: { type: segment, from: [0, 0], to: [1, 0] } }"),
            "6:39 this is not round: it has no radius\n");
}

// What is written out with no size is a mistake; what gets there by names and formulas is left out of the drawing.
TEST(Annotations, OfNoSize) {
  for (const char* type : {"arrow", "brace"})
    EXPECT_EQ(
        about(std::string("{ type: ") + type + ", to: [1, 0], from: [1, 0] }"),
        std::string("6:26 ") + (type[0] == 'a' ? "an arrow" : "a brace") + " ends where it begins: it has no length\n");
  EXPECT_EQ(about("{ type: linear_dimension, from: [1, 0], to: [1, 0] }"),
            "6:51 a dimension ends where it begins: it has no length\n");
  EXPECT_EQ(about("{ type: linear_dimension, from: [1, 0], to: [2, 0], along: y }"),
            "6:66 the two points lie side by side in this direction: there is nothing to measure\n");
  for (const char* type : {"angle", "angle_dimension"}) {
    const std::string begin = std::string("{ type: ") + type + ", at: [1, 0], ";
    const auto place = [&](size_t more) { return "6:" + std::to_string(7 + begin.size() + more); };
    EXPECT_EQ(about(begin + "from: [1, 0], to: [2, 0] }"),
              place(6) + " this side of the angle has no length: the point is the apex\n");
    EXPECT_EQ(about(begin + "from: [2, 0], to: [1, 0] }"),
              place(18) + " this side of the angle has no length: the point is the apex\n");
    EXPECT_EQ(about(begin + "from: [2, 0], to: [7, 0] }"),
              place(18) + " both sides of the angle go the same way: it is 0\n");
    EXPECT_EQ(about(begin + "from: [2, 0], to: [-7, 0] }"), "");
  }
  EXPECT_EQ(about("{ type: arrow, from: [0, 0], to: { of: l, t: 0 } }"), "");
  EXPECT_EQ(about("{ repeat: { k: 0..2 }, type: arrow, from: [0, 0], to: [k, 0] }"), "");
}

TEST(Annotations, Errors) {
  EXPECT_EQ(about("{ type: labl, at: [0, 0], text: a }"), "6:15 unknown type 'labl' (did you mean 'label'?)\n");
  EXPECT_EQ(about("{ at: [0, 0], text: a }"), "6:7 missing 'type' of an annotation\n");
  EXPECT_EQ(about("label"), "6:7 expected an annotation as a map with a type, found a single value\n");
  EXPECT_EQ(about("{ type: circle, radius: 1 }"), "6:15 'circle' makes a curve, but an annotation is wanted here\n");
  EXPECT_EQ(about("{ type: label, at: [0, 0] }"), "6:7 missing field 'text' of 'label'\n");
  EXPECT_EQ(about("{ type: label, at: nowhere, text: a }"), "6:26 there is no geometry called 'nowhere'\n");
  EXPECT_EQ(about("{ type: label, at: b, text: a }"), "6:26 'b' is a body, but a point is wanted here\n");
  EXPECT_EQ(about("{ type: label, at: [0, 0], text: a, side: abve }"),
            "6:49 unknown word 'abve' (did you mean 'above'?)\n");
  EXPECT_EQ(about("{ type: label, at: { page: [5, 8 mm] }, text: a }"),
            "6:35 the length '5' on the page has no unit\n");
  EXPECT_EQ(about("{ type: label, at: { page: [5 mm] }, text: a }"), "6:34 a place on the page has two lengths\n");
  EXPECT_EQ(about("{ type: label, at: { page: [5 mm, 1 mm], t: 0 }, text: a }"),
            "6:48 unknown field 't' of a place on the page\n");
  EXPECT_EQ(about("{ type: arrow, from: [0, 0] }"), "6:7 an arrow has either 'to' or 'along' and 'length'\n");
  EXPECT_EQ(about("{ type: arrow, from: [0, 0], to: [1, 0], along: x }"),
            "6:55 an arrow has either 'to' or 'along' and 'length'\n");
  EXPECT_EQ(about("{ type: arrow, from: [0, 0], along: x }"), "6:43 'along' needs 'length'\n");
  EXPECT_EQ(about("{ type: arrow, from: [0, 0], to: [1, 0], length: 2 }"), "6:56 'length' goes with 'along'\n");
  EXPECT_EQ(about("{ type: angle_dimension, at: { page: [0 mm, 0 mm] }, from: [1, 0], to: [0, 1] }"),
            "6:36 a dimension measures the model, not the page\n");
  EXPECT_EQ(about("{ type: linear_dimension, from: { page: [0 mm, 0 mm] }, to: [1, 0] }"),
            "6:39 a dimension measures the model, not the page\n");
  EXPECT_EQ(about("{ type: linear_dimension, from: [0, 0], to: [1, 0], offset: 5 }"),
            "6:67 the length '5' on the page has no unit\n");
  EXPECT_EQ(about("{ type: radius_dimension, of: b }"), "");  // a ball is round
  EXPECT_EQ(about("{ type: radius_dimension, of: c, text: a, prefix: b }"),
            "6:57 'text' stands instead of the number: there is nothing for 'prefix'\n");
  EXPECT_EQ(about("{ type: light_path, from: [0, 0], along: x, wavelength: 0.589 }"),
            "6:63 expected a value between 360 and 830 nm, found 0.589\n");
  EXPECT_EQ(about("{ type: light_path, from: [0, 0] }"), "6:7 a light path has either 'to' or 'along'\n");
}

const std::string kPanels =
    "panels:\n"
    "  top: { camera: { view: top }, drawing: { annotations: { type: point, at: [0, 0] } } }\n"
    "  front: { like: top, camera: { view: front }, objects: [{ shape: b }] }\n";

TEST(Panels, ViewsOfOnePage) {
  const Model m = model(kGeometry + "objects: [{ shape: c }]\ndrawing: { ground: fill }\n" + kPanels +
                        "layout: { rows: [[front], [top, empty]], scale: 1/2, gap: 12 mm }\n"
                        "outputs: [a.pdf, { file: top.svg, panel: top, width: 80 mm }]\n");
  ASSERT_EQ(m.panels.size(), 2u);
  const Panel &top = m.panels[0], &front = m.panels[1];  // in the order of the scene
  EXPECT_EQ(front.name, "front");
  ASSERT_TRUE(front.objects);
  EXPECT_NE(front.objects->at(0).material, nullptr);
  EXPECT_FALSE(top.objects);
  EXPECT_EQ(top.camera->view_direction(), Vec3(0, 0, -1));
  EXPECT_EQ(front.camera->view_direction(), Vec3(0, 1, 0));
  // What a panel's drawing does not say the scene's drawing does.
  EXPECT_EQ(top.drawing.ground, Ground::fill);
  EXPECT_EQ(top.drawing.annotations.size(), 1u);
  EXPECT_TRUE(m.drawing.annotations.empty());
  EXPECT_EQ(m.layout.rows, (std::vector<std::vector<std::string>>{{"front"}, {"top", ""}}));
  EXPECT_EQ(m.layout.scale, 0.5);
  EXPECT_EQ(m.layout.gap, 12);
  EXPECT_EQ(m.outputs.at(1).panel, "top");
  EXPECT_EQ(m.outputs.at(1).width, 80);
}

TEST(Panels, WithoutALayoutTheyStandInARow) {
  const Model m = model(kGeometry + kPanels);
  EXPECT_EQ(m.layout.rows, (std::vector<std::vector<std::string>>{{"top", "front"}}));
  EXPECT_EQ(m.layout.scale, 0);
}

TEST(Panels, Errors) {
  const auto layout = [](const std::string& text) { return said(kGeometry + kPanels + "layout: " + text + "\n"); };
  EXPECT_EQ(layout("{ rows: [[top, side]] }"), "7:24 there is no panel called 'side'\n");
  EXPECT_EQ(layout("{ rows: [[top], [top]] }"), "7:26 the panel 'top' stands here twice\n");
  EXPECT_EQ(layout("{ rows: [top, front] }"), "7:18 expected a row of names, found a single value\n");
  EXPECT_EQ(layout("{ rows: [] }"), "7:17 expected rows of names\n");
  EXPECT_EQ(layout("{ rows: [[top]], scale: 0 }"), "7:33 expected a value greater than 0, found 0\n");
  EXPECT_EQ(layout("{ gap: 3 mm }"), "7:9 missing field 'rows' of 'layout'\n");
  EXPECT_EQ(said(kGeometry + "panels:\n  a: { camra: { view: top } }\n"),
            "5:8 unknown field 'camra' of a panel (did you mean 'camera'?)\n");
  EXPECT_EQ(said(kGeometry + "panels:\n  a: { camera: { view: tpo } }\n"),
            "5:24 unknown word 'tpo' (did you mean 'top'?)\n");
  EXPECT_EQ(said(kGeometry + "panels: { a: { objects: [{ shape: z }] } }\n"), "4:35 there is no geometry called 'z'\n");
  EXPECT_EQ(said("outputs: [{ file: a.pdf, panel: side }]\n"), "3:33 there is no panel called 'side'\n");
}

TEST(Outputs, FieldsBelongToTheirKind) {
  EXPECT_EQ(said("outputs: [{ file: a.exr, width: 5 mm }]\n"), "3:33 'width' is for drawings\n");
  EXPECT_EQ(said("outputs: [{ file: a.pdf, exposure: 1 }]\n"), "3:36 'exposure' is for rendered png files\n");
  EXPECT_EQ(said("outputs: [{ file: a.exr, kind: drawing }]\n"), "3:32 'a.exr' is always a render\n");
  EXPECT_EQ(said("outputs: [{ file: a.pdf, width: -5 mm }]\n"),
            "3:33 expected a length greater than 0 and at most 5000 mm, found -5 mm\n");
}

TEST(Graph, AxesNeedOne) {
  EXPECT_EQ(said(kGeometry + "drawing: { axes: { x: {} } }\n"),
            "4:12 'axes' belong to a graph, and this camera shows none\n");
  const std::string graph = "a: { camera: { type: graph } }", top = "b: { camera: { view: top } }";
  EXPECT_EQ(said(kGeometry + "panels: { " + top + " }\ndrawing: { axes: { x: {} } }\n"),
            "5:12 'axes' belong to a graph, and this camera shows none\n");
  EXPECT_EQ(said(kGeometry + "panels: { b: { camera: { view: top }, drawing: { axes: { x: {} } } } }\n"),
            "4:50 'axes' belong to a graph, and this camera shows none\n");
  // Those of a page are for its graphs.
  const Model m = model(kGeometry + "panels: { " + graph + ", " + top + " }\ndrawing: { axes: { x: {} } }\n");
  EXPECT_TRUE(m.panels.at(0).drawing.axes);
  EXPECT_FALSE(m.panels.at(1).drawing.axes);
}

TEST(Paper, SizeAndMarginInMillimetres) {
  const Model m = model("image: { size: [84 mm, 60 mm], margin: 2 mm }\n" + kGeometry);
  EXPECT_EQ(m.paper.width, 84);
  EXPECT_EQ(m.paper.height, 60);
  EXPECT_EQ(m.paper.margin, 2);
  EXPECT_DOUBLE_EQ(model("image: { size: [960, 480] }\n" + kGeometry).paper.height, 127);  // 480 / 96 inch
}

TEST(Graph, AxesAreScaledIndependently) {
  const Model m = model(kGeometry + "camera: { type: graph, x: [0, 6], y: [-1, 1] }\nimage: { size: [600, 100] }\n");
  const PicturePoint p = m.camera->project({1.5, 0.5, 7});
  EXPECT_DOUBLE_EQ(p.x, 150);
  EXPECT_DOUBLE_EQ(p.y, 25);
  const Ray ray = m.camera->ray(150, 25);
  EXPECT_DOUBLE_EQ(ray.origin.x, 1.5);
  EXPECT_DOUBLE_EQ(ray.origin.y, 0.5);
  EXPECT_EQ(ray.direction, Vec3(0, 0, -1));
  EXPECT_EQ(said("camera: { type: graph, x: [6, 0] }\n"), "3:27 a range must begin below its end\n");
  // Without ranges all is shown: the circle of radius 2.
  const Model all = model("objects: [{ shape: { type: circle, radius: 2 } }]\ncamera: { type: graph }\n");
  EXPECT_NEAR(all.camera->project({2, 0, 0}).x, all.camera->width(), 1e-9);
  // Then a side that is automatic is as long as the other.
  const Model square = model(
      "objects: [{ shape: { type: formula_curve, y: sin(x), domain: [0, 6] } }]\ncamera: { type: graph }\n"
      "image: { size: [80 mm, auto], margin: 5 mm }\n");
  EXPECT_NEAR(square.paper.height, 80, 1e-9);
  // To the summits between samples, and to corners: 2 (|x - 0.3| - 0.7) in (-1, 1).
  const Model summits = model(
      "geometry: { f: { type: formula_curve, y: abs(x - 0.3) - 0.7, domain: [-1, 1] } }\n"
      "objects: [{ shape: f, transform: { scale: [1, 2, 1] } }]\ncamera: { type: graph }\n");
  EXPECT_NEAR(summits.camera->project({0, 1.2, 0}).y, 0, 1e-9);
  EXPECT_NEAR(summits.camera->project({0, -1.4, 0}).y, summits.camera->height(), 1e-9);
}

// What is written out and shows nothing is a mistake; a parameter that goes round comes back.
TEST(Drawing, WhatShowsNothingIsExplained) {
  const auto said = [](const std::string& objects, const std::string& annotation) {
    return build_text(R"(geometry:
  c: { type: bezier_curve, points: [[0, 0, 0], [1, 1, 0], [2, 0, 0]] }
  ring: { type: circle, radius: 1 }
  s: { type: plane, domain: { u: [0, 1], v: [0, 1] } }
objects: [)" + objects +
                      "]\n" + (annotation.empty() ? "" : "drawing: { annotations: [" + annotation + "] }\n"))
        .said;
  };
  EXPECT_EQ(said("{ shape: s, lines: { parameter: { at_u: [0, 1] } } }", ""), "");
  EXPECT_NE(said("{ shape: s, lines: { parameter: { at_u: [5] } } }", "").find("u = 5 lies outside of the shape"),
            std::string::npos);
  EXPECT_NE(said("{ shape: c, show: { de_casteljau: { t: 1.5 } } }", "").find("t = 1.5 lies outside of the curve"),
            std::string::npos);
  EXPECT_NE(said("{ shape: s, lines: { section: { planes: [] } } }", "").find("at least 1 value"), std::string::npos);
  const std::string shape = "{ shape: s }";
  EXPECT_NE(said(shape, "{ type: arrow, from: [1, 2, 3], to: [1, 2, 3] }").find("it has no length"), std::string::npos);
  EXPECT_NE(said(shape, "{ type: angle, at: [0, 0, 0], from: [1, 0, 0], to: [2, 0, 0] }").find("it is 0"),
            std::string::npos);
  EXPECT_NE(said(shape, "{ type: point, at: { of: c, t: 1.5 } }").find("t = 1.5 lies outside of the curve"),
            std::string::npos);
  EXPECT_EQ(said(shape, "{ type: point, at: { of: ring, t: 7 } }"), "");
  EXPECT_EQ(said(shape, "{ type: arrow, from: [0, 0, 0], to: { of: c, t: 0 } }"), "");
}

}  // namespace
}  // namespace lekalo::render::drawing_sections_test
