// Styles and their order of precedence (built-in, named, object, inline), lines, helpers and legends of objects. What
// is expected follows from the scene's own text; widths of built-in styles are those of ISO 128-2; one point is 1/72
// inch.
#include "render/model/styles.h"

#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::styles_test {
namespace {

Model model(const std::string& text) {
  BuiltText result = build_text("lights: {}\n" + text);
  EXPECT_EQ(result.said, "") << text;
  return std::move(result.model);
}
std::string said(const std::string& text) { return build_text("lights: {}\n" + text).said; }
std::string hints(const std::string& text) { return build_text("lights: {}\n" + text).hints; }

const std::string kCurve = "geometry: { r: { type: bezier_curve, points: [[0, 0], [1, 3], [4, 2]] } }\n";

TEST(Styles, BuiltInOnesAreThere) {
  const Model m = model("");
  for (const char* name :
       {"thick", "thin", "hairline", "hidden", "axis", "construction", "dimension", "label", "ray"}) {
    ASSERT_EQ(m.styles.count(name), 1u) << name;
    EXPECT_TRUE(is_built_in_style(name));
    EXPECT_EQ(m.styles.at(name).name, name);
  }
  EXPECT_EQ(m.styles.size(), 9u);
  EXPECT_DOUBLE_EQ(m.styles.at("thick").width, 0.5);
  EXPECT_DOUBLE_EQ(m.styles.at("thin").width, 0.25);
  EXPECT_TRUE(m.styles.at("thin").dash.empty());
  EXPECT_EQ(m.styles.at("axis").dash.size(), 4u);
  EXPECT_EQ(m.styles.at("dimension").arrows, "both");
}

TEST(Styles, LikeAndChangesOfBuiltInOnes) {
  const Model m = model(
      "styles:\n"
      "  thick: { width: 0.72 pt }\n"  // changed everywhere, field by field
      "  axis: { color: red }\n"
      "  thin: { like: thick, opacity: 0.5 }\n"  // replaced
      "  net: { like: construction, width: 2 px, marker: ball, fill: white, font: sans }\n"
      "  cycling: { like: net, color: cycle, dash: solid }\n");
  EXPECT_DOUBLE_EQ(m.styles.at("thick").width, 0.254);
  EXPECT_EQ(m.styles.at("axis").dash.size(), 4u);
  EXPECT_EQ(m.styles.at("axis").color, geometry::Vec3(1, 0, 0));
  EXPECT_DOUBLE_EQ(m.styles.at("thin").width, 0.254);
  EXPECT_EQ(m.styles.at("thin").opacity, 0.5);
  EXPECT_DOUBLE_EQ(m.styles.at("net").width, 2 * 25.4 / 96);
  EXPECT_EQ(m.styles.at("net").color, m.styles.at("construction").color);
  EXPECT_EQ(m.styles.at("net").fill, geometry::Vec3(1));
  EXPECT_TRUE(m.styles.at("cycling").cycles);
  EXPECT_EQ(m.styles.at("cycling").marker, "ball");
}

TEST(Styles, Errors) {
  const auto style = [](const std::string& fields) { return said("styles:\n  a: " + fields + "\n"); };
  EXPECT_EQ(style("{ widht: 1 mm }"), "4:8 unknown field 'widht' of a style (did you mean 'width'?)\n");
  EXPECT_EQ(style("{ type: style }"), "4:8 unknown field 'type' of a style\n");
  EXPECT_EQ(style("{ width: 0.5 }"), "4:15 the length '0.5' on the page has no unit\n");
  EXPECT_EQ(style("{ width: -1 mm }"), "4:15 expected a length greater than 0 and at most 50 mm, found -1 mm\n");
  EXPECT_EQ(style("{ opacity: 1.5 }"), "4:17 expected a value between 0 and 1, found 1.5\n");
  EXPECT_EQ(style("{ opacity: 0/0 }"), "4:17 the formula has no finite value (not a number)\n");
  EXPECT_EQ(style("{ marker: bal }"), "4:16 unknown word 'bal' (did you mean 'ball'?)\n");
  EXPECT_EQ(style("{ color: cycel }"), "4:15 unknown colour 'cycel' (did you mean 'cycle'?)\n");
  EXPECT_EQ(style("{ dash: [1 mm] }"), "4:14 expected at least 2 values, found 1\n");
  EXPECT_EQ(style("{ dash: [1 mm, 1 mm, 1 mm] }"), "4:14 lengths drawn and left out come in pairs\n");
  EXPECT_EQ(style("{ dash: [0 mm, 0 mm] }"), "4:14 dashes without any length\n");
  EXPECT_EQ(style("{ like: thik }"), "4:14 there is nothing called 'thik' to be like (did you mean 'thick'?)\n");
  EXPECT_EQ(style("7"), "4:6 expected a style as a map of fields, found a single value\n");
  EXPECT_EQ(said("styles: [a]\n"), "3:9 'styles' is a map of named things\n");
}

TEST(Lines, WhatIsGivenIsDrawn) {
  const Model m = model(kCurve +
                        "styles: { net: { like: thin, color: red } }\n"
                        "objects:\n"
                        "  - shape: [{ type: sphere_surface, radius: 1 }, r]\n"
                        "    lines:\n"
                        "      boundary: net\n"
                        "      silhouette: { width: 0.7 mm }\n"  // changes `thick`
                        "      curve: { like: axis, opacity: 0.5 }\n"
                        "      parameter: { at_u: 9, at_v: [0, 0.5, 1], style: { color: blue } }\n"
                        "      section: { planes: { normal: x } }\n"
                        "      intersection: { with: { type: ball, radius: 2 }, style: hairline }\n"
                        "      hidden: faded\n"
                        "  - { shape: r, lines: {} }\n"
                        "  - { shape: r, lines: { hidden: hairline } }\n"
                        "  - { shape: r }\n"
                        "  - { shape: r, lines: { curve: { hidden: thin } } }\n");
  ASSERT_EQ(m.objects.size(), 6u);
  const Lines& lines = *m.objects[0].look->lines;
  EXPECT_EQ(lines.styles.size(), 6u);
  EXPECT_EQ(lines.styles.at("boundary").name, "net");
  EXPECT_EQ(lines.styles.at("boundary").color, geometry::Vec3(1, 0, 0));
  EXPECT_DOUBLE_EQ(lines.styles.at("silhouette").width, 0.7);
  EXPECT_EQ(lines.styles.at("curve").dash.size(), 4u);
  EXPECT_EQ(lines.styles.at("curve").opacity, 0.5);
  EXPECT_EQ(lines.styles.at("parameter").color, geometry::Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(lines.styles.at("parameter").width, 0.13);
  EXPECT_EQ(lines.at_u.count, 9);
  EXPECT_EQ(lines.at_v.values, (std::vector<double>{0, 0.5, 1}));
  ASSERT_EQ(lines.planes.size(), 1u);
  EXPECT_EQ(lines.planes[0].normal, geometry::Vec3(1, 0, 0));
  EXPECT_EQ(lines.with.size(), 1u);
  EXPECT_EQ(lines.hidden.way, HiddenLines::Way::faded);
  EXPECT_TRUE(m.objects[2].look->lines->styles.empty());
  EXPECT_EQ(m.objects[3].look->lines->hidden.way, HiddenLines::Way::styled);
  EXPECT_EQ(m.objects[3].look->lines->hidden.style.name, "hairline");
  // What becomes of a kind's hidden lines may be said without their style.
  EXPECT_EQ(m.objects[5].look->lines->styles.at("curve").name, "thick");
  EXPECT_EQ(m.objects[5].look->lines->own_hidden.at("curve").way, HiddenLines::Way::thin);
  // Without lines of its own an object has those of the drawing.
  EXPECT_EQ(m.objects[4].look, nullptr);
  EXPECT_EQ(m.drawing.lines.styles.size(), 4u);
  EXPECT_EQ(m.drawing.lines.styles.at("curve").name, "thick");
}

TEST(Lines, Errors) {
  const auto lines = [](const std::string& fields) {
    return said(kCurve + "objects:\n  - shape: [r, { type: sphere_surface, radius: 1 }]\n    lines: " + fields + "\n");
  };
  EXPECT_EQ(lines("{ curve: thik }"), "6:21 there is no style called 'thik' (did you mean 'thick'?)\n");
  EXPECT_EQ(lines("{ curv: thick }"), "6:14 unknown field 'curv' of 'lines' (did you mean 'curve'?)\n");
  EXPECT_EQ(lines("{ hidden: dashd }"), "6:22 unknown word 'dashd' (did you mean 'dashed'?)\n");
  EXPECT_EQ(lines("{ parameter: { style: thin } }"), "6:25 parameter lines need 'at_u' or 'at_v'\n");
  EXPECT_EQ(lines("{ parameter: { at_u: 0 } }"), "6:33 expected a count between 1 and 10000, found 0\n");
  EXPECT_EQ(lines("{ parameter: { at_u: 2.5 } }"), "6:33 expected a whole number, found 2.5\n");
  EXPECT_EQ(lines("{ parameter: { at_u: [0, 0/0] } }"), "6:37 the formula has no finite value (not a number)\n");
  // The sphere's u goes round, its v from pole to pole.
  EXPECT_EQ(lines("{ parameter: { at_u: [0, 540 deg], at_v: [0, 100 deg] } }"),
            "6:57 v = 100 deg lies outside of the shapes\n");
  EXPECT_EQ(lines("{ parameter: { at_v: 1..2 } }"), "6:33 v = 2 lies outside of the shapes\n");
  EXPECT_EQ(lines("{ curve: { width: 0 mm } }"),
            "6:30 expected a length greater than 0 and at most 50 mm, found 0 mm\n");
  EXPECT_EQ(lines("{ section: { planes: [] } }"), "6:33 expected at least 1 value, found 0\n");
  EXPECT_EQ(lines("{ section: {} }"), "6:23 missing field 'planes' of 'section'\n");
  EXPECT_EQ(lines("thick"), "6:12 expected a map of fields, found a single value\n");
}

TEST(Helpers, OfTheTypeOfTheShape) {
  const Model m =
      model(kCurve +
            "parameters: { t0: 0.4 }\n"
            "objects:\n"
            "  - shape: r\n"
            "    show:\n"
            "      control_polygon: { style: thin, marker: dot, label: '$\\mathbf{p}_%i$', hidden: faded }\n"
            "      de_casteljau: { t: t0, marker: circle, levels: 1..2, label: '$p_%i^{(%k)}$' }\n"
            "      comb: {}\n"
            "  - { shape: { type: circle, radius: 1 }, show: [frames, comb] }\n"
            "  - { shape: { type: sphere_surface, radius: 1 }, show: normals }\n");
  const std::vector<Helper>& helpers = m.objects[0].look->helpers;
  ASSERT_EQ(helpers.size(), 3u);
  EXPECT_EQ(helpers[0].type, "control_polygon");
  EXPECT_EQ(helpers[0].style.name, "thin");
  EXPECT_EQ(helpers[0].hidden.way, HiddenLines::Way::faded);
  EXPECT_EQ(helpers[1].values.number("t"), 0.4);
  EXPECT_EQ(helpers[1].values.numbers("levels"), (std::vector<double>{1, 2}));
  const double place[] = {1, 2};
  EXPECT_EQ(helpers[1].values.get<TextTemplate>("label").text(place), "$p_1^{(2)}$");
  EXPECT_EQ(helpers[2].values.integer("count"), 60);
  EXPECT_EQ(m.objects[1].look->helpers.size(), 2u);
  EXPECT_EQ(m.objects[2].look->helpers.at(0).values.get<geometry::ParameterValues>("at_u").count, 5);
}

TEST(Helpers, Errors) {
  const auto show = [](const std::string& text) { return kCurve + "objects:\n  - shape: r\n    show: " + text + "\n"; };
  EXPECT_EQ(said(show("{ control_poligon: {} }")),
            "6:13 'bezier_curve' has no helper 'control_poligon' (did you mean 'control_polygon'?)\n");
  EXPECT_EQ(hints(show("{ control_net: {} }")),
            "it has control_polygon, de_casteljau, comb, frames, osculating_circle, evolute, tangents, normal_lines, "
            "features, "
            "hodograph, direction, colored, jumps, insertion, elevation, hulls, moved_point, crossings\n");
  EXPECT_EQ(said(show("[comb, knots]")), "6:18 'bezier_curve' has no helper 'knots'\n");
  EXPECT_EQ(said(show("{ comb: { cuont: 3 } }")), "6:21 unknown field 'cuont' of 'comb' (did you mean 'count'?)\n");
  EXPECT_EQ(said(show("{ comb: thin }")), "6:19 expected a map of fields for 'comb', found a single value\n");
  EXPECT_EQ(said(show("{ de_casteljau: { u: 0.5 } }")),
            "6:27 de Casteljau's construction on a curve needs 't' alone\n");
  EXPECT_EQ(said(show("{ de_casteljau: { t: 0.5, levels: [0.5] } }")), "6:46 expected a value at least 1, found 0.5\n");
  EXPECT_EQ(said(show("{ de_casteljau: { t: 0.5, levels: [1.5] } }")), "6:45 levels are whole numbers\n");
  EXPECT_EQ(said("objects: [{ shape: { type: ball, radius: 1 }, show: { comb: {} } }]\n"),
            "3:55 'ball' has no helper 'comb'\n");
  // What it would need does not matter where there is none.
  EXPECT_EQ(said("objects: [{ shape: { type: ball, radius: 1 }, show: { de_casteljau: { t: 0.5 } } }]\n"),
            "3:55 'ball' has no helper 'de_casteljau'\n");
  // Whatever else is wrong with the object.
  EXPECT_EQ(said(kCurve + "objects: { shape: r, colour: red, show: { control_poligon: {} } }\n"),
            "4:22 unknown field 'colour' of an object\n"
            "4:43 'bezier_curve' has no helper 'control_poligon' (did you mean 'control_polygon'?)\n");
  EXPECT_EQ(said(kCurve + "objects: { shape: q, show: [control_net, control_nett] }\n"),
            "4:19 there is no geometry called 'q'\n"
            "4:42 there is no helper 'control_nett' (did you mean 'control_net'?)\n");
}

TEST(Legend, NumbersTheMembersOfAFamily) {
  const Model m = model(
      "geometry: { f: { repeat: { k: 3..5 }, type: circle, radius: k } }\n"
      "objects: [{ shape: f, legend: '$N_%i^3$' }, { shape: f.0 }]\n");
  EXPECT_EQ(m.objects.at(1).legend, "$N_1^3$");
  EXPECT_EQ(m.objects.at(3).legend, "");
}

}  // namespace
}  // namespace lekalo::render::styles_test
