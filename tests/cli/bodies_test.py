"""Bodies from curves and surfaces: valid, meshed without cracks, met by rays an even number of times; volumes of random profiles; errors."""

import collections
import math
import random
import unittest

from program import SCENE_ERROR, ProgramTest

PATH = "{ type: bezier_curve, points: [[0, 0, 0], [0, 0, 4], [4, 0, 4], [5, 5, 5]] }"
ROUND = "{ type: rectangle, size: [2, 1], corner_radius: 0.2 }"
HOLE = "{ type: circle, radius: 0.2 }"
BODIES = {
    "extruded": f"{{ type: extrusion_body, of: [{ROUND}, {HOLE}], along: [1, 0, 3], back: 1 }}",
    "drafted": f"{{ type: extrusion_body, of: [{ROUND}, {HOLE}], along: [0, 0, 1], draft: 5 }}",
    "turned": f"{{ type: revolution_body, of: {{ type: rectangle, size: [1, 1], center: [2.5, 0] }}, axis: y, angle: 250 }}",
    "hollow_ring": f"{{ type: revolution_body, of: [{{ type: rectangle, size: [1, 1], center: [2.5, 0] }}, {{ type: circle, radius: 0.25, "
                   f"center: [2.5, 0] }}], axis: y }}",
    "closed_loft": "{ type: loft_body, closed: true, of: { repeat: { k: 0..4 }, type: circle, radius: 0.5 + 0.1*(k/4), center: "
                   "[2*cos(2*pi*k/5), 2*sin(2*pi*k/5), 1], normal: [-sin(2*pi*k/5), cos(2*pi*k/5), 0] } }",
    "twisted": "{ type: sweep_body, of: { type: rectangle, size: [1, 1] }, path: { type: segment, from: [0, 0, 0], to: [0, 0, 3] }, "
               "twist: 90 deg*s, scale: 1 - 0.3*s }",
    "spheroid": "{ type: revolution_body, of: { type: nurbs_curve, points: [[1, 0, -1], [1.7, 0, -0.3], [0.5, 0, 0.4], [0.9, 0, 1.5]] } }",
    "slice": "{ like: spheroid, angle: 100 }",
    "shifted": f"{{ type: translation_body, of: {ROUND}, along: {{ type: bezier_curve, points: [[0, 0, 0], [0, 0, 2], [3, 0, 2], [3, 0, 4]] }} }}",
    "bent": f"{{ type: sweep_body, of: {ROUND}, path: {PATH} }}",
    "link": "{ type: sweep_body, of: { type: circle, radius: 0.5 }, path: { type: ellipse, semi_axes: [3, 2] } }",
    "tube": f"{{ type: pipe, radius: 0.3, wall: 0.1, path: {PATH} }}",
    "loft": "{ type: loft_body, of: [{ type: rectangle, size: [2, 2] }, { type: rectangle, size: [3, 3], center: [0, 0, 1] }, "
            "{ type: rectangle, size: [1, 1], center: [0, 0, 3] }] }",
    "sheet": "{ type: thickened_sheet, of: { type: trimmed_surface, of: { type: formula_surface, point: [u, v, u*v], domain: "
             "{ u: [0, 1], v: [0, 1] } }, loops: [{ type: circle, center: [0.5, 0.5], radius: 0.4 }, "
             "{ type: circle, center: [0.5, 0.5], radius: 0.1 }] }, thickness: 0.2 }",
    "shell": "{ type: thickened_sheet, of: { type: sphere_surface, radius: 1 }, thickness: 0.2 }",
    "wall": "{ type: extrusion_body, of: { type: line_arc_curve, closed: false, nodes: [{ at: [0, 0] }, { at: [2, 0], fillet: 0.4 }, "
            "{ at: [2, 1] }, { at: [3, 1] }] }, thickness: 0.1, along: z }",
    "hollow": "{ type: hollow_body, of: { type: box, size: [3, 3, 3] }, voids: { type: ball, radius: 1, center: [1.5, 1.5, 1.5] } }",
    "set_off": "{ type: offset_body, of: { type: pyramid, points: [[0, 0], [3, 0], [3, 2], [0, 2]], height: 3 }, distance: 0.2 }",
    "round": "{ type: offset_body, of: { type: pyramid, points: [[0, 0], [3, 0], [3, 2], [0, 2]], height: 3 }, distance: 0.2, joints: round }",
    "round_drum": "{ type: offset_body, of: { type: cylinder_body, center: [1, 1, 0], radius: 1, height: 2 }, distance: 0.2, joints: round }",
    "no_groove": "{ type: offset_body, of: { type: prism, points: [[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1.6, 1], [1.6, 2], [0, 2]], "
                 "height: 2 }, distance: 0.25 }",
    "tub": f"{{ type: shell_body, of: {{ type: extrusion_body, of: {ROUND}, along: [0, 0, 2] }}, thickness: 0.05, open: [end] }}",
    "two_open": "{ type: shell_body, of: { type: box, size: [3, 2, 2] }, thickness: 0.2, open: [z_max, y_min] }",
    "tilted": f"{{ type: moved_faces, of: {{ type: extrusion_body, of: [{ROUND}, {HOLE}], along: [0, 0, 1] }}, faces: end, by: {{ rotate: 10, axis: x }} }}",
    "leant": f"{{ type: drafted_faces, of: {{ type: extrusion_body, of: [{{ type: rectangle, size: [2, 1] }}, {HOLE}], along: [0, 0, 1] }}, "
             "faces: [side.0, side.2, side.4], angle: 8 }",
    "plain": f"{{ type: deleted_faces, of: {{ type: extrusion_body, of: [{ROUND}, {HOLE}], along: [0, 0, 1] }}, faces: [side.1, side.8] }}",
    "dented": "{ type: deformed_face, of: { type: box, size: [3, 3, 2] }, face: z_max, count: 5, moves: { at: [2, 2], height: -1 } }",
}
SCENE = "lekalo: 1\ngeometry:\n" + "".join(f"  {name}: {body}\n" for name, body in BODIES.items())


class Bodies(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("bodies.yaml", SCENE)

    def test_valid_and_closed(self):
        for name in BODIES:
            with self.subTest(name):
                found = self.json_of("measure", "bodies.yaml", name, "--topology")
                self.assertEqual(found["violations"], [])
                self.assertTrue(found["closed"])

    def test_meshes_have_no_cracks(self):
        for name in BODIES:
            with self.subTest(name):
                self.run_program("export", "bodies.yaml", name, "-o", f"{name}.obj", "--sag", "0.02")
                sides = collections.Counter()
                for line in (self.folder / f"{name}.obj").read_text().splitlines():
                    if line.startswith("f "):
                        corners = [word.split("/")[0] for word in line.split()[1:]]
                        sides.update(zip(corners, corners[1:] + corners[:1]))
                self.assertGreater(len(sides), 0)
                self.assertTrue(all(count == 1 and (b, a) in sides for (a, b), count in sides.items()))

    def test_tessellations(self):
        """Meshes of the scene: of bodies closed, of a box its twelve triangles; of a ball one that holds a smaller ball."""
        meshes = "".join(f"  mesh_of_{name}: {{ type: tessellation, of: {name} }}\n" for name in BODIES)
        self.write("meshes.yaml", SCENE + meshes + """
  cuboid: { type: tessellation, of: { type: box, size: [1, 2, 3] } }
  globe: { type: tessellation, of: { type: ball, radius: 1 }, sag: 0.02, angle: 90 }
""")
        for name in BODIES:
            with self.subTest(name):
                self.assertTrue(self.json_of("measure", "meshes.yaml", f"mesh_of_{name}")["closed"])
        cuboid = self.json_of("measure", "meshes.yaml", "cuboid")
        self.assertEqual((cuboid["area"], cuboid["volume"]), (22, 6))
        share = self.json_of("measure", "meshes.yaml", "globe")["volume"] / (4 * math.pi / 3)
        self.assertTrue((1 - 0.02)**3 <= share < 1, share)
        self.write("plane.yaml", "lekalo: 1\ngeometry: { m: { type: tessellation, of: { type: plane } } }\n")
        self.assertIn("plane.yaml:2:", self.run_program("check", "plane.yaml", code=SCENE_ERROR)[1])

    def test_rays_meet_them_evenly(self):
        random.seed(7)
        rays = []
        for _ in range(60):
            direction = [random.uniform(-1, 1) for _ in range(3)]
            rays.append([random.uniform(-0.8, 3) - 20 * direction[0], random.uniform(-0.8, 3) - 20 * direction[1],
                         random.uniform(0, 4) - 20 * direction[2], *direction])
        self.write("rays.csv", "".join(",".join(map(repr, ray)) + "\n" for ray in rays))
        for name in BODIES:
            with self.subTest(name):
                self.write("one.yaml", SCENE + f"objects: [{{ shape: {name} }}]\n")
                found = [len(ray["hits"]) for ray in self.json_of("trace", "one.yaml", "--rays", "rays.csv")["rays"]]
                self.assertEqual([count % 2 for count in found], [0] * len(rays))
                self.assertGreater(sum(found), 0)

    def test_random_prisms(self):
        random.seed(11)
        for _ in range(4):
            count = random.randint(3, 9)
            corners = [(random.uniform(0.6, 2) * math.cos(2 * math.pi * k / count),
                        random.uniform(0.6, 2) * math.sin(2 * math.pi * k / count)) for k in range(count)]
            along = [random.uniform(-1, 1), random.uniform(-1, 1), random.choice([-1, 1]) * random.uniform(0.5, 2)]
            if random.random() < 0.5:
                corners.reverse()
            area = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))) / 2
            points = ", ".join(f"[{x!r}, {y!r}]" for x, y in corners)
            self.write("prism.yaml", f"lekalo: 1\ngeometry:\n  b: {{ type: extrusion_body, along: {along}, of: "
                       f"{{ type: polyline, closed: true, points: [{points}] }} }}\n")
            found = self.json_of("measure", "prism.yaml", "b")
            self.assert_near(found["volume"], area * abs(along[2]), 1e-12 * area)
            self.assertEqual(self.json_of("measure", "prism.yaml", "b", "--topology")["characteristics"][0]["faces"], count + 2)

    def test_booleans_of_swept_bodies_that_share_surfaces(self):
        """Of surfaces of revolution and extrusion with each other and with planes, cylinders, spheres and tori."""
        self.write("shared.yaml", """lekalo: 1
geometry:
  section: { type: polyline, points: [[2, 0, 0], [3, 0, 0], [3, 0, 1], [2, 0, 1]], closed: true }
  ring: { type: revolution_body, of: section }
  plate: { type: box, center: [0, 0, 0.5], size: [8, 8, 1] }
  core: { type: cylinder_body, radius: 2, height: 1 }
  part: { type: revolution_body, of: section, angle: 200 }
  other: { type: revolution_body, of: section, angle: 100, transform: { rotate: 150 } }
  rod: { type: extrusion_body, of: { type: circle, radius: 1 }, along: [0, 0, 2] }
  bolt: { type: cylinder_body, radius: 1, height: 3, center: [0, 0, -1] }
  torus: { type: torus_body, major_radius: 2, minor_radius: 0.5 }
  turned: { type: revolution_body, of: { type: circle, radius: 0.5, center: [2, 0, 0], normal: [0, -1, 0] } }
  a: { type: difference, of: plate, minus: ring }
  b: { type: union, of: [ring, core] }
  c: { type: union, of: [part, other] }
  d: { type: intersection, of: [rod, bolt] }
  e: { type: union, of: [torus, turned] }
""")
        ring = 5 * math.pi
        for name, volume in (("a", 64 - ring), ("b", 9 * math.pi), ("c", ring * 250 / 360), ("d", 2 * math.pi), ("e", math.pi**2)):
            with self.subTest(name):
                self.assert_near(self.json_of("measure", "shared.yaml", name)["volume"], volume, 1e-10)

    def test_exploded(self):
        self.write("apart.yaml", "lekalo: 1\ngeometry:\n  box: { type: box, size: [3, 2, 1] }\n"
                   "  apart: { type: exploded_body, of: box, distance: 0.5 }\n"
                   "  loop: { type: face_loop, of: box, face: z_max, inset: 0.25 }\n")
        found = self.json_of("measure", "apart.yaml", "apart", "--topology")
        self.assertEqual((found["valid"], found["closed"], found["shells"], len(found["vertices"])), (True, False, 6, 24))
        self.assert_near(self.json_of("evaluate", "apart.yaml", "apart", "--face", "x_max", "--at", "0,0")["point"][0], 3.5, 1e-15)
        self.assert_near(self.json_of("measure", "apart.yaml", "loop")["length"], 8, 1e-12)

    def test_parts_by_name(self):
        self.write("parts.yaml", "lekalo: 1\ngeometry:\n  box: { type: box, size: [3, 2, 1] }\n"
                   "  apart: { type: exploded_body, of: box, distance: 0.5 }\n")
        self.assert_near(self.json_of("measure", "parts.yaml", "box.z_max")["area"], 6, 1e-13)
        self.assert_near(self.json_of("measure", "parts.yaml", "apart.box.x_max")["area"], 2, 1e-13)
        edges = self.json_of("measure", "parts.yaml", "box", "--topology")["edges"]
        lengths = sorted(self.json_of("measure", "parts.yaml", f"box.edge.{edge['index']}")["length"] for edge in edges)
        for length, expected in zip(lengths, [1] * 4 + [2] * 4 + [3] * 4):
            self.assert_near(length, expected, 1e-12)
        self.assertIn("no face 'z_mox'", self.run_program("measure", "parts.yaml", "box.z_mox", code=2)[1])
        self.assertIn("stands for 6 things", self.run_program("measure", "parts.yaml", "apart.box", code=2)[1])

    def test_walls_of_uneven_arcs(self):
        # The same arc, its angle the parameter and not.
        walls = [f"{{ type: extrusion_body, along: z, thickness: 0.2, of: {{ type: composite_curve, of: [{{ type: segment, from: [0, 0], to: [1, 0] }}, "
                 f"{{ type: formula_curve, point: [2 - cos({angle}), sin({angle}), 0], domain: [0, {end}] }}] }} }}"
                 for angle, end in (("t", 1.3), ("t + 0.3*t*t", 1))]
        self.write("walls.yaml", f"lekalo: 1\ngeometry:\n  even: {walls[0]}\n  uneven: {walls[1]}\n")
        even, uneven = (self.json_of("measure", "walls.yaml", name)["volume"] for name in ("even", "uneven"))
        self.assert_near(even, uneven, 1e-12)

    def test_sheet_of_flat_part(self):
        # The surface is curved more than the thickness allows, but not where it is used.
        self.write("part.yaml", "lekalo: 1\ngeometry:\n"
                   "  hill: { type: formula_surface, z: '2*exp(-20*((x - 3)^2 + y^2))', domain: { u: [-1, 4], v: [-1, 1] } }\n"
                   "  part: { type: trimmed_surface, of: hill, loops: [{ type: circle, radius: 0.5 }] }\n"
                   "  sheet: { type: thickened_sheet, of: part, thickness: 0.2 }\n")
        self.assert_near(self.json_of("measure", "part.yaml", "sheet")["volume"], 0.05 * math.pi, 1e-9)

    def test_topology_in_words(self):
        self.write("sheet.yaml", "lekalo: 1\ngeometry: { s: { type: sewn_shell, of: { type: plane, size: [1, 1] } } }\n")
        text = self.run_program("measure", "sheet.yaml", "s", "--topology")[0]
        self.assertIn("open shell of 1 face, 4 edges, 4 vertices, 1 loop: H 1, connectivity 1, 1 border\n", text)
        self.assertIn("1 shell, 1 loop\n1 face\n", text)

    def refused(self, body, *texts):
        self.write("wrong.yaml", f"lekalo: 1\ngeometry:\n  b: {{ {body} }}\n")
        errors = self.run_program("measure", "wrong.yaml", "b", code=3)[1]
        for text in texts:
            self.assertIn(text, errors)

    def test_refused(self):
        self.refused("type: extrusion_body, of: { type: polyline, points: [[0, 0], [1, 0], [1, 1]] }, along: z",
                     "the profile is open: it begins at (0, 0, 0) and ends at (1, 1, 0)", "thickness")
        self.refused("type: extrusion_body, of: { type: polyline, closed: true, points: [[0, 0], [2, 2], [2, 0], [0, 1]] }, along: z",
                     "the profile meets itself at (0.666667, 0.666667, 0)")
        self.refused("type: extrusion_body, of: { type: named_curve, preset: lemniscate_of_bernoulli }, along: z", "the profile meets itself at")
        self.refused("type: extrusion_body, of: { type: circle, radius: 1 }, along: x", "within its own plane")
        self.refused("type: extrusion_body, of: { type: circle, radius: 1 }, along: [0, 0, 0]", "must not be zero")
        self.refused("type: extrusion_body, of: [{ type: circle, radius: 1 }, { type: circle, radius: 1, center: [1.5, 0] }], along: z",
                     "curves 0 and 1 of the profile meet at")
        self.refused("type: extrusion_body, of: [{ type: circle, radius: 1 }, { type: circle, radius: 0.5, center: [2.5, 0] }], along: z",
                     "two lie beside each other")
        self.refused("type: extrusion_body, of: { type: rectangle, size: [1, 1] }, along: z, draft: 40", "profile")
        self.refused("type: extrusion_body, of: { type: circle, radius: 1 }, along: z, draft: 50", "the arc of radius 1")
        self.refused("type: revolution_body, of: { type: circle, radius: 1, center: [0.5, 0, 0], normal: y }", "the profile crosses the axis")
        self.refused("type: revolution_body, axis: z, of: { type: circle, radius: 1, frame: { origin: [0.9995, 0, 0], z: y, x: [1, 0, 0.3] } }",
                     "is 0.0005 beyond it")
        self.refused("type: revolution_body, of: { type: circle, radius: 1, center: [3, 0, 0] }", "does not lie in the plane")
        self.refused("type: revolution_body, of: { type: circle, radius: 1, center: [1, 0, 0], normal: y }", "touches the axis")
        self.refused("type: translation_body, of: { type: circle, radius: 1 }, along: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 3], "
                     "[2, 0, 3], [2, 0, 1]] }", "the curve turns back")
        self.refused("type: sweep_body, of: { type: circle, radius: 1 }, path: { type: circle, radius: 0.8 }", "would run through itself",
                     "0.8 away")
        # The profile is told where it is farthest, not at its nearest sample.
        self.refused("type: pipe, path: { type: circle, radius: 1 }, radius: 1.002", "the profile reaches 1.002", "1 away")
        self.refused("type: pipe, path: { type: circle, radius: 1 }, radius: 1.5", "the profile reaches 1.5")
        self.refused("type: sweep_body, of: { type: circle, radius: 0.1 }, path: { type: polyline, points: [[0, 0, 0], [0, 0, 1], [1, 0, 1]] }",
                     "the path has a corner at (0, 0, 1), t = 1")
        self.refused("type: pipe, radius: 0, path: { type: segment, from: [0, 0, 0], to: [0, 0, 1] }", "radius")
        self.refused("type: pipe, radius: 1, wall: 1, path: { type: segment, from: [0, 0, 0], to: [0, 0, 1] }", "nothing is left open")
        self.refused("type: loft_body, of: [{ type: circle, radius: 1 }, { type: rectangle, size: [1, 1], center: [0, 0, 1] }]",
                     "section 0 has 1 segment and section 1 has 4")
        self.refused("type: thickened_sheet, of: { type: cylinder_surface, radius: 1, height: 1 }, thickness: -1.5",
                     "curved more than that", "radius of curvature on this side is 1")
        self.refused("type: hollow_body, of: { type: box, size: [1, 1, 1] }, voids: { type: box, size: [1, 1, 1], corner: [0.5, 0, 0] }",
                     "void 0 is not inside of the body")
        self.refused("type: extrusion_body, of: [{ type: rectangle, size: [4, 4] }, { type: circle, radius: 1 }], along: z, draft: 50",
                     "nothing is left of the profile", "a smaller draft")
        room = "type: hollow_body, of: { type: box, size: [9, 9, 9] }, voids"
        ball, box = "{ type: ball, radius: 1, center: [3, 3, 3] }", "{ type: box, size: [5, 5, 5], corner: [1, 1, 1] }"
        self.refused(f"{room}: [{box}, {ball}]", "void 1 runs into void 0")
        self.refused(f"{room}: [{ball}, {box}]", "void 1 runs into void 0")
        self.refused(f"{room}: {{ type: ball, radius: 1, center: [20, 3, 3] }}", "void 0 is not inside of the body")
        # A tip, an edge and a tangent point that only touch.
        cone = "{ type: revolution_body, axis: { through: [0, 4, 4], along: x }, of: { type: polyline, closed: true, points: [[0, 4, 4], [2, 4, 4], [2, 5, 4]] } }"
        wedge = "{ type: extrusion_body, along: [0, 0, 1], of: { type: polyline, closed: true, points: [[0, 4, 4], [1, 3, 4], [2, 4, 4], [1, 5, 4]] } }"
        for touching in cone, wedge, "{ type: ball, radius: 1, center: [1, 4, 4] }":
            self.refused(f"{room}: {touching}", "void 0 is not inside of the body at (0, 4, 4)")
        self.refused(f"type: hollow_body, of: {{ {room}: {ball} }}, voids: {box}", "void 0 encloses a void of the body")
        self.refused("type: extrusion_body, of: { type: circle, radius: 1 }, along: z, thickness_side: left", "no wall without a thickness")
        self.refused("type: loft_body, frame: frenet, of: [{ type: circle, radius: 1 }, { type: circle, radius: 2, center: [0, 0, 1] }]",
                     "there is no guide whose frame turns")
        self.refused("type: sewn_shell, solid: true, of: { type: plane, size: [1, 1] }", "it is open")


if __name__ == "__main__":
    unittest.main()
