"""The net of a Bezier triangle and de Casteljau's construction in drawings, measured on the page."""

import math
import re
import unittest

from program import ProgramTest

SCENE = """lekalo: 1
geometry:
  flat: { type: bezier_triangle, points: [[0, 6], [0, 0], [9, 0]], elevate: 2, corners: [[0, 6], [0, 0], [9, 0]] }
objects: [{ shape: flat, lines: {}, show: { control_net: { label: '$%i%j%k$' }, de_casteljau: { u: 2, v: 1 } } }]
camera: { view: top }
"""


class Triangles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("net.yaml", SCENE)
        self.run_program("draw", "net.yaml", "-o", "net.svg", "--quiet")
        self.svg = self.bytes_of("net.svg").decode()

    def lines_of(self, kind):
        group = re.search(rf'<g id="flat-{kind}" .*?</g>', self.svg, re.DOTALL).group()
        return [[tuple(map(float, p)) for p in re.findall(r"([\d.]+) ([\d.]+)", d)]
                for d in re.findall(r' d="([^"]*)"', group)]

    def test_net_and_construction(self):
        marks = [line[0] for line in self.lines_of("mark")]
        self.assertEqual(len(marks), 10 + 6 + 3 + 1)
        # The corners 300, 030 and 003 are the first mark, the seventh and the tenth; all signs have one size.
        top, left, right = marks[0], marks[6], marks[9]
        at = lambda x, y: [left[k] + (right[k] - left[k]) * x / 9 + (top[k] - left[k]) * y / 6 for k in (0, 1)]
        # On a flat net with even points the construction ends at (u, v).
        self.assert_near(marks[19], at(2, 1), 0.3)
        length = lambda kind: sum(math.dist(p, q) for line in self.lines_of(kind) for p, q in zip(line, line[1:]))
        whole = 9 + 6 + math.hypot(9, 6)
        scale = math.dist(left, right) / 9
        # Lines of 1, 2/3 and 1/3 of each side; triangles of 1/3 of the size.
        self.assertAlmostEqual(length("control_net") / scale, 2 * whole, delta=0.01)
        self.assertAlmostEqual(length("de_casteljau") / scale, 4 * whole / 3, delta=0.01)

    def test_labels(self):
        texts = re.findall(r"<text[^>]*>(.*?)</text>", self.svg, re.DOTALL)
        found = {re.sub(r"<[^>]*>|\s", "", text) for text in texts}
        self.assertEqual(found, {"300", "210", "201", "120", "111", "102", "030", "021", "012", "003"})


if __name__ == "__main__":
    unittest.main()
