"""Surfaces on points, against what is known of them in other ways."""

import math
import unittest

from program import ProgramTest


class Surfaces(ProgramTest):
    def points(self, scene, name, places, *options):
        """The points of a surface at these (u, v)."""
        self.write("places.csv", "u,v\n" + "".join(f"{u!r},{v!r}\n" for u, v in places))
        rows = self.json_of("evaluate", scene, name, "--table", "places.csv", *options)["rows"]
        return [row["point"] for row in rows]

    def test_ball_of_a_grid(self):
        """Radii of the interpolant through a grid on a sphere, poles mirrored (Grezdov, Filippenko 2010, 5)."""
        self.write("scene.yaml", """lekalo: 1
parameters: { n: 4, m: 2 }
geometry:
  sphere: { type: sphere_surface, radius: 1 }
  round: { type: grid_interpolant, of: sphere, cells: { u: n, v: m }, beta: circle, ends: poles }
  plain: { type: grid_interpolant, of: sphere, cells: { u: n, v: m }, ends: poles }
""")
        for n, m, largest, least in [(4, 2, 1.0004928, 0.82403720), (8, 4, 1.0000079, 0.98436436),
                                     (16, 8, 1.0000001, 0.99892072)]:
            # At twelfths of the cells, as in the source of the numbers; one cell in u, the others are the same.
            places = [(2 * math.pi / n * i / 12, -math.pi / 2 + math.pi * j / (12 * m)) for i in range(13) for j in range(12 * m + 1)]
            options = (f"--set=n={n}", f"--set=m={m}")
            with self.subTest(n=n):
                round_, plain = ([math.hypot(*p) for p in self.points("scene.yaml", name, places, *options)]
                                 for name in ("round", "plain"))
                self.assertGreater(min(round_), 1 - 1e-14)
                self.assertAlmostEqual(max(round_), largest, delta=5.1e-8)
                self.assertAlmostEqual(min(plain), least, delta=5.1e-9)
                self.assertLess(max(plain), 1 + 1e-14)


if __name__ == "__main__":
    unittest.main()
