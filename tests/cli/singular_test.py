"""Formulas with infinite slopes, steps and poles: what is drawn is the curve, and no output holds a number that is none."""

import math
import re
import unittest
import xml.etree.ElementTree as tree

from program import SCENE_ERROR, ProgramTest, USAGE

NUMBER = r"-?\d+(?:\.\d+)?"


def places_of(path, each=40):
    """Places along a path of lines and cubic curves, in millimetres."""
    places = []
    for kind, words in re.findall(r"([MLC])([^MLC]*)", path):
        numbers = [float(x) for x in re.findall(NUMBER, words)]
        points = list(zip(numbers[::2], numbers[1::2]))
        if kind == "M":
            places.append(points[0])
            continue
        a = places[-1]
        b, c, d = points if kind == "C" else (tuple((2 * p + q) / 3 for p, q in zip(a, points[0])),
                                              tuple((p + 2 * q) / 3 for p, q in zip(a, points[0])), points[0])
        for i in range(1, each + 1):
            s, r = i / each, 1 - i / each
            places.append(tuple(r**3 * a[k] + 3 * r * r * s * b[k] + 3 * r * s * s * c[k] + s**3 * d[k]
                                for k in (0, 1)))
    return places


def farthest(places, line):
    """The largest distance of a place from a polyline."""
    def distance(p, a, b):
        x, y = b[0] - a[0], b[1] - a[1]
        share = max(0, min(1, ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / max(x * x + y * y, 1e-300)))
        return math.hypot(p[0] - a[0] - share * x, p[1] - a[1] - share * y)
    return max(min(distance(p, a, b) for a, b in zip(line, line[1:])) for p in places)


class Singular(ProgramTest):
    def drawn(self, formula, domain, y):
        """Paths of a graph on a page of about 100 mm x 100 mm; a segment across the page tells its scales."""
        self.write("graph.yaml", f"""lekalo: 1
geometry:
  f: {{ type: formula_curve, y: '{formula}', domain: {list(domain)} }}
  scale: {{ type: segment, from: [{domain[0]}, {y[0]}], to: [{domain[1]}, {y[1]}] }}
camera: {{ type: graph, x: {list(domain)}, y: {list(y)} }}
image: {{ size: [100 mm, 100 mm] }}
""")
        self.run_program("draw", "graph.yaml", "--quiet", "-o", "graph.svg")
        text = self.bytes_of("graph.svg").decode()
        self.assertNotRegex(text, r"(?i)\b-?(nan|inf)\b")
        paths = {"f": [], "scale": []}
        for element in tree.fromstring(text).iter("{http://www.w3.org/2000/svg}path"):
            paths[element.get("id").split("-")[0]].append(places_of(element.get("d")))
        (left, low), (right, high) = paths["scale"][0][0], paths["scale"][0][-1]
        self.to_page = lambda x, f: (left + (x - domain[0]) / (domain[1] - domain[0]) * (right - left),
                                     low + (f - y[0]) / (y[1] - y[0]) * (high - low))
        self.to_graph = lambda p: (domain[0] + (p[0] - left) / (right - left) * (domain[1] - domain[0]),
                                   y[0] + (p[1] - low) / (high - low) * (y[1] - y[0]))
        return paths["f"]

    def assert_whole(self, formula, f, domain, y, parameters):
        """One path, nowhere farther than 0.02 mm from the curve, which is nowhere farther than that from it."""
        paths = self.drawn(formula, domain, y)
        self.assertEqual(len(paths), 1, formula)
        true = [self.to_page(t, f(t)) for t in parameters]
        self.assertLess(farthest(paths[0][::5], true), 0.02, formula)
        self.assertLess(farthest(true[::5], paths[0]), 0.02, formula)

    def test_infinite_slopes_are_drawn_whole(self):
        """Roots at ends, inside at a binary and at another number, of both signs; parameters crowd at the roots."""
        cosines = [-math.cos(math.pi * i / 2000) for i in range(2001)]
        self.assert_whole("acos(x)/(1 rad)", math.acos, (-1, 1), (-0.5, 3.5), cosines)
        self.assert_whole("sqrt(1-x^4)", lambda x: math.sqrt(max(0, 1 - x**4)), (-1, 1), (-0.5, 1.5), cosines)
        powers = [s * (i / 1000)**4 for s in (-1, 1) for i in range(1001)]
        for at in (0, 0.3):
            near = sorted({at + p * (1 + at) for p in powers if p < 0} | {at + p * (1 - at) for p in powers if p > 0} | {at})
            self.assert_whole(f"sqrt(abs(x-{at}))", lambda x: math.sqrt(abs(x - at)), (-1, 1), (-0.5, 1.5), near)
            self.assert_whole(f"cbrt(x-{at})", lambda x: math.copysign(abs(x - at)**(1 / 3), x - at), (-1, 1),
                              (-1.5, 1.5), near)

    def test_steps_are_gaps(self):
        """One level path for each value; nothing joins them."""
        for formula, count in (("floor(2*x)/2", 8), ("ceil(x/0.3)/2", 14), ("sign(x-0.3)", 2), ("round(x)", 5),
                               ("1 if x > 0.1 else -1", 2)):
            paths = self.drawn(formula, (-2, 2), (-5, 5))
            self.assertEqual(len(paths), count, formula)
            for path in paths:
                heights = [p[1] for p in path]
                self.assertLess(max(heights) - min(heights), 1e-3, formula)
            width = sum(self.to_graph(path[-1])[0] - self.to_graph(path[0])[0] for path in paths)
            self.assertAlmostEqual(width, 4, delta=1e-3)
        slanted = self.drawn("mod(x, 0.7)", (-2, 2), (-5, 5))
        self.assertEqual(len(slanted), 6)

    def test_poles_part_a_graph(self):
        for formula, f, count in (("tan(x)", math.tan, 3), ("1/x", lambda x: 1 / x, 2),
                                  ("1/(x-0.3)", lambda x: 1 / (x - 0.3), 2),
                                  ("1/(x-0.3)^2 - 3", lambda x: 1 / (x - 0.3)**2 - 3, 2)):
            paths = self.drawn(formula, (-4, 4), (-5, 5))
            self.assertEqual(len(paths), count, formula)
            for path in paths:
                for p in path[::7]:
                    x, y = self.to_graph(p)
                    if abs(y) < 5:
                        slope = (f(x + 1e-6) - f(x - 1e-6)) / 2e-6
                        self.assertLess(abs(f(x) - y) / math.hypot(1, slope), 2e-3, formula)
            self.assertEqual(sum(abs(abs(self.to_graph(path[k])[1]) - 5) < 0.5 for path in paths for k in (0, -1)),
                             2 * (count - 1), formula)

    def test_waves_are_no_common_part(self):
        """Crossings at even steps, where a common part is asked for: 24 half waves over the axis and over its way back."""
        self.write("waves.yaml", """lekalo: 1
geometry:
  wave: { type: formula_curve, y: 'sin(24*pi*x)', domain: [0, 1] }
  axis: { type: segment, from: [0, 0], to: [1, 0] }
  both: { type: composite_curve, of: [axis, { type: formula_curve, point: ['1 - t', 'sin(24*pi*t)', 0], domain: [0, 1] }] }
""")
        found = self.json_of("measure", "waves.yaml", "wave", "--intersect", "axis")
        self.assertEqual(found["common"], [])
        self.assertEqual(len(found["points"]), 25)
        for k, point in enumerate(found["points"]):
            self.assertAlmostEqual(point["t"], k / 24, delta=1e-12)
        self.assertEqual(self.json_of("measure", "waves.yaml", "both", "--self-intersection")["common"], [])

    def test_distance_of_a_curve_on_a_surface(self):
        """A contour lies on its surface all along: that is the only minimum, at a pinch point too."""
        self.write("on.yaml", """lekalo: 1
geometry:
  umbrella: { type: formula_surface, point: [u*v, u, v^2], domain: { u: [-1, 1], v: [-1, 1] } }
  own: { type: self_intersection_curve, of: umbrella }
  ball: { type: sphere_surface, radius: 2 }
  pipe: { type: cylinder_surface, frame: { origin: [1, 0, -2.6] }, radius: 1, height: 5.2 }
  window: { type: intersection_curve, of: [ball, pipe] }
""")
        for surface, curve in (("umbrella", "own"), ("ball", "window"), ("pipe", "window")):
            for one, other in ((surface, curve), (curve, surface)):
                found = self.json_of("measure", "on.yaml", one, "--to", other)
                self.assertEqual((found["distance"], len(found["minima"])), (0, 1), curve)
                self.assertFalse(found["minima"][0]["isolated"])

    def test_evaluate_says_where_there_is_no_number(self):
        """The value is there, the derivatives of a root at zero are not."""
        self.write("root.yaml", """lekalo: 1
geometry:
  r: { type: formula_curve, y: 'sqrt(x)', domain: [0, 1] }
  s: { type: formula_surface, z: 'sqrt(x)', domain: { u: [0, 1], v: [0, 1] } }
""")
        found = self.json_of("evaluate", "root.yaml", "r", "--at", 0)
        self.assertEqual((found["point"], found["derivatives"], found["tangent"], found["curvature"]),
                         ([0, 0, 0], [None, None], None, None))
        found = self.json_of("evaluate", "root.yaml", "s", "--at", "0,0.5")
        self.assertEqual((found["point"], found["du"], found["dv"]), ([0, 0.5, 0], None, [0, 1, 0]))
        for name, at in (("r", "0"), ("s", "0,0.5")):
            self.assertNotRegex(self.run_program("evaluate", "root.yaml", name, "--at", at)[0], r"(?i)\b-?(nan|inf)\b")

    STEPS = """lekalo: 1
geometry:
  st: { type: formula_surface, z: 'sign(y)', domain: { u: [-1, 1], v: [-1, 1] } }
  slanted: { type: formula_surface, z: 'sign(y + 0.5*x)', domain: { u: [-1, 1], v: [-1, 1] } }
  either: { type: formula_surface, z: '1 if y > 0 else -1', domain: { u: [-1, 1], v: [-1, 1] } }
  fl: { type: formula_surface, z: 'floor(x)', domain: { u: [-1.5, 1.5], v: [-1, 1] } }
  roof: { type: formula_surface, z: 'abs(x)', domain: { u: [-1, 1], v: [-1, 1] } }
  corner: { type: formula_surface, z: 'x if x > 0 else 0', domain: { u: [-1, 1], v: [-1, 1] } }
  half: { type: formula_surface, z: 'sqrt(x) if x > 0 else -1', domain: { u: [-1, 1], v: [-1, 1] } }
  wall: { type: plane, frame: { origin: [0.25, 0, 0], z: x }, size: [6, 6] }
  through_gap: { type: segment, from: [0.3, -0.1, -0.5], to: [0.3, 0.1, 0.5] }
  through_sheet: { type: segment, from: [0.3, 0, -2], to: [0.3, 0.5, 2] }
  along_sheet: { type: segment, from: [0.3, -0.5, 1], to: [0.3, 0.5, 1] }
  stair: { type: formula_curve, y: 'floor(x)', domain: [-1.5, 1.5] }
  up: { type: segment, from: [-1.5, -1.75], to: [1.5, 1.25] }
objects: { shape: st, lines: { boundary: thick, parameter: { at_u: 5 } } }
camera: { type: perspective, from: [0, -6, 1], at: [0, 0, 0], field_of_view: 40 }
image: { size: [96, 96] }
"""

    def lengths(self, *arguments):
        found = self.json_of("measure", "steps.yaml", *arguments)
        self.assertTrue(found["complete"], arguments)
        return sorted(branch["length"] for branch in found["branches"])

    def test_sections_end_at_steps(self):
        """Nothing bridges the gap; at a kink both sides are there. Lengths by hand."""
        self.write("steps.yaml", self.STEPS)
        for arguments, lengths in ((("st", "--section", "0.25,0,0,1,0,0"), [1, 1]),
                                   (("slanted", "--section", "0.5,0,0,1,0,0"), [0.75, 1.25]),
                                   (("either", "--section", "0.25,0,0,1,0,0"), [1, 1]),
                                   (("fl", "--section", "0,0.25,0,0,1,0"), [0.5, 0.5, 1, 1]),
                                   (("st", "--intersect", "wall"), [1, 1]),
                                   (("wall", "--intersect", "st"), [1, 1]),
                                   (("roof", "--section", "0,0.2,0,0,1,0"), [math.sqrt(2), math.sqrt(2)]),
                                   (("roof", "--section", "0,0,0,0,0,1"), [2]),
                                   (("corner", "--section", "0,0,0,0,1,0"), [1, math.sqrt(2)])):
            self.assert_near(self.lengths(*arguments), lengths, 1e-11)
        self.assertFalse(self.json_of("measure", "steps.yaml", "half", "--section", "0,0,0,0,1,0")["complete"])

    def test_distances_from_surfaces_with_steps(self):
        """Both edges of a step count, and nothing between them."""
        self.write("steps.yaml", self.STEPS)
        for name, to, distance in (("either", "0,0,0.1", 0.9), ("fl", "0,0,0.1", 0.1), ("fl", "-0.2,0,0", 0.2),
                                   ("st", "0,0.2,0.1", 0.9), ("st", "0,0.2,-0.9", math.hypot(0.2, 0.1)),
                                   ("slanted", "0,0.01,0", 1), ("corner", "-0.1,0,-0.2", 0.2),
                                   ("corner", "0.5,0,-0.5", math.hypot(0.5, 0.5))):
            found = self.json_of("measure", "steps.yaml", name, "--to", to)
            self.assertAlmostEqual(found["distance"], distance, delta=1e-12, msg=f"{name} {to}")
        out, errors = self.run_program("measure", "steps.yaml", "half", "--to", "0,0,0", code=USAGE)
        self.assertIn("may step", errors)
        out, errors = self.run_program("measure", "steps.yaml", "st", "--to", "through_gap", code=USAGE)
        self.assertIn("from points alone", errors)

    def test_curves_pass_through_gaps(self):
        self.write("steps.yaml", self.STEPS)
        def points(*arguments):
            return self.json_of("measure", "steps.yaml", *arguments)["points"]
        self.assertEqual(points("st", "--intersect", "through_gap"), [])
        self.assert_near([p["point"] for p in points("st", "--intersect", "through_sheet")], [[0.3, 0.375, 1]], 1e-12)
        along = self.json_of("measure", "steps.yaml", "along_sheet", "--intersect", "st")
        self.assertEqual(along["points"], [])
        self.assert_near([part["t"] for part in along["common"]], [[0.5, 1]], 1e-9)
        # y = x - 0.25 meets floor(x) where that is x - 0.25.
        self.assert_near([p["point"][0] for p in points("stair", "--intersect", "up")], [-0.75, 0.25, 1.25], 1e-12)

    def test_roots_and_poles_in_queries(self):
        """The cusp of sqrt(|t|), ends with infinite slopes, the branches of the tangent between its poles."""
        self.write("roots.yaml", """lekalo: 1
geometry:
  a: { type: formula_curve, point: ['t', 'sqrt(abs(t))', 0], domain: [-1, 1] }
  c: { type: formula_curve, y: 'acos(x)/(1 rad)', domain: [-1, 1] }
  v: { type: segment, from: [0, -2], to: [0, 2] }
  t: { type: formula_curve, y: 'tan(x)', domain: [-4, 4] }
  h: { type: segment, from: [-4, 0.25], to: [4, 0.25] }
""")
        def points(*arguments):
            found = self.json_of("measure", "roots.yaml", *arguments)
            self.assertEqual(found["common"], [])
            return [p["point"] for p in found["points"]]
        self.assert_near(points("a", "--intersect", "v"), [[0, 0, 0]], 1e-9)
        self.assert_near(points("t", "--intersect", "h"), [[math.atan(0.25) + k * math.pi, 0.25, 0] for k in (-1, 0, 1)],
                         1e-12)
        self.assertEqual(points("t", "--self-intersection"), [])
        self.assertAlmostEqual(self.json_of("measure", "roots.yaml", "c")["length"], 3.8201977, delta=1e-6)
        for name, to, near in (("a", (0.1, -1), (0, 0)), ("c", (-2, 3.3), (-1, math.pi)), ("c", (1.5, -1), (1, 0))):
            found = self.json_of("measure", "roots.yaml", name, "--to", f"{to[0]},{to[1]},0")
            self.assertAlmostEqual(found["distance"], math.dist(to, near), delta=1e-12)
            self.assertEqual(len(found["feet"]), 1)

    def test_what_is_too_large_is_refused_with_its_place(self):
        self.write("large.yaml", """lekalo: 1
parameters: { r: 1e15, b: 1 }
geometry:
  ball: { type: ball, radius: r }
  patch: { type: bezier_surface, points: [[[0, 0, 0], [b, 0, 0]], [[0, b, 0], [b, b, b]]] }
""")
        self.run_program("check", "large.yaml")
        for name, column in (("r=1.1e15", "4:3"), ("b=1e18", "5:3"), ("b=1e30", "5:3")):
            out, errors = self.run_program("draw", "large.yaml", "--set", name, "-o", "large.svg", code=SCENE_ERROR)
            self.assertIn(f"large.yaml:{column}", errors)
            self.assertIn("has coordinates beyond 1e+15", errors)
        for name, column in (("r=1e-80", "4:3"), ("b=1e-60", "5:3")):
            errors = self.run_program("check", "large.yaml", "--set", name, code=SCENE_ERROR)[1]
            self.assertIn(f"large.yaml:{column}", errors)
            self.assertIn("has no coordinate above 1e-50", errors)
        self.write("shown.yaml", """lekalo: 1
geometry: { ball: { type: ball, radius: 1 } }
objects: { shape: ball, transform: { scale: 1e20 } }
""")
        out, errors = self.run_program("check", "shown.yaml", code=SCENE_ERROR)
        self.assertIn("shown.yaml:3:", errors)
        self.write("group.yaml", """lekalo: 1
geometry: { ball: { type: ball, radius: 1 }, g: { type: group, of: [{ shape: ball, transform: { scale: 1e10 } }] } }
objects: { shape: g, transform: { scale: 1e10 } }
""")
        self.assertIn("group.yaml:3:", self.run_program("check", "group.yaml", code=SCENE_ERROR)[1])
        # A graph may leave the page.
        self.write("graph.yaml", """lekalo: 1
geometry: { c: { type: formula_curve, y: 'exp(60*x)', domain: [0, 1] } }
camera: { type: graph, y: [0, 5] }
""")
        self.run_program("check", "graph.yaml")

    def test_a_geodesic_without_end_is_refused(self):
        self.write("long.yaml", """lekalo: 1
geometry:
  t: { type: torus_surface, major_radius: 3, minor_radius: 1 }
  g: { type: geodesic_curve, of: t, from: [0, 0], direction: 30, length: 1e5 }
""")
        out, errors = self.run_program("check", "long.yaml", code=SCENE_ERROR)
        self.assertIn("long.yaml:4:", errors)
        self.assertIn("longer than 1000 times", errors)

    def test_very_long_conics_are_no_parabolas(self):
        self.write("long.yaml", """lekalo: 1
geometry:
  e: { type: ellipse, semi_axes: [1000000, 1] }
  f: { type: ellipse, semi_axes: [1, 1000000] }
  h: { type: hyperbola, semi_axes: [1000000, 1], range: [-1, 1] }
""")
        for name, kind, axis in (("e", "ellipse", [1, 0, 0]), ("f", "ellipse", [0, 1, 0]),
                                 ("h", "hyperbola", [1, 0, 0])):
            found = self.json_of("measure", "long.yaml", name)
            self.assertEqual((found["conic"], found["half_axes"]), (kind, [1e6, 1]), name)
            self.assert_near(found["axis"], axis, 0)

    def test_a_spline_through_a_thousand_points_and_itself(self):
        """A spiral of 50 points a turn, from whose end a way straight to the middle crosses the 19 turns before."""
        def polar(r, turns):
            return [r * math.cos(2 * math.pi * turns), r * math.sin(2 * math.pi * turns)]
        points = [polar(1 + k / 1000, k / 50) for k in range(991)]
        points += [polar(1.99 - 0.1 * k, 990 / 50) for k in range(1, 15)]
        self.write("spline.yaml", f"lekalo: 1\ngeometry: {{ s: {{ type: spline_curve, points: {points} }} }}\n")
        found = self.json_of("measure", "spline.yaml", "s", "--self-intersection")
        self.assertEqual(len(found["points"]), 19)
        self.assertEqual(found["common"], [])
        for k, point in enumerate(sorted(found["points"], key=lambda one: one["t"])):
            self.assertAlmostEqual(math.hypot(*point["point"][:2]), 1.04 + 0.05 * k, delta=5e-3)

    def test_sections_through_a_tip(self):
        """A cone by its formula: straight lines through the tip, by a whole plane and by one with sides; near the tip
        what is left out is told."""
        self.write("tips.yaml", """lekalo: 1
geometry:
  k: { type: formula_surface, z: 'sqrt(x^2 + y^2)', domain: { u: [-1, 1], v: [-1, 1] } }
  across: { type: plane, frame: { origin: [0, 0, 0], z: x }, size: [6, 6] }
  part: { type: plane, frame: { origin: [0, 0, 0], z: x }, size: [1, 1] }
""")
        def found(*arguments):
            return self.json_of("measure", "tips.yaml", *arguments)
        for arguments, length in ((("k", "--section", "0,0,0,0,1,0"), 2 * math.sqrt(2)),
                                  (("k", "--section", "0,0,0,1,1,0"), 4), (("k", "--intersect", "across"), 2 * math.sqrt(2)),
                                  (("across", "--intersect", "k"), 2 * math.sqrt(2)), (("k", "--intersect", "part"), math.sqrt(2))):
            lines = found(*arguments)
            self.assertTrue(lines["complete"], arguments)
            self.assertAlmostEqual(sum(line["length"] for line in lines["branches"]), length, delta=1e-11)
        slanted = found("k", "--section", "0,0,0,0.3,1,0")
        length = sum(line["length"] for line in slanted["branches"])
        self.assertAlmostEqual(length, 2 * math.sqrt(2 * 1.09), delta=1e-6)
        self.assertFalse(slanted["complete"] and abs(length - 2 * math.sqrt(2 * 1.09)) > 1e-11)


if __name__ == "__main__":
    unittest.main()
