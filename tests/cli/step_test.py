"""lekalo export --format step: entities, names, units, fits and what is left out."""

import re
import unittest

from program import ProgramTest

SCENE = """
lekalo: 1
info: { title: 'Ring ''A''', unit: cm }
geometry:
  block: { type: box, size: [1, 2, 3] }
  pin: { type: cylinder_body, radius: 1, height: 2 }
  wave: { type: formula_surface, point: [u, v, sin(u)*cos(v)], domain: { u: [0, 2], v: [0, 2] } }
  rim: { type: circle, radius: 2 }
  blob: { type: implicit, formula: x^2 + y^4 + z^2 - 1, ball: { radius: 2 } }
objects:
  - { shape: [block, pin], material: { type: diffuse, color: red } }
  - { shape: rim, transform: { translate: [10, 0, 0] } }
"""

# They touch in a point of the curve in which they meet.
TOUCHING_TORI = """
lekalo: 1
geometry:
  ring: { type: torus_body, major_radius: 1, minor_radius: 0.3 }
  tool: { type: torus_body, center: [2, 0, 0], major_radius: 1, minor_radius: 0.3 }
  window: { type: difference, of: ring, minus: tool }
"""


ANALYTIC = """
lekalo: 1
geometry:
  sheet: { type: plane, size: [2, 3] }
  tube: { type: cylinder_surface, radius: 1, height: 2, transform: { rotate: 20, axis: [1, 2, 3] } }
  hat: { type: cone_surface, radius: 1, height: 2 }
  globe: { type: sphere_surface, radius: 2 }
  tyre: { type: torus_surface, major_radius: 3, minor_radius: 1 }
  ring: { type: torus_body, major_radius: 3, minor_radius: 1 }
  part: { type: torus_surface, major_radius: 3, minor_radius: 1, domain: { u: [0, 2], v: [0.5, 2] } }
  line: { type: parameter_line, of: tube, v: 0.7 }
  pin: { type: extrusion_surface, of: { type: circle, radius: 1 }, along: [0, 0, 2] }
  turned: { type: revolution_surface, of: { type: segment, from: [1, 0, 0], to: [2, 0, 1] } }
  bowl: { type: revolution_surface, of: { type: circle, radius: 2, axis: y, arc: [0, 60] } }
  flat: { type: bezier_surface, points: [[[0, 0, 1], [1, 0, 1]], [[0, 1, 1], [2, 2, 1]]] }
"""

SWEEPS = """
lekalo: 1
geometry:
  leaning: { type: extrusion_surface, of: { type: circle, radius: 1 }, along: [1, 0, 2] }
  oval: { type: extrusion_surface, of: { type: ellipse, semi_axes: [2, 1] }, along: [0, 0, 2] }
  mirrored: { type: extrusion_surface, of: { type: circle, radius: 1 }, along: [0, 0, 2], transform: [{ scale: [1, 2, 1] }, { mirror: x }] }
  wall: { type: extrusion_surface, of: { type: bezier_curve, points: [[0, 0, 0], [1, 2, 0], [2, 0, 0]] }, along: [0, 0, 2] }
  apple: { type: revolution_surface, of: { type: circle, radius: 2, center: [1, 0, 0], axis: y, arc: [-30, 30] } }
  vase: { type: revolution_surface, of: { type: bezier_curve, points: [[1, 0, 0], [2, 0, 1], [1, 0, 2]] } }
"""


class Step(ProgramTest):
    def exported(self, *arguments, unit="cm"):
        self.write("scene.yaml", SCENE.replace("unit: cm", f"unit: {unit}"))
        _, errors = self.run_program("export", "scene.yaml", *arguments, "-o", "x.step")
        text = (self.folder / "x.step").read_text()
        entities = dict(re.findall(r"^#(\d+)=(.*);$", text, re.M))
        for line in entities.values():
            for number in re.findall(r"#(\d+)", line):
                self.assertIn(number, entities)
        return text, errors

    def test_solids(self):
        text, errors = self.exported()
        self.assertTrue(text.startswith("ISO-10303-21;\n"))
        self.assertTrue(text.endswith("END-ISO-10303-21;\n"))
        self.assertIn("FILE_NAME('Ring ''A'''", text)
        self.assertIn("SI_UNIT(.CENTI.,.METRE.)", text)
        self.assertEqual(text.count("=MANIFOLD_SOLID_BREP("), 2)
        self.assertEqual(text.count("=ADVANCED_FACE("), 6 + 3)
        self.assertEqual(text.count("=CYLINDRICAL_SURFACE("), 1)
        self.assertIn("ADVANCED_FACE('x_min'", text)
        self.assertIn("COLOUR_RGB('',1.,0.,0.)", text)
        self.assertEqual(len(re.findall(r"=CIRCLE\(", text)), 2 + 1)
        self.assertIn("3 shapes", errors)
        self.assertNotIn("fitted", errors)

    def test_analytic_surfaces_and_their_borders_are_exact(self):
        self.write("analytic.yaml", ANALYTIC)
        for name, surface, lines, circles in (
            ("sheet", "PLANE", 4, 0),
            ("tube", "CYLINDRICAL_SURFACE", 1, 2),
            ("hat", "CONICAL_SURFACE", 1, 1),
            ("globe", "SPHERICAL_SURFACE", 0, 1),
            ("tyre", "TOROIDAL_SURFACE", 0, 2),
            ("ring", "TOROIDAL_SURFACE", 0, 2),
            ("part", "TOROIDAL_SURFACE", 0, 4),
            ("line", "GEOMETRIC_CURVE_SET", 0, 1),
            ("pin", "CYLINDRICAL_SURFACE", 1, 2),
            ("turned", "CONICAL_SURFACE", 1, 2),
            ("bowl", "SPHERICAL_SURFACE", 0, 3),
            ("flat", "PLANE", 4, 0),
        ):
            _, errors = self.run_program("export", "analytic.yaml", name, "-o", "x.step")
            text = (self.folder / "x.step").read_text()
            self.assertEqual((text.count(f"={surface}("), text.count("=LINE("), text.count("=CIRCLE(")), (1, lines, circles), name)
            self.assertNotIn("B_SPLINE", text, name)
            self.assertNotIn("fitted", errors, name)

    def test_other_sweeps_keep_their_sections(self):
        self.write("sweeps.yaml", SWEEPS)
        for name, surface, section in (
            ("leaning", "SURFACE_OF_LINEAR_EXTRUSION", "CIRCLE"),
            ("oval", "SURFACE_OF_LINEAR_EXTRUSION", "ELLIPSE"),
            ("mirrored", "SURFACE_OF_LINEAR_EXTRUSION", "ELLIPSE"),
            ("wall", "SURFACE_OF_LINEAR_EXTRUSION", "B_SPLINE_CURVE_WITH_KNOTS"),
            ("apple", "SURFACE_OF_REVOLUTION", "CIRCLE"),
            ("vase", "SURFACE_OF_REVOLUTION", "B_SPLINE_CURVE_WITH_KNOTS"),
        ):
            _, errors = self.run_program("export", "sweeps.yaml", name, "-o", "x.step")
            text = (self.folder / "x.step").read_text()
            entities = dict(re.findall(r"^#(\d+)=(.*);$", text, re.M))
            swept = re.search(rf"={surface}\('',#(\d+),#(\d+)\)", text)
            self.assertTrue(swept, name)
            self.assertTrue(entities[swept[1]].startswith(section + "("), name)
            self.assertNotIn("B_SPLINE_SURFACE", text, name)
            self.assertNotIn("fitted", errors, name)

    def test_fits_are_told(self):
        text, errors = self.exported("wave")
        self.assertIn("=SHELL_BASED_SURFACE_MODEL(", text)
        self.assertIn("B_SPLINE_SURFACE_WITH_KNOTS", text)
        found = re.search(r"note: 'wave': \d+ of its curves and surfaces are fitted, (\S+) away", errors)
        self.assertTrue(found, errors)
        self.assertLess(float(found[1]), 1e-8)

    def test_units(self):
        for unit, written in (("km", "SI_UNIT(.KILO.,.METRE.)"), ("dm", "SI_UNIT(.DECI.,.METRE.)"), ("ft", "CONVERSION_BASED_UNIT('FOOT'")):
            text, errors = self.exported("block", unit=unit)
            self.assertIn(written, text)
            self.assertNotIn("not known", errors)
        text, errors = self.exported("block", unit="ell")
        self.assertIn("SI_UNIT(.MILLI.,.METRE.)", text)
        self.assertIn("note: info.unit 'ell' is not known: lengths are written as millimetres", errors)

    def test_what_is_left_out(self):
        _, errors = self.exported("block", "blob")
        self.assertIn("note: 'blob' is left out: it is met by rays only", errors)
        _, errors = self.run_program("export", "scene.yaml", "blob", "-o", "y.step", code=2)
        self.assertIn("there is nothing to export: 'blob' is left out", errors)
        self.assertFalse((self.folder / "y.step").exists())

    def test_why_a_solid_has_no_boundary(self):
        self.write("tori.yaml", TOUCHING_TORI)
        _, errors = self.run_program("export", "tori.yaml", "window", "-o", "z.step", code=2)
        self.assertIn("'window' is left out: its boundary is not made: ", errors)
        _, errors = self.run_program("measure", "tori.yaml", "window.edge.0", code=2)
        self.assertIn("'window.edge.0': the boundary of 'window' is not made: ", errors)
        _, errors = self.run_program("evaluate", "tori.yaml", "window", "--uv", "0,0", code=2)
        self.assertIn("'window' has no faces: its boundary is not made: ", errors)


if __name__ == "__main__":
    unittest.main()
