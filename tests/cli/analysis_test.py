"""Pictures of curvatures and other quantities: their numbers in OpenEXR layers, and what is said of wrong wishes."""

import unittest

from program import ProgramTest

SCENE = """
lekalo: 1
geometry:
  ring: {{ type: torus_surface, major_radius: 3, minor_radius: 1 }}
objects: [{{ shape: ring, {0} }}]
camera: {{ view: {{ azimuth: -60, elevation: 40 }} }}
integrator: {{ type: analysis, {1} }}
image: {{ size: [48, 32], samples: 1 }}
"""


class Analysis(ProgramTest):
    def render(self, name, integrator, object_fields="name: it", code=0, options=()):
        self.write("scene.yaml", SCENE.format(object_fields, integrator))
        return self.run_program("render", "scene.yaml", "-o", name, *options, code=code)[1]

    def worst(self, first, second, layer):
        return self.json_of("compare", first, second, "--layer", layer, "--metric", "max", "--threshold", "1e9")["value"]

    def test_layers_hold_the_numbers(self):
        """Golovanov 2016, 3.2: the torus has K = cos v/(3 + cos v), H = -(3 + 2 cos v)/(2 (3 + cos v)), k2 = -1."""
        for formula, truth in [("K", "cos(v)/(3 + cos(v))"), ("H", "-(3 + 2*cos(v))/(2*(3 + cos(v)))"), ("k2", "-1 + 0*x"),
                               ("k1", "-cos(v)/(3 + cos(v))"), ("x^2 + y^2", "(3 + cos(v))^2"), ("z", "sin(v)")]:
            self.render("a.exr", f"formula: '{formula}'")
            self.render("b.exr", f"formula: '{truth}'")
            self.assertLess(self.worst("a.exr", "b.exr", "formula"), 3e-6, formula)
        self.render("a.exr", "quantity: gaussian_curvature")
        self.assertEqual(self.worst("a.exr", "a.exr", "gaussian_curvature"), 0)

    def test_meshes_of_surfaces_show_the_surface(self):
        self.render("a.exr", "quantity: mean_curvature")
        self.render("b.exr", "quantity: mean_curvature", "representation: mesh, mesh: { sag: 0.0005 }")
        self.assertLess(self.worst("a.exr", "b.exr", "mean_curvature"), 0.02)

    def test_same_bits(self):
        for threads in ("1", "3"):
            self.render(f"{threads}.exr", "quantity: k1, lines: true, bands: true", options=("--threads", threads))
        self.assertEqual(self.bytes_of("1.exr"), self.bytes_of("3.exr"))

    def test_errors(self):
        for fields, message in [("quantity: zebra, formula: K", "a 'formula' is a quantity of its own"),
                                ("quantity: mean_curvature, stripes: 5", "'stripes' is not for the quantity"),
                                ("quantity: distance", "needs the surface 'to'"),
                                ("quantity: deviation", "needs the measured 'points'"),
                                ("quantity: zebra, range: [0, 1]", "has no scale of colours"),
                                ("quantity: reflection_lines, ceiling: x", "stand upright")]:
            self.assertIn(message, self.render("a.png", fields, code=3))

    def test_bare_meshes_have_no_curvature(self):
        self.write("t.yaml", """
lekalo: 1
geometry:
  net: { type: triangulation, points: [[0, 0], [1, 0], [1, 1], [0, 1]] }
integrator: { type: analysis }
image: { size: [32, 24], samples: 1 }
""")
        _, notes = self.run_program("render", "t.yaml", "-o", "t.png")
        self.assertIn("the quantity 'gaussian_curvature' is not known everywhere; grey in the picture", notes)
        self.assertIn("'net'", notes)
        with open(self.folder / "t.yaml", "a") as scene:
            scene.write("drawing: { ground: shaded }\n")
        _, notes = self.run_program("draw", "t.yaml", "-o", "t.svg")
        self.assertIn("the quantity 'gaussian_curvature' is not known everywhere", notes)

    def test_color_bar_of_the_integrator(self):
        scene = SCENE.format("name: it", "quantity: mean_curvature, range: [-1, 1], title: mean") + """
drawing:
  ground: shaded
  annotations: [{ type: color_bar, at: { page: [2 mm, 2 mm] }, height: 8 mm, width: 2 mm, ticks: 5 }]
"""
        scene = scene.replace("[48, 32]", "[60 mm, 50 mm]")
        self.write("bar.yaml", scene)
        self.run_program("draw", "bar.yaml", "-o", "bar.svg", "--quiet")
        text = self.bytes_of("bar.svg").decode()
        for number in ("0.5", "1", "mean"):
            self.assertTrue(f">{number}<" in text, number)
        # Over a rendered picture too: its lower left corner is no longer blank.
        _, notes = self.run_program("render", "bar.yaml", "-o", "bar.png")
        self.assertNotIn("annotations", notes)
        self.write("bare.yaml", scene.split("drawing:")[0].replace("[48, 32]", "[60 mm, 50 mm]"))
        self.run_program("render", "bare.yaml", "-o", "bare.png", "--quiet")
        self.assertNotEqual(self.bytes_of("bar.png"), self.bytes_of("bare.png"))
        self.write("bar.yaml", scene.replace("type: analysis, quantity: mean_curvature, range: [-1, 1], title: mean", "type: classic"))
        _, errors = self.run_program("draw", "bar.yaml", "-o", "bar.svg", code=3)
        self.assertIn("a colour bar needs the 'range' of its numbers", errors)
        # Of a panel with annotations of its own too, as many as those of the scene.
        self.write("bar.yaml", """
lekalo: 1
geometry: { torus: { type: torus_surface, major_radius: 3, minor_radius: 1 } }
drawing: { annotations: { type: point, at: [0, 0, 0] } }
panels:
  one: { objects: { shape: torus }, drawing: { annotations: { type: color_bar, at: { page: [9 mm, 9 mm] }, height: 44 mm } } }
image: { size: [120 mm, 70 mm] }
""")
        _, errors = self.run_program("draw", "bar.yaml", "-o", "bar.svg", code=3)
        self.assertEqual(errors.count("a colour bar needs the 'range' of its numbers"), 1)


if __name__ == "__main__":
    unittest.main()
