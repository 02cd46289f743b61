"""Curves and surfaces as NURBS in JSON: read back they are the curves that `evaluate` tells (by the
recursion of Cox and de Boor, and by SciPy where it is installed)."""

import json
import math
import unittest

from program import ProgramTest

SCENE = """
lekalo: 1
geometry:
  open: { type: nurbs_curve, knots: [0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4], points: [[0, 0], [1, 2], [2, -1, 3], [3, 3], [4, 0], [5, 2], [6, 1]], weights: [1, 2, 1, 0.5, 1, 3, 1] }
  closed: { type: nurbs_curve, closed: true, points: [[0, 0], [2, 0], [3, 2], [1, 3], [-1, 2]] }
  spring: { type: formula_curve, point: [2*cos(t), 2*sin(t), t/3], domain: [0, 20] }
  kink: { type: formula_curve, point: [t, abs(t), 0], domain: [-1, 1] }
  rim: { type: circle, radius: 2 }
  wall: { type: plane, origin: [0, 0, 0] }
  block: { type: box, size: [1, 1, 1] }
objects:
  - { shape: rim, transform: { translate: [10, 0, 0] } }
  - { shape: open }
"""

SURFACES = """
lekalo: 1
geometry:
  net: { type: nurbs_surface, degree: { u: 1, v: 2 }, points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 2]]], weights: [[1, 2, 1], [1, 1, 3]] }
  ball: { type: sphere_surface, radius: 2 }
  swept: { type: sweep_surface, path: { type: helix, radius: 3, pitch: 2, turns: 1 }, section: { type: circle, radius: 0.5 }, twist: 90 deg*s }
  wave: { type: formula_surface, point: [u, v, sin(u)*cos(v)], domain: { u: [0, 2], v: [0, 1] } }
"""


def bezier_point(piece, s, t):
    """By Bernstein polynomials."""
    n, m = piece["degree"]
    total = [0, 0, 0, 0]
    for i in range(n + 1):
        for j in range(m + 1):
            weight = (piece["weights"][i][j] * math.comb(n, i) * s**i * (1 - s) ** (n - i)
                      * math.comb(m, j) * t**j * (1 - t) ** (m - j))
            total = [a + weight * x for a, x in zip(total, [*piece["points"][i][j], 1])]
    return [x / total[3] for x in total[:3]]


def basis(degree, knots, i, t):
    """The recursion of Cox and de Boor, 0/0 = 0."""
    if degree == 0:
        return 1.0 if knots[i] <= t < knots[i + 1] else 0.0
    left, right = knots[i + degree] - knots[i], knots[i + degree + 1] - knots[i + 1]
    return ((t - knots[i]) / left * basis(degree - 1, knots, i, t) if left > 0 else 0) + (
        (knots[i + degree + 1] - t) / right * basis(degree - 1, knots, i + 1, t) if right > 0 else 0)


def de_boor(curve, t):
    """The point by repeated affine combination of homogeneous control points."""
    p, knots = curve["degree"], curve["knots"]
    span = max(i for i in range(p, len(knots) - p - 1) if knots[i] <= t and knots[i] < knots[i + 1])
    d = [[x * w for x in point] + [w] for point, w in zip(curve["points"], curve["weights"])][span - p:span + 1]
    for r in range(1, p + 1):
        for j in range(p, r - 1, -1):
            lo, hi = knots[span - p + j], knots[span + 1 + j - r]
            part = (t - lo) / (hi - lo)
            d[j] = [(1 - part) * a + part * b for a, b in zip(d[j - 1], d[j])]
    return [x / d[p][3] for x in d[p][:3]]


NAMED = """
lekalo: 1
geometry:
  witch: { type: named_curve, preset: witch_of_agnesi }
  folium: { type: named_curve, preset: folium_of_descartes }
  cissoid: { type: named_curve, preset: cissoid_of_diocles }
  trisectrix: { type: named_curve, preset: trisectrix_of_maclaurin }
  strophoid: { type: named_curve, preset: strophoid }
  lemniscate: { type: named_curve, preset: lemniscate_of_bernoulli }
  kappa: { type: named_curve, preset: kappa }
  cardioid: { type: named_curve, preset: cardioid }
  limacon: { type: named_curve, preset: limacon_of_pascal, a: 2, b: 1 }
  deltoid: { type: named_curve, preset: deltoid }
  astroid: { type: named_curve, preset: astroid }
  nephroid: { type: named_curve, preset: nephroid }
  trifolium: { type: named_curve, preset: rose, p: 3 }
"""
# Grezdov, Filippenko 2010; those without an equation there by Lawrence 1972. Of size 1.
IMPLICIT = {
    "witch": lambda x, y: (x * x + 1) * y - 1,
    "folium": lambda x, y: x**3 + y**3 - 3 * x * y,
    "cissoid": lambda x, y: x * (x * x + y * y) - y * y,
    "trisectrix": lambda x, y: x * (x * x + y * y) - (3 * x * x - y * y),
    "strophoid": lambda x, y: y * y * (1 - x) - x * x * (1 + x),
    "lemniscate": lambda x, y: (x * x + y * y) ** 2 - 2 * (x * x - y * y),
    "kappa": lambda x, y: (x * x + y * y) * y * y - x * x,
    "cardioid": lambda x, y: (x * x + y * y + 2 * x) ** 2 - 4 * (x * x + y * y),
    "limacon": lambda x, y: (x * x + y * y - 2 * x) ** 2 - (x * x + y * y),
    "deltoid": lambda x, y: (x * x + y * y) ** 2 + 18 * (x * x + y * y) - 27 - 8 * (x**3 - 3 * x * y * y),
    "astroid": lambda x, y: (x * x + y * y - 1) ** 3 + 27 * x * x * y * y,
    "nephroid": lambda x, y: ((x * x + y * y - 4) ** 3 - 108 * y * y) / 100,
    "trifolium": lambda x, y: (x * x + y * y) ** 2 - x**3 + 3 * x * y * y,
}


class ExportNurbs(ProgramTest):
    def check(self, curves, homogeneous_at):
        for name, curve in curves.items():
            lo, hi = curve["knots"][curve["degree"]], curve["knots"][-1 - curve["degree"]]
            for k in range(8):
                t = lo + (hi - lo) * (k + 0.37) / 8
                found = homogeneous_at(curve, t)
                point = self.json_of("evaluate", "scene.yaml", name, "--at", repr(t))["point"]
                for a, b in zip(found[:3], point):
                    self.assertLessEqual(abs(a / found[3] - b), 1e-13 + curve["deviation"], (name, t))

    def exported(self, *names):
        self.write("scene.yaml", SCENE)
        self.run_program("export", "scene.yaml", *names, "-o", "curves.json", "--quiet")
        return {curve["name"]: curve for curve in json.loads(self.bytes_of("curves.json"))["curves"]}

    def test_they_are_the_curves(self):
        curves = self.exported("open", "closed", "spring", "kink")
        self.assertEqual([curve["exact"] for curve in curves.values()], [True, True, False, False])

        def homogeneous_at(curve, t):
            total = [0, 0, 0, 0]
            for i, (point, weight) in enumerate(zip(curve["points"], curve["weights"])):
                n = basis(curve["degree"], curve["knots"], i, t)
                total = [a + n * weight * x for a, x in zip(total, [*point, 1])]
            return total

        self.check(curves, homogeneous_at)

    def test_rational_named_curves(self):
        """By de Boor's algorithm on what is written: implicit equations and parametric formulas hold."""
        self.write("scene.yaml", NAMED)
        self.run_program("export", "scene.yaml", *IMPLICIT, "-o", "curves.json", "--quiet")
        curves = json.loads(self.bytes_of("curves.json"))["curves"]
        self.assertEqual([curve["name"] for curve in curves], list(IMPLICIT))
        for curve in curves:
            self.assertTrue(curve["exact"], curve["name"])
            lo, hi = curve["knots"][curve["degree"]], curve["knots"][-1 - curve["degree"]]
            for k in range(101):
                x, y, z = de_boor(curve, lo + (hi - lo) * k / 101)
                self.assertLess(abs(IMPLICIT[curve["name"]](x, y)), 2e-12, (curve["name"], k))
                self.assertEqual(z, 0)

    def test_scipy_reads_them(self):
        try:
            import numpy
            from scipy.interpolate import BSpline
        except ImportError:
            self.skipTest("SciPy is not installed")

        def homogeneous_at(curve, t):
            weights = numpy.array(curve["weights"])[:, None]
            return BSpline(curve["knots"], numpy.hstack([numpy.array(curve["points"]) * weights, weights]), curve["degree"])(t)

        self.check(self.exported("open", "closed", "spring", "kink"), homogeneous_at)

    def test_objects_are_written_where_they_are(self):
        curves = self.exported()
        self.assertEqual(sorted(curves), ["open", "rim"])
        self.assertEqual(curves["rim"]["points"][0], [12, 0, 0])
        self.assertAlmostEqual(min(curves["rim"]["weights"]), math.sqrt(0.5), delta=1e-15)

    def test_errors(self):
        self.write("scene.yaml", SCENE)
        _, errors = self.run_program("export", "scene.yaml", "block", "-o", "x.json", code=2)
        self.assertIn("'block' is no curve or surface", errors)
        _, errors = self.run_program("measure", "scene.yaml", "wall", "--nurbs", code=2)
        self.assertIn("'wall' has no bounds", errors)

    def test_surfaces(self):
        """Pieces in Bernstein form, and whole nets by their knots, are the surfaces that `evaluate` tells."""
        self.write("scene.yaml", SURFACES)
        self.run_program("export", "scene.yaml", "net", "ball", "swept", "wave", "-o", "s.json", "--quiet")
        surfaces = {one["name"]: one for one in json.loads(self.bytes_of("s.json"))["surfaces"]}
        self.assertEqual([one["exact"] for one in surfaces.values()], [True, True, False, False])
        for name in ("net", "swept", "wave"):
            surface = surfaces[name]
            self.assertLess(surface["deviation"], 1e-11)
            for piece in surface["pieces"][:: max(1, len(surface["pieces"]) // 5)]:
                (u0, u1), (v0, v1) = piece["domain"]
                found = bezier_point(piece, 0.3, 0.6)
                there = self.json_of("evaluate", "scene.yaml", name, "--at", f"{u0 + 0.3 * (u1 - u0)!r},{v0 + 0.6 * (v1 - v0)!r}")
                for a, b in zip(found, there["point"]):
                    self.assertAlmostEqual(a, b, delta=1e-11, msg=name)
        net = surfaces["net"]
        total = [0, 0, 0, 0]
        for i, row in enumerate(net["points"]):
            for j, point in enumerate(row):
                weight = (basis(net["degree"][0], net["knots_u"], i, 0.4) * basis(net["degree"][1], net["knots_v"], j, 0.7)
                          * net["weights"][i][j])
                total = [a + weight * x for a, x in zip(total, [*point, 1])]
        for a, b in zip(total, self.json_of("evaluate", "scene.yaml", "net", "--at", "0.4,0.7")["point"]):
            self.assertAlmostEqual(a / total[3], b, delta=1e-14)
        for piece in surfaces["ball"]["pieces"]:
            self.assertAlmostEqual(math.hypot(*bezier_point(piece, 0.2, 0.9)), 2, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
