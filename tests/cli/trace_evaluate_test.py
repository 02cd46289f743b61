"""What trace finds, evaluate gives back: every type of surface, faces of bodies and patches, unmoved and moved."""

import math
import random
import re
import unittest

from program import ProgramTest, ROOT, USAGE

NET = "[[0, 0, 0], [0, 1, 1], [0, 2, 0], [0, 3, 1]], [[1, 0, 1], [1, 1, 3], [1, 2, 1], [1, 3, 0]], " \
      "[[2, 0, 0], [2, 1, 1], [2, 2, 2], [2, 3, 0]]"
SURFACES = {
    "cloud_surface": "points: [[0, 0], [1, 0, 0.3], [2, 0], [0, 1, 0.3], [1, 1, 0.6], [2, 1, 0.3], [0, 2], [1, 2, 0.3], [2, 2]], degree: 2",
    "plane": "size: [4, 4]",
    "sphere_surface": "radius: 1.5",
    "cylinder_surface": "radius: 1, height: 2",
    "cone_surface": "radius: 1.5, height: 2",
    "torus_surface": "major_radius: 1.5, minor_radius: 0.5",
    "ellipsoid": "semi_axes: [1, 1.5, 0.7]",
    "hyperboloid_one_sheet": "semi_axes: [1, 0.8, 1], heights: [-1, 1.5]",
    "hyperboloid_two_sheets": "semi_axes: [1, 0.8, 0.5], heights: [0.5, 2]",
    "elliptic_paraboloid": "semi_axes: [1, 0.8], heights: [0, 2]",
    "hyperbolic_paraboloid": "semi_axes: [1, 0.8], domain: { u: [-2, 2], v: [-2, 2] }",
    "extrusion_surface": "of: { type: circle, radius: 1 }, along: [0.3, 0.2, 2]",
    "revolution_surface": "of: { type: bezier_curve, points: [[1, 0, 0], [2, 0, 1], [0.5, 0, 2]] }, axis: z",
    "bezier_surface": f"points: [{NET}], weights: [[1, 2, 1, 1], [1, 0.5, 3, 1], [1, 1, 1, 1]]",
    "nurbs_surface": f"points: [{NET}], degree: 2",
    "t_spline": "degree: 1, at: [[0, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]], lines: [[0, 1], [2, 4], [5, 7], "
                "[0, 5], [3, 6], [1, 7]], points: [[-1, -1], [2, -1], [-1, 0], [1, 0.5, 1.5], [2, 0.5], [-1, 2], [1, 2, 1], [2, 2]]",
    "t_spline_functions": "of: { type: t_spline, at: [{ repeat: { i: 0..3, j: 0..3 }, point: [i, j] }], lines: [[0, 3], [4, 7], "
                          "[8, 11], [12, 15], [0, 12], [1, 13], [2, 14], [3, 15]] }, vertices: [5]",
    "coordinate_surface": "point: [u*cos(v)*sin(w), u*sin(v)*sin(w), 1.3*u*cos(w)], hold: u, at: 1.2, "
                          "domain: { u: [0.2, 2], v: [0.5, 2.5] }",
    "formula_surface": "point: ['(2 + cos(v))*cos(u)', '(2 + cos(v))*sin(u)', sin(v) + 0.3*sin(3*u)], "
                       "domain: { u: [0, 2*pi], v: [0, 2*pi] }, closed: true",
    "ruled_surface": "of: [{ type: circle, radius: 1.5 }, { type: circle, radius: 0.7, center: [0.3, 0, 2] }]",
    "sector_surface": "of: { type: circle, radius: 2, center: [0, 0, -0.5] }, apex: [0.5, 0.5, 1.5]",
    "translation_surface": "of: { type: bezier_curve, points: [[-1.5, -1, 0], [0, -1, 2], [2, -1, 0]] }, "
                           "along: { type: formula_curve, point: [0, t, 0.3*sin(t)], domain: [0, 3] }",
    "loft_surface": "of: [{ type: circle, radius: 1, center: [0, 0, -0.5] }, { type: ellipse, semi_axes: [1.5, 0.7] }, "
                    "{ type: circle, radius: 1.2, center: [0, 0, 1.5] }]",
    "sweep_surface": "path: { type: bezier_curve, points: [[-1.5, 0, 0], [0.5, 0, 2], [1.5, 2, 0]] }, "
                     "section: { type: circle, radius: 0.6 }, scale: 1 + 0.3*s, twist: 90 deg*s",
    "bridge_surface": "from: { type: cylinder_surface, radius: 1, height: 0.5, frame: { origin: [0, 0, -0.6] } }, to: { type: "
                      "cylinder_surface, radius: 1.6, height: 1, frame: { origin: [0, 0, 1.5] } }",
    "offset_surface": f"of: {{ type: bezier_surface, points: [{NET}] }}, distance: 0.1",
    "bilinear_surface": "points: [[[-1, -1, 0], [-1, 2, 1]], [[2, -1, 1], [2, 2, 0]]]",
    "coons_surface": "u_lines: [{ type: segment, from: [-1, -1], to: [2, -1] }, { type: bezier_curve, points: [[-1, 2, 1], "
                     "[0, 3, 2], [2, 2]] }], v_lines: [{ type: formula_curve, point: [-1, 3*t - 1, t^2], domain: [0, 1] }, "
                     "{ type: segment, from: [2, -1], to: [2, 2] }]",
    "gordon": "u_lines: [{ type: segment, from: [-1, -1], to: [2, -1] }, { type: formula_curve, point: [3*t - 1, 2, "
              "sin(pi*t)], domain: [0, 1] }], v_lines: [{ type: segment, from: [-1, -1], to: [-1, 2] }, { type: segment, "
              "from: [2, -1], to: [2, 2] }]",
    "guided_loft": "along: { type: bezier_curve, points: [[0, 0, -1], [0.3, 0, 1], [0, 0, 2]] }, of: [{ type: circle, radius: 1, "
                   "center: [0, 0, -1] }, { type: circle, radius: 1.4, center: [0, 0, 2] }], at_v: [0, 1]",
    "hermite_surface": f"points: [{NET}]",
    "blade_surface": "sections: [{ points: [[2, 0, -1], [1, -0.2, -1], [0.2, -0.4, -1], [-0.6, 0.1, -1], [0.3, 0.6, -1], [1, 0.5, "
                     "-1], [2, 0, -1]] }, { points: [[2, 0, 2], [1.2, 0, 2], [0.5, 0, 2], [0.1, 0.4, 2], [0.6, 0.9, 2], [1.2, 0.7, "
                     "2], [2, 0, 2]] }]",
    "mid_surface": "of: { type: torus_surface, major_radius: 2, minor_radius: 0.5 }, to: { type: torus_surface, major_radius: 1.5, "
                   "minor_radius: 0.9 }",
    "fairing_surface": "start: [-1, 0, 0], end: [2, 0, 1], start_normal: x, closed: true, points: [{ repeat: { i: 0..7 }, row: [{ "
                       "repeat: { j: 0..2 }, point: [j, '(1 + 0.3*j)*cos((45*i) deg)', '(1 + 0.3*j)*sin((45*i) deg)'] }] }]",
    "spline_surface": f"points: [{NET}], degree: 2",
    "grid_interpolant": "of: { type: sphere_surface, radius: 1.5 }, cells: { u: 6, v: 3 }, beta: circle, ends: poles",
    "composite_bezier": "degree: { u: 2, v: 1 }, joints: { u: smooth, v: as_given }, points: [[[-1, -1], [-1, 2]], [[0, -1, 2], "
                        "[0, 2]], [[2, -1], [2, 2, 2]], [[3, -1, 1], [3, 2]]]",
    "control_polyhedron": f"of: {{ type: bezier_surface, points: [{NET}] }}",
    "fit_surface": f"grid: [{NET}], degree: 2, spans: 1",
    "smoothing_surface": f"points: [{NET}], order: second, passes: 1",
    "section_surface": "sections: [{ points: [[-1, -1, 0], [0.5, -1, 1.5], [2, -1, 0]] }, { points: [[-1, 2, 0.5], [0, 2, 1], [1, 2, "
                       "1.5], [2, 2, 0]] }]",
    "spline_of_surface": "of: { type: torus_surface, major_radius: 1.5, minor_radius: 0.5 }, tolerance: 0.01",
    "spline_volume_face": f"at: 0.4, degree_u: 2, degree_v: 2, layers: [{{ points: [{NET}] }}, {{ points: [[[-1, -1, 1], [-1, 0, 2], "
                          "[-1, 1, 1], [-1, 2, 1]], [[0, -1, 1], [0, 0, 2], [0, 1, 1], [0, 2, 1]], [[2, -1, 1], [2, 0, 2], [2, 1, 1], "
                          "[2, 2, 1]]] }]",
    "bezier_triangle": "points: [[-1, -1], [-1, 2], [2, -1, 1], [0, 3], [1, 1, 2], [3, 0]]",
    "triangle_part": "of: { type: bezier_triangle, points: [[-1, -1], [-1, 2], [2, -1, 1], [0, 3], [1, 1, 2], [3, 0]] }, "
                     "vertices: [[0.8, 0.1, 0.1], [0, 1, 0], [0, 0, 1]]",
    "bernstein_triangle": "degree: 3, index: [1, 1, 1], corners: [[-1, -1], [3, 0], [0, 3]]",
    "triangle_surface": "points: [[-1, -1, 0], [3, 0, 1], [0, 3, 0.5]]",
    "transfinite_triangle": "of: [{ type: segment, from: [-1, -1], to: [3, 0] }, { type: segment, from: [3, 0], to: [0, 3] }, "
                            "{ type: segment, from: [0, 3], to: [-1, -1] }]",
    "vintoid": "preset: toroid",
    "serpentine": "preset: coil, n: 1",
    "fillet_surface": "of: [{ type: plane, origin: [0, 0, -0.5], size: [6, 6] }, { type: cylinder_surface, radius: 1, height: 2, frame: "
                      "{ origin: [0, 0, -1], z: [0.3, 0, 1] } }], radius: 0.6",
    "extended_surface": f"of: {{ type: bezier_surface, points: [{NET}] }}, before: 0.2, after: 0.3",
    "deformed_surface": "of: { type: cylinder_surface, radius: 1.2, height: 2, frame: { origin: [0, 0, -0.5] } }, count: { u: 8, v: 5 }, "
                        "moves: [{ at: [0, 2], height: 0.5 }, { at: [4, 2], height: -0.4 }]",
    "reparametrized_surface": f"of: {{ type: bezier_surface, points: [{NET}] }}, swap: true, reverse: [u], domain: {{ u: [1, 3], v: [0, 5] }}",
    "chamfer_surface": "of: [{ type: plane, origin: [0, 0, -0.5], size: [6, 6] }, { type: cylinder_surface, radius: 1, height: 2, frame: "
                       "{ origin: [0, 0, -1], z: [0.3, 0, 1] } }], legs: [0.6, 1]",
    "thread_surface": "diameter: 2, length: 0.8",
    "weld_groove": "seam: { type: circle, radius: 1.5 }, normal: z, thickness: 0.6, gap: 0.1, root_face: 0.1, angle: 60",
    "line_surface": "of: { type: segment, from: [-1.5, -1.5, 0], to: [1.5, -1.5, 0.4] }, "
                    "directions: { type: bezier_curve, points: [[0, 3, 1], [0.3, 3, 0.6], [0, 3, 0.2]] }",
    "developable_surface": "of: [{ type: ellipse, semi_axes: [1.5, 1] }, { type: ellipse, semi_axes: [1, 1.5], frame: { origin: [0, 0, 1] } }]",
    "development": "of: { type: cone_surface, radius: 1.5, top_radius: 0.5, height: 2 }",
    "ribbon": "of: { type: bezier_curve, points: [[-1, -1, -1], [1, -1, 0], [1, 1, 0.5], [-1, 1, 1]] }, width: 1.5",
}


class TraceThenEvaluate(ProgramTest):
    def check(self, names, shift, rays_each, scene, middle):
        """Rays through the neighbourhood of every shape; shape k stands `shift` * k along x."""
        random.seed(5)
        self.write("scene.yaml", scene)
        rays = []
        for k in range(len(names)):
            for _ in range(rays_each):
                through = [x + random.uniform(-0.7, 0.7) for x in middle]
                direction = [random.uniform(-1, 1) for _ in range(3)]
                origin = [x - 3 * d for x, d in zip(through, direction)]
                rays.append([origin[0] + shift * k, *origin[1:], *direction])
        self.write("rays.csv", "".join(",".join(map(repr, ray)) + "\n" for ray in rays))
        met = set()
        for ray in self.json_of("trace", "scene.yaml", "--rays", "rays.csv")["rays"]:
            for hit in ray["hits"][:2]:
                name = hit["object"]
                on_line = [o + hit["t"] * d for o, d in zip(ray["origin"], ray["direction"])]
                self.assert_near(hit["point"], on_line, 1e-12)
                there = self.json_of("evaluate", "scene.yaml", name, "--face", hit["face"], "--at",
                                     f"{hit['u']!r},{hit['v']!r}")["point"]
                self.assert_near([there[0] + shift * names.index(name), *there[1:]], hit["point"], 1e-12)
                met.add(name)
        self.assertEqual(met, set(names))

    def test_table_of_parameters(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  c: { type: circle, radius: 2 }\n"
                   "  ball: { type: sphere_surface, radius: 2 }\n")
        self.write("t.csv", "t\n0\n0.5\n1\n")
        self.write("uv.csv", "0, 0.5\n1, 0.25\n")
        rows = self.json_of("evaluate", "scene.yaml", "c", "--table", "t.csv")["rows"]
        self.assertEqual(rows, [self.json_of("evaluate", "scene.yaml", "c", "--at", at) for at in ("0", "0.5", "1")])
        rows = self.json_of("evaluate", "scene.yaml", "ball", "--table", "uv.csv")["rows"]
        self.assertEqual(rows[1], self.json_of("evaluate", "scene.yaml", "ball", "--at", "1,0.25"))
        self.run_program("evaluate", "scene.yaml", "ball", "--table", "t.csv", code=2)
        self.run_program("evaluate", "scene.yaml", "c", "--at", "0", "--table", "t.csv", code=2)

    def test_every_type_is_here(self):
        listed = set(re.findall(r"^## (\w+)$", (ROOT / "docs/reference/surfaces.md").read_text(), re.MULTILINE))
        outside = {"patches", "external_surface"}
        self.assertEqual(set(SURFACES), listed - outside)

    def test_surfaces(self):
        names = ["of_" + name for name in SURFACES]
        geometry = "".join(f"  of_{name}: {{ type: {name}, {fields} }}\n" for name, fields in SURFACES.items())
        objects = "".join(f"  - {{ shape: {name}, transform: {{ translate: [{12 * k}, 0, 0] }} }}\n"
                          for k, name in enumerate(names))
        self.check(names, 12, 5, f"lekalo: 1\ngeometry:\n{geometry}objects:\n{objects}", [0.5, 0.5, 0.5])

    def test_faces_and_patches(self):
        teapot = ROOT / "scenes/data/newell_teapot.txt"
        self.check(["teapot"], 0, 6, f"lekalo: 1\ngeometry: {{ teapot: {{ type: patches, file: '{teapot}' }} }}\n",
                   [0, 0, 1.2])
        self.check(["sheet"], 0, 20, "lekalo: 1\ngeometry: { sheet: { type: trimmed_surface, of: { type: torus_surface, "
                   "major_radius: 1, minor_radius: 0.5 }, keep: outside, loops: [{ type: circle, radius: 0.7 }] } }\n",
                   [0, 0, 0])
        self.check(["wedge"], 0, 6, "lekalo: 1\ngeometry: { wedge: { type: wedge, size: [2, 3, 1], top: 1 } }\n",
                   [0.5, 1, 0.5])

    def test_frames_of_curves(self):
        """The twisted cubic at t = 1 and the ellipse at pi/3 (Golovanov 2016, 2.1), and helices of both hands."""
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n"
                   "  cubic: { type: formula_curve, point: [t, t^2, t^3], domain: [0, 2] }\n"
                   "  oval: { type: ellipse, semi_axes: [3, 2] }\n"
                   "  right: { type: formula_curve, point: [2*cos(t), 2*sin(t), 0.5*t], domain: [0, 9] }\n"
                   "  left: { type: formula_curve, point: [2*cos(t), 2*sin(t), -0.5*t], domain: [0, 9] }\n")
        cubic = self.json_of("evaluate", "scene.yaml", "cubic", "--at", "1", "--order", "3")
        self.assert_near(cubic["point"] + sum(cubic["derivatives"], []), [1, 1, 1, 1, 2, 3, 0, 2, 6, 0, 0, 6], 1e-14)
        self.assert_near(cubic["curvature"], math.sqrt(19 / 686), 1e-15)
        self.assert_near(cubic["torsion"], 3 / 19, 1e-15)
        self.assert_near(cubic["tangent"], [x / math.sqrt(14) for x in (1, 2, 3)], 1e-15)
        self.assert_near(cubic["normal"], [-0.674453273433462, -0.490511471587973, 0.551825405536469], 1e-14)
        self.assert_near(cubic["binormal"], [x / math.sqrt(19) for x in (3, -3, 1)], 1e-15)
        self.assert_near(self.json_of("evaluate", "scene.yaml", "oval", "--at", "pi/3")["curvature"], 0.278098532170490,
                         1e-14)
        # k = r/(r^2 + c^2), torsion c/(r^2 + c^2): positive of a right-handed helix.
        for name, sign in ("right", 1), ("left", -1):
            helix = self.json_of("evaluate", "scene.yaml", name, "--at", "4")
            self.assert_near([helix["curvature"], helix["torsion"]], [2 / 4.25, sign * 0.5 / 4.25], 1e-15)

    def test_straight_lines_and_cusps(self):
        """No noise: a straight line has no torsion, at a cusp the tangent is the limit."""
        third = "[[0.1, 0.7, 0.3], [0.4, 0.8, 0.5], [0.7, 0.9, 0.7], [1, 1, 0.9]]"
        self.write("scene.yaml", f"lekalo: 1\ngeometry:\n  line: {{ type: bezier_curve, points: {third} }}\n"
                   "  cardioid: { type: formula_curve, point: [2*(1 - cos(t))*cos(t), 2*(1 - cos(t))*sin(t), 0], "
                   "domain: [0, 2*pi] }\n"
                   "  cusp: { type: formula_curve, point: [t^2, t^3, 0], domain: [-1, 1] }\n"
                   "  ball: { type: sphere_surface, radius: 2 }\n"
                   "  great: { type: geodesic_curve, of: ball, from: [0.3, 0], direction: 90, length: 5 }\n"
                   "  shadow: { type: projected_curve, of: { type: segment, from: [3, 0, 0], to: [0, 3, 1] }, onto: ball }\n"
                   "  flex: { type: formula_curve, point: [t, t^3, 0], domain: [-1, 1] }\n")
        for t in "0", "0.3", "0.77", "1":
            line = self.json_of("evaluate", "scene.yaml", "line", "--at", t)
            self.assertEqual([line[key] for key in ("curvature", "torsion", "normal", "binormal")], [0, 0, None, None])
            self.assert_near(line["tangent"], [x / math.sqrt(14) for x in (3, 1, 2)], 1e-14)
        flex = self.json_of("evaluate", "scene.yaml", "flex", "--at", "0")
        self.assertEqual([flex[key] for key in ("curvature", "torsion", "normal")], [0, None, None])
        # Curves on surfaces have few derivatives: great circles.
        for name in "great", "shadow":
            found = self.json_of("evaluate", "scene.yaml", name, "--at", "0.6")
            self.assert_near([found["curvature"], found["torsion"]], [0.5, 0], 1e-9)
        # From greater t, at the end of the domain from smaller.
        for name, t, tangent in ("cusp", "0", [1, 0, 0]), ("cardioid", "0", [1, 0, 0]), ("cardioid", "2*pi", [-1, 0, 0]):
            found = self.json_of("evaluate", "scene.yaml", name, "--at", t)
            self.assert_near(found["tangent"], tangent, 1e-12)
            self.assertEqual([found[key] for key in ("curvature", "torsion", "normal")], [None, None, None])

    def test_parameters(self):
        """Domain, period, closure; and a note outside of the domain, on parts of periodic shapes too."""
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  rim: { type: circle, radius: 1 }\n"
                   "  arc: { type: circle, radius: 1, arc: [0, 90] }\n"
                   "  wave: { type: bezier_curve, points: [[0, 0], [1, 2], [2, 0]] }\n"
                   "  pipe: { type: cylinder_surface, radius: 1, height: 3 }\n")
        turn = 2 * math.pi
        for name, at, expected in (
                ("rim", "1", [("t", [0, turn], turn, True)]), ("arc", "1", [("t", [0, turn / 4], turn, False)]),
                ("wave", "1", [("t", [0, 1], None, False)]),
                ("pipe", "1,1", [("u", [0, turn], turn, True), ("v", [0, 1], None, False)])):
            for found in (self.json_of("evaluate", "scene.yaml", name, "--at", at),
                          self.json_of("measure", "scene.yaml", name)):
                self.assertEqual([tuple(one.values()) for one in found["parameters"]], expected)
            self.assertNotIn("note", self.run_program("evaluate", "scene.yaml", name, "--at", at)[1])
        self.assertIn("domain of u           0 to 6.2831853071795862, period 6.2831853071795862, closed\n"
                      "domain of v           0 to 1\n", self.run_program("measure", "scene.yaml", "pipe")[0])
        self.assertEqual(self.run_program("evaluate", "scene.yaml", "rim", "--at", "7")[1], "")
        for name, at, note in (("arc", "7", "by the period the place is 0.716814693"),
                               ("arc", "2", "outside the domain 0 to 1.57079633, this is the continuation"),
                               ("wave", "1.5", "t = 1.5 lies outside"), ("pipe", "7,4", "v = 4 lies outside")):
            self.assertIn(note, self.run_program("evaluate", "scene.yaml", name, "--at", at)[1])

    def test_options_of_other_things_are_refused(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  ring: { type: circle, radius: 1 }\n  ball: { type: sphere_surface, radius: 2 }\n"
                   "  polar: { type: coordinate_surface, point: [u*cos(v), u*sin(v), w], hold: u, at: 1, "
                   "domain: { u: [0, 6], v: [0, 1] }, transform: [{ scale: 2 }, { translate: [0, 0, 3] }] }\n")
        for *arguments, message in (("ring", "--at", "1", "--metric", "--metric and --face belong to surfaces"),
                                    ("ring", "--at", "1", "--face", "0", "--metric and --face belong to surfaces"),
                                    ("ball", "--at", "1,1", "--order", "3", "--order belongs to curves"),
                                    ("polar", "--at", "1,0,0", "--along", "1,0", "take --at U,V of the surface"),
                                    ("polar", "--at", "1,0,0", "--turn", "5", "take --at U,V of the surface")):
            self.assertIn(message, self.run_program("evaluate", "scene.yaml", *arguments, code=USAGE)[1])
        # Coordinates move with their surface.
        found = self.json_of("evaluate", "scene.yaml", "polar", "--at", "3,0,0.5")
        self.assert_near(found["point"] + sum(found["basis"], []), [6, 0, 4, 2, 0, 0, 0, 6, 0, 0, 0, 2], 1e-14)

    def test_curvatures_at_a_pole(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  dish: { type: formula_surface, coordinates: cylindrical, "
                   "point: [u, v, u^2], domain: { u: [0, 1], v: [0, 2*pi] } }\n"
                   "  cone: { type: formula_surface, coordinates: cylindrical, point: [u, v, u], "
                   "domain: { u: [0, 1], v: [0, 2*pi] } }\n")
        dish = self.json_of("evaluate", "scene.yaml", "dish", "--at", "0,0.4")
        self.assert_near(dish["gaussian_curvature"], 4, 1e-7)
        self.assert_near(dish["principal_curvatures"], [2, 2], 1e-7)
        self.assertRegex(self.run_program("evaluate", "scene.yaml", "cone", "--at", "0,0.4")[0],
                         r"gaussian_curvature +-\nmean_curvature +-\nprincipal_curvatures +-\n")


if __name__ == "__main__":
    unittest.main()
