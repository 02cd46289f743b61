"""Milling: programs of moves, and paths as cutter location data (APT)."""

import math
import re
import unittest

from program import ProgramTest, SCENE_ERROR, USAGE

SCENE = """lekalo: 1
info: { title: A rounded block, unit: mm }
parameters: { r: 1 }
geometry:
  contour: { type: circle, radius: 3 }
  around: { type: flank_path, of: contour, side: right, cutter: { radius: 1, corner_radius: 0.2, length: 4, angle: 10 }, plane: { through: [0, 0, -2] } }
  top: { type: plane, size: [4, 4] }
  rows: { type: tool_path, of: top, count: 3, pattern: one_way, approach: 1, exit: 2, cutter: { radius: 1, corner_radius: 1, length: 4 }, feed: 50, approach_feed: 20, rapid_feed: 500 }
  start: { of: around, t: 0 }
  program:
    type: tool_program
    cutter: { radius: r, corner_radius: 0.2, length: 4, angle: 10 }
    start: [6, 0, 3]
    moves: [{ to: [6, 0, -2], rapid: true, feed: 500 }, { to: start, feed: 100 }, { path: around, feed: 200 }, { by: [0, 0, 5], rapid: true, feed: 500 }]
objects: [{ shape: [program, rows] }]
"""
RADIUS = 3 + 1 - 0.2 + 0.2 * (1 / math.cos(math.radians(10)) - math.tan(math.radians(10)))


def places(text):
    return [[float(x) for x in line[5:].split(",")] for line in text.splitlines() if line.startswith("GOTO/")]


class Milling(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.yaml", SCENE)

    def cldata(self, *options):
        self.run_program("export", "scene.yaml", *options, "-o", "x.cldata", "--quiet")
        return self.bytes_of("x.cldata").decode()

    def test_head(self):
        text = self.cldata()
        lines = text.splitlines()
        self.assertEqual(lines[:3], ["PARTNO/A rounded block", "UNITS/MM", "MULTAX/ON"])
        self.assertEqual(lines[-1], "FINI")
        self.assertEqual(sum(line.startswith("CUTTER/") for line in lines), 2)
        d, r, e, f, a, b, h = [float(x) for x in re.search(r"CUTTER/(.*)", text)[1].split(",")]
        self.assert_near([d, r, e, f, a, b, h], [2 * (RADIUS - 3), 0.2, 0.8, 0.2, 0, 10, 4], 1e-8)

    def test_chords_keep_the_tolerance(self):
        for sag in (0.1, 0.001):
            text = self.cldata("around", "--sag", str(sag))
            self.assertIn(f"$$ PATH around: CHORDS WITHIN {sag}", text)
            at = places(text)
            radii = [math.hypot(x, y) for x, y, *_ in at]
            self.assert_near(radii, [radii[0]] * len(at), 1e-8)
            for a, b in zip(at, at[1:]):
                middle = math.hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
                self.assertLess(radii[0] - middle, 1.001 * sag)
            for x, y, z, i, j, k in at:
                self.assert_near([z, i * i + j * j + k * k], [-2, 1], 1e-8)
                # The axis leans towards the part where the cutter is wider above.
                self.assert_near(i * x + j * y, math.sin(math.radians(10)) * radii[0], 1e-7)

    def test_feeds(self):
        text = self.cldata("rows")
        words = [line.split("/")[0] if not line.startswith("FEDRAT") else line for line in text.splitlines()]
        start = words.index("CUTTER") + 1
        self.assertEqual(words[start:], ["RAPID", "GOTO", "FEDRAT/20", "GOTO", "FEDRAT/50", "GOTO", "RAPID", "GOTO", "RAPID", "GOTO",
                                         "FEDRAT/20", "GOTO", "FEDRAT/50", "GOTO", "RAPID", "GOTO", "RAPID", "GOTO",
                                         "FEDRAT/20", "GOTO", "FEDRAT/50", "GOTO", "RAPID", "GOTO", "FINI"])
        self.assertEqual(places(text)[:4], [[-2, -2, 1, 0, 0, 1], [-2, -2, 0, 0, 0, 1], [2, -2, 0, 0, 0, 1], [2, -2, 2, 0, 0, 1]])

    def test_program(self):
        found = self.json_of("measure", "scene.yaml", "program")
        radius = math.hypot(*places(self.cldata("around"))[0][:2])
        round_it = 2 * math.pi * radius
        self.assert_near(found["time"], 5 / 500 + (6 - radius) / 100 + round_it / 200 + 5 / 500, 1e-8)
        self.assert_near(found["cutting_length"], 6 - radius + round_it, 1e-8)
        self.assert_near(found["length_in_air"], 10, 1e-12)

    def test_what_is_refused(self):
        _, errors = self.run_program("check", "scene.yaml", "--set", "r=1.5", code=SCENE_ERROR)
        self.assertIn("the path is one of another cutter", errors)
        self.write("rapid.yaml", SCENE.replace("{ path: around,", "{ path: around, rapid: true,"))
        _, errors = self.run_program("check", "rapid.yaml", code=SCENE_ERROR)
        self.assertIn("leave out 'rapid'", errors)
        self.write("gap.yaml", SCENE.replace("{ to: start, feed: 100 }, ", ""))
        _, errors = self.run_program("check", "gap.yaml", code=SCENE_ERROR)
        self.assertIn("from the end of the move before", errors)
        self.assertIn("gap.yaml:14:", errors)
        _, errors = self.run_program("export", "scene.yaml", "contour", "--format", "cldata", code=USAGE)
        self.assertIn("'contour' is no path of a cutter", errors)

    def refuse(self, message, *geometry):
        self.write("refused.yaml", "lekalo: 1\ngeometry:\n" + "".join(f"  {line}\n" for line in geometry))
        _, errors = self.run_program("check", "refused.yaml", code=SCENE_ERROR)
        self.assertIn(message, errors)

    def accept(self, *geometry):
        self.write("accepted.yaml", "lekalo: 1\ngeometry:\n" + "".join(f"  {line}\n" for line in geometry))
        self.run_program("check", "accepted.yaml")

    def test_program_of_another_point(self):
        cutter = "cutter: { radius: 1, corner_radius: 1, length: 3 }"
        path = "path: { type: cutter_path, of: { type: plane, size: [4, 4] }, v: 0, point: %%s, allowance: 0.1, %s }" % cutter
        program = "program: { type: tool_program, start: { of: path, t: -2 }, moves: [{ path: path }], %s }" % cutter
        for point in ("center", "contact"):
            self.refuse("not that of the middle of the cutter's end", path % point, program)
        self.accept(path % "reference", program)

    def test_moves_meet(self):
        cutter = "cutter: { radius: 1, corner_radius: 1, length: 3 }"
        path = "path: { type: cutter_path, of: { type: plane, size: [4, 4] }, v: 0, %s }" % cutter
        program = "program: { type: tool_program, start: [-2, 0, 1], moves: [{ to: [-2, %s, 0] }, { path: path }], " + cutter + " }"
        self.refuse("5e-08 from the end of the move before", path, program % "5e-8")
        self.accept(path, program % "1e-9")

    def test_corners(self):
        table, bent = "table: { type: plane, size: [4, 4] }", "{ type: polyline, points: [[0, 0], [1, 0], [1, 1]] }"
        contour = "path: {{ type: flank_path, of: {{ type: rectangle, size: [8, 5]{} }}, side: {}, cutter: {{ radius: 1, length: 4 }}, h: 0 }}"
        path = "path: {{ type: cutter_path, of: table, image: {}, {}cutter: {{ radius: 1, corner_radius: 0.3, length: 4 }} }}"
        message = "the path jumps at the corner at t = 1"
        self.refuse(message, contour.format("", "right"))
        self.refuse(message, contour.format("", "left"))
        self.refuse(message, table, path.format(bent, "lead: 20 deg, "))
        self.refuse(message, table, path.format(bent, "point: contact, lead: 20 deg, "))
        self.accept(contour.format("", "on"))
        self.accept(contour.format(", corner_radius: 0.5", "right"))
        self.accept(table, path.format(bent, "axis: [0.1, 0, 1], "))

    def test_hollows(self):
        contour = "path: {{ type: flank_path, of: {{ type: ellipse, semi_axes: [3, 1] }}, side: {}, cutter: {{ radius: {}, length: 4, angle: {} }}, h: {} }}"
        # The least radius of curvature is 1/3; that of the cone at h is (radius + h sin(angle)) / cos(angle).
        message = "at t = 0 the curve is hollower than the cutter"
        self.refuse(message, contour.format("left", 1, 0, 0))
        self.refuse(message, contour.format("left", 0.1, 10, 2))
        self.accept(contour.format("left", 0.1, 10, 1))
        self.accept(contour.format("left", 0.333, 0, 0))
        self.accept(contour.format("right", 1, 0, 0))


if __name__ == "__main__":
    unittest.main()
