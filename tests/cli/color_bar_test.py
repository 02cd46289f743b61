"""Colour bars: their numbers, and what is said about wrong ones."""

import unittest

from program import ProgramTest

SCENE = """
lekalo: 1
geometry: {{ c: {{ type: ellipse, semi_axes: [3, 2] }} }}
objects: {{ shape: c, lines: {{}}, show: {{ colored: {{ by: curvature }} }} }}
camera: {{ view: top }}
drawing: {{ annotations: [{{ type: color_bar, at: {{ page: [5 mm, 5 mm] }}, {} }}] }}
image: {{ size: [90 mm, 60 mm], margin: 12 mm }}
"""


class ColorBar(ProgramTest):
    def test_round_numbers(self):
        """The curvature of the ellipse goes from 2/9 to 3/4."""
        self.write("scene.yaml", SCENE.format("of: c, by: curvature, ticks: 5"))
        self.run_program("draw", "scene.yaml", "-o", "bar.svg", "--quiet")
        text = self.bytes_of("bar.svg").decode()
        for number in ("0.3", "0.4", "0.5", "0.6", "0.7"):
            self.assertTrue(f">{number}<" in text, number)
        self.assertFalse(">0.8<" in text)
        self.assertGreater(text.count('class="colored'), 0)

    def test_minus_signs(self):
        self.write("scene.yaml", SCENE.format("range: [-10, 10]"))
        self.run_program("draw", "scene.yaml", "-o", "bar.svg", "--quiet")
        self.assertIn(">−10<", self.bytes_of("bar.svg").decode())

    def test_signs(self):
        """In blue_red zero is white: the bar of curvatures from -0.75 to 0.94 ends as far from it on both sides."""
        self.write("scene.yaml", SCENE.format("of: w, by: signed_curvature, colors: blue_red, ticks: [-0.9, 0, 0.9]")
                   .replace("geometry: { ", "geometry: { w: { type: formula_curve, y: sin(x) + 0.1*x^2, domain: [0, 6] }, "))
        self.run_program("draw", "scene.yaml", "-o", "bar.svg", "--quiet")
        text = self.bytes_of("bar.svg").decode()
        self.assertTrue(">−0.9<" in text and ">0.9<" in text)

    def test_errors(self):
        for fields, message in [("by: curvature", "either the 'range' of its numbers or a curve 'of'"),
                                ("of: c, range: [0, 1]", "either the 'range' of its numbers or a curve 'of'"),
                                ("range: [0, 1], ticks: [0.5, 2]", "beyond the ends of the bar")]:
            self.write("scene.yaml", SCENE.format(fields))
            _, errors = self.run_program("draw", "scene.yaml", "-o", "bar.svg", code=3)
            self.assertIn(message, errors)


if __name__ == "__main__":
    unittest.main()
