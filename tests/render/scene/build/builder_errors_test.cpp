// What is said about wrong scenes, and where. The wordings are the product's own; that nothing else is said beside them
// is what these tests are for.
#include <gtest/gtest.h>

#include "render/scene/scene_text.h"

namespace lekalo::render::builder_errors_test {
namespace {

std::string said(const std::string& text) { return build_text(text).said; }
std::string hints(const std::string& text) { return build_text(text).hints; }

// One thing in `geometry`, in line 3; its map begins in column 6.
std::string about(const std::string& map) { return said("geometry:\n  a: " + map + "\n"); }

TEST(BuilderErrors, UnknownFieldsAreNamedWithTheNearest) {
  EXPECT_EQ(about("{ type: circle, radius: 1, raduis: 2 }"),
            "3:33 unknown field 'raduis' of 'circle' (did you mean 'radius'?)\n");
  EXPECT_EQ(about("{ type: ball, radius: 1, wobble: 2 }"), "3:31 unknown field 'wobble' of 'ball'\n");
  EXPECT_EQ(hints("geometry: { a: { type: ball, radius: 1, wobble: 2 } }"),
            "it has frame, radius, transform, like, center, normal, axis, type, repeat\n");
  EXPECT_EQ(about("{ type: ball, radius: 1, reversed: true }"), "3:31 unknown field 'reversed' of 'ball'\n");
  EXPECT_EQ(said("geometry: { p: [0, 0] }\nobjects:\n  - { shape: p, clips: 3 }"),
            "4:17 unknown field 'clips' of an object (did you mean 'clip'?)\n");
}

TEST(BuilderErrors, UnknownSections) {
  EXPECT_EQ(said("geometri: {}"), "2:1 unknown section 'geometri' (did you mean 'geometry'?)\n");
  EXPECT_EQ(said("geometri: { a: { type: ball, radius: r } }\nparameter: { r: 2 }\nobjects: [{ shape: a }]"),
            "2:1 unknown section 'geometri' (did you mean 'geometry'?)\n"
            "3:1 unknown section 'parameter' (did you mean 'parameters'?)\n")
      << "what stands in them is known all the same";
  EXPECT_EQ(said("geometri: { a: { type: ball, radios: 1 } }"),
            "2:1 unknown section 'geometri' (did you mean 'geometry'?)\n"
            "2:30 unknown field 'radios' of 'ball' (did you mean 'radius'?)\n")
      << "and its errors are found in the same run";
  EXPECT_EQ(said("image: 7\nparameters: 9\ninfo: [a]\ngeometry: 3\nlayout: []\nobjects: 5"),
            "2:8 'image' is a map of fields, found a single value\n"
            "3:13 'parameters' is a map of fields, found a single value\n"
            "4:7 'info' is a map of fields, found a list\n"
            "5:11 'geometry' is a map of named things\n"
            "6:9 'layout' is a map of fields, found a list\n"
            "7:10 expected an object as a map of fields, found a single value\n");
}

// A field that is there under a wrong name is not missing as well.
TEST(BuilderErrors, MissingFieldsSayWhatTheyTake) {
  EXPECT_EQ(about("{ type: ball, raduis: 1 }"), "3:20 unknown field 'raduis' of 'ball' (did you mean 'radius'?)\n");
  EXPECT_EQ(hints("geometry: { a: { type: ball } }"), "radius: length greater than 0\n");
  EXPECT_EQ(hints("geometry: { a: { type: box } }"), "size: lengths along x, y and z (vector: [a, b, c])\n");
}

TEST(BuilderErrors, KnotsOfOneDirection) {
  EXPECT_EQ(about("{ type: nurbs_surface, degree: 1, points: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]],\n"
                  "       knots: { u: [0, 0, 1, 1], v: [0, 0, 1] } }"),
            "4:37 in direction v: 2 points of degree 1 need 4 knots, not 3\n");
}

TEST(BuilderErrors, ThingsInTheWrongSection) {
  EXPECT_EQ(hints("annotations: []"), "it belongs inside another: drawing: { annotations: ... }\n");
  EXPECT_EQ(hints("samples: 4"), "it belongs inside another: image: { samples: ... }\n");
  EXPECT_EQ(hints("lights: none"), "write name: { type: ..., ... }; lights: {} means none\n");
  const std::string swapped =
      "geometry: { g: { type: ball, radius: 1 } }\nmaterials: { m: { type: diffuse } }\n"
      "objects: { shape: m, material: g }";
  EXPECT_EQ(said(swapped), "4:19 there is no geometry called 'm'\n4:32 there is no material called 'g'\n");
  EXPECT_EQ(hints(swapped), "'m' stands under 'materials'\n'g' stands under 'geometry'\n");
}

TEST(BuilderErrors, CapsAreForBodies) {
  const auto shown = [](const std::string& shape, const std::string& clip) {
    return said("objects: { shape: " + shape + ", clip: " + clip + " }");
  };
  const std::string sphere = "{ type: sphere_surface, radius: 1 }";
  EXPECT_EQ(shown("{ type: ball, radius: 1 }", "{ normal: x, cap: true }"), "");
  EXPECT_EQ(shown(sphere, "[{ normal: x }, { normal: y, cap: false }]"), "");
  EXPECT_EQ(shown(sphere, "{ normal: x, cap: true }"),
            "2:80 a cap closes the cut of a body; this shape has no inside\n");
  // Shapes that have an inside.
  const std::string drilled =
      "{ type: difference, of: { type: box, size: [1, 1, 1] }, minus: { type: ball, radius: 1 } }";
  const std::string bar = "{ type: segment, from: [0, 0, 0], to: [1, 0, 0] }";
  const auto tube = [&](const std::string& caps) {
    return "{ type: tube, of: " + bar + ", radius: 0.1, caps: " + caps + " }";
  };
  EXPECT_EQ(shown(drilled, "{ normal: x, cap: true }"), "");  // by its boundary
  EXPECT_EQ(shown(tube("flat"), "{ normal: x, cap: true }"),
            "2:139 a cap closes the cut of a body, and this shape is none\n");
  EXPECT_EQ(shown(tube("none"), "{ normal: x, cap: true }"),
            "2:139 a cap closes the cut of a body; this shape has no inside\n");
  EXPECT_EQ(shown(sphere, "[{ normal: x }, { normal: y, cap: true }]"),
            "2:96 a cap closes the cut of a body; this shape has no inside\n");
}

TEST(BuilderErrors, OpenOperandsSayWhatWouldCloseThem) {
  const auto united = [](const std::string& shape) { return "geometry:\n  a: { type: union, of: [" + shape + "] }\n"; };
  const std::string bar = "{ type: segment, from: [0, 0, 0], to: [1, 0, 0] }";
  const std::string tube = united("{ type: tube, of: " + bar + ", radius: 0.1, caps: none }");
  EXPECT_EQ(said(tube), "3:25 this shape is not closed: it has no inside\n");
  EXPECT_EQ(hints(tube), "a tube is closed with caps: round, or flat\n");
  EXPECT_EQ(hints(united("{ type: implicit, formula: x^2 + y^2 + z^2 - 1, ball: { radius: 2 } }")),
            "an implicit surface is closed with closed: true\n");
}

TEST(BuilderErrors, LoopsThatTrimNothing) {
  const auto trimmed = [](const std::string& loops) {
    return "{ type: trimmed_surface, of: { type: plane, size: [2, 2] }, loops: " + loops + " }";
  };
  EXPECT_EQ(about(trimmed("{ type: circle, radius: 0.5 }")), "");
  EXPECT_EQ(about(trimmed("{ type: circle, radius: 2 }")),
            "3:73 curve 0 leaves the domain of the surface at (1.41421, 1.41421)\n");
  EXPECT_EQ(
      about(trimmed("[{ type: segment, from: [0, 0], to: [1, 0] }, { type: segment, from: [1, 0], to: [1, 1] }]")),
      "3:73 the loop that begins with curve 0 is open: it ends at (1, 1) and began at (0, 0)\n");
  EXPECT_EQ(
      about(trimmed("[{ type: circle, radius: 0.5 }, { type: circle, center: [0.3, 0], radius: 0.5 }]")).substr(0, 68),
      "3:73 the loops that begin with curve 0 and curve 1 cross near (0.15,");
}

TEST(BuilderErrors, SurfacesThatBoundNoSolid) {
  EXPECT_EQ(about("{ type: intersection, of: [{ type: cylinder_surface, radius: 1, height: 2 }] }").substr(0, 86),
            "3:32 this surface bounds no solid: it is open: 2 of its edges are free, one of them at");
  EXPECT_EQ(about("{ type: intersection, of: [{ type: torus_surface, major_radius: 2, minor_radius: 1 }] }"), "");
}

TEST(BuilderErrors, WrongKinds) {
  EXPECT_EQ(about("{ type: circle, radius: [1, 2] }"), "3:30 expected a number or a formula, found a list\n");
  EXPECT_EQ(about("{ type: ball, radius: 1, center: [1] }"), "3:39 a point has 2 or 3 coordinates, found 1\n");
  EXPECT_EQ(about("{ type: circle, radius: 1, normal: w }"), "3:41 expected a direction, found 'w'\n");
  EXPECT_EQ(about("{ type: circle, radius: 1, normal: [0, 0, 0] }"), "3:41 this direction has no length\n");
  EXPECT_EQ(about("{ type: nurbs_curve, degree: 1.5, points: [[0, 0], [0, 1]] }"),
            "3:35 expected a whole number, found 1.5\n");
  EXPECT_EQ(about("{ type: torus_surface, major_radius: 1 < 2, minor_radius: 1 }"),
            "3:43 expected a number, found a condition\n");
  EXPECT_EQ(about("5"),
            "3:6 expected a curve, a surface, a body, a mesh, a shape, a group or a point as a map with a type, found "
            "a single "
            "value\n");
  EXPECT_EQ(about("{ type: sphere_surface, radius: 1, reversed: yes }"), "3:51 expected true or false, found 'yes'\n");
  EXPECT_EQ(said("image: { filter: boxx }"), "2:18 unknown word 'boxx' (did you mean 'box'?)\n");
}

TEST(BuilderErrors, ValuesOutOfRange) {
  EXPECT_EQ(about("{ type: circle, radius: -1 }"), "3:30 expected a value greater than 0, found -1\n");
  EXPECT_EQ(said("image: { samples: 0 }"), "2:19 expected a value between 1 and 1048576, found 0\n");
  EXPECT_EQ(said("camera: { type: perspective, field_of_view: 200 }"),
            "2:45 expected a value greater than 0 and at most 170 degrees, found 200\n");
  EXPECT_EQ(about("{ type: circle, radius: 1, arc: [0, 400] }"), "3:38 the arc is longer than one turn\n");
  EXPECT_EQ(about("{ type: revolution_surface, of: { type: segment, from: [1, 0, 0], to: [1, 0, 1] }, angle: 361 }"),
            "3:96 expected a value greater than 0 and at most 360 degrees, found 361\n");
  EXPECT_EQ(about("{ type: revolution_surface, of: { type: segment, from: [1, 0, 0], to: [1, 0, 1] }, angle: 360 }"),
            "");
  EXPECT_EQ(about("{ type: circle, radius: 1, arc: [90, 0] }"), "3:38 a range must begin below its end\n");
  EXPECT_EQ(about("{ type: torus_surface, major_radius: -2, minor_radius: 1 }"),
            "3:43 the sheet is empty: major_radius must be greater than -minor_radius\n");
}

TEST(BuilderErrors, AbsurdSizes) {
  EXPECT_EQ(about("{ type: nurbs_curve, degree: 1000, points: [[0, 0], [1, 1]] }"),
            "3:35 expected a value between 1 and 25, found 1000\n");
  EXPECT_EQ(said("image: { size: [1000000000, 1] }"), "2:17 a side of a picture is between 1 and 65536 pixels\n");
  EXPECT_EQ(said("image: { size: [32000, 32000] }"), "2:16 a picture of 32000 x 32000 pixels is too large\n");
  EXPECT_EQ(hints("image: { size: [32000, 32000] }"), "at most 100 million pixels\n");
  EXPECT_EQ(said("geometry:\n  a: { repeat: { i: 0..1e8 }, type: ball, radius: 1 }\n"),
            "3:21 more than 1000000 repetitions\n");
}

// Solids of solids by names: many are good, and those that would take all memory are errors. The largest comes first,
// in the file and by its name.
TEST(BuilderErrors, SolidsOfSolids) {
  const auto chain = [](int count, const std::string& with) {
    const auto name = [](int i) { return "n" + std::to_string(999 - i); };
    std::string text = "geometry:\n";
    for (int i = count; i > 0; --i)
      text += "  " + name(i) + ": { type: union, of: [" + name(i - 1) + ", " + (with.empty() ? name(i - 1) : with) +
              "] }\n";
    return text + "  n999: { type: box, size: [1, 1, 1] }\n";
  };
  const char* const ball = "{ type: ball, radius: 0.1 }";
  EXPECT_EQ(said(chain(100, ball) + "objects: [{ shape: n899 }]"), "");
  EXPECT_NE(said(chain(300, ball)).find("things inside things more than 256 deep"), std::string::npos);
  EXPECT_NE(said(chain(30, "")).find("it has more than 100000 parts, those of its operands' operands counted"),
            std::string::npos);
}

TEST(BuilderErrors, MissingFields) {
  EXPECT_EQ(about("{ type: bezier_curve }"), "3:6 missing field 'points' of 'bezier_curve'\n");
  EXPECT_EQ(about("{ radius: 1 }"),
            "3:6 missing 'type' of a curve, a surface, a body, a mesh, a shape, a group or a point\n");
  EXPECT_EQ(about("{ type: ball, radius: 1, center: { of: { type: segment, from: x0, to: [1, 0] } } }"),
            "3:68 there is no geometry called 'x0'\n");
  EXPECT_EQ(said("geometry: { l: { type: segment, from: [0, 0], to: [1, 0] }, b: { type: ball, radius: 1, center: "
                 "{ of: l } } }"),
            "2:97 missing 't' of a place on a curve\n");
}

TEST(BuilderErrors, DanglingReferences) {
  EXPECT_EQ(said("geometry:\n  section: { type: circle, radius: 1 }\n"
                 "  a: { type: revolution_surface, of: secton, axis: x }\n"
                 "objects:\n  - { shape: b, material: steel }\n"),
            "4:38 there is no geometry called 'secton' (did you mean 'section'?)\n"
            "6:14 there is no geometry called 'b'\n"
            "6:27 there is no material called 'steel'\n");
  EXPECT_EQ(about("{ type: ball, radius: R }"), "3:28 unknown name 'R'\n");
  EXPECT_EQ(said("parameters: { radius: 2 }\ngeometry: { a: { type: ball, radius: radus } }"),
            "3:38 unknown name 'radus'\n");
  EXPECT_EQ(hints("parameters: { radius: 2 }\ngeometry: { a: { type: ball, radius: radus } }"),
            "did you mean 'radius'?\n");
  EXPECT_EQ(about("{ type: mesh, file: none.obj }"), "3:26 there is no file 'none.obj'\n");
}

TEST(BuilderErrors, NumbersWhereThingsAreWanted) {
  EXPECT_EQ(said("camera: { from: 2.5, at: [0, 0, 0] }"), "2:17 expected a point, found the number 2.5\n");
  EXPECT_EQ(hints("camera: { from: 2.5, at: [0, 0, 0] }"),
            "write [x, y, z], the name of a point, or a place such as { of: curve, t: 0.5 }\n");
  EXPECT_EQ(said("objects: [{ shape: { type: ball, radius: 1 }, material: 3 }]"),
            "2:57 expected a material, found the number 3\n");
}

// A word that is a choice of some type's field, where the thing itself is wanted.
TEST(BuilderErrors, WordsOfFields) {
  const std::string ball = "objects: [{ shape: { type: ball, radius: 1 }, material: ";
  EXPECT_EQ(said(ball + "BK7 }]"), "2:57 there is no material called 'BK7'\n");
  EXPECT_EQ(hints(ball + "BK7 }]"), "write { type: dielectric, glass: N-BK7 }\n");
  EXPECT_EQ(hints(ball + "N-BK7 }]"), "write { type: dielectric, glass: N-BK7 }\n");
  EXPECT_EQ(hints("materials: { lens: BK7 }"), "write { type: dielectric, glass: N-BK7 }\n");
  EXPECT_EQ(hints("materials: { mirror: Cu }"), "write { type: conductor, metal: Cu }\n");
  EXPECT_EQ(hints("materials: { lens: BK77 }"), "write { type: classic, ... }\n");
  EXPECT_EQ(said(ball + "{ type: dielectric, glass: BK7 } }]"), "2:84 unknown word 'BK7' (did you mean 'N-BK7'?)\n");
  EXPECT_EQ(said(ball + "{ glass: BK7 } }]"), "2:57 missing 'type' of a material\n");
  EXPECT_EQ(hints(ball + "{ glass: BK7 } }]"), "one of dielectric\n");
  EXPECT_EQ(hints(ball + "{ glass: BK7, metal: Cu } }]"), hints(ball + "{} }]"));
}

TEST(BuilderErrors, ThingsOfTheWrongCategory) {
  EXPECT_EQ(about("{ type: revolution_surface, of: { type: ball, radius: 1 }, axis: z }"),
            "3:46 'ball' makes a body, but a curve is wanted here\n");
  EXPECT_EQ(said("geometry:\n  b: { type: ball, radius: 1 }\n  a: { type: revolution_surface, of: b, axis: z }\n"),
            "4:38 'b' is a body, but a curve is wanted here\n");
  EXPECT_EQ(about("{ type: diffuse }"),
            "3:14 'diffuse' makes a material, but a curve, a surface, a body, a mesh, a shape, a group or a point is "
            "wanted here\n");
}

TEST(BuilderErrors, UnknownTypes) {
  EXPECT_EQ(about("{ type: circl, radius: 1 }"), "3:14 unknown type 'circl' (did you mean 'circle'?)\n");
  EXPECT_EQ(about("{ type: sphere, radius: 1 }"), "3:14 'sphere' exists for several kinds\n");
  EXPECT_EQ(hints("geometry: { a: { type: sphere, radius: 1 } }"), "say which: ball, sphere_surface\n");
  // One that is meant is named, not a choice of it.
  EXPECT_EQ(about("{ type: ruled, of: a }"), "3:14 unknown type 'ruled' (did you mean 'ruled_surface'?)\n");
  EXPECT_EQ(said("integrator: { type: clasic }"), "2:21 unknown type 'clasic' (did you mean 'classic'?)\n");
}

TEST(BuilderErrors, FormulasWithoutAFiniteValue) {
  EXPECT_EQ(about("{ type: circle, radius: 0/0 }"), "3:30 the formula has no finite value (not a number)\n");
  EXPECT_EQ(about("{ type: circle, radius: sqrt(-1) }"), "3:30 the formula has no finite value (not a number)\n");
  EXPECT_EQ(said("parameters: { w: 1/0 }"), "2:18 the formula has no finite value (infinite)\n");
  EXPECT_EQ(about("{ type: ball, radius: .inf }"), "3:28 '.inf' is not a number here\n");
  EXPECT_EQ(about("{ type: ball, radius: nan }"), "3:28 'nan' is not a number here\n");
  EXPECT_EQ(about("{ type: ball, radius: 1e400 }"), "3:28 the number 1e400 is outside the range of double precision\n");
}

TEST(BuilderErrors, LengthsAndAngles) {
  EXPECT_EQ(about("{ type: circle, radius: 5 mm }"), "3:30 a length of the model has no unit, found '5 mm'\n");
  EXPECT_EQ(about("{ type: ball, radius: 1, transform: { rotate: pi/2, axis: z } }"),
            "3:52 pi without a unit: a plain number means degrees here\n");
  EXPECT_EQ(about("{ type: circle, radius: 1, arc: [0, pi] }"),
            "3:42 pi without a unit: a plain number means degrees here\n");
}

TEST(BuilderErrors, Circles) {
  EXPECT_EQ(said("parameters: { a: b + 1, b: 2*a }"), "2:28 the parameter 'a' is defined by itself\n");
  EXPECT_EQ(said("geometry:\n  a: { type: revolution_surface, of: { type: segment, from: p, to: [1, 0] }, axis: z }\n"
                 "  p: { type: revolution_surface, of: a, axis: z }\n"),
            "3:6 'a' is built from itself\n");
  EXPECT_EQ(said("materials:\n  a: { like: b }\n  b: { like: a }\n"), "3:14 'b' is like itself in the end\n");
  EXPECT_EQ(said("materials:\n  a: { like: a }\n"), "3:14 'a' is like itself in the end\n");
}

TEST(BuilderErrors, Names) {
  EXPECT_EQ(said("parameters: { pi: 3, t: 1, sin: 2, n: 4 }"),
            "2:15 a parameter may not be called 'pi'\n2:22 a parameter may not be called 't'\n"
            "2:28 a parameter may not be called 'sin'\n");
  EXPECT_EQ(about("{ repeat: { t: 0..2 }, type: ball, radius: 1 }"), "3:18 a counter may not be called 't'\n");
  EXPECT_EQ(said("parameters: { i: 1 }\ngeometry:\n  a: { repeat: { i: 0..2 }, type: ball, radius: 1 }\n"),
            "4:18 the counter 'i' is also a parameter\n");
}

TEST(BuilderErrors, RepeatsAndFamilies) {
  const std::string family = "geometry:\n  f: { repeat: { i: 0..2 }, type: circle, radius: i + 1 }\n";
  EXPECT_EQ(said(family + "  a: { type: revolution_surface, of: f, axis: x }\n"),
            "4:38 'f' is a family of 3; one thing is wanted here\n");
  EXPECT_EQ(said(family + "  a: { type: revolution_surface, of: f.7, axis: x }\n"), "4:38 'f' has no member '7'\n");
  EXPECT_EQ(said(family + "  a: { like: f, radius: 1 }\n"), "4:14 'f' is a family: its fields need its counters\n");
  EXPECT_EQ(about("{ repeat: 5, type: ball, radius: 1 }"), "3:16 'repeat' names a counter and its values\n");
  EXPECT_EQ(about("{ repeat: { i: 0.5..2 }, type: ball, radius: 1 }"), "3:21 a range of whole numbers, found 0.5..2\n");
  EXPECT_EQ(said("materials:\n  a: { like: nobody }\n"), "3:14 there is nothing called 'nobody' to be like\n");
}

TEST(BuilderErrors, Transforms) {
  const auto step = [](const std::string& text) { return about("{ type: ball, radius: 1, transform: " + text + " }"); };
  EXPECT_EQ(step("[{ translate: [1, 0, 0], rotate: 30 }]"), "3:67 one step does one thing\n");
  EXPECT_EQ(step("{ transalte: [1, 0, 0] }"),
            "3:44 unknown step 'transalte' of a transform (did you mean 'translate'?)\n");
  EXPECT_EQ(step("{ scale: 0 }"), "3:51 a scale factor of 0 flattens everything\n");
  EXPECT_EQ(step("{ scale: 2, axis: z }"), "3:60 'axis' goes with 'rotate', not with 'scale'\n");
  EXPECT_EQ(step("3"), "3:42 expected a step of a transform, found a single value\n");
  EXPECT_EQ(step("{ matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0]] }"),
            "3:52 this matrix flattens everything: its determinant is 0\n");
}

TEST(BuilderErrors, TransformsBeyondNumbers) {
  EXPECT_EQ(about("{ type: ball, radius: 1, transform: { scale: 1e200 } }"),
            "3:6 the transform is too large: its determinant is beyond what numbers can hold\n");
}

TEST(BuilderErrors, SurfacesWithoutArea) {
  const std::string line = "[[[0, 0, 0], [1, 0, 0]], [[2, 0, 0], [3, 0, 0]]]";
  EXPECT_EQ(about("{ type: bezier_surface, points: " + line + " }"),
            "3:6 'bezier_surface' has no area: its points lie on one curve\n");
  EXPECT_EQ(
      about("{ type: extrusion_surface, along: [2, 0, 0], of: { type: segment, from: [0, 0, 0], to: [1, 0, 0] } }"),
      "3:6 'extrusion_surface' has no area: its points lie on one curve\n");
  EXPECT_EQ(about("{ type: formula_surface, point: [u + v, u + v, 1], domain: { u: [0, 1], v: [0, 1] } }"),
            "3:6 'formula_surface' has no area: its points lie on one curve\n");
  // A cone's tip and a patch with an edge that is a point do have one.
  EXPECT_EQ(about("{ type: bezier_surface, points: [[[0, 0, 0], [0, 0, 0]], [[2, 0, 0], [3, 1, 0]]] }"), "");
}

// Formulas are told of by the names of their own variables.
TEST(BuilderErrors, FormulasWithoutAValue) {
  const std::string square = ", domain: { u: [-1, 1], v: [0, 1] } }";
  EXPECT_EQ(about("{ type: formula_surface, z: log(x) + y" + square),
            "3:54 the formulas have no value at x = -1, y = 0\n");
  EXPECT_EQ(about("{ type: formula_surface, point: [u, v, log(u) + v]" + square),
            "3:66 the formulas have no value at u = -1, v = 0\n");
  EXPECT_EQ(about("{ type: formula_curve, y: sqrt(x), domain: [-1, 1] }"),
            "3:49 the formulas have no value at x = -1\n");
  EXPECT_EQ(about("{ type: formula_curve, point: [t, sqrt(t)], domain: [-1, 1] }"),
            "3:58 the formulas have no value at t = -1\n");
}

TEST(BuilderErrors, FramesPlacesAndNets) {
  EXPECT_EQ(about("{ type: ball, frame: { z: x }, center: [1, 1], radius: 1 }"),
            "3:45 a placement is given by 'frame' or by 'center' and 'normal', not by both\n");
  EXPECT_EQ(about("{ type: ball, frame: { z: x, x: x }, radius: 1 }"), "3:27 x is parallel to z\n");
  EXPECT_EQ(about("{ type: nurbs_surface, degree: { u: 3 }, points: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]] }"),
            "3:37 'degree' takes one value for both directions, or { u: ..., v: ... }\n");
  EXPECT_EQ(about("{ type: nurbs_surface, degree: [1, 1], points: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]] }"),
            "3:37 'degree' takes one value for both directions, or one for each\n");
  EXPECT_EQ(about("{ type: nurbs_surface, degree: 1, points: [[[0, 0], [0, 1]], [[1, 0]]] }"),
            "3:67 this row has 1 points, the rows before it 2\n");
  EXPECT_EQ(about("{ type: nurbs_curve, degree: 1, knots: clmped, points: [[0, 0], [0, 1]] }"),
            "3:45 unknown rule for knots 'clmped' (did you mean 'clamped'?)\n");
  EXPECT_EQ(about("{ type: nurbs_curve, degree: 1, knots: [0, 1], points: [[0, 0], [0, 1]] }"),
            "3:45 2 points of degree 1 need 4 knots, not 2\n");
}

TEST(BuilderErrors, Colors) {
  const auto color = [](const std::string& text) {
    return said("materials:\n  m: { type: diffuse, color: " + text + " }");
  };
  EXPECT_EQ(color("steelblu"), "3:30 unknown colour 'steelblu' (did you mean 'steelblue'?)\n");
  EXPECT_EQ(color("'#12'"), "3:30 '#12' is no colour\n");
  EXPECT_EQ(color("[1, 2]"), "3:30 expected 3 values, found 2\n");
  EXPECT_EQ(color("1.5"), "3:30 the values of this colour must be between 0 and 1\n");
  EXPECT_EQ(color("{ srgb: [0, 0, 2] }"), "3:45 expected a value between 0 and 1, found 2\n");
}

TEST(BuilderErrors, CameraPictureAndOutputs) {
  EXPECT_EQ(said("camera: { type: perspective, from: [0, 0, 5], at: [0, 0, 5] }"),
            "2:51 the camera stands at the point that it looks at\n");
  EXPECT_EQ(said("image: { crop: [1, 2, 3] }"), "2:16 expected 4 values, found 3\n");
  EXPECT_EQ(said("image: { size: [10, 10], crop: [0, 0, 20, 5] }"),
            "2:32 this part does not lie inside the picture of 10 x 10 pixels\n");
  EXPECT_EQ(said("image: { size: [10 mm, 10] }"), "2:16 width and height are both in pixels or both on paper\n");
  EXPECT_EQ(said("outputs: [a.jpg, { file: b.png, exposre: 1 }, c.png]"),
            "2:11 'a.jpg' has an unknown ending\n"
            "2:33 unknown field 'exposre' of an output (did you mean 'exposure'?)\n");
}

TEST(BuilderErrors, FiltersAndBackgrounds) {
  EXPECT_EQ(said("image: { filter_radius: 0.1 }"),
            "2:25 the filter reaches less than 0.5 pixels: it would miss samples\n");
  EXPECT_EQ(said("image: { background: [1e40, 0, 0] }"), "2:22 too bright: pictures hold numbers up to 3.4e38\n");
  EXPECT_EQ(said("image: { filter_radius: 0.5, background: [1e30, 0, 0] }"), "");
}

TEST(BuilderErrors, AllErrorsOfAFileInOneRun) {
  EXPECT_EQ(said("parameters: { n: 1/0 }\n"
                 "geometry:\n"
                 "  a: { type: circle, radius: -1, colour: red }\n"
                 "  b: { type: box, size: [1, m, 2] }\n"
                 "  unused: { type: ball }\n"
                 "materials:\n"
                 "  unused: { type: plastic, color: redd }\n"
                 "camera: { type: fisheye }\n"
                 "image: { samples: many }\n"),
            "2:18 the formula has no finite value (infinite)\n"
            "4:30 expected a value greater than 0, found -1\n"
            "4:34 unknown field 'colour' of 'circle'\n"
            "5:29 unknown name 'm'\n"
            "6:11 missing field 'radius' of 'ball'\n"
            "8:35 unknown colour 'redd' (did you mean 'red'?)\n"
            "9:17 unknown type 'fisheye'\n"
            "10:19 unknown name 'many'\n");
}

}  // namespace
}  // namespace lekalo::render::builder_errors_test
