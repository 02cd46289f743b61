"""Splines through points against those of SciPy, on random points with uneven parameters. Skipped where SciPy is not installed."""

import unittest

from program import ProgramTest

try:
    import numpy
    from scipy import interpolate
except ImportError:
    numpy = None


@unittest.skipUnless(numpy, "python3-scipy is not installed")
class Splines(ProgramTest):
    def setUp(self):
        super().setUp()
        self.random = numpy.random.default_rng(1985)
        self.count = 0

    def data(self, count):
        steps = self.random.uniform(0.2, 2, count - 1)
        return numpy.concatenate([[0], numpy.cumsum(steps)]), self.random.uniform(-1, 1, (count, 3))

    def check(self, fields, points, expected, t, tolerance=2e-13):
        """The curve of the fields through points against expected(parameters), at places of t's range."""
        self.count += 1
        places = numpy.linspace(t[0], t[-1], 101)
        rows = [",".join(repr(float(x)) for x in (place, *point)) for place, point in zip(places, expected(places))]
        self.write(f"s{self.count}.csv", "t,x,y,z\n" + "\n".join(rows) + "\n")
        self.write(f"p{self.count}.csv", "\n".join(",".join(repr(float(x)) for x in point) for point in points) + "\n")
        self.write(f"c{self.count}.yaml", "lekalo: 1\ngeometry:\n  c: { points: { file: p%d.csv }, %s }\n" % (self.count, fields))
        found = self.json_of("measure", f"c{self.count}.yaml", "c", "--against", f"s{self.count}.csv",
                             "--tolerance", tolerance)
        self.assertTrue(found["passed"], fields)

    def knots(self, t):
        return "knots: [%s]" % ", ".join(repr(float(x)) for x in t)

    def vector(self, v):
        return "[%s]" % ", ".join(repr(float(x)) for x in v)

    def test_cubic_splines_of_all_ends(self):
        for count in (4, 5, 12, 60):
            t, p = self.data(count)
            a, b = self.random.uniform(-1, 1, (2, 3))
            for ends, of_scipy in ((["natural", "natural"], "natural"), (["not_a_knot", "not_a_knot"], "not-a-knot")):
                self.check(f"type: spline_curve, ends: [{', '.join(ends)}], {self.knots(t)}", p,
                           interpolate.CubicSpline(t, p, bc_type=of_scipy), t)
            self.check(f"type: spline_curve, {self.knots(t)}, start_tangent: {self.vector(a)}, end_tangent: {self.vector(b)}", p,
                       interpolate.CubicSpline(t, p, bc_type=((1, a), (1, b))), t)
            self.check(f"type: spline_curve, {self.knots(t)}, start_tangent: {self.vector(a)}, end_second_derivative: {self.vector(b)}",
                       p, interpolate.CubicSpline(t, p, bc_type=((1, a), (2, b))), t)
            closed = numpy.vstack([p, p[:1]])
            t = numpy.append(t, t[-1] + 1.5)
            self.check(f"type: spline_curve, closed: true, {self.knots(t)}", p,
                       interpolate.CubicSpline(t, closed, bc_type="periodic"), t)

    def test_any_degree(self):
        for degree in range(1, 9):
            t, p = self.data(14)
            middles = (t[1:] + t[:-1]) / 2
            inner = t[(degree + 1) // 2:-(degree + 1) // 2] if degree % 2 else middles[degree // 2:-(degree // 2)]
            knots = numpy.concatenate([[t[0]] * (degree + 1), inner, [t[-1]] * (degree + 1)])
            self.check(f"type: spline_curve, degree: {degree}, {self.knots(t)}", p,
                       interpolate.make_interp_spline(t, p, degree, t=knots), t, 1e-11)

    def test_natural_quintic(self):
        t, p = self.data(9)
        a = self.random.uniform(-1, 1, 3)
        zero = numpy.zeros(3)
        of_scipy = interpolate.make_interp_spline(t, p, 5, bc_type=([(3, zero), (4, zero)], [(1, a), (3, zero)]))
        self.check(f"type: spline_curve, degree: 5, ends: natural, end_tangent: {self.vector(a)}, {self.knots(t)}", p, of_scipy, t, 1e-11)

    def test_hermite_curves_with_estimated_tangents(self):
        for count in (2, 3, 7, 40):
            t, p = self.data(count)
            self.check(f"type: hermite_curve, estimate: monotone, {self.knots(t)}", p, interpolate.PchipInterpolator(t, p), t)
            if count > 2:
                self.check(f"type: hermite_curve, estimate: akima, {self.knots(t)}", p, interpolate.Akima1DInterpolator(t, p), t)
            q = self.random.uniform(-1, 1, p.shape)
            tangents = "tangents: [%s]" % ", ".join(self.vector(v) for v in q)
            self.check(f"type: hermite_curve, {tangents}, {self.knots(t)}", p, interpolate.CubicHermiteSpline(t, p, q), t)

    def test_least_squares(self):
        for degree in (1, 2, 3, 5):
            t, p = self.data(50)
            w = self.random.uniform(0.5, 2, 50)
            breaks = t[[8, 15, 24, 33, 40]] + 0.05
            knots = numpy.concatenate([[t[0]] * (degree + 1), breaks, [t[-1]] * (degree + 1)])
            weights = "weights: [%s]" % ", ".join(repr(float(x)) for x in w * w)  # SciPy squares its weights
            breaks = "breaks: [%s]" % ", ".join(repr(float(x)) for x in breaks)
            self.check(f"type: fit_curve, degree: {degree}, {breaks}, {weights}, {self.knots(t)}", p,
                       interpolate.make_lsq_spline(t, p, knots, degree, w=w), t, 1e-11)

    def test_smoothing_splines(self):
        for count, stiffness in ((5, 0.1), (20, 1.5), (60, 1e-3)):
            t, p = self.data(count)
            w = self.random.uniform(0.5, 2, count)
            # SciPy's takes one coordinate.
            each = [interpolate.make_smoothing_spline(t, p[:, k], w=w, lam=stiffness) for k in range(3)]
            weights = "weights: [%s]" % ", ".join(repr(float(x)) for x in w)
            self.check(f"type: smoothing_spline, stiffness: {stiffness!r}, {weights}, {self.knots(t)}", p,
                       lambda at: numpy.stack([one(at) for one in each], axis=1), t, 1e-11)

    def test_polynomials(self):
        for count in (2, 5, 9, 12):
            t, p = self.data(count)
            t = numpy.cos(numpy.pi * (numpy.arange(count)[::-1] + 0.5) / count)  # Chebyshev's: SciPy itself errs little
            self.check(f"type: lagrange_curve, {self.knots(t)}", p, interpolate.BarycentricInterpolator(t, p), t)

    def test_polynomials_with_tangents(self):
        t, p = self.data(4)
        q = self.random.uniform(-1, 1, (2, 3))
        of_scipy = interpolate.KroghInterpolator([t[0], t[1], t[1], t[2], t[3], t[3]], [p[0], p[1], q[0], p[2], p[3], q[1]])
        tangents = f"tangents: [{{ point: 1, vector: {self.vector(q[0])} }}, {{ point: 3, vector: {self.vector(q[1])} }}]"
        self.check(f"type: lagrange_curve, {tangents}, {self.knots(t)}", p, of_scipy, t)


if __name__ == "__main__":
    unittest.main()
