"""Blades of random sections: the sheet goes through their points, its parts are parts of it, its mid surface is between the sides."""

import math
import random
import unittest

from program import ProgramTest


def section(rng, z):
    """A wrap of 4 + 1 + 4 points about x = 0, from (2, 0) and back."""
    chord, thick, lean = 2 + 0.2 * rng.random(), 0.1 + 0.1 * rng.random(), 0.3 * rng.random()
    places = [1, 0.7, 0.4, 0.15, 0, 0.15, 0.4, 0.7, 1]
    return [[chord * p, lean * p * (1 - p) + (-1 if i < 4 else 1) * thick * math.sqrt(p) * (1 - p), z]
            for i, p in enumerate(places)]


class Blades(ProgramTest):
    def point(self, name, u, v):
        return self.json_of("evaluate", "scene.yaml", name, "--at", f"{u!r},{v!r}")["point"]

    def assert_same(self, a, b):
        self.assertLess(math.dist(a, b), 1e-12)

    def write_scene(self, sections, more=""):
        rows = ", ".join(f"{{ points: {points}{other} }}" for points, other in sections)
        self.write("scene.yaml", f"lekalo: 1\ngeometry:\n  whole: {{ type: blade_surface, at_v: {list(range(len(sections)))}, "
                   f"sections: [{rows}] }}\n{more}")

    def test_random_sections(self):
        rng = random.Random(7)
        for _ in range(3):
            sections = [section(rng, z) for z in (0, 1, 2.2, 3)]
            self.write_scene([(points, "") for points in sections],
                             "  pressure: { type: blade_surface, of: whole, part: pressure, entry: 0.1 }\n"
                             "  suction: { type: blade_surface, of: whole, part: suction, entry: 0.1 }\n"
                             "  middle: { type: mid_surface, of: pressure, to: suction }\n")
            lo, hi = self.json_of("evaluate", "scene.yaml", "whole", "--at", "0,0")["parameters"][0]["domain"]
            for j, points in enumerate(sections):
                self.assert_same(self.point("whole", 0, j), points[4])
                self.assert_same(self.point("whole", lo, j), points[0])
                self.assert_same(self.point("whole", hi, j), points[8])
                found = self.json_of("measure", "scene.yaml", "whole", "--to", ",".join(map(repr, points[2])), "--nearest")
                self.assertLess(found["distance"], 1e-12)
            w, v = rng.random(), 3 * rng.random()
            suction, pressure = self.point("suction", w, v), self.point("pressure", w, v)
            self.assert_same(suction, self.point("whole", 0.1 + w * (hi - 0.1), v))
            self.assert_same(pressure, self.point("whole", -0.1 + w * (lo + 0.1), v))
            self.assert_same(self.point("middle", w, v), [(a + b) / 2 for a, b in zip(suction, pressure)])

    def test_cylindrical_sections(self):
        """Nodes lie on the cylinders, where their developments say."""
        flat = [[p[0] - 1, p[1]] for p in section(random.Random(3), 0)]
        self.write_scene([(flat, f", radius: {radius}") for radius in (1.5, 2, 3)])
        for j, radius in enumerate((1.5, 2, 3)):
            angle = flat[4][0] / radius
            self.assert_same(self.point("whole", 0, j), [radius * math.cos(angle), radius * math.sin(angle), flat[4][1]])
            for i in (2, 6):
                angle = flat[i][0] / radius
                place = [radius * math.cos(angle), radius * math.sin(angle), flat[i][1]]
                found = self.json_of("measure", "scene.yaml", "whole", "--to", ",".join(map(repr, place)), "--nearest")
                self.assertLess(found["distance"], 1e-12)


if __name__ == "__main__":
    unittest.main()
