"""Formulas with infinite slopes, steps and poles: what is drawn is the curve, and no output holds a number that is none."""

import math
import re
import unittest
import xml.etree.ElementTree as tree

from program import ProgramTest

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


if __name__ == "__main__":
    unittest.main()
