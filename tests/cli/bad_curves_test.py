"""Bad data of every type of curve that takes such: the message stands at the field, names the item and a cure."""

import unittest

from program import SCENE_ERROR, ProgramTest

# Types that go through or near points, with what else their example needs and the least number of points, open and closed.
THROUGH = {"spline_curve": ("", 2, 3), "hermite_curve": ("", 2, 3), "lagrange_curve": ("", 2, None),
           "tension_spline": (", tension: 2", 2, 3), "exponential_spline": (", tension: 2", 2, 3),
           "smoothing_spline": (", stiffness: 1", 3, 3), "local_spline": ("", 3, 3), "elastica": ("", 2, None),
           "fit_curve": (", spans: 1, degree: 2", 2, None), "local_interpolant": ("", 2, 3), "arc_blend_curve": ("", 2, 3)}
LINES = {"polyline": ("", 2, 3), "polygon": ("", 3, None), "rounded_polyline": (", corner_radius: 0.1", 2, None)}
NURBS = {"nurbs_curve": (", degree: 2", 3, 3), "bezier_curve": ("", 2, None)}
PARAMETERS = [one for one in THROUGH if one not in ("elastica", "local_interpolant", "arc_blend_curve")]
POINTS = [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]]
CORNER = "[[0, 0], [2, 0], [2, 1], [0, 1]]"


class BadCurves(ProgramTest):
    def refused(self, curve, field, *words):
        """The curve has an error at the value of `field` (None: anywhere), with these words and a cure."""
        line = f"  it: {{ type: {curve} }}"
        self.write("scene.yaml", f"lekalo: 1\ngeometry:\n{line}\nlights: {{}}\n")
        error = self.run_program("check", "scene.yaml", code=SCENE_ERROR)[1]
        with self.subTest(curve):
            if field:
                column = line.index(f" {field}: ") + len(field) + 4
                self.assertIn(f"scene.yaml:3:{column}: ", error)
            for word in words:
                self.assertIn(word, error)
            self.assertRegex(error, r"\nhint: |at least|must|expected \d")  # what to do, or what there must be

    def test_too_few_points(self):
        for name, (more, least, least_closed) in {**THROUGH, **LINES, **NURBS}.items():
            few = POINTS[:least - 1]
            self.refused(f"{name}, points: {few}{more}", "points", "at least", f"{least - 1}")
            if least_closed:
                self.refused(f"{name}, points: {POINTS[:2]}, closed: true{more}", "points", "at least 3", "2")
        for name in ("arc_through_points", "rational_cubic", "conic"):
            self.refused(f"{name}, points: {POINTS[:2]}", "points", "expected", "2")

    def test_repeated_points(self):
        repeated = [POINTS[0], POINTS[1], POINTS[1], POINTS[3]]
        for name, (more, _, least_closed) in {**THROUGH, **LINES}.items():
            if name != "local_interpolant":  # which rests there, as its parameter goes on
                self.refused(f"{name}, points: {repeated}{more}", "points", "1 and 2 coincide", "leave one of them out")
            if least_closed:
                self.refused(f"{name}, points: {POINTS + POINTS[:1]}, closed: true{more}", "points",
                             "closed: true takes unrepeated points")
        self.refused("segment, from: [1, 2], to: [1, 2]", "to", "the ends of the segment coincide", "move one")
        self.refused("hermite_edge, from: [1, 2], to: [1, 2], normals: [[0, 1], [1, 0]]", "to", "ends where it begins")
        self.refused("line_arc_curve, nodes: [{ at: [0, 0] }, { at: [0, 0] }, { at: [1, 1] }]", "nodes",
                     "node 0", "leave one of its ends out")
        self.refused("g2_curve, points: [[0, 0, 0], [1, 0, 0], [2, 1, 0], [2, 1, 0]], segments: [{ to: [3, 1, 1], "
                     "tangent: z }]", "points", "the last two points coincide", "points[2]")
        self.refused("circular_arc, points: [[1, 0], [1, 0]], radius: 2", "points", "the ends of an arc coincide")
        self.refused("g2_curve, points: [[2, 3.5, 1], [3, 2.5, -0.5], [3.3, 4.7, 2.1], [5, 3.5, 2]], segments: "
                     "[{ to: [5, 3.5, 2], tangent: z }]", "segments", "segment 2: its ends coincide")

    def test_knots_and_parameters_that_decrease(self):
        for name in PARAMETERS:
            more = THROUGH[name][0]
            self.refused(f"{name}, points: {POINTS}, knots: [0, 1, 3, 2, 4]{more}", "knots",
                         "point 2 is 3 and that of point 3 is 2")
        self.refused(f"nurbs_curve, points: {POINTS}, degree: 2, knots: [0, 0, 0, 2, 1, 3, 3, 3]", "knots",
                     "knot 3 is 2 and knot 4 is 1")
        self.refused("basis_function, degree: 1, knots: [0, 2, 1, 3], index: 0", "knots", "knot 1 is 2 and knot 2 is 1")
        self.refused("basis_function, degree: 1, knots: [0, 1, 1, 1, 2], index: 0", "knots", "the knot 1 stands more than 2")

    def test_weights(self):
        self.refused(f"nurbs_curve, points: {POINTS}, weights: [0, 0, 0, 0, 0]", "weights", "all weights are zero")
        self.refused(f"bezier_curve, points: {POINTS}, weights: [1, 1, -9, 1, 1]", "weights", "the denominator vanishes")
        self.refused(f"nurbs_curve, points: {POINTS}, weights: [1, 2]", "weights", "2 weights do not fit 5 points")
        for type in ("fit_curve, spans: 1", "smoothing_spline, stiffness: 1"):
            self.refused(f"{type}, points: {POINTS}, weights: [1, 1, 0, 1, 1]", "weights", "weight 2 is 0, not positive")
        for type in ("local_spline, passes: 2", "smoothing_spline"):
            self.refused(f"{type}, points: {POINTS}, corridor: [1, 1, -1, 1, 1]", "corridor", "half-width 2 is negative")
            self.refused(f"{type}, points: {POINTS}, corridor: [1, 1]", "corridor", "2 half-widths do not fit 5 points")

    def test_tangents(self):
        on_a_line = "[[0, 0], [1, 1], [2, 2]]"
        self.refused(f"conic_arc, points: {on_a_line}, weight: 1", "points", "lie on one line", "move one of them")
        self.refused(f"arc_through_points, points: {on_a_line}", "points", "lie on one line", "move one of the points")
        self.refused("rational_cubic, points: [[0, 0], [1, 1], [2, 2], [4, 0]], start_curvature: 1", "start_curvature",
                     "lie on one line", "move one of them")
        self.refused("g2_curve, points: [[2, 3.5, 1], [3, 2.5, -0.5], [3.3, 4.7, 2.1], [5, 3.5, 2]], segments: "
                     "[{ to: [8, 0, 3], tangent: [1.7, -1.2, -0.1] }]", "segments", "segment 2: its tangent line is parallel")
        self.refused(f"hermite_curve, points: {POINTS}, tangents: [[1, 0], [0, 1]]", "tangents", "5 points need 5 tangents")
        self.refused(f"hermite_curve, points: {POINTS}, directions: [[1, 0], [0, 0], [1, 0], [1, 0], [1, 0]]", "directions",
                     "the vector of point 1 is zero", "give it a direction")
        self.refused("hermite_edge, from: [0, 0], to: [1, 2], normals: [[0, 1], [0, 0]]", "normals", "normal 1 is zero")
        self.refused("circular_arc, points: [[1, 0], [0, 1]], radius: 2, normal: x", "normal", "at right angles to the chord")

    def test_corners_that_do_not_fit(self):
        for curve in (f"polygon, points: {CORNER}", f"rounded_polyline, points: {CORNER}", "rectangle, size: [2, 1]",
                      "regular_polygon, sides: 6, radius: 1"):
            self.refused(f"{curve}, corner_radius: 5", "corner_radius", "the side from point",
                         "the largest radius that fits is")
        self.refused("line_arc_curve, nodes: [{ at: [0, 0] }, { at: [1, 0], fillet: 9 }, { at: [1, 1] }]", "nodes",
                     "the line from node 0 to node 1", "times these radii fit")
        self.refused("line_arc_curve, nodes: [{ at: [0, 0] }, { at: [3, 0], join: arc, radius: 1 }, { at: [1, 1] }]", "nodes",
                     "the arc from node", "the radius must be at least")
        self.refused("profile, preset: L, height: 5, width: 5, web_thickness: 1, toe_radius: 9", "toe_radius", "has no room")
        self.refused("rounded_corners, of: { type: polyline, points: [[0, 0], [1, 0], [1, 1]] }, zone: 9", "zone")

    def test_closed_curves_that_do_not_close(self):
        self.refused("formula_curve, point: [t, t^2], domain: [0, 1], closed: true", "closed", "its ends do not meet")
        self.refused("composite_curve, of: [{ type: segment, from: [0, 0], to: [1, 0] }], closed: true", "of",
                     "segment 0 begins 1 from the end of segment 0", "leave out 'closed'")
        self.refused("nurbs_of, of: { type: segment, from: [0, 0], to: [1, 0] }, closed: true", "closed", "do not meet")
        self.refused("local_interpolant, of: { type: segment, from: [0, 0], to: [1, 0] }, cells: 5, closed: true", "closed",
                     "is not closed")

    def test_words_among_numbers(self):
        self.write("word.csv", "x,y\n0,0\n1,2\n3,abc\n4,0\n6,1\n")
        self.write("short.csv", "0,0\n1,2\n3\n4,0\n")
        for name, (more, _, _) in {**THROUGH, **LINES, **NURBS}.items():
            self.refused(f"{name}, points: {{ file: word.csv }}{more}", None, "word.csv:4:3: expected a number, found 'abc'",
                         "scene.yaml:3:")
            self.refused(f"{name}, points: {{ file: short.csv }}{more}", None, "short.csv:3:1: this row has 1 cell")
            self.refused(f"{name}, points: [[0, 0], [1, abc], [2, 0], [3, 1]]{more}", None, "unknown name 'abc'")


if __name__ == "__main__":
    unittest.main()
