"""Curves as NURBS curves in JSON: read back they are the curves that `evaluate` tells (by the
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
objects:
  - { shape: rim, transform: { translate: [10, 0, 0] } }
  - { shape: open }
"""


def basis(degree, knots, i, t):
    """The recursion of Cox and de Boor, 0/0 = 0."""
    if degree == 0:
        return 1.0 if knots[i] <= t < knots[i + 1] else 0.0
    left, right = knots[i + degree] - knots[i], knots[i + degree + 1] - knots[i + 1]
    return ((t - knots[i]) / left * basis(degree - 1, knots, i, t) if left > 0 else 0) + (
        (knots[i + degree + 1] - t) / right * basis(degree - 1, knots, i + 1, t) if right > 0 else 0)


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
        _, errors = self.run_program("export", "scene.yaml", "wall", "-o", "x.json", code=2)
        self.assertIn("'wall' is no curve", errors)
        _, errors = self.run_program("measure", "scene.yaml", "wall", "--nurbs", code=2)
        self.assertIn("'wall' is no curve", errors)


if __name__ == "__main__":
    unittest.main()
