"""What figures of scenes/figures show is so in numbers: of closed forms, of tables, of sums written out here."""

import math
import unittest

from program import DIFFERS, ProgramTest, ROOT

FIGURES = ROOT / "scenes/figures"


def bernstein(n, i, t):
    return math.comb(n, i) * t**i * (1 - t)**(n - i)


class FigureNumbers(ProgramTest):
    def evaluate(self, figure, name, *at, **options):
        return self.json_of("evaluate", FIGURES / f"{figure}.yaml", name, "--at", ",".join(map(repr, at)))

    def length(self, point, domain, coordinates="cartesian"):
        self.write("arc.yaml", "lekalo: 1\ngeometry: { arc: { type: formula_curve, "
                   f"coordinates: {coordinates}, point: [{point}], domain: [{domain}] }} }}\n")
        return self.json_of("measure", "arc.yaml", "arc")["length"]

    def test_weight_of_a_point(self):
        """Golovanov 2016, 2.6: the weights -0.5, 0, 1, 4, 16 of p_3."""
        points = [(0, 0), (1, 2), (2, 2), (3, 3), (5, 2), (6, 0)]
        for k, w in enumerate((-0.5, 0, 1, 4, 16)):
            for t in 0.1, 0.5, 0.8:
                share = [bernstein(5, i, t) * (w if i == 3 else 1) for i in range(6)]
                expected = [sum(s * p[x] for s, p in zip(share, points)) / sum(share) for x in (0, 1)]
                self.assert_near(self.evaluate("weight_family", f"curve.{k}", t)["point"][:2], expected, 1e-14)
        self.assert_near(self.evaluate("weight_family", "curve.3", 0.5)["point"][:2],
                         [2.83870967741935, 2.58064516129032], 1e-14)

    def test_degree_elevation(self):
        """The same curve with the points and the weight of Golovanov 2016, 2.6."""
        scene = FIGURES / "degree_elevation.yaml"
        self.run_program("measure", scene, "three", "--against", "two", "--tolerance", "1e-14")
        text = scene.read_text()
        c = math.sqrt(0.5)
        w = (1 + 2 * c) / 3
        self.assertIn("[(c + 2)/(3*w), -c/(3*w)]", text)
        self.assert_near([w, (c + 2) / (3 * w), c / (3 * w)], [0.804737854124365, 1.12132034355964, 0.292893218813452],
                         1e-14)

    def test_knot_insertion(self):
        scene = FIGURES / "knot_insertion.yaml"
        for name in "once", "thrice":
            self.run_program("measure", scene, name, "--against", "curve", "--tolerance", "1e-13")
        self.assert_near(self.evaluate("knot_insertion", "curve", 2.5)["point"], [3.5, 35 / 24, 0], 1e-15)

    def test_ellipse_of_eight_points(self):
        """Golovanov 2016, 2.14 (f)."""
        for t, x, y in ((0.25, 2.78936490318729, 0.736189419123746), (0.5, 3 / math.sqrt(2), math.sqrt(2)),
                        (3.25, 1.10428412868562, -1.85957660212486)):
            self.assert_near(self.evaluate("ellipse_of_nurbs", "curve", t)["point"], [x, y, 0], 1e-14)
        for k in range(40):
            x, y, _ = self.evaluate("ellipse_of_nurbs", "curve", k / 10)["point"]
            self.assert_near((x / 3)**2 + (y / 2)**2, 1, 1e-15)
        (t,) = self.evaluate("ellipse_of_nurbs", "curve", 1.0)["parameters"]
        self.assertEqual((t["domain"], t["period"], t["closed"]), ([0, 4], 4, True))

    def test_images_of_a_curve(self):
        """Points and derivatives under the maps of Golovanov 2016, 2.15 (e)."""
        turn = math.radians(60)
        maps = {"turned": lambda x, y, moved: (x * math.cos(turn) - y * math.sin(turn) + 7 * moved,
                                               x * math.sin(turn) + y * math.cos(turn)),
                "mirrored": lambda x, y, moved: (4.8 * moved - x, y),
                "stretched": lambda x, y, moved: (2 * x, 0.5 * y - 1.4 * moved)}
        for t in 0.0, 0.3, 0.9:
            base = self.evaluate("moved_curves", "base", t)
            for name, image in maps.items():
                moved = self.evaluate("moved_curves", name, t)
                self.assert_near(moved["point"][:2], image(*base["point"][:2], 1), 1e-14)
                for of_base, of_moved in zip(base["derivatives"], moved["derivatives"]):
                    self.assert_near(of_moved[:2], image(*of_base[:2], 0), 1e-13)

    def test_bilinear_surface(self):
        """Golovanov 2016, 3.5.1: r_uv = p00 - p10 - p01 + p11, K = -(r_uv m)^2/g."""
        found = self.evaluate("bilinear_patch", "patch", 0.25, 0.5)
        self.assert_near(found["point"], [0.5, 1, 0.5], 1e-15)
        self.assert_near(found["du"] + found["dv"] + found["duv"], [2, 0, 0, 0, 2, 0.5, 0, 0, -2], 1e-14)
        self.assert_near(found["duu"] + found["dvv"], [0] * 6, 1e-14)
        # r_u x r_v = (0, -1, 4), g = 17
        self.assert_near(found["gaussian_curvature"], -(8 / math.sqrt(17))**2 / 17, 1e-14)
        corner = self.evaluate("bilinear_patch", "triangle", 0.0, 0.4)
        self.assert_near(corner["point"], [4, -1, 0.5], 0)
        self.assert_near(math.hypot(*corner["normal"]), 1, 1e-15)

    def test_biquadratic_patches(self):
        """Golovanov 2016, 3.7.4: on the sphere and the torus, at the places of the table."""
        self.assert_near(self.evaluate("biquadratic_patches", "octant", 0.25, 0.75)["point"],
                         [0.342250154633602, 0.135493715207440, 0.929788301062430], 1e-14)
        found = self.evaluate("biquadratic_patches", "octant", 0.25, 0.75)
        self.assert_near(found["du"], [-0.215260137635541, 0.543736034394084, 0], 1e-14)
        self.assert_near(found["duv"], [0.863838543521223, -2.182011723908885, 0], 1e-13)
        self.assert_near(self.evaluate("biquadratic_patches", "torus", 0.25, 0.5)["point"],
                         [3.279363691049638, 1.728703117641829, 0.707106781186548], 1e-14)
        for u in 0.0, 0.3, 0.8:
            for v in 0.1, 0.6, 1.0:
                x, y, z = self.evaluate("biquadratic_patches", "octant", u, v)["point"]
                self.assert_near(x * x + y * y + z * z, 1, 1e-15)
                x, y, z = self.evaluate("biquadratic_patches", "torus", u, v)["point"]
                self.assert_near((math.hypot(x, y) - 3)**2 + z * z, 1, 1e-14)

    def test_averaged_normals(self):
        """Means of the five triangles at a corner of an icosahedron look away from its middle, and so do all between."""
        for x, name in ((-4.4, "flat"), (0, "smooth"), (4.4, "creased")):
            hits = self.json_of("trace", FIGURES / "averaged_normals.yaml", "--ray", f"{x + 0.3},-5,0.4,0,1,0")["hits"]
            self.assertEqual(hits[0]["object"], name)
            point = [hits[0]["point"][0] - x, *hits[0]["point"][1:]]
            radial = [c / math.hypot(*point) for c in point]
            self.assert_near(hits[0]["normal"], radial if name == "smooth" else hits[0]["geometric_normal"], 1e-12)
            self.assertGreater(math.dist(hits[0]["geometric_normal"], radial), 0.1)

    def test_moments_about_the_centroid(self):
        """A block has m/3 (b^2 + c^2) about an edge, m/12 (b^2 + c^2) about the axis through its centroid (8.11)."""
        block = self.json_of("measure", FIGURES / "central_moments.yaml", "block")
        a, b, c = 2.4, 1.6, 1.2
        mass = a * b * c
        self.assert_near(block["centroid"], [a / 2, b / 2, c / 2], 1e-14)
        for i, (p, q) in enumerate(((b, c), (a, c), (a, b))):
            self.assert_near(block["inertia"][i][i], mass / 12 * (p * p + q * q), 1e-13)
            at_origin = block["inertia"][i][i] + mass * ((p / 2)**2 + (q / 2)**2)
            self.assert_near(at_origin, mass / 3 * (p * p + q * q), 1e-13)
            self.assert_near(block["inertia"][i][(i + 1) % 3], 0, 1e-14)

    def test_operations_on_bodies(self):
        """A block and a post that stands out of it: their union, intersection and difference by the common part."""
        r, h, off = 0.7, 1.2, 0.5  # what lies beyond x = 1 is a segment of the circle about x = 1/2
        common = h * (math.pi * r * r - (r * r * math.acos(off / r) - off * math.sqrt(r * r - off * off)))
        block, post = 2 * 2 * h, math.pi * r * r * 2.2
        for name, volume in ("both", block + post - common), ("common", common), ("less", block - common):
            found = self.json_of("measure", FIGURES / "plate_csg.yaml", name)
            self.assert_near(found["volume"], volume, max(found["volume_error"], 1e-9))
            self.assertLess(found["volume_error"], 0.02 * volume)

    def test_moving_lamp(self):
        """A whole turn brings the first picture back, half a turn another shadow."""
        self.run_program("render", FIGURES / "moving_lamp.yaml", "--frames", "azimuth=0..360:3", "--size", "60x40",
                         "--samples", "1", "-o", "lamp.exr", "--quiet")
        self.run_program("compare", "lamp_0001.exr", "lamp_0003.exr", "--metric", "max", "--threshold", "1e-5")
        self.run_program("compare", "lamp_0001.exr", "lamp_0002.exr", "--metric", "max", "--threshold", "0.2",
                         code=DIFFERS)

    def check_curves(self, figure, curves):
        """name: place (x, y), scale in the figure, range of t, equation."""
        for name, (x0, y0, scale, (lo, hi), equation) in curves.items():
            for k in range(1, 12):
                t = lo + (hi - lo) * k / 12
                x, y, _ = self.evaluate(figure, name, t)["point"]
                self.assert_near(equation((x - x0) / scale, (y - y0) / scale), 0, 1e-12)

    def test_plane_cubics(self):
        """Equations, lengths of loops and arcs (Grezdov, Filippenko 2010, 7.2)."""
        self.check_curves("plane_cubics", {
            "witch": (0, -0.5, 1, (-1.7, 1.7), lambda x, y: (x * x + 1) * y - 1),
            "folium": (4.2, 0, 0.8, (-0.5, 2.07), lambda x, y: x**3 + y**3 - 3 * x * y),
            "cissoid": (8, 0, 1, (-1.7, 1.7), lambda x, y: y * y * (1 - x) - x**3),
            "cubic_parabola": (0, -4, 1, (-1.1, 1.1), lambda x, y: y - x**3),
            "trisectrix": (3.3, -4, 0.8, (-2.6, 2.6), lambda x, y: x * (x * x + y * y) - 3 * x * x + y * y),
            "ophiuride": (8, -4, 1, (-2, 1.3), lambda x, y: x * (x * x + y * y) - y * (y + x)),
            "semicubical": (-0.6, -8, 1, (-1.1, 1.1), lambda x, y: y * y - x**3),
            "strophoid": (4.2, -8, 1, (-2, 2), lambda x, y: y * y * (1 - x) - x * x * (1 + x)),
            "trident_left": (8.4, -8, 1, (-1.25, -0.2), lambda x, y: x * y - x**3 - 0.3),
            "trident_right": (8.4, -8, 1, (0.2, 1.1), lambda x, y: x * y - x**3 - 0.3)})
        self.assert_near(self.length("3*sin(t)*cos(t)/(sin(t)^3 + cos(t)^3), t", "0, pi/2", "polar"), 4.917488722, 1e-9)
        self.assert_near(self.length("(3 - t^2)/(1 + t^2), t*(3 - t^2)/(1 + t^2)", "-sqrt(3), sqrt(3)"), 8.244653292, 1e-9)
        self.assert_near(self.length("(t^2 - 1)/(t^2 + 1), t*(t^2 - 1)/(t^2 + 1)", "-1, 1"), 2.489597270, 1e-9)
        self.assert_near(self.json_of("measure", FIGURES / "plane_cubics.yaml", "semicubical")["length"],
                         2 * ((4 + 9 * 1.1**2)**1.5 - 8) / 27, 1e-9)

    def test_plane_quartics(self):
        """Equations and lengths (Grezdov, Filippenko 2010, 7.3)."""
        def descartes(sign):
            return lambda x, y: math.hypot(x, y) + sign * 0.5 * math.hypot(x - 1, y) - 1.5
        spiric = lambda x, y: (x * x + y * y + 0.25 + 4 - 0.64)**2 - 16 * (x * x + 0.25)
        conchoid = lambda x, y: (y - 0.5)**2 * (x * x + y * y) - y * y
        kappa = lambda x, y: (x * x + y * y) * y * y - x * x
        round_ = (0, 2 * math.pi)
        self.check_curves("plane_quartics", {
            "lemniscate": (0, 0, 1, round_, lambda x, y: (x * x + y * y)**2 - 2 * (x * x - y * y)),
            "oval_inner": (5.4, 0, 0.5, round_, descartes(1)),
            "oval_outer": (5.4, 0, 0.5, round_, descartes(-1)),
            "kappa_right": (9.6, 0, 1, (0.5, math.pi - 0.5), kappa),
            "kappa_left": (9.6, 0, 1, (0.5, math.pi - 0.5), kappa),
            "cardioid": (1.2, -4, 1, round_, lambda x, y: (x * x + y * y + 1.2 * x)**2 - 1.44 * (x * x + y * y)),
            "cassini": (4.8, -4, 1, round_, lambda x, y: (x * x + y * y + 1)**2 - 4 * x * x - 1.2**4),
            "conchoid_far": (9.6, -4, 1, (0.4, math.pi - 0.4), conchoid),
            "conchoid_near": (9.6, -4, 1, (0.2, math.pi - 0.2), conchoid),
            "limacon": (-1.1, -8, 0.8, round_, lambda x, y: (x * x + y * y - 2 * x)**2 - x * x - y * y),
            "perseus_right": (4.8, -8, 0.6, round_, spiric),
            "perseus_left": (4.8, -8, 0.6, round_, spiric),
            "deltoid": (9.6, -8, 1, round_, lambda x, y: (x * x + y * y)**2 + 4.5 * (x * x + y * y) - 27 / 16
                        - 4 * (x**3 - 3 * x * y * y))})
        for name, expected in (("lemniscate", 7.416298709), ("cassini", 7.827269088), ("cardioid", 16 * 0.6),
                               ("limacon", 0.8 * 13.36489322), ("perseus_right", 0.6 * 5.122986065), ("deltoid", 8)):
            found = self.json_of("measure", FIGURES / "plane_quartics.yaml", name)["length"]
            self.assert_near(found, expected, 1e-8)

    def test_lame_curves(self):
        """The equation, and the areas 4 Gamma(1 + 1/m)^2 / Gamma(1 + 2/m) that their quarters bound."""
        for name, m in ("star", 0.5), ("astroid", 2 / 3), ("hypoellipse", 1.5), ("superellipse", 2.5):
            for j in range(4):
                for t in 0.1, 0.7, 1.4:
                    x, y, _ = self.evaluate("lame_curves", f"{name}.{j}", t)["point"]
                    self.assert_near(abs(x)**m + abs(y)**m, 1, 1e-14)
        for t in 0.2, 2.0, 5.0:
            x, y, _ = self.evaluate("lame_curves", "squircle", t)["point"]
            self.assert_near(x**4 + y**4, 1, 1e-15)
        self.write("quarter.yaml", "lekalo: 1\ngeometry:\n" + "".join(
            f"  {name}: {{ type: trimmed_surface, of: {{ type: plane, size: [4, 4] }}, loops: [{{ type: formula_curve, "
            f"point: [{x}, {y}], domain: [0, pi/2] }}, {{ type: polyline, points: [[0, 1], [0, 0], [1, 0]] }}] }}\n"
            for name, x, y in (("astroid", "cos(t)^3", "sin(t)^3"), ("star", "cos(t)^4", "sin(t)^4"))))
        for name, m in ("astroid", 2 / 3), ("star", 0.5):
            area = math.gamma(1 + 1 / m)**2 / math.gamma(1 + 2 / m)
            self.assert_near(self.json_of("measure", "quarter.yaml", name)["area"], area, 1e-9)


if __name__ == "__main__":
    unittest.main()
