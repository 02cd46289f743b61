"""Surfaces on points, against what is known of them in other ways."""

import math
import unittest

from program import ProgramTest

try:
    import numpy
    from scipy import interpolate
except ImportError:
    numpy = None


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

    def test_volume_of_a_sphere_of_cells(self):
        """Hermite's bicubics on 8 x 4 cells with exact derivatives and twists (Zavyalov et al. 1985, II.6): 4.17782736."""
        self.write("scene.yaml", """lekalo: 1
geometry:
  sphere: { type: sphere_surface, radius: 1 }
  cells: { type: spline_of_surface, of: sphere, tolerance: 0.003, steps: equal }
""")
        lines = self.json_of("measure", "scene.yaml", "cells")["parameters"]
        self.assertEqual([line["domain"][1] - line["domain"][0] for line in lines], [2 * math.pi, math.pi])
        # r (r_u x r_v)/3 is of degree 8 in a cell.
        gauss = [(0, 128 / 225), *((s * math.sqrt(5 - t * 2 * math.sqrt(10 / 7)) / 3, (322 + t * 13 * math.sqrt(70)) / 900)
                                   for t in (1, -1) for s in (1, -1))]
        h = math.pi / 8
        places = [(h * (2 * i + 1 + x), h * (2 * j + 1 + y) - math.pi / 2, a * b * h * h)
                  for i in range(8) for j in range(4) for x, a in gauss for y, b in gauss]
        self.write("places.csv", "u,v\n" + "".join(f"{u!r},{v!r}\n" for u, v, _ in places))
        volume = 0
        for row, (_, _, weight) in zip(self.json_of("evaluate", "scene.yaml", "cells", "--table", "places.csv")["rows"], places):
            (x, y, z), (a, b, c), (d, e, f) = row["point"], row["du"], row["dv"]
            volume += weight / 3 * (x * (b * f - c * e) + y * (c * d - a * f) + z * (a * e - b * d))
        self.assertAlmostEqual(volume, 4.17782736, delta=5.1e-9)

    def cloud(self, count):
        random = numpy.random.default_rng(1985)
        at = random.uniform(0, 1, (count, 2)) * [3, 2]
        z = numpy.sin(at[:, 0]) * numpy.cos(2 * at[:, 1]) + random.normal(0, 0.05, count)
        weights = random.uniform(0.5, 2, count)
        self.write("points.csv", "".join(f"{float(x)!r},{float(y)!r},{float(one)!r}\n" for (x, y), one in zip(at, z)))
        self.write("at.csv", "".join(f"{float(x)!r},{float(y)!r}\n" for x, y in at))
        return at, z, weights

    @unittest.skipUnless(numpy, "python3-scipy is not installed")
    def test_least_squares_of_a_cloud(self):
        at, z, weights = self.cloud(300)
        listed = ", ".join(repr(float(w)) for w in weights)
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  fit: { type: fit_surface, points: { file: points.csv }, at: { file: at.csv }, "
                   "domain: { u: [0, 3], v: [0, 2] }, degree: { u: 3, v: 2 }, spans: { u: 3, v: 2 }, weights: [%s] }\n" % listed)
        # SciPy's weights are those of distances.
        other = interpolate.LSQBivariateSpline(at[:, 0], at[:, 1], z, [1, 2], [1], w=numpy.sqrt(weights), bbox=[0, 3, 0, 2], kx=3, ky=2)
        places = [(0.1 + 0.28 * i, 0.05 + 0.19 * i) for i in range(11)]
        for (u, v), found in zip(places, self.points("scene.yaml", "fit", places)):
            self.assertLess(max(abs(found[0] - u), abs(found[1] - v)), 1e-12)  # linear functions are met
            self.assertAlmostEqual(found[2], float(other.ev(u, v)), delta=1e-11)

    @unittest.skipUnless(numpy, "python3-scipy is not installed")
    def test_regularized_polynomial(self):
        """A biquadratic polynomial near points, and the integral of z_uu^2 + 2 z_uv^2 + z_vv^2 (Zavyalov et al. 1985, I.1)."""
        at, z, weights = self.cloud(40)
        listed = ", ".join(repr(float(w)) for w in weights)
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  fit: { type: fit_surface, points: { file: points.csv }, at: { file: at.csv }, "
                   "domain: { u: [0, 3], v: [0, 2] }, degree: 2, spans: 1, stiffness: 0.7, weights: [%s] }\n" % listed)
        powers = [(i, j) for i in range(3) for j in range(3)]
        rows = numpy.array([[u**i * v**j for i, j in powers] for u, v in at])
        x, w = numpy.polynomial.legendre.leggauss(6)
        roughness = numpy.zeros((9, 9))
        for u, wu in zip(1.5 * (x + 1), 1.5 * w):
            for v, wv in zip(x + 1, w):
                uu = numpy.array([i * (i - 1) * u**max(i - 2, 0) * v**j for i, j in powers])
                uv = numpy.array([i * j * u**max(i - 1, 0) * v**max(j - 1, 0) for i, j in powers])
                vv = numpy.array([j * (j - 1) * u**i * v**max(j - 2, 0) for i, j in powers])
                roughness += wu * wv * (numpy.outer(uu, uu) + 2 * numpy.outer(uv, uv) + numpy.outer(vv, vv))
        c = numpy.linalg.solve(rows.T @ (weights[:, None] * rows) + 0.7 * roughness, rows.T @ (weights * z))
        places = [(0.1 + 0.28 * i, 0.05 + 0.19 * i) for i in range(11)]
        for (u, v), found in zip(places, self.points("scene.yaml", "fit", places)):
            self.assertAlmostEqual(found[2], sum(ck * u**i * v**j for ck, (i, j) in zip(c, powers)), delta=1e-10)

    def test_closed_t_splines_by_long_and_short_lines(self):
        """Lines round a torus are cut at all their vertices, over the seams too."""
        n = 6
        rows = [[n * i + j for j in range(n)] for i in range(n)]
        lines = [[*row, row[0]] for row in rows] + [[row[j] for row in [*rows, rows[0]]] for j in range(n)]
        pieces = [[[line[0], line[3], line[0]] for line in lines], [[line[k], line[k + 1]] for line in lines for k in range(n)]]
        def torus(lines):
            return (f"{{ type: t_spline, period: {{ u: {n}, v: {n} }}, at: [{{ repeat: {{ i: 0..{n - 1}, j: 0..{n - 1} }}, point: [i, j] }}], lines: {lines}, "
                    f"points: [{{ repeat: {{ i: 0..{n - 1}, j: 0..{n - 1} }}, point: "
                    f"[(3 + cos(2 * pi * j / {n})) * cos(2 * pi * i / {n}), (3 + cos(2 * pi * j / {n})) * sin(2 * pi * i / {n}), sin(2 * pi * j / {n})] }}] }}")
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n" + "".join(f"  s{k}: {torus(p)}\n" for k, p in enumerate([lines, *pieces])))
        places = [(0.3, 0.2), (2.7, 5.9), (5.5, 5.5)]
        whole = self.points("scene.yaml", "s0", places)
        for name in "s1", "s2":
            self.assert_near(self.points("scene.yaml", name, places), whole, 1e-14)

    @unittest.skipUnless(numpy, "python3-scipy is not installed")
    def test_spline_through_a_grid(self):
        """C2 bicubics with derivatives at the borders, against SciPy's splines in both directions."""
        random = numpy.random.default_rng(6)
        u, v = numpy.array([0, 1, 2.5, 3, 4.2]), numpy.array([0, 0.7, 2, 3.1])
        z, start, end = random.normal(size=(5, 4)), random.normal(size=4), random.normal(size=4)
        grid = [[[float(a), float(b), float(z[i, j])] for j, b in enumerate(v)] for i, a in enumerate(u)]
        vectors = lambda slopes: [[1, 0, float(s)] for s in slopes]
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  s: { type: spline_surface, knots: { u: %s, v: %s }, points: %s, u_start: %s, u_end: %s }\n" %
                   (u.tolist(), v.tolist(), grid, vectors(start), vectors(end)))
        along_u = interpolate.CubicSpline(u, z, bc_type=((1, start), (1, end)))
        places = [(0.3 * i, 0.2 * i) for i in range(14)]
        for (a, b), found in zip(places, self.points("scene.yaml", "s", places)):
            self.assertAlmostEqual(found[2], float(interpolate.CubicSpline(v, along_u(a))(b)), delta=1e-12)

    def test_fit_of_a_grid_to_a_tolerance(self):
        u, v = [0.25 * i for i in range(25)], [0.2 * j for j in range(21)]
        grid = [[[a, b, math.sin(a) * math.cos(b) / (1 + (a - 3)**2)] for b in v] for a in u]
        for tolerance in (0.02, 0.001):
            self.write("scene.yaml", "lekalo: 1\ngeometry:\n  fit: { type: fit_surface, tolerance: %r, grid: %s, knots: { u: %s, v: %s } }\n" %
                       (tolerance, grid, u, v))
            found = self.points("scene.yaml", "fit", [(a, b) for a in u for b in v])
            off = max(math.dist(p, q) for p, q in zip(found, [p for row in grid for p in row]))
            self.assertLessEqual(off, tolerance)
            self.assertGreater(off, tolerance / 100)  # no finer than it has to be

    def test_sections_and_outlines_of_an_offset_of_a_formula(self):
        """The section of the paraboloid's offset is a circle: radius r - 2 r d/w at the height r^2 + d/w, w^2 = 1 + 4 r^2."""
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  bowl: { type: formula_surface, point: [u, v, u*u + v*v], domain: { u: [-1, 1], v: [-1, 1] } }\n"
                   "  shifted: { type: offset_surface, of: bowl, distance: 0.1 }\nobjects: [{ shape: shifted }]\ncamera: { view: front }\n")
        r = 0.6
        w = math.sqrt(1 + 4 * r * r)
        height = r * r + 0.1 / w
        found = self.json_of("measure", "scene.yaml", "shifted", "--section", f"0,0,{height!r},0,0,1")
        self.assertEqual(len(found["branches"]), 1)
        self.assert_near(found["branches"][0]["length"], 2 * math.pi * (r - 0.2 * r / w), 1e-11)
        self.assertEqual(len(self.json_of("measure", "scene.yaml", "shifted", "--silhouette", "1,0.2,0.3")["branches"]), 1)
        self.run_program("draw", "scene.yaml", "-o", "scene.svg")

    def test_cloud_on_a_surface_near_it(self):
        """Points of a paraboloid, whose parameters come from a plane below and move to their feet: the sum of squares falls."""
        random = [((0.618033988749895 * k) % 1 * 4, (0.7548776662466927 * k) % 1 * 3) for k in range(1, 121)]
        cloud = [[x, y, 0.3 * x * x - 0.2 * x * y + 0.02 * math.sin(9 * x + 5 * y)] for x, y in random]
        sums = []
        for passes in (0, 20):
            self.write("scene.yaml", "lekalo: 1\ngeometry:\n  sheet: { type: bilinear_surface, points: [[[0, 0, 0], [0, 3, 0]], [[4, 0, 3], [4, 3, 1]]] }\n"
                       "  fit: { type: fit_surface, near: sheet, degree: 2, spans: 1, passes: %d, points: %s }\n" % (passes, cloud))
            total = 0
            for p in cloud[:40]:
                total += self.json_of("measure", "scene.yaml", "fit", "--to", ",".join(map(repr, p)), "--nearest")["distance"]**2
            sums.append(total)
        self.assertLess(sums[1], sums[0])
        self.assertLess(math.sqrt(sums[1] / 40), 0.03)


if __name__ == "__main__":
    unittest.main()
